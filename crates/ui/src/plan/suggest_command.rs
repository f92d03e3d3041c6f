//! What people can ask of proposed landmarks.

/// What people can ask of proposals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SuggestCommand {
    /// How many to propose.
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
