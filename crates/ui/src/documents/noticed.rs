//! Findings in a run.

use pilotage_core::flight::overview::Finding;
use pilotage_core::navigator::Run;

/// Findings in a run.
#[derive(Clone, Debug, Default)]
pub struct Noticed {
    /// The generation of the run.
    run: Option<u64>,
    findings: Vec<Finding>,
}

impl Noticed {
    /// Whether the run of that generation was looked over.
    pub fn is_of(&self, generation: u64) -> bool {
        self.run == Some(generation)
    }

    /// Looks over a run.
    pub fn look_over(&mut self, run: &Run, generation: u64) {
        *self = Self {
            run: Some(generation),
            findings: run.findings(),
        };
    }

    /// Findings in the run of that generation; empty while it was not looked over.
    pub fn of(&self, generation: u64) -> &[Finding] {
        if self.is_of(generation) {
            &self.findings
        } else {
            &[]
        }
    }
}
