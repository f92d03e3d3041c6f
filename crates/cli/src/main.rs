//! `pilotage`: the jobs of the app without a screen.

mod align;
mod bench;
mod columns;
mod compare;
mod convert;
mod detect;
mod evaluate;
mod export;
mod export_parquet;
mod export_track;
mod export_value;
mod files;
mod filter_options;
mod georef;
mod inspect;
mod inspect_log;
mod inspect_wind;
mod labels;
mod map;
mod mission_file;
mod numbers;
mod opening;
mod outage;
mod outcome;
mod own_map;
mod photo_picture;
mod plan;
mod register;
mod replay;
mod replay_frames;
mod scenario;
mod simulate;
mod statistics;
mod train;
mod workers;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use outcome::Outcome;

/// Navigate aircraft by what can be seen on the ground.
#[derive(Parser)]
#[command(version, about)]
struct Arguments {
    #[command(subcommand)]
    job: Job,
}

#[derive(Subcommand)]
enum Job {
    /// List the built-in scenarios.
    Scenarios,
    /// Fly a built-in scenario, or over a map of your own, and write it as a flight folder.
    Simulate(simulate::Arguments),
    /// Run flights through the estimator.
    Replay(replay::Arguments),
    /// The same flights by several estimators and vehicle models, in one table.
    Compare(compare::Arguments),
    /// Put a camera in time and place beside a log: clock, mount and focal length, from the pictures.
    Align(align::Arguments),
    /// Suggest landmarks, predict the uncertainty along a route.
    Plan(Box<plan::Arguments>),
    /// Train a detector for each landmark from the map alone.
    Train(train::Arguments),
    /// Judge trained detectors on pictures that they were not trained on.
    Evaluate(Box<evaluate::Arguments>),
    /// Run a cascade over pictures.
    Detect(detect::Arguments),
    /// Lay photos on a map, of whatever date: where each was taken, how surely, or why not.
    Register(register::Arguments),
    /// Convert routes, landmarks and labels between file formats.
    Convert(convert::Arguments),
    /// Write the values of a log as CSV or JSON, or its track as KML, GPX, GeoJSON or CSV.
    Export(export::Arguments),
    /// Show what the columns of tables mean, and save it to be edited.
    Columns(columns::Arguments),
    /// Say what a file or folder is.
    Inspect(inspect::Arguments),
    /// Look at maps: what they are, and pictures out of them.
    Map(map::Arguments),
    /// Time the kernels and the filter.
    Bench(bench::Arguments),
}

fn main() -> ExitCode {
    // Who reads no further (`pilotage … | head`) ends the program, as with any other tool.
    sigpipe::reset();
    let outcome = match Arguments::parse().job {
        Job::Scenarios => {
            simulate::list();
            Ok(())
        }
        Job::Simulate(arguments) => simulate::run(&arguments),
        Job::Replay(arguments) => replay::run(&arguments),
        Job::Compare(arguments) => compare::run(&arguments),
        Job::Align(arguments) => align::run(&arguments),
        Job::Plan(arguments) => plan::run(&arguments),
        Job::Train(arguments) => train::run(&arguments),
        Job::Evaluate(arguments) => evaluate::run(&arguments),
        Job::Detect(arguments) => detect::run(&arguments),
        Job::Register(arguments) => register::run(&arguments),
        Job::Convert(arguments) => convert::run(&arguments),
        Job::Export(arguments) => export::run(&arguments),
        Job::Columns(arguments) => columns::run(&arguments),
        Job::Inspect(arguments) => inspect::run(&arguments),
        Job::Map(arguments) => map::run(&arguments),
        Job::Bench(arguments) => bench::run(&arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("pilotage: {error}");
            ExitCode::FAILURE
        }
    }
}
