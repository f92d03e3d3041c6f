//! The selected landmark compared with the map around it: when, and by which job.

use pilotage_core::frames::GroundRect;
use pilotage_jobs::JobId;

/// Comparison of the selected landmark with the map around it.
#[derive(Debug, Default)]
pub struct Examination {
    /// Job under way, and its landmark.
    pub job: Option<(JobId, u32)>,
    /// The landmark that was selected last, and its box.
    pub seen: Option<(u32, GroundRect)>,
    /// When to begin, milliseconds of the host's clock.
    pub at: Option<f64>,
}
