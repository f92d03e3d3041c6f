//! What a run and its pictures say of the flight, beside what its log says.

use pilotage_core::alignment::camera_findings;
use pilotage_core::flight::overview::Finding;

use super::Documents;

/// What was noticed in a run.
#[derive(Clone, Debug, Default)]
pub struct Noticed {
    /// The generation of the run.
    run: Option<u64>,
    findings: Vec<Finding>,
}

impl Documents {
    /// Looks over the run if it is complete and was not looked over yet.
    pub fn tend_noticed(&mut self) {
        let is_known = self.noticed.run == Some(self.run_generation);
        if let Some(run) = self.run.as_ref().filter(|_| self.run_complete && !is_known) {
            self.noticed = Noticed {
                run: Some(self.run_generation),
                findings: run.findings(),
            };
        }
    }

    /// What the pictures say of the camera as it is flown, and what the navigator doubted in the run that is shown.
    pub fn noticed(&self) -> Vec<Finding> {
        let left = self.camera_log.left();
        let mut all = left.map_or_else(Vec::new, |left| camera_findings(&left));
        if self.noticed.run == Some(self.run_generation) {
            all.extend_from_slice(&self.noticed.findings);
        }
        all
    }
}
