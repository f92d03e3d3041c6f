//! Round trips, somebody else's GeoJSON, and broken files.

use proptest::prelude::*;

use super::*;
use crate::settings::{CameraAdjustment, NavigatorSettings, VehicleChoice};
use pilotage_base::frames::{Altitude, AltitudeFrame, Geodetic, GroundPoint, GroundRect};
use pilotage_raster::camera::CameraModel;
use pilotage_roads::{RoadClass, RoadLine};
use pilotage_vision::landmark::Landmark;
use pilotage_vision::registration::FollowSettings;

fn mission() -> Mission {
    let mut barn = Landmark::new(
        7,
        "barn \"north\"",
        GroundRect {
            south: -800.0,
            north: -760.25,
            west: 612.5,
            east: 650.0,
        },
    );
    barn.reference = GroundPoint::new(-779.0, 630.0);
    barn.height = 4.5;
    barn.enabled = false;
    barn.properties
        .insert("owner".to_owned(), r#"{ "a": [1.10, 1e3] }"#.to_owned());
    barn.properties
        .insert("feature:bbox".to_owned(), "[1,2, 3,4]".to_owned());
    Mission {
        name: "Two places".to_owned(),
        origin: Geodetic::from_degrees(45.0, -30.0, 120.0),
        map: Some(MapReference::Picture("ortho.jpg".to_owned())),
        routes: vec![route()],
        no_fly: vec![NoFlyZone {
            name: "airfield".to_owned(),
            corners: [(0.0, 0.0), (0.0, 400.0), (250.0, 350.0), (300.0, -20.0)]
                .map(|(n, e)| GroundPoint::new(n, e))
                .to_vec(),
            holes: vec![
                [(50.0, 50.0), (50.0, 90.0), (80.0, 60.0)]
                    .map(|(n, e)| GroundPoint::new(n, e))
                    .to_vec(),
            ],
            properties: [("floor_m".to_owned(), "120".to_owned())].into(),
        }],
        rally: vec![RallyPoint {
            altitude: Altitude::new(60.5, AltitudeFrame::AboveGround),
            properties: [("owner".to_owned(), "\"Ann\"".to_owned())].into(),
            ..RallyPoint::new(1, GroundPoint::new(-40.0, 75.5))
        }],
        roads: vec![RoadLine {
            name: "Mill \"old\" Lane".to_owned(),
            class: RoadClass::Tertiary,
            width: 6.25,
            course: [(10.0, -20.0), (310.5, -20.0), (500.0, 90.0)]
                .map(|(n, e)| GroundPoint::new(n, e))
                .to_vec(),
            properties: [("lanes".to_owned(), "2".to_owned())].into(),
        }]
        .into(),
        labels: vec![FrameLabels {
            flight: "Farm from 46.800000°, -92.000000°".to_owned(),
            frame: "00007.jpg".to_owned(),
            size: (640, 480),
            boxes: LabelBox::new(2, "pool", [[10.25, 20.0], [70.5, 90.125]], (640, 480))
                .into_iter()
                .collect(),
            absent: vec![1],
            ..FrameLabels::default()
        }],
        landmarks: vec![
            barn,
            Landmark::new(
                2,
                "pool",
                GroundRect::centered(GroundPoint::new(10.0, 20.0), 30.0, 40.0),
            ),
        ],
        camera: Some(CameraModel::pinhole(640, 480, 1.0)),
        camera_to_log: Some(CameraAdjustment {
            offset: -0.66,
            drift: 2e-5,
            middle: 61.5,
            roll: 0.01,
            pitch: -0.02,
            yaw: 0.07,
            log_focal: 0.03,
        }),
        navigator: NavigatorSettings {
            alpha: 0.1,
            vehicle: VehicleChoice::RandomWalk,
            ..NavigatorSettings::default()
        },
        properties: [
            ("crs".to_owned(), "{\"x\" : 1}".to_owned()),
            (
                OTHER_FEATURES.to_owned(),
                r#"[{"type":"Feature","geometry":{"type":"Point","coordinates":[1.50,2]},"properties":{"n":0.10}}]"#
                    .to_owned(),
            ),
        ]
        .into(),
    }
}

fn route() -> Route {
    let at =
        |north, frame| WayPoint::new(GroundPoint::new(north, 40.0), Altitude::new(120.5, frame));
    let mut loiter = at(300.0, AltitudeFrame::AboveGround);
    loiter.speed = Some(18.25);
    loiter.action = WayPointAction::Loiter {
        radius: -80.0,
        turns: 2.5,
    };
    loiter
        .properties
        .insert("hold".to_owned(), "[1,  2]".to_owned());
    Route {
        id: 3,
        name: "there \"and\" back".to_owned(),
        way_points: vec![
            WayPoint {
                action: WayPointAction::TakeOff,
                ..at(0.0, AltitudeFrame::AboveTakeOff)
            },
            loiter,
            WayPoint {
                action: WayPointAction::Wait {
                    radius: 90.0,
                    seconds: Some(45.5),
                },
                ..at(900.0, AltitudeFrame::Amsl)
            },
            WayPoint {
                action: WayPointAction::Wait {
                    radius: 0.0,
                    seconds: None,
                },
                ..at(950.0, AltitudeFrame::Amsl)
            },
        ],
        returns: true,
        properties: [
            ("colour".to_owned(), "\"red\"".to_owned()),
            ("feature:bbox".to_owned(), "[1,2, 3,4]".to_owned()),
        ]
        .into(),
    }
}

fn near(a: &GroundPoint, b: &GroundPoint) -> bool {
    a.distance(b) < 2e-5
}

#[test]
fn a_camera_beyond_reason_beside_its_log_is_refused() {
    let text = write_mission(&mission());
    let (before, after) = text.split_once("\"drift\":").unwrap();
    let rest = &after[after.find([',', '}']).unwrap()..];
    let text = format!("{before}\"drift\":-2{rest}");
    let refused = read_mission(text.as_bytes()).unwrap_err().to_string();
    assert!(refused.contains("camera_to_log"), "{refused}");
}

#[test]
fn a_mission_survives_its_file() {
    let (before, after) = (
        mission(),
        read_mission(write_mission(&mission()).as_bytes()).unwrap(),
    );
    assert_eq!(after.name, before.name);
    assert_eq!(after.map, before.map);
    assert_eq!(after.navigator, before.navigator);
    assert_eq!(after.camera, before.camera);
    assert_eq!(after.camera_to_log, before.camera_to_log);
    assert_eq!(after.properties, before.properties);
    assert_eq!(after.routes.len(), 1);
    let (a, b) = (&after.no_fly[0], &before.no_fly[0]);
    assert_eq!((&a.name, &a.properties), (&b.name, &b.properties));
    assert_eq!(a.corners.len(), 4);
    assert!(a.corners.iter().zip(&b.corners).all(|(a, b)| near(a, b)));
    let (a, b) = (&after.roads[0], &before.roads[0]);
    assert_eq!((&a.name, a.class, a.width), (&b.name, b.class, b.width));
    assert_eq!(a.properties, b.properties);
    assert_eq!(a.course.len(), 3);
    assert!(a.course.iter().zip(&b.course).all(|(a, b)| near(a, b)));
    let (a, b) = (&after.routes[0], &before.routes[0]);
    assert_eq!((a.id, &a.name), (b.id, &b.name));
    assert_eq!(a.properties, b.properties);
    assert_eq!(a.way_points.len(), b.way_points.len());
    for (a, b) in a.way_points.iter().zip(&b.way_points) {
        assert!(near(&a.position, &b.position));
        let position = b.position;
        assert_eq!(
            WayPoint {
                position,
                ..a.clone()
            },
            *b
        );
    }
    for (a, b) in after.landmarks.iter().zip(&before.landmarks) {
        assert_eq!((a.id, &a.name, a.enabled), (b.id, &b.name, b.enabled));
        assert_eq!((a.height, &a.properties), (b.height, &b.properties));
        assert!(near(&a.reference, &b.reference));
        let corner = |r: &GroundRect| GroundPoint::new(r.south, r.west);
        assert!(near(&corner(&a.bounds), &corner(&b.bounds)));
        assert!((a.bounds.width() - b.bounds.width()).abs() < 4e-5);
    }
}

#[test]
fn a_saved_file_is_saved_the_same_again() {
    let once = write_mission(&mission());
    let twice = write_mission(&read_mission(once.as_bytes()).unwrap());
    assert_eq!(once, twice);
}

#[test]
fn the_stated_height_of_the_ground_survives_the_file_and_the_origin_stays() {
    let mut stated = mission();
    assert_eq!(stated.level_ground().ground, 120.0);
    stated.state_ground(431.5);
    let after = read_mission(write_mission(&stated).as_bytes()).unwrap();
    assert_eq!(after.level_ground().ground, 431.5);
    assert_eq!(after.level_ground().take_off, 431.5);
    assert!((after.origin.height - 120.0).abs() < 1e-9);
}

#[test]
fn what_is_written_is_geojson() {
    let text = write_mission(&mission());
    let parsed: geojson::GeoJson = text.parse().unwrap();
    let geojson::GeoJson::FeatureCollection(collection) = parsed else {
        panic!("no collection");
    };
    assert_eq!(collection.features.len(), 7);
}

#[test]
fn a_route_that_is_still_being_drawn_is_saved_too() {
    for count in 0..3 {
        let mut mission = mission();
        mission.routes[0].way_points.truncate(count);
        let text = write_mission(&mission);
        assert!(text.parse::<geojson::GeoJson>().is_ok());
        let back = read_mission(text.as_bytes()).unwrap();
        assert_eq!(back.routes[0].way_points.len(), count);
        assert_eq!(write_mission(&back), text);
    }
}

#[test]
fn way_points_that_state_nothing_are_flown_by_at_the_usual_altitude() {
    let text = r#"{ "type": "FeatureCollection", "features": [
        { "type": "Feature", "properties": { "pilotage": "route" },
          "geometry": { "type": "LineString", "coordinates": [[10, 45], [10.001, 45]] } } ] }"#;
    let mission = read_mission(text.as_bytes()).unwrap();
    let route = &mission.routes[0];
    assert_eq!((route.id, route.name.as_str()), (1, "Route 1"));
    assert_eq!(route.way_points[1].altitude, USUAL_ALTITUDE);
    assert!((route.length() - 78.8).abs() < 0.1, "{}", route.length());
    assert_eq!(mission.properties.get(OTHER_FEATURES), None);
}

