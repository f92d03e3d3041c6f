//! The generated country as a world: the scenarios fly over it.

use std::sync::Arc;

use super::flight_day::FlightDay;
use super::flight_frames::SimulatedFlight;
use super::scenario::{Overrides, Scenario};
use super::scenery::Scenery;
use super::sensors::SensorSpec;
use super::world::{LaidWorld, LayOut, SimulationChoice, World};
use pilotage_base::frames::GroundPoint;
use pilotage_mission::mission::Mission;
use pilotage_mission::settings::NavigatorSettings;
use pilotage_raster::imagery::{CachedImagery, Imagery};

/// Memory for tiles of the ground under a flight on the map's own day.
const CACHE_MEGABYTES: usize = 32;

/// The generated country.
#[derive(Debug)]
pub(super) struct Countryside;

impl World for Countryside {
    fn key(&self) -> &'static str {
        "countryside"
    }

    fn place(&self) -> &'static str {
        "the generated country"
    }

    fn flights(&self) -> Vec<SimulationChoice> {
        Scenario::all().iter().map(choice).collect()
    }

    fn navigator(&self, flight: &str) -> NavigatorSettings {
        let sensors = SensorSpec::default();
        let settings = Scenario::named(flight).map(|scenario| scenario.navigator(&sensors));
        settings.unwrap_or_default()
    }

    fn route(&self, flight: &str) -> Option<Vec<GroundPoint>> {
        Some(Scenario::named(flight)?.route)
    }

    fn is_variable(&self) -> bool {
        true
    }

    fn is_shown_whole(&self) -> bool {
        false
    }
}

impl LayOut for Countryside {
    fn lay_out(&self) -> Arc<dyn LaidWorld> {
        Arc::new(LaidCountry(Scenario::map()))
    }
}

fn choice(scenario: &Scenario) -> SimulationChoice {
    SimulationChoice {
        name: scenario.name,
        title: scenario.title,
        description: scenario.description,
        height: scenario.height,
        wind: scenario.wind,
        world: &Countryside,
    }
}

/// Its scenery on the map's day.
struct LaidCountry(Scenery);

impl LaidWorld for LaidCountry {
    fn map(&self) -> Arc<dyn Imagery> {
        Arc::new(self.0.clone())
    }

    fn scenery(&self) -> Option<Scenery> {
        Some(self.0.clone())
    }

    fn fly(&self, flight: &str, seed: u64, overrides: &Overrides) -> Option<SimulatedFlight> {
        let mut simulated = Scenario::named(flight)?.simulate(seed, overrides);
        simulated.frames = if simulated.day == FlightDay::Same {
            let ground = CachedImagery::new(self.map(), CACHE_MEGABYTES);
            simulated.frames.over(Arc::new(ground))
        } else {
            // Laid out with the first picture: until then, the map and its tiles are on screen already.
            simulated.frames.over_ground(self.0.clone())
        };
        Some(simulated)
    }

    fn missions(&self, flight: &str, overrides: &Overrides) -> Vec<(&'static str, Mission)> {
        let Some(scenario) = Scenario::named(flight) else {
            return Vec::new();
        };
        let routes = choice(&scenario).route(overrides.height);
        let mission = Mission {
            routes: routes.into_iter().collect(),
            ..scenario.mission_over(&self.0)
        };
        vec![("mission.geojson", mission)]
    }
}
