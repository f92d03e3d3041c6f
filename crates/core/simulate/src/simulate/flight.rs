//! A flight along a path, and what was measured on it.

use nalgebra::{Point3, Vector2, Vector3};
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

use super::dryden::{DrydenGust, Turbulence};
use super::flight_airframe::{AircraftState, Airframe, AirframeCommand};
use super::guidance::{GuidanceSettings, PathFollower};
use super::sensors::{self, SensorSpec, SensorStream};
use pilotage_base::frames::{GroundPoint, LocalFrame};
use pilotage_flight::{Channel, Flight, Frame, FrameTruth, StartFix, Truth, TruthState};
use pilotage_raster::camera::CameraModel;

/// Strongest wind in which anybody takes off, as a share of the airspeed.
const STRONGEST_WIND: f64 = 0.75;
/// Winds drawn, at most, until one is weaker.
const WINDS_DRAWN: usize = 100;
/// Integration steps per second.
pub(super) const STEPS_PER_SECOND: usize = 100;
/// Steps between two recorded states; 20 Hz.
pub(super) const STEPS_PER_RECORD: usize = 5;

/// Flight to fly.
#[derive(Clone, Debug, PartialEq)]
pub struct FlightPlan {
    /// Name of the flight.
    pub name: String,
    /// Way-points over the ground; the flight begins at the first, on the course of the first leg.
    pub way_points: Vec<GroundPoint>,
    /// Height above ground, metres, where [`targets`](Self::targets) do not say another.
    pub height: f64,
    /// Targets at the way-points; none where all of it is flown at one height in cruise.
    pub targets: Vec<Target>,
    /// Mean wind: velocity of the air (north, east), m/s.
    pub wind: Vector2<f64>,
    /// Longest time, seconds, in case the wind is too strong to get on.
    pub longest: f64,
    /// The aircraft.
    pub airframe: Airframe,
    /// Its sensors.
    pub sensors: SensorSpec,
    /// Its camera.
    pub camera: CameraModel,
    /// The world frame on the globe.
    pub frame_on_globe: LocalFrame,
    /// Down coordinate of the ground plane, metres.
    pub ground_down: f64,
}

/// Height and airspeed with which a way-point is flown over.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Target {
    /// Height above ground at the way-point, metres; on the way there it changes evenly.
    pub height: f64,
    /// Airspeed on the leg that leads there, m/s; cruise if `None`.
    pub airspeed: Option<f64>,
}

/// A flight as it truly goes, recorded at 20 Hz.
#[derive(Clone, Debug, PartialEq)]
pub struct TrueFlight {
    /// Times, positions, attitudes and mean winds.
    pub states: Vec<TruthState>,
    /// Airspeed at each of them, m/s.
    pub airspeeds: Vec<f64>,
}

/// Inputs that turn a true flight into a measured one.
pub(super) struct Recording<'a> {
    pub name: &'a str,
    pub sensors: &'a SensorSpec,
    pub camera: &'a CameraModel,
    pub frame_on_globe: LocalFrame,
    /// Down coordinate of the ground plane, metres.
    pub ground_down: f64,
    pub seed: u64,
}

impl Recording<'_> {
    /// The flight through `states`, recorded at 20 Hz, with what was measured on it, its frames and its
    /// first position; `None` without any state.
    pub fn flight(&self, states: Vec<TruthState>, channels: Vec<Channel>) -> Option<Flight> {
        // Each frame at the record nearest to its time: as many a second as are asked for, if no more than records.
        let records_per_frame = (f64::from(STEPS_PER_SECOND as u32)
            / f64::from(STEPS_PER_RECORD as u32)
            / self.sensors.frame_rate)
            .max(1.0);
        let frame_states = || {
            let records = (0_u32..).map(|k| (f64::from(k) * records_per_frame).round() as usize);
            records.map_while(|record| states.get(record))
        };
        let frames = frame_states()
            .enumerate()
            .map(|(number, state)| Frame {
                time: state.time,
                name: format!("{number:05}.jpg"),
                stored_turn: 0.0,
            })
            .collect();
        let frame_truth = frame_states()
            .enumerate()
            .map(|(number, state)| FrameTruth {
                position: state.position,
                camera_attitude: state
                    .attitude
                    .map(|body| sensors::camera_attitude(self.sensors, self.seed, number, &body)),
            })
            .collect();
        let first = states.first()?;
        let begin = GroundPoint::new(first.position.x, first.position.y);
        Some(Flight {
            name: self.name.to_owned(),
            frame_on_globe: Some(self.frame_on_globe),
            camera: self.camera.clone(),
            ground_down: self.ground_down,
            channels,
            frames,
            start: StartFix {
                time: first.time,
                position: sensors::start_fix(self.sensors, self.seed, begin),
                standard_deviation: self.sensors.start_position,
            },
            truth: Some(Truth {
                states,
                frames: frame_truth,
            }),
        })
    }
}

