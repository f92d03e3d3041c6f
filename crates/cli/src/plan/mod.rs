//! `pilotage plan`: suggest landmarks, predict the uncertainty along a route.

mod arguments;
mod calibrate;
mod envelopes;
mod find;
mod ground;
mod no_fly;
pub mod propose;
mod source;
mod untested;
mod verify;

use pilotage_core::mission::write_mission;
use pilotage_core::plan::{Envelope, Reliability, Suggestion, UntestedDetection, Verification};
use serde::Serialize;

pub use arguments::Arguments;
use envelopes::envelopes;
use ground::ground_of;
pub use pilotage_disk::planned_flight::{PlanSource, PlannedFlight, above_ground};
pub use pilotage_disk::predict::predict;
use pilotage_disk::{landmarks, planned_flight};
use propose::suggest;
pub use source::SourceArguments;
pub use verify::fly;

use crate::CommandResult;
use crate::files::write_whole;

/// Sample of the summary.
#[derive(Serialize)]
struct SummarySample {
    distance_m: f64,
    sigma_major_m: f64,
    sigma_minor_m: f64,
    heading_of_major_deg: f64,
    corridor_across_m: f64,
    dead_reckoning_s: f64,
    p_detect: Vec<f64>,
}

#[derive(Serialize)]
struct PlanSummary {
    /// Those that are switched on, in the order of every `p_detect`.
    landmarks: Vec<String>,
    suggestions: Vec<Suggestion>,
    found: Option<find::BothRoutes>,
    samples: Vec<SummarySample>,
    worst_stretch: Option<pilotage_core::plan::Stretch>,
    verification: Option<Verification>,
    reliability: Option<Reliability>,
    envelopes: Vec<Envelope>,
    untested: Option<UntestedDetection>,
}

/// Plans what the arguments say.
pub fn run(arguments: &Arguments) -> CommandResult {
    let mut ground = ground_of(arguments)?;
    let mut summary = PlanSummary {
        landmarks: Vec::new(),
        suggestions: Vec::new(),
        found: None,
        samples: Vec::new(),
        worst_stretch: None,
        verification: None,
        reliability: None,
        envelopes: Vec::new(),
        untested: None,
    };
    if let Some(ends) = &arguments.find.find {
        summary.found = Some(find::find(arguments, &mut ground, ends)?);
    }
    if let Some(count) = arguments.suggest {
        if arguments.only_suggested {
            ground.mission.landmarks.clear();
        }
        summary.suggestions = suggest(arguments, &ground, count)?;
        let free = ground.mission.free_landmark_id();
        let proposed = summary.suggestions.iter().zip(free..);
        let proposed = proposed.map(|(suggestion, id)| suggestion.landmark(id));
        ground.mission.landmarks.extend(proposed);
    }
    if let Some(passes) = arguments.calibrate {
        let reliability = calibrate::calibrate(arguments, &ground, passes)?;
        if let Some(path) = &arguments.diagram {
            write_whole(path, reliability.svg())?;
        }
        summary.reliability = Some(reliability);
    }
    if arguments.measure.envelope {
        summary.envelopes = envelopes(arguments, &ground)?;
    }
    if arguments.measure.untested {
        summary.untested = Some(untested::untested(arguments, &ground)?);
    }
    no_fly::tell_legs(&ground);
    let mut flown = None;
    if arguments.predict {
        let (plan, prediction) = predict(&ground, arguments.seed, arguments.limit, &|line| {
            println!("{line}");
        })?;
        no_fly::tell_reached(&ground, &prediction);
        summary.worst_stretch = prediction.worst_stretch();
        summary.samples = prediction.samples.iter().map(sample).collect();
        if let Some(seeds) = &arguments.fly {
            let seeds = crate::scenario::seed_range(seeds)?;
            let (found, of_seeds) =
                verify::verify(&ground, &plan, &prediction, seeds, arguments.as_stated)?;
            flown = Some(of_seeds);
            println!(
                "{} flights, {} frames: {:.1} % inside the 95 % ellipse, {:.1} ± {:.1} % inside the corridor; \
                 error {:.2} m RMS where {:.2} m was predicted and the filter believed {:.2} m (NEES {:.2}), \
                 at most {:.1} m",
                found.flights,
                found.frames,
                100.0 * found.inside_ellipse,
                100.0 * found.inside_corridor,
                100.0 * found.corridor_uncertainty,
                found.rms_m,
                found.predicted_rms_m,
                found.believed_rms_m,
                found.mean_nees,
                found.largest_m
            );
            summary.verification = Some(found);
        }
    }
    summary.landmarks = ground
        .mission
        .landmarks
        .iter()
        .filter(|l| l.enabled)
        .map(|l| l.name.clone())
        .collect();
    if let Some(path) = &arguments.out {
        write_whole(path, write_mission(&ground.mission))?;
    }
    if let Some(path) = &arguments.summary {
        write_whole(path, serde_json::to_string_pretty(&summary)?)?;
    }
    flown.map_or(Ok(()), |flown| flown.all_done())
}

fn sample(s: &pilotage_core::plan::PredictionSample) -> SummarySample {
    SummarySample {
        distance_m: s.distance,
        sigma_major_m: s.corridor.sigma_major,
        sigma_minor_m: s.corridor.sigma_minor,
        heading_of_major_deg: s.corridor.heading_of_major.to_degrees(),
        corridor_across_m: s.corridor.across,
        dead_reckoning_s: s.dead_reckoning,
        p_detect: s.detection.clone(),
    }
}
