//! A small flight by landmarks with a fault, watched as its crew can watch it: by innovations and NIS.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{Cholesky, Matrix2, Vector2, Vector4};
use pilotage_base::frames::{Attitude, GroundPoint};
use pilotage_estimation::filter::{
    Consistency, ConsistencySummary, Gate, Gaussian, Ukf, UnscentedSettings,
};
use pilotage_estimation::vehicle::{AirData, AirplaneWind, ControlInput, VehicleModel};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Seconds of the flight, and of a step.
const SECONDS: f64 = 300.0;
const STEP: f64 = 0.5;
/// Airspeed of the flight, m/s.
pub const AIRSPEED: f64 = 20.0;
/// Standard deviation of a look, metres on each axis.
pub const LOOK: f64 = 5.0;
/// Standard deviation of the place at the start, metres.
const START: f64 = 5.0;
/// Seed of the flight.
pub const SEED: u64 = 11;
/// Share of good looks that pass the gate: the navigator's.
const CONFIDENCE: f64 = 0.997;

/// Course of the flight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Three quarter turns to the right, from 70 s, 140 s and 210 s on, 18 s each.
    Turns,
    /// Northward all the time.
    Straight,
}

/// Faults of the flight, and what its crew assumes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WatchedFlight {
    /// Course.
    pub way: Way,
    /// True wind, velocity of the air north and east, m/s.
    pub wind: Vector2<f64>,
    /// Compass reading less the true heading, radians.
    pub compass: f64,
    /// Assumed reading less the true heading, radians.
    pub compass_assumed: f64,
    /// Age of the camera's pictures, seconds.
    pub lag: f64,
    /// Assumed age, seconds.
    pub lag_assumed: f64,
    /// True airspeed from this moment (s) on, m/s, while the reading stays at `AIRSPEED`.
    pub faster: Option<(f64, f64)>,
    /// Moment from which the airspeed's reading is not believed, s.
    pub distrusted: f64,
    /// Standard deviation of the wind that is assumed to be zero at the start, m/s on each axis.
    pub wind_deviation: f64,
    /// Seconds between looks.
    pub between: f64,
    /// Probability that a landmark is found at a look.
    pub found: f64,
    /// Probability that a find is a wrong place, and its distance from the right one, metres.
    pub wrong: (f64, f64),
    /// Looks between these moments do not happen.
    pub blind: [f64; 2],
    /// Look at a moment, s, at a twin that stands beside the landmark, metres north and east.
    pub twin: Option<(f64, Vector2<f64>)>,
    /// Moment of a look that is left out, s.
    pub left_out: Option<f64>,
    /// Whether looks beyond the gate are refused.
    pub gated: bool,
}

impl Default for WatchedFlight {
    /// Nothing is wrong, and the wind is known to be calm but for 4 m/s.
    fn default() -> Self {
        Self {
            way: Way::Turns,
            wind: Vector2::new(2.0, -3.0),
            compass: 0.0,
            compass_assumed: 0.0,
            lag: 0.0,
            lag_assumed: 0.0,
            faster: None,
            distrusted: f64::INFINITY,
            wind_deviation: 4.0,
            between: 5.0,
            found: 1.0,
            wrong: (0.0, 0.0),
            blind: [f64::INFINITY; 2],
            twin: None,
            left_out: None,
            gated: false,
        }
    }
}

/// Look at a landmark as the crew sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Moment, s.
    pub time: f64,
    /// Innovation ahead and to the right by the compass, metres.
    pub innovation: Vector2<f64>,
    /// Its standard deviation on the wider axis, metres.
    pub deviation: f64,
    /// Normalised innovation squared, of two numbers.
    pub nis: f64,
    /// Whether it was taken in.
    pub accepted: bool,
}

/// Belief at a moment beside the truth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlownMoment {
    /// Moment, s.
    pub time: f64,
    /// Distance of the estimate from the truth, metres.
    pub error: f64,
    /// Stated standard deviation of the place on its wider axis, metres.
    pub deviation: f64,
    /// Estimated wind, m/s north and east.
    pub wind: Vector2<f64>,
}

/// Flight as it went.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WatchedRun {
    /// Looks in their order.
    pub looks: Vec<Look>,
    /// Moments, a second apart.
    pub moments: Vec<FlownMoment>,
}