impl FlightPlan {
    /// Flies the plan and measures. The same plan and seed give the same flight to the bit.
    ///
    /// Returns `None` for a path of fewer than two different way-points.
    ///
    /// ```
    /// use pilotage_base::frames::GroundPoint;
    /// use pilotage_simulate::simulate::{FlightPlan, Overrides, Scenario};
    ///
    /// let scenario = Scenario::named("distinct-400ft-calm").ok_or("no such scenario")?;
    /// let way_points = vec![GroundPoint::new(0.0, 0.0), GroundPoint::new(0.0, 300.0)];
    /// let plan = FlightPlan { way_points, ..scenario.plan(&Overrides::default()) };
    /// let flight = plan.simulate(1).ok_or("nothing to fly")?;
    /// // Two pictures a second.
    /// assert_eq!(flight.frames[1].time - flight.frames[0].time, 0.5);
    /// // The same seed is the same flight, to the bit.
    /// assert_eq!(plan.simulate(1).as_ref(), Some(&flight));
    /// assert_ne!(plan.simulate(2).as_ref(), Some(&flight));
    /// # Ok::<(), &str>(())
    /// ```
    pub fn simulate(&self, seed: u64) -> Option<Flight> {
        let flown = self.fly(Some(seed))?;
        let channels = sensors::measure(
            &self.sensors,
            seed,
            &flown.states,
            &flown.airspeeds,
            self.ground_down,
        );
        Recording {
            name: &self.name,
            sensors: &self.sensors,
            camera: &self.camera,
            frame_on_globe: self.frame_on_globe,
            ground_down: self.ground_down,
            seed,
        }
        .flight(flown.states, channels)
    }

    /// The same plan in a wind drawn by `seed` about the plan's with `deviation` m/s per axis, for
    /// studies over winds. A wind that nobody takes off in, because it would carry the aircraft away, is
    /// drawn anew.
    #[must_use]
    pub fn in_wind_of(&self, seed: u64, deviation: f64) -> Self {
        let mut random = SensorStream::Wind.random(seed);
        let mut drawn = (0..WINDS_DRAWN).map(|_| {
            let unit: Vector2<f64> = Vector2::from_fn(|_, _| StandardNormal.sample(&mut random));
            self.wind + deviation * unit
        });
        let strongest = STRONGEST_WIND * self.airframe.cruise;
        let flyable = drawn.find(|wind| wind.norm() < strongest);
        Self {
            wind: flyable.unwrap_or(self.wind),
            ..self.clone()
        }
    }

