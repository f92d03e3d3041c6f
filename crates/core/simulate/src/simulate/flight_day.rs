//! The day of a flight, which need not be that of the map.

use serde::{Deserialize, Serialize};

use super::scenery::Day;

/// On which day the camera sees the ground; the map is always that of the map's day.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum FlightDay {
    /// The day on which the map was made.
    Same,
    /// Another season, light and haze, other cars and crops.
    #[default]
    Other,
    /// Late winter: bare trees, pale grass, a low sun.
    LateWinter,
    /// Early spring: first leaves, young crops.
    EarlySpring,
}

impl FlightDay {
    /// Name on the command line and in files.
    pub fn key(self) -> &'static str {
        match self {
            Self::Same => "same",
            Self::Other => "other",
            Self::LateWinter => "late-winter",
            Self::EarlySpring => "early-spring",
        }
    }

    /// The day of that name.
    pub fn named(name: &str) -> Option<Self> {
        [Self::Same, Self::Other, Self::LateWinter, Self::EarlySpring]
            .into_iter()
            .find(|day| day.key() == name)
    }

    /// Its light and season.
    pub fn day(self) -> Day {
        match self {
            Self::Same => Day::map_day(),
            Self::Other => Day::other_day(),
            Self::LateWinter => Day::late_winter(),
            Self::EarlySpring => Day::early_spring(),
        }
    }
}
