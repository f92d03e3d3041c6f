//! Our files in the readers of pymavlink, fastkml and gpxpy.

use pilotage_core::exchange::{Format, Places, write_places, write_route};
use pilotage_core::frames::{
    Altitude, AltitudeFrame, Geodetic, GroundPoint, GroundRect, LocalFrame,
};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::{Route, WayPoint, WayPointAction};
use pilotage_tests::oracle::ask;
use serde::{Deserialize, Serialize};

#[derive(Serialize)]
struct Files {
    waypoints: String,
    kml: String,
    gpx: String,
}

#[derive(Deserialize)]
struct Read {
    waypoints: Vec<[f64; 12]>,
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
    Route {
        id: 1,
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
    let question = Files {
        waypoints: text(waypoints.bytes),
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

    // Home, take-off, speed, way-point, loiter, usual speed, landing.
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
            [6.0, 3.0, 21.0, 0.0],
        ]
    );
    assert_eq!(answer.waypoints[2][5], 18.5);
    assert_eq!(answer.waypoints[4][4..8], [2.5, 0.0, -80.0, 0.0]);
    for (line, way_point) in [1, 3, 4, 6].into_iter().zip(&route().way_points) {
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
            ("Ärger & <Weg>", "LineString", 4),
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
    assert_eq!(elevations, [None, None, Some(640.0), None]);
    for (place, way_point) in only.points.iter().zip(&route().way_points) {
        near(place.0, place.1, &way_point.position);
    }
    let (name, latitude, longitude) = &answer.gpx.waypoints[0];
    assert_eq!(name, "barn \"1\"");
    near(*latitude, *longitude, &barn.reference);
}
