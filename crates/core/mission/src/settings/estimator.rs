//! Choice of the estimator that the navigator uses, and its settings for people.

use serde::{Deserialize, Serialize};

use pilotage_estimation::filter::ParticleSettings;

/// The estimators that work on the vehicle models, the registry of them: one line each here, and one
/// in `engine::engine`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum EstimatorChoice {
    /// The unscented Kalman filter (DeAngelo 2016, Table 3).
    #[default]
    Unscented,
    /// The extended Kalman filter.
    Extended,
    /// The regularised particle filter.
    Particles,
}

impl EstimatorChoice {
    /// Every choice, in the order in which people read them.
    pub const ALL: [Self; 3] = [Self::Unscented, Self::Extended, Self::Particles];

    /// Name in files and on the command line.
    pub fn key(self) -> &'static str {
        match self {
            Self::Unscented => "ukf",
            Self::Extended => "ekf",
            Self::Particles => "particle",
        }
    }

    /// The choice with this key.
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|choice| choice.key() == key)
    }

    /// Name for people.
    pub fn label(self) -> &'static str {
        match self {
            Self::Unscented => "Unscented Kalman filter",
            Self::Extended => "Extended Kalman filter",
            Self::Particles => "Particle filter",
        }
    }

    /// Description of the estimator, in a sentence.
    pub fn description(self) -> &'static str {
        match self {
            Self::Unscented => "Propagates sigma points through the models; assumes a Gaussian.",
            Self::Extended => {
                "Propagates the mean and the slopes of the models; assumes a Gaussian."
            }
            Self::Particles => {
                "Sends many random states through the models and believes in any distribution."
            }
        }
    }
}

/// The estimator and its settings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct EstimatorSettings {
    /// Kind of estimator.
    pub choice: EstimatorChoice,
    /// Settings of the particle filter; the others have theirs in the navigator's settings.
    pub particles: ParticleSettings,
}
