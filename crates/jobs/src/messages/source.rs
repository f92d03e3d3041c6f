//! Sources of flights.

use pilotage_core::simulate::{
    FlightDay, Overrides, SimulationChoice, WORLDS, Wind, World, is_small_world,
};
use serde::{Deserialize, Serialize};

use super::map_source::MapSource;
use super::rehearsed_flight::RehearsedFlight;
use super::studied_flight::StudiedFlight;

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

    /// The world that it is flown in.
    pub fn world(&self) -> &'static dyn World {
        SimulationChoice::named(&self.scenario).map_or(WORLDS[0], |choice| choice.world)
    }

    /// The map that it is flown by.
    ///
    /// ```
    /// use pilotage_jobs::{MapSource, SimulationOptions};
    ///
    /// let hall = SimulationOptions { scenario: "indoor-hall".to_owned(), ..SimulationOptions::demo() };
    /// assert_eq!(hall.map(), MapSource::world("hall"));
    /// ```
    pub fn map(&self) -> MapSource {
        MapSource::world(self.world().key())
    }

    /// Day on which the pictures are taken.
    pub fn day(&self) -> FlightDay {
        if self.other_day {
            FlightDay::Other
        } else {
            FlightDay::Same
        }
    }

    /// Values that it has otherwise than its scenario.
    pub fn overrides(&self) -> Overrides {
        Overrides {
            wind: self.wind.map(|(from, speed)| Wind { from, speed }),
            height: self.height,
            day: Some(self.day()),
            ..Overrides::default()
        }
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
    /// A planned route, flown in the simulation.
    Rehearsed(Box<RehearsedFlight>),
    /// A flight of a study, flown once more.
    Studied(Box<StudiedFlight>),
}

impl FlightSource {
    /// Options of the built-in flight that it is, if it is one.
    pub fn simulation(&self) -> Option<&SimulationOptions> {
        match self {
            Self::Simulated(options) => Some(options),
            _ => None,
        }
    }

    /// Seed of what an estimator draws over it: that of a simulated flight, so that several differ in it as well.
    pub fn estimator_seed(&self) -> u64 {
        self.simulation().map_or(1, |options| options.seed)
    }

    /// Key of the files that it is made from, if it is.
    pub fn key(&self) -> Option<&str> {
        match self {
            Self::Files(key) => Some(key),
            Self::Rehearsed(flight) => flight.map.key(),
            Self::Simulated(_) | Self::Studied(_) | Self::Nothing => None,
        }
    }

    /// Whether it is flown by no mission but its own: a study flew a copy, and its flight is to be the same to the bit.
    pub fn has_own_mission(&self) -> bool {
        matches!(self, Self::Studied(it) if it.flight.mission.is_some())
    }

    /// Whether the small program opens it.
    pub fn is_small(&self) -> bool {
        match self {
            Self::Simulated(options) => is_small_world(options.world().key()),
            Self::Rehearsed(flight) => flight.map.is_small(),
            Self::Nothing => true,
            Self::Files(_) | Self::Studied(_) => false,
        }
    }
}
