//! Ground of a plan, as its arguments name it.

use pilotage_core::frames::GroundPoint;
use pilotage_core::plan::random_route;
use pilotage_core::simulate::Wind;

use super::arguments::Arguments;
use super::planned_flight::PlannedFlight;
use crate::notes::told_ground;
use crate::numbers::numbers;

/// Opens the ground that the arguments of a plan name.
pub fn ground_of(arguments: &Arguments) -> Result<PlannedFlight, Box<dyn std::error::Error>> {
    let mut ground = told_ground(PlannedFlight::at(&arguments.source.to_source())?);
    if let Some(plan) = ground
        .plan
        .as_mut()
        .filter(|_| arguments.source.scenario.is_some())
    {
        if let Some(text) = &arguments.route {
            plan.path.way_points = way_points(text, "--route")?;
        }
        if let Some(seed) = arguments.random_route {
            plan.path.way_points = random_route(seed);
            plan.path.wind = Wind::default();
        }
    }
    Ok(ground)
}

/// Way-points as an option states them.
pub fn way_points(text: &str, option: &str) -> Result<Vec<GroundPoint>, String> {
    let place = |pair: &str| {
        let [north, east] = numbers(pair, option)?;
        Ok(GroundPoint::new(north, east))
    };
    let places: Result<_, String> = text.split(';').map(place).collect();
    places.map_err(|_| format!("{option}: \"{text}\" is not NORTH,EAST;NORTH,EAST;…"))
}
