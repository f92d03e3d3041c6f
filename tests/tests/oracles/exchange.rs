//! Our files in the readers of pymavlink, fastkml and gpxpy.

use pilotage_core::exchange::{Format, Places, write_places, write_route};
use pilotage_core::frames::{
    Altitude, AltitudeFrame, Geodetic, GroundPoint, GroundRect, LocalFrame,
};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::{RallyPoint, Route, WayPoint, WayPointAction};
use pilotage_tests::oracle::ask;
use serde::{Deserialize, Serialize};

#[derive(Serialize)]
struct Files {
    waypoints: String,
    rally: String,
    kml: String,
    gpx: String,
}

#[derive(Deserialize)]
struct Read {
    waypoints: Vec<[f64; 12]>,
    rally: Vec<[f64; 12]>,
    kml: Vec<Placemark>,
    gpx: Gpx,
}

#[derive(Deserialize)]
struct Placemark {
    name: String,
    r#type: String,
    coordinates: Vec<Vec<f64>>,
}

#[derive(Deserialize)]
struct Gpx {
    routes: Vec<GpxRoute>,
    waypoints: Vec<(String, f64, f64)>,
}

#[derive(Deserialize)]
struct GpxRoute {
    name: String,
    points: Vec<(f64, f64, Option<f64>)>,
}

fn route() -> Route {
    let at = |north, east, metres, frame, speed, action| WayPoint {
        speed,
        action,
        ..WayPoint::new(GroundPoint::new(north, east), Altitude::new(metres, frame))
    };
    let loiter = WayPointAction::Loiter {
        radius: -80.0,
        turns: 2.5,
    };
    let wait = |seconds| WayPointAction::Wait {
        radius: -60.0,
        seconds,
    };
    Route {
        id: 1,
        returns: true,
        name: "Ärger & <Weg>".to_owned(),
        way_points: vec![
            at(
                0.0,
                0.0,
                50.0,
                AltitudeFrame::AboveTakeOff,
                None,
                WayPointAction::TakeOff,
            ),
            at(
                900.5,
                -321.25,
                110.5,
                AltitudeFrame::AboveGround,
                Some(18.5),
                WayPointAction::FlyBy,
            ),
            at(
                1500.0,
                700.0,
                640.0,
                AltitudeFrame::Amsl,
                Some(18.5),
                loiter,
            ),
            at(
                1400.0,
                200.0,
                90.0,
                AltitudeFrame::AboveTakeOff,
                None,
                wait(Some(45.0)),
            ),
            at(
                300.0,
                200.0,
                90.0,
                AltitudeFrame::AboveTakeOff,
                None,
                wait(None),
            ),
            at(
                10.0,
                20.0,
                0.0,
                AltitudeFrame::AboveTakeOff,
                None,
                WayPointAction::Land,
            ),
        ],
        ..Route::default()
    }
}

fn text(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).expect("what we write is UTF-8")
}

fn rally() -> [RallyPoint; 2] {
    [
        RallyPoint::new(1, GroundPoint::new(250.0, -75.0)),
        RallyPoint {
            altitude: Altitude::new(560.5, AltitudeFrame::Amsl),
            ..RallyPoint::new(2, GroundPoint::new(900.0, 640.0))
        },
    ]
}

/// Checks numbers, frames, commands, altitudes and parameters of the lines of way-points and of rally points.
fn check_commands(answer: &Read) {
    // Home, take-off, speed, way-point, circles, usual speed, two waits, landing, return.
    let numbers: Vec<[f64; 4]> = answer
        .waypoints
        .iter()
        .map(|w| [w[0], w[2], w[3], w[10]])
        .collect();
    assert_eq!(
        numbers,
        [
            [0.0, 0.0, 16.0, 0.0],
            [1.0, 3.0, 22.0, 50.0],
            [2.0, 2.0, 178.0, 0.0],
            [3.0, 10.0, 16.0, 110.5],
            [4.0, 0.0, 18.0, 640.0],
            [5.0, 2.0, 178.0, 0.0],
            [6.0, 3.0, 19.0, 90.0],
            [7.0, 3.0, 17.0, 90.0],
            [8.0, 3.0, 21.0, 0.0],
            [9.0, 2.0, 20.0, 0.0],
        ]
    );
    assert_eq!(answer.waypoints[2][5], 18.5);
    assert_eq!(answer.waypoints[4][4..8], [2.5, 0.0, -80.0, 0.0]);
    assert_eq!(answer.waypoints[6][4..8], [45.0, 0.0, -60.0, 0.0]);
    assert_eq!(answer.waypoints[7][4..8], [0.0, 0.0, -60.0, 0.0]);
    let numbers: Vec<[f64; 4]> = (answer.rally.iter())
        .map(|w| [w[0], w[2], w[3], w[10]])
        .collect();
    let wanted = [[0.0, 3.0, 5100.0, 100.0], [1.0, 0.0, 5100.0, 560.5]];
    assert_eq!(numbers, wanted);
}

