//! Sources of maps and flights.

use pilotage_core::frames::Geodetic;
use pilotage_core::imagery::Georeference;
use pilotage_core::simulate::IndoorHall;
use serde::{Deserialize, Serialize};

use super::WebMap;

/// Options of a built-in scenario that the user may change.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SimulationOptions {
    /// Scenario name.
    pub scenario: String,
    /// Seed of all noise.
    pub seed: u64,
    /// Whether the camera sees another day than the map.
    pub other_day: bool,
    /// Direction the wind comes from, radians, and its speed, m/s; the scenario's own if `None`.
    pub wind: Option<(f64, f64)>,
    /// Height above ground, metres; the scenario's own if `None`.
    pub height: Option<f64>,
}

impl SimulationOptions {
    /// The built-in demo.
    pub fn demo() -> Self {
        Self {
            scenario: "distinct-400ft-wind".into(),
            seed: 1,
            other_day: true,
            wind: None,
            height: None,
        }
    }

    /// Whether it is the flight in the hall.
    pub fn is_indoors(&self) -> bool {
        self.scenario == IndoorHall::NAME
    }

    /// The map that it is flown by.
    pub fn map(&self) -> MapSource {
        if self.is_indoors() {
            MapSource::Hall
        } else {
            MapSource::Scenery
        }
    }
}

/// Source of a map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum MapSource {
    /// The generated scenery that the built-in scenarios use as their map.
    Scenery,
    /// Files that the page gave to the worker under this key (see [`crate::ProvideOrder`]).
    Files(String),
    /// The map among files of this key, put into the world frame around an origin.
    Placed {
        /// Key of the files.
        key: String,
        /// Origin of the world frame.
        origin: Geodetic,
    },
    /// A picture among files of this key whose place is known better than by the files.
    Picture {
        /// Key of the files.
        key: String,
        /// The picture.
        name: String,
        /// Origin of the world frame; its own if `None`.
        origin: Option<Geodetic>,
        /// Georeference of the picture's pixels.
        place: Georeference,
    },
    /// Tiles of the web.
    Web(WebMap),
    /// No map.
    Nothing,
    /// The drawing of the floor of the hall.
    Hall,
}

impl MapSource {
    /// Whether the program has it without any file.
    pub fn is_built_in(&self) -> bool {
        matches!(self, Self::Scenery | Self::Hall | Self::Nothing)
    }

    /// Key of the files that it is made from, if it is.
    pub fn key(&self) -> Option<&str> {
        match self {
            Self::Scenery | Self::Hall | Self::Web(_) | Self::Nothing => None,
            Self::Files(key) | Self::Placed { key, .. } | Self::Picture { key, .. } => Some(key),
        }
    }

    /// Origin of the world frame it was put into, if one was given.
    pub fn origin(&self) -> Option<Geodetic> {
        match self {
            Self::Placed { origin, .. } => Some(*origin),
            Self::Picture { origin, .. } => *origin,
            Self::Web(map) => Some(map.origin),
            Self::Scenery | Self::Hall | Self::Files(_) | Self::Nothing => None,
        }
    }

    /// The same map in the world around another origin, if it can be put there.
    #[must_use]
    pub fn moved(&self, to: Geodetic) -> Self {
        let mut moved = self.clone();
        match &mut moved {
            Self::Placed { origin, .. } => *origin = to,
            Self::Picture { origin, .. } => *origin = Some(to),
            Self::Web(map) => map.origin = to,
            Self::Scenery | Self::Hall | Self::Files(_) | Self::Nothing => {}
        }
        moved
    }
}

/// Source of a flight.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum FlightSource {
    /// A simulated flight.
    Simulated(SimulationOptions),
    /// Files that the page gave to the worker under this key.
    Files(String),
    /// Nothing is flown.
    Nothing,
}

impl FlightSource {
    /// Key of the files that it is made from, if it is.
    pub fn key(&self) -> Option<&str> {
        match self {
            Self::Files(key) => Some(key),
            Self::Simulated(_) | Self::Nothing => None,
        }
    }

    /// Whether the program has it without any file.
    pub fn is_built_in(&self) -> bool {
        matches!(self, Self::Simulated(_) | Self::Nothing)
    }
}
