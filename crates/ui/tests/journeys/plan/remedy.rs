use egui_kittest::kittest::Queryable as _;

use super::{draw, number, planning, type_number};

#[test]
fn the_worst_stretch_is_told_with_what_a_landmark_or_more_height_would_do_and_another_line_is_looked_for()
 {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    type_number(&mut rig, "Limit (1σ)", "500");
    rig.settle();
    let words = "What mends the worst stretch";
    assert!(rig.harness.query_by_label_contains(words).is_none());
    type_number(&mut rig, "Limit (1σ)", "3");
    rig.settle();
    rig.settle();
    assert!(number(&rig, "/prediction/stretches") > 0.0);
    // Nothing is tested: another landmark would be no better than a box at random, and is not advised.
    rig.harness.get_by_label_contains(
        "that is found like a box at random would not mend the worst stretch.",
    );
    rig.open_tab("Landmarks");
    rig.harness.state_mut().host.per_frame = Some(0.9);
    rig.harness.get_by_label("Test all").click();
    for _ in 0..6 {
        rig.settle();
    }
    rig.open_tab("Route");
    rig.settle();
    let [planned, aided, higher] =
        ["0", "1", "2"].map(|i| number(&rig, &format!("/remedies/sigmas/{i}")));
    assert!(aided < 0.95 * planned, "{planned} {aided} {higher}");
    rig.harness
        .get_by_label_contains("To fix the worst stretch, add a landmark ");
    rig.harness
        .get_by_label_contains("Found like the tested ones, it makes the largest error");
    rig.harness
        .get_by_label_contains("above ground its largest error is");
    let (north, east) = (
        number(&rig, "/remedies/place/0"),
        number(&rig, "/remedies/place/1"),
    );
    rig.harness
        .get_by_label("Reroute around the worst stretch")
        .click();
    rig.settle();
    assert_eq!(rig.state()["plan"]["tab"], "Ground");
    assert_eq!(number(&rig, "/find/from/0"), north);
    assert_eq!(number(&rig, "/find/from/1"), east);
    assert!(number(&rig, "/find/to/1") > east);
    assert!(number(&rig, "/find/surest/length") > 0.0);
}
