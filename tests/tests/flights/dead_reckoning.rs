//! Recorded flights of the Skywalker X-8 with satellite navigation cut out of them again and again.
//!
//! The full filter takes its noise from the flight up to each outage. The noise of the plain one was made likeliest on
//! these same flights: its errors say what is possible, not what a flight that nobody has seen will show.

use pilotage_core::camera::CameraModel;
use pilotage_core::flight::{Channel, ChannelName, Flight, StartFix};
use pilotage_core::frames::{GroundPoint, wrap_pi};
use pilotage_core::instruments::{
    Instruments, OutagePlan, OutageStudy, ReckonSettings, ReckoningWay, likeliest, reckon,
    rolling_track, study_outages,
};
use pilotage_tests::recorded;

/// Number of flights of the plain filter while its noise is looked for.
const TUNING: usize = 60;

fn flight(name: &str) -> Option<Flight> {
    let folder = recorded::flight(name, "inertialnav_x8")?.expect("the flight reads");
    Some(folder.flight)
}

/// Outages of `length` seconds, one every `every` seconds of the flight.
fn study(flight: &Flight, way: &ReckoningWay, length: f64, every: f64) -> OutageStudy {
    let instruments = Instruments::of(flight, None).expect("it has instruments");
    let plan = OutagePlan {
        length,
        every,
        ..OutagePlan::default()
    };
    let settings = ReckonSettings::default();
    let study = study_outages(&instruments, way, &plan, &settings, &mut |_| true);
    let study = study.expect("the filter goes on");
    let (median, ninety) = (study.error_quantile(0.5), study.error_quantile(0.9));
    let covered = 100.0 * study.covered();
    println!(
        "{}, {length} s: {} outages, median {median:.1} m, 90 % {ninety:.1} m, {covered:.0} % inside",
        study.label,
        study.outages.len()
    );
    study
}

#[test]
fn a_minute_without_gps_costs_less_than_42_metres_in_half_of_the_cuts() {
    let Some(flight) = flight("testlog2") else {
        return;
    };
    for way in [
        ReckoningWay::air_and_wind(),
        ReckoningWay::by_logged_heading(),
    ] {
        let study = study(&flight, &way, 60.0, 2.0);
        assert!(study.outages.len() > 100, "{} outages", study.outages.len());
        assert!(study.error_quantile(0.5) <= 36.0 && study.error_quantile(0.9) <= 62.0);
        assert!(
            (0.85..=1.0).contains(&study.covered()),
            "{}",
            study.covered()
        );
    }
}

#[test]
fn by_the_gyros_heading_it_costs_less_than_52() {
    let Some(flight) = flight("testlog2") else {
        return;
    };
    let study = study(&flight, &ReckoningWay::by_gyros(), 60.0, 2.0);
    assert!(study.error_quantile(0.5) <= 52.0);
    assert!(
        (0.85..=1.0).contains(&study.covered()),
        "{}",
        study.covered()
    );
}

/// Outages by the plain filter, with the noise that makes their ends likeliest.
fn tuned_to_ends(flight: &Flight) -> OutageStudy {
    let instruments = Instruments::of(flight, None).expect("it has instruments");
    let outages = |noise: &[f64]| {
        let mut settings = ReckonSettings::default();
        settings.plain.air_data.position_noise_density = noise[0];
        settings.plain.wind_noise_density = noise[1];
        let plan = OutagePlan::default();
        let study = study_outages(
            &instruments,
            &ReckoningWay::plain(),
            &plan,
            &settings,
            &mut |_| true,
        );
        study.expect("the filter goes on")
    };
    let plain = ReckonSettings::default().plain;
    let start = [
        plain.air_data.position_noise_density,
        plain.wind_noise_density,
    ];
    let (noise, _) = likeliest(&start, TUNING, |noise| outages(noise).end_log_likelihood());
    let study = outages(&noise);
    println!(
        "plain, ends likeliest by {:.2} m/√s and {:.3} m/s/√s: median {:.1} m, 90 % {:.1} m, {:.0} % inside",
        noise[0],
        noise[1],
        study.error_quantile(0.5),
        study.error_quantile(0.9),
        100.0 * study.covered()
    );
    study
}

