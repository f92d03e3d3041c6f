//! Commands about trainings.

/// Commands about trainings.
#[derive(Clone, Debug, PartialEq)]
pub enum TrainCommand {
    /// Train detectors for these landmarks.
    Start(Vec<u32>),
    /// For those that are marked.
    Selected,
    /// For every landmark that is switched on and has none yet; for all of them if none is left.
    All,
    /// Number of photos that each learns from.
    Photos(usize),
    /// Let the training of a landmark, or every one, keep its place.
    Pause(Option<u32>),
    /// Go on.
    Resume(Option<u32>),
    /// Stop for good and forget what was done.
    Cancel(Option<u32>),
}
