//! A correction of the estimate as a short motion: from what was predicted to what the picture made of it.

use nalgebra::{DMatrix, Matrix2};
use pilotage_core::frames::GroundPoint;
use pilotage_core::navigator::{Run, StepReport};

use super::symbols::sigma_points;
use crate::views::picking::recent_frame;

/// Longest motion of a correction, seconds.
const LONGEST: f64 = 0.25;
/// Largest part of the time between two pictures that it takes.
const MOST_OF_INTERVAL: f64 = 0.8;

/// Belief of the position as it is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownBelief {
    /// Estimated position.
    pub position: GroundPoint,
    /// Its covariance (north, east), square metres.
    pub covariance: Matrix2<f64>,
    /// Sigma points, states in rows and points in columns.
    pub sigma: DMatrix<f64>,
    /// Part of the last correction that is shown, 0 to 1: 1 once the motion is over.
    pub share: f32,
}

/// The belief of `step` at a `time`, in motion while the last correction is so fresh. `motion` is how many seconds of the
/// flight pass in a second, 0 where nothing may move by itself.
pub fn shown_belief(run: &Run, step: &StepReport, time: f64, motion: f64) -> ShownBelief {
    let mut shown = ShownBelief {
        position: step.after.position(),
        covariance: step.after.position_covariance(),
        sigma: sigma_points(step).clone(),
        share: 1.0,
    };
    let longest = LONGEST * motion;
    let corrected = recent_frame(run, time, longest).filter(|it| it.is_placed());
    let Some(corrected) = corrected.filter(|_| motion > 0.0) else {
        return shown;
    };
    // One farther back does not make the motion shorter.
    let earlier = corrected.time - corrected.dt.max(1e-6);
    let before = recent_frame(run, earlier, longest / MOST_OF_INTERVAL);
    let interval = before.map_or(f64::INFINITY, |it| corrected.time - it.time);
    let length = longest.min(MOST_OF_INTERVAL * interval);
    let age = (time - corrected.time) / length;
    if !(0.0..1.0).contains(&age) {
        return shown;
    }
    let share = age * age * (3.0 - 2.0 * age);
    let missing = 1.0 - share;
    let (prior, posterior) = (&corrected.predicted, &corrected.after);
    shown.position.north += missing * (prior.position().north - posterior.position().north);
    shown.position.east += missing * (prior.position().east - posterior.position().east);
    shown.covariance += missing * (prior.position_covariance() - posterior.position_covariance());
    if let Some(posterior) = &corrected.sigma.after_correct {
        let prior = &corrected.sigma.after_predict;
        if prior.shape() == posterior.shape() && prior.shape() == shown.sigma.shape() {
            shown.sigma += missing * (prior - posterior);
        }
    }
    shown.share = share as f32;
    shown
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::views::fixture::Fixture;

    /// A run with a correction, and its step.
    fn corrected(run: &Run) -> &StepReport {
        let last = run.steps.len() - 1;
        let mut steps = run.steps[..last].iter();
        steps.find(|step| step.corrected()).expect("a correction")
    }

    #[test]
    fn the_cloud_goes_from_the_prediction_to_the_correction_and_stands_there() {
        let fixture = Fixture::new();
        let run = &fixture.run;
        let step = corrected(run);
        let prior = shown_belief(run, step, step.time, 1.0);
        assert!(prior.position.distance(&step.predicted.position()) < 1e-9);
        let off = prior.covariance - step.predicted.position_covariance();
        assert!(off.norm() < 1e-9);
        assert!((&prior.sigma - &step.sigma.after_predict).norm() < 1e-9);
        assert_eq!(prior.share, 0.0);
        let mut before = f64::INFINITY;
        for i in 1..10 {
            let shown = shown_belief(run, step, step.time + 0.01 * f64::from(i), 1.0);
            let off = shown.position.distance(&step.after.position());
            assert!(off < before);
            before = off;
        }
        let over = shown_belief(run, step, step.time + LONGEST, 1.0);
        assert!(over.position.distance(&step.after.position()) < 1e-9);
        assert_eq!(over.share, 1.0);
    }

    #[test]
    fn nothing_moves_while_the_replay_stands_still_or_people_want_no_motion() {
        let fixture = Fixture::new();
        let step = corrected(&fixture.run);
        let shown = shown_belief(&fixture.run, step, step.time, 0.0);
        assert!(shown.position.distance(&step.after.position()) < 1e-9);
        assert_eq!(shown.share, 1.0);
    }
}
