//! Simulated flights over the generated scenery.

use std::sync::Arc;

use pilotage_core::imagery::CachedImagery;
use pilotage_core::simulate::scenery::Scenery;
use pilotage_core::simulate::{FlightDay, Overrides, Scenario, Wind};

use super::SimulationOptions;
use super::flights::{KeptFrames, OpenFlight};

/// Memory for tiles of the ground under a flight on the map's own day.
const CACHE_MEGABYTES: usize = 96;

/// Flies a scenario over `map`; pictures are taken when they are asked for.
pub fn open(options: &SimulationOptions, map: &Scenery) -> Result<OpenFlight, String> {
    let scenario = Scenario::named(&options.scenario).ok_or_else(|| {
        let known: Vec<_> = Scenario::all().iter().map(|s| s.name).collect();
        format!(
            "there is no scenario “{}”; there are {}",
            options.scenario,
            known.join(", ")
        )
    })?;
    let day = if options.other_day {
        FlightDay::Other
    } else {
        FlightDay::Same
    };
    let overrides = Overrides {
        wind: options.wind.map(|(from, speed)| Wind { from, speed }),
        height: options.height,
        day: Some(day),
        ..Overrides::default()
    };
    let mut simulated = scenario.simulate(options.seed, &overrides);
    simulated.frames = if day == FlightDay::Same {
        let ground = CachedImagery::new(Arc::new(map.clone()), CACHE_MEGABYTES);
        simulated.frames.over(Arc::new(ground))
    } else {
        // Laid out with the first picture: until then, the map and its tiles are on screen already.
        simulated.frames.over_ground(map.clone())
    };
    Ok(OpenFlight {
        frames: KeptFrames::rendered(&simulated.flight, Box::new(simulated.frames)),
        flight: Arc::new(simulated.flight),
        mission: Some(scenario.mission_over(map)),
    })
}
