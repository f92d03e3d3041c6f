//! Findings about the flight beside those of its log.

use pilotage_core::flight::overview::Finding;

use super::Documents;

impl Documents {
    /// Looks over the run if it is complete and was not looked over yet.
    pub fn tend_noticed(&mut self) {
        let is_known = self.run.noticed.is_of(self.run.generation);
        if let Some(run) = self
            .run
            .navigated
            .as_ref()
            .filter(|_| self.run.is_complete && !is_known)
        {
            let flight = self.flight.measured.as_ref();
            self.run.noticed.look_over(run, flight, self.run.generation);
        }
    }

    /// Findings of the features, then doubts of the navigator in the run that is shown.
    pub fn noticed(&self) -> Vec<Finding> {
        self.run.noticed.of(self.run.generation)
    }

    /// Takes what the features found about the flight; whether that is something else than before.
    pub fn take_found(&mut self, found: Vec<Finding>) -> bool {
        self.run.noticed.take_found(found)
    }
}
