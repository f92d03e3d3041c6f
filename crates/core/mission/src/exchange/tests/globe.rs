//! Places anywhere on the globe through every format, holes of polygons, and moments without a place.

use proptest::prelude::*;

use super::super::{Format, Places, read_any, write_landmarks, write_places, write_route};
use super::assert_noted;
use crate::mission::NoFlyZone;
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint};

fn csv(places: &[(f64, f64)]) -> String {
    let rows: Vec<String> = places
        .iter()
        .map(|(latitude, longitude)| format!("r,{latitude},{longitude},50\n"))
        .collect();
    format!("route,latitude,longitude,altitude\n{}", rows.concat())
}

/// Degrees of longitude from one to the other, the short way.
fn apart(a: f64, b: f64) -> f64 {
    let d = (a - b).rem_euclid(360.0);
    d.min(360.0 - d)
}

/// Latitude and longitude of the way-points of a table that we wrote.
fn places(text: &str) -> Vec<(f64, f64)> {
    let cells = |l: &str| l.split(',').map(str::to_owned).collect::<Vec<_>>();
    let rows = text.lines().skip(1).map(cells);
    rows.map(|c| (c[1].parse().unwrap(), c[2].parse().unwrap()))
        .collect()
}

proptest! {
    #[test]
    fn places_anywhere_come_back_through_every_format_to_a_millimetre_or_are_refused(
        first in (-89.9_f64..89.9, -180.0_f64..180.0),
        off in (-60.0_f64..60.0, -90.0_f64..90.0),
        scale in prop_oneof![Just(1e-4), Just(1e-2), Just(1.0)],
    ) {
        let second = ((first.0 + scale * off.0).clamp(-89.9, 89.9), first.1 + scale * off.1);
        let asked = [first, second];
        let Ok(imported) = read_any("a.csv", csv(&asked).as_bytes(), None) else {
            // Only what is far apart may be refused.
            prop_assert!(scale == 1.0, "{asked:?}");
            return Ok(());
        };
        for format in Format::told_by_extension() {
            let file = write_route(format, &imported.routes[0], &imported.frame).unwrap();
            let back = read_any("x", &file.bytes, None).unwrap();
            let table = write_route(Format::Csv, &back.routes[0], &back.frame).unwrap();
            let found = places(&String::from_utf8(table.bytes).unwrap());
            for (found, asked) in found.iter().zip(asked) {
                let north = (found.0 - asked.0) * 111_700.0;
                let east = apart(found.1, asked.1) * 111_400.0 * asked.0.to_radians().cos();
                prop_assert!(north.hypot(east) < 1e-3, "{}: {found:?} {asked:?}", format.name());
            }
        }
    }
}

#[test]
fn a_route_over_the_date_line_stays_there() {
    let text = csv(&[(-17.0, 179.999), (-17.001, -179.999)]);
    let imported = read_any("a.csv", text.as_bytes(), None).unwrap();
    let origin = imported.frame.origin;
    assert!((origin.latitude.to_degrees() + 17.0005).abs() < 1e-4);
    assert!(apart(origin.longitude.to_degrees(), 180.0) < 1e-6);
    assert!((imported.routes[0].length() - 240.0).abs() < 2.0);
}

#[test]
fn places_around_the_whole_globe_are_refused_by_name() {
    for places in [[(0.0, 0.0), (0.0, 180.0)], [(70.9, -178.7), (-89.0, 0.0)]] {
        let error = read_any("a.csv", csv(&places).as_bytes(), None).unwrap_err();
        let error = error.to_string();
        assert!(error.starts_with("a.csv: its places lie"), "{error}");
    }
}

const RING: &str = r#"<kml xmlns="http://www.opengis.net/kml/2.2"><Document><Placemark><name>ring</name><Polygon>
 <outerBoundaryIs><LinearRing><coordinates>8,47 8.01,47 8.01,47.01 8,47.01 8,47</coordinates></LinearRing></outerBoundaryIs>
 <innerBoundaryIs><LinearRing><coordinates>8.004,47.004 8.006,47.004 8.006,47.006 8.004,47.004</coordinates></LinearRing></innerBoundaryIs>
 <innerBoundaryIs><LinearRing><coordinates>8.001,47.001 8.002,47.001 8.002,47.002 8.001,47.001</coordinates></LinearRing></innerBoundaryIs>
