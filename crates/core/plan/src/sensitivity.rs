//! Sensitivity of the navigator to its instruments: errors that walk at random, added to one instrument at a time
//! (DeAngelo 2016, chapter 5, figures 5-36 to 5-43: 7 deviations × 4 instruments × 10 runs).
//!
//! Run number `r` has the same flight, gusts, detections and walk for every instrument and every deviation (common random
//! numbers), so that what differs along a curve is the deviation alone. Landmarks are found as stated, without pictures.

use std::sync::Arc;

use nalgebra::{Matrix4, Vector4};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

use super::{DetectionStatistics, ExpectedDetection, PlannedLandmark, as_stated};
use pilotage_base::frames::units::feet;
use pilotage_base::frames::wrap_pi;
use pilotage_base::statistics::quantile_ranks;
use pilotage_flight::{ChannelName, Flight};
use pilotage_navigator::navigator::{Navigator, summarize};
use pilotage_simulate::simulate::{Overrides, Scenario, SensorSpec};

/// Scenario whose route and wind the flights have; they fly it at 1000 ft.
const SCENARIO: &str = "distinct-400ft-wind";
/// Seconds from one step of the walk to the next: the thesis gives none, but peaks of 10 to 16 deviations, which a walk of
/// its flights' length has with some hundred steps.
const STEP: f64 = 1.0;
/// Share of frames with a landmark in view that find it.
const PER_FRAME: f64 = 0.7;
/// Deviation of a found place per axis, metres, and of turn and log size: as measured from 1000 ft.
const FOUND: (f64, f64) = (0.16, 0.01);
/// A seed of a walk is not that of another use of it.
const SALT: u64 = 0x5e_a51;

/// Instrument whose error walks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TestedInstrument {
    /// Airspeed.
    Airspeed,
    /// Roll.
    Roll,
    /// Pitch.
    Pitch,
    /// Heading.
    Yaw,
}

impl TestedInstrument {
    /// All of them, in the order of the thesis.
    pub const ALL: [Self; 4] = [Self::Airspeed, Self::Roll, Self::Pitch, Self::Yaw];

    /// Name for people.
    pub fn label(self) -> &'static str {
        match self {
            Self::Airspeed => "airspeed",
            Self::Roll => "roll",
            Self::Pitch => "pitch",
            Self::Yaw => "yaw",
        }
    }

    /// Channel of it.
    pub fn channel(self) -> ChannelName {
        match self {
            Self::Airspeed => ChannelName::Airspeed,
            Self::Roll => ChannelName::Roll,
            Self::Pitch => ChannelName::Pitch,
            Self::Yaw => ChannelName::Heading,
        }
    }

    /// Standard deviations of a walk's step that the thesis tries, m/s (from ft/s) or radians (from degrees).
    pub fn deviations(self) -> [f64; 7] {
        let steps = [0.2, 0.4, 0.6, 1.0, 1.5, 2.0, 2.5];
        steps.map(|step: f64| match self {
            Self::Airspeed => feet(step),
            _ => step.to_radians(),
        })
    }
}

/// `flight` with an error of `instrument` that walks at random, by `seed`: every second a normal step of this deviation, m/s
/// or radians, linear between. The channel's own noise stays.
#[must_use]
pub fn with_walk(
    mut flight: Flight,
    instrument: TestedInstrument,
    deviation: f64,
    seed: u64,
) -> Flight {
    let begin = flight.start.time;
    let name = instrument.channel();
    for channel in flight.channels.iter_mut().filter(|c| c.name == name) {
        let last = channel.times.last().map_or(begin, |time| *time);
        let steps = ((last - begin) / STEP).ceil().max(0.0) as usize + 2;
        let mut random = ChaCha8Rng::seed_from_u64(seed ^ SALT);
        let mut walk = vec![0.0];
        while walk.len() < steps {
            let step: f64 = StandardNormal.sample(&mut random);
            walk.push(walk[walk.len() - 1] + step);
        }
        for (time, value) in channel.times.iter().zip(&mut channel.values) {
            let place = ((time - begin) / STEP).clamp(0.0, (steps - 2) as f64);
            let (whole, part) = (place.floor() as usize, place.fract());
            let error = deviation * (walk[whole] + part * (walk[whole + 1] - walk[whole]));
            *value = match instrument {
                TestedInstrument::Airspeed => (*value + error).max(0.0),
                TestedInstrument::Yaw => wrap_pi(*value + error),
                _ => *value + error,
            };
        }
    }
    flight
}

