//! A trained detector as data.

use nalgebra::Matrix2;
use serde::{Deserialize, Serialize};

use super::Likelihood;
use crate::frames::GroundRect;
use crate::landmark::cascade::Cascade;

/// Longer side of the window, pixels.
const LONGER: f64 = 32.0;
/// Shorter side at the least, pixels.
const SHORTEST: usize = 12;

/// The window in which a landmark is shown to its detector.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DetectorWindow {
    /// Metres per pixel.
    pub gsd: f64,
    /// Width, pixels.
    pub width: usize,
    /// Height, pixels.
    pub height: usize,
}

impl DetectorWindow {
    /// For a box on the ground that is seen from where a pixel of the camera covers `camera_gsd` metres.
    pub fn around(bounds: &GroundRect, camera_gsd: f64) -> Self {
        let longer = bounds.width().max(bounds.height());
        let gsd = (longer / LONGER).max(camera_gsd);
        let pixels = |metres: f64| ((metres / gsd).round() as usize).max(SHORTEST);
        Self {
            gsd,
            width: pixels(bounds.width()),
            height: pixels(bounds.height()),
        }
    }
}

/// A cascade trained for one landmark and what is known of how well it does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainedDetector {
    /// The cascade.
    #[serde(with = "as_text")]
    pub cascade: Cascade,
    /// The window that it is shown.
    pub window: DetectorWindow,
    /// The box it was trained for: it is of no use for another one.
    pub bounds: GroundRect,
    /// Score from which on a mark counts: that of the stated rate of false alarms.
    pub least_score: f64,
    /// How likely a mark is right, by its score.
    pub likelihood: Likelihood,
    /// Covariance of the places of right marks (north, east) on held-out pictures, m².
    pub covariance: Matrix2<f64>,
}

/// A cascade as base64 of its compact form.
mod as_text {
    use base64::Engine as _;
    use base64::engine::general_purpose::STANDARD;
    use serde::{Deserialize as _, Deserializer, Serializer, de};

    use super::Cascade;

    pub fn serialize<S: Serializer>(cascade: &Cascade, out: S) -> Result<S::Ok, S::Error> {
        out.serialize_str(&STANDARD.encode(cascade.to_bytes()))
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(source: D) -> Result<Cascade, D::Error> {
        let text = String::deserialize(source)?;
        let bytes = STANDARD.decode(text).map_err(de::Error::custom)?;
        Cascade::from_bytes(&bytes).map_err(de::Error::custom)
    }
}
