//! Fences of plans.

use super::super::{Format, Places, read_any, write_places};
use super::frame;
use crate::mission::NoFlyZone;
use pilotage_base::frames::GroundPoint;

/// A plan with these fences.
fn plan(fences: &str) -> String {
    format!(
        r#"{{ "fileType": "Plan", "version": 1, "groundStation": "Q", "geoFence": {fences},
            "rallyPoints": {{ "points": [], "version": 2 }}, "mission": {{ "version": 2, "firmwareType": 12,
            "vehicleType": 2, "cruiseSpeed": 15, "hoverSpeed": 5, "plannedHomePosition": [47.4, 8.5, 412], "items": [
            {{ "type": "SimpleItem", "command": 16, "frame": 3, "params": [0, 0, 0, null, 47.41, 8.51, 60],
               "autoContinue": true, "doJumpId": 1 }} ] }} }}"#
    )
}

fn areas(fences: &str) -> (usize, Vec<String>) {
    let read = read_any("a.plan", plan(fences).as_bytes(), Some(frame())).unwrap();
    (read.no_fly.len(), read.notes)
}

const SQUARE: &str = r#"{ "inclusion": false, "polygon": [[47.4, 8.5], [47.4, 8.51], [47.41, 8.51]], "version": 1 }"#;

#[test]
fn an_odd_fence_is_counted_and_the_others_are_areas() {
    let circle = r#"{ "circle": { "center": [47.4, 8.5], "radius": 90 }, "inclusion": false }"#;
    let whole = |polygons: &str| {
        format!(
            "{{ \"circles\": [{circle}], \"polygons\": [{SQUARE}, {polygons}], \"version\": 2 }}"
        )
    };
    // Heights behind latitude and longitude are no matter of an area.
    let third = SQUARE.replace("8.5]", "8.5, 400]");
    assert_eq!(areas(&whole(&third)).0, 3);
    for odd in [
        r#"{ "polygon": [[47.4, 8.5], [47.4, 8.51], [47.41, 8.51]] }"#,
        r#"{ "inclusion": false, "polygon": [[47.4, null], [47.4, 8.51], [47.41, 8.51]] }"#,
        r#"{ "inclusion": false, "polygon": "none" }"#,
        "7",
    ] {
        let (count, notes) = areas(&whole(odd));
        assert_eq!(count, 2, "{odd}");
        let told = notes
            .iter()
            .any(|n| n.starts_with("1 × fence that is no area"));
        assert!(told, "{odd}: {notes:?}");
    }
    let (count, notes) = areas(&format!(
        "{{ \"circles\": {{}}, \"polygons\": [{SQUARE}], \"version\": 2 }}"
    ));
    assert_eq!(count, 1);
    assert!(notes.iter().any(|n| n.contains("fence that is no area")));
}

#[test]
fn holes_of_areas_are_told_where_they_become_fences_and_a_list_that_is_none_takes_them() {
    let square = |half: f64| {
        let corners = [(-half, -half), (-half, half), (half, half), (half, -half)];
        corners
            .map(|(north, east)| GroundPoint::new(north, east))
            .to_vec()
    };
    let read = |fences: &str| read_any("a.plan", plan(fences).as_bytes(), Some(frame())).unwrap();
    for fences in [
        "null",
        r#"{ "circles": [], "polygons": null, "version": 2 }"#,
        r#"{ "circles": [], "polygons": [], "version": 2 }"#,
    ] {
        let read = read(fences);
        let zone = NoFlyZone {
            name: "A".to_owned(),
            corners: square(200.0),
            holes: vec![square(50.0)],
            ..NoFlyZone::default()
        };
        let places = Places {
            routes: &read.routes,
            no_fly: std::slice::from_ref(&zone),
            ..Places::default()
        };
        let written = write_places(Format::Plan, &places, &read.frame).unwrap();
        let told = "1 × hole of a no-fly area is left out: fences have none";
        assert!(
            written.notes.iter().any(|n| n == told),
            "{:?}",
            written.notes
        );
        let again = read_any("a.plan", &written.bytes, Some(frame())).unwrap();
        assert_eq!(again.no_fly.len(), 1, "{fences}");
    }
}
