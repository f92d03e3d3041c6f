//! Rally points through the formats that have them.

use super::super::{Format, Imported, Places, read_any, write_places, write_route};
use super::{assert_noted, frame, route};
use crate::mission::RallyPoint;
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint};
use serde_json::{Value, json};

fn points() -> [RallyPoint; 2] {
    let field = RallyPoint {
        name: "field & <wood>".to_owned(),
        altitude: Altitude::new(75.5, AltitudeFrame::AboveTakeOff),
        ..RallyPoint::new(1, GroundPoint::new(-250.5, 900.25))
    };
    [field, RallyPoint::new(2, GroundPoint::new(1200.0, -40.0))]
}

fn written(format: Format, rally: &[RallyPoint]) -> (Vec<u8>, Vec<String>) {
    let places = Places {
        routes: &[route()],
        rally: Some(rally),
        ..Places::default()
    };
    let file = write_places(format, &places, &frame()).unwrap();
    (file.bytes, file.notes)
}

#[test]
fn rally_points_come_back_from_every_format_that_has_them_and_are_told_in_others() {
    for format in [
        Format::Plan,
        Format::GeoJson,
        Format::Kml,
        Format::Kmz,
        Format::Gpx,
    ] {
        let (bytes, _) = written(format, &points());
        let back = read_any("x", &bytes, Some(frame())).unwrap();
        let counts = (back.routes.len(), back.landmarks.len(), back.rally.len());
        assert_eq!(counts, (1, 0, 2), "{}", format.name());
        for (after, before) in back.rally.iter().zip(&points()) {
            assert!(after.position.distance(&before.position) < 1e-3);
            assert_eq!(after.altitude, before.altitude);
            if format != Format::Plan {
                assert_eq!(after.name, before.name);
                assert!(after.properties.is_empty(), "{:?}", after.properties);
            }
        }
    }
    for format in [Format::Csv, Format::Waypoints] {
        let notes = written(format, &points()).1;
        assert_noted(&notes, |n| n.starts_with("2 × rally point is left out"));
    }
}

/// A file of rally points as pymavlink saves one.
const LINES: &str = "QGC WPL 110\n\
    0\t0\t3\t5100\t0\t40\t180\t1\t47.001\t8.002\t50\t1\n\
    1\t0\t0\t5100\t0\t0\t0\t0\t47.003\t8\t560\t0\n";

fn alone(read: &Imported) -> String {
    let places = Places {
        rally: Some(&read.rally),
        ..Places::default()
    };
    let file = write_places(Format::Waypoints, &places, &read.frame).unwrap();
    String::from_utf8(file.bytes).unwrap()
}

#[test]
fn a_way_point_file_of_rally_points_has_no_route_and_every_line_comes_back() {
    let read = read_any("rally.waypoints", LINES.as_bytes(), None).unwrap();
    assert_eq!((read.routes.len(), read.rally.len()), (0, 2));
    let altitudes: Vec<_> = read.rally.iter().map(|point| point.altitude).collect();
    assert_eq!(
        altitudes,
        [
            Altitude::new(50.0, AltitudeFrame::AboveTakeOff),
            Altitude::new(560.0, AltitudeFrame::Amsl)
        ]
    );
    assert_eq!(read.rally[1].name, "Rally 2");
    assert_eq!(alone(&read), LINES);
}

#[test]
fn a_rally_point_that_is_moved_keeps_the_rest_of_its_line() {
    let mut read = read_any("rally.waypoints", LINES.as_bytes(), None).unwrap();
    read.rally[0].altitude.metres = 65.0;
    let text = alone(&read);
    assert!(
        text.contains("5100\t0\t40\t180\t1\t47.001\t8.002\t65\t1"),
        "{text}"
    );
}

#[test]
fn rally_points_among_the_lines_of_a_mission_stay_there_until_the_mission_has_them_no_more() {
    let text = "QGC WPL 110\n0\t1\t0\t16\t0\t0\t0\t0\t47\t8\t430\t1\n\
        1\t0\t3\t16\t0\t0\t0\t0\t47.001\t8\t50\t1\n\
        2\t0\t3\t5100\t0\t40\t0\t0\t47.001\t8.002\t50\t1\n";
    let mut read = read_any("a.waypoints", text.as_bytes(), None).unwrap();
    assert_eq!((read.routes.len(), read.rally.len()), (1, 1));
    let lines = |read: &Imported| {
        let places = Places {
            routes: &read.routes,
            rally: Some(&read.rally),
            ..Places::default()
        };
        let file = write_places(Format::Waypoints, &places, &read.frame).unwrap();
        (String::from_utf8(file.bytes).unwrap(), file.notes)
    };
    assert_eq!(lines(&read), (text.to_owned(), Vec::new()));
    let plain = write_route(Format::Waypoints, &read.routes[0], &read.frame).unwrap();
    assert_eq!(String::from_utf8(plain.bytes).unwrap(), text);
    read.rally.clear();
    assert!(!lines(&read).0.contains("5100"));
}

#[test]
fn a_plan_keeps_the_rally_points_that_the_mission_still_has_and_gets_the_others() {
    let (bytes, _) = written(Format::Plan, &[]);
    let mut plan: Value = serde_json::from_slice(&bytes).unwrap();
    let own = json!({ "version": 2, "points": [[47.401, 8.502, 30], [47.403, 8.5, 45.5]], "x": 1 });
    plan["rallyPoints"] = own.clone();
    let mut read = read_any("a.plan", plan.to_string().as_bytes(), Some(frame())).unwrap();
    let again = |read: &Imported| -> Value {
        let places = Places {
            routes: &read.routes,
            rally: Some(&read.rally),
            ..Places::default()
        };
        let file = write_places(Format::Plan, &places, &frame()).unwrap();
        serde_json::from_slice::<Value>(&file.bytes).unwrap()["rallyPoints"].clone()
    };
    assert_eq!(again(&read), own);
    read.rally.remove(0);
    read.rally.push(points()[0].clone());
    let after = again(&read);
    let list = after["points"].as_array().unwrap();
    assert_eq!((list.len(), &after["x"]), (2, &json!(1)));
    assert_eq!(list[0], own["points"][1]);
    assert_eq!(list[1][2], 75.5);
}

#[test]
fn altitudes_of_rally_points_in_a_plan_count_from_home() {
    let mut above_sea = points()[0].clone();
    above_sea.altitude = Altitude::new(500.0, AltitudeFrame::Amsl);
    let mut route = route();
    let heights = |route: &crate::mission::Route| {
        let places = Places {
            routes: std::slice::from_ref(route),
            rally: Some(std::slice::from_ref(&above_sea)),
            ..Places::default()
        };
        let file = write_places(Format::Plan, &places, &frame()).unwrap();
        let plan: Value = serde_json::from_slice(&file.bytes).unwrap();
        (plan["rallyPoints"]["points"][0][2].as_f64(), file.notes)
    };
    let (height, notes) = heights(&route);
    assert_eq!(height, Some(500.0));
    assert_noted(&notes, |n| n.contains("as if it counted from take-off"));
    let home = "[47.4, 8.5, 430.0]".to_owned();
    route.properties.insert("home".to_owned(), home);
    assert_eq!(heights(&route).0, Some(70.0));
}