impl WatchedRun {
    /// NIS of all looks with the bounds of its mean.
    pub fn consistency(&self) -> Option<ConsistencySummary> {
        let mut nis = Consistency::default();
        for look in &self.looks {
            nis.push(look.nis, 2);
        }
        nis.summary()
    }

    /// Largest error from a moment on, metres.
    pub fn largest_error(&self, from: f64) -> f64 {
        let later = self.moments.iter().filter(|moment| moment.time >= from);
        later.map(|moment| moment.error).fold(0.0, f64::max)
    }

    /// Largest stated standard deviation from a moment on, metres.
    pub fn largest_deviation(&self, from: f64) -> f64 {
        let later = self.moments.iter().filter(|moment| moment.time >= from);
        later.map(|moment| moment.deviation).fold(0.0, f64::max)
    }

    /// Belief at a moment, or at the last one before it.
    pub fn at(&self, time: f64) -> Option<&FlownMoment> {
        self.moments
            .iter()
            .rev()
            .find(|moment| moment.time <= time + 1e-9)
    }

    /// Looks that were refused.
    pub fn refused(&self) -> usize {
        self.looks.iter().filter(|look| !look.accepted).count()
    }
}

/// NIS of two numbers up to which the gate lets a look pass.
pub fn gate_of_looks() -> f64 {
    Gate {
        confidence: CONFIDENCE,
    }
    .threshold(2)
}

fn heading(way: Way, time: f64) -> f64 {
    let turned = |from: f64| ((time - from) / 18.0).clamp(0.0, 1.0) * FRAC_PI_2;
    match way {
        Way::Straight => 0.0,
        Way::Turns => [70.0, 140.0, 210.0].map(turned).iter().sum::<f64>() % TAU,
    }
}

fn wider(covariance: &Matrix2<f64>) -> f64 {
    covariance.symmetric_eigenvalues().max().max(0.0).sqrt()
}

impl WatchedFlight {
    /// Flies it; nothing where the filter refuses.
    pub fn fly(&self) -> WatchedRun {
        self.flown().unwrap_or_default()
    }

    fn flown(&self) -> Option<WatchedRun> {
        let mut random = ChaCha8Rng::seed_from_u64(SEED);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let mut chance = ChaCha8Rng::seed_from_u64(SEED + 1);
        let model = AirplaneWind {
            air_data: AirData::default().cruising(AIRSPEED, 3.0),
            start_wind_deviation: self.wind_deviation,
            ..AirplaneWind::default()
        };
        let mut filter = Ukf::new(
            model.prior(GroundPoint::default(), START),
            UnscentedSettings::default(),
        )
        .ok()?;
        let mut truth = Vector4::new(START * normal(), START * normal(), self.wind.x, self.wind.y);
        let (mut places, mut inputs) = (vec![truth], Vec::new());
        let mut flown = WatchedRun::default();
        let steps = (SECONDS / STEP) as usize;
        let each_look = (self.between / STEP).round().max(1.0) as usize;
        for step in 1..=steps {
            let time = step as f64 * STEP;
            let true_heading = heading(self.way, time - 0.5 * STEP);
            let fast = self.faster.filter(|(from, _)| time > *from);
            let flies = ControlInput::new(
                fast.map_or(AIRSPEED, |(_, airspeed)| airspeed),
                Attitude::level(true_heading),
            );
            let noise = Cholesky::new(model.process_noise(&truth, &flies, STEP))?.l();
            let draw = Vector4::from_fn(|_, _| normal());
            truth = model.propagate(&truth, &flies, STEP) + noise * draw;
            places.push(truth);
            let read = Attitude::level(true_heading + self.compass - self.compass_assumed);
            let reads = if time > self.distrusted {
                ControlInput::without_airspeed(read)
            } else {
                ControlInput::new(AIRSPEED, read)
            };
            let noise = model.process_noise(filter.mean(), &reads, STEP);
            filter
                .predict(|x| model.propagate(x, &reads, STEP), &noise)
                .ok()?;
            inputs.push(reads);
            if step % each_look == 0 {
                let scatter = LOOK * Vector2::new(normal(), normal());
                let draws = [0, 1, 2].map(|_| chance.random::<f64>());
                if let Some(look) =
                    self.look(time, &places, &inputs, &model, &mut filter, scatter, draws)
                {
                    flown.looks.push(look);
                }
            }
            if step % 2 == 0 {
                let belief: Gaussian<2> = filter.state().marginal::<0, 2>();
                flown.moments.push(FlownMoment {
                    time,
                    error: (belief.mean - truth.fixed_rows::<2>(0)).norm(),
                    deviation: wider(&belief.covariance),
                    wind: filter.mean().fixed_rows::<2>(2).into(),
                });
            }
        }
        Some(flown)
    }

