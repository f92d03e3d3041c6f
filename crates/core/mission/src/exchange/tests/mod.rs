//! Round trips through every format, other people's files, and broken ones.

mod actions;
mod archives;
mod fences;
mod firmware;
mod flown;
mod foreign;
mod globe;
mod held;
mod home;
mod kml_elements;
mod kml_pilot;
mod makers;
mod plan;
mod rally;
mod round_trip;
mod several;
mod tables;

use crate::mission::{Route, WayPoint, WayPointAction};
use pilotage_base::frames::{Altitude, AltitudeFrame, Geodetic, GroundPoint, LocalFrame};

pub(super) fn frame() -> LocalFrame {
    LocalFrame::new(Geodetic::from_degrees(47.4, 8.5, 400.0))
}

/// A route with everything that a way-point can state.
pub(super) fn route() -> Route {
    let at = |north, east, metres, frame| {
        WayPoint::new(GroundPoint::new(north, east), Altitude::new(metres, frame))
    };
    Route {
        id: 1,
        name: "there & <back>".to_owned(),
        way_points: vec![
            WayPoint {
                action: WayPointAction::TakeOff,
                ..at(0.0, 0.0, 50.0, AltitudeFrame::AboveTakeOff)
            },
            WayPoint {
                speed: Some(18.5),
                ..at(400.25, -30.5, 120.0, AltitudeFrame::AboveTakeOff)
            },
            WayPoint {
                speed: Some(18.5),
                action: WayPointAction::Loiter {
                    radius: -75.0,
                    turns: 2.5,
                },
                ..at(800.0, 900.0, 135.5, AltitudeFrame::AboveGround)
            },
            at(-200.0, 1200.0, 620.0, AltitudeFrame::Amsl),
            WayPoint {
                speed: Some(14.0),
                action: WayPointAction::Land,
                ..at(10.0, 12.0, 0.0, AltitudeFrame::AboveTakeOff)
            },
        ],
        ..Route::default()
    }
}

/// Asserts that one of the notes is as wanted.
#[track_caller]
pub(super) fn assert_noted(notes: &[String], is_wanted: impl Fn(&str) -> bool) {
    assert!(notes.iter().any(|note| is_wanted(note)), "{notes:#?}");
}

/// Asserts that two routes state the same, places to a tenth of a millimetre.
pub(super) fn assert_same_way_points(after: &Route, before: &Route) {
    assert_eq!(after.way_points.len(), before.way_points.len());
    for (a, b) in after.way_points.iter().zip(&before.way_points) {
        let distance = a.position.distance(&b.position);
        assert!(distance < 1e-4, "{distance} m from where it was");
        let position = b.position;
        assert_eq!(
            WayPoint {
                position,
                ..a.clone()
            },
            *b
        );
    }
}
