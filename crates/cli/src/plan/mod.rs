//! `pilotage plan`: suggest landmarks, predict the uncertainty along a route.

mod calibrate;
mod find;
mod ground;
mod verify;

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use pilotage_core::frames::GroundPoint;
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::write_mission;
use pilotage_core::plan::{
    Assessor, Circumstances, Envelope, EnvelopeSurvey, FieldView, PlannedLandmark, Prediction,
    PredictionRequest, Proposal, ProposalQuestion, Rehearsal, Reliability, Suggestion,
    Verification,
};
use serde::Serialize;

use ground::way_points;
pub use ground::{Ground, Source};

use crate::Outcome;
use crate::files::write_whole;

/// What to plan.
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    source: Source,
    /// Propose that many landmarks from the map alone.
    #[arg(long, value_name = "N")]
    suggest: Option<usize>,
    /// Side of the proposed boxes, metres; a third of the picture's shorter side on the ground if
    /// it is not stated.
    #[arg(long)]
    side: Option<f64>,
    /// Standard deviation of the position per axis, metres, when proposed landmarks are looked for:
    /// how far around them look-alikes count.
    #[arg(long, default_value_t = Proposal::POSITION)]
    position: f64,
    /// Predict the uncertainty along the route.
    #[arg(long)]
    predict: bool,
    /// Way-points instead of the scenario's: metres north and east, "0,0;400,300".
    #[arg(long, requires = "scenario", allow_hyphen_values = true)]
    route: Option<String>,
    /// A random route of that seed over the scenery instead of the scenario's, in a wind of which only
    /// is known what the filter is told to expect.
    #[arg(long, requires = "scenario", conflicts_with = "route")]
    random_route: Option<u64>,
    #[command(flatten)]
    find: find::FindArguments,
    /// Fly the plan with seeds A..B, B left out, over the generated scenery on another day, and compare
    /// the errors with the prediction.
    #[arg(long, requires_all = ["scenario", "predict"], value_name = "A..B")]
    fly: Option<String>,
    /// Fly without pictures: landmarks are found as often and as well as is expected of them.
    #[arg(long, requires = "fly")]
    as_stated: bool,
    /// Fly about that many passes over places of every quality on days that were not rehearsed, and
    /// compare how often they are found with what was said.
    #[arg(long, requires = "scenario", value_name = "PASSES")]
    calibrate: Option<usize>,
    /// Where to draw the reliability diagram, SVG.
    #[arg(long, requires = "calibrate")]
    diagram: Option<PathBuf>,
    /// Measure from which heights and with which tilts each landmark is found.
    #[arg(long)]
    envelope: bool,
    /// Standard deviation of the position (longer axis) that is accepted, metres.
    #[arg(long, default_value_t = 10.0)]
    limit: f64,
    /// Seed of rehearsal days and worlds.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write the mission, with the proposed landmarks instead of its own and the found route as its
    /// first.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Write the results as JSON.
    #[arg(long)]
    summary: Option<PathBuf>,
}

/// One sample of the summary.
#[derive(Serialize)]
struct Sample {
    distance_m: f64,
    sigma_major_m: f64,
    sigma_minor_m: f64,
    heading_of_major_deg: f64,
    corridor_across_m: f64,
    dead_reckoning_s: f64,
    p_detect: Vec<f64>,
}

#[derive(Serialize)]
struct Summary {
    /// Those that are switched on, in the order of every `p_detect`.
    landmarks: Vec<String>,
    suggestions: Vec<Suggestion>,
    found: Option<find::Found>,
    samples: Vec<Sample>,
    worst_stretch: Option<pilotage_core::plan::Stretch>,
    verification: Option<Verification>,
    reliability: Option<Reliability>,
    envelopes: Vec<Envelope>,
}

