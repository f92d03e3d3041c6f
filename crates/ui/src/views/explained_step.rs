//! Landmark in a step of one run: what an explanation is of.

/// Landmark in a step of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExplainedStep {
    /// Generation of the run: another run of the flight has the same steps and landmarks.
    pub run: u64,
    /// Time of the step, seconds in the flight's time base.
    pub time: f64,
    /// Landmark id.
    pub landmark: u32,
}

impl ExplainedStep {
    /// Whether it is this landmark in the step at this time, seconds in the flight's time base.
    pub fn is(&self, time: f64, landmark: u32) -> bool {
        self.time == time && self.landmark == landmark
    }
}
