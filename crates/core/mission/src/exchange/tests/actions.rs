//! Take-off, circles, waiting, landing and return as formats of others have them.

use super::super::{Format, Imported, read_any, write_route};
use super::{assert_noted, frame};
use crate::mission::{Route, WayPoint, WayPointAction};
use pilotage_base::files::{FileSet, ZipFiles};
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint};

fn wait(radius: f64, seconds: Option<f64>) -> WayPointAction {
    WayPointAction::Wait { radius, seconds }
}

fn read(lines: &[&str]) -> (Imported, String) {
    let text = format!("QGC WPL 110\n{}\n", lines.join("\n").replace(' ', "\t"));
    let imported = read_any("a.waypoints", text.as_bytes(), None).unwrap();
    (imported, text)
}

fn written(imported: &Imported) -> String {
    let route = &imported.routes[0];
    let written = write_route(Format::Waypoints, route, &imported.frame).unwrap();
    String::from_utf8(written.bytes).unwrap()
}

/// Number of the command and the first four parameters in each line.
fn commands(text: &str) -> Vec<[f64; 5]> {
    let line = |line: &str| -> [f64; 5] {
        let fields: Vec<f64> = line.split('\t').map(|f| f.parse().unwrap()).collect();
        [3, 4, 5, 6, 7].map(|i| fields[i])
    };
    text.lines().skip(1).map(line).collect()
}

const LINES: [&str; 9] = [
    "0 1 0 16 0 0 0 0 47 8 430 1",
    "1 0 3 84 15 1 0 0 47 8 30 1",
    "2 0 3 16 12 2 0 0 47.001 8 50 1",
    "3 0 3 19 30 1 -60 1 47.002 8 50 1",
    "4 0 3 18 2.5 1 80 1 47.003 8 50 1",
    "5 0 3 17 0 0 -90 5 47.003 8.001 50 1",
    "6 0 3 16 0 2 0 0 47.004 8 50 1",
    "7 0 3 85 0 0 25 0 47.001 8 0 1",
    "8 0 0 20 0 0 0 0 0 0 0 0",
];

#[test]
fn commands_of_a_ground_station_are_actions_and_every_line_comes_back() {
    let (imported, text) = read(&LINES);
    let route = &imported.routes[0];
    let actions: Vec<_> = route.way_points.iter().map(|w| w.action).collect();
    let loiter = WayPointAction::Loiter {
        radius: 80.0,
        turns: 2.5,
    };
    let wanted = [
        WayPointAction::TakeOff,
        wait(0.0, Some(12.0)),
        wait(-60.0, Some(30.0)),
        loiter,
        wait(-90.0, None),
        WayPointAction::FlyBy,
        WayPointAction::Land,
    ];
    assert_eq!(actions, wanted);
    assert!(route.returns);
    assert_eq!(written(&imported), text);
}

