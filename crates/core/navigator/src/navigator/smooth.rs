//! The best estimate after the flight: every step with all that was measured before and after it.

use nalgebra::{DMatrix, SMatrix, SVector};

use super::engine::{unscented, visit_model};
use super::{Estimate, Run};
use pilotage_estimation::filter::{FilterError, Gaussian, SmootherLink, Weights};
use pilotage_estimation::vehicle::{VehicleModel, VehicleVisitor};

/// The smoothed estimates of a run, one for the end of each of its steps, by the unscented
/// Rauch-Tung-Striebel smoother over the steps' sigma points.
///
/// Runs of every estimator can be smoothed: all report sigma points from which a prediction can be told.
/// Where another belief took over in flight (see [`super::JointReport::recovered`]) the steps before it
/// are smoothed from what that one believed. The last estimate is that of the run.
///
/// # Errors
/// Where the run is of another vehicle than its settings say, or a covariance of it is none.
pub fn smooth(run: &Run) -> Result<Vec<Estimate>, FilterError> {
    let mut smoothing = RunSmoothing::default();
    while smoothing.advance(run, run.steps.len())? {}
    Ok(smoothing.into_estimates())
}

/// A run that is being smoothed, from its end backward, some steps at a time: the estimates are those of [`smooth`],
/// whatever the parts.
#[derive(Clone, Debug, Default)]
pub struct RunSmoothing {
    /// Estimates so far, that of the last step first.
    backward: Vec<Estimate>,
}

impl RunSmoothing {
    /// Smooths so many steps more of the run, which is the same in every call; whether some are left.
    ///
    /// # Errors
    /// Those of [`smooth`].
    pub fn advance(&mut self, run: &Run, count: usize) -> Result<bool, FilterError> {
        let part = SmoothedPart {
            run,
            known: &self.backward,
            count,
        };
        let part = visit_model(&run.settings, part)?;
        self.backward.extend(part);
        Ok(self.done() < run.steps.len())
    }

    /// Number of steps that are smoothed.
    #[must_use]
    pub fn done(&self) -> usize {
        self.backward.len()
    }

    /// The estimates, one for the end of each step that is smoothed, in the order of time.
    #[must_use]
    pub fn into_estimates(mut self) -> Vec<Estimate> {
        self.backward.reverse();
        self.backward
    }
}

/// The next estimates backward before those that are known.
struct SmoothedPart<'a> {
    run: &'a Run,
    known: &'a [Estimate],
    count: usize,
}

impl VehicleVisitor for SmoothedPart<'_> {
    type Output = Result<Vec<Estimate>, FilterError>;

    fn visit<const N: usize, V: VehicleModel<N>>(self, _model: V) -> Self::Output {
        let weights = Weights::new::<N>(&unscented(&self.run.settings), 0.0)?;
        let steps = &self.run.steps;
        let Some(last) = steps.last() else {
            return Ok(Vec::new());
        };
        let mut part = Vec::new();
        let mut later = gaussian::<N>(self.known.last().unwrap_or(&last.after))?;
        if self.known.is_empty() {
            part.push(Estimate::from(&later));
        }
        let to = steps.len() - self.known.len() - part.len();
        let from = (to + part.len()).saturating_sub(self.count).min(to);
        // The step after each: it begins where that one ends.
        for step in steps[from + 1..=to].iter().rev() {
            let (before, after) = (&step.sigma.before_predict, &step.sigma.after_predict);
            let link = SmootherLink {
                before: gaussian(&step.before)?,
                after: gaussian(&step.predicted)?,
                cross_covariance: spread::<N>(before)?
                    * spread::<N>(after)?.transpose()
                    * (0.5 * weights.outer),
            };
            later = link.smoothed(&later)?;
            part.push(Estimate::from(&later));
        }
        Ok(part)
    }
}

fn size<const N: usize>(found: usize) -> Result<(), FilterError> {
    if found == N {
        return Ok(());
    }
    Err(FilterError::Size {
        what: "state of the run",
        expected: N,
        found,
    })
}

fn gaussian<const N: usize>(estimate: &Estimate) -> Result<Gaussian<N>, FilterError> {
    size::<N>(estimate.mean.len())?;
    size::<N>(estimate.covariance.ncols())?;
    Ok(Gaussian::new(
        SVector::from_column_slice(estimate.mean.as_slice()),
        SMatrix::from_column_slice(estimate.covariance.as_slice()),
    ))
}

/// Differences of opposite sigma points (n × (2n + 1), the centre first).
fn spread<const N: usize>(points: &DMatrix<f64>) -> Result<SMatrix<f64, N, N>, FilterError> {
    size::<N>(points.nrows())?;
    size::<N>(points.ncols().saturating_sub(1) / 2)?;
    Ok(SMatrix::from_fn(|i, j| {
        points[(i, 1 + j)] - points[(i, 1 + N + j)]
    }))
}

#[cfg(test)]
mod tests {
    use nalgebra::{DVector, dvector};
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::super::engine::{MeasurementModel, engine};
    use super::*;
    use crate::navigator::{Control, SigmaSets, StepReport, StepTiming};
    use pilotage_base::frames::{Attitude, GroundPoint};
    use pilotage_estimation::filter::Consistency;
    use pilotage_estimation::vehicle::{ControlInput, Kinematics};
    use pilotage_mission::settings::{EstimatorChoice, NavigatorSettings};

