//! Parts of the column at the right while planning.

/// What the column at the right shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PlanTab {
    /// Routes, legs and prediction.
    #[default]
    Route,
    /// Landmarks and how well they are found.
    Landmarks,
    /// Where fixes would be had, no-fly areas, and finding a route.
    Ground,
}
