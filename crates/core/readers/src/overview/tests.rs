//! Flights that are made here, and what is said of them.

use nalgebra::{Point3, Vector2};
use pilotage_flight::in_log_time;

use super::super::interpret::{Role, RoleSeries};
use super::*;
use pilotage_flight::TruthState;

fn series(role: Role, times: Vec<f64>, values: Vec<f64>) -> RoleSeries {
    RoleSeries {
        role,
        source: format!("TEST.{role:?}"),
        times,
        values,
        implausible: 0,
        out_of_order: 0,
        is_held: false,
    }
}

/// Findings about sensors in a flight of an hour.
fn told(found: &[&RoleSeries]) -> Vec<Finding> {
    let sensors: Vec<Sensor> = found.iter().map(|series| Sensor::of(series)).collect();
    causes::findings(&sensors, &[(0.0, 3600.0)])
}

/// Five rows a second for so many seconds.
fn times(seconds: usize) -> Vec<f64> {
    (0..5 * seconds).map(|i| 0.2 * i as f64).collect()
}

#[test]
fn a_track_alone_tells_that_it_flies_from_beginning_to_end() {
    let times = times(100);
    // At 20 m/s, down to the height of the beginning and up again.
    let height = |t: &f64| 120.0 + 20.0 * (t / 9.0).sin();
    let found = [
        series(
            Role::Latitude,
            times.clone(),
            times.iter().map(|t| 0.8 + 20.0 * t / 6.371e6).collect(),
        ),
        series(Role::Longitude, times.clone(), vec![0.1; times.len()]),
        series(
            Role::GpsHeight,
            times.clone(),
            times.iter().map(height).collect(),
        ),
    ];
    let flown = airborne::airborne(&found);
    assert_eq!(flown.len(), 1, "{flown:?}");
    assert!(flown[0].1 - flown[0].0 > 98.0, "{flown:?}");
    // One that rests with a receiver's noise does not fly.
    let rest: Vec<f64> = (0..times.len())
        .map(|i| 0.8 + 2e-7 * f64::from(i as u32 % 3))
        .collect();
    let found = [
        series(Role::Latitude, times.clone(), rest),
        series(Role::Longitude, times.clone(), vec![0.1; times.len()]),
    ];
    assert!(airborne::airborne(&found).is_empty());
}

/// A circling flight from second 20 to second 100 of 120, its airspeed sensor reading by a factor wrong.
fn circling(wind: Vector2<f64>, reads: f64) -> Vec<RoleSeries> {
    let times = times(120);
    let flies = |t: f64| (20.0..100.0).contains(&t);
    let heading = |t: f64| pilotage_base::frames::wrap_pi(0.1 * t);
    let of = |role, value: &dyn Fn(f64) -> f64| {
        let values = times.iter().map(|t| value(*t)).collect();
        series(role, times.clone(), values)
    };
    let airspeed = |t: f64| {
        if flies(t) {
            18.0 + (0.3 * t).sin()
        } else {
            0.2 * t.sin()
        }
    };
    let ground = move |t: f64, direction: f64, wind: f64| {
        if flies(t) {
            airspeed(t) * direction + wind
        } else {
            0.1
        }
    };
    vec![
        of(Role::Airspeed, &|t| reads * airspeed(t)),
        of(Role::Heading, &heading),
        of(Role::GpsVelocityNorth, &|t| {
            ground(t, heading(t).cos(), wind.x)
        }),
        of(Role::GpsVelocityEast, &|t| {
            ground(t, heading(t).sin(), wind.y)
        }),
    ]
}

#[test]
fn the_stretch_in_the_air_is_found_between_take_off_and_landing() {
    let found = circling(Vector2::new(2.0, -1.0), 1.0);
    let stretches = airborne(&found);
    assert_eq!(stretches.len(), 1, "{stretches:?}");
    let (from, to) = stretches[0];
    assert!(
        (from - 20.0).abs() < 0.5 && (to - 100.0).abs() < 0.5,
        "{from} {to}"
    );
}

#[test]
fn hovering_without_a_barometer_is_in_the_air_and_standing_is_not() {
    let flight = |height: f64, role| {
        let times = times(60);
        let of = |role, value: &dyn Fn(f64) -> f64| {
            series(
                role,
                times.clone(),
                times.iter().map(|t| value(*t)).collect(),
            )
        };
        let up = move |t: f64| {
            if (10.0..50.0).contains(&t) {
                height
            } else {
                0.0
            }
        };
        vec![
            of(Role::GpsVelocityNorth, &|t| 0.3 * t.sin()),
            of(Role::GpsVelocityEast, &|_| 0.1),
            of(role, &|t| up(t) + (0.2 * t).sin()),
        ]
    };
    for role in [Role::GpsHeight, Role::HeightAboveGround] {
        let stretches = airborne(&flight(20.0, role));
        assert_eq!(stretches.len(), 1, "{stretches:?}");
        let (from, to) = stretches[0];
        assert!(
            (from - 10.0).abs() < 0.5 && (to - 50.0).abs() < 0.5,
            "{from} {to}"
        );
        assert_eq!(airborne(&flight(0.0, role)), []);
    }
}

