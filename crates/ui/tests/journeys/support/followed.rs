//! Roads that the scripted worker finds between two places.

use pilotage_core::frames::GroundPoint;
use pilotage_jobs::{FollowRoadOrder, FollowedRoad, JobEvent};

/// A road of 6.24 m that leads 20 m to the north of the straight line.
pub fn followed(order: &FollowRoadOrder) -> [JobEvent; 2] {
    let [from, to] = order.ends;
    let north = 0.5 * (from.north + to.north) + 20.0;
    let middle = GroundPoint::new(north, 0.5 * (from.east + to.east));
    let road = FollowedRoad {
        course: vec![from, middle, to],
        width: Some(6.24),
        told: None,
    };
    let told = JobEvent::of_figures(&road).expect("figures");
    [told, JobEvent::Finished]
}
