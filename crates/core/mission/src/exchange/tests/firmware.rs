//! Plans for PX4, which refuses heights above ground and circles that are counted.

use serde_json::{Value, json};

use super::super::{Format, read_any, write_route};
use super::{assert_noted, frame, route};
use crate::mission::{Route, WayPointAction};
use pilotage_base::frames::{Altitude, AltitudeFrame};

/// A plan for this autopilot with a way-point 50 m above ground, 560 m above the sea by its own terrain.
fn over_terrain(firmware: u8, command: u16) -> String {
    format!(
        r#"{{ "fileType": "Plan", "version": 1, "groundStation": "QGroundControl",
            "geoFence": {{ "circles": [], "polygons": [], "version": 2 }}, "rallyPoints": {{ "points": [], "version": 2 }},
            "mission": {{ "version": 2, "firmwareType": {firmware}, "vehicleType": 2, "cruiseSpeed": 15, "hoverSpeed": 5,
            "globalPlanAltitudeMode": 3, "plannedHomePosition": [47.4, 8.5, 412], "items": [
            {{ "type": "SimpleItem", "command": {command}, "frame": 0, "params": [2, 0, 50, null, 47.41, 8.51, 560],
               "autoContinue": true, "doJumpId": 1, "AMSLAltAboveTerrain": 560, "Altitude": 50, "AltitudeMode": 3 }} ] }} }}"#
    )
}

fn read(text: &str) -> Route {
    let mut read = read_any("a.plan", text.as_bytes(), Some(frame())).unwrap();
    read.routes.remove(0)
}

/// The mission that is written, its first way-point, and notes.
fn written(route: &Route) -> (Value, Value, Vec<String>) {
    let written = write_route(Format::Plan, route, &frame()).unwrap();
    let plan: Value = serde_json::from_slice(&written.bytes).unwrap();
    let mission = plan["mission"].clone();
    let item = mission["items"][0].clone();
    (mission, item, written.notes)
}

fn stated(item: &Value) -> Value {
    let height = &item["params"][6];
    json!([
        item["frame"],
        item["AltitudeMode"],
        item["Altitude"],
        item["AMSLAltAboveTerrain"],
        height
    ])
}

#[test]
fn a_height_over_terrain_comes_back_as_it_was_and_is_left_open_where_it_is_another() {
    for firmware in [12, 3] {
        let (mission, item, notes) = written(&read(&over_terrain(firmware, 16)));
        assert_eq!(stated(&item), json!([0, 3, 50.0, 560.0, 560.0]));
        assert_eq!(mission["globalPlanAltitudeMode"], 3);
        assert_eq!(mission["firmwareType"], firmware);
        assert_eq!(notes, Vec::<String>::new());
    }
    let change = |firmware: u8, how: fn(&mut Route)| {
        let mut route = read(&over_terrain(firmware, 16));
        assert_eq!(
            route.way_points[0].altitude,
            Altitude::new(50.0, AltitudeFrame::AboveGround)
        );
        how(&mut route);
        written(&route)
    };
    let moved = |route: &mut Route| route.way_points[0].position.north += 5.0;
    let higher = |route: &mut Route| route.way_points[0].altitude.metres = 70.0;
    let (_, item, notes) = change(12, moved);
    assert_eq!(stated(&item), json!([0, 3, 50.0, null, null]));
    assert_noted(&notes, |n| n.starts_with("1 × height above ground"));
    let (_, item, _) = change(12, higher);
    assert_eq!(stated(&item), json!([0, 3, 70.0, null, null]));
    // ArduPilot follows the ground itself.
    let (mission, item, notes) = change(3, higher);
    assert_eq!(stated(&item), json!([10, 4, 70.0, null, 70.0]));
    assert_eq!(mission["globalPlanAltitudeMode"], 4);
    assert_eq!(notes, Vec::<String>::new());
}

#[test]
fn heights_that_are_left_open_are_heights_above_ground_again() {
    let mut route = read(&over_terrain(12, 16));
    route.way_points[0].altitude.metres = 70.0;
    let written = write_route(Format::Plan, &route, &frame()).unwrap();
    let back = read_any("a.plan", &written.bytes, Some(frame())).unwrap();
    let altitude = back.routes[0].way_points[0].altitude;
    assert_eq!(altitude, Altitude::new(70.0, AltitudeFrame::AboveGround));
}

#[test]
fn a_route_that_px4_cannot_fly_is_a_plan_for_ardupilot() {
    let (mission, _, notes) = written(&route());
    assert_eq!(mission["firmwareType"], 3);
    assert_noted(&notes, |n| {
        n.contains("ArduPilot") && n.contains("height above ground, LOITER_TURNS")
    });
    let mut plain = route();
    plain.way_points[2].altitude.frame = AltitudeFrame::AboveTakeOff;
    let (mission, _, _) = written(&plain);
    assert_eq!(mission["firmwareType"], 3, "it circles still");
    plain.way_points[2].action = WayPointAction::FlyBy;
    let (mission, _, notes) = written(&plain);
    assert_eq!(mission["firmwareType"], 12);
    assert_noted(&notes, |n| n.contains("the plan says PX4"));
}

#[test]
fn way_point_files_of_a_plan_for_px4_tell_what_it_refuses() {
    let notes = |firmware: u8| {
        let route = read(&over_terrain(firmware, 18));
        let written = write_route(Format::Waypoints, &route, &frame()).unwrap();
        let mut notes = written.notes.into_iter();
        notes.find(|note| note.contains("refuses"))
    };
    let told = notes(12).unwrap();
    assert!(
        told.ends_with("refuses this: height above ground, LOITER_TURNS"),
        "{told}"
    );
    assert_eq!(notes(3), None);
}

#[test]
fn circles_in_a_plan_for_px4_are_told() {
    let (_, item, notes) = written(&read(&over_terrain(12, 18)));
    assert_eq!(item["command"], 18);
    let told = "PX4, for which the plan is, refuses this: LOITER_TURNS";
    assert_eq!(notes, [told]);
    let (_, _, notes) = written(&read(&over_terrain(3, 18)));
    assert_eq!(notes, Vec::<String>::new());
}
