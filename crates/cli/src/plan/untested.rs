//! `pilotage plan --untested`: what a landmark is worth on the map that nobody tested.

use pilotage_core::plan::{Proposal, UntestedDetection};
use pilotage_jobs::{JobEvent, UntestedOrder};

use super::arguments::Arguments;
use super::planned_flight::PlannedFlight;
use crate::workers;

/// Looks at boxes anywhere around the route, or all over the map, and says how often they are found.
pub fn untested(
    arguments: &Arguments,
    ground: &PlannedFlight,
) -> Result<UntestedDetection, String> {
    let mission = &ground.mission;
    let drawn = || UntestedOrder::usual_side(mission);
    let usual = || Proposal::usual_side(&ground.circumstances(arguments.position).view());
    let side = arguments.side.or_else(drawn).or_else(usual);
    let side = side.ok_or("the camera does not look down at the ground")?;
    let like = ground.assessment(&UntestedOrder::usual_box(side), arguments.seed);
    let plan = ground.plan.as_ref();
    let places = plan.map_or_else(Vec::new, |plan| plan.path.way_points.clone());
    let order = UntestedOrder::of(mission, like, &ground.map.bounds(), places);
    let begun = std::time::Instant::now();
    let mut found = None;
    workers::run(vec![order], &ground.lent(), &mut |_, event| {
        match event {
            JobEvent::Failed(why) => return Err(why),
            JobEvent::Untested(told) => found = Some(*told),
            _ => {}
        }
        Ok(())
    })?;
    let found = found.ok_or("nothing came of it")?;
    println!(
        "{} boxes at random, {side:.0} m wide, seen from {:.0} m: recognised on {:.0} % of days, and then found in \
         {:.0} % of frames: {:.0} % in all; {:.1} s",
        found.boxes,
        ground.height,
        100.0 * found.expected.recognised,
        100.0 * found.expected.per_frame,
        100.0 * found.expected.probability(),
        begun.elapsed().as_secs_f64()
    );
    Ok(found)
}
