//! Missions of DJI Pilot, which are KML with elements of their own.

use std::fmt::Write;

use super::super::{Format, read_any, write_route};
use super::{assert_noted, frame};
use crate::mission::WayPointAction;
use pilotage_base::frames::{Altitude, AltitudeFrame};

/// A mission as DJI Pilot writes it, of these way-points and this line.
fn mission(points: &[(&str, &str)], line: &str, coordinates: &str) -> String {
    let mut text = String::from(
        r#"<?xml version="1.0" encoding="UTF-8"?><kml xmlns="http://www.opengis.net/kml/2.2"><Document xmlns="">
        <name>Dam</name><open>1</open><ExtendedData xmlns:mis="www.dji.com"><mis:type>Waypoint</mis:type></ExtendedData>
        <Folder><name>Waypoints</name>"#,
    );
    for (data, place) in points {
        // Writing into a string cannot fail.
        let _ = write!(
            text,
            "<Placemark><name>Waypoint</name><visibility>1</visibility><ExtendedData xmlns:mis=\"www.dji.com\">{data}\
             </ExtendedData><Point><altitudeMode>relativeToGround</altitudeMode><coordinates>{place}</coordinates></Point>\
             </Placemark>"
        );
    }
    text + &format!(
        "</Folder><Placemark><name>Wayline</name><ExtendedData xmlns:mis=\"www.dji.com\">{line}</ExtendedData>\
         <LineString><altitudeMode>relativeToGround</altitudeMode><coordinates>{coordinates}</coordinates></LineString>\
         </Placemark></Document></kml>"
    )
}

const COMMON: &str = "<mis:useWaylineSpeed>true</mis:useWaylineSpeed><mis:speed>9</mis:speed>";
const OWN: &str = "<mis:useWaylineSpeed>false</mis:useWaylineSpeed><mis:speed>5</mis:speed>\
    <mis:actions param=\"5000\" accuracy=\"0\">Hovering</mis:actions>\
    <mis:actions param=\"0\" accuracy=\"0\">ShootPhoto</mis:actions>";
const LINE: &str = "<mis:altitude>50.0</mis:altitude><mis:autoFlightSpeed>8</mis:autoFlightSpeed>\
    <mis:actionOnFinish>GoHome</mis:actionOnFinish><mis:droneInfo><mis:droneHeight>\
    <mis:useAbsolute>false</mis:useAbsolute></mis:droneHeight></mis:droneInfo>";
const PLACES: [&str; 3] = ["8.5,47.4,60", "8.51,47.4,70", "8.51,47.41,80"];

fn whole() -> String {
    let points = [(COMMON, PLACES[0]), (OWN, PLACES[1]), (COMMON, PLACES[2])];
    mission(&points, LINE, &PLACES.join(" "))
}

#[test]
fn a_mission_of_dji_pilot_is_one_route_with_its_speeds_stays_and_return() {
    let back = read_any("a.kml", whole().as_bytes(), Some(frame())).unwrap();
    assert_eq!((back.routes.len(), back.landmarks.len()), (1, 0));
    let route = &back.routes[0];
    assert_eq!((route.name.as_str(), route.returns), ("Dam", true));
    let speeds: Vec<_> = route.way_points.iter().map(|w| w.speed).collect();
    assert_eq!(speeds, [None, Some(8.0), Some(5.0)]);
    let stay = WayPointAction::Wait {
        radius: 0.0,
        seconds: Some(5.0),
    };
    let actions: Vec<_> = route.way_points.iter().map(|w| w.action).collect();
    assert_eq!(
        actions,
        [WayPointAction::FlyBy, stay, WayPointAction::FlyBy]
    );
    let altitudes: Vec<_> = route.way_points.iter().map(|w| w.altitude).collect();
    let heights = [60.0, 70.0, 80.0].map(|m| Altitude::new(m, AltitudeFrame::AboveTakeOff));
    assert_eq!(altitudes, heights);
    assert_eq!(route.way_points[1].properties["mis:speed"], "\"5\"");
    assert!(route.way_points[1].properties["mis:actions"].contains("ShootPhoto"));
    assert!(route.properties["mis:droneInfo"].contains("useAbsolute"));
    for words in [
        "DJI Pilot",
        "not shown: ShootPhoto",
        "GoHome",
        "over ground",
    ] {
        assert_noted(&back.notes, |n| n.contains(words));
    }
    // Through our own KML it stays what it is.
    let written = write_route(Format::Kml, route, &frame()).unwrap();
    let again = read_any("b.kml", &written.bytes, Some(frame())).unwrap();
    assert_eq!(again.routes[0].way_points[2].speed, Some(5.0));
    assert_eq!(again.landmarks.len(), 0);
}

#[test]
fn points_that_are_not_those_of_the_line_stay_landmarks_with_all_that_is_said_of_them() {
    let points = [(COMMON, PLACES[0]), (OWN, PLACES[1])];
    let text = mission(&points, LINE, &PLACES.join(" "));
    let back = read_any("a.kml", text.as_bytes(), Some(frame())).unwrap();
    assert_eq!((back.routes.len(), back.landmarks.len()), (1, 2));
    assert_eq!(back.landmarks[1].properties["mis:speed"], "\"5\"");
    assert_eq!(back.routes[0].properties["mis:autoFlightSpeed"], "\"8\"");
}
