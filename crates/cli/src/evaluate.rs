//! `pilotage evaluate`: trained detectors on pictures that they were not trained on.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use pilotage_core::landmark::Landmark;
use pilotage_core::text::{distinct_names, in_quotes, plain_name};
use pilotage_jobs::{EvaluationOrder, EvaluationReport, FlownCamera, JobEvent, JudgedDetector};

use crate::CommandResult;
use crate::files::write_whole;
use crate::outcome::all_done;
use crate::plan::{PlannedFlight, SourceArguments};
use crate::replaying::flight_at;
use crate::workers::{self, Lent};

/// Most photos, and days on which they are taken: each is kept in memory.
const MOST: i64 = 1_000_000;
/// Time between two words on a judging.
const TOLD_EVERY: Duration = Duration::from_secs(2);

/// Arguments of `pilotage evaluate`.
#[derive(clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    source: SourceArguments,
    /// Landmark whose detector is evaluated, by its name or its id; may be said again. Every landmark with
    /// a detector if absent.
    #[arg(long, value_name = "NAME")]
    landmark: Vec<String>,
    /// A flight folder with its truth: its frames are looked at as well, but for those in which the mission has the landmark
    /// labelled and those that show mostly the same ground.
    #[arg(long, value_name = "FLIGHT_FOLDER")]
    frames: Option<PathBuf>,
    /// Most frames of the flight, evenly spread; as many as in the page, 200, if not said.
    #[arg(long, value_name = "N", requires = "frames", value_parser = clap::value_parser!(u32).range(1..=MOST))]
    most_frames: Option<u32>,
    /// Photos of each landmark; as many as in the page if not said.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(10..=MOST))]
    photos: Option<u32>,
    /// Days on which they are taken; as many as in the page if not said.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=MOST))]
    days: Option<u32>,
    /// False alarms per photo at which detections are told; 0.01 if not said.
    #[arg(long, value_name = "RATE")]
    false_alarms: Option<f64>,
    /// Seed of photos and days, never those of a training; that of the page if not said.
    #[arg(long)]
    seed: Option<u64>,
    /// Write every figure as one table.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Folder for the plots.
    #[arg(long, value_name = "FOLDER")]
    svg: Option<PathBuf>,
    /// Write everything as JSON.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

impl Arguments {
    /// The order with the amounts that are stated, and those of the page where none is.
    fn amounts(&self, usual: EvaluationOrder) -> EvaluationOrder {
        let stated = |stated: Option<u32>, usual| stated.map_or(usual, |count| count as usize);
        EvaluationOrder {
            photos: stated(self.photos, usual.photos),
            days: stated(self.days, usual.days),
            seed: self.seed.unwrap_or(usual.seed),
            most_frames: stated(self.most_frames, usual.most_frames),
            false_alarms: self.false_alarms.unwrap_or(usual.false_alarms),
            ..usual
        }
    }
}

/// Evaluates the landmarks.
pub fn run(arguments: &Arguments) -> CommandResult {
    let stated = arguments.false_alarms;
    if let Some(stated) = stated.filter(|rate| !(*rate >= 0.0 && rate.is_finite())) {
        return Err(format!("--false-alarms: {stated} is no rate").into());
    }
    let ground = crate::notes::told_ground(PlannedFlight::at(&arguments.source.to_source())?);
    let landmarks = with_detector(&ground.mission.landmarks, &arguments.landmark)?;
    let folder = match &arguments.frames {
        Some(path) => {
            let flight = flight_at(path, None, None)?;
            crate::notes::tell(&flight.notes);
            Some(flight.open)
        }
        None => None,
    };
    if let Some(folder) = folder.as_ref().filter(|f| f.flight.truth.is_none()) {
        return Err(format!(
            "--frames: nothing says where \"{}\" really flew, so that no mark can be judged",
            folder.flight.name
        )
        .into());
    }
    let flight = folder.as_ref().map(|_| Lent::flight());
    let mut lent = ground.lent();
    if let Some(folder) = folder {
        lent = lent.with_flight(&folder);
    }
    let order = |landmark: &Landmark| {
        let usual = EvaluationOrder::usual(ground.assessment(landmark, None), flight.clone());
        EvaluationOrder {
            camera: FlownCamera::of(&ground.mission),
            labels: ground.mission.labels.clone(),
            ..arguments.amounts(usual)
        }
        .in_detail()
    };
    let orders = landmarks.iter().map(order).collect();
    let (mut all, mut told) = (Vec::<JudgedDetector>::new(), Instant::now());
    let mut reports = vec![None; landmarks.len()];
    workers::run(orders, &lent, &mut |number, event| {
        match event {
            JobEvent::Failed(why) => eprintln!("{}: {why}", landmarks[number].name),
            JobEvent::Progress(_, words) if told.elapsed() >= TOLD_EVERY => {
                eprintln!("{}: {words}", landmarks[number].name);
                told = Instant::now();
            }
            JobEvent::Evaluation(report) => reports[number] = Some(report),
            JobEvent::Figures(_) => {
                let judged = event.read_figures()?;
                if let Some(report) = &reports[number] {
                    tell(report, &judged);
                }
                all.push(judged);
            }
            _ => {}
        }
        Ok(())
    })?;
    if let Some(path) = &arguments.csv {
        write_whole(path, table(&all))?;
    }
    if let Some(folder) = &arguments.svg {
        std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
        let names = distinct_names(all.iter().map(|it| plain_name(&it.landmark)), []);
        for (evaluated, name) in all.iter().zip(names) {
            for plot in evaluated.evaluation.plots() {
                write_whole(&folder.join(format!("{name}.{}.svg", plot.key)), plot.svg())?;
            }
        }
    }
    if let Some(path) = &arguments.json {
        write_whole(path, serde_json::to_string_pretty(&all)?)?;
    }
    all_done(all.len(), landmarks.len(), "detectors", "judged")
}

