//! Fits and ellipses on flights that nothing was made for.

use super::generated::{GeneratedPlan, Wander};
use super::*;

/// Flights of each plan for fits, and for outages: that of docs/results.md needs `PILOTAGE_SEEDS=30`.
const SEEDS: u64 = 30;
const OUTAGES: u64 = 8;

fn outage_seeds() -> u64 {
    let asked = std::env::var("PILOTAGE_SEEDS").ok();
    asked.and_then(|n| n.parse().ok()).unwrap_or(OUTAGES)
}

/// Results of the fits of a plan's flights.
struct Fits {
    /// Airspeed scales less the true one, in numbers and in stated deviations.
    scales: Vec<(f64, f64)>,
    /// Squared errors of the wind in stated deviations, of two axes.
    winds: Vec<f64>,
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

impl Fits {
    fn of(plan: &GeneratedPlan) -> Self {
        Self::by(plan, HeadingChoice::Logged)
    }

    fn by(plan: &GeneratedPlan, heading: HeadingChoice) -> Self {
        let settings = CalibrationSettings::default();
        let (mut scales, mut winds) = (Vec::new(), Vec::new());
        for seed in 0..SEEDS {
            let generated = plan.fly(seed);
            let instruments = Instruments::of(&generated.flight, None).unwrap();
            let end = instruments.stretch.1;
            let known = instruments.calibrate(end, heading, &settings);
            let fit = known.fit.unwrap();
            let off = fit.scale - plan.scale;
            scales.push((off, off / fit.scale_deviation));
            let wind = fit.wind - generated.wind;
            winds.push(wind.norm_squared() / fit.wind_deviation.powi(2));
        }
        Self { scales, winds }
    }

    fn is_honest(&self, what: &str, most: f64) {
        let bias = mean(self.scales.iter().map(|(off, _)| *off));
        let largest = self.scales.iter().map(|(off, _)| off.abs());
        let largest = largest.fold(0.0, f64::max);
        let nees = mean(self.scales.iter().map(|(_, off)| off * off));
        let wind = mean(self.winds.iter().copied());
        println!(
            "{what}: scale off by {bias:.4} in the mean, {largest:.3} at most, NEES {nees:.2} (1); wind NEES {wind:.2} (2)"
        );
        assert!(bias.abs() < most, "{what}: {bias}");
        assert!(largest < 0.1, "{what}: {largest}");
        // 95 % of the means of 30 squares lie between 0.56 and 1.57; what is stated may be wide, not narrow.
        assert!((0.3..1.6).contains(&nees), "{what}: {nees}");
        assert!((0.6..4.0).contains(&wind), "{what}: {wind}");
    }
}

/// Outages of a minute, one after the other.
fn outages(plan: &GeneratedPlan) -> Vec<OutageOutcome> {
    let every_minute = OutagePlan {
        length: 60.0,
        every: 60.0,
        warm_up: 60.0,
    };
    let settings = ReckonSettings::default();
    let way = ReckoningWay::air_and_wind();
    let of_seed = |seed| {
        let generated = plan.fly(seed);
        let instruments = Instruments::of(&generated.flight, None).unwrap();
        let study = study_outages(&instruments, &way, &every_minute, &settings, &mut |_| true);
        study.unwrap().outages
    };
    (0..outage_seeds()).flat_map(of_seed).collect()
}

/// 95 % interval of a probability of which `share` of `count` trials came true; Wilson 1927.
fn interval(share: f64, count: f64) -> (f64, f64) {
    let z = 1.96_f64;
    let scale = 1.0 / (1.0 + z * z / count);
    let middle = scale * (share + z * z / (2.0 * count));
    let half = scale * z * (share * (1.0 - share) / count + (z / (2.0 * count)).powi(2)).sqrt();
    (middle - half, middle + half)
}

/// Asserts that the 95 % ellipse holds at least the share `least` of the ends.
fn hold(what: &str, plan: &GeneratedPlan, least: f64) {
    let outages = outages(plan);
    let inside = outages
        .iter()
        .filter(|outage| outage.squared() <= 5.991)
        .count();
    let (inside, count) = (inside as f64, outages.len() as f64);
    let (low, high) = interval(inside / count, count);
    let errors = outages.iter().map(|outage| outage.error.norm()).collect();
    println!(
        "{what}: {inside} of {count} ends inside ({:.0} to {:.0} %), median {:.0} m",
        100.0 * low,
        100.0 * high,
        quantile(errors, 0.5)
    );
    assert!(inside / count >= least, "{what}: {inside} of {count}");
}

#[test]
fn the_airspeed_scale_is_that_of_the_flight_whatever_else_moves_it() {
    let legs = GeneratedPlan::default();
    let noisy = GeneratedPlan {
        airspeed_noise: Wander(2.0, 0.7),
        ..legs
    };
    let gusty = GeneratedPlan {
        gusts: Wander(2.0, 15.0),
        velocity: Wander(1.0, 2.0),
        ..legs
    };
    Fits::of(&legs).is_honest("legs", 0.015);
    Fits::of(&noisy).is_honest("noisy airspeed", 0.015);
    Fits::of(&gusty).is_honest("strong gusts, noisy velocity", 0.02);
}

/// The generated gyros drift by 0.002 rad/s: over the flight by an angle that is not small.
#[test]
fn the_scale_by_the_heading_of_gyros_is_as_honest() {
    let legs = GeneratedPlan::default();
    Fits::by(&legs, HeadingChoice::Gyros).is_honest("gyros", 0.015);
}

#[test]
fn a_short_flight_and_one_in_circles_know_how_little_they_know() {
    let legs = GeneratedPlan::default();
    let short = GeneratedPlan {
        duration: 130.0,
        leg: 30.0,
        ..legs
    };
    let circles = GeneratedPlan {
        duration: 200.0,
        leg: 0.0,
        ..legs
    };
    let slipping = GeneratedPlan {
        duration: 200.0,
        slip: Wander(0.1, 6.0),
        heading: Wander(0.08, 60.0),
        ..legs
    };
    Fits::of(&short).is_honest("short", 0.03);
    Fits::of(&circles).is_honest("circles", 0.015);
    Fits::of(&slipping).is_honest("slip and heading", 0.03);
}

#[test]
fn ellipses_hold_the_ends_of_outages() {
    let legs = GeneratedPlan {
        duration: 310.0,
        ..GeneratedPlan::default()
    };
    hold("legs", &legs, 0.85);
}

#[test]
fn ellipses_hold_with_a_noisy_airspeed() {
    let noisy = GeneratedPlan {
        duration: 310.0,
        airspeed_noise: Wander(2.0, 0.7),
        ..GeneratedPlan::default()
    };
    hold("noisy airspeed", &noisy, 0.85);
}

#[test]
fn ellipses_hold_in_a_wind_that_changes() {
    let walking = GeneratedPlan {
        duration: 310.0,
        walk: 0.15,
        ..GeneratedPlan::default()
    };
    hold("walking wind", &walking, 0.8);
}
