//! `pilotage rehearse`: a planned route flown again and again in the simulation, beside its prediction.

use pilotage_core::plan::{PlanComparison, PredictionAgreement, Verification};
use pilotage_jobs::Rehearsed;
use serde::Serialize;

use crate::CommandResult;
use crate::notes::told_ground;
use crate::plan::{PlannedFlight, SourceArguments, fly, predict};
use crate::scenario::seed_range;

/// Arguments of `pilotage rehearse`.
#[derive(clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    source: SourceArguments,
    /// Name of the route that is flown in place of the mission's first.
    #[arg(long, value_name = "NAME", requires = "mission")]
    route: Option<String>,
    /// Seeds A..B, B left out: each draws the wind, the day and the errors of the sensors.
    #[arg(long, value_name = "A..B", default_value = "1..21")]
    seeds: String,
    /// Fly without pictures: landmarks are found as often and as well as is expected of them.
    #[arg(long)]
    no_pictures: bool,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// A flight, or all of them, beside the prediction.
#[derive(Serialize)]
struct FlownFigures {
    frames: usize,
    /// Frames that corrected the estimate.
    corrected: usize,
    /// Share of positions inside the 95 % corridor.
    inside_corridor: f64,
    rms_m: f64,
    predicted_rms_m: f64,
    largest_m: f64,
    /// Distance of the largest error along the planned path.
    largest_at_m: f64,
}

#[derive(Serialize)]
struct FlownSeed {
    seed: u64,
    #[serde(flatten)]
    figures: FlownFigures,
}

#[derive(Serialize)]
struct Together {
    flights: usize,
    #[serde(flatten)]
    figures: FlownFigures,
    /// Two standard deviations of the share inside the corridor, where flights are enough to tell.
    inside_corridor_margin: Option<f64>,
    largest_seed: Option<u64>,
    prediction: PredictionAgreement,
}

#[derive(Serialize)]
struct RehearsalSummary {
    pictures: bool,
    flights: Vec<FlownSeed>,
    together: Together,
}

/// Rehearses the route that the arguments name.
pub fn run(arguments: &Arguments) -> CommandResult {
    let seeds = seed_range(&arguments.seeds)?;
    let ground = told_ground(PlannedFlight::along(
        &arguments.source.to_source(),
        arguments.route.as_deref(),
    )?);
    let say = |line: &str| eprintln!("{line}");
    let (plan, prediction) = predict(&ground, None, f64::INFINITY, &say)?;
    let (mut flights, mut frames) = (Vec::new(), Vec::new());
    let mut hear = |seed, flown: Rehearsed| {
        let of = Verification::of(std::slice::from_ref(&flown.frames));
        let figures = FlownFigures::new(&of, flown.corrected, &flown.frames);
        if !arguments.json {
            println!("seed {seed}: {}", figures.sentence(None));
        }
        flights.push(FlownSeed { seed, figures });
        frames.push(flown.frames);
    };
    let as_stated = arguments.no_pictures;
    let flown = fly(&ground, &plan, &prediction, seeds, as_stated, &mut hear)?;
    let together = Together::new(&flights, &frames);
    if arguments.json {
        let summary = RehearsalSummary {
            pictures: !as_stated,
            flights,
            together,
        };
        println!("{}", serde_json::to_string_pretty(&summary)?);
    } else {
        together.print();
    }
    flown.all_done()
}

impl FlownFigures {
    fn new(of: &Verification, corrected: usize, frames: &[PlanComparison]) -> Self {
        let largest = PlanComparison::worst(frames);
        Self {
            frames: of.frames,
            corrected,
            inside_corridor: of.inside_corridor,
            rms_m: of.rms_m,
            predicted_rms_m: of.predicted_rms_m,
            largest_m: of.largest_m,
            largest_at_m: largest.map_or(0.0, |frame| frame.distance),
        }
    }

    fn sentence(&self, margin: Option<f64>) -> String {
        let margin = margin.map_or_else(String::new, |it| format!(" ± {:.1}", 100.0 * it));
        format!(
            "{} frames, {} corrected, {:.1}{margin} % inside the 95 % corridor, error {:.2} m RMS where {:.2} m was \
             predicted, at most {:.1} m, {:.0} m along",
            self.frames,
            self.corrected,
            100.0 * self.inside_corridor,
            self.rms_m,
            self.predicted_rms_m,
            self.largest_m,
            self.largest_at_m
        )
    }
}

impl Together {
    fn new(flights: &[FlownSeed], frames: &[Vec<PlanComparison>]) -> Self {
        let of = Verification::of(frames);
        let corrected = flights.iter().map(|it| it.figures.corrected).sum();
        let error = |it: &FlownSeed| it.figures.largest_m;
        let worst = flights.iter().max_by(|a, b| error(a).total_cmp(&error(b)));
        Self {
            flights: of.flights,
            figures: FlownFigures::new(&of, corrected, &frames.concat()),
            inside_corridor_margin: of.corridor_margin(),
            largest_seed: worst.map(|it| it.seed),
            prediction: of.agreement(),
        }
    }

    fn print(&self) {
        let seed = self.largest_seed.unwrap_or_default();
        let sentence = self.figures.sentence(self.inside_corridor_margin);
        let flights = match self.flights {
            1 => "1 flight".to_owned(),
            count => format!("{count} flights"),
        };
        println!("{flights}: {sentence} (seed {seed})");
        println!("{}", self.prediction.sentence());
    }
}