/// Those of the chosen landmarks for which a detector was trained.
fn with_detector(landmarks: &[Landmark], wanted: &[String]) -> Result<Vec<Landmark>, String> {
    let mut chosen = chosen(landmarks, wanted)?;
    let without = chosen.iter().find(|l| l.trained_detector().is_none());
    if let Some(landmark) = without.filter(|_| !wanted.is_empty()) {
        return Err(format!(
            "landmark \"{}\" has no detector that was trained for its box; see pilotage train",
            landmark.name
        ));
    }
    chosen.retain(|l| l.trained_detector().is_some());
    if chosen.is_empty() {
        return Err(
            "no landmark has a detector; pilotage train --write-mission trains them".to_owned(),
        );
    }
    Ok(chosen)
}

/// Prints what the page shows of a detector, and by what else it is judged here.
fn tell(report: &EvaluationReport, judged: &JudgedDetector) {
    println!("{}: {}", report.name, report.basis);
    for figure in &report.figures {
        println!("    {figure}");
    }
    println!("    its own threshold, as flown: {:.3}", judged.threshold);
    if let Some(calibration) = &judged.evaluation.calibration {
        println!(
            "    probability of a score: Brier {:.4}, {:.4} were it a constant",
            calibration.brier, calibration.brier_of_share
        );
    }
}

/// All tables below each other, with the landmark's name in front.
fn table(all: &[JudgedDetector]) -> String {
    let mut rows = Vec::new();
    for evaluated in all {
        let csv = evaluated.evaluation.csv();
        let quoted = in_quotes(&evaluated.landmark);
        let mut lines = csv.lines();
        let head = lines.next().unwrap_or_default();
        if rows.is_empty() {
            rows.push(format!("landmark,{head}\n"));
        }
        rows.extend(lines.map(|line| format!("{quoted},{line}\n")));
    }
    rows.concat()
}

/// The landmarks of those names or ids, or else all that are switched on.
fn chosen(landmarks: &[Landmark], wanted: &[String]) -> Result<Vec<Landmark>, String> {
    let one = |wanted: &String| {
        let by_name = landmarks.iter().find(|l| l.name == *wanted);
        let by_id = || landmarks.iter().find(|l| l.id.to_string() == *wanted);
        by_name.or_else(by_id).cloned().ok_or_else(|| {
            let names: Vec<_> = landmarks.iter().map(|l| l.name.as_str()).collect();
            let names = names.join(", ");
            format!("--landmark: there is no \"{wanted}\"; there are: {names}")
        })
    };
    let chosen: Vec<Landmark> = if wanted.is_empty() {
        landmarks.iter().filter(|l| l.enabled).cloned().collect()
    } else {
        wanted.iter().map(one).collect::<Result<_, _>>()?
    };
    if chosen.is_empty() {
        return Err("the mission has no landmark that is switched on".to_owned());
    }
    Ok(chosen)
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;

    #[derive(Parser)]
    struct Words {
        #[command(flatten)]
        arguments: Arguments,
    }

    #[test]
    fn what_is_not_said_is_as_on_the_page_and_so_are_the_frames_of_a_flight() {
        let scenario = ["evaluate", "--scenario", "distinct-400ft-calm"];
        let parsed = |more: &[&str]| Words::parse_from([&scenario[..], more].concat()).arguments;
        let source = parsed(&[]).source.to_source();
        let ground = PlannedFlight::at(&source).unwrap();
        let about = ground.assessment(&ground.mission.landmarks[0], None);
        let usual = EvaluationOrder::usual(about, None);
        let frames = ["--frames", "flown"];
        assert!(parsed(&frames).amounts(usual.clone()) == usual);
        let few = parsed(&[&frames[..], &["--most-frames", "30"]].concat());
        assert_eq!(few.amounts(usual).most_frames, 30);
    }
}