/// Plans what the arguments say.
pub fn run(arguments: &Arguments) -> Outcome {
    let mut ground = Ground::of(arguments)?;
    let mut summary = Summary {
        landmarks: Vec::new(),
        suggestions: Vec::new(),
        found: None,
        samples: Vec::new(),
        worst_stretch: None,
        verification: None,
        reliability: None,
        envelopes: Vec::new(),
    };
    if let Some(ends) = &arguments.find.find {
        summary.found = Some(find::find(arguments, &mut ground, ends)?);
    }
    if let Some(count) = arguments.suggest {
        summary.suggestions = suggest(arguments, &ground, count)?;
        let proposed = summary.suggestions.iter().zip(1..);
        ground.mission.landmarks = proposed
            .map(|(s, id)| Landmark::new(id, format!("suggestion {id}"), s.candidate.bounds))
            .collect();
    }
    if let Some(passes) = arguments.calibrate {
        let (reliability, _) = calibrate::calibrate(arguments, &ground, passes);
        if let Some(path) = &arguments.diagram {
            write_whole(path, reliability.svg())?;
        }
        summary.reliability = Some(reliability);
    }
    if arguments.envelope {
        summary.envelopes = envelopes(arguments, &ground);
    }
    if arguments.predict {
        let (prediction, landmarks) = predict(arguments, &ground)?;
        summary.worst_stretch = prediction.worst_stretch();
        summary.samples = prediction.samples.iter().map(sample).collect();
        if let Some((seeds, plan)) = arguments.fly.as_ref().zip(ground.plan.as_ref()) {
            let seeds = crate::replay::seed_range(seeds)?;
            let stated = arguments.as_stated.then_some(landmarks.as_slice());
            let found = verify::verify(&ground, plan, &prediction, seeds, stated)?;
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
    Ok(())
}

fn sample(s: &pilotage_core::plan::PredictionSample) -> Sample {
    Sample {
        distance_m: s.distance,
        sigma_major_m: s.corridor.sigma_major,
        sigma_minor_m: s.corridor.sigma_minor,
        heading_of_major_deg: s.corridor.heading_of_major.to_degrees(),
        corridor_across_m: s.corridor.across,
        dead_reckoning_s: s.dead_reckoning,
        p_detect: s.detection.clone(),
    }
}

/// The places of the map as landmarks are proposed from them, rehearsed; all over the map or only along
/// the route.
fn rehearsed(
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

fn suggest(
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

/// How landmarks are looked for on the plan.
fn circumstances(ground: &Ground) -> Circumstances {
    let settings = &ground.mission.navigator;
    Circumstances {
        camera: ground.camera.clone(),
        height: ground.height,
        position: Rehearsal::POSITION,
        sensors: settings.sensors,
        detector: settings.detector,
        ground_down: ground.plan.as_ref().map_or(0.0, |p| p.ground_down),
        tilt: 0.0,
    }
}

/// From which heights and with which tilts each landmark is found.
fn envelopes(arguments: &Arguments, ground: &Ground) -> Vec<Envelope> {
    let days = ground.days.spread(EnvelopeSurvey::DAYS, arguments.seed);
    let enabled = ground.mission.landmarks.iter().filter(|l| l.enabled);
    enabled
        .map(|landmark| {
            let map = Arc::clone(&ground.map);
            let assessor =
                Assessor::new(landmark, map, &days, circumstances(ground), arguments.seed);
            let mut survey = EnvelopeSurvey::usual(assessor);
            while survey.advance() {}
            let envelope = survey.envelope().clone();
            println!(
                "{}: height, then found of looks at tilts of {:?} degrees",
                landmark.name,
                EnvelopeSurvey::TILTS
            );
            for (row, height) in envelope.heights.iter().enumerate() {
                let cells = (0..envelope.tilts.len()).filter_map(|tilt| envelope.at(row, tilt));
                let cells: Vec<String> =
                    cells.map(|c| format!("{}/{}", c.found, c.looks)).collect();
                println!("{height:8.0} m  {}", cells.join("  "));
            }
            envelope
        })
        .collect()
}

/// Measures each landmark over the map.
fn expected(arguments: &Arguments, ground: &Ground, ground_down: f64) -> Vec<PlannedLandmark> {
    let days = Rehearsal::days(ground.days.as_ref(), arguments.seed);
    let mut landmarks = Vec::new();
    for landmark in ground.mission.landmarks.iter().filter(|l| l.enabled) {
        let circumstances = Circumstances {
            ground_down,
            ..circumstances(ground)
        };
        let map = Arc::clone(&ground.map);
        let begun = std::time::Instant::now();
        let mut assessor = Assessor::new(landmark, map, &days, circumstances, arguments.seed);
        assessor.rehearse();
        let expected = assessor.expected();
        println!(
            "{:24} found {}, false {:.3}, {:.1} s",
            landmark.name,
            expected.map_or_else(
                || "never: it does not fit into the picture".to_owned(),
                |e| format!("{:.2}", e.probability())
            ),
            assessor.false_matches(),
            begun.elapsed().as_secs_f64()
        );
        landmarks.push(PlannedLandmark {
            landmark: landmark.clone(),
            detection: assessor.statistics(),
        });
    }
    landmarks
}

/// Measures the landmarks and predicts.
fn predict(
    arguments: &Arguments,
    ground: &Ground,
) -> Result<(Prediction, Vec<PlannedLandmark>), Box<dyn std::error::Error>> {
    let plan = ground
        .plan
        .as_ref()
        .ok_or("the mission has no route to predict along")?;
    let settings = &ground.mission.navigator;
    let landmarks = expected(arguments, ground, plan.ground_down);
    let request = PredictionRequest {
        plan,
        settings,
        landmarks: &landmarks,
        wind_deviation: settings.start.wind,
        worlds: 100,
        seed: arguments.seed,
        limit: arguments.limit,
    };
    let begun = std::time::Instant::now();
    let prediction = request.predict()?;
    let largest = prediction
        .samples
        .iter()
        .map(|s| s.corridor.sigma_major)
        .fold(0.0, f64::max);
    println!(
        "{} frames, largest standard deviation {largest:.1} m, predicted in {:.2} s",
        prediction.samples.len(),
        begun.elapsed().as_secs_f64()
    );
    for stretch in &prediction.over_limit {
        println!(
            "over {:.0} m from {:.0} m to {:.0} m: up to {:.1} m at north {:.0} m east {:.0} m, after {:.0} s of dead reckoning",
            arguments.limit,
            stretch.begin,
            stretch.end,
            stretch.sigma,
            stretch.worst.north,
            stretch.worst.east,
            stretch.dead_reckoning
        );
    }
    Ok((prediction, landmarks))
}
