//! Findings in a run, and those of the features about its flight.

use pilotage_core::flight::Flight;
use pilotage_core::flight::overview::Finding;
use pilotage_core::navigator::{Run, passed_over};

/// Findings in a run, and those of the features about its flight.
#[derive(Clone, Debug, Default)]
pub struct Noticed {
    /// The generation of the run.
    run: Option<u64>,
    findings: Vec<Finding>,
    of_features: Vec<Finding>,
}

impl Noticed {
    /// Whether the run of that generation was looked over.
    pub fn is_of(&self, generation: u64) -> bool {
        self.run == Some(generation)
    }

    /// Looks over a run, and what its aids did not look at of the flight.
    pub fn look_over(&mut self, run: &Run, flight: Option<&Flight>, generation: u64) {
        self.run = Some(generation);
        self.findings = run.findings();
        let unseen = flight.map(|flight| passed_over(flight, run));
        self.findings.extend(unseen.into_iter().flatten());
    }

    /// Takes what the features found; whether that is something else than before.
    pub fn take_found(&mut self, found: Vec<Finding>) -> bool {
        let is_other = self.of_features != found;
        self.of_features = found;
        is_other
    }

    /// Findings of the features, then those in the run of that generation, once that was looked over.
    pub fn of(&self, generation: u64) -> Vec<Finding> {
        let of_run = self.findings.iter().filter(|_| self.is_of(generation));
        self.of_features.iter().chain(of_run).cloned().collect()
    }
}
