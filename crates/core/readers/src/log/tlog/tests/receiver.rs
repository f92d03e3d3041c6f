//! Tests of the receiver's clock that is set while the vehicle's own goes on.

use super::super::super::{Log, TopicName, testing};
use super::super::INFO;
use super::written::Written;

/// Three hundred moments a fifth of a second apart, with words every fifteen seconds: received as `clock` says of the
/// number and the second, stamped by the vehicle as `boot` says, milliseconds.
fn log(clock: impl Fn(u32, f64) -> f64, boot: impl Fn(u32) -> u32) -> Log {
    let mut file = Written::new();
    for index in 0..300 {
        let received = 7200.0 + clock(index, 0.2 * f64::from(index));
        let time = (received * 1e6).round() as u64;
        let angle = 0.01_f32.to_le_bytes();
        let stamp = boot(index).to_le_bytes();
        let fields: [&[u8]; 7] = [&stamp, &angle, &angle, &angle, &[0; 4], &[0; 4], &angle];
        file = file.version_2(time, 30, &fields);
        // A receiver's speed has no stamp: VFR_HUD.
        file = file.version_2(time + 1, 74, &[&angle, &angle, &angle, &angle, &[1; 4]]);
        if index % 75 == 0 {
            file = file.words(time + 2, 6, "here", 0, 0);
        }
    }
    testing::read(&INFO, &file.bytes, 1000)
}

fn times<'a>(log: &'a Log, name: &str) -> &'a [f64] {
    let name = TopicName {
        name: name.to_owned(),
        instance: Some(1),
    };
    &log.topic(&name).unwrap().times
}

fn regular(index: u32) -> u32 {
    5000 + 200 * index
}

#[test]
fn a_clock_set_by_an_hour_or_minutes_leaves_one_flight_with_all_its_rows() {
    for by in [3600.0, -3600.0, 120.0, -25.0] {
        let log = log(|i, r| r + if i > 150 { by } else { 0.0 }, regular);
        for name in ["ATTITUDE", "VFR_HUD"] {
            let times = times(&log, name);
            assert_eq!(times.len(), 300, "{by} {name}");
            for (index, time) in times.iter().enumerate() {
                let right = 0.2 * index as f64;
                assert!((time - right).abs() < 1e-3, "{by} {name} {index} {time}");
            }
        }
        let last = log.messages.last().unwrap();
        assert!((last.time - 45.0).abs() < 1e-3, "{by} {}", last.time);
        assert_eq!(log.utc_at_zero, Some(1.7e9 + 7200.0));
        let told = &log.report.remarks[0];
        assert!(told.contains("the receiver's clock was set"), "{told}");
    }
}

#[test]
fn a_clock_set_by_seconds_is_told_as_one_and_a_late_link_is_not() {
    for by in [10.0, -15.0, 1.5] {
        let log = log(|i, r| r + if i > 150 { by } else { 0.0 }, regular);
        let times = times(&log, "ATTITUDE");
        assert!((times[299] - times[0] - 59.8).abs() < 1e-3, "{by}");
        let way = if by > 0.0 { "forward" } else { "back" };
        let wanted = format!("set {way} by {:.1} s", f64::abs(by));
        let remarks = &log.report.remarks;
        assert!(
            remarks.len() == 1 && remarks[0].contains(&wanted),
            "{by} {remarks:?}"
        );
    }
    // Links stall as they begin and end.
    for stall in [0..30, 270..300] {
        let stalled = |i: u32, r: f64| r + if stall.contains(&i) { 2.0 } else { 0.0 };
        let remarks = log(stalled, regular).report.remarks;
        assert!(
            remarks.iter().all(|remark| !remark.contains("set")),
            "{stall:?} {remarks:?}"
        );
    }
    let late = |i: u32, r: f64| {
        r + if i < 150 {
            0.0
        } else {
            0.1 * f64::from((i - 150).min(225 - i.min(225)))
        }
    };
    let remarks = log(late, regular).report.remarks;
    assert!(
        remarks.iter().all(|remark| !remark.contains("set")),
        "{remarks:?}"
    );
}

