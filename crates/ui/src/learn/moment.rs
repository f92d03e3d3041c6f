//! A moment of a run that a stop of the tour tells of.

use pilotage_core::navigator::Run;

/// A moment of the run, with two sentences on it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TourMoment {
    /// Index of the step.
    pub index: usize,
    /// Its time, seconds.
    pub time: f64,
    /// Begin of the stretch of time that the stop is about, seconds.
    pub from: f64,
    /// Its end, seconds.
    pub until: f64,
    /// The landmark it is about.
    pub landmark: Option<u32>,
    /// Words on what is to be seen, with the numbers of this run.
    pub text: String,
}

impl TourMoment {
    pub(super) fn new(run: &Run, index: usize, text: String) -> Self {
        let time = run.steps[index].time;
        Self {
            index,
            time,
            from: time,
            until: time,
            landmark: None,
            text,
        }
    }

    pub(super) fn landmark(mut self, landmark: Option<u32>) -> Self {
        self.landmark = landmark;
        self
    }

    pub(super) fn until(mut self, until: f64) -> Self {
        self.until = until;
        self
    }

    pub(super) fn from(mut self, from: f64) -> Self {
        self.from = from;
        self
    }
}
