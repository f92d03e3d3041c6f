//! `pilotage train`: a detector for each landmark, from the map alone.

use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

use pilotage_core::flight::{FrameSource as _, read_flight};
use pilotage_core::landmark::cascade::train::FeatureKind;
use pilotage_core::landmark::trained::{Preparation, TrainedDetector};
use pilotage_core::landmark::{DetectorChoice, Landmark};
use pilotage_core::mission::write_mission;
use pilotage_core::training::evaluation::AtThreshold;
use pilotage_core::training::{
    DetectorTraining, FlightEnvelope, Photo, Photos, StageReport, TrainingPlan, labelled_photos,
};
use serde::Serialize;

use crate::Outcome;
use crate::files::{Directory, write_whole};
use crate::plan::{Ground, Source};

/// Arguments of `pilotage train`.
#[derive(clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    source: Source,
    /// Only the landmarks with these names; all that are switched on if none is named.
    #[arg(long)]
    landmark: Vec<String>,
    /// Features of the cascades: hog, lbp, haar or tilted-haar.
    #[arg(long, default_value = "hog")]
    features: String,
    /// Photos that each learns from.
    #[arg(long, default_value_t = TrainingPlan::default().photos)]
    positives: usize,
    /// Windows of something else that each stage learns from.
    #[arg(long, default_value_t = TrainingPlan::default().negatives)]
    negatives: usize,
    /// Photos on other days that each is judged by.
    #[arg(long, default_value_t = TrainingPlan::default().held_out)]
    held_out: usize,
    /// Greatest error of the heading on either side, degrees; 5 or what the mission's sensors make of it
    /// if not said.
    #[arg(long)]
    heading_error: Option<f64>,
    /// Show the pictures as they are, neither rectified nor turned, to compare with.
    #[arg(long)]
    plain: bool,
    /// Greatest bank or pitch angle, degrees.
    #[arg(long, default_value_t = 15.0)]
    tilt: f64,
    /// Detector that the mission shall use for them: template, cascade or both.
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
struct Row {
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
pub fn run(arguments: &Arguments) -> Outcome {
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
    let mut ground = Ground::at(&arguments.source)?;
    for name in &arguments.landmark {
        if !ground.mission.landmarks.iter().any(|l| l.name == *name) {
            return Err(format!("--landmark: the mission has none called \"{name}\"").into());
        }
    }
    let wanted = |l: &&Landmark| match arguments.landmark.as_slice() {
        [] => l.enabled,
        names => names.contains(&l.name),
    };
    let landmarks: Vec<Landmark> = ground
        .mission
        .landmarks
        .iter()
        .filter(wanted)
        .cloned()
        .collect();
    let sensors = ground.mission.navigator.sensors;
    let usual = FlightEnvelope::around(&ground.camera, ground.height, sensors);
    let heading_error = arguments.heading_error.map(f64::to_radians);
    let envelope = FlightEnvelope {
        heading_error: heading_error.unwrap_or(usual.heading_error),
        tilt: arguments.tilt.to_radians(),
        ..usual
    };
    let plan = TrainingPlan {
        kind,
        photos: arguments.positives,
        negatives: arguments.negatives,
        held_out: arguments.held_out,
        template: ground.mission.navigator.detector,
        preparation: if arguments.plain {
            Preparation::Plain
        } else {
            Preparation::Rectified
        },
        seed: arguments.seed,
        ..TrainingPlan::default()
    };
    let labelled = labelled(arguments, &ground, &landmarks)?;
    let done = train_all(&ground, &landmarks, labelled, &envelope, &plan);
    let mut rows = Vec::new();
    for (landmark, result) in landmarks.iter().zip(done) {
        let (row, trained) = result?;
        print(&row);
        rows.push(row);
        if let Some(folder) = &arguments.out {
            std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
            let path = folder.join(format!("{}.xml", landmark.name));
            write_whole(&path, trained.cascade.to_xml())?;
        }
        let kept = ground
            .mission
            .landmarks
            .iter_mut()
            .find(|l| l.id == landmark.id);
        if let Some(kept) = kept {
            kept.keep_trained(Some(&trained));
            kept.choose_detector(choice);
        }
    }
    if let Some(path) = &arguments.write_mission {
        write_whole(path, write_mission(&ground.mission))?;
    }
    if let Some(path) = &arguments.summary {
        write_whole(path, serde_json::to_vec_pretty(&rows)?)?;
    }
    Ok(())
}

type Trained = Result<(Row, TrainedDetector), String>;

/// Frames of the flight in which people labelled each landmark.
fn labelled(
    arguments: &Arguments,
    ground: &Ground,
    landmarks: &[Landmark],
) -> Result<Vec<Vec<Photo>>, Box<dyn std::error::Error>> {
    let labels = &ground.mission.labels;
    let Some(path) = arguments
        .source
        .flight
        .as_ref()
        .filter(|_| !labels.is_empty())
    else {
        return Ok(landmarks.iter().map(|_| Vec::new()).collect());
    };
    let folder = read_flight(Arc::new(Directory::open(path)?))?;
    let (flight, mut frames) = (folder.flight, folder.frames);
    let photos = |landmark| labelled_photos(&flight, labels, landmark, |i| frames.picture(i));
    Ok(landmarks.iter().map(photos).collect::<Result<_, _>>()?)
}

/// Trains one landmark after the other on every core.
fn train_all(
    ground: &Ground,
    landmarks: &[Landmark],
    labelled: Vec<Vec<Photo>>,
    envelope: &FlightEnvelope,
    plan: &TrainingPlan,
) -> Vec<Trained> {
    let next = AtomicUsize::new(0);
    let labelled = Mutex::new(labelled);
    let workers = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let work = || {
        let mut done = Vec::new();
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            let Some(landmark) = landmarks.get(number) else {
                return done;
            };
            let photos = labelled
                .lock()
                .map_or_else(|_| Vec::new(), |mut all| std::mem::take(&mut all[number]));
            // The last may have a core to itself, which takes the photos that it is judged by.
            let is_core_free = number + 1 == landmarks.len() && number.is_multiple_of(workers);
            let trained = train(
                ground,
                landmark,
                photos,
                envelope,
                plan.clone(),
                is_core_free,
            );
            done.push((number, trained));
        }
    };
    let mut all: Vec<(usize, Trained)> = std::thread::scope(|scope| {
        let handles: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
        let done = handles.into_iter().map(|h| h.join().unwrap_or_default());
        done.flatten().collect()
    });
    all.sort_by_key(|(number, _)| *number);
    all.into_iter().map(|(_, trained)| trained).collect()
}

