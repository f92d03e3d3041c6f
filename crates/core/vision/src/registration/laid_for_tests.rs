//! A frame laid on the map, for tests.

use nalgebra::{Matrix2, Matrix6, Point3, SMatrix};

use super::CameraPlace;
use super::fit::{PoseFit, UNKNOWNS};
use super::look::MapPose;
use super::register::{Registration, RegistrationMethod};
use super::shape::MapShape;
use pilotage_base::frames::{Attitude, GroundPoint, Pose};

/// A frame that was laid as a whole 100 m above a place, with a probability.
pub fn laid_at(north: f64, east: f64, probability: f64) -> Registration {
    let pose = Pose {
        position_in_world: Point3::new(north, east, -100.0),
        attitude: Attitude::level(0.0),
    };
    Registration {
        fit: PoseFit {
            at: MapPose {
                pose,
                shape: MapShape::default(),
            },
            covariance: SMatrix::<f64, UNKNOWNS, UNKNOWNS>::identity(),
            deviation: 1.0,
        },
        matches: Vec::new(),
        tried: 10,
        laid_by: RegistrationMethod::WholeFrame,
        log_false_alarms: (1.0 - probability).log10(),
        probability,
        camera: CameraPlace {
            pose,
            covariance: Matrix6::identity(),
            by_tilt: Matrix2::zeros(),
        },
        centre: GroundPoint::new(north, east),
        centre_covariance: Matrix2::identity(),
        stored_turn: 0.0,
        score: 0.5,
    }
}
