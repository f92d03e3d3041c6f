//! Contents of a flight log, in words.

use std::sync::Arc;

use pilotage_core::flight::FlightFolder;
use pilotage_core::flight::files::FileSet;
use pilotage_core::flight::in_log_time;
use pilotage_core::flight::interpret::{flight_from_log, log_of_flight};
use pilotage_core::flight::log::{Log, LogOutline, SetParameter};
use pilotage_core::flight::overview::{Overview, Severity, modes};
use pilotage_jobs::{LogGlance, glance_at_folder};

/// Prints what the log is, what measured, what looks wrong and what can be done with it.
/// Of the files beside it the pictures count.
pub fn describe(log: &Log, beside: &Arc<dyn FileSet>) {
    let glance = LogGlance::of(log, flight_from_log(log), beside);
    if let Some(lost) = &glance.lost_pictures {
        eprintln!("note: {lost}; its pictures are left out");
    }
    measured(log, &glance.overview);
    if let Ok(open) = &glance.flight {
        crate::inspect_wind::describe(&open.flight);
    }
    judged(&glance.overview);
}

/// Prints the same of a flight of tables or photos.
pub fn describe_folder(folder: &FlightFolder) {
    let log = folder.log();
    let beside = log_of_flight(&log, &folder.flight);
    let seen = glance_at_folder(&log, &beside, &folder.flight);
    measured(&log, &seen);
    crate::inspect_wind::describe(&folder.flight);
    judged(&seen);
}

/// Prints the kind of the log, and the sensors that measured.
fn measured(log: &Log, seen: &Overview) {
    println!(
        "{} \"{}\": {:.1} s, {} topics, {} messages {}",
        log.format.label(),
        log.name,
        seen.span.1 - seen.span.0,
        log.topics.iter().filter(|t| !t.is_empty()).count(),
        log.report.messages,
        log.vehicle
    );
    let mut names: Vec<&str> = log.parameters.iter().map(|p| p.name.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    if !names.is_empty() || !log.modes.is_empty() {
        println!(
            "    {} parameters, {} changes of mode, {} words of the autopilot",
            names.len(),
            log.modes.len(),
            log.messages.len()
        );
    }
    let aloft: f64 = seen.airborne.iter().fold(0.0, |sum, (a, b)| sum + b - a);
    if aloft > 0.0 {
        println!(
            "    in the air {aloft:.0} s, {:.2} km over ground",
            1e-3 * seen.distance
        );
    } else {
        println!("    never in the air");
    }
    if !log.modes.is_empty() {
        for (from, to) in &seen.airborne {
            let modes = modes(log, *from, *to).join(", ");
            println!("    flew from {from:.0} to {to:.0} s: {modes}");
        }
    }
    for sensor in &seen.sensors {
        println!(
            "    {:22} {:32} {:8} samples {:7.1} Hz",
            sensor.role.label(),
            sensor.source,
            sensor.samples,
            sensor.rate
        );
    }
    if let Some(fit) = &seen.air_data {
        println!(
            "    wind north {:.1}, east {:.1} m/s; airspeed scale {:.3}; left over {:.2} m/s",
            fit.wind.x, fit.wind.y, fit.scale, fit.rms
        );
    }
}

/// Prints the findings that look wrong, and the uses of the log.
fn judged(seen: &Overview) {
    for finding in &seen.findings {
        let word = match finding.severity {
            Severity::Note => "note",
            Severity::Warning => "warning",
            Severity::Trouble => "trouble",
        };
        println!("{word}: {}. {}", finding.title, in_log_time(&finding.text));
    }
    for ability in &seen.abilities {
        match &ability.lacks {
            None => println!("can: {}", ability.what),
            Some(lacks) => println!("cannot: {}. {lacks}", ability.what),
        }
    }
}

/// Prints how many rows of each kind there are, and their rate.
pub fn counts(log: &Log) {
    for topic in LogOutline::of(log).topics {
        println!(
            "    {:32} {:8} rows {:9.2} Hz",
            topic.name.to_string(),
            topic.rows,
            topic.rate()
        );
    }
}

/// Prints the parameters whose names have `part` in them, in whatever case, as they were last set.
pub fn parameters(log: &Log, part: &str) {
    let part = part.to_lowercase();
    let all = log.set_parameters();
    let is_shown = |it: &&SetParameter| it.name.to_lowercase().contains(&part);
    let shown = all.iter().filter(is_shown);
    for parameter in shown.clone() {
        let default = parameter.other_default();
        let default = default.map_or_else(String::new, |value| format!("  (default {value})"));
        let changes = match parameter.changes {
            0 => String::new(),
            1 => "  changed once".to_owned(),
            more => format!("  changed {more} times"),
        };
        println!(
            "    {:24} {}{default}{changes}",
            parameter.name, parameter.value
        );
    }
    let shown = shown.count();
    if shown == all.len() {
        println!("{shown} parameters");
    } else {
        println!("{shown} of {} parameters", all.len());
    }
}
