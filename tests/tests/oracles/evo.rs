//! Trajectory errors beside those of evo, sample by sample.

use nalgebra::Point3;
use pilotage_core::flight::trajectory::{
    Delta, ErrorStatistics, PlacePair, TrajectoryAlignment, absolute_errors, relative_errors,
};
use pilotage_tests::oracle::ask;
use serde::{Deserialize, Serialize};

#[derive(Serialize)]
struct Question {
    times: Vec<f64>,
    estimate: Vec<[f64; 3]>,
    reference: Vec<[f64; 3]>,
    alignment: TrajectoryAlignment,
    samples: usize,
}

#[derive(Deserialize)]
struct Statistics {
    rmse: f64,
    mean: f64,
    median: f64,
    std: f64,
    min: f64,
    max: f64,
    sse: f64,
}

#[derive(Deserialize)]
struct Errors {
    errors: Vec<f64>,
    statistics: Statistics,
}

#[derive(Deserialize)]
struct Answer {
    absolute: Errors,
    relative: Errors,
}

/// A flight in spirals, and an estimate of it that drifts, is turned, a little too large, and jumps once.
fn trajectories() -> Vec<PlacePair> {
    let pair = |i: u32| {
        let t = 0.2 * f64::from(i);
        let reference = Point3::new(
            (40.0 + t) * (0.11 * t).cos(),
            (60.0 + 0.5 * t) * (0.11 * t).sin(),
            -30.0 - 8.0 * (0.05 * t).sin(),
        );
        let (sin, cos) = 0.35_f64.sin_cos();
        let jump = if t > 55.0 { 6.0 } else { 0.0 };
        let estimate = Point3::new(
            1.03 * (cos * reference.x - sin * reference.y) + 12.0 + jump,
            1.03 * (sin * reference.x + cos * reference.y) - 7.0 + 0.08 * t,
            1.03 * reference.z + 2.0 * (0.9 * t).sin(),
        );
        PlacePair {
            time: t,
            estimate,
            reference,
        }
    };
    (0..500).map(pair).collect()
}

fn agree(name: &str, ours: &[(f64, f64)], theirs: &Errors) {
    assert_eq!(ours.len(), theirs.errors.len(), "{name}");
    for ((time, own), other) in ours.iter().zip(&theirs.errors) {
        assert!(
            (own - other).abs() < 1e-8,
            "{name} at {time}: {own} {other}"
        );
    }
    let own = ErrorStatistics::of(ours.iter().map(|e| e.1)).expect("there are errors");
    let other = &theirs.statistics;
    for (what, own, other) in [
        ("rmse", own.rmse, other.rmse),
        ("mean", own.mean, other.mean),
        ("median", own.median, other.median),
        ("std", own.standard_deviation, other.std),
        ("min", own.least, other.min),
        ("max", own.greatest, other.max),
        ("sse", own.sum_of_squares, other.sse),
    ] {
        let scale = other.abs().max(1.0);
        assert!(
            (own - other).abs() < 1e-8 * scale,
            "{name} {what}: {own} {other}"
        );
    }
}

#[test]
fn errors_are_those_of_evo_for_every_alignment() {
    let pairs = trajectories();
    let samples = 25;
    for alignment in [
        TrajectoryAlignment::None,
        TrajectoryAlignment::Origin,
        TrajectoryAlignment::Rigid,
        TrajectoryAlignment::Similarity,
    ] {
        let question = Question {
            times: pairs.iter().map(|p| p.time).collect(),
            estimate: pairs.iter().map(|p| p.estimate.coords.into()).collect(),
            reference: pairs.iter().map(|p| p.reference.coords.into()).collect(),
            alignment,
            samples,
        };
        let Some(answer): Option<Answer> = ask("evo_errors.py", &question) else {
            return;
        };
        let name = format!("{alignment:?}");
        agree(&name, &absolute_errors(&pairs, alignment), &answer.absolute);
        let relative = relative_errors(&pairs, Delta::Samples(samples));
        agree("relative", &relative, &answer.relative);
    }
}