    #[expect(clippy::too_many_arguments)]
    fn look(
        &self,
        time: f64,
        places: &[Vector4<f64>],
        inputs: &[ControlInput],
        model: &AirplaneWind,
        filter: &mut Ukf<4>,
        scatter: Vector2<f64>,
        [found, wrong, direction]: [f64; 3],
    ) -> Option<Look> {
        let is = |moment: f64| (moment - time).abs() < 0.5 * STEP;
        let is_blind = time > self.blind[0] && time < self.blind[1];
        if found >= self.found || is_blind || self.left_out.is_some_and(is) {
            return None;
        }
        let back = ((self.lag / STEP).round() as usize).min(places.len() - 1);
        let seen: Vector2<f64> = places[places.len() - 1 - back].fixed_rows::<2>(0).into();
        let twin = self.twin.filter(|(moment, _)| is(*moment));
        let mut beside = twin.map_or_else(Vector2::zeros, |(_, away)| away);
        if wrong < self.wrong.0 {
            let (sin, cos) = (TAU * direction).sin_cos();
            beside += self.wrong.1 * Vector2::new(cos, sin);
        }
        let measured = seen + scatter + beside;
        // The place that a picture of the assumed age shows, by the way flown since.
        let shown = |x: &Vector4<f64>| {
            let (mut state, mut left) = (*x, self.lag_assumed);
            for input in inputs.iter().rev() {
                if left <= 0.0 {
                    break;
                }
                state = model.propagate(&state, input, -left.min(STEP));
                left -= STEP;
            }
            Some(Vector2::new(state[0], state[1]))
        };
        let noise = Matrix2::from_diagonal_element(LOOK * LOOK);
        let expected = filter.predict_measurement(shown, &noise).ok()?;
        let innovation = expected.innovation(&measured);
        let nis = expected.nis(&innovation);
        let accepted = !self.gated || nis <= gate_of_looks();
        let deviation = wider(&expected.innovation_covariance);
        if accepted {
            filter.correct(&expected, &measured).ok()?;
        }
        let (sin, cos) = inputs.last()?.heading().sin_cos();
        let ahead = Vector2::new(cos, sin);
        let right = Vector2::new(-sin, cos);
        Some(Look {
            time,
            innovation: Vector2::new(ahead.dot(&innovation), right.dot(&innovation)),
            deviation,
            nis,
            accepted,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flight_without_a_fault_is_honest() {
        for way in [Way::Turns, Way::Straight] {
            let flown = WatchedFlight {
                way,
                ..WatchedFlight::default()
            }
            .fly();
            assert_eq!(flown.looks.len(), 60);
            let nis = flown.consistency().unwrap();
            assert!(nis.is_consistent(), "{nis:?}");
            assert!(flown.largest_error(60.0) < 20.0);
        }
    }

    #[test]
    fn a_straight_flight_with_a_late_camera_is_behind_by_lag_times_speed() {
        let flown = WatchedFlight {
            way: Way::Straight,
            lag: 2.0,
            wind: Vector2::zeros(),
            ..WatchedFlight::default()
        }
        .fly();
        let last = flown.moments.iter().filter(|moment| moment.time > 150.0);
        let errors: Vec<f64> = last.map(|moment| moment.error).collect();
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        assert!((mean - 40.0).abs() < 5.0, "{mean}");
    }

    #[test]
    fn a_straight_flight_takes_a_turned_compass_for_a_wind() {
        let flown = WatchedFlight {
            way: Way::Straight,
            compass: 0.1,
            wind: Vector2::zeros(),
            ..WatchedFlight::default()
        }
        .fly();
        let wind = flown.at(300.0).unwrap().wind;
        // It believes that it flies 0.1 rad to the right, and is carried to the left by 20 m/s × sin 0.1.
        assert!((wind.y + 2.0).abs() < 0.7, "{wind:?}");
    }
}
