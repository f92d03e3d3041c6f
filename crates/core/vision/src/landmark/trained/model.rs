//! A trained detector as data.

use serde::{Deserialize, Serialize};

use super::{Likelihood, MarkPrecision, Variants};
use crate::landmark::cascade::Cascade;
use pilotage_base::frames::GroundRect;

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
    /// The turns and sizes in which the ground is shown in it.
    #[serde(default)]
    pub variants: Variants,
}

impl DetectorWindow {
    /// For a box on the ground that is seen from where a pixel of the camera covers `camera_gsd` metres.
    ///
    /// ```
    /// use pilotage_base::frames::{GroundPoint, GroundRect};
    /// use pilotage_vision::landmark::trained::{DetectorWindow, Variants};
    ///
    /// // The longer side of the box gets 32 pixels.
    /// let bounds = GroundRect::centered(GroundPoint::new(0.0, 0.0), 16.0, 64.0);
    /// let window = DetectorWindow::around(&bounds, 0.5, Variants::default());
    /// assert_eq!((window.gsd, window.width), (2.0, 32));
    /// // Never less than 12 pixels.
    /// assert_eq!(window.height, 12);
    /// ```
    pub fn around(bounds: &GroundRect, camera_gsd: f64, variants: Variants) -> Self {
        let longer = bounds.width().max(bounds.height());
        let gsd = (longer / LONGER).max(camera_gsd);
        let pixels = |metres: f64| ((metres / gsd).round() as usize).max(SHORTEST);
        Self {
            gsd,
            width: pixels(bounds.width()),
            height: pixels(bounds.height()),
            variants,
        }
    }

    /// Distance beside the landmark up to which a window may be taken for it, north and east, metres: nothing
    /// is learned from windows so near.
    pub fn beside(&self) -> (f64, f64) {
        let reach = |side: usize| (side as f64 / 3.0).floor() * self.gsd;
        (reach(self.height), reach(self.width))
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
    /// Likelihood that a mark is right, by its score.
    pub likelihood: Likelihood,
    /// Precision of right marks in place, turn and size.
    pub precision: MarkPrecision,
    /// Likelihood by the score of the landmark's map patch, on the same held-out pictures; nothing where it
    /// was not looked for.
    #[serde(default)]
    pub template: Option<TemplateLikelihood>,
}

/// Likelihood by the score of a landmark's map patch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TemplateLikelihood {
    /// Log odds of being right, by the score.
    pub likelihood: Likelihood,
    /// Log odds of being right of all places that it was learned from.
    pub before: f64,
}

impl TemplateLikelihood {
    /// Learned from scores and whether they were right.
    pub fn learned(places: &[(f64, bool)]) -> Option<Self> {
        let right = places.iter().filter(|p| p.1).count() as f64;
        let wrong = places.len() as f64 - right;
        (!places.is_empty()).then(|| Self {
            likelihood: Likelihood::fit(places),
            before: ((right + 1.0) / (wrong + 1.0)).ln(),
        })
    }

    /// Log of how much likelier the score is of the landmark than of something else.
    pub fn log_ratio(&self, score: f64) -> f64 {
        self.likelihood.log_odds(score) - self.before
    }
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
