//! Commands about proposed landmarks.

/// Commands about proposed landmarks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SuggestCommand {
    /// Number of landmarks to propose.
    Count(usize),
    /// Look for them.
    Start,
    /// Stop looking.
    Stop,
    /// Make landmarks of all, or of one of them.
    Add(Option<usize>),
    /// Forget them.
    Dismiss,
}
