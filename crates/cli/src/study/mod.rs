//! `pilotage study`: questions over many flights.

mod arguments;
mod carry_out;
mod folder;
mod map_work;
mod progress;
mod results;
mod rows;
mod sensitivity;
mod shards;

use pilotage_study::{MeasureKind, StudySetting};

use crate::CommandResult;
use crate::workers;
use arguments::GiveUpChoice;
use map_work::MapWorkPlan;

/// Arguments of `pilotage study`.
#[derive(clap::Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct Arguments {
    #[command(subcommand)]
    other: Option<Other>,
    #[command(flatten)]
    plan: Option<arguments::Arguments>,
}

#[derive(clap::Subcommand)]
enum Other {
    /// Errors that walk at random, added to one instrument at a time (`DeAngelo` 2016, figures 5-36 to 5-43).
    Sensitivity(sensitivity::Arguments),
    /// Print what came of recorded studies, or write it into the measured results.
    Results(results::Arguments),
    /// List what a plan can set and measure.
    Settings,
}

/// Makes the study that the arguments ask for.
pub fn run(arguments: &Arguments) -> CommandResult {
    match (&arguments.other, &arguments.plan) {
        (Some(Other::Sensitivity(of_sensitivity)), _) => sensitivity::run(of_sensitivity),
        (Some(Other::Results(of_results)), _) => results::run(of_results),
        (Some(Other::Settings), _) => {
            list();
            Ok(())
        }
        (None, Some(plan)) => {
            match plan.until {
                Some(GiveUpChoice::InputEnds) => end_with_input(),
                None => {}
            }
            let text = plan.text()?;
            if map_work::run(plan, &text)? {
                return Ok(());
            }
            carry_out::run(plan, &text)
        }
        (None, None) => Err("give the plan of a study, or see pilotage study --help".into()),
    }
}

/// Lets the program end as soon as its standard input does.
fn end_with_input() {
    workers::once_input_ends(|ended| {
        let why = match ended {
            Ok(_) => "the standard input has ended".to_owned(),
            Err(why) => format!("the standard input cannot be read: {why}"),
        };
        eprintln!("Given up: {why}.");
        std::process::exit(1);
    });
}

fn list() {
    println!("Settings:");
    for setting in StudySetting::ALL {
        println!("  {:18} {:5} {}", setting.key, setting.unit, setting.about);
    }
    println!("Measures:");
    for kind in MeasureKind::ALL {
        println!("  {:18} {}", kind.key(), kind.unit());
    }
    println!("Work on a map, in a plan of its own:");
    for (key, about) in MapWorkPlan::SETTINGS {
        println!("  {key:18} {about}");
    }
}
