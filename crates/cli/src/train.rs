//! `pilotage train`: a detector for each landmark, from the map alone.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use pilotage_core::landmark::cascade::train::FeatureKind;
use pilotage_core::landmark::trained::Preparation;
use pilotage_core::landmark::{DetectorChoice, Landmark};
use pilotage_core::mission::write_mission;
use pilotage_core::plan::Proposal;
use pilotage_core::text::{distinct_names, plain_name};
use pilotage_core::training::{FlightEnvelope, StageReport, TrainingPlan};
use pilotage_jobs::{
    FlownCamera, JobEvent, LabelledFrames, OpenFlight, TrainOrder, TrainingOutcome,
};
use serde::Serialize;

use crate::CommandResult;
use crate::files::write_whole;
use crate::notes::{tell, told_ground};
use crate::numbers::{below_right_angle, count, zero_or_more};
use crate::outcome::all_done;
use crate::plan::{PlannedFlight, SourceArguments};
use crate::replaying::{FlightOnDisk, flight_at};
use crate::workers::{self, Lent};

/// Arguments of `pilotage train`.
#[derive(clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    source: SourceArguments,
    /// Only the landmarks with these names; if none is named, those that are switched on and have no detector, or all that
    /// are where each has one.
    #[arg(long)]
    landmark: Vec<String>,
    /// Features of the cascades: hog, lbp, haar or tilted-haar.
    #[arg(long, default_value = "hog")]
    features: String,
    /// Photos that each learns from.
    #[arg(long, default_value_t = TrainingPlan::default().photos, value_parser = count)]
    positives: usize,
    /// Windows of something else that each stage learns from.
    #[arg(long, default_value_t = TrainingPlan::default().negatives, value_parser = count)]
    negatives: usize,
    /// Photos on other days that each is judged by; 100, or as many as it learns from if those are fewer, if not said.
    #[arg(long)]
    held_out: Option<usize>,
    /// Greatest error of the heading on either side, degrees; 5 or what the mission's sensors make of it
    /// if not said.
    #[arg(long, value_parser = zero_or_more)]
    heading_error: Option<f64>,
    /// Show the pictures as they are, neither rectified nor turned, to compare with.
    #[arg(long)]
    plain: bool,
    /// Greatest bank or pitch angle, degrees; 15 if not said.
    #[arg(long, value_parser = below_right_angle)]
    tilt: Option<f64>,
    /// Detector that the mission shall use for them from now on: template, cascade or both.
    #[arg(long, default_value = "cascade")]
    detector: String,
    /// Draws photos, days and features.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Folder for each landmark's cascade as an OpenCV XML file.
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// File for the mission with the detectors in it.
    #[arg(long, value_name = "FILE")]
    write_mission: Option<PathBuf>,
    /// File for the course of the trainings, JSON.
    #[arg(long, value_name = "FILE")]
    summary: Option<PathBuf>,
}

/// Report of the training of one landmark.
#[derive(Serialize)]
struct TrainedRow {
    landmark: String,
    seconds: f64,
    stages: Vec<StageReport>,
    /// Held-out photos, and those in which it was found at the stated rate of false alarms.
    judged: usize,
    found: usize,
    false_alarms: usize,
    sigma_north_m: f64,
    sigma_east_m: f64,
}

/// Trains what the arguments say.
pub fn run(arguments: &Arguments) -> CommandResult {
    let kind = FeatureKind::ALL
        .into_iter()
        .find(|k| k.key() == arguments.features);
    let kind = kind.ok_or_else(|| {
        format!(
            "--features: \"{}\" is none of hog, lbp, haar, tilted-haar",
            arguments.features
        )
    })?;
    let choice = DetectorChoice::named(&arguments.detector).ok_or_else(|| {
        format!(
            "--detector: \"{}\" is none of template, cascade, both",
            arguments.detector
        )
    })?;
    let mut ground = told_ground(PlannedFlight::at(&arguments.source.to_source())?);
    for name in &arguments.landmark {
        if !ground.mission.landmarks.iter().any(|l| l.name == *name) {
            return Err(format!("--landmark: the mission has none called \"{name}\"").into());
        }
    }
    let landmarks: Vec<Landmark> = match arguments.landmark.as_slice() {
        [] => TrainOrder::wanted(&ground.mission).cloned().collect(),
        names => {
            let all = ground.mission.landmarks.iter();
            all.filter(|l| names.contains(&l.name)).cloned().collect()
        }
    };
    let usual = TrainOrder::usual_plan(&ground.mission, arguments.positives);
    let plan = TrainingPlan {
        kind,
        negatives: arguments.negatives,
        held_out: arguments.held_out.unwrap_or(usual.held_out),
        preparation: if arguments.plain {
            Preparation::Plain
        } else {
            Preparation::Rectified
        },
        seed: arguments.seed,
        ..usual
    };
    if landmarks.is_empty() {
        return Err("the mission has no landmark that is switched on".into());
    }
    let rows = train(arguments, &mut ground, &landmarks, &plan, choice)?;
    if let Some(path) = &arguments.write_mission {
        write_whole(path, write_mission(&ground.mission))?;
    }
    if let Some(path) = &arguments.summary {
        write_whole(path, serde_json::to_vec_pretty(&rows)?)?;
    }
    all_done(rows.len(), landmarks.len(), "landmarks", "trained")
}

