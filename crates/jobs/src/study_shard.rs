//! A piece of a study: runs whose numbers follow each other.

use std::ops::Range;
use std::sync::Arc;

use pilotage_study::{Study, StudyRow};

use super::order::{Order, Urgency, WorkerRole};
use super::{Advance, JobEvent, RunningJob, WorkerState};

/// Order of some runs of a study. Event `Figures` with the [`StudyRow`]s of all, in the order of their numbers.
#[derive(Clone)]
pub struct StudyShardOrder {
    /// The study.
    pub study: Arc<Study>,
    /// Numbers of its runs.
    pub runs: Range<u64>,
}

/// Runs under way.
struct FlownRuns {
    order: StudyShardOrder,
    rows: Vec<StudyRow>,
}

impl RunningJob for FlownRuns {
    fn advance(
        &mut self,
        _: &mut WorkerState,
        _: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        if let Some(run) = self.order.runs.next() {
            let row = self.order.study.fly(run).map_err(|why| why.to_string())?;
            self.rows.push(row);
            return Ok(Advance::More);
        }
        emit(JobEvent::of_figures(&self.rows)?);
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl Order for StudyShardOrder {
    const URGENCY: Urgency = Urgency::Slow;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(FlownRuns {
            order: self,
            rows: Vec::new(),
        })
    }
}

#[cfg(test)]
mod tests {
    use pilotage_study::StudyPlan;

    use super::*;
    use crate::running::figures;

    #[test]
    fn a_piece_has_the_rows_that_its_runs_have_by_themselves() {
        let plan = r#"
            name = "test"
            question = "?"
            draws = 3
            fixed = { seconds = 5, step = 0.2 }
            cross.vehicle = ["airplane-wind", "airplane-full"]
            measure = [{ of = "error-rms" }, { of = "frames-used" }]
        "#;
        let study = Arc::new(Study::new(StudyPlan::read(plan).unwrap()).unwrap());
        let rows: Vec<StudyRow> = figures(StudyShardOrder {
            study: Arc::clone(&study),
            runs: 2..5,
        });
        let alone: Vec<StudyRow> = [2, 3, 4].map(|run| study.fly(run).unwrap()).into();
        assert_eq!(rows, alone);
        assert_ne!(rows[0].measured, rows[1].measured);
    }
}
