//! Sensitivity to one deviation of one instrument, over several flights.

use pilotage_core::plan::{SensitivityRow, TestedInstrument, rms_with_walk};

use super::order::{Order, Urgency, WorkerRole};
use super::{Advance, JobEvent, RunningJob, WorkerState};

/// Question how the position errs where the error of an instrument walks at random. Event `Figures` with a
/// [`SensitivityRow`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensitivityOrder {
    /// The instrument.
    pub instrument: TestedInstrument,
    /// Standard deviation of the walk's steps, m/s or radians.
    pub deviation: f64,
    /// Number of flights.
    pub runs: u64,
}

/// The question under way.
struct Flights {
    order: SensitivityOrder,
    row: SensitivityRow,
}

impl RunningJob for Flights {
    fn advance(
        &mut self,
        _: &mut WorkerState,
        _: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let done = self.row.rms.len() as u64;
        if done < self.order.runs {
            let SensitivityOrder {
                instrument,
                deviation,
                runs,
            } = self.order;
            self.row
                .rms
                .push(rms_with_walk(instrument, deviation, done + 1));
            let share = (done + 1) as f32 / runs as f32;
            emit(JobEvent::Progress(share, "Flying".to_owned()));
            return Ok(Advance::More);
        }
        emit(JobEvent::of_figures(&self.row)?);
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl Order for SensitivityOrder {
    const URGENCY: Urgency = Urgency::Slow;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(Flights {
            order: self,
            row: SensitivityRow {
                instrument: self.instrument,
                deviation: self.deviation,
                rms: Vec::new(),
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::running::figures;

    #[test]
    fn every_run_has_its_error_and_the_same_one_whenever_it_is_flown() {
        let order = SensitivityOrder {
            instrument: TestedInstrument::Yaw,
            deviation: 0.01,
            runs: 2,
        };
        let row: SensitivityRow = figures(order);
        assert_eq!(row.rms.len(), 2);
        assert_ne!(row.rms[0], row.rms[1]);
        assert_eq!(row.rms[1], rms_with_walk(TestedInstrument::Yaw, 0.01, 2));
    }
}