    /// A run of `choice` in a wind that it does not know, with a fix every fifth second, and the truth.
    fn run(choice: EstimatorChoice, seed: u64) -> (Run, Vec<DVector<f64>>) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let mut settings = NavigatorSettings::default();
        settings.estimator.choice = choice;
        settings.process.airspeed = 0.5;
        // Air without gusts, and readings without biases.
        settings.process.gust = 0.0;
        settings.process.airspeed_bias = 0.0;
        settings.process.heading_bias = 0.0;
        let mut engine = engine(&settings, GroundPoint::new(0.0, 0.0), 3.0).unwrap();
        let mut truth = dvector![
            3.0 * normal(),
            3.0 * normal(),
            4.0 * normal(),
            4.0 * normal()
        ];
        let (dt, position) = (0.5, DMatrix::from_diagonal_element(2, 2, 4.0));
        let (mut steps, mut truths) = (Vec::new(), Vec::new());
        for k in 0..120_i32 {
            let heading = 0.05 * f64::from(k);
            let attitude = Attitude::level(heading);
            let predicted = engine
                .predict(&ControlInput::new(18.0, attitude), dt)
                .unwrap();
            let airspeed = 18.0 + settings.process.airspeed * normal() / dt.sqrt();
            let across = 18.0 * settings.process.heading * normal() / dt.sqrt();
            let (sin, cos) = heading.sin_cos();
            truth[0] += (airspeed * cos - across * sin + truth[2]) * dt;
            truth[1] += (airspeed * sin + across * cos + truth[3]) * dt;
            for axis in 2..4 {
                truth[axis] += settings.process.wind * dt.sqrt() * normal();
            }
            let mut after = predicted.after.clone();
            if k % 10 == 9 {
                let seen = dvector![truth[0] + 2.0 * normal(), truth[1] + 2.0 * normal()];
                let place = |k: &Kinematics| Some(dvector![k.position.north, k.position.east]);
                let model = MeasurementModel::of_pose(place);
                after = engine.correct(&model, &position, &seen).unwrap().after;
            }
            steps.push(StepReport {
                time: dt * f64::from(k + 1),
                dt,
                control: Control {
                    airspeed: Some(18.0),
                    heading,
                    roll: 0.0,
                    pitch: 0.0,
                    height: 100.0,
                },
                before: predicted.before,
                predicted: predicted.after,
                after,
                sigma: SigmaSets {
                    before_predict: predicted.sigma_before,
                    after_predict: predicted.sigma_after,
                    before_correct: None,
                    after_correct: None,
                },
                dead_reckoned: GroundPoint::default(),
                doubts: Vec::new(),
                frame: None,
                timing: StepTiming::default(),
                updates: Vec::new(),
                sightings: Vec::new(),
            });
            truths.push(truth.clone());
        }
        let run = Run {
            name: "test".to_owned(),
            settings,
            landmarks: Vec::new(),
            state_names: engine.components(),
            steps,
        };
        (run, truths)
    }

    #[test]
    fn a_run_of_any_estimator_is_better_known_after_the_flight_and_honestly_so() {
        const RUNS: usize = 25;
        for choice in EstimatorChoice::ALL {
            let (mut filtered, mut error) = (0.0, 0.0);
            let mut nees = Consistency::default();
            for seed in 0..RUNS as u64 {
                let (run, truths) = run(choice, seed);
                let smoothed = smooth(&run).unwrap();
                assert_eq!(smoothed.len(), run.steps.len());
                assert_eq!(smoothed.last(), run.steps.last().map(|s| &s.after));
                for ((step, smoothed), truth) in run.steps.iter().zip(&smoothed).zip(&truths) {
                    let off = &smoothed.mean - truth;
                    filtered += (&step.after.mean - truth).rows(0, 2).norm_squared();
                    error += off.rows(0, 2).norm_squared();
                    let root = smoothed.covariance.clone().cholesky().unwrap();
                    nees.push(root.solve(&off).dot(&off), 4);
                }
            }
            let summary = nees.summary_of_runs(RUNS).unwrap();
            println!("{choice:?}: error {error:.0} of {filtered:.0} m², {summary:?}");
            assert!(error < 0.4 * filtered, "{choice:?}: {error} {filtered}");
            assert!(summary.is_consistent(), "{choice:?}: {summary:?}");
        }
    }

    #[test]
    fn a_run_that_is_smoothed_by_parts_is_the_same_to_the_bit() {
        let (run, _) = run(EstimatorChoice::Unscented, 3);
        let whole = smooth(&run).unwrap();
        for count in [1, 7, 119, 120, 500] {
            let mut parts = RunSmoothing::default();
            while parts.advance(&run, count).unwrap() {
                assert_eq!(parts.done() % count, 0);
            }
            assert!(parts.into_estimates() == whole, "{count}");
        }
    }

    #[test]
    fn a_run_without_steps_has_nothing_to_smooth_and_one_of_another_vehicle_is_refused() {
        let (mut run, _) = run(EstimatorChoice::Unscented, 1);
        let steps = std::mem::take(&mut run.steps);
        assert_eq!(smooth(&run), Ok(Vec::new()));
        run.steps = steps;
        run.settings.vehicle = pilotage_mission::settings::VehicleChoice::AirplaneFull;
        let refused = smooth(&run).unwrap_err();
        assert!(matches!(refused, FilterError::Size { expected: 8, .. }));
    }
}