#[test]
fn photos_taken_well_above_the_ground_were_taken_in_the_air_however_far_apart() {
    let times: Vec<f64> = (0..10).map(|i| 7.0 * f64::from(i)).collect();
    let heights = vec![40.0; times.len()];
    let found = [series(Role::HeightAboveGround, times.clone(), heights)];
    assert_eq!(airborne(&found), [(0.0, 63.0)]);
    let low = [series(Role::HeightAboveGround, times, vec![1.0; 10])];
    assert_eq!(airborne(&low), []);
}

#[test]
fn what_a_gimbal_holds_is_neither_dead_nor_stuck() {
    let mut held = series(Role::Pitch, times(60), vec![0.1; 300]);
    assert!(!told(&[&held]).is_empty());
    held.is_held = true;
    assert!(told(&[&held]).is_empty());
}

#[test]
fn one_cause_is_one_note_and_on_the_ground_nothing_is_stuck() {
    let gap = |role| {
        let kept = times(60).into_iter().filter(|t| !(10.0..14.0).contains(t));
        let kept: Vec<f64> = kept.collect();
        let values = kept.iter().map(|t| t.sin()).collect();
        series(role, kept, values)
    };
    let lost = [Role::Latitude, Role::Longitude, Role::GpsHeight].map(gap);
    let findings = told(&lost.each_ref());
    assert_eq!(findings.len(), 1, "{findings:?}");
    assert!(
        findings[0]
            .title
            .starts_with("Latitude and 2 more are missing for 4.")
    );
    let dead = [Role::Roll, Role::Pitch].map(|role| series(role, times(20), vec![0.0; 100]));
    let findings = told(&dead.each_ref());
    assert_eq!(findings[0].title, "Roll and 1 more never move");
    assert_eq!(findings.len(), 1);
    // An estimator of a wind that says nothing is no sensor that is not there.
    assert!(told(&[&series(Role::WindNorth, times(20), vec![0.0; 100])]).is_empty());
    let mut values: Vec<f64> = times(60).iter().map(|t| 18.0 + t.sin()).collect();
    values[100..160].fill(17.0);
    let stuck = [Sensor::of(&series(Role::Airspeed, times(60), values))];
    assert_eq!(causes::findings(&stuck, &[(0.0, 60.0)]).len(), 1);
    assert_eq!(causes::findings(&stuck, &[(40.0, 60.0)]), []);
}

#[test]
fn what_the_autopilot_says_of_flying_is_believed_and_two_flights_are_two() {
    use super::super::log::{Cells, Column, LogFormat, ModeChange};
    let mut log = Log::new("two", LogFormat::Dataflash);
    let events = [
        (1.0, 10.0),
        (5.0, 28.0),
        (40.0, 18.0),
        (60.0, 28.0),
        (90.0, 18.0),
        (95.0, 11.0),
    ];
    let times = events.map(|(time, _)| Some(time));
    let ids = Column {
        name: "Id".to_owned(),
        unit: String::new(),
        cells: Cells::Numbers(events.map(|(_, id)| id).to_vec()),
    };
    log.add_columns("EV", &times, &[ids]);
    for (time, mode) in [(0.0, "STABILIZE"), (20.0, "AUTO"), (50.0, "LOITER")] {
        log.modes.push(ModeChange {
            time,
            mode: mode.to_owned(),
        });
    }
    let flights = states::airborne(&log).unwrap();
    assert_eq!(flights, [(5.0, 40.0), (60.0, 90.0)]);
    let told = states::several(&log, &flights, |_| true).unwrap();
    assert_eq!(told.title, "2 flights in one log");
    assert_eq!(
        in_log_time(&told.text),
        "It was in the air from 5.0 s to 40.0 s (STABILIZE, AUTO), from 60.0 s to 90.0 s (LOITER)."
    );
    assert_eq!(states::several(&log, &flights[..1], |_| true), None);
}

#[test]
fn what_never_leaves_the_ground_was_never_in_the_air() {
    let times = times(60);
    let wander: Vec<f64> = times.iter().map(|t| 0.3 * t.sin()).collect();
    let found = [
        series(Role::GpsVelocityNorth, times.clone(), wander.clone()),
        series(Role::GpsVelocityEast, times, wander),
    ];
    assert_eq!(airborne(&found), []);
}

#[test]
fn wind_and_scale_of_the_airspeed_are_found_over_a_circle() {
    let wind = Vector2::new(3.0, -4.0);
    let found = circling(wind, 1.25);
    let fit = fit_air_data(&found, &airborne(&found)).unwrap();
    assert!((fit.scale - 0.8).abs() < 1e-3, "{fit:?}");
    assert!((fit.wind - wind).norm() < 0.05, "{fit:?}");
    let finding = &fit.findings()[0];
    assert_eq!(finding.title, "Airspeed reads 25 % too fast");
    assert_eq!(finding.severity, Severity::Warning);
    let right = circling(wind, 1.0);
    let fit = fit_air_data(&right, &airborne(&right)).unwrap();
    assert!(fit.findings().is_empty());
}