    /// The flight as planned: the mean wind blows and no gust.
    ///
    /// Returns `None` for a path of fewer than two different way-points.
    ///
    /// ```
    /// use pilotage_base::frames::GroundPoint;
    /// use pilotage_simulate::simulate::{FlightPlan, Overrides, Scenario};
    ///
    /// let scenario = Scenario::named("distinct-400ft-calm").ok_or("no such scenario")?;
    /// let way_points = vec![GroundPoint::new(0.0, 0.0), GroundPoint::new(0.0, 300.0)];
    /// let plan = FlightPlan { way_points, ..scenario.plan(&Overrides::default()) };
    /// // Eastward in calm air at cruising speed: 300 m / 18.87 m/s = 15.9 s.
    /// let flight = plan.nominal().ok_or("nothing to fly")?;
    /// let last = flight.states.last().ok_or("no state")?;
    /// assert!((last.time - 300.0 / plan.airframe.cruise).abs() < 0.1);
    /// assert!((last.position.y - 300.0).abs() < 2.0 && last.position.x.abs() < 0.1);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn nominal(&self) -> Option<TrueFlight> {
        self.fly(None)
    }

    /// Flies in the gusts of `seed`, or in none.
    fn fly(&self, seed: Option<u64>) -> Option<TrueFlight> {
        let dt = 1.0 / STEPS_PER_SECOND as f64;
        let guidance = GuidanceSettings::within(self.airframe.bank_limit);
        let mut path = PathFollower::new(&self.way_points, guidance)?;
        let turbulence = Turbulence::low_altitude(self.height, self.wind.norm());
        let mut gusts = seed.map(|seed| {
            let mut random = SensorStream::Gust.random(seed);
            let gust = DrydenGust::new(&turbulence, self.airframe.cruise, dt, &mut random);
            (gust, random)
        });
        let mut next_gust = || {
            let gust = gusts.as_mut();
            gust.map_or_else(Vector3::zeros, |(gust, random)| gust.step(random))
        };
        let targets = self.targets_of_legs();
        let begin = self.level(&targets, &path, &path.start());
        let mut aircraft = AircraftState::cruising(
            &self.airframe,
            path.start(),
            begin,
            self.crab_heading(path.initial_course()),
        );
        aircraft.airspeed = self.airspeed(&targets, &path);
        aircraft.gust = next_gust();

        let mut states = Vec::new();
        let mut airspeeds = Vec::new();
        let longest = (self.longest * STEPS_PER_SECOND as f64) as usize;
        for step in 0..=longest {
            let position = Vector2::new(aircraft.position.x, aircraft.position.y);
            if step % STEPS_PER_RECORD == 0 {
                states.push(TruthState {
                    time: step as f64 / STEPS_PER_SECOND as f64,
                    position: Point3::from(aircraft.position),
                    attitude: Some(aircraft.attitude(&self.airframe)),
                    wind: Some(self.wind),
                });
                airspeeds.push(aircraft.airspeed);
            }
            if path.finished(&position) {
                break;
            }
            let ground_velocity = aircraft.ground_velocity(&self.wind);
            let command = AirframeCommand {
                bank: path.bank(&position, &ground_velocity.xy()),
                airspeed: self.airspeed(&targets, &path),
                height: self.level(&targets, &path, &position),
            };
            aircraft.step(&self.airframe, &command, &self.wind, next_gust(), dt);
        }
        Some(TrueFlight { states, airspeeds })
    }

    /// The targets of the way-points that the path has: those in one place count once.
    fn targets_of_legs(&self) -> Vec<Target> {
        let mut kept: Vec<Target> = Vec::new();
        let mut last: Option<&GroundPoint> = None;
        for (place, target) in self.way_points.iter().zip(&self.targets) {
            if last.is_none_or(|last| last.distance(place) >= 1e-6) {
                kept.push(*target);
                last = Some(place);
            }
        }
        kept
    }

    /// Height above the origin's level to be flown at a place, metres.
    fn level(&self, targets: &[Target], path: &PathFollower, position: &Vector2<f64>) -> f64 {
        let ends = (targets.get(path.leg()), targets.get(path.leg() + 1));
        let height = match ends {
            (Some(from), Some(to)) => {
                from.height + path.progress(position) * (to.height - from.height)
            }
            (Some(only), None) | (None, Some(only)) => only.height,
            (None, None) => self.height,
        };
        height - self.ground_down
    }

    /// Airspeed to be flown on the leg that is followed, m/s.
    fn airspeed(&self, targets: &[Target], path: &PathFollower) -> f64 {
        let stated = targets.get(path.leg() + 1).and_then(|t| t.airspeed);
        stated.unwrap_or(self.airframe.cruise)
    }

    /// Heading that holds `course` over the ground in the mean wind, as far as the wind allows.
    fn crab_heading(&self, course: f64) -> f64 {
        let across = -course.sin() * self.wind.x + course.cos() * self.wind.y;
        course - (across / self.airframe.cruise).clamp(-1.0, 1.0).asin()
    }
}

#[cfg(test)]
mod tests {
    use super::super::scenario::{Overrides, Scenario, Wind};
    use super::*;
    use pilotage_base::frames::units::{feet, knots};
    use pilotage_flight::ChannelName;

    fn plan(way_points: &[(f64, f64)], wind: Wind) -> FlightPlan {
        FlightPlan {
            way_points: way_points
                .iter()
                .map(|(n, e)| GroundPoint::new(*n, *e))
                .collect(),
            wind: wind.velocity(),
            ..Scenario::all()[0].plan(&Overrides::default())
        }
    }

