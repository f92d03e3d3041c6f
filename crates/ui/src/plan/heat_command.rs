//! Preferences and commands of the heat map.

use pilotage_core::plan::Proposal;
use pilotage_jobs::FixesFrom;
use serde::{Deserialize, Serialize};

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
    pub of: FixesFrom,
}

impl Default for HeatPreferences {
    fn default() -> Self {
        Self {
            shown: false,
            blind: false,
            opacity: 0.6,
            position: Proposal::POSITION,
            of: FixesFrom::default(),
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
