//! Airspeeds that are the receiver's ground speed, and others.

use super::super::super::{Log, Topic, testing};
use super::super::INFO;
use super::written::Written;
use crate::interpret::{Role, series};

/// A minute of a vehicle whose ground speed changes between 6 and 14 m/s, its receiver five times a second, the airspeed
/// of its display four times; `airspeed` tells that of a ground speed.
fn log(autopilot: u8, has_sensor: bool, airspeed: impl Fn(f64) -> f64) -> Log {
    log_of(autopilot, [has_sensor, true, true], airspeed)
}

/// The same with a sensor, messages of a receiver and of the display, as `has` says.
fn log_of(autopilot: u8, has: [bool; 3], airspeed: impl Fn(f64) -> f64) -> Log {
    let [has_sensor, has_receiver, has_display] = has;
    let mut file = Written::new();
    let speed = |tick: u32| (1000.0 + 400.0 * (f64::from(tick - tick % 4) * 0.01).sin()).round();
    for tick in 0..1200_u32 {
        let time = u64::from(tick) * 50_000;
        if tick % 20 == 0 {
            file = file.heartbeat(time, 2, autopilot, 5);
            // HIGH_LATENCY2: its airspeed is the 30th byte, its speed over ground the 32nd, in fifths of m/s.
            let fifths = |speed: f64| [(5.0 * speed) as u8];
            let ground = speed(tick) / 100.0;
            let (told, over_ground) = (fifths(airspeed(ground)), fifths(ground));
            let parts: [&[u8]; 5] = [&[1; 29], &told, &[1], &over_ground, &[1; 10]];
            file = file.version_2(time, 235, &parts);
        }
        let speed = speed(tick);
        if has_receiver && tick % 4 == 0 {
            let place = [475_000_000_i32, 85_000_000, 500_000].map(i32::to_le_bytes);
            let rest = [100, 100, speed as u16, 9000].map(u16::to_le_bytes);
            let stamp = (time + 1).to_le_bytes();
            let parts = [
                &stamp[..],
                place.as_flattened(),
                rest.as_flattened(),
                &[3, 12],
            ];
            file = file.version_1(time, 24, &parts);
        }
        if has_display && tick % 5 == 2 {
            let told = (airspeed(speed / 100.0) as f32).to_le_bytes();
            let over_ground = ((speed / 100.0) as f32).to_le_bytes();
            let parts: [&[u8]; 5] = [&told, &over_ground, &[0; 4], &[0; 4], &[0; 4]];
            file = file.version_1(time, 74, &parts);
            if has_sensor {
                // Airspeed, raw pressure, temperature, number and flags of the sensor.
                let parts: [&[u8]; 3] = [&told, &[0; 4], &[0, 0, 1, 1]];
                file = file.version_2(time, 295, &parts);
            }
        }
    }
    testing::read(&INFO, &file.bytes, 1000)
}

#[test]
fn ground_speed_in_the_place_of_an_airspeed_is_none_and_told() {
    let found = log(3, false, |ground| ground);
    assert_eq!(series(&found, Role::Airspeed), None);
    assert!(series(&found, Role::GroundSpeed).is_some());
    let told = &found.report.remarks;
    assert!(
        told.iter().any(|it| it.contains("ground speed")),
        "{told:?}"
    );
    // The numbers stay to be looked at.
    let hud = found.first("VFR_HUD").map(Topic::len);
    assert_eq!(hud, Some(240));
}

#[test]
fn ground_speed_in_its_place_is_none_in_logs_without_messages_of_the_receiver() {
    for has_display in [true, false] {
        let found = log_of(3, [false, false, has_display], |ground| ground);
        assert_eq!(series(&found, Role::Airspeed), None, "{has_display}");
        let told = &found.report.remarks;
        assert!(
            told.iter().any(|it| it.contains("ground speed")),
            "{told:?}"
        );
        let found = log_of(3, [false, false, has_display], |ground| ground + 1.5);
        assert!(series(&found, Role::Airspeed).is_some(), "{has_display}");
    }
}

#[test]
fn an_airspeed_of_a_sensor_or_of_another_autopilot_is_kept() {
    for (autopilot, has_sensor, wind) in [(3, false, 1.5), (3, true, 0.0), (12, false, 0.0)] {
        let found = log(autopilot, has_sensor, |ground| ground + wind);
        let airspeed = series(&found, Role::Airspeed).map(|it| it.times.len());
        assert_eq!(airspeed, Some(240), "{autopilot} {has_sensor} {wind}");
        assert_eq!(found.report.remarks, [] as [String; 0]);
    }
}
