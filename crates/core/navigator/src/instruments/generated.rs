//! Generated flights whose tracks have something that is not airspeed.

use nalgebra::Vector2;
use pilotage_base::frames::{GroundPoint, wrap_pi};
use pilotage_flight::{Channel, ChannelName, Flight, StartFix};
use pilotage_raster::camera::CameraModel;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Step of the simulation, seconds; attitude at each, airspeed at every second, satellite navigation at every fourth.
const STEP: f64 = 0.05;
/// Time in which the airplane follows a wind along its nose, seconds.
const FOLLOWS: f64 = 3.0;
/// Time in which it rolls, seconds.
const ROLLS: f64 = 0.7;
const GRAVITY: f64 = 9.81;
/// Length of the sideslip, m.
pub const SLIP_LENGTH: f64 = 22.0;
/// Delay of satellite navigation and of airspeed, seconds.
const LATE: f64 = 0.2;

/// Something that remembers itself: standard deviation and correlation time, seconds.
#[derive(Clone, Copy, Debug)]
pub struct Wander(pub f64, pub f64);

/// Flight to generate: what is flown, in what, and how it is measured.
#[derive(Clone, Copy, Debug)]
pub struct GeneratedPlan {
    /// Duration, seconds.
    pub duration: f64,
    /// Duration of a straight leg, seconds; none for circles.
    pub leg: f64,
    /// Turn between two legs, radians.
    pub turn: f64,
    /// True airspeed, m/s, and how it strays.
    pub airspeed: (f64, Wander),
    /// True over measured airspeed.
    pub scale: f64,
    /// Noise of the airspeed that the airplane does not follow, m/s.
    pub airspeed_noise: Wander,
    /// Steady wind, north and east, m/s.
    pub wind: [f64; 2],
    /// Its random walk, m/s/√s.
    pub walk: f64,
    /// Gusts.
    pub gusts: Wander,
    /// Sideslip, radians.
    pub slip: Wander,
    /// Error of the heading, radians.
    pub heading: Wander,
    /// Noise of velocities by satellite navigation, m/s.
    pub velocity: Wander,
    /// Error of positions by satellite navigation, m.
    pub position: Wander,
}

impl Default for GeneratedPlan {
    /// Long straight legs and a few turns, as a small airplane surveys: the flight on which least squares fails.
    fn default() -> Self {
        Self {
            duration: 360.0,
            leg: 50.0,
            turn: 1.7,
            airspeed: (17.0, Wander(1.0, 8.0)),
            scale: 1.2,
            airspeed_noise: Wander(1.0, 0.7),
            wind: [-3.0, 4.0],
            walk: 0.06,
            gusts: Wander(1.2, 8.0),
            slip: Wander(0.04, 4.0),
            heading: Wander(0.03, 40.0),
            velocity: Wander(0.3, 1.0),
            position: Wander(1.0, 30.0),
        }
    }
}

/// A flight with what was true.
pub struct Generated {
    pub flight: Flight,
    /// Steady wind at the end, m/s.
    pub wind: Vector2<f64>,
}

struct Random(ChaCha8Rng);

impl Random {
    fn normal(&mut self) -> f64 {
        StandardNormal.sample(&mut self.0)
    }

    fn vector(&mut self) -> Vector2<f64> {
        Vector2::new(self.normal(), self.normal())
    }
}

/// A wandering value.
struct Wanderer {
    wander: Wander,
    value: f64,
}

impl Wanderer {
    fn new(wander: Wander, random: &mut Random) -> Self {
        let value = wander.0 * random.normal();
        Self { wander, value }
    }

    fn after(&mut self, dt: f64, random: &mut Random) -> f64 {
        let kept = (-dt / self.wander.1).exp();
        let fresh = self.wander.0 * (1.0 - kept * kept).sqrt();
        self.value = kept * self.value + fresh * random.normal();
        self.value
    }
}

/// Values of a channel over time.
#[derive(Default)]
struct Recorded(Vec<(ChannelName, Vec<f64>, Vec<f64>)>);

impl Recorded {
    fn add(&mut self, name: ChannelName, time: f64, value: f64) {
        let index = self.0.iter().position(|channel| channel.0 == name);
        let index = index.unwrap_or_else(|| {
            self.0.push((name, Vec::new(), Vec::new()));
            self.0.len() - 1
        });
        self.0[index].1.push(time);
        self.0[index].2.push(value);
    }
}

impl GeneratedPlan {
    /// Roll that the pilot wants at a time, radians.
    fn roll(&self, time: f64) -> f64 {
        const TURNING: f64 = 0.25;
        let turn = self.turn / TURNING;
        if self.leg <= 0.0 || time % (self.leg + turn) > self.leg {
            (TURNING * self.airspeed.0 / GRAVITY).atan()
        } else {
            0.0
        }
    }

