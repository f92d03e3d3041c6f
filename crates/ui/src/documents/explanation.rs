//! Explanation of a landmark in the run, asked of the workers.

use pilotage_jobs::{ExplainOrder, ExplainedBy, Job};

use super::Documents;

impl Documents {
    /// Job that explains a landmark in the step at `time`, seconds in the flight's time base; `None` if that has no
    /// picture.
    pub fn explanation(&self, by: ExplainedBy, time: f64, landmark: u32) -> Option<Job> {
        let step = self.run.as_ref()?.step_at(time)?;
        step.frame.as_ref()?;
        Some(Job::ExplainMatch(ExplainOrder {
            by,
            flight: self.flight_source.clone(),
            map: self.map_source.clone(),
            mission: self.mission.clone(),
            step: Box::new(step.clone()),
            landmark,
        }))
    }
}
