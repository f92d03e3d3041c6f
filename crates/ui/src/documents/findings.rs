//! Findings of a run about the flight, beside those of its log.

use pilotage_core::flight::overview::Finding;

use super::Documents;

impl Documents {
    /// Looks over the run if it is complete and was not looked over yet.
    pub fn tend_noticed(&mut self) {
        let is_known = self.noticed.is_of(self.run_generation);
        if let Some(run) = self.run.as_ref().filter(|_| self.run_complete && !is_known) {
            self.noticed.look_over(run, self.run_generation);
        }
    }

    /// Doubts of the navigator in the run that is shown.
    pub fn noticed(&self) -> &[Finding] {
        self.noticed.of(self.run_generation)
    }
}
