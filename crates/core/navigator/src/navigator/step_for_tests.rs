//! A step of a run in which nothing was seen, for tests.

use nalgebra::{DMatrix, dvector};
use pilotage_base::frames::GroundPoint;

use super::{Control, Estimate, SigmaSets, StepReport, StepTiming};

/// The step that ends at `time`, seconds, in two states.
pub fn step_at(time: f64) -> StepReport {
    let estimate = Estimate {
        mean: dvector![3.0, -4.0],
        covariance: DMatrix::identity(2, 2),
    };
    StepReport {
        time,
        dt: 0.5,
        control: Control {
            airspeed: Some(18.0),
            heading: 1.0,
            roll: 0.1,
            pitch: 0.0,
            height: 120.0,
        },
        before: estimate.clone(),
        predicted: estimate.clone(),
        after: estimate,
        sigma: SigmaSets {
            before_predict: DMatrix::zeros(2, 5),
            after_predict: DMatrix::zeros(2, 5),
            before_correct: None,
            after_correct: None,
        },
        dead_reckoned: GroundPoint::new(1.0, 2.0),
        doubts: Vec::new(),
        frame: None,
        timing: StepTiming::default(),
        updates: Vec::new(),
        sightings: Vec::new(),
    }
}