#[test]
fn a_way_point_in_words_that_we_do_not_know_is_told_with_its_line() {
    let text = write_mission(&mission());
    let line = |word: &str| 1 + text[..text.find(word).unwrap()].matches('\n').count();
    for (word, other) in [("\"loiter\"", "\"dance\""), ("\"amsl\"", "\"high\"")] {
        let error = read_mission(text.replacen(word, other, 1).as_bytes()).unwrap_err();
        let error = error.to_string();
        assert!(
            error.starts_with(&format!("line {},", line(word))),
            "{error}"
        );
        assert!(error.contains(&other.replace('"', "`")), "{error}");
    }
}

#[test]
fn polygons_of_somebody_else_are_landmarks_around_their_middle() {
    let text = r#"{ "type": "FeatureCollection", "features": [
        { "type": "Feature", "id": "x", "properties": null, "geometry": { "type": "Polygon",
          "coordinates": [[[10.0, 45.0], [10.001, 45.0], [10.001, 45.001], [10.0, 45.001], [10.0, 45.0]]] } },
        { "type": "Feature", "properties": { "name": "road" },
          "geometry": { "type": "LineString", "coordinates": [[0, 0], [1, 1]] } } ] }"#;
    let mission = read_mission(text.as_bytes()).unwrap();
    assert_eq!(mission.landmarks.len(), 1);
    let landmark = &mission.landmarks[0];
    assert_eq!(landmark.name, "Landmark 1");
    assert!((landmark.bounds.height() - 111.13).abs() < 0.1);
    assert_eq!(landmark.properties["feature:id"], "\"x\"");
    assert!(mission.properties[OTHER_FEATURES].contains("LineString"));
}

