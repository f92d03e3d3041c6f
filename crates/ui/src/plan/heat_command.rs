//! Sources of fixes, and preferences and commands of the heat map.

use pilotage_core::plan::Proposal;
use serde::{Deserialize, Serialize};

/// Sources of fixes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum HeatOf {
    /// The landmarks that are switched on.
    #[default]
    Landmarks,
    /// Whatever the map offers.
    Map,
}

/// Preferences of the heat map; remembered between visits.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct HeatPreferences {
    /// Whether it is shown.
    pub shown: bool,
    /// Whether only blind areas are marked.
    pub blind: bool,
    /// Opacity over the map, 0 to 1.
    pub opacity: f32,
    /// Standard deviation of the position that is assumed, metres.
    pub position: f64,
    /// Sources of fixes.
    pub of: HeatOf,
}

impl Default for HeatPreferences {
    fn default() -> Self {
        Self {
            shown: false,
            blind: false,
            opacity: 0.6,
            position: Proposal::POSITION,
            of: HeatOf::default(),
        }
    }
}

/// Commands of the heat map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HeatCommand {
    /// Show or hide it.
    Toggle,
    /// Mark blind areas only, or show the probability everywhere.
    ToggleBlind,
    /// Show it in another way.
    Set(HeatPreferences),
    /// Stop computing it; what is known stays.
    Stop,
    /// Compute it after all.
    Resume,
}
