//! Observations along a flight, step by step.

use nalgebra::{Matrix2, Vector2};
use pilotage_core::filter::chi_square_quantile;
use pilotage_core::flight::Flight;
use pilotage_core::navigator::{Outcome, Run, StepReport, is_wrong};
use pilotage_core::vehicle::StateComponent;

use super::measure::MeasureKind;
use super::plan::StudyMeasure;

/// Share of the truth that an honest ellipse holds.
const ELLIPSE: f64 = 0.95;

/// Squares of an error, and the last of them.
#[derive(Clone, Copy, Debug, Default)]
struct Errors {
    sum: f64,
    largest: f64,
    last: f64,
    count: usize,
}

impl Errors {
    fn push(&mut self, squared: f64) {
        self.sum += squared;
        self.largest = self.largest.max(squared);
        self.last = squared;
        self.count += 1;
    }

    fn rms(&self) -> Option<f64> {
        (self.count > 0).then(|| (self.sum / self.count as f64).sqrt())
    }

    fn end(&self) -> Option<f64> {
        (self.count > 0).then(|| self.last.sqrt())
    }

    fn most(&self) -> Option<f64> {
        (self.count > 0).then(|| self.largest.sqrt())
    }
}

/// Observations along a flight. Those of a flight that the filter gave up are the default.
#[derive(Default)]
pub struct Observed {
    /// The run without its steps; none of a flight that was given up.
    head: Option<Run>,
    wind_index: Option<usize>,
    inside_below: f64,
    position: Errors,
    wind: Errors,
    reckoned: Errors,
    nees: f64,
    inside: usize,
    is_inside: bool,
    nis: f64,
    nis_dof: f64,
    frames: usize,
    accepted: usize,
    refused: usize,
    wrong: usize,
    is_doubted: bool,
}

impl Observed {
    /// Nothing yet, of the run that begins with `head`.
    pub fn of(head: Run) -> Self {
        Self {
            wind_index: head.state_index(StateComponent::WindNorth),
            inside_below: chi_square_quantile(ELLIPSE, 2.0),
            head: Some(head),
            ..Self::default()
        }
    }

    /// Takes in a step.
    pub fn take(&mut self, flight: &Flight, step: &StepReport) {
        self.is_doubted |= !step.doubts.is_empty();
        if let Some(frame) = &step.frame {
            self.frames += usize::from(frame.joint.is_some());
            for candidate in &frame.candidates {
                if candidate.outcome != Outcome::Accepted {
                    self.refused += usize::from(candidate.measured_pixel.is_some());
                    continue;
                }
                self.accepted += 1;
                let head = self.head.as_ref();
                let is_wrong =
                    head.is_some_and(|run| is_wrong(flight, run, frame.index, candidate));
                self.wrong += usize::from(is_wrong);
            }
            if let Some(joint) = &frame.joint {
                self.nis += joint.nis;
                self.nis_dof += joint.degrees_of_freedom as f64;
            }
        }
        let Some(truth) = &flight.truth else { return };
        if let Some(position) = truth.position(step.time) {
            let truth = Vector2::new(position.x, position.y);
            let off = step.after.position().to_vector() - truth;
            self.position.push(off.norm_squared());
            let reckoned = step.dead_reckoned.to_vector() - truth;
            self.reckoned.push(reckoned.norm_squared());
            let covariance: Matrix2<f64> = step.after.position_covariance();
            // A covariance that cannot be inverted is no honest one: it counts as outside.
            let nees = covariance
                .cholesky()
                .map_or(f64::INFINITY, |root| root.solve(&off).dot(&off));
            self.nees += nees;
            self.is_inside = nees <= self.inside_below;
            self.inside += usize::from(self.is_inside);
        }
        if let Some((index, wind)) = self.wind_index.zip(truth.wind(step.time)) {
            let mean = &step.after.mean;
            let off = Vector2::new(mean[index], mean[index + 1]) - wind;
            self.wind.push(off.norm_squared());
        }
    }

    fn number(&self, kind: MeasureKind) -> Option<f64> {
        let steps = self.position.count;
        let mean = |sum: f64, count: f64| (count > 0.0).then(|| sum / count);
        let is_finished = self.head.is_some() && steps > 0;
        let yes = |is_so: bool| Some(f64::from(u8::from(is_so)));
        if kind == MeasureKind::Finished {
            return yes(is_finished);
        }
        if !is_finished {
            return None;
        }
        match kind {
            MeasureKind::Finished => None,
            MeasureKind::ErrorRms => self.position.rms(),
            MeasureKind::ErrorMax => self.position.most(),
            MeasureKind::ErrorEnd => self.position.end(),
            MeasureKind::WindErrorRms => self.wind.rms(),
            MeasureKind::WindErrorEnd => self.wind.end(),
            MeasureKind::ReckonedMax => self.reckoned.most(),
            MeasureKind::Nees => mean(self.nees, steps as f64),
            MeasureKind::Inside => mean(self.inside as f64, steps as f64),
            MeasureKind::InsideAtEnd => yes(self.is_inside),
            MeasureKind::Nis => mean(self.nis, self.nis_dof),
            MeasureKind::Frames => Some(self.frames as f64),
            MeasureKind::Accepted => Some(self.accepted as f64),
            MeasureKind::Refused => Some(self.refused as f64),
            MeasureKind::Wrong => Some(self.wrong as f64),
            MeasureKind::Doubted => yes(self.is_doubted),
        }
        .filter(|number| number.is_finite())
    }

    /// The number that a study asks for.
    pub fn measure(&self, measure: &StudyMeasure) -> Option<f64> {
        measure.judged(self.number(measure.of))
    }

    /// Numbers of all kinds, in the order of [`MeasureKind::ALL`].
    pub fn numbers(&self) -> Vec<Option<f64>> {
        MeasureKind::ALL.map(|kind| self.number(kind)).into()
    }
}

/// Numbers of all kinds of a run of `flight`, in the order of [`MeasureKind::ALL`]; `None` where there is no such number.
pub fn numbers_of(flight: &Flight, run: &Run) -> Vec<Option<f64>> {
    let mut observed = Observed::of(Run {
        steps: Vec::new(),
        ..run.clone()
    });
    for step in &run.steps {
        observed.take(flight, step);
    }
    observed.numbers()
}
