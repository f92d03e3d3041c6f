//! The run of the navigator that is shown.

use pilotage_core::navigator::Run;
use pilotage_jobs::MapSource;

use super::Noticed;

/// Run over the flight that is open, and the one before it.
#[derive(Debug, Default)]
pub struct RunDocument {
    /// The run so far.
    pub navigated: Option<Run>,
    /// Map over which it was flown: another one may have been opened since.
    pub over: Option<MapSource>,
    /// Whether it is complete.
    pub is_complete: bool,
    /// Counts runs, so that caches know when another one is shown.
    pub generation: u64,
    /// The run before the last change.
    pub ghost: Option<Run>,
    /// The ghost's generation.
    pub ghost_generation: u64,
    /// Findings in the run.
    pub noticed: Noticed,
}

impl RunDocument {
    /// Whether the run of a generation is no longer the one that is shown: what was found out of it is of a run before.
    pub fn is_before(&self, generation: u64) -> bool {
        self.generation != generation
    }

    /// Shows a run that begins over a map, or none.
    pub fn show(&mut self, head: Option<Run>, over: Option<MapSource>) {
        self.navigated = head;
        self.over = over;
        self.is_complete = false;
        self.generation += 1;
    }

    /// Makes the finished run the one before the change.
    pub fn haunt(&mut self) {
        if self.is_complete
            && let Some(old) = self.navigated.take()
        {
            self.ghost = Some(old);
            self.ghost_generation = self.generation;
        }
    }

    /// Forgets the runs of a flight that is left; the counters go on.
    pub fn leave(&mut self) {
        *self = Self {
            generation: self.generation + 1,
            ghost_generation: self.ghost_generation,
            ..Self::default()
        };
    }
}
