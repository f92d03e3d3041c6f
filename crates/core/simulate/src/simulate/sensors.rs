//! Readings of the aircraft's sensors, made from the truth.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

use pilotage_base::frames::{Attitude, GroundPoint, wrap_pi};
use pilotage_flight::{Channel, ChannelName, TruthState};

/// White noise per sample and a bias that stays for the flight, standard deviations in the
/// quantity's unit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SensorError {
    /// Standard deviation of the white noise of each sample.
    pub noise: f64,
    /// Standard deviation of the bias.
    pub bias: f64,
}

/// Sensor errors and rates of a small unmanned aircraft.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SensorSpec {
    /// Pitot tube, m/s: a differential pressure sensor of a few pascals.
    pub airspeed: SensorError,
    /// Heading of an attitude filter aided by a calibrated magnetometer, radians.
    pub heading: SensorError,
    /// Roll and pitch of that filter, each, radians.
    pub attitude: SensorError,
    /// Height above ground, barometer set at take-off, metres.
    pub height: SensorError,
    /// Samples of these per second.
    pub rate: f64,
    /// Frames of the camera per second.
    pub frame_rate: f64,
    /// Vibration of the camera mount per axis and frame, radians (DeAngelo 2016, 5.1).
    pub mount_vibration: f64,
    /// Error of the first position per axis, metres.
    pub start_position: f64,
}

impl Default for SensorSpec {
    fn default() -> Self {
        Self {
            airspeed: SensorError {
                noise: 0.3,
                bias: 0.2,
            },
            heading: SensorError {
                noise: 0.5_f64.to_radians(),
                bias: 0.4_f64.to_radians(),
            },
            attitude: SensorError {
                noise: 0.3_f64.to_radians(),
                bias: 0.15_f64.to_radians(),
            },
            height: SensorError {
                noise: 0.4,
                bias: 0.4,
            },
            rate: 20.0,
            frame_rate: 2.0,
            mount_vibration: 1.0_f64.to_radians(),
            start_position: 3.0,
        }
    }
}

/// Independent streams of random numbers under one seed; the numbers are part of what a seed means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SensorStream {
    Gust,
    Start,
    Airspeed,
    Heading,
    Roll,
    Pitch,
    Height,
    Wind,
    VelocityNorth,
    VelocityEast,
    /// Vibration of the mount in frame number so-and-so.
    Vibration(usize),
}

impl SensorStream {
    fn number(self) -> u64 {
        match self {
            Self::Gust => 1,
            Self::Start => 2,
            Self::Airspeed => 3,
            Self::Heading => 4,
            Self::Roll => 5,
            Self::Pitch => 6,
            Self::Height => 7,
            Self::Wind => 8,
            Self::VelocityNorth => 9,
            Self::VelocityEast => 10,
            Self::Vibration(frame) => (1 << 32) | frame as u64,
        }
    }

    /// The stream's generator. What one stream draws does not depend on any other.
    pub(super) fn random(self, seed: u64) -> ChaCha8Rng {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(self.number());
        random
    }
}

/// Measures one quantity of the truth: times and true values.
pub(super) fn channel(
    name: ChannelName,
    error: SensorError,
    stream: SensorStream,
    seed: u64,
    truth: &[(f64, f64)],
) -> Channel {
    let mut random = stream.random(seed);
    let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
    let bias = error.bias * normal();
    let (times, values) = truth
        .iter()
        .map(|(time, value)| {
            let measured = value + bias + error.noise * normal();
            let measured = if name.is_angle() {
                wrap_pi(measured)
            } else {
                measured
            };
            (*time, measured)
        })
        .unzip();
    Channel {
        name,
        times,
        values,
    }
}