/// Root mean square of the position's error over run number `run`, metres, with that error of that instrument; `None` where
/// the filter could not go on.
pub fn rms_with_walk(instrument: TestedInstrument, deviation: f64, run: u64) -> Option<f64> {
    let mut scenario = Scenario::named(SCENARIO)?;
    scenario.height = feet(1000.0);
    let spec = SensorSpec {
        mount_vibration: 0.0,
        ..SensorSpec::default()
    };
    let overrides = Overrides {
        sensors: Some(spec),
        ..Overrides::default()
    };
    let flight = with_walk(scenario.fly(run, &overrides), instrument, deviation, run);
    let mission = scenario.mission();
    // Nobody tells the filter of the walk, but it knows that the mount does not shake.
    let settings = scenario.navigator(&spec);
    let (place, turn) = FOUND;
    let expected = ExpectedDetection {
        recognised: 1.0,
        per_frame: PER_FRAME,
        covariance: Matrix4::from_diagonal(
            &Vector4::new(place, place, turn, turn).map(|deviation: f64| deviation * deviation),
        ),
    };
    let planned = mission.landmarks.iter().map(|landmark| PlannedLandmark {
        landmark: landmark.clone(),
        detection: DetectionStatistics::everywhere(expected),
    });
    let planned: Vec<PlannedLandmark> = planned.collect();
    let (detector, mut frames) = as_stated(&flight, &planned, run)?;
    let flight = Arc::new(flight);
    let navigator = Navigator::with_detector(
        Arc::clone(&flight),
        &mission.landmarks,
        Box::new(detector),
        &settings,
    );
    let flown = navigator.ok()?.sparing().fly(&mut frames, &|| 0.0).ok()?;
    Some(summarize(&flight, &flown, None).position_error_m?.rms)
}

/// Errors of all runs with one deviation of one instrument.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SensitivityRow {
    /// Instrument.
    pub instrument: TestedInstrument,
    /// Standard deviation of the walk's steps, m/s or radians.
    pub deviation: f64,
    /// Root mean square of the position's error of each run, metres; `None` where the filter could not go on.
    pub rms: Vec<Option<f64>>,
}

impl SensitivityRow {
    /// Errors of the runs that came to their end, ascending, metres.
    pub fn flown(&self) -> Vec<f64> {
        let mut flown: Vec<f64> = self.rms.iter().flatten().copied().collect();
        flown.sort_by(f64::total_cmp);
        flown
    }

    /// Median of them, metres.
    pub fn median(&self) -> Option<f64> {
        median(&self.flown())
    }

    /// Interval of the median with a confidence of 95 % at least, metres: its ends are two of the runs, by the binomial law of
    /// ranks, whatever the law of the errors. `None` of fewer than six runs, all of which lie on one side of the median too
    /// often.
    pub fn interval(&self) -> Option<[f64; 2]> {
        let flown = self.flown();
        let ranks = quantile_ranks(flown.len() as u64, 0.5)?;
        Some(ranks.map(|rank| flown[rank as usize]))
    }
}

