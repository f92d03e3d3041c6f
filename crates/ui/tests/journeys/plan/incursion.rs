//! A route over a no-fly area is told wherever one looks, and not exported without a question.

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;

use super::{draw, draw_area, planning};
use crate::support::Rig;

/// A no-fly area about the origin, and a route.
fn over_an_area(rig: &mut Rig, route: [(f64, f64); 2]) {
    draw_area(rig);
    draw(rig, &route);
    rig.harness.get_by_label("Route").click();
    rig.settle();
}

fn export(rig: &mut Rig) {
    rig.key_with(Modifiers::COMMAND, Key::K);
    rig.harness
        .event(egui::Event::Text("export the route as gpx".into()));
    rig.frames(2);
    rig.key(Key::Enter);
    rig.settle();
}

#[test]
fn a_route_over_a_no_fly_area_is_told_in_the_tab_and_above_the_map_and_asked_about_before_an_export()
 {
    let mut rig = planning();
    over_an_area(&mut rig, [(0.0, -300.0), (0.0, 300.0)]);
    let warnings = rig.state()["plan"]["no_fly_warnings"].clone();
    let first = warnings[0].as_str().unwrap_or_default().to_owned();
    assert!(first.starts_with("Leg 1 crosses "), "{warnings}");
    assert!(first.ends_with("for 120 m."), "{warnings}");
    rig.harness.get_by_label(&first);
    rig.harness
        .get_by_label_contains("No-fly areas: 120 m over");
    let saved = rig.host().saved.len();
    export(&mut rig);
    assert_eq!(rig.host().saved.len(), saved, "it asks first");
    let toasts = rig.state()["toasts"].to_string();
    assert!(toasts.contains("Export again"), "{toasts}");
    rig.harness
        .get_by_label_contains("Export again to save the route as it is.");
    export(&mut rig);
    assert_eq!(rig.host().saved.len(), saved + 1);
}

#[test]
fn a_route_whose_corridor_alone_reaches_into_an_area_is_told_as_well_and_one_far_off_is_not() {
    let mut rig = planning();
    over_an_area(&mut rig, [(-130.0, 64.0), (150.0, 64.0)]);
    let warnings = rig.state()["plan"]["no_fly_warnings"].to_string();
    assert!(
        warnings.contains("The 95 % corridor reaches into"),
        "{warnings}"
    );
    assert!(!warnings.contains("crosses"), "{warnings}");
    rig.harness
        .get_by_label_contains("No-fly areas: corridor reaches");
    let mut rig = planning();
    over_an_area(&mut rig, [(-130.0, 380.0), (20.0, 380.0)]);
    assert_eq!(
        rig.state()["plan"]["no_fly_warnings"],
        serde_json::json!([])
    );
    rig.harness.get_by_label_contains("No-fly areas: clear");
}