    #[test]
    fn a_climb_along_a_leg_is_flown_evenly_and_each_leg_at_its_speed() {
        let mut climb = plan(
            &[(0.0, 0.0), (0.0, 0.0), (0.0, 800.0), (0.0, 1600.0)],
            Wind::default(),
        );
        let target = |height, airspeed| Target { height, airspeed };
        climb.targets = vec![
            target(100.0, None),
            target(100.0, None),
            target(140.0, Some(16.0)),
            target(140.0, Some(24.0)),
        ];
        let flown = climb.nominal().unwrap();
        let at = |east: f64| {
            let away = |s: &&TruthState| (s.position.y - east).abs();
            let index = flown.states.iter().map(|s| away(&s)).enumerate();
            let (index, _) = index.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
            (-flown.states[index].position.z, flown.airspeeds[index])
        };
        assert!((at(400.0).0 - 120.0).abs() < 4.0, "{:?}", at(400.0));
        assert!((at(1500.0).0 - 140.0).abs() < 1.0, "{:?}", at(1500.0));
        assert!((at(400.0).1 - 16.0).abs() < 0.5, "{:?}", at(400.0));
        assert!((at(1500.0).1 - 24.0).abs() < 0.5, "{:?}", at(1500.0));
    }

    #[test]
    fn as_many_frames_are_taken_as_are_asked_for() {
        let mut plan = plan(&[(0.0, 0.0), (0.0, 3000.0)], Wind::default());
        plan.longest = 60.0;
        for (rate, asked) in [
            (0.5, 31),
            (2.0, 121),
            (6.0, 361),
            (8.0, 481),
            (15.0, 901),
            (20.0, 1201),
        ] {
            plan.sensors.frame_rate = rate;
            let flight = plan.simulate(1).unwrap();
            let frames = flight.frames;
            assert!(
                frames.len().abs_diff(asked) <= 1,
                "{rate}: {}",
                frames.len()
            );
            let late = |(k, frame): (u32, &Frame)| frame.time - f64::from(k) / rate;
            assert!((0..).zip(&frames).map(late).all(|late| late.abs() < 0.026));
        }
    }

    fn truth(plan: &FlightPlan, seed: u64) -> Vec<TruthState> {
        plan.simulate(seed).unwrap().truth.unwrap().states
    }

    /// The thesis: 40 s for the first leg in calm air, 55 s against ten knots (2475 ft).
    #[test]
    fn the_first_leg_takes_the_times_of_the_thesis() {
        let leg = [(0.0, 0.0), (0.0, feet(2475.0))];
        let calm = truth(&plan(&leg, Wind::default()), 1).last().unwrap().time;
        assert!((calm - 40.0).abs() < 0.7, "{calm}");
        let against = Wind {
            from: 82.0_f64.to_radians(),
            speed: knots(10.0),
        };
        let slow = truth(&plan(&leg, against), 1).last().unwrap().time;
        assert!((slow - 55.0).abs() < 1.5, "{slow}");
    }

    /// The thesis: the pool comes 64 to 65 s after the start in calm air and about 82 s in the wind.
    #[test]
    fn the_scenarios_reach_the_pool_about_when_the_thesis_does() {
        for (scenario, expected) in Scenario::all().iter().zip([65.0, 82.0]) {
            let states = truth(&scenario.plan(&Overrides::default()), 1);
            let pool = Vector2::new(510.0, 240.0);
            let nearest = states
                .iter()
                .min_by(|a, b| {
                    let d = |s: &TruthState| (s.position.xy().coords - pool).norm();
                    d(a).total_cmp(&d(b))
                })
                .unwrap();
            assert!((nearest.time - expected).abs() < 3.0, "{}", nearest.time);
        }
    }

    #[test]
    fn an_aircraft_in_a_crosswind_stays_on_its_leg_and_points_into_the_wind() {
        let wind = Wind {
            from: 0.0,
            speed: 5.0,
        };
        let states = truth(&plan(&[(0.0, 0.0), (0.0, 900.0)], wind), 3);
        assert!(states.iter().all(|s| s.position.x.abs() < 6.0));
        let mean_heading =
            states.iter().map(|s| s.attitude.unwrap().yaw).sum::<f64>() / states.len() as f64;
        let crab = 90.0 - mean_heading.to_degrees();
        // asin(5 / 18.87) = 15.4 degrees to the left of east.
        assert!((crab - 15.4).abs() < 1.0, "{crab}");
    }

