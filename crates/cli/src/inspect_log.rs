//! What a flight log holds, in words.

use pilotage_core::flight::FlightFolder;
use pilotage_core::flight::interpret::{flight_from_log, log_of_flight};
use pilotage_core::flight::log::Log;
use pilotage_core::flight::overview::{Overview, Severity, overview};

/// Prints what the log is, what measured, what looks wrong and what can be done with it.
pub fn describe(log: &Log) {
    let interpreted = flight_from_log(log);
    let seen = overview(log, &interpreted.measured());
    measured(log, &seen);
    if let Ok(flight) = &interpreted.into_flight() {
        crate::inspect_wind::describe(flight);
    }
    judged(&seen);
}

/// Prints the same of a flight of tables or photos.
pub fn describe_folder(folder: &FlightFolder) {
    let log = folder.log();
    let beside = log_of_flight(&log, &folder.flight);
    let mut seen = overview(&log, &beside.measured());
    seen.add_pictures(folder.flight.frames.len());
    measured(&log, &seen);
    crate::inspect_wind::describe(&folder.flight);
    judged(&seen);
}

/// What the log is, and what measured.
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
    let aloft: f64 = seen.airborne.iter().map(|(a, b)| b - a).sum();
    println!(
        "    in the air {aloft:.0} s, {:.2} km over ground",
        1e-3 * seen.distance
    );
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

/// What looks wrong, and what can be done with it.
fn judged(seen: &Overview) {
    for finding in &seen.findings {
        let word = match finding.severity {
            Severity::Note => "note",
            Severity::Warning => "warning",
            Severity::Trouble => "trouble",
        };
        println!("{word}: {}. {}", finding.title, finding.text);
    }
    for ability in &seen.abilities {
        match &ability.lacks {
            None => println!("can: {}", ability.what),
            Some(lacks) => println!("cannot: {}. {lacks}", ability.what),
        }
    }
}