#[test]
fn an_airspeed_that_has_nothing_to_do_with_the_track_is_no_scale() {
    let mut found = circling(Vector2::zeros(), 1.0);
    let airspeed = found.iter_mut().find(|s| s.role == Role::Airspeed).unwrap();
    for value in &mut airspeed.values {
        *value *= 0.01;
    }
    let fit = fit_air_data(&found, &airborne(&found)).unwrap();
    let title = &fit.findings()[0].title;
    assert_eq!(title, "Airspeed, heading and track contradict each other");
}

#[test]
fn a_straight_flight_does_not_tell_wind_from_scale() {
    let mut found = circling(Vector2::zeros(), 1.0);
    for value in &mut found[1].values {
        *value = 0.3;
    }
    assert_eq!(fit_air_data(&found, &[(20.0, 100.0)]), None);
}

#[test]
fn a_gap_a_stuck_sensor_and_a_dead_one_are_told_with_their_times() {
    let mut gap = series(Role::Heading, times(60), Vec::new());
    gap.values = gap.times.iter().map(|t| t.sin()).collect();
    let keep: Vec<bool> = gap
        .times
        .iter()
        .map(|t| !(10.0..14.0).contains(t))
        .collect();
    let mut kept = keep.iter();
    gap.times.retain(|_| *kept.next().unwrap());
    let mut kept = keep.iter();
    gap.values.retain(|_| *kept.next().unwrap());
    let sensor = Sensor::of(&gap);
    assert!((sensor.rate - 5.0).abs() < 1e-6);
    assert_eq!(sensor.gaps.len(), 1);
    assert!(
        told(&[&gap])[0]
            .title
            .starts_with("Heading is missing for 4.")
    );

    let mut stuck = series(Role::Airspeed, times(60), Vec::new());
    let value = |t: f64| {
        if (20.0..32.0).contains(&t) {
            17.0
        } else {
            18.0 + t.sin()
        }
    };
    stuck.values = stuck.times.iter().map(|t| value(*t)).collect();
    let finding = &told(&[&stuck])[0];
    assert_eq!(finding.title, "Airspeed is stuck for 12 s");
    let (from, to) = finding.span.unwrap();
    assert!((from - 20.0).abs() < 0.3 && (to - 31.8).abs() < 0.3);

    let dead = series(Role::Pitch, times(20), vec![0.0; 100]);
    assert_eq!(told(&[&dead])[0].title, "Pitch never moves");
}

#[test]
fn a_jump_of_the_position_that_no_velocity_explains_is_a_glitch() {
    let times = times(60);
    let velocity = vec![10.0; times.len()];
    let found = [
        series(Role::GpsVelocityNorth, times.clone(), velocity),
        series(Role::GpsVelocityEast, times.clone(), vec![0.0; times.len()]),
    ];
    let state = |jump: f64, i: usize, t: f64| TruthState {
        time: t,
        position: Point3::new(
            10.0 * t + 0.1 * (i % 3) as f64,
            if t > 30.1 { jump } else { 0.0 },
            0.0,
        ),
        attitude: None,
        wind: None,
    };
    let states = |jump: f64| -> Vec<TruthState> {
        times
            .iter()
            .enumerate()
            .map(|(i, t)| state(jump, i, *t))
            .collect()
    };
    let findings = glitch::findings(&found, &states(40.0));
    assert_eq!(findings[0].title, "GPS jumps by 40 m");
    assert!((findings[0].span.unwrap().0 - 30.2).abs() < 1e-6);
    assert!(glitch::findings(&found, &states(0.0)).is_empty());
}

#[test]
fn photos_with_minutes_between_them_are_one_set_and_landings_between_rows_part_flights() {
    // Six times four photos, two seconds apart, with three minutes in between.
    let taken: Vec<f64> = (0..24)
        .map(|i| f64::from(180 * (i / 4) + 2 * (i % 4)))
        .collect();
    let high = vec![80.0; taken.len()];
    let photos = [series(Role::HeightAboveGround, taken, high)];
    // A flight, a minute on the ground, a flight.
    let rows = times(180);
    let height = |t: &f64| if (60.0..120.0).contains(t) { 0.0 } else { 80.0 };
    let heights = rows.iter().map(height).collect();
    let landed = [series(Role::HeightAboveGround, rows, heights)];
    for (found, parts, flights) in [
        (&photos, 6, None),
        (&landed, 2, Some("2 flights in one log")),
    ] {
        let airborne = airborne(found);
        assert_eq!(airborne.len(), parts);
        let log = Log::new("rows", super::super::log::LogFormat::Dataflash);
        let told = states::several(&log, &airborne, |pause| states::is_watched(found, pause));
        assert_eq!(told.map(|told| told.title).as_deref(), flights);
    }
}