/// Median of ascending values.
fn median(ascending: &[f64]) -> Option<f64> {
    let last = ascending.len().checked_sub(1)?;
    Some(0.5 * (ascending[last / 2] + ascending[last.div_ceil(2)]))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::LN_2;

    use rand_distr::Exp1;

    use super::*;

    fn flight() -> Flight {
        let scenario = Scenario::named(SCENARIO).unwrap();
        scenario.fly(1, &Overrides::default())
    }

    #[test]
    fn a_walk_has_the_variance_of_its_steps_and_is_the_same_for_every_deviation() {
        let plain = flight();
        let error = |deviation: f64, seed: u64| -> Vec<f64> {
            let walked = with_walk(plain.clone(), TestedInstrument::Roll, deviation, seed);
            let values =
                |flight: &Flight| flight.channel(ChannelName::Roll).unwrap().values.clone();
            let (with, without) = (values(&walked), values(&plain));
            with.iter().zip(&without).map(|(a, b)| a - b).collect()
        };
        let (small, large) = (error(0.01, 4), error(0.03, 4));
        for (small, large) in small.iter().zip(&large) {
            assert!((3.0 * small - large).abs() < 1e-9);
        }
        // After n steps the variance is n times that of a step: over 200 walks, to some 10 %.
        let steps = 40;
        let at = |errors: &[f64]| {
            let times = &plain.channel(ChannelName::Roll).unwrap().times;
            let index = times.partition_point(|t| *t < plain.start.time + f64::from(steps));
            errors[index]
        };
        let variance = (0..200)
            .map(|seed| at(&error(0.01, seed)).powi(2))
            .sum::<f64>()
            / 200.0;
        let ratio = variance / (f64::from(steps) * 1e-4);
        assert!((0.75..1.3).contains(&ratio), "{ratio}");
        // The other channels are as they were.
        let walked = with_walk(plain.clone(), TestedInstrument::Roll, 0.01, 4);
        let heading =
            |flight: &Flight| flight.channel(ChannelName::Heading).unwrap().values.clone();
        assert_eq!(heading(&walked), heading(&plain));
    }

    #[test]
    fn a_tilted_attitude_costs_more_than_a_good_one_and_counts_come_with_an_interval() {
        let row = |deviation: f64| SensitivityRow {
            instrument: TestedInstrument::Roll,
            deviation,
            rms: (1..=6)
                .map(|run| rms_with_walk(TestedInstrument::Roll, deviation, run))
                .collect(),
        };
        let [good, bad] = [row(0.2_f64.to_radians()), row(1.5_f64.to_radians())];
        let (small, large) = (good.median().unwrap(), bad.median().unwrap());
        assert!(large > 2.0 * small, "{small} {large}");
        let [low, high] = good.interval().unwrap();
        assert!(low <= small && small <= high, "{low} {small} {high}");
    }

    fn row(rms: Vec<Option<f64>>) -> SensitivityRow {
        SensitivityRow {
            instrument: TestedInstrument::Yaw,
            deviation: 0.1,
            rms,
        }
    }

    #[test]
    fn the_interval_of_a_median_is_that_of_its_order_statistics() {
        let ten = row((1..=10).map(|n| Some(f64::from(n))).chain([None]).collect());
        assert_eq!(ten.median(), Some(5.5));
        // By binomials the median of ten lies between the second and the ninth with 97.9 %.
        assert_eq!(ten.interval(), Some([2.0, 9.0]));
        // That of five lies beyond all of them once in 16.
        let five = row((1..=5).map(|n| Some(f64::from(n))).collect());
        assert_eq!(five.interval(), None);
        assert_eq!(row(vec![None; 10]).interval(), None);
    }

    #[test]
    fn the_interval_of_a_median_holds_it_as_often_as_it_says() {
        // Errors of a skewed law whose median is ln 2. By percentiles of the bootstrap 93.8, 93.5 and 94.8 % held it.
        for runs in [10, 20, 50] {
            let mut random = ChaCha8Rng::seed_from_u64(runs);
            let held = (0..2000).filter(|_| {
                let error = |_| Some(Exp1.sample(&mut random));
                let interval = row((0..runs).map(error).collect()).interval();
                interval.is_some_and(|[low, high]: [f64; 2]| low <= LN_2 && LN_2 <= high)
            });
            // The deviation of the count is 10.
            let held = held.count();
            assert!((1880..1980).contains(&held), "{runs}: {held}");
        }
    }
}