#[test]
fn delays_pitch_gusts_and_sideslip_halve_the_errors_of_the_plain_filter() {
    let Some(flight) = flight("testlog2") else {
        return;
    };
    let full = study(&flight, &ReckoningWay::air_and_wind(), 60.0, 2.0);
    let beside = |plain: &OutageStudy| {
        let ratio = |share| full.error_quantile(share) / plain.error_quantile(share);
        let (median, ninety) = (ratio(0.5), ratio(0.9));
        println!("  full beside it: median {median:.3}, 90 % {ninety:.3}");
        (median, ninety)
    };
    // The default noise makes the innovations likeliest among winds that hardly change.
    let by_innovations = study(&flight, &ReckoningWay::plain(), 60.0, 2.0);
    let (median, ninety) = beside(&by_innovations);
    assert!(median <= 0.6 && ninety <= 0.6, "{median} {ninety}");
    // Noise that fits the ends of these very outages, beside noise from before each: what is left there is mostly how the
    // wind itself changes, which no filter knows beforehand (docs/results.md), so that half is not reached.
    let by_ends = tuned_to_ends(&flight);
    let (median, ninety) = beside(&by_ends);
    assert!(median <= 0.8 && ninety <= 0.9, "{median} {ninety}");
}

#[test]
fn a_heading_that_its_gyros_contradict_is_told_and_not_believed() {
    let Some(flight) = flight("inputfiles_px4") else {
        return;
    };
    let study = study(&flight, &ReckoningWay::air_and_wind(), 30.0, 2.0);
    assert!(study.error_quantile(0.5) <= 12.0);
    assert!(study.covered() >= 0.85, "{}", study.covered());
    let instruments = Instruments::of(&flight, None).expect("it has instruments");
    let (begin, end) = instruments.stretch;
    let outage = (0.5 * (begin + end), 0.5 * (begin + end) + 30.0);
    let ways = [ReckoningWay::air_and_wind(), ReckoningWay::gps_throughout()];
    let settings = ReckonSettings::default();
    let found =
        reckon(&instruments, outage, &ways, &settings, |_| true).expect("the filter goes on");
    let titles: Vec<&str> = found.findings.iter().map(|f| f.title.as_str()).collect();
    let is_told = |title: &&str| title.contains("disagree by");
    assert!(titles.iter().any(is_told), "{titles:?}");
    // Where satellite navigation goes on, its track is followed.
    let aided = &found.tracks[1].growth(outage);
    let worst = aided.iter().filter_map(|g| g.error).fold(0.0, f64::max);
    assert!(worst < 15.0, "{worst} m with satellite navigation");
    let alone = found.tracks[0].growth(outage);
    assert!(
        alone
            .last()
            .is_some_and(|g| g.since > 29.0 && g.radius > 5.0)
    );
}

#[test]
fn the_wind_is_that_of_the_whole_flight_after_two_turns() {
    let Some(flight) = flight("testlog2") else {
        return;
    };
    let instruments = Instruments::of(&flight, None).expect("it has instruments");
    let (begin, end) = instruments.stretch;
    let settings = ReckonSettings::default();
    let whole = instruments.calibrate(
        end,
        ReckoningWay::air_and_wind().heading,
        &settings.calibration,
    );
    let whole = whole.fit.expect("a fit over the whole flight").wind;
    let track = rolling_track(&instruments, &ReckoningWay::air_and_wind(), &settings);
    let track = track.expect("the filter goes on");
    let later = track.points.iter().filter(|p| p.time > begin + 60.0);
    let errors: Vec<f64> = later.map(|p| (p.wind - whole).norm_squared()).collect();
    let rms = (errors.iter().sum::<f64>() / errors.len() as f64).sqrt();
    println!("wind: {rms:.2} m/s RMS beside {whole:.2?}");
    assert!(rms <= 1.0, "{rms} m/s");
}

