//! Formats hold what they say they hold.

use std::collections::BTreeMap;

use super::super::{Format, Places, read_any, write_places};
use crate::mission::{NoFlyZone, RallyPoint, Route, WayPoint};
use pilotage_base::frames::{Altitude, AltitudeFrame, Geodetic, GroundPoint, LocalFrame};

#[test]
fn areas_and_rally_points_come_back_out_of_the_formats_that_say_they_hold_them_and_of_no_other() {
    let frame = LocalFrame::new(Geodetic::from_degrees(46.8, -92.0, 0.0));
    let at = |north, east| GroundPoint::new(north, east);
    let altitude = Altitude::new(120.0, AltitudeFrame::AboveTakeOff);
    let route = Route {
        id: 1,
        name: "Out".to_owned(),
        way_points: vec![
            WayPoint::new(at(0.0, 0.0), altitude),
            WayPoint::new(at(500.0, 0.0), altitude),
        ],
        ..Route::default()
    };
    let area = NoFlyZone {
        name: "Town".to_owned(),
        corners: vec![at(0.0, 100.0), at(0.0, 200.0), at(90.0, 150.0)],
        ..NoFlyZone::default()
    };
    let rally = RallyPoint {
        name: "Field".to_owned(),
        position: at(30.0, 40.0),
        altitude,
        properties: BTreeMap::new(),
    };
    for (format, is_beside) in Format::all().flat_map(|f| [(f, true), (f, false)]) {
        let routes = if is_beside {
            vec![route.clone()]
        } else {
            Vec::new()
        };
        let places = Places {
            routes: &routes,
            landmarks: &[],
            no_fly: std::slice::from_ref(&area),
            rally: Some(std::slice::from_ref(&rally)),
        };
        let Ok(written) = write_places(format, &places, &frame) else {
            assert!(!format.holds_landmarks() && !is_beside, "{format:?}");
            continue;
        };
        let back = read_any("x", &written.bytes, Some(frame));
        let (areas, points) = back.map_or((0, 0), |back| (back.no_fly.len(), back.rally.len()));
        assert_eq!(areas > 0, format.holds_areas(), "{format:?}, {is_beside}");
        assert_eq!(
            points > 0,
            format.holds_rally(is_beside),
            "{format:?}, {is_beside}"
        );
    }
}
