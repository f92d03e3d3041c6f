//! What a flight log holds, in words.

use pilotage_core::flight::interpret::flight_from_log;
use pilotage_core::flight::log::{Log, all_formats};
use pilotage_core::flight::overview::{Severity, overview};

/// Prints what the log is, what measured, what looks wrong and what can be done with it.
pub fn describe(log: &Log) {
    let info = all_formats().iter().find(|info| info.format == log.format);
    let format = info.map_or("flight log", |info| info.label);
    let interpreted = flight_from_log(log);
    let seen = overview(log, &interpreted);
    println!(
        "{} \"{}\": {:.1} s, {} topics, {} messages {}",
        format,
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
    if let Ok(flight) = &interpreted.into_flight() {
        crate::inspect_wind::describe(flight);
    }
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