/// The same photos, taken by a thread of their own.
fn elsewhere(photos: Photos) -> Photos {
    let (send, receive) = std::sync::mpsc::channel();
    std::thread::spawn(move || {
        for photo in photos {
            if send.send(photo).is_err() {
                break;
            }
        }
    });
    Box::new(receive.into_iter())
}

fn train(
    ground: &Ground,
    landmark: &Landmark,
    labelled: Vec<Photo>,
    envelope: &FlightEnvelope,
    plan: TrainingPlan,
    is_core_free: bool,
) -> Trained {
    let begun = std::time::Instant::now();
    let days = ground.days.as_ref();
    let mut training =
        DetectorTraining::new(landmark, &ground.map, days, envelope, plan).with_labelled(labelled);
    if is_core_free {
        training = training.with_held_out(elsewhere);
    }
    let mut stages = 0;
    while training.advance().map_err(|e| e.to_string())? {
        if training.reports().len() > stages {
            stages = training.reports().len();
            eprintln!("{}: stage {stages}", landmark.name);
        }
    }
    let trained = training.trained().ok_or("the training came to no end")?;
    let judged = AtThreshold::over(training.looks(), trained.least_score);
    let row = Row {
        landmark: landmark.name.clone(),
        seconds: begun.elapsed().as_secs_f64(),
        stages: training.reports().to_vec(),
        judged: judged.found.of,
        found: judged.found.happened,
        false_alarms: judged.deceived.happened,
        sigma_north_m: trained.precision.covariance[(0, 0)].sqrt(),
        sigma_east_m: trained.precision.covariance[(1, 1)].sqrt(),
    };
    Ok((row, trained))
}

fn print(row: &Row) {
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
