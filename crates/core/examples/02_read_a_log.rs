//! Reads a flight log of ArduPilot: what is in it, what its fields mean, and the flight that it tells of.
//!
//! `cargo run -p pilotage-core --example 02_read_a_log`
//!
//! The log is written here, as text; `read_log` takes binary ones of ArduPilot, PX4, MAVLink and MCAP as well.

use std::{error::Error, fmt::Write};

use pilotage_core::flight::{
    ChannelName, SpanStatistics,
    expression::Expression,
    interpret::flight_from_log,
    log::{LogOutline, read_log},
    overview::overview,
};
use pilotage_core::imagery::MemoryBytes;

/// Twelve seconds on the ground, then two circles of a minute at 20 m/s.
fn a_log() -> Result<String, std::fmt::Error> {
    let mut text = String::from(
        "FMT, 1, 50, GPS, QBIHLLfff, TimeUS,Status,GMS,GWk,Lat,Lng,Alt,Spd,GCrs\n\
         FMT, 2, 50, ATT, QccC, TimeUS,Roll,Pitch,Yaw\n",
    );
    for i in 0..660 {
        let flown = (0.2 * f64::from(i) - 12.0).max(0.0);
        let (speed, bank) = if flown > 0.0 {
            (20.0, 12.0 + 0.1 * f64::from(i % 5 - 2))
        } else {
            (0.0, 0.0)
        };
        // A radius of 191 m; a degree of latitude is 111.2 km here, one of longitude 76.1.
        let (sin, cos) = (6.0 * flown).to_radians().sin_cos();
        let latitude = 47.0 + 191.0 * sin / 111_200.0;
        let longitude = 8.0 + 191.0 * (1.0 - cos) / 76_100.0;
        let (ms, course) = (200 * i, (6.0 * flown) % 360.0);
        let height = 400.0 + flown.min(50.0);
        writeln!(
            text,
            "GPS, {ms}000, 3, {ms}, 2300, {latitude:.7}, {longitude:.7}, {height:.2}, {speed}, {course:.2}"
        )?;
        writeln!(text, "ATT, {ms}000, {bank:.2}, 2.0, {course:.2}")?;
    }
    Ok(text)
}

fn main() -> Result<(), Box<dyn Error>> {
    let source = MemoryBytes::new("flight.log", a_log()?.into_bytes());
    let log = read_log(&source)?.ok_or("this is no log")?;
    for topic in &LogOutline::of(&log).topics {
        let (name, rows, rate) = (&topic.name, topic.rows, topic.rate());
        println!("{name}: {rows} rows, {rate:.1} Hz");
    }

    // Fields by their names, and what they mean whatever the autopilot calls them.
    let bank = Expression::parse("abs(ATT.Roll)")?.evaluate(&log)?;
    let bank = SpanStatistics::of(&bank, (60.0, 120.0)).ok_or("no roll at that time")?;
    println!("bank {:.1}° on average from 60 s to 120 s", bank.mean);

    let interpreted = flight_from_log(&log);
    let seen = overview(&log, &interpreted.measured());
    let (air, way) = (&seen.airborne, seen.distance);
    println!("in the air (s): {air:.1?}, over {way:.0} m");
    for finding in &seen.findings {
        println!("{:?}: {}", finding.severity, finding.text);
    }

    let flight = interpreted.into_flight()?;
    let north = flight.channel(ChannelName::GpsNorth).ok_or("no track")?;
    let farthest = north.values.iter().fold(0.0, |a: f64, n| a.max(*n));
    println!("{farthest:.1} m north of the start at most");
    if (farthest - 191.0).abs() > 1.0 || (bank.mean - 12.0).abs() > 0.1 {
        return Err("the circles have a radius of 191 m and a bank of 12°".into());
    }
    Ok(())
}
