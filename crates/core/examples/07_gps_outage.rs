//! Cuts GPS out of a flight for a minute and navigates through the outage by airspeed, heading and the wind that
//! was learned before it: the error against what the filter says of it.
//!
//! `cargo run -p pilotage-core --example 07_gps_outage`

use std::error::Error;

use pilotage_core::flight::{Channel, ChannelName, Flight};
use pilotage_core::frames::GroundPoint;
use pilotage_core::instruments::{Instruments, ReckonSettings, ReckoningWay, reckon};
use pilotage_core::simulate::{FlightPlan, Overrides, Scenario};

/// When GPS is lost and when it comes back, seconds.
const OUTAGE: (f64, f64) = (140.0, 200.0);

/// Adds what a satellite receiver reads, five times a second: the truth, with an error of a metre that wanders.
fn add_gps(flight: &mut Flight) -> Option<()> {
    let truth = flight.truth.clone()?;
    let times = truth.states.iter().skip(4).step_by(4);
    let times: Vec<f64> = times.map(|state| state.time).collect();
    let names = [
        (ChannelName::GpsNorth, ChannelName::GpsVelocityNorth),
        (ChannelName::GpsEast, ChannelName::GpsVelocityEast),
    ];
    for (axis, (place, velocity)) in names.into_iter().enumerate() {
        let read = |time: f64| {
            let truly = truth.position(time).map_or(f64::NAN, |p| p[axis]);
            truly + (0.05 * time + axis as f64).sin()
        };
        let change = |time: f64| (read(time) - read(time - 0.2)) / 0.2;
        let mut add = |name, value: &dyn Fn(f64) -> f64| {
            let (times, values) = (times.clone(), times.iter().map(|t| value(*t)).collect());
            flight.channels.push(Channel {
                name,
                times,
                values,
            });
        };
        add(place, &read);
        add(velocity, &change);
    }
    Some(())
}

fn main() -> Result<(), Box<dyn Error>> {
    // A survey of legs of 600 m in a wind of 10 kt.
    let scenario = Scenario::named("distinct-400ft-wind").ok_or("no such scenario")?;
    let corner = |i: i32| {
        let north = if (i + 1) / 2 % 2 == 0 { -300.0 } else { 300.0 };
        GroundPoint::new(north, 120.0 * f64::from(i / 2) - 300.0)
    };
    let plan = FlightPlan {
        way_points: (0..12).map(corner).collect(),
        ..scenario.plan(&Overrides::default())
    };
    let mut flight = plan.simulate(4).ok_or("there is nothing to fly")?;
    add_gps(&mut flight).ok_or("a simulated flight has a truth")?;
    let instruments = Instruments::of(&flight, None)?;
    let ways = [ReckoningWay::air_and_wind(), ReckoningWay::plain()];
    let settings = ReckonSettings::default();
    let found = reckon(&instruments, OUTAGE, &ways, &settings, |_| true)?;
    for track in &found.tracks {
        println!("{}:\n  since, s  error, m  95 % ellipse, m", track.label);
        for growth in track.growth(OUTAGE).iter().step_by(50) {
            let error = growth.error.ok_or("satellite navigation is known there")?;
            println!(
                "  {:8.1}  {error:8.1}  {:15.1}",
                growth.since, growth.radius
            );
        }
    }

    let growth = found.tracks[0].growth(OUTAGE);
    let last = growth.last().ok_or("the outage is empty")?;
    let error = last.error.ok_or("satellite navigation is known there")?;
    if error > 150.0 || error > 1.5 * last.radius {
        return Err("a minute should cost less than 150 m, and the filter should say so".into());
    }
    Ok(())
}
