//! Simulated flights over the generated scenery.

use std::sync::Arc;

use pilotage_core::imagery::Imagery;
use pilotage_core::simulate::{FlightDay, Overrides, Scenario, Wind};

use super::SimulationOptions;
use super::flights::{KeptFrames, OpenFlight};

/// The map of the built-in scenarios.
pub fn scenery_map() -> Arc<dyn Imagery> {
    Arc::new(Scenario::map())
}

/// Flies a scenario; pictures are taken when they are asked for.
pub fn open(options: &SimulationOptions) -> Result<OpenFlight, String> {
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
    let simulated = scenario.simulate(options.seed, &overrides);
    Ok(OpenFlight {
        frames: KeptFrames::rendered(&simulated.flight, Box::new(simulated.frames)),
        flight: Arc::new(simulated.flight),
        mission: Some(scenario.mission()),
    })
}