#[test]
fn other_readers_find_our_routes_and_landmarks_where_we_put_them() {
    let frame = LocalFrame::new(Geodetic::from_degrees(46.84, -91.99, 200.0));
    let barn = Landmark::new(
        1,
        "barn \"1\"",
        GroundRect::centered(GroundPoint::new(200.0, 300.0), 20.0, 30.0),
    );
    let written = |format| {
        let places = Places {
            routes: &[route()],
            landmarks: std::slice::from_ref(&barn),
            ..Places::default()
        };
        write_places(format, &places, &frame).expect("the format holds both")
    };
    let waypoints = write_route(Format::Waypoints, &route(), &frame).expect("WPL holds a route");
    let rally = rally();
    let places = Places {
        rally: Some(&rally),
        ..Places::default()
    };
    let alone = write_places(Format::Waypoints, &places, &frame).expect("WPL holds rally points");
    let question = Files {
        waypoints: text(waypoints.bytes),
        rally: text(alone.bytes),
        kml: text(written(Format::Kml).bytes),
        gpx: text(written(Format::Gpx).bytes),
    };
    let Some(answer) = ask::<_, Read>("exchange_read.py", &question) else {
        return;
    };
    let near = |latitude: f64, longitude: f64, p: &GroundPoint| {
        // pymavlink keeps doubles; a hundred-millionth of a degree is a millimetre.
        let position = Geodetic::from_degrees(latitude, longitude, frame.origin.height);
        let found = frame.world_from_geodetic(&position);
        let distance = GroundPoint::new(found.x, found.y).distance(p);
        assert!(distance < 2e-3, "{distance} m from {p:?}");
    };

    check_commands(&answer);
    for (line, point) in answer.rally.iter().zip(&rally) {
        near(line[8], line[9], &point.position);
    }
    for (line, way_point) in [1, 3, 4, 6, 7, 8].into_iter().zip(&route().way_points) {
        let [.., latitude, longitude, _, _] = answer.waypoints[line];
        near(latitude, longitude, &way_point.position);
    }

    let kinds: Vec<_> = answer
        .kml
        .iter()
        .map(|p| (p.name.as_str(), p.r#type.as_str(), p.coordinates.len()))
        .collect();
    assert_eq!(
        kinds,
        [
            ("Ärger & <Weg>", "LineString", 6),
            ("barn \"1\"", "Polygon", 5)
        ]
    );
    for (place, way_point) in answer.kml[0].coordinates.iter().zip(&route().way_points) {
        near(place[1], place[0], &way_point.position);
    }
    let corner = GroundPoint::new(barn.bounds.south, barn.bounds.west);
    let first = &answer.kml[1].coordinates[0];
    near(first[1], first[0], &corner);

    let [only] = &answer.gpx.routes[..] else {
        panic!("{} routes", answer.gpx.routes.len());
    };
    assert_eq!(only.name, route().name);
    let elevations: Vec<_> = only.points.iter().map(|p| p.2).collect();
    assert_eq!(elevations, [None, None, Some(640.0), None, None, None]);
    for (place, way_point) in only.points.iter().zip(&route().way_points) {
        near(place.0, place.1, &way_point.position);
    }
    let (name, latitude, longitude) = &answer.gpx.waypoints[0];
    assert_eq!(name, "barn \"1\"");
    near(*latitude, *longitude, &barn.reference);
}
