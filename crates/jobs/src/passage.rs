//! A flight on its way through the navigator.

use pilotage_core::flight::FrameSource;
use pilotage_core::navigator::{Navigator, Run};

use super::running::SLICE;

/// A navigator on its way, and the run so far.
pub struct Passage {
    navigator: Navigator,
    run: Run,
}

impl Passage {
    /// Nothing flown yet.
    pub fn new(navigator: Navigator) -> Self {
        Self {
            run: navigator.run_head(),
            navigator,
        }
    }

    /// Steps for about a slice of `clock` (milliseconds); whether there are more.
    ///
    /// # Errors
    /// Why it cannot be navigated on, in words.
    pub fn advance(
        &mut self,
        frames: &mut dyn FrameSource,
        clock: &dyn Fn() -> f64,
    ) -> Result<bool, String> {
        let begun = clock();
        while clock() - begun < SLICE {
            match self.navigator.advance(frames, clock) {
                Some(step) => {
                    let step = step.map_err(|cause| cause.to_string())?;
                    self.run.steps.push(step);
                }
                None => return Ok(false),
            }
        }
        Ok(true)
    }

    /// Share of the flight that is over, 0 to 1.
    pub fn progress(&self) -> f32 {
        let (done, all) = self.navigator.progress();
        done as f32 / all.max(1) as f32
    }

    /// The run, as far as it went.
    pub fn into_run(self) -> Run {
        self.run
    }
}
