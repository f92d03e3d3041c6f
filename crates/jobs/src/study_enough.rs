//! Rule of a plan by which the flights of its study are enough.

use pilotage_study::{StudyDesign, StudyPlan, StudyPlanParts, StudyRow, StudyTally};
use serde::{Deserialize, Serialize};

use super::order::{Order, Urgency, WorkerRole};
use super::running::once;
use super::{JobEvent, RunningJob, WorkerState};

/// Numbers of all kinds ([`pilotage_study::StudyFlight::numbers`]) of the flights of a study from its first on. Event
/// `Figures` with the draws after which the plan's rule to stop says that it is enough (`Option<u64>`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudyEnoughOrder {
    /// The plan.
    pub plan: StudyPlanParts,
    /// Numbers by flight.
    pub numbers: Vec<Vec<Option<f64>>>,
}

impl Order for StudyEnoughOrder {
    const URGENCY: Urgency = Urgency::First;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |_, emit| {
            let plan = StudyPlan::from(self.plan);
            let measures = plan.measure.clone();
            let design = StudyDesign::new(plan);
            let mut tally = StudyTally::new(&design);
            for (run, numbers) in (0..).zip(&self.numbers) {
                let judged = measures.iter().map(|m| m.among(numbers));
                let measured = judged.collect();
                tally
                    .take(StudyRow { run, measured })
                    .map_err(|why| why.to_string())?;
            }
            emit(JobEvent::of_figures(&tally.enough_after())?);
            Ok(())
        })
    }
}

#[cfg(test)]
mod tests {
    use pilotage_study::MeasureKind;

    use super::*;
    use crate::running::figures;

    #[test]
    fn it_is_enough_where_the_terminal_stops() {
        let plan = StudyPlan::read(
            r#"
            name = "near"
            question = "How often?"
            draws = 100
            cross.vehicle = ["airplane-wind", "airplane-full"]
            measure = [{ of = "error-max", name = "near", at_most = 20 }]
            stop = { measure = "near", half_width = 0.12, every = 10 }
        "#,
        )
        .unwrap();
        // Errors of which every fourth passes the limit: a share of 0.75, whose interval is narrow enough after some 50.
        let of = |run: u64| {
            let largest = if (run / 2).is_multiple_of(4) {
                30.0
            } else {
                10.0
            };
            let number = |kind| (kind == MeasureKind::ErrorMax).then_some(largest);
            MeasureKind::ALL.map(number).to_vec()
        };
        let design = StudyDesign::new(plan.clone());
        let mut tally = StudyTally::new(&design);
        for run in 0..200 {
            let largest = MeasureKind::ErrorMax.among(&of(run));
            let measured = vec![plan.measure[0].judged(largest)];
            tally.take(StudyRow { run, measured }).unwrap();
        }
        let terminal = tally.summary();
        assert!(terminal.is_stopped && (40..=70).contains(&terminal.draws));
        let enough = |flights: u64| -> Option<u64> {
            figures(StudyEnoughOrder {
                plan: plan.clone().into(),
                numbers: (0..flights).map(of).collect(),
            })
        };
        assert_eq!(enough(2 * terminal.draws - 1), None);
        assert_eq!(enough(2 * terminal.draws), Some(terminal.draws));
        assert_eq!(
            enough(200),
            Some(terminal.draws),
            "what was flown beyond is left out"
        );
    }
}
