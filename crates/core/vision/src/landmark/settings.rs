//! Settings of the template detector.

use serde::{Deserialize, Serialize};

/// How a landmark's map patch is looked for and when the answer is refused.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TemplateSettings {
    /// Least correlation score of an accepted peak, 0 to 1.
    pub least_score: f64,
    /// Greatest ratio of the second-best peak to the best.
    pub greatest_ambiguity: f64,
    /// Half-width of the search region in standard deviations of the predicted place.
    pub search_sigmas: f64,
    /// Most rotation tried on either side, radians.
    pub rotation_range: f64,
    /// Most scale tried on either side, as a fraction.
    pub scale_range: f64,
}

impl Default for TemplateSettings {
    fn default() -> Self {
        Self {
            least_score: 0.45,
            greatest_ambiguity: 0.85,
            search_sigmas: 3.5,
            rotation_range: 3.0_f64.to_radians(),
            scale_range: 0.03,
        }
    }
}
