//! The plan of a study read from its text.

use pilotage_core::text::capitalised;
use pilotage_study::{StudyError, StudyPlan, StudyPlanParts};
use serde::{Deserialize, Serialize};

use super::order::{Order, Urgency, WorkerRole};
use super::running::once;
use super::{JobEvent, RunningJob, WorkerState};

/// Text of a plan to read, TOML: event `Figures` with a [`StudyPlanParts`], or `Failed` with why it cannot be followed and
/// where.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReadStudyPlanOrder {
    /// The text.
    pub text: String,
}

impl Order for ReadStudyPlanOrder {
    const URGENCY: Urgency = Urgency::First;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |_, emit| {
            let plan = StudyPlan::read(&self.text).map_err(|why| match why {
                StudyError::NoPlan(_) => capitalised(&why.to_string()),
                StudyError::Plan { .. } => format!("In the plan, {why}"),
            })?;
            emit(JobEvent::of_figures(&StudyPlanParts::from(plan))?);
            Ok(())
        })
    }
}

#[cfg(test)]
mod tests {
    use pilotage_study::SHIPPED_PLANS;

    use super::*;
    use crate::running::figures;

    #[test]
    fn every_plan_passes_from_the_worker_as_it_is() {
        let stops = r#"
            name = "stops"
            question = "When is it enough?"
            draws = 32
            fixed = { seconds = 20, vehicle = "airplane-wind" }
            draw.wind-speed = { normal = [4, 1] }
            draw.wind-from = { choice = [0, 90] }
            draw.step = { log-uniform = [0.1, 1] }
            measure = [{ of = "error-max", name = "within 20 m", at_most = 20 }]
            stop = { measure = "within 20 m", half_width = 0.01, every = 16 }
        "#;
        for text in SHIPPED_PLANS.into_iter().chain([stops]) {
            let plan = StudyPlan::read(text).unwrap();
            let text = text.to_owned();
            let parts: StudyPlanParts = figures(ReadStudyPlanOrder { text });
            assert_eq!(StudyPlan::from(parts), plan);
        }
    }
}
