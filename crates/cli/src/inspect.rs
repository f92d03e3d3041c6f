//! `pilotage inspect`: what a file or folder is.

use std::path::{Path, PathBuf};

use pilotage_core::flight::Flight;

use crate::opening::{OpenedPath, foreign_words, open};
use crate::{CommandResult, inspect_log};

/// Arguments of `pilotage inspect`.
#[derive(clap::Args)]
pub struct Arguments {
    /// A flight log, a flight folder, tables of a flight, photos, labels of pictures, a mission, or a saved run.
    path: PathBuf,
    /// Meaning of the columns of tables, as `pilotage columns --save` wrote it.
    #[arg(long, value_name = "MAP")]
    columns: Option<PathBuf>,
    /// Print the parameters of a log whose names have this in them; all without it.
    #[arg(long, value_name = "NAME", num_args = 0..=1, default_missing_value = "")]
    parameters: Option<String>,
    /// Take the flight of another vehicle of a telemetry log, by the number of its system.
    #[arg(long, value_name = "SYSTEM")]
    vehicle: Option<u32>,
    /// Print how many rows of each kind a log has.
    #[arg(long)]
    counts: bool,
}

/// Says what the path holds.
pub fn run(arguments: &Arguments) -> CommandResult {
    let path = &arguments.path;
    let labels = crate::labels::read(path);
    let opened = match (open(path, arguments.columns.as_deref()), &labels) {
        // An archive of labels is none of flights.
        (Err(_), Ok(Some(_))) => OpenedPath::Nothing(String::new()),
        (opened, _) => opened?.of_vehicle(arguments.vehicle)?,
    };
    let is_flight = !matches!(opened, OpenedPath::Nothing(_));
    match labels {
        Ok(Some((format, found))) => {
            crate::labels::describe(format, found);
            if !is_flight {
                return Ok(());
            }
        }
        Ok(None) => {}
        Err(why) if is_flight => eprintln!("note: {why}"),
        // Labels of another program are called by its name.
        Err(why) => {
            let named = foreign_words(path).filter(|is| is.contains("labels of"));
            return Err(named.map_or(why, Into::into));
        }
    }
    let told = match opened {
        OpenedPath::Folder(folder) | OpenedPath::Tables(folder) => {
            describe(&folder.flight);
            inspect_log::describe_folder(&folder);
            if arguments.counts {
                inspect_log::counts(&folder.log());
            }
            if arguments.parameters.is_some() {
                return Err(of_logs("parameters", "a flight").into());
            }
            return Ok(());
        }
        OpenedPath::Log(log, beside) => {
            inspect_log::describe(&log, &beside);
            if arguments.counts {
                inspect_log::counts(&log);
            }
            if let Some(part) = &arguments.parameters {
                inspect_log::parameters(&log, part);
            }
            return Ok(());
        }
        OpenedPath::Nothing(told) => told,
    };
    let bytes = std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
    if let Ok(run) = pilotage_core::navigator::decode_run(&path.to_string_lossy(), &bytes) {
        println!(
            "run \"{}\": {} steps, {} landmarks",
            run.name,
            run.steps.len(),
            run.landmarks.len()
        );
        return arguments.nothing_of_logs("a run");
    }
    let package = pilotage_core::mission::package::read_package(&bytes).map_err(|e| {
        match foreign_words(path) {
            Some(is) => is,
            None if !told.is_empty() => format!("{}: {told}", path.display()),
            // What says that it is one of ours is told why it is not read.
            None if is_ours(&bytes) => format!(
                "{}: neither a flight log, a flight, a run nor a mission: {e}",
                path.display()
            ),
            None => format!(
                "{}: of no kind that is known here: neither a flight log, a flight, a run nor a mission",
                path.display()
            ),
        }
    })?;
    if !says_ours(&bytes) {
        return Err(places_of_others(path).into());
    }
    let mission = package.mission;
    println!(
        "mission \"{}\": {} landmarks",
        mission.name,
        mission.landmarks.len()
    );
    for landmark in &mission.landmarks {
        println!(
            "    {:3} {:24} {:6.1} × {:6.1} m at north {:8.1}, east {:8.1} m",
            landmark.id,
            landmark.name,
            landmark.bounds.width(),
            landmark.bounds.height(),
            landmark.reference.north,
            landmark.reference.east
        );
    }
    arguments.nothing_of_logs("a mission")
}

impl Arguments {
    /// Refuses what was asked of something that only a log has.
    fn nothing_of_logs(&self, of: &str) -> CommandResult {
        let asked = [
            ("parameters", self.parameters.is_some()),
            ("counts", self.counts),
        ];
        match asked.into_iter().find(|(_, is_asked)| *is_asked) {
            Some((option, _)) => Err(of_logs(option, of).into()),
            None => Ok(()),
        }
    }
}

fn of_logs(option: &str, of: &str) -> String {
    format!("--{option} is of logs; this is {of}")
}

/// Whether a file says that it was saved here.
fn is_ours(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(1000)];
    String::from_utf8_lossy(head).contains("\"pilotage")
}

/// Name of a file that holds places and was not saved here.
fn places_of_others(path: &Path) -> String {
    foreign_words(path).unwrap_or_else(|| {
        format!(
            "{}: it is GeoJSON without the marks of a mission: `pilotage convert`, or open it in Plan",
            path.display()
        )
    })
}

/// Whether a mission that can be read says anywhere that it was saved here; a zip with one in it does.
fn says_ours(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK") || String::from_utf8_lossy(bytes).contains("\"pilotage")
}

fn describe(flight: &Flight) {
    let (begin, end) = flight.span();
    println!(
        "flight \"{}\": {:.1} s, {} frames",
        flight.name,
        end - begin,
        flight.frames.len()
    );
    println!(
        "    camera {} × {} px, focal length {:.1} px",
        flight.camera.width, flight.camera.height, flight.camera.focal
    );
    for channel in &flight.channels {
        println!(
            "    {:22} {} samples",
            channel.name.key(),
            channel.times.len()
        );
    }
    if let Some(truth) = &flight.truth {
        println!(
            "    truth: {} states, {} frames",
            truth.states.len(),
            truth.frames.len()
        );
    }
}
