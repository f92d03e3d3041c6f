//! A flight in a hall, after the indoor flight of DeAngelo 2016, chapter 6.

mod floor;
mod quadcopter;
mod world;

use std::collections::BTreeMap;
use std::sync::Arc;

use nalgebra::{Point3, Vector2, Vector3};

pub(super) use self::world::Hall;

use self::floor::{FLOOR_SIDE, Floor};
use self::quadcopter::{Quadcopter, QuadcopterState, Reference};
use super::dryden::{DrydenGust, Turbulence};
use super::flight::{Recording, STEPS_PER_RECORD, STEPS_PER_SECOND};
use super::flight_day::FlightDay;
use super::flight_frames::{SimulatedFlight, SimulatedFrames};
use super::scenario::world_origin;
use super::sensors::{self, SensorError, SensorSpec, SensorStream};
use pilotage_base::frames::LocalFrame;
use pilotage_base::frames::units::{GRAVITY, feet};
use pilotage_flight::{Channel, ChannelName, TruthState};
use pilotage_mission::mission::{MapReference, Mission};
use pilotage_mission::settings::{
    NavigatorSettings, ProcessNoise, SensorNoise, StartError, VehicleChoice,
};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::{CachedImagery, GeoreferencedPicture, Imagery};
use pilotage_vision::landmark::Landmark;

/// Memory for tiles of the floor: all of it, with its coarser levels.
const CACHE_MEGABYTES: usize = 32;
/// Distance of the route from the walls, metres.
const FROM_WALLS: f64 = 1.3;
/// Seconds for which the quadcopter hovers before and after its rounds.
const HOVER: f64 = 3.0;
/// Time constant and standard deviation of the draught's gusts, seconds and m/s per axis; a third
/// of that vertically.
const GUST: (f64, f64) = (2.0, 0.1);

/// A quadcopter in a hall of 625 square feet, over posters and taped roads.
///
/// DeAngelo 2016, chapter 6: some 10 ft above the floor, counter-clockwise from the lower left corner
/// and back, the autopilot's channels at 20 Hz. The thesis does not say how fast it flew, how often
/// the camera took pictures and what the sensors were good for; here they are those of a small
/// vehicle's autopilot, and motion capture measures the velocity for the model that wants it.
#[derive(Clone, Debug, PartialEq)]
pub struct IndoorHall {
    /// Draught: mean velocity of the air (north, east), m/s.
    pub draught: Vector2<f64>,
    /// Speed along the route, m/s.
    pub speed: f64,
    /// Times that the route is flown round.
    pub rounds: u32,
    /// Height above the floor, metres.
    pub height: f64,
    /// Sensors of the vehicle.
    pub sensors: SensorSpec,
    /// Velocity over ground by motion capture, each component, m/s.
    pub velocity: SensorError,
    /// Error with which the posters were laid, per axis, metres.
    pub laying: f64,
}

impl Default for IndoorHall {
    fn default() -> Self {
        Self {
            draught: Vector2::new(-0.3, 0.4),
            speed: 0.6,
            rounds: 2,
            height: feet(10.0),
            sensors: SensorSpec {
                height: SensorError {
                    noise: 0.02,
                    bias: 0.02,
                },
                mount_vibration: 0.5_f64.to_radians(),
                start_position: 0.3,
                ..SensorSpec::default()
            },
            velocity: SensorError {
                noise: 0.05,
                bias: 0.03,
            },
            laying: 0.005,
        }
    }
}

impl IndoorHall {
    /// Name on the command line and in files.
    pub const NAME: &'static str = "indoor-hall";
    /// Title for people.
    pub const TITLE: &'static str = "Quadcopter in a hall";
    /// Description of what happens in the flight.
    pub const DESCRIPTION: &'static str = "Twice round a hall of 7.6 m a side, counter-clockwise from its south-west \
         corner, over posters and taped roads, in a draught that the filter has to find.";

    /// The camera: 640×480, 60° across, fixed to the airframe, looking down.
    pub fn camera() -> CameraModel {
        CameraModel::pinhole(640, 480, 60.0_f64.to_radians())
    }

    /// The drawing of the floor: the map.
    pub fn map() -> GeoreferencedPicture {
        Floor::drawn().map()
    }