</Polygon></Placemark></Document></kml>"#;

#[test]
fn holes_of_a_polygon_come_back_from_every_format_that_has_areas() {
    let read = read_any("a.kml", RING.as_bytes(), None).unwrap();
    let before = read.landmarks[0].holes();
    assert_eq!(before.iter().map(Vec::len).collect::<Vec<_>>(), [3, 3]);
    for format in [Format::GeoJson, Format::Kml, Format::Kmz, Format::Csv] {
        let file = write_landmarks(format, &read.landmarks, &read.frame).unwrap();
        let back = read_any("x", &file.bytes, Some(read.frame)).unwrap();
        let after = back.landmarks[0].holes();
        assert_eq!(after.len(), 2, "{}", format.name());
        for (a, b) in after.iter().flatten().zip(before.iter().flatten()) {
            assert!(a.distance(b) < 1e-3, "{}", format.name());
        }
    }
}

#[test]
fn a_moment_of_a_track_without_a_place_is_left_out_and_told() {
    let text = "<kml xmlns:gx=\"g\"><Placemark><gx:Track><gx:coord/><gx:coord>8 47 400</gx:coord>\
                <gx:coord></gx:coord><gx:coord>8.001 47 401</gx:coord></gx:Track></Placemark></kml>";
    let back = read_any("a.kml", text.as_bytes(), None).unwrap();
    assert_eq!(back.routes[0].way_points.len(), 2);
    assert_noted(&back.notes, |n| n.starts_with("2 × moment"));
}

#[test]
fn the_tracks_of_a_multi_track_count_from_what_it_says() {
    let track = |own: &str| {
        format!(
            "<gx:Track>{own}<gx:coord>8 47 400</gx:coord><gx:coord>8.001 47 401</gx:coord></gx:Track>"
        )
    };
    let text = format!(
        "<kml xmlns:gx=\"g\"><Placemark><gx:MultiTrack><altitudeMode>absolute</altitudeMode>{}{}</gx:MultiTrack>\
         </Placemark></kml>",
        track(""),
        track("<altitudeMode>relativeToGround</altitudeMode>")
    );
    let back = read_any("a.kml", text.as_bytes(), None).unwrap();
    let frames: Vec<_> = back
        .routes
        .iter()
        .map(|route| route.way_points[1].altitude)
        .collect();
    let at = |frame| Altitude::new(401.0, frame);
    assert_eq!(
        frames,
        [at(AltitudeFrame::Amsl), at(AltitudeFrame::AboveGround)]
    );
}

#[test]
fn no_fly_areas_come_back_as_such_with_their_holes() {
    let mut read = read_any("a.kml", RING.as_bytes(), None).unwrap();
    let ring = |places: &[(f64, f64)]| -> Vec<GroundPoint> {
        places
            .iter()
            .map(|(n, e)| GroundPoint::new(*n, *e))
            .collect()
    };
    read.landmarks.clear();
    let zone = NoFlyZone {
        name: "air base & town".to_owned(),
        corners: ring(&[(0.0, 0.0), (900.0, 0.0), (900.0, 700.0), (0.0, 650.0)]),
        holes: vec![ring(&[(100.0, 100.0), (200.0, 100.0), (200.0, 180.0)])],
        properties: [("owner".to_owned(), "\"Ann\"".to_owned())].into(),
    };
    for format in [Format::GeoJson, Format::Kml, Format::Kmz] {
        let places = Places {
            no_fly: std::slice::from_ref(&zone),
            ..Places::default()
        };
        let file = write_places(format, &places, &read.frame).unwrap();
        assert_eq!(file.notes, Vec::<String>::new());
        let back = read_any("x", &file.bytes, Some(read.frame)).unwrap();
        let counts = (back.routes.len(), back.landmarks.len(), back.no_fly.len());
        assert_eq!(counts, (0, 0, 1), "{}", format.name());
        let after = &back.no_fly[0];
        assert_eq!(
            (&after.name, &after.properties),
            (&zone.name, &zone.properties)
        );
        let rings = |zone: &NoFlyZone| [&[zone.corners.clone()][..], &zone.holes].concat();
        assert_eq!(after.holes.len(), 1);
        for (a, b) in rings(after).iter().zip(&rings(&zone)) {
            assert_eq!(a.len(), b.len(), "{}", format.name());
            assert!(a.iter().zip(b).all(|(a, b)| a.distance(b) < 1e-3));
        }
    }
}

