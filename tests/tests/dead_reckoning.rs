//! Recorded flights of the Skywalker X-8 with satellite navigation cut out of them again and again.
//!
//! The noise that the filters expect by default was made likeliest on these same flights: the errors below say
//! what is possible with them, not what a flight that nobody has seen will show.

use pilotage_core::flight::Flight;
use pilotage_core::instruments::{
    CutPlan, CutStudy, Instruments, ReckonSettings, Way, reckon, rolling_track, study_cuts,
};
use pilotage_tests::recorded;

fn flight(name: &str) -> Option<Flight> {
    let folder = recorded::flight(name, "inertialnav_x8")?.expect("the flight reads");
    Some(folder.flight)
}

/// Cuts of `length` seconds, one every `every` seconds of the flight.
fn study(flight: &Flight, way: &Way, length: f64, every: f64) -> CutStudy {
    let instruments = Instruments::of(flight, None).expect("it has instruments");
    let plan = CutPlan {
        length,
        every,
        ..CutPlan::default()
    };
    let settings = ReckonSettings::default();
    let study = study_cuts(&instruments, way, &plan, &settings, &mut |_| true);
    let study = study.expect("the filter goes on");
    let (median, ninety) = (study.error_quantile(0.5), study.error_quantile(0.9));
    let covered = 100.0 * study.covered();
    println!(
        "{}, {length} s: {} cuts, median {median:.1} m, 90 % {ninety:.1} m, {covered:.0} % inside",
        study.label,
        study.cuts.len()
    );
    study
}

#[test]
fn a_minute_without_gps_costs_less_than_42_metres_in_half_of_the_cuts() {
    let Some(flight) = flight("testlog2") else {
        return;
    };
    for way in [Way::air_and_wind(), Way::by_logged_heading()] {
        let study = study(&flight, &way, 60.0, 2.0);
        assert!(study.cuts.len() > 100, "{} cuts", study.cuts.len());
        assert!(study.error_quantile(0.5) <= 42.0 && study.error_quantile(0.9) <= 75.0);
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
    let study = study(&flight, &Way::by_gyros(), 60.0, 2.0);
    assert!(study.error_quantile(0.5) <= 52.0);
    assert!(
        (0.85..=1.0).contains(&study.covered()),
        "{}",
        study.covered()
    );
}

#[test]
fn delays_pitch_and_gusts_halve_the_errors_of_the_plain_filter() {
    let Some(flight) = flight("testlog2") else {
        return;
    };
    let full = study(&flight, &Way::air_and_wind(), 60.0, 2.0);
    let plain = study(&flight, &Way::plain(), 60.0, 2.0);
    let ratio = |share| full.error_quantile(share) / plain.error_quantile(share);
    let (median, ninety) = (ratio(0.5), ratio(0.9));
    println!("full beside plain: median {median:.2}, 90 % {ninety:.2}");
    assert!(median <= 0.8 && ninety <= 0.6, "{median} {ninety}");
}

#[test]
fn a_heading_that_its_gyros_contradict_is_told_and_not_believed() {
    let Some(flight) = flight("inputfiles_px4") else {
        return;
    };
    let study = study(&flight, &Way::air_and_wind(), 30.0, 2.0);
    assert!(study.error_quantile(0.5) <= 40.0);
    let instruments = Instruments::of(&flight, None).expect("it has instruments");
    let (begin, end) = instruments.stretch;
    let cut = (0.5 * (begin + end), 0.5 * (begin + end) + 30.0);
    let ways = [Way::air_and_wind(), Way::gps_throughout()];
    let settings = ReckonSettings::default();
    let found = reckon(&instruments, cut, &ways, &settings, |_| true).expect("the filter goes on");
    let titles: Vec<&str> = found.findings.iter().map(|f| f.title.as_str()).collect();
    let is_told = |title: &&str| title.contains("disagree by");
    assert!(titles.iter().any(is_told), "{titles:?}");
    // Where satellite navigation goes on, its track is followed.
    let aided = &found.tracks[1].growth(cut);
    let worst = aided.iter().filter_map(|g| g.error).fold(0.0, f64::max);
    assert!(worst < 15.0, "{worst} m with satellite navigation");
    let alone = found.tracks[0].growth(cut);
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
    let whole = instruments.calibrate(end, Way::air_and_wind().heading, &settings.calibration);
    let whole = whole.fit.expect("a fit over the whole flight").wind;
    let track = rolling_track(&instruments, &Way::air_and_wind(), &settings);
    let track = track.expect("the filter goes on");
    let later = track.points.iter().filter(|p| p.time > begin + 60.0);
    let errors: Vec<f64> = later.map(|p| (p.wind - whole).norm_squared()).collect();
    let rms = (errors.iter().sum::<f64>() / errors.len() as f64).sqrt();
    println!("wind: {rms:.2} m/s RMS beside {whole:.2?}");
    assert!(rms <= 1.0, "{rms} m/s");
}
