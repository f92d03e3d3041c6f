//! The pictures that explain a match.

use pilotage_core::flight::FrameSource as _;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{StepReport, explain};

use super::{FlightSource, MapSource, MatchPictures, Workshop};

/// Looks at a past step again.
pub fn match_pictures(
    workshop: &mut Workshop,
    flight: &FlightSource,
    map: &MapSource,
    mission: &Mission,
    step: &StepReport,
    landmark: u32,
) -> Result<MatchPictures, String> {
    let map = workshop.map(map)?;
    let open = workshop.flight(flight)?;
    let mut open = open.borrow_mut();
    let index = step
        .frame
        .as_ref()
        .ok_or("this step has no camera picture")?
        .index;
    let picture = open.frames.picture(index).map_err(|e| e.to_string())?;
    let marked = mission
        .landmark(landmark)
        .ok_or("the landmark is no longer in the mission")?;
    let settings = &mission.navigator;
    let evidence = explain(&open.flight, map, settings, marked, step, &picture)
        .ok_or("the landmark was not looked for in this picture")?
        .map_err(|refusal| format!("{}: {}", marked.name, refusal.reason()))?;
    let mut peaks = evidence.peaks.into_iter();
    Ok(MatchPictures {
        time: step.time,
        landmark,
        patch: evidence.patch,
        rectified: evidence.rectified,
        surface: evidence.surface,
        peak: peaks.next(),
        second: peaks.next(),
        gsd: evidence.gsd,
    })
}
