//! `pilotage plan --suggest`: places of the map that would serve as landmarks.

use std::sync::Arc;

use pilotage_core::frames::GroundPoint;
use pilotage_core::plan::{FieldView, Proposal, ProposalQuestion, Suggestion};

use super::arguments::Arguments;
use super::ground::Ground;

/// The places of the map as landmarks are proposed from them, rehearsed; all over the map or only along
/// the route.
pub fn rehearsed(
    arguments: &Arguments,
    ground: &Ground,
    all_over: bool,
) -> Result<Proposal, Box<dyn std::error::Error>> {
    let plan = ground.plan.as_ref().filter(|_| !all_over);
    let settings = &ground.mission.navigator;
    let first = ground
        .mission
        .routes
        .first()
        .and_then(|r| r.way_points.first());
    let cruise = plan.map_or(1.0, |p| p.airframe.cruise);
    let mut proposal = Proposal::new(ProposalQuestion {
        map: Arc::clone(&ground.map),
        days: Proposal::days(ground.days.as_ref(), arguments.seed),
        view: FieldView {
            camera: ground.camera.clone(),
            height: ground.height,
            position: arguments.position,
            tilt: settings.sensors.roll.max(settings.sensors.pitch),
        },
        way_points: plan.map_or_else(Vec::new, |p| p.way_points.clone()),
        speed: first.and_then(|w| w.speed).unwrap_or(cruise),
        ground_down: plan.map_or(0.0, |p| p.ground_down),
        navigator: settings.clone(),
        side: arguments.side,
        taken: Vec::new(),
    })
    .ok_or("the camera does not see the ground")?;
    let begun = std::time::Instant::now();
    let (_, places) = proposal.progress();
    while proposal.advance() {
        let (done, _) = proposal.progress();
        if done % 500 == 0 {
            eprintln!(
                "{:3} %  {done} of {places} places",
                100 * done / places.max(1)
            );
        }
    }
    eprintln!(
        "{places} places of {:.0} m rehearsed, {:.1} s",
        proposal.side(),
        begun.elapsed().as_secs_f64()
    );
    Ok(proposal)
}

pub fn suggest(
    arguments: &Arguments,
    ground: &Ground,
    count: usize,
) -> Result<Vec<Suggestion>, Box<dyn std::error::Error>> {
    let chosen = rehearsed(arguments, ground, false)?.chosen(count);
    if chosen.is_empty() {
        return Err(
            "no place of the map is distinct enough; try another --side or --height".into(),
        );
    }
    for (suggestion, number) in chosen.iter().zip(1..) {
        let GroundPoint { north, east } = suggestion.candidate.bounds.center();
        println!(
            "{number:3}  north {north:7.1} m  east {east:7.1} m  {}",
            suggestion.reason
        );
    }
    Ok(chosen)
}