    #[test]
    fn a_right_turn_has_a_radius_of_about_65_metres_and_keeps_its_height() {
        let states = truth(
            &plan(
                &[(0.0, 0.0), (0.0, 300.0), (-900.0, 300.0)],
                Wind::default(),
            ),
            5,
        );
        let easternmost = states.iter().map(|s| s.position.y).fold(0.0, f64::max);
        assert!(
            (300.0 - 5.0..300.0 + 12.0).contains(&easternmost),
            "{easternmost}"
        );
        let begin = states.iter().find(|s| s.position.x < -1.5).unwrap();
        let end = states
            .iter()
            .find(|s| s.attitude.unwrap().yaw > 170.0_f64.to_radians())
            .unwrap();
        let extent = end.position.y - begin.position.y;
        assert!((50.0..80.0).contains(&extent), "{extent}");
        assert!(
            states
                .iter()
                .all(|s| (-s.position.z - feet(400.0)).abs() < 2.0)
        );
    }

    #[test]
    fn the_ground_velocity_is_that_through_the_air_plus_wind_and_a_small_gust() {
        let wind = Wind {
            from: 307.0_f64.to_radians(),
            speed: knots(10.0),
        };
        let flight = plan(&[(0.0, 0.0), (0.0, 900.0)], wind).simulate(9).unwrap();
        let states = &flight.truth.as_ref().unwrap().states;
        let mut sum = Vector2::zeros();
        for pair in states.windows(2) {
            let ground = (pair[1].position - pair[0].position).xy() / (pair[1].time - pair[0].time);
            let yaw = pair[0].attitude.unwrap().yaw;
            let airspeed = flight.value(ChannelName::Airspeed, pair[0].time).unwrap();
            sum += ground - airspeed * Vector2::new(yaw.cos(), yaw.sin());
        }
        let mean = sum / (states.len() - 1) as f64;
        // Gusts and the bias of the airspeed sensor remain.
        assert!((mean - wind.velocity()).norm() < 1.0, "{mean}");
    }

    #[test]
    fn the_same_seed_gives_the_same_flight_and_another_seed_another() {
        let scenario = &Scenario::all()[1];
        let flight = scenario.fly(4, &Overrides::default());
        assert_eq!(flight, scenario.fly(4, &Overrides::default()));
        assert_ne!(flight, scenario.fly(5, &Overrides::default()));
    }

    #[test]
    fn the_winds_of_many_flights_are_spread_as_asked_and_none_carries_the_aircraft_away() {
        let plan = Scenario::all()[1].plan(&Overrides::default());
        let calm = FlightPlan {
            wind: Vector2::zeros(),
            ..plan
        };
        let winds: Vec<_> = (0..4000)
            .map(|seed| calm.in_wind_of(seed, 4.0).wind)
            .collect();
        let square = winds.iter().map(Vector2::norm_squared).sum::<f64>() / 8000.0;
        assert!((square.sqrt() - 4.0).abs() < 0.1, "{square}");
        assert!(
            winds
                .iter()
                .all(|wind| wind.norm() < 0.75 * calm.airframe.cruise)
        );
        let strong = winds.iter().filter(|wind| wind.norm() > 10.0).count() as f64 / 4000.0;
        assert!(
            (strong - (-0.5 * 2.5_f64.powi(2)).exp()).abs() < 0.012,
            "{strong}"
        );
    }

    #[test]
    fn frames_come_every_half_second_each_with_its_true_pose() {
        let flight = Scenario::all()[0].fly(4, &Overrides::default());
        let truth = flight.truth.as_ref().unwrap();
        assert_eq!(flight.frames.len(), truth.frames.len());
        for (i, (frame, pose)) in flight.frames.iter().zip(&truth.frames).enumerate() {
            assert_eq!(frame.time, 0.5 * i as f64);
            assert_eq!(truth.position(frame.time).unwrap(), pose.position);
        }
        let shake: Vec<f64> = truth
            .frames
            .iter()
            .zip(truth.states.iter().step_by(10))
            .map(|(f, s)| f.camera_attitude.unwrap().roll - s.attitude.unwrap().roll)
            .collect();
        let variance = shake.iter().map(|s| s * s).sum::<f64>() / shake.len() as f64;
        assert!((0.8..1.2).contains(&variance.sqrt().to_degrees()));
    }

    #[test]
    fn every_scenario_stays_over_the_scenery() {
        for scenario in Scenario::all() {
            let flight = scenario.fly(2, &Overrides::default());
            for s in &flight.truth.as_ref().unwrap().states {
                assert!(s.position.x.abs() <= 900.0 && s.position.y.abs() <= 900.0);
            }
        }
    }
}