/// Trains a detector for each of the landmarks, and keeps it with them; of those that cannot be trained it tells why.
fn train(
    arguments: &Arguments,
    ground: &mut PlannedFlight,
    landmarks: &[Landmark],
    plan: &TrainingPlan,
    choice: DetectorChoice,
) -> Result<Vec<TrainedRow>, Box<dyn std::error::Error>> {
    let mut lent = ground.lent();
    let labelled = labelled_flight(arguments.source.flight.as_ref(), ground)?.map(|folder| {
        lent = lent.clone().with_flight(&folder);
        LabelledFrames {
            flight: Lent::flight(),
            camera: FlownCamera::of(&ground.mission),
            labels: ground.mission.labels.clone(),
        }
    });
    let with = ground.circumstances(Proposal::POSITION);
    let order = |landmark: &Landmark| {
        let order = with.training(landmark, plan.clone(), labelled.clone());
        let usual = order.envelope();
        let heading_error = arguments.heading_error.map(f64::to_radians);
        let envelope = FlightEnvelope {
            heading_error: heading_error.unwrap_or(usual.heading_error),
            tilt: arguments.tilt.map_or(usual.tilt, f64::to_radians),
            ..usual
        };
        order.within(envelope)
    };
    let orders = landmarks.iter().map(order).collect();
    let (mut rows, mut stages) = (Vec::new(), 0);
    let mission = &mut ground.mission;
    let stems = mission.landmarks.iter().map(|it| plain_name(&it.name));
    let stems = distinct_names(stems, []);
    let ids = mission.landmarks.iter().map(|it| it.id);
    let stems: BTreeMap<u32, String> = ids.zip(stems).collect();
    workers::run(orders, &lent, &mut |number, event| {
        let name = &landmarks[number].name;
        match event {
            JobEvent::Failed(why) => {
                stages = 0;
                eprintln!("{name}: {why}");
            }
            JobEvent::Training(report) if report.stages.len() > stages => {
                stages = report.stages.len();
                eprintln!("{name}: stage {stages}");
            }
            JobEvent::Trained(outcome) => {
                stages = 0;
                let mut landmark = landmarks[number].clone();
                landmark.keep_trained_text(Some(&outcome.detector));
                if let Some(folder) = &arguments.out {
                    write_cascade(folder, &stems[&landmark.id], &landmark)?;
                }
                let kept = mission.landmarks.iter_mut().find(|l| l.id == landmark.id);
                let changed = kept.and_then(|kept| keep(kept, &outcome.detector, choice));
                let row = TrainedRow::of(name, *outcome);
                print(&row);
                if let Some(changed) = changed.filter(|_| arguments.write_mission.is_some()) {
                    println!("  {changed} (--detector template, cascade or both)");
                }
                rows.push(row);
            }
            _ => {}
        }
        Ok(())
    })?;
    Ok(rows)
}

/// Keeps the detector that was trained for a landmark, and by which it shall be looked for; says so where that is another than
/// before.
pub fn keep(landmark: &mut Landmark, trained: &str, choice: DetectorChoice) -> Option<String> {
    let before = landmark.detector_choice();
    landmark.keep_trained_text(Some(trained));
    landmark.choose_detector(choice);
    (choice != before).then(|| {
        format!(
            "the mission looks for \"{}\" by {} from now on, no longer by {}",
            landmark.name,
            choice.key(),
            before.key()
        )
    })
}

impl TrainedRow {
    fn of(landmark: &str, outcome: TrainingOutcome) -> Self {
        let [sigma_north_m, sigma_east_m] = outcome.sigmas;
        Self {
            landmark: landmark.to_owned(),
            seconds: outcome.seconds,
            stages: outcome.stages,
            judged: outcome.judged,
            found: outcome.found,
            false_alarms: outcome.false_alarms,
            sigma_north_m,
            sigma_east_m,
        }
    }
}

/// Writes the cascade of a landmark into a folder, which is made if missing, in a file of this name.
fn write_cascade(folder: &Path, stem: &str, landmark: &Landmark) -> Result<(), String> {
    let trained = landmark.trained_detector();
    let trained = trained.ok_or("the detector cannot be read back")?;
    std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let path = folder.join(format!("{stem}.xml"));
    write_whole(&path, trained.cascade.to_xml())
}

/// The flight in whose frames people labelled landmarks, if there is one.
pub fn labelled_flight(
    path: Option<&PathBuf>,
    ground: &PlannedFlight,
) -> Result<Option<OpenFlight>, Box<dyn std::error::Error>> {
    let Some(path) = path.filter(|_| !ground.mission.labels.is_empty()) else {
        return Ok(None);
    };
    let FlightOnDisk { open, notes, .. } = flight_at(path, None, None)?;
    tell(&notes);
    tell(&ground.mission.told_of_labels(&open.flight.identity()));
    Ok(Some(open))
}

fn print(row: &TrainedRow) {
    println!("{} ({:.1} s)", row.landmark, row.seconds);
    println!("  stage  votes  hit rate  false alarms  windows that came to it");
    for (number, stage) in row.stages.iter().enumerate() {
        println!(
            "  {:>5}  {:>5}  {:>8.4}  {:>12.4}  {:.2e}",
            number + 1,
            stage.row.votes,
            stage.row.hit_rate,
            stage.row.false_alarm_rate,
            stage.passed_before
        );
    }
    println!(
        "  found in {} of {} held-out photos, {} false alarms, ± {:.2} m north, {:.2} m east",
        row.found, row.judged, row.false_alarms, row.sigma_north_m, row.sigma_east_m
    );
}