#[test]
fn a_clock_set_forth_and_back_again_leaves_one_flight() {
    let log = log(
        |i, r| r + if (60..200).contains(&i) { 3600.0 } else { 0.0 },
        regular,
    );
    let times = times(&log, "VFR_HUD");
    assert_eq!(times.len(), 300);
    assert!((times[299] - 59.8).abs() < 1e-3, "{}", times[299]);
}

#[test]
fn a_clock_that_was_never_set_before_gives_the_date_behind_it() {
    let years = 3.0e8;
    let log = log(|i, r| r + if i > 150 { years } else { 0.0 }, regular);
    assert!((times(&log, "ATTITUDE")[299] - 59.8).abs() < 1e-3);
    let utc = log.utc_at_zero.unwrap();
    assert!((utc - (1.7e9 + 7200.0 + years)).abs() < 1e-2, "{utc}");
}

#[test]
fn a_pause_of_both_clocks_is_a_pause_and_a_burst_behind_one_is_no_leap() {
    let pause = |i: u32| if i > 150 { 600.0 } else { 0.0 };
    let paused = log(|i, r| r + pause(i), |i| regular(i) + 1000 * pause(i) as u32);
    assert!((times(&paused, "VFR_HUD")[299] - 659.8).abs() < 1e-3);
    assert_eq!(paused.report.remarks, Vec::<String>::new());
    // Thirty seconds come at once.
    let held = |i: u32, r: f64| {
        if (60..210).contains(&i) {
            42.0 + 1e-3 * f64::from(i - 60)
        } else {
            r
        }
    };
    let held = log(held, regular);
    assert!((times(&held, "ATTITUDE")[299] - 59.8).abs() < 1e-3);
    let remarks = &held.report.remarks;
    assert!(!remarks.iter().any(|r| r.contains("set")), "{remarks:?}");
}

#[test]
fn a_vehicle_that_starts_again_is_still_a_second_start() {
    let boot = |i: u32| {
        if i < 150 {
            regular(i)
        } else {
            regular(i - 150)
        }
    };
    // The second counts from zero, or is heard for the first time after minutes.
    let later = |i: u32| regular(i) + if i < 150 { 0 } else { 200_000 };
    for boot in [&boot as &dyn Fn(u32) -> u32, &later] {
        let log = log(|i, r| r + if i >= 150 { 600.0 } else { 0.0 }, boot);
        assert!((times(&log, "VFR_HUD")[299] - 659.8).abs() < 1e-3);
    }
}

#[test]
fn single_wrong_times_of_the_receiver_are_no_clock_that_was_set() {
    // Bits of the receiver's times that fell over, as damage does that no checksum tells: two in ten rows.
    for seed in 0..11 {
        for (from, to) in [(60, 240), (3, 100), (200, 299)] {
            let wrong = |i: u32| (from..to).contains(&i) && (i % 10 == 3 || i % 10 == 6);
            let clock = |i: u32, r: f64| {
                let bit = 25 + (3 * i + seed) % 11;
                let by = 2_f64.powi(bit as i32) * 1e-6;
                match (wrong(i), i % 4) {
                    (true, 0 | 3) => r - by,
                    (true, _) => r + by,
                    _ => r,
                }
            };
            let log = log(clock, regular);
            let times = times(&log, "ATTITUDE");
            assert_eq!(times.len(), 300, "{seed} {from}");
            for (index, time) in times.iter().enumerate() {
                let right = 0.2 * index as f64;
                assert!((time - right).abs() < 1e-3, "{seed} {from} {index} {time}");
            }
            let remarks = &log.report.remarks;
            let is_set = remarks.iter().any(|remark| remark.contains("was set"));
            assert!(!is_set, "{seed} {from} {remarks:?}");
        }
    }
}