    /// The flight of a seed.
    #[expect(
        clippy::too_many_lines,
        reason = "one step of everything after the other"
    )]
    pub fn fly(&self, seed: u64) -> Generated {
        let mut random = Random(ChaCha8Rng::seed_from_u64(seed));
        let random = &mut random;
        let mut wander = |wander| Wanderer::new(wander, random);
        let mut speed = wander(self.airspeed.1);
        let mut read = wander(self.airspeed_noise);
        let mut gusts = [wander(self.gusts), wander(self.gusts)];
        let mut slip = wander(self.slip);
        let mut compass = wander(self.heading);
        let mut velocity = [wander(self.velocity), wander(self.velocity)];
        let mut position = [wander(self.position), wander(self.position)];
        let mut wind = Vector2::from(self.wind);
        let mut heading = 6.0 * random.normal();
        let mut roll = 0.0_f64;
        let gyro_bias = 0.002 * random.normal();
        let (mut place, mut followed) = (Vector2::zeros(), Vector2::zeros());
        let mut recorded = Recorded::default();
        for step in 0..(self.duration / STEP) as usize {
            let time = step as f64 * STEP;
            let roll_rate = (self.roll(time) - roll) / ROLLS;
            roll += roll_rate * STEP;
            let rate = GRAVITY * roll.tan() / self.airspeed.0;
            heading += rate * STEP;
            let (pitch, pitching) = (0.02 * (0.3 * time).sin(), 0.006 * (0.3 * time).cos());
            wind += random.vector() * (self.walk * STEP.sqrt());
            let gust = Vector2::new(gusts[0].after(STEP, random), gusts[1].after(STEP, random));
            followed += (gust - followed) * (STEP / FOLLOWS);
            let true_speed = self.airspeed.0 + speed.after(STEP, random);
            let slip = slip.after(STEP, random);
            let ahead = Vector2::new(heading.cos(), heading.sin());
            let right = Vector2::new(-ahead.y, ahead.x);
            // The air moves by the gust, the airplane follows it: what it has not followed yet it reads.
            let through = ahead * true_speed + right * (slip * true_speed);
            let over_ground = through + followed + wind;
            place += over_ground * STEP;
            let met = true_speed - ahead.dot(&(gust - followed));
            let noise = read.after(STEP, random);
            let error = compass.after(STEP, random);
            let by = |name, value| (name, value);
            for (name, value) in [
                by(ChannelName::Heading, wrap_pi(heading + error)),
                by(ChannelName::Roll, roll),
                by(ChannelName::Pitch, pitch),
                by(ChannelName::RollRate, roll_rate - rate * pitch.sin()),
                by(
                    ChannelName::PitchRate,
                    pitching * roll.cos() + rate * roll.sin() * pitch.cos(),
                ),
                by(
                    ChannelName::YawRate,
                    rate * roll.cos() * pitch.cos() - pitching * roll.sin() + gyro_bias,
                ),
            ] {
                recorded.add(name, time, value);
            }
            let force = -slip * true_speed * true_speed / (SLIP_LENGTH * roll.cos());
            recorded.add(
                ChannelName::AccelerationRight,
                time,
                force + 0.2 + 0.3 * random.normal(),
            );
            if step % 2 == 0 {
                let airspeed = (met + noise) / self.scale;
                recorded.add(ChannelName::Airspeed, time + LATE, airspeed);
            }
            let (off, drift) = (
                Vector2::new(
                    velocity[0].after(STEP, random),
                    velocity[1].after(STEP, random),
                ),
                Vector2::new(
                    position[0].after(STEP, random),
                    position[1].after(STEP, random),
                ),
            );
            if step % 4 == 0 {
                let (told, there) = (over_ground + off, place + drift);
                for (name, value) in [
                    by(ChannelName::GpsNorth, there.x),
                    by(ChannelName::GpsEast, there.y),
                    by(ChannelName::GpsVelocityNorth, told.x),
                    by(ChannelName::GpsVelocityEast, told.y),
                ] {
                    recorded.add(name, time + LATE, value);
                }
            }
        }
        let channels = recorded.0.into_iter();
        let channels = channels.map(|(name, times, values)| Channel {
            name,
            times,
            values,
        });
        Generated {
            flight: Flight {
                name: format!("generated {seed}"),
                frame_on_globe: None,
                camera: CameraModel::pinhole(640, 480, 1.0),
                ground_down: 0.0,
                channels: channels.collect(),
                frames: Vec::new(),
                start: StartFix {
                    time: 0.0,
                    position: GroundPoint::default(),
                    standard_deviation: 3.0,
                },
                truth: None,
            },
            wind,
        }
    }
}