/// Round and round at 16 m/s through a wind of 5 m/s, pushed sideways: for 100 s now to this side and now to that, then
/// to the left wherever it flies north and to the right wherever south, which drifts like another wind.
fn slipping() -> Flight {
    const SPEED: f64 = 16.0;
    const LENGTH: f64 = 20.0;
    const STEP: f64 = 0.05;
    let heading = |time: f64| 0.25 * time;
    let force = |time: f64| {
        if time < 100.0 {
            2.0 * (0.9 * time).sin()
        } else {
            2.0 * heading(time).cos()
        }
    };
    let times: Vec<f64> = (0..4000).map(|i| STEP * f64::from(i)).collect();
    let velocity = |time: f64| {
        let (sin, cos) = heading(time).sin_cos();
        let slip = -LENGTH * force(time) / SPEED;
        [
            SPEED * cos - slip * sin - 3.0,
            SPEED * sin + slip * cos + 4.0,
        ]
    };
    let place = |axis: usize| {
        let steps = times.iter().scan(0.0, move |at, time| {
            let before = *at;
            *at += velocity(time + 0.5 * STEP)[axis] * STEP;
            Some(before)
        });
        steps.collect()
    };
    let channel = |name, values| Channel {
        name,
        times: times.clone(),
        values,
    };
    let of = |value: &dyn Fn(f64) -> f64| times.iter().map(|t| value(*t)).collect();
    Flight {
        name: "slipping".to_owned(),
        frame_on_globe: None,
        camera: CameraModel::pinhole(640, 480, 1.0),
        ground_down: 0.0,
        channels: vec![
            channel(ChannelName::GpsNorth, place(0)),
            channel(ChannelName::GpsEast, place(1)),
            channel(ChannelName::GpsVelocityNorth, of(&|t| velocity(t)[0])),
            channel(ChannelName::GpsVelocityEast, of(&|t| velocity(t)[1])),
            channel(ChannelName::Heading, of(&|t| wrap_pi(heading(t)))),
            // No sensor shows the same all the time.
            channel(
                ChannelName::Airspeed,
                of(&|t| SPEED + 0.01 * (7.0 * t).sin()),
            ),
            channel(ChannelName::AccelerationRight, of(&force)),
        ],
        frames: Vec::new(),
        start: StartFix {
            time: 0.0,
            position: GroundPoint::default(),
            standard_deviation: 3.0,
        },
        truth: None,
    }
}

#[test]
fn a_sideslip_is_known_by_its_side_force() {
    let mut flight = slipping();
    let outages = |flight: &Flight| {
        let instruments = Instruments::of(flight, None).expect("it has instruments");
        let ways = [ReckoningWay::air_and_wind()];
        let settings = ReckonSettings::default();
        let found = reckon(&instruments, (98.0, 158.0), &ways, &settings, |_| true);
        let track = &found.expect("the filter goes on").tracks[0];
        let last = track.growth((98.0, 158.0)).pop().expect("a point");
        let error = last.error.expect("it is known where it was");
        let fit = track.calibration.fit.expect("a fit");
        println!(
            "slip of {:.1} ± {:.1} m, {error:.1} m off",
            fit.slip_length, fit.slip_deviation
        );
        (fit.slip_length, error)
    };
    let (length, error) = outages(&flight);
    assert!((length - 20.0).abs() < 1.0, "{length} m");
    assert!(error < 5.0, "{error} m");
    flight
        .channels
        .retain(|c| c.name != ChannelName::AccelerationRight);
    let (length, without) = outages(&flight);
    assert!(length == 0.0 && without > 50.0, "{length} m, {without} m");
}
