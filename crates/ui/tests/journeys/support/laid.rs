//! The invented flight with satellite navigation, and its pictures laid on the map.

use nalgebra::{Matrix2, Matrix6, Point2, Point3};
use pilotage_core::flight::{Channel, ChannelName, Flight};
use pilotage_core::frames::Pose;
use pilotage_core::navigator::{RegisteredPlace, RegistrationReport, StepReport};
use pilotage_core::registration::{MapShape, RegistrationMethod};

use super::flight::flight;

/// Occasion on which pictures of the invented flight, stamped too early, are laid on the map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Laying {
    /// They are not, and the flight is the usual one.
    #[default]
    Never,
    /// Only if the mission asks for whole frames.
    IfAsked,
    /// In any case.
    Always,
}

/// Seconds by which the pictures are stamped too early.
pub const EARLY: f64 = 0.5;

/// The flight with fixes of its true places and pictures stamped too early.
pub fn early_flight() -> Flight {
    let mut flight = flight();
    let states = flight.truth.iter().flat_map(|t| &t.states);
    let states: Vec<_> = states.map(|s| (s.time, s.position)).collect();
    for (name, axis) in [(ChannelName::GpsNorth, 0), (ChannelName::GpsEast, 1)] {
        flight.channels.push(Channel {
            name,
            times: states.iter().map(|s| s.0).collect(),
            values: states.iter().map(|s| s.1[axis]).collect(),
        });
    }
    for frame in &mut flight.frames {
        frame.time += 1.0 - EARLY;
    }
    flight.frames.truncate(110);
    flight
}

/// Lays the pictures of the flight as it was `opened` where they were taken; `flown` says what was believed of
/// the camera.
pub fn lay_frames(steps: &mut [StepReport], opened: &Flight, flown: &Flight) {
    let frames = steps.iter_mut().filter_map(|s| s.frame.as_mut());
    for report in frames {
        let Some(frame) = opened.frames.get(report.index) else {
            continue;
        };
        let time = frame.time + EARLY;
        let value = |name| opened.value(name, time).expect("a whole channel");
        let height = value(ChannelName::HeightAboveGround);
        let wave = 0.2 * (2.3 * report.index as f64).sin();
        let pose = Pose {
            position_in_world: Point3::new(
                value(ChannelName::GpsNorth) + wave,
                value(ChannelName::GpsEast) - wave,
                -height * flown.camera.focal / opened.camera.focal,
            ),
            attitude: opened.attitude(time).expect("a heading"),
        };
        let middle = Point2::new(320.0, 240.0);
        let centre = opened.camera.ground_at(&pose, &middle, 0.0);
        report.laid = Some(RegistrationReport {
            place: Some(RegisteredPlace {
                pose,
                covariance: Matrix6::identity(),
                centre: centre.expect("it looks down"),
                centre_covariance: Matrix2::identity(),
                matches: Vec::new(),
                stored_turn: 0.0,
                shape: MapShape::default(),
            }),
            refusal: None,
            refused_as: None,
            tried: 40,
            laid_by: RegistrationMethod::Patches,
            log_false_alarms: -20.0,
            probability: Some(1.0),
        });
    }
}
