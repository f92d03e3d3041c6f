//! The process noise that the thesis prints.

use serde::{Deserialize, Serialize};

use pilotage_base::frames::units::METRES_PER_FOOT;

/// Process noise per step, whatever its length, as in DeAngelo 2016, Table 4.
///
/// | | position, ft² | wind, (ft/s)² |
/// |---|---|---|
/// | distinct landmarks | 9 | 0.2 |
/// | road localization | 9 | 4 |
/// | generic landmarks | 400 | 1 |
/// | wind from GPS | 400 | 0.4 |
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ThesisNoise {
    /// Landmarks of their own kind.
    #[default]
    DistinctLandmarks,
    /// Fixes on a road between landmarks.
    RoadLocalization,
    /// Landmarks of a class.
    GenericLandmarks,
    /// Wind from GPS positions.
    WindFromGps,
}

impl ThesisNoise {
    /// Variance of each position component per step, m².
    pub fn position_variance(self) -> f64 {
        let square_feet = match self {
            Self::DistinctLandmarks | Self::RoadLocalization => 9.0,
            Self::GenericLandmarks | Self::WindFromGps => 400.0,
        };
        square_feet * METRES_PER_FOOT * METRES_PER_FOOT
    }

    /// Variance of each wind component per step, (m/s)².
    pub fn wind_variance(self) -> f64 {
        let square_feet_per_second = match self {
            Self::DistinctLandmarks => 0.2,
            Self::RoadLocalization => 4.0,
            Self::GenericLandmarks => 1.0,
            Self::WindFromGps => 0.4,
        };
        square_feet_per_second * METRES_PER_FOOT * METRES_PER_FOOT
    }
}
