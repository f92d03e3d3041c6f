//! No-fly areas of the mission that the planned route leads over, or its corridor reaches into.

use pilotage_core::plan::{RoutePrediction, reached_zones};

use super::planned_flight::PlannedFlight;

fn metres(distance: f64) -> String {
    format!("{distance:.0} m")
}

/// Prints the legs of the plan that lead over no-fly areas.
pub fn tell_legs(ground: &PlannedFlight) {
    let zones = &ground.mission.no_fly;
    for found in ground.way.incursions(zones) {
        println!("{}", found.sentence(&zones[found.zone].name, &metres));
    }
}

/// Prints where the predicted corridor reaches into no-fly areas.
pub fn tell_reached(ground: &PlannedFlight, prediction: &RoutePrediction) {
    let zones = &ground.mission.no_fly;
    for found in reached_zones(&prediction.samples, zones) {
        println!("{}", found.sentence(&zones[found.zone].name, &metres));
    }
}
