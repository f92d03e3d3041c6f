//! Tally of one contender, flight by flight.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use super::{ComparisonRow, Contender};
use crate::navigator::{ErrorFigures, Estimate, Outcome, Run, smooth};
use pilotage_estimation::filter::{Consistency, FilterError};
use pilotage_flight::Flight;

/// Gathers the runs of one contender.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContenderTally {
    contender: Contender,
    flights: usize,
    failed: usize,
    in_flight: PositionErrors,
    smoothed: Option<PositionErrors>,
    /// Flights navigated to their end that could not be smoothed.
    unsmoothed: usize,
    nis: Consistency,
    frames_with_update: usize,
    accepted: usize,
    refused: usize,
    steps: usize,
    milliseconds: f64,
    smoothing_milliseconds: f64,
}

/// Errors of positions.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct PositionErrors {
    distances: Vec<f64>,
    nees: Consistency,
}

impl PositionErrors {
    fn push(&mut self, estimate: &Estimate, truth: &Vector2<f64>) {
        let off = estimate.position().to_vector() - truth;
        self.distances.push(off.norm());
        let covariance = estimate.position_covariance();
        // A covariance that cannot be inverted is no honest one: it counts as outside.
        let nees = covariance
            .cholesky()
            .map_or(f64::INFINITY, |root| root.solve(&off).dot(&off));
        self.nees.push(nees, 2);
    }

    fn merge(&mut self, other: Self) {
        self.distances.extend(other.distances);
        self.nees.merge(&other.nees);
    }
}

impl ContenderTally {
    /// Nothing yet; with the smoothed estimates too, if so asked.
    pub fn new(contender: Contender, with_smoothed: bool) -> Self {
        Self {
            contender,
            flights: 0,
            failed: 0,
            in_flight: PositionErrors::default(),
            smoothed: with_smoothed.then(PositionErrors::default),
            unsmoothed: 0,
            nis: Consistency::default(),
            frames_with_update: 0,
            accepted: 0,
            refused: 0,
            steps: 0,
            milliseconds: 0.0,
            smoothing_milliseconds: 0.0,
        }
    }

    /// Whose it is.
    pub fn contender(&self) -> Contender {
        self.contender
    }

    /// Counts a flight that could not be navigated to its end.
    pub fn fail(&mut self) {
        self.failed += 1;
    }

    /// Adds the run of a flight, held against its truth where there is one. `stopwatch` gives
    /// milliseconds of any clock that never goes back.
    ///
    /// # Errors
    /// Where the run cannot be smoothed. It is counted all the same: as flown in flight, as failed smoothed.
    pub fn add(
        &mut self,
        flight: &Flight,
        run: &Run,
        stopwatch: &dyn Fn() -> f64,
    ) -> Result<(), FilterError> {
        self.flights += 1;
        self.steps += run.steps.len();
        let truth = |time: f64| {
            let position = flight.truth.as_ref()?.position(time)?;
            Some(Vector2::new(position.x, position.y))
        };
        for step in &run.steps {
            self.milliseconds += step.timing.predict + step.timing.update;
            if let Some(truth) = truth(step.time) {
                self.in_flight.push(&step.after, &truth);
            }
            let Some(frame) = &step.frame else { continue };
            let accepted = frame.candidates.iter();
            let accepted = accepted.filter(|c| c.outcome == Outcome::Accepted).count();
            self.accepted += accepted;
            self.refused += frame.candidates.len() - accepted;
            if let Some(joint) = &frame.joint {
                self.frames_with_update += 1;
                self.nis.push(joint.nis, joint.degrees_of_freedom);
            }
        }
        if let Some(errors) = &mut self.smoothed {
            let begun = stopwatch();
            let smoothed = smooth(run).inspect_err(|_| self.unsmoothed += 1)?;
            self.smoothing_milliseconds += stopwatch() - begun;
            for (step, estimate) in run.steps.iter().zip(&smoothed) {
                if let Some(truth) = truth(step.time) {
                    errors.push(estimate, &truth);
                }
            }
        }
        Ok(())
    }

    /// Adds what another gathered of the same contender.
    pub fn merge(&mut self, other: Self) {
        self.flights += other.flights;
        self.failed += other.failed;
        self.in_flight.merge(other.in_flight);
        if let Some((ours, theirs)) = self.smoothed.as_mut().zip(other.smoothed) {
            ours.merge(theirs);
        }
        self.unsmoothed += other.unsmoothed;
        self.nis.merge(&other.nis);
        self.frames_with_update += other.frames_with_update;
        self.accepted += other.accepted;
        self.refused += other.refused;
        self.steps += other.steps;
        self.milliseconds += other.milliseconds;
        self.smoothing_milliseconds += other.smoothing_milliseconds;
    }

    /// The lines of the table: in flight, and smoothed if that was asked for.
    pub fn rows(&self) -> Vec<ComparisonRow> {
        let row = |errors: &PositionErrors, smoothed: bool| {
            let (unsmoothed, milliseconds) = if smoothed {
                (self.unsmoothed, self.smoothing_milliseconds)
            } else {
                (0, self.milliseconds)
            };
            let flights = self.flights - unsmoothed;
            ComparisonRow {
                contender: self.contender,
                smoothed,
                flights,
                failed: self.failed + unsmoothed,
                position_error_m: ErrorFigures::of(errors.distances.clone()),
                nees: errors.nees.summary_of_runs(flights),
                nis: (!smoothed).then(|| self.nis.summary()).flatten(),
                frames_with_update: self.frames_with_update,
                updates_accepted: self.accepted,
                updates_refused: self.refused,
                ms_per_step: milliseconds / self.steps.max(1) as f64,
            }
        };
        let smoothed = self.smoothed.iter().map(|errors| row(errors, true));
        std::iter::once(row(&self.in_flight, false))
            .chain(smoothed)
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use pilotage_mission::settings::{EstimatorChoice, NavigatorSettings, VehicleChoice};

    use super::*;
    use crate::navigator::flight_for_tests::flight_of;
    use crate::navigator::step_for_tests::step_at;

    #[test]
    fn a_run_that_cannot_be_smoothed_is_counted_as_that_and_the_others_are_judged() {
        let flight = flight_of(Vec::new());
        let contender = Contender {
            estimator: EstimatorChoice::Unscented,
            vehicle: VehicleChoice::RandomWalk,
        };
        // Its steps have two states; an airplane in wind has four.
        let run = |vehicle| Run {
            name: "test".to_owned(),
            settings: NavigatorSettings {
                vehicle,
                ..NavigatorSettings::default()
            },
            landmarks: Vec::new(),
            state_names: Vec::new(),
            steps: vec![step_at(0.5), step_at(1.0)],
        };
        let mut tally = ContenderTally::new(contender, true);
        tally
            .add(&flight, &run(VehicleChoice::RandomWalk), &|| 0.0)
            .expect("it is smoothed");
        let refused = tally.add(&flight, &run(VehicleChoice::AirplaneWind), &|| 0.0);
        assert!(
            matches!(refused, Err(FilterError::Size { .. })),
            "{refused:?}"
        );
        let mut both = ContenderTally::new(contender, true);
        both.fail();
        both.merge(tally);
        let counted: Vec<(bool, usize, usize)> = both
            .rows()
            .iter()
            .map(|row| (row.smoothed, row.flights, row.failed))
            .collect();
        assert_eq!(counted, [(false, 2, 1), (true, 1, 2)]);
    }
}
