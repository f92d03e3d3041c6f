//! `pilotage plan --suggest`: places of the map that would serve as landmarks.

use pilotage_core::frames::GroundPoint;
use pilotage_core::plan::{LandmarkCandidate, Suggestion};
use pilotage_jobs::{JobEvent, ProposeOrder, Share, ShareOrder, SuggestOrder};

use super::arguments::Arguments;
use super::planned_flight::PlannedFlight;
use crate::workers::{self, Lent};

/// Shares in which places are rehearsed: as many as most machines have processors.
const SHARES: usize = 8;

/// Order of `count` landmarks, where the position is known to `position` metres per axis.
pub fn proposal(ground: &PlannedFlight, position: f64, count: usize) -> SuggestOrder {
    let plan = ground.plan.as_ref();
    let places = plan.map_or_else(Vec::new, |plan| plan.path.way_points.clone());
    let route = ground.mission.routes.first();
    let with = ground.circumstances(position);
    with.proposal(&ground.mission.landmarks, route, places, count)
}

fn order(arguments: &Arguments, ground: &PlannedFlight, count: usize) -> SuggestOrder {
    let order = proposal(ground, arguments.position, count);
    SuggestOrder {
        side: arguments.side,
        seed: arguments.seed.unwrap_or(order.seed),
        ..order
    }
}

/// Proposes landmarks along the route, or all over the map where there is none.
pub fn suggest(
    arguments: &Arguments,
    ground: &PlannedFlight,
    count: usize,
) -> Result<Vec<Suggestion>, Box<dyn std::error::Error>> {
    let order = Box::new(order(arguments, ground, count));
    let lent = ground.lent();
    let begun = std::time::Instant::now();
    let share = |part| ShareOrder(order.clone(), Share { part, of: SHARES });
    let (mut found, mut told) = (Vec::new(), 0);
    workers::run(
        (0..SHARES).map(share).collect(),
        &lent,
        &mut |part, event| {
            match event {
                JobEvent::Failed(why) => return Err(why),
                JobEvent::Candidates(_, mut some) => found.append(&mut some),
                JobEvent::Progress(done, _) => {
                    let percent = (100.0 * (part as f32 + done) / SHARES as f32) as usize;
                    if percent / 10 > told {
                        told = percent / 10;
                        eprintln!("{percent:3} % of the places");
                    }
                }
                _ => {}
            }
            Ok(())
        },
    )?;
    eprintln!(
        "places rehearsed: {} of them would do, {:.1} s",
        found.len(),
        begun.elapsed().as_secs_f64()
    );
    let chosen = choose(order, found, &lent)?;
    print!("{}", list(&chosen));
    Ok(chosen)
}

/// The landmarks chosen among all places that passed.
pub fn choose(
    order: Box<SuggestOrder>,
    found: Vec<LandmarkCandidate>,
    lent: &Lent,
) -> Result<Vec<Suggestion>, Box<dyn std::error::Error>> {
    let mut chosen = Vec::new();
    workers::run(vec![ProposeOrder(order, found)], lent, &mut |_, event| {
        match event {
            JobEvent::Failed(why) => return Err(why),
            JobEvent::Suggestions(suggestions) => chosen = suggestions,
            _ => {}
        }
        Ok(())
    })?;
    if chosen.is_empty() {
        return Err(
            "no place of the map is distinct enough; try another --side or --height".into(),
        );
    }
    Ok(chosen)
}

/// Lines on the landmarks that are proposed.
pub fn list(chosen: &[Suggestion]) -> String {
    let lines = chosen.iter().zip(1..).map(|(suggestion, number)| {
        let GroundPoint { north, east } = suggestion.candidate.bounds.center();
        format!(
            "{number:3}  north {north:7.1} m  east {east:7.1} m  {}\n",
            suggestion.reason
        )
    });
    lines.collect()
}
