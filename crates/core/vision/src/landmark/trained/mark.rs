//! A place at which a cascade finds its landmark.

use pilotage_base::frames::GroundPoint;

/// A place at which a cascade finds its landmark.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// Middle of the window on the ground under the assumed pose.
    pub ground: GroundPoint,
    /// Score of the fit: for a window that passed every stage the sum of what it passed them by, at least
    /// zero; below, a whole number less for each stage that it did not come to.
    pub score: f64,
    /// Stages passed.
    pub stages: usize,
    /// Whether the window is one of the outermost that were looked at and lie whole in the picture: one
    /// beside it may fit better.
    pub at_edge: bool,
    /// Turn in which it was found, radians clockwise.
    pub rotation: f64,
    /// Logarithm of the size in which it was found.
    pub log_scale: f64,
}
