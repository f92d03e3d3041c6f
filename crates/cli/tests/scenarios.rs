//! The built-in scenarios against their bars, on another day than the map's, over a few seeds.
//!
//! The figures over twenty seeds are in docs/results.md (`cargo xtask test --studies` asks them again); the
//! everyday runs notice when they go.

use std::process::Command;

use pilotage_tests::studies::either;
use serde_json::Value;

/// Seeds of a run; the mean NEES of so few scatters more widely than that of twenty.
fn study(scenario: &str, seeds: &str) -> (Value, f64) {
    let summary =
        std::env::temp_dir().join(format!("pilotage-{scenario}-{}.json", std::process::id()));
    let out = Command::new(env!("CARGO_BIN_EXE_pilotage"))
        .args([
            "replay",
            "--scenario",
            scenario,
            "--seeds",
            seeds,
            "--day",
            "other",
            "--summary",
        ])
        .arg(&summary)
        .output()
        .expect("the program starts");
    assert!(
        out.status.success(),
        "{}",
        String::from_utf8_lossy(&out.stderr)
    );
    println!("{scenario}\n{}", String::from_utf8_lossy(&out.stdout));
    let text = std::fs::read_to_string(&summary).expect("a summary was written");
    std::fs::remove_file(&summary).ok();
    let study: Value = serde_json::from_str(&text).expect("the summary is JSON");
    let runs = study["runs"].as_array().expect("runs").len();
    (study, runs as f64)
}

fn quantile(study: &Value, figure: &str, which: &str) -> f64 {
    let all = study["quantiles"].as_array().expect("quantiles");
    let row = all
        .iter()
        .find(|q| q["figure"] == figure)
        .expect("the figure is there");
    row[which].as_f64().expect("a number")
}

fn check(scenario: &str, seeds: &str, most_rms: f64) {
    let (study, runs) = study(scenario, seeds);
    let rms = quantile(&study, "position_error_m.rms", "median");
    let over_bound = study["error_over_bound"]
        .as_f64()
        .expect("the truth is known");
    let wind = quantile(&study, "wind_error_after_minute_mps.rms", "median");
    let nees = quantile(&study, "nees.mean", "mean");
    let wrong = quantile(&study, "updates_wrong", "mean") * runs;
    let accepted = quantile(&study, "updates_accepted", "mean") * runs;
    assert!(rms <= most_rms, "median RMS {rms} m");
    assert!(
        over_bound <= 1.25,
        "error over the Cramér-Rao bound {over_bound}"
    );
    assert!(wind <= 0.5, "wind error {wind} m/s");
    let (low, high) = pilotage_core::filter::mean_interval(2.0, runs as usize);
    assert!(
        (low..=high).contains(&nees),
        "mean NEES {nees} outside {low} to {high}"
    );
    assert!(
        wrong <= 0.002 * accepted,
        "{wrong} wrong of {accepted} accepted"
    );
}

#[test]
fn four_hundred_feet_in_wind() {
    check("distinct-400ft-wind", either("1..3", "1..21"), 5.5);
}

#[test]
fn four_hundred_feet_in_calm_air() {
    check("distinct-400ft-calm", either("1..3", "1..21"), 3.5);
}

#[test]
fn a_thousand_feet_with_turns() {
    check("distinct-1000ft-extended", either("1..2", "1..21"), 6.0);
}
