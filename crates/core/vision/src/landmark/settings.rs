//! Settings of the template detector.

use serde::{Deserialize, Serialize};

/// Features of a landmark's map patch that are compared with the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TemplateFeatures {
    /// Brightness and edges: exact where the map shows the ground as the camera sees it.
    #[default]
    Brightness,
    /// Orientation fields, which tell where edges run and how, judged by probability: for maps of another
    /// date or sensor.
    Orientation,
}

impl TemplateFeatures {
    /// Every choice, in the order in which people read them.
    pub const ALL: [Self; 2] = [Self::Brightness, Self::Orientation];

    /// Name in files and on the command line.
    pub fn key(self) -> &'static str {
        match self {
            Self::Brightness => "brightness",
            Self::Orientation => "orientation",
        }
    }

    /// The choice of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|choice| choice.key() == name)
    }
}

/// Settings of the search for a landmark's map patch, and of the refusal of its answer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TemplateSettings {
    /// Features that are compared; files that say nothing mean brightness.
    #[serde(default)]
    pub features: TemplateFeatures,
    /// Standard deviation of the map's own place per axis, metres: of satellite and aerial maps some 3, of an
    /// orthophoto made by the flight itself near 0.
    #[serde(default)]
    pub map_deviation: f64,
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
            features: TemplateFeatures::default(),
            map_deviation: 0.0,
            least_score: 0.45,
            greatest_ambiguity: 0.85,
            search_sigmas: 3.5,
            rotation_range: 3.0_f64.to_radians(),
            scale_range: 0.03,
        }
    }
}