#[test]
fn a_way_point_beyond_a_pole_is_refused_by_its_line_in_every_format_of_missions() {
    let refused = |file: &str, text: &str, line: Option<usize>, words: &str| {
        let error = read_any(file, text.as_bytes(), None)
            .unwrap_err()
            .to_string();
        let is_told = line.is_none_or(|line| error.contains(&format!("line {line},")));
        assert!(is_told && error.contains(words), "{file}: {error}");
    };
    let list = |latitude: &str, longitude: &str| {
        format!(
            "QGC WPL 110\n0\t1\t0\t16\t0\t0\t0\t0\t-33.85\t18.42\t12\t1\n\
             1\t0\t3\t16\t0\t0\t0\t0\t{latitude}\t{longitude}\t100\t1\n\
             2\t0\t3\t16\t0\t0\t0\t0\t-33.84\t18.43\t100\t1\n"
        )
    };
    refused(
        "a.waypoints",
        &list("-95", "18.42"),
        Some(3),
        "-95 is no latitude",
    );
    let beyond = list("-33.85", "1842000000");
    refused(
        "a.waypoints",
        &beyond,
        Some(3),
        "1842000000 is no longitude",
    );
    let home = list("-33.85", "18.42").replace("\t-33.85\t18.42\t12\t", "\t-95\t18.42\t12\t");
    refused("a.waypoints", &home, Some(2), "-95 is no latitude");
    // Of a command that leads nowhere these may be any numbers.
    let other = list("-95", "18.42").replace("1\t0\t3\t16\t", "1\t0\t3\t181\t");
    assert!(read_any("a.waypoints", other.as_bytes(), None).is_ok());
    let plan = |home: &str, latitude: &str| {
        format!(
            r#"{{ "fileType": "Plan", "version": 1, "mission": {{ "version": 2,
  "plannedHomePosition": [{home}, 18.42, 12],
  "items": [{{ "type": "SimpleItem", "command": 16, "frame": 3,
    "params": [0, 0, 0, null, {latitude}, 18.42, 100] }}] }} }}"#
        )
    };
    assert!(read_any("a.plan", plan("-33.85", "-33.85").as_bytes(), None).is_ok());
    let item = "mission.items[0].params[4]: -95 is no latitude";
    refused("a.plan", &plan("-33.85", "-95"), Some(4), item);
    refused(
        "a.plan",
        &plan("-95", "-33.85"),
        Some(2),
        "mission.plannedHomePosition: -95",
    );
    let inav = r#"<?xml version="1.0"?>
<mission>
<missionitem no="1" action="WAYPOINT" lat="-95" lon="18.42" alt="50" parameter1="0" parameter2="0" parameter3="0" flag="165"/>
</mission>"#;
    refused("a.mission", inav, Some(3), "-95, 18.42 is no place");
    let terminal = |place: &str| {
        format!("# wp\nwp 0 1 -338500000 184200000 5000 0 0 0 0\nwp 1 1 {place} 5000 0 0 0 165\n")
    };
    assert!(read_any("a.txt", terminal("-338400000 184200000").as_bytes(), None).is_ok());
    let far = terminal("-950000000 184200000");
    refused("a.txt", &far, Some(3), "-95, 18.42 is no place");
    let far = terminal("-338400000 5500000000");
    refused("a.txt", &far, Some(3), "-33.84, 550 is no place");
    let json = |latitude: &str| {
        format!(
            r#"{{"mission":[{{"no":1,"action":"WAYPOINT","lat":-33.85,"lon":18.42,"alt":50}},
{{"no":2,"action":"WAYPOINT","lat":{latitude},"lon":18.42,"alt":50,"flag":165}}]}}"#
        )
    };
    assert!(read_any("a.json", json("-33.84").as_bytes(), None).is_ok());
    let item = "command 2 of the mission: -95, 18.42 is no place";
    refused("a.json", &json("-95"), None, item);
}
