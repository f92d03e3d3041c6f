//! Ground of a plan, as its arguments name it.

use pilotage_core::frames::GroundPoint;
use pilotage_core::plan::random_route;
use pilotage_core::simulate::Wind;

use super::arguments::Arguments;
use super::planned_flight::PlannedFlight;
use crate::notes::tell;

/// Opens the ground that the arguments of a plan name.
pub fn ground_of(arguments: &Arguments) -> Result<PlannedFlight, Box<dyn std::error::Error>> {
    let mut ground = PlannedFlight::at(&arguments.source.to_source())?;
    tell(&ground.notes);
    if let Some(plan) = ground
        .plan
        .as_mut()
        .filter(|_| arguments.source.scenario.is_some())
    {
        if let Some(text) = &arguments.route {
            plan.path.way_points = way_points(text)?;
        }
        if let Some(seed) = arguments.random_route {
            plan.path.way_points = random_route(seed);
            plan.path.wind = Wind::default();
        }
    }
    Ok(ground)
}

/// Way-points as `--route` states them.
pub fn way_points(text: &str) -> Result<Vec<GroundPoint>, String> {
    text.split(';')
        .map(|pair| {
            let (north, east) = pair.split_once(',')?;
            let number = |t: &str| t.trim().parse().ok();
            Some(GroundPoint::new(number(north)?, number(east)?))
        })
        .collect::<Option<_>>()
        .ok_or_else(|| format!("--route: \"{text}\" is not NORTH,EAST;NORTH,EAST;…"))
}