#[test]
fn what_is_wrong_is_told_with_its_line() {
    let told = |text: &str| read_mission(text.as_bytes()).unwrap_err().to_string();
    assert!(told("{\n \"type\": Feature").starts_with("line 2, column 10"));
    assert!(told("{}").contains("not a GeoJSON FeatureCollection"));
    assert!(told("[1]").starts_with("line 1"));
    let text = write_mission(&mission());
    let broken = text.replacen("\"enabled\": true", "\"enabled\": \"yes\"", 1);
    let line = 1 + text[..text.find("\"enabled\": true").unwrap()]
        .matches('\n')
        .count();
    let message = told(&broken);
    assert!(message.starts_with(&format!("line {line}, ")), "{message}");
    assert!(message.contains("expected a boolean"), "{message}");
    let later = text.replacen("\"pilotage_mission\": 1", "\"pilotage_mission\": 2", 1);
    assert!(told(&later).contains("version 2"));
    let far = text.replacen("\"latitude_deg\":45", "\"latitude_deg\":95", 1);
    assert!(told(&far).contains("is not a latitude"), "{}", told(&far));
}

proptest! {
    #[test]
    fn broken_missions_are_refused_or_read_but_never_panic(
        cut in 0.0_f64..1.0,
        flips in proptest::collection::vec((0.0_f64..1.0, any::<u8>()), 0..6),
        truncate in any::<bool>(),
    ) {
        let mut bytes = write_mission(&mission()).into_bytes();
        for (place, value) in flips {
            let at = (place * bytes.len() as f64) as usize;
            bytes[at] = value;
        }
        if truncate {
            bytes.truncate((cut * bytes.len() as f64) as usize);
        }
        if let Ok(mission) = read_mission(&bytes) {
            let _ = write_mission(&mission);
        }
    }

    #[test]
    fn a_landmark_anywhere_near_the_origin_comes_back_to_a_tenth_of_a_millimetre(
        north in -3000.0_f64..3000.0,
        east in -3000.0_f64..3000.0,
        latitude in -80.0_f64..80.0,
    ) {
        let frame = pilotage_base::frames::LocalFrame::new(Geodetic::from_degrees(latitude, 11.0, 50.0));
        let p = GroundPoint::new(north, east);
        let (longitude, latitude) = globe::lon_lat(&frame, &p);
        prop_assert!(globe::ground(&frame, longitude, latitude).distance(&p) < 1e-4);
    }
}

#[test]
fn whole_frames_of_a_mission_are_the_usual_ones_but_for_what_is_stated() {
    let text = r#"{"type": "FeatureCollection", "pilotage_mission": 1, "features": [],
        "navigator": {"vehicle": "ConstantVelocity", "whole_frames": {"farthest": 500.0}}}"#;
    let read = read_mission(text.as_bytes()).unwrap();
    let usual = FollowSettings::default();
    let expected = FollowSettings {
        farthest: Some(500.0),
        ..usual
    };
    assert_eq!(read.navigator.whole_frames, Some(expected));
}

#[test]
fn labels_of_files_that_name_no_flight_are_read_and_of_any() {
    let text = r#"{"type": "FeatureCollection", "pilotage_mission": 1, "features": [],
        "labels": [{"frame": "00007.jpg", "size": [640, 480], "boxes": [], "absent": [1]}]}"#;
    let read = read_mission(text.as_bytes()).unwrap();
    assert_eq!(read.label_counts("Route from 0.0 m, 0.0 m", 1), (0, 1));
}
