//! `pilotage`: the jobs of the app without a screen.

mod align;
mod bench;
mod class_words;
mod classes;
mod columns;
mod compare;
mod convert;
mod detect;
mod evaluate;
mod export;
mod export_parquet;
mod export_track;
mod export_value;
mod georef;
mod inspect;
mod inspect_log;
mod inspect_wind;
mod labels;
mod locate_photo;
mod map;
mod notes;
mod numbers;
mod outage;
mod outcome;
mod own_map;
mod photo_search;
mod plan;
mod reference_map;
mod register;
mod rehearse;
mod replay;
mod replay_frames;
mod roads;
mod scenario;
mod simulate;
mod statistics;
mod study;
mod train;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use outcome::CommandResult;
use pilotage_disk::{files, filter_options, maps, mission_file, opening, replaying, workers};

/// Navigate aircraft by what can be seen on the ground.
#[derive(Parser)]
#[command(version, about)]
struct Arguments {
    #[command(subcommand)]
    job: CommandChoice,
}

#[derive(Subcommand)]
enum CommandChoice {
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
    /// Fly a planned route in the simulation, on other days and in drawn winds, beside its prediction.
    Rehearse(rehearse::Arguments),
    /// Train a detector for each landmark from the map alone.
    Train(train::Arguments),
    /// Judge trained detectors on pictures that they were not trained on.
    Evaluate(Box<evaluate::Arguments>),
    /// Train and judge what tells classes of the ground.
    Classes(classes::Arguments),
    /// Make a map into a table of generic landmarks.
    ReferenceMap(reference_map::Arguments),
    /// Ask a question over many flights.
    Study(study::Arguments),
    /// Run a cascade over pictures.
    Detect(detect::Arguments),
    /// Lay photos on a map, of whatever date: where each was taken, how surely, or why not.
    Register(register::Arguments),
    /// Read, print, write and compare road maps, and fly by them.
    Roads(roads::Arguments),
    /// Convert routes, landmarks and labels between file formats.
    Convert(convert::Arguments),
    /// Write the values of a log as CSV, JSON or Parquet, or its track as KML, KMZ, GPX, GeoJSON or CSV.
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
        CommandChoice::Scenarios => {
            simulate::list();
            Ok(())
        }
        CommandChoice::Simulate(arguments) => simulate::run(&arguments),
        CommandChoice::Replay(arguments) => replay::run(&arguments),
        CommandChoice::Compare(arguments) => compare::run(&arguments),
        CommandChoice::Align(arguments) => align::run(&arguments),
        CommandChoice::Plan(arguments) => plan::run(&arguments),
        CommandChoice::Rehearse(arguments) => rehearse::run(&arguments),
        CommandChoice::Train(arguments) => train::run(&arguments),
        CommandChoice::Evaluate(arguments) => evaluate::run(&arguments),
        CommandChoice::Classes(arguments) => classes::run(&arguments),
        CommandChoice::ReferenceMap(arguments) => reference_map::run(&arguments),
        CommandChoice::Study(arguments) => study::run(&arguments),
        CommandChoice::Detect(arguments) => detect::run(&arguments),
        CommandChoice::Register(arguments) => register::run(&arguments),
        CommandChoice::Roads(arguments) => roads::run(&arguments),
        CommandChoice::Convert(arguments) => convert::run(&arguments),
        CommandChoice::Export(arguments) => export::run(&arguments),
        CommandChoice::Columns(arguments) => columns::run(&arguments),
        CommandChoice::Inspect(arguments) => inspect::run(&arguments),
        CommandChoice::Map(arguments) => map::run(&arguments),
        CommandChoice::Bench(arguments) => bench::run(&arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("pilotage: {error}");
            ExitCode::FAILURE
        }
    }
}