    /// The flight with its pictures, which are made when they are asked for. The same seed gives the
    /// same flight to the bit.
    ///
    /// # Panics
    ///
    /// Only for a hall put together by hand whose flight takes no time: a speed that is not above zero.
    pub fn simulate(&self, seed: u64) -> SimulatedFlight {
        let (states, velocities) = self.fly(seed);
        let mut channels =
            sensors::measure(&self.sensors, seed, &states, &vec![0.0; states.len()], 0.0);
        channels.retain(|channel| channel.name != ChannelName::Airspeed);
        channels.extend(self.motion_capture(seed, &states, &velocities));
        let flight = Recording {
            name: Self::NAME,
            sensors: &self.sensors,
            camera: &Self::camera(),
            frame_on_globe: LocalFrame::new(world_origin()),
            ground_down: 0.0,
            seed,
        }
        .flight(states, channels)
        .expect("a flight of some time has states");
        let floor: Arc<dyn Imagery> =
            Arc::new(Floor::drawn().laid(seed, self.laying).as_seen(seed));
        let day = FlightDay::Same;
        SimulatedFlight {
            frames: SimulatedFrames::new(&flight, day, seed)
                .over(Arc::new(CachedImagery::new(floor, CACHE_MEGABYTES))),
            flight,
            seed,
            day,
        }
    }

    fn motion_capture(
        &self,
        seed: u64,
        states: &[TruthState],
        velocities: &[Vector2<f64>],
    ) -> [Channel; 2] {
        let axes = [
            (ChannelName::VelocityNorth, SensorStream::VelocityNorth),
            (ChannelName::VelocityEast, SensorStream::VelocityEast),
        ];
        let mut axis = 0;
        axes.map(|(name, stream)| {
            let times = states.iter().map(|s| s.time);
            let truth: Vec<_> = times.zip(velocities.iter().map(|v| v[axis])).collect();
            axis += 1;
            sensors::channel(name, self.velocity, stream, seed, &truth)
        })
    }

    /// Posters as landmarks, and how to navigate by them on the process model `vehicle`.
    pub fn mission(&self, vehicle: VehicleChoice) -> Mission {
        let posters = Floor::drawn().posters();
        let landmarks = (1..).zip(posters);
        Mission {
            name: Self::TITLE.to_owned(),
            origin: world_origin(),
            map: Some(MapReference::Picture("map.png".to_owned())),
            landmarks: landmarks
                .map(|(id, bounds)| Landmark::new(id, format!("poster {id}"), bounds))
                .collect(),
            routes: Vec::new(),
            no_fly: Vec::new(),
            rally: Vec::new(),
            roads: Vec::new().into(),
            labels: Vec::new(),
            camera: Some(Self::camera()),
            camera_to_log: None,
            navigator: self.navigator(vehicle),
            properties: BTreeMap::new(),
        }
    }

    /// Settings that know the sensors and the gusts, not the draught.
    ///
    /// For the multirotor: an error of the measured tilt pushes by g per radian, a gust of standard
    /// deviation σ and correlation time τ by the drag k as a white acceleration of the density
    /// k σ √(2τ) would.
    pub fn navigator(&self, vehicle: VehicleChoice) -> NavigatorSettings {
        let defaults = NavigatorSettings::default();
        let spec = &self.sensors;
        let step = 1.0 / spec.rate;
        let camera_angle = |error: SensorError| {
            (spec.mount_vibration.powi(2) + error.noise.powi(2) + error.bias.powi(2)).sqrt()
        };
        let drag = Quadcopter::default().drag;
        let (time, deviation) = GUST;
        let gusts = drag * deviation * (2.0 * time).sqrt();
        let tilt = GRAVITY * spec.attitude.noise * step.sqrt();
        let is_driven = vehicle == VehicleChoice::VelocityDriven;
        NavigatorSettings {
            vehicle,
            start: StartError {
                position: spec.start_position,
                // Of the velocity's bias, or of the wind.
                wind: if is_driven { self.velocity.bias } else { 0.5 },
                offset: [0.0, 0.0],
            },
            process: ProcessNoise {
                position: 0.0,
                wind: if is_driven { 0.0 } else { 0.01 },
                acceleration: gusts.hypot(tilt),
                drag,
                velocity: self.velocity.noise * step.sqrt(),
                ..defaults.process
            },
            sensors: SensorNoise {
                roll: camera_angle(spec.attitude),
                pitch: camera_angle(spec.attitude),
                yaw: camera_angle(spec.heading),
                height: spec.height.noise.hypot(spec.height.bias),
                // Posters are laid by hand.
                pixel: self.laying * Self::camera().focal / self.height,
                ground: 0.0,
                tilt_bias: 0.0,
                yaw_bias: 0.0,
                height_bias: 0.0,
            },
            ..defaults
        }
    }

