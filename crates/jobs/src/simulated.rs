//! Simulated flights over the generated scenery.

use std::sync::Arc;

use pilotage_core::frames::{Altitude, AltitudeFrame};
use pilotage_core::imagery::CachedImagery;
use pilotage_core::mission::{Mission, Route, WayPoint};
use pilotage_core::navigator::VehicleChoice;
use pilotage_core::simulate::scenery::Scenery;
use pilotage_core::simulate::{FlightDay, IndoorHall, Overrides, Scenario, SimulationChoice, Wind};

use super::SimulationOptions;
use super::flights::{KeptFrames, OpenFlight};

/// Memory for tiles of the ground under a flight on the map's own day.
const CACHE_MEGABYTES: usize = 32;

/// The scenario of these options.
fn scenario(options: &SimulationOptions) -> Result<Scenario, String> {
    Scenario::named(&options.scenario).ok_or_else(|| {
        let known: Vec<_> = SimulationChoice::all().iter().map(|c| c.name).collect();
        format!(
            "there is no scenario “{}”; there are {}",
            options.scenario,
            known.join(", ")
        )
    })
}

/// The route of a scenario, as people plan one.
pub fn scenario_route(options: &SimulationOptions) -> Result<Route, String> {
    let scenario = scenario(options)?;
    let height = options.height.unwrap_or(scenario.height);
    let altitude = Altitude::new(height, AltitudeFrame::AboveGround);
    Ok(Route {
        id: 1,
        name: "Route of the flight".to_owned(),
        way_points: scenario
            .route
            .iter()
            .map(|place| WayPoint::new(*place, altitude))
            .collect(),
        ..Route::default()
    })
}

/// The mean wind of a simulated flight.
pub fn scenario_wind(options: &SimulationOptions) -> Wind {
    let stated = options.wind.map(|(from, speed)| Wind { from, speed });
    stated
        .or_else(|| Some(SimulationChoice::named(&options.scenario)?.wind))
        .unwrap_or_default()
}

/// Flies in the hall.
pub fn open_hall(options: &SimulationOptions) -> OpenFlight {
    let hall = IndoorHall::default();
    let simulated = hall.simulate(options.seed);
    OpenFlight {
        frames: KeptFrames::rendered(&simulated.flight, Box::new(simulated.frames)),
        flight: Arc::new(simulated.flight),
        mission: Some(hall.mission(VehicleChoice::Multirotor)),
    }
}

/// Flies a scenario over `map`; pictures are taken when they are asked for.
pub fn open(options: &SimulationOptions, map: &Scenery) -> Result<OpenFlight, String> {
    let scenario = scenario(options)?;
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
        mission: Some(Mission {
            routes: vec![scenario_route(options)?],
            ..scenario.mission_over(map)
        }),
    })
}