/// The measured series of a flight: airspeed, heading, roll, pitch, height above ground.
///
/// `airspeeds` holds one true airspeed per state; states are taken at `rate` from the recording.
pub(super) fn measure(
    spec: &SensorSpec,
    seed: u64,
    states: &[TruthState],
    airspeeds: &[f64],
    ground_down: f64,
) -> Vec<Channel> {
    let attitude = |s: &TruthState| s.attitude.unwrap_or_default();
    let of = |value: &dyn Fn(&TruthState) -> f64| -> Vec<(f64, f64)> {
        states.iter().map(|s| (s.time, value(s))).collect()
    };
    let airspeed: Vec<(f64, f64)> = states
        .iter()
        .map(|s| s.time)
        .zip(airspeeds.iter().copied())
        .collect();
    let heading = of(&|s| attitude(s).yaw);
    let roll = of(&|s| attitude(s).roll);
    let pitch = of(&|s| attitude(s).pitch);
    let height = of(&|s| ground_down - s.position.z);
    [
        (
            ChannelName::Airspeed,
            spec.airspeed,
            SensorStream::Airspeed,
            airspeed,
        ),
        (
            ChannelName::Heading,
            spec.heading,
            SensorStream::Heading,
            heading,
        ),
        (ChannelName::Roll, spec.attitude, SensorStream::Roll, roll),
        (
            ChannelName::Pitch,
            spec.attitude,
            SensorStream::Pitch,
            pitch,
        ),
        (
            ChannelName::HeightAboveGround,
            spec.height,
            SensorStream::Height,
            height,
        ),
    ]
    .into_iter()
    .map(|(name, error, stream, truth)| channel(name, error, stream, seed, &truth))
    .collect()
}

/// The attitude from which frame number `frame` is really taken: the body's with the mount's
/// vibration.
pub(super) fn camera_attitude(
    spec: &SensorSpec,
    seed: u64,
    frame: usize,
    body: &Attitude,
) -> Attitude {
    let mut random = SensorStream::Vibration(frame).random(seed);
    let mut shake = || -> f64 {
        let normal: f64 = StandardNormal.sample(&mut random);
        spec.mount_vibration * normal
    };
    Attitude {
        roll: body.roll + shake(),
        pitch: body.pitch + shake(),
        yaw: wrap_pi(body.yaw + shake()),
    }
}

/// The first position as the filter is told it.
pub(super) fn start_fix(spec: &SensorSpec, seed: u64, truth: GroundPoint) -> GroundPoint {
    let mut random = SensorStream::Start.random(seed);
    let mut error = || -> f64 {
        let normal: f64 = StandardNormal.sample(&mut random);
        spec.start_position * normal
    };
    GroundPoint::new(truth.north + error(), truth.east + error())
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;

    use super::*;

    fn states() -> Vec<TruthState> {
        (0..20_000)
            .map(|i| TruthState {
                time: f64::from(i) / 20.0,
                position: Point3::new(0.0, 0.0, -100.0),
                attitude: Some(Attitude::level(179.9_f64.to_radians())),
                wind: None,
            })
            .collect()
    }

    #[test]
    fn measured_noise_and_bias_have_the_stated_size() {
        let (spec, states) = (SensorSpec::default(), states());
        let airspeeds = vec![18.0; states.len()];
        let mut squared_bias = 0.0;
        for seed in 0..40 {
            let channels = measure(&spec, seed, &states[..2000], &airspeeds[..2000], 0.0);
            let values = &channels[0].values;
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            let variance =
                values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64;
            assert!((variance.sqrt() / 0.3 - 1.0).abs() < 0.1);
            squared_bias += (mean - 18.0).powi(2) / 40.0;
        }
        assert!((squared_bias.sqrt() / 0.2 - 1.0).abs() < 0.3);
    }

    #[test]
    fn a_measured_heading_near_south_stays_within_half_a_turn() {
        let states = states();
        let channels = measure(
            &SensorSpec::default(),
            3,
            &states,
            &vec![18.0; states.len()],
            0.0,
        );
        let heading = &channels[1].values;
        assert!(heading.iter().all(|h| h.abs() <= std::f64::consts::PI));
        assert!(heading.iter().any(|h| *h < 0.0) && heading.iter().any(|h| *h > 0.0));
    }

    #[test]
    fn the_shake_of_a_frame_does_not_depend_on_the_frames_before_it() {
        let (spec, body) = (SensorSpec::default(), Attitude::level(1.0));
        let alone = camera_attitude(&spec, 5, 17, &body);
        let _ = camera_attitude(&spec, 5, 16, &body);
        assert_eq!(alone, camera_attitude(&spec, 5, 17, &body));
        assert_ne!(alone, camera_attitude(&spec, 5, 16, &body));
    }
}