    /// True states and velocities over ground at 20 Hz.
    fn fly(&self, seed: u64) -> (Vec<TruthState>, Vec<Vector2<f64>>) {
        let dt = 1.0 / STEPS_PER_SECOND as f64;
        let mut random = SensorStream::Gust.random(seed);
        let (time, deviation) = GUST;
        let turbulence = Turbulence {
            intensity: Vector3::new(1.0, 1.0, 1.0 / 3.0) * deviation,
            scale: Vector3::repeat(time),
        };
        // At one metre a second scale lengths are times; the gust's axes are taken as north and east.
        let mut gust = DrydenGust::new(&turbulence, 1.0, dt, &mut random);
        let draught = Vector3::new(self.draught.x, self.draught.y, 0.0);
        let craft = Quadcopter::default();
        let mut state = QuadcopterState::hovering(&self.reference(0.0));
        let (mut states, mut velocities) = (Vec::new(), Vec::new());
        let steps = (self.duration() * STEPS_PER_SECOND as f64) as usize;
        for step in 0..=steps {
            let now = step as f64 * dt;
            if step % STEPS_PER_RECORD == 0 {
                states.push(TruthState {
                    time: now,
                    position: Point3::from(state.position),
                    attitude: Some(state.attitude),
                    wind: Some(self.draught),
                });
                velocities.push(state.velocity);
            }
            let air = draught + gust.step(&mut random);
            state.step(&craft, &self.reference(now), &air, dt);
        }
        (states, velocities)
    }

    /// Length of the route once round, metres.
    fn side() -> f64 {
        FLOOR_SIDE - 2.0 * FROM_WALLS
    }

    /// Seconds from hovering to hovering.
    fn duration(&self) -> f64 {
        2.0 * HOVER + f64::from(self.rounds) * 4.0 * Self::side() / self.speed
    }

    /// Reference to follow at a time: round a square, counter-clockwise from its south-west corner, nose
    /// first.
    fn reference(&self, time: f64) -> Reference {
        let side = Self::side();
        let way = self.speed * (time - HOVER);
        let whole = f64::from(self.rounds) * 4.0 * side;
        let is_moving = (0.0..whole).contains(&way);
        let way = way.clamp(0.0, whole);
        let leg = if way < whole {
            (way / side) as usize
        } else {
            3
        };
        let along = if way < whole { way % side } else { side };
        let corners = [(-0.5, -0.5), (-0.5, 0.5), (0.5, 0.5), (0.5, -0.5)]
            .map(|(north, east)| Vector2::new(north, east) * side);
        let (from, to) = (corners[leg % 4], corners[(leg + 1) % 4]);
        let ahead = (to - from) / side;
        Reference {
            position: from + ahead * along,
            velocity: if is_moving {
                ahead * self.speed
            } else {
                Vector2::zeros()
            },
            height: self.height,
            heading: ahead.y.atan2(ahead.x),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_flies_round_the_floor_for_over_a_minute_at_ten_feet_and_comes_back() {
        let hall = IndoorHall::default();
        let flight = hall.simulate(7).flight;
        let states = &flight.truth.as_ref().unwrap().states;
        let (first, last) = (states.first().unwrap(), states.last().unwrap());
        assert!(last.time > 60.0, "{}", last.time);
        for state in states {
            let place = state.position;
            assert!(place.x.abs().max(place.y.abs()) < 0.5 * FLOOR_SIDE - 0.6);
            assert!((-place.z - feet(10.0)).abs() < 0.3, "{}", place.z);
        }
        assert!((last.position - first.position).norm() < 0.6);
        // Counter-clockwise: east of the first corner after a quarter of a round.
        let quarter = HOVER + IndoorHall::side() / hall.speed;
        let there = flight.truth.as_ref().unwrap().position(quarter).unwrap();
        assert!(there.y > 1.5 && there.x < -1.5, "{there}");
    }

    #[test]
    fn motion_capture_measures_the_velocity_over_ground_and_nobody_the_airspeed() {
        let hall = IndoorHall::default();
        let flight = hall.simulate(2).flight;
        assert!(flight.channel(ChannelName::Airspeed).is_none());
        let truth = flight.truth.as_ref().unwrap();
        let (begin, end) = (10.0, 40.0);
        let measured = |name| {
            let channel = flight.channel(name).unwrap();
            let samples = channel.times.iter().zip(&channel.values);
            let inside = samples.filter(|(t, _)| **t > begin - 1e-6 && **t < end - 1e-6);
            inside.map(|(_, v)| v / hall.sensors.rate).sum::<f64>()
        };
        let way = truth.position(end).unwrap() - truth.position(begin).unwrap();
        // Thirty seconds of a bias of 0.03 m/s, three deviations.
        assert!((measured(ChannelName::VelocityNorth) - way.x).abs() < 2.7);
        assert!((measured(ChannelName::VelocityEast) - way.y).abs() < 2.7);
        assert_eq!(flight, hall.simulate(2).flight);
    }
}