#[test]
fn what_is_changed_of_an_action_is_written_and_the_rest_of_its_command_stays() {
    let (mut imported, _) = read(&LINES);
    let way_points = &mut imported.routes[0].way_points;
    way_points[1].action = wait(0.0, Some(20.0));
    way_points[2].action = wait(50.0, Some(5.0));
    way_points[4].action = wait(40.0, Some(7.0));
    way_points[5].action = wait(0.0, None);
    way_points[6].action = WayPointAction::FlyBy;
    imported.routes[0].returns = false;
    let after = commands(&written(&imported));
    assert_eq!(after.len(), 8, "the return is gone: {after:?}");
    assert_eq!(after[2], [16.0, 20.0, 2.0, 0.0, 0.0]);
    assert_eq!(after[3], [19.0, 5.0, 1.0, 50.0, 1.0]);
    assert_eq!(after[5], [19.0, 7.0, 0.0, 40.0, 0.0]);
    assert_eq!(after[6], [17.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(after[7][0], 16.0);
    imported.routes[0].way_points[1].action = wait(30.0, Some(20.0));
    let after = commands(&written(&imported));
    assert_eq!(after[2], [19.0, 20.0, 0.0, 30.0, 0.0]);
}

#[test]
fn a_return_is_the_end_of_the_route_whatever_way_points_are_added() {
    let (mut imported, _) = read(&[&LINES[..3], &["3 0 0 20 0 0 0 0 0 0 0 1"]].concat());
    assert!(imported.routes[0].returns);
    let mut last = imported.routes[0].way_points[1].clone();
    last.position.north += 200.0;
    imported.routes[0].way_points.push(last);
    let after = commands(&written(&imported));
    assert_eq!(
        after.iter().map(|c| c[0]).collect::<Vec<_>>(),
        [16.0, 84.0, 16.0, 16.0, 20.0]
    );
}

#[test]
fn a_return_before_the_end_stays_where_it_is_and_is_told() {
    let (imported, text) = read(&[
        "0 1 0 16 0 0 0 0 47 8 430 1",
        "1 0 3 16 0 0 0 0 47.001 8 50 1",
        "2 0 0 20 0 0 0 0 0 0 0 1",
        "3 0 3 16 0 0 0 0 47.002 8 50 1",
    ]);
    assert!(!imported.routes[0].returns);
    assert_noted(&imported.notes, |n| {
        n.contains("return to launch before the end")
    });
    assert_eq!(written(&imported), text);
}

/// A route that waits for ten seconds at its first way-point.
fn waiting() -> Route {
    let at = |north, action| WayPoint {
        action,
        ..WayPoint::new(
            GroundPoint::new(north, 0.0),
            Altitude::new(60.0, AltitudeFrame::AboveTakeOff),
        )
    };
    Route {
        way_points: vec![
            at(0.0, wait(0.0, Some(10.0))),
            at(200.0, WayPointAction::FlyBy),
        ],
        returns: true,
        ..Route::default()
    }
}

fn back(format: Format, route: &Route) -> (Route, String) {
    let file = write_route(format, route, &frame()).unwrap();
    let name = format!("a.{}", format.extensions()[0]);
    let mut read = read_any(&name, &file.bytes, Some(frame())).unwrap();
    assert_eq!(read.routes.len(), 1);
    let text = match ZipFiles::open(&file.bytes) {
        Ok(zip) => String::from_utf8(zip.read("wpmz/waylines.wpml").unwrap()).unwrap(),
        Err(_) => String::from_utf8(file.bytes).unwrap(),
    };
    (read.routes.remove(0), text)
}

#[test]
fn dji_and_litchi_hover_where_the_route_waits_and_no_longer_once_it_does_not() {
    for (format, hovers) in [
        (Format::Wpml, "hoverTime>10<"),
        (Format::Litchi, ",0,10000,"),
    ] {
        let (mut route, text) = back(format, &waiting());
        assert!(text.contains(hovers), "{text}");
        assert_eq!(route.way_points[0].action, wait(0.0, Some(10.0)));
        assert_eq!(route.way_points[1].action, WayPointAction::FlyBy);
        assert_eq!(back(format, &route).1, text);
        route.way_points[0].action = wait(0.0, Some(4.5));
        let (mut changed, _) = back(format, &route);
        assert_eq!(changed.way_points[0].action, wait(0.0, Some(4.5)));
        changed.way_points[0].action = WayPointAction::FlyBy;
        assert_eq!(
            back(format, &changed).0.way_points[0].action,
            WayPointAction::FlyBy
        );
    }
}

#[test]
fn dji_returns_where_the_route_does_and_stays_where_somebody_says_so() {
    let (mut route, text) = back(Format::Wpml, &waiting());
    assert!(route.returns && text.contains("finishAction>goHome<"));
    route.returns = false;
    let (mut route, text) = back(Format::Wpml, &route);
    assert!(
        !route.returns && text.contains("finishAction>noAction<"),
        "{text}"
    );
    route.returns = true;
    let (route, text) = back(Format::Wpml, &route);
    assert!(
        route.returns && text.contains("finishAction>goHome<"),
        "{text}"
    );
}

#[test]
fn formats_without_actions_say_what_others_do_not_see() {
    for (format, words) in [
        (Format::Kml, "neither take-off, circles"),
        (Format::Gpx, "neither take-off, circles"),
        (Format::Csv, "return at the end is left out"),
        (Format::Litchi, "return at the end is left out"),
    ] {
        let file = write_route(format, &waiting(), &frame()).unwrap();
        assert_noted(&file.notes, |n| n.contains(words));
    }
    let mut endless = waiting();
    endless.way_points[0].action = wait(50.0, None);
    let file = write_route(Format::Wpml, &endless, &frame()).unwrap();
    assert_noted(&file.notes, |n| n.contains("waiting without an end"));
}
