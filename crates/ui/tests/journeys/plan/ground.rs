//! The ground under a plan: an elevation model's, or level at a stated height.

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use pilotage_core::frames::{Geodetic, GroundPoint};
use pilotage_core::imagery::terrain::HeightDatum;
use pilotage_jobs::{Job, OpenedFiles, TerrainInfo};
use pilotage_ui::host::OpenedFile;

use super::super::support::Rig;
use super::{choose, click, count, draw, number, planning, set};

/// Ground at 400 m, and between the demo's west and east a ridge of 500 m that ends 200 m north and south.
fn ridge(place: &GroundPoint) -> f64 {
    let on_it = place.east.abs() < 45.0 && place.north.abs() < 200.0;
    if on_it { 500.0 } else { 400.0 }
}

fn open_heights(rig: &mut Rig) {
    rig.host().heights = Some(ridge);
    rig.host().opens = Some(OpenedFiles {
        key: String::new(),
        log: None,
        flight: None,
        map: None,
        terrain: Some(TerrainInfo {
            name: "ridge.tif".into(),
            datum: HeightDatum::MeanSeaLevel("EGM96".into()),
            spacing: 10.0,
            middle: Geodetic::from_degrees(45.0, -30.0, 0.0),
        }),
        mission: None,
        run: None,
        unplaced: None,
        photos: Vec::new(),
        imports: Vec::new(),
        tables: Vec::new(),
        labels: None,
        beside: None,
        remarks: Vec::new(),
    });
    rig.host().opened.push(vec![OpenedFile {
        path: "ridge.tif".into(),
        content: vec![1].into(),
    }]);
    rig.frames(4);
    rig.settle();
    assert_eq!(rig.state()["terrain"]["name"], "ridge.tif");
}

fn frame(rig: &mut Rig, frame: &str) {
    rig.harness
        .get_by_label("What the altitude counts from")
        .click_accesskit();
    rig.frames(3);
    rig.harness.get_by_label(frame).click();
    rig.settle();
}

/// Heights above ground, metres, in the last prediction that was asked for from `height` at the start: what
/// would mend a stretch is predicted from higher up.
fn predicted_heights(rig: &mut Rig, height: f64) -> Vec<f64> {
    let jobs = rig.host().jobs.iter().rev();
    let order = jobs.filter_map(|(_, job)| match job {
        Job::Predict(order) => Some(order),
        _ => None,
    });
    let mut order = order.filter(|o| {
        o.path
            .targets
            .first()
            .is_some_and(|t| (t.height - height).abs() < 0.5)
    });
    let targets = order.next().map(|o| &o.path.targets).expect("a prediction");
    targets.iter().map(|t| t.height).collect()
}

#[test]
fn an_opened_elevation_model_is_named_and_counts_in_altitudes_profile_and_prediction() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    assert_eq!(
        count(
            &rig,
            "Ground: level at 0 m AMSL, no elevation model is open."
        ),
        1
    );
    open_heights(&mut rig);
    rig.open_tab("Plan");
    rig.settle();
    assert_eq!(count(&rig, "ridge.tif, heights above EGM96"), 1);
    assert_eq!(count(&rig, "Ground: ridge.tif, heights above EGM96."), 1);
    choose(&mut rig, 1);
    let height = number(&rig, "/routes/0/way_points/0/altitude");
    frame(&mut rig, "AMSL");
    let amsl = number(&rig, "/routes/0/way_points/0/altitude");
    assert!((amsl - height - 400.0).abs() < 0.5, "{height} {amsl}");
    rig.harness
        .get_by_label("This altitude for all way-points")
        .click();
    rig.settle();
    let heights = predicted_heights(&mut rig, height);
    let lowest = heights.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(
        heights.len() > 2 && (lowest - height + 100.0).abs() < 1.0,
        "{heights:?}"
    );
    rig.open_tab("Heights");
    let words = format!(
        "Heights along the route: lowest {:.0} m above ground",
        height - 100.0
    );
    assert_eq!(count(&rig, &words), 1, "{words}");
}

