//! Parts of the column at the right while planning.

/// Tab of the column at the right.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PlanTab {
    /// Routes, legs and prediction.
    #[default]
    Route,
    /// Landmarks and how well they are found.
    Landmarks,
    /// Heat map of the probability of a fix, no-fly areas, and finding a route.
    Ground,
}