#[test]
fn without_an_elevation_model_the_height_of_level_ground_is_stated_and_undone() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    set(&mut rig, "Height of level ground", 430.0);
    assert_eq!(
        count(
            &rig,
            "Ground: level at 430 m AMSL, no elevation model is open."
        ),
        1
    );
    choose(&mut rig, 1);
    let height = number(&rig, "/routes/0/way_points/0/altitude");
    frame(&mut rig, "AMSL");
    let amsl = number(&rig, "/routes/0/way_points/0/altitude");
    assert!((amsl - height - 430.0).abs() < 1e-6, "{height} {amsl}");
    rig.key_with(Modifiers::COMMAND, Key::Z);
    rig.key_with(Modifiers::COMMAND, Key::Z);
    rig.settle();
    assert_eq!(
        count(
            &rig,
            "Ground: level at 0 m AMSL, no elevation model is open."
        ),
        1
    );
}

#[test]
fn a_found_route_keeps_clear_of_high_ground_by_what_is_asked() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    open_heights(&mut rig);
    rig.open_tab("Plan");
    choose(&mut rig, 1);
    frame(&mut rig, "AMSL");
    let height = number(&rig, "/routes/0/way_points/0/altitude") - 400.0;
    rig.harness.key_press_modifiers(Modifiers::SHIFT, Key::F);
    rig.settle();
    click(&mut rig, 0.0, -300.0);
    click(&mut rig, 0.0, 300.0);
    rig.settle();
    let words = format!(
        "Flown at {:.0} m AMSL: ground over {:.0} m AMSL is avoided",
        height + 400.0,
        height + 340.0
    );
    assert_eq!(count(&rig, &words), 1, "{words}");
    rig.harness.get_by_label("Find the route").click();
    rig.settle();
    let around = number(&rig, "/find/shortest/length");
    assert!(around > 690.0, "{around}");
    assert_eq!(count(&rig, "Shortest"), 1);
    set(&mut rig, "Height over the ground, at least", 5.0);
    rig.harness.get_by_label("Find the route").click();
    rig.settle();
    let over = number(&rig, "/find/shortest/length");
    assert!((over - 600.0).abs() < 12.0, "{over}");
    assert_eq!(count(&rig, "Straight"), 1);
}

#[test]
fn a_route_turned_round_cut_or_followed_by_a_corridor_keeps_its_heights() {
    let mut rig = planning();
    open_heights(&mut rig);
    // From the ridge at 500 m to the ground at 400 m.
    draw(&mut rig, &[(0.0, 0.0), (110.0, 70.0), (60.0, 300.0)]);
    choose(&mut rig, 1);
    set(&mut rig, "Altitude of the way-point", 120.0);
    frame(&mut rig, "above take-off");
    rig.harness
        .get_by_label("This altitude for all way-points")
        .click_accesskit();
    rig.settle();
    let altitudes = |rig: &Rig, route: usize| {
        let state = rig.state();
        let way_points = state["plan"]["routes"][route]["way_points"].clone();
        let way_points = way_points.as_array().cloned().unwrap_or_default();
        let metres = way_points.iter().map(|w| w["altitude"].as_f64());
        metres
            .map(|it| it.expect("metres").round())
            .collect::<Vec<_>>()
    };
    assert_eq!(altitudes(&rig, 0), [120.0; 3]);
    rig.key(Key::X);
    assert_eq!(altitudes(&rig, 0), [220.0; 3], "take-off at 400 m");
    rig.key(Key::X);
    assert_eq!(altitudes(&rig, 0), [120.0; 3]);
    rig.key(Key::Delete);
    assert_eq!(altitudes(&rig, 0), [220.0; 2], "it begins at 400 m");
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(altitudes(&rig, 0), [120.0; 3]);
    rig.key_with(Modifiers::COMMAND, Key::K);
    let words = "fly a corridor along the route";
    rig.harness.event(egui::Event::Text(words.into()));
    rig.frames(2);
    rig.key(Key::Enter);
    rig.settle();
    // It begins beside the ridge, at 400 m.
    let corridor = altitudes(&rig, 1);
    assert_eq!(corridor, vec![220.0; corridor.len()]);
    assert!(corridor.len() >= 6, "{corridor:?}");
}
