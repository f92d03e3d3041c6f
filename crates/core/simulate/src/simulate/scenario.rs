//! The built-in scenarios, by name.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use super::dryden::Turbulence;
use super::flight::FlightPlan;
use super::flight_airframe::Airframe;
use super::flight_day::FlightDay;
use super::flight_frames::{SimulatedFlight, SimulatedFrames};
use super::route;
use super::scenery::{DEMO_SEED, Day, DistinctFeature, Scenery};
use super::sensors::{SensorError, SensorSpec};
use pilotage_base::frames::units::{feet, knots};
use pilotage_base::frames::{Geodetic, GroundPoint, GroundRect, LocalFrame};
use pilotage_flight::Flight;
use pilotage_mission::mission::{MapReference, Mission};
use pilotage_mission::settings::{
    ChosenAid, GENERIC_LANDMARKS, NavigatorSettings, ProcessNoise, ROAD_MAP, SensorNoise,
    StartError, VehicleChoice,
};
use pilotage_raster::camera::CameraModel;
use pilotage_vision::landmark::Landmark;

/// Landmarks of the scenarios: nine buildings and a pool.
pub(super) const LANDMARKS: usize = 10;

/// Errors of the places that the template detector finds on other days of the generated world, which its covariance
/// does not know, pixels and metres per axis.
///
/// Measured against the truth over the ten landmarks on nine days that lie evenly among all, 675 looks from 400 ft and
/// 4,333 from 1000 ft: a landmark's places scatter by 0.19 to 0.26 px, its turn and size by 0.004; and about each other
/// the landmarks' means by 0.13 m from 400 ft and 0.06 m from 1000 ft, their turns by 0.006 and 0.008, their sizes by
/// 0.009. The two together stand for 0.56 px, 0.007 and 0.007 from 400 ft, where 0.52 to 0.59, 0.007 and 0.010 were
/// measured; for 0.32 px, 0.010 and 0.010 from 1000 ft, where 0.25 to 0.28, 0.009 and 0.011 were.
const DETECTOR_PIXEL: f64 = 0.18;
const DETECTOR_GROUND: f64 = 0.11;

/// Error of the map of generated roads per axis, metres: verges and worn edges move their middle so far.
const GENERATED_ROAD_ERROR: f64 = 0.3;

/// Error per axis that generic landmarks share by the shadows of another day, metres: as measured
/// (`pilotage classes places --countries 8 --pictures 6`).
const SHARED_BY_SHADOWS: f64 = 0.43;

/// An aid with the numbers that hold in the generated world for whoever flies at `height`, metres, with sensors of `spec`.
fn chosen_aid(key: &str, height: f64, spec: &SensorSpec) -> ChosenAid {
    let aid = ChosenAid::usual(key);
    if key == ROAD_MAP.aid {
        aid.with(ROAD_MAP.number, GENERATED_ROAD_ERROR)
    } else if key == GENERIC_LANDMARKS.aid {
        // A bias of roll or pitch moves all that is seen.
        let shared = SHARED_BY_SHADOWS.hypot(height * spec.attitude.bias);
        aid.with(GENERIC_LANDMARKS.number, shared)
    } else {
        aid
    }
}

/// Width of the pictures of most scenarios, pixels.
const PICTURE_WIDTH: usize = 640;

/// A camera with pictures of `width` pixels, 60° across, looking down.
fn camera_of(width: usize) -> CameraModel {
    CameraModel::pinhole(width, width * 3 / 4, 60.0_f64.to_radians())
}

/// Origin of the generated world on the globe: a place without a map, in the North Atlantic.
pub fn world_origin() -> Geodetic {
    Geodetic::from_degrees(45.0, -30.0, 0.0)
}

/// Mean wind as people state it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Wind {
    /// Direction from which it blows, radians clockwise from north.
    pub from: f64,
    /// Speed at flight height, m/s.
    pub speed: f64,
}

impl Wind {
    /// The wind of air that moves so (north, east), m/s.
    pub fn of_velocity(velocity: &Vector2<f64>) -> Self {
        Self {
            from: (-velocity.y).atan2(-velocity.x).rem_euclid(TAU),
            speed: velocity.norm(),
        }
    }

    /// Velocity of the air (north, east), m/s.
    ///
    /// ```
    /// use pilotage_simulate::simulate::Wind;
    ///
    /// // A wind from the north blows towards the south.
    /// let velocity = Wind { from: 0.0, speed: 5.0 }.velocity();
    /// assert_eq!((velocity.x, velocity.y.abs()), (-5.0, 0.0));
    /// ```
    pub fn velocity(&self) -> Vector2<f64> {
        -self.speed * Vector2::new(self.from.cos(), self.from.sin())
    }
}

/// A flight that can be had by its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// Name on the command line and in files.
    pub name: &'static str,
    /// Title for people.
    pub title: &'static str,
    /// Description of what happens in the scenario.
    pub description: &'static str,
    /// Way-points over the ground.
    pub route: Vec<GroundPoint>,
    /// Height above ground, metres.
    pub height: f64,
    /// Mean wind.
    pub wind: Wind,
    /// Whether it is flown by named landmarks.
    pub by_landmarks: bool,
    /// Keys of the aids by which it is flown, beside landmarks or in their place.
    pub aids: &'static [&'static str],
    /// The day on which its camera sees the ground where that is not the map's.
    pub other_day: FlightDay,
    /// Width of its pictures, pixels; they are three quarters as high.
    pub picture_width: usize,
}

/// Values that the user wants otherwise than the scenario has them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Overrides {
    /// Mean wind.
    pub wind: Option<Wind>,
    /// Height above ground, metres.
    pub height: Option<f64>,
    /// The day on which the camera sees the ground.
    pub day: Option<FlightDay>,
    /// Sensor errors.
    pub sensors: Option<SensorSpec>,
}

/// The part of each distinct feature that is picked as its landmark: name, centre north and east of the
/// middle of the feature, side; metres.
///
/// A whole building with its yard does not fit into a picture from 400 ft for long; a box of 34 m or
/// 40 m does, turned by any heading, for five frames or more. Within the feature the box lies where the
/// map's patch scored high, and clearly higher than its own rivals, over three rehearsal days with
/// other suns and seasons: none of them is a day that the scenarios fly on.
const PICKED: [(&str, f64, f64, f64); LANDMARKS] = [
    ("dairy barn", 8.0, -16.0, 40.0),
    ("greenhouse rows", 16.0, -4.0, 40.0),
    ("church", -8.0, 0.0, 34.0),
    ("L-shaped school", 0.0, -8.0, 40.0),
    ("vaulted sports hall", -12.0, -16.0, 34.0),
    ("H-shaped hospital", 8.0, 16.0, 34.0),
    ("supermarket", 16.0, -16.0, 34.0),
    ("water tanks", -16.0, -4.0, 34.0),
    ("sawtooth factory", 16.0, 12.0, 34.0),
    ("swimming pool", 8.0, -4.0, 34.0),
];

/// The picked part of a feature; its middle if it is not in the list.
pub(super) fn picked(feature: &DistinctFeature) -> GroundRect {
    let middle = feature.landmark_box.center();
    let known = PICKED.iter().find(|(name, ..)| *name == feature.name);
    let (north, east, side) = known.map_or((0.0, 0.0, 36.0), |(_, n, e, s)| (*n, *e, *s));
    let center = GroundPoint::new(middle.north + north, middle.east + east);
    GroundRect::centered(center, side, side)
}

impl Scenario {
    /// Every scenario, in the order in which people read them.
    pub fn all() -> Vec<Self> {
        let usual = Self {
            name: "",
            title: "",
            description: "",
            route: Vec::new(),
            height: feet(1000.0),
            wind: Wind::default(),
            by_landmarks: true,
            aids: &[],
            other_day: FlightDay::Other,
            picture_width: PICTURE_WIDTH,
        };
        let mut all = vec![
            Self {
                name: "distinct-400ft-calm",
                title: "Village, calm",
                description: "A leg north-west over nine buildings, a right turn, and a leg \
                              north-east along a road without any landmark until a pool near its \
                              end. Calm air.",
                route: route::two_legs(),
                height: feet(400.0),
                ..usual.clone()
            },
            Self {
                name: "distinct-400ft-wind",
                title: "Village in wind",
                description: "The same route against a wind of which the filter knows nothing at \
                              the start: it has to learn it from the landmarks.",
                route: route::two_legs(),
                height: feet(400.0),
                wind: Wind {
                    from: 307.0_f64.to_radians(),
                    speed: knots(10.0),
                },
                ..usual.clone()
            },
            Self {
                name: "distinct-1000ft-extended",
                title: "Village from higher up",
                description: "Over three minutes of S-turns in several directions over the \
                              same ten landmarks, with gaps in which none is in view. Calm air.",
                route: route::extended(),
                ..usual.clone()
            },
            Self {
                name: "roads-400ft",
                title: "Along a road",
                description: "The leg north-east along a straight road, without a landmark: the road \
                              tells the place across it, and nothing along it. Calm air.",
                route: route::road_leg(),
                height: feet(400.0),
                by_landmarks: false,
                aids: &[ROAD_MAP.aid],
                ..usual.clone()
            },
            Self {
                name: "generic-1000ft",
                title: "Without named landmarks",
                description: "The same S-turns without any picked landmark: buildings, trees, \
                              waters and paved places are found in the map and in the pictures, \
                              and told apart by their arrangement. Calm air.",
                route: route::extended(),
                by_landmarks: false,
                aids: &[GENERIC_LANDMARKS.aid],
                ..usual.clone()
            },
            Self {
                name: "blended-1000ft",
                title: "Everything that helps",
                description: "The same S-turns by the ten landmarks, by what nobody picked and by \
                              roads together. Calm air.",
                route: route::extended(),
                aids: &[ROAD_MAP.aid, GENERIC_LANDMARKS.aid],
                ..usual
            },
        ];
        all.extend(Self::high());
        all
    }

    /// The scenarios from so high that a picture shows half the country, as wide as the pictures of the thesis.
    fn high() -> [Self; 2] {
        [
            Self {
                name: "generic-2500ft-winter",
                title: "High over late winter",
                description: "From the east along a road, turns, and back east without it, in a wind \
                              from the south. The map is of summer, the camera sees bare trees \
                              and pale grass.",
                route: route::winter(),
                height: feet(2500.0),
                wind: Wind {
                    from: 180.0_f64.to_radians(),
                    speed: knots(5.0),
                },
                by_landmarks: false,
                aids: &[GENERIC_LANDMARKS.aid],
                other_day: FlightDay::LateWinter,
                picture_width: 2 * PICTURE_WIDTH,
            },
            Self {
                name: "generic-3500ft-spring",
                title: "Higher over early spring",
                description: "A circuit as around an airfield, over the village and out to the four \
                              corners of the country, where landmarks are few, in a wind from \
                              the south-west.",
                route: route::spring(),
                height: feet(3500.0),
                wind: Wind {
                    from: 230.0_f64.to_radians(),
                    speed: knots(4.0),
                },
                by_landmarks: false,
                aids: &[GENERIC_LANDMARKS.aid],
                other_day: FlightDay::EarlySpring,
                picture_width: 2 * PICTURE_WIDTH,
            },
        ]
    }

    /// The scenario of that name.
    ///
    /// ```
    /// use pilotage_simulate::simulate::{Overrides, Scenario};
    ///
    /// let scenario = Scenario::named("distinct-400ft-wind").ok_or("no such scenario")?;
    /// let plan = scenario.plan(&Overrides::default());
    /// assert!((plan.height - 121.92).abs() < 1e-9); // 400 ft
    /// assert!((plan.wind.norm() - 5.144).abs() < 1e-3); // 10 kt
    /// # Ok::<(), &str>(())
    /// ```
    pub fn named(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|s| s.name == name)
    }

    /// The camera of most scenarios: 640×480, 60° across, fixed to the airframe, looking down.
    pub fn camera() -> CameraModel {
        camera_of(PICTURE_WIDTH)
    }

    /// Plan of the flight.
    pub fn plan(&self, overrides: &Overrides) -> FlightPlan {
        FlightPlan {
            name: self.name.to_owned(),
            way_points: self.route.clone(),
            height: overrides.height.unwrap_or(self.height),
            targets: Vec::new(),
            wind: overrides.wind.unwrap_or(self.wind).velocity(),
            longest: 900.0,
            airframe: Airframe::sig_kadet_senior(),
            sensors: overrides.sensors.unwrap_or_default(),
            camera: camera_of(self.picture_width),
            frame_on_globe: LocalFrame::new(world_origin()),
            ground_down: 0.0,
        }
    }

    /// The day on which its camera sees the ground of a flight on `day`.
    pub fn seen_on(&self, day: FlightDay) -> FlightDay {
        match day {
            FlightDay::Other => self.other_day,
            day => day,
        }
    }

    /// The flight with its pictures, which are made when they are asked for.
    pub fn simulate(&self, seed: u64, overrides: &Overrides) -> SimulatedFlight {
        let flight = self.fly(seed, overrides);
        let day = overrides.day.unwrap_or_default();
        SimulatedFlight {
            frames: SimulatedFrames::new(&flight, self.seen_on(day), seed),
            seed,
            day,
            flight,
        }
    }

    /// The map of every scenario.
    pub fn map() -> Scenery {
        Scenery::new(DEMO_SEED, Day::map_day())
    }

    /// The landmarks, or the aids, and how to navigate the scenario with them.
    pub fn mission(&self) -> Mission {
        self.mission_over(&Self::map())
    }

    /// The same over the map as laid out already.
    pub fn mission_over(&self, map: &Scenery) -> Mission {
        let landmarks = map
            .distinct_features()
            .into_iter()
            .take(if self.by_landmarks { LANDMARKS } else { 0 })
            .zip(1..)
            .map(|(feature, id)| {
                let bounds = picked(&feature);
                Landmark::new(id, feature.name, bounds)
            })
            .collect();
        Mission {
            name: self.title.to_owned(),
            origin: world_origin(),
            map: Some(MapReference::Scenario(self.name.to_owned())),
            landmarks,
            routes: Vec::new(),
            no_fly: Vec::new(),
            rally: Vec::new(),
            roads: if self.aids.contains(&ROAD_MAP.aid) {
                map.road_map().lines().to_vec().into()
            } else {
                Vec::new().into()
            },
            labels: Vec::new(),
            camera: Some(camera_of(self.picture_width)),
            camera_to_log: None,
            navigator: self.navigator(&SensorSpec::default()),
            properties: BTreeMap::new(),
        }
    }

    /// Settings that know the errors of the `sensors` and the turbulence to be expected at the scenario's height.
    pub fn navigator(&self, sensors: &SensorSpec) -> NavigatorSettings {
        let airframe = Airframe::sig_kadet_senior();
        let turbulence = Turbulence::low_altitude(self.height, 0.0);
        let step = 1.0 / sensors.rate;
        let camera_angle = |error: SensorError| {
            (sensors.mount_vibration.powi(2) + error.noise.powi(2) + error.bias.powi(2)).sqrt()
        };
        let defaults = NavigatorSettings::default();
        NavigatorSettings {
            vehicle: VehicleChoice::AirplaneFull,
            start: StartError {
                position: sensors.start_position,
                wind: if self.wind.speed > 0.0 { 4.0 } else { 1.0 },
                offset: [0.0, 0.0],
            },
            process: ProcessNoise {
                // White noise per sample, held for one step, as a density.
                airspeed: sensors.airspeed.noise * step.sqrt(),
                heading: sensors.heading.noise * step.sqrt(),
                position: 0.02,
                wind: 0.01,
                gust: turbulence.intensity.x,
                gust_per_wind: Turbulence::per_wind(self.height),
                gust_time: turbulence.correlation_time(airframe.cruise),
                airspeed_bias: sensors.airspeed.bias,
                heading_bias: sensors.heading.bias,
                ..defaults.process
            },
            sensors: SensorNoise {
                roll: camera_angle(sensors.attitude),
                pitch: camera_angle(sensors.attitude),
                yaw: camera_angle(sensors.heading),
                height: sensors.height.noise.hypot(sensors.height.bias),
                pixel: DETECTOR_PIXEL,
                ground: DETECTOR_GROUND,
                tilt_bias: sensors.attitude.bias,
                yaw_bias: sensors.heading.bias,
                height_bias: sensors.height.bias,
            },
            aids: self
                .aids
                .iter()
                .map(|key| chosen_aid(key, self.height, sensors))
                .collect(),
            ..defaults
        }
    }

    /// The flight alone, without pictures.
    ///
    /// # Panics
    ///
    /// Only for a scenario put together by hand with fewer than two different way-points.
    pub fn fly(&self, seed: u64, overrides: &Overrides) -> Flight {
        self.plan(overrides)
            .simulate(seed)
            .expect("the routes of the scenarios have more than two way-points")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_flight::FrameTruth;
    use pilotage_roads::{RoadJoining, RoadMap};

    #[test]
    fn flights_of_one_name_are_known_by_where_they_went() {
        let scenario = Scenario::named("distinct-400ft-calm").unwrap();
        let identity = |seed, overrides: &Overrides| scenario.fly(seed, overrides).identity();
        let first = identity(1, &Overrides::default());
        assert!(first.starts_with("distinct-400ft-calm from "), "{first}");
        // On another day the pictures are of the same ground from the same places.
        let on_other_day = Overrides {
            day: Some(FlightDay::Same),
            ..Overrides::default()
        };
        assert_eq!(first, identity(1, &on_other_day));
        assert_ne!(first, identity(2, &Overrides::default()));
        let wind = Some(Wind {
            from: 1.0,
            speed: 5.0,
        });
        let in_wind = Overrides {
            wind,
            ..Overrides::default()
        };
        assert_ne!(first, identity(1, &in_wind));
        let mut shifted = scenario.fly(1, &Overrides::default());
        for frame in &mut shifted.frames {
            frame.time += 0.4;
        }
        shifted.camera = CameraModel::pinhole(64, 48, 1.0);
        assert_eq!(first, shifted.identity());
    }

    /// For every frame, how many of the mission's landmarks lie in it.
    fn in_view(scenario: &Scenario) -> Vec<usize> {
        let (flight, mission) = (scenario.fly(1, &Overrides::default()), scenario.mission());
        let truth = flight.truth.unwrap();
        let poses = truth.frames.iter().filter_map(FrameTruth::pose);
        poses
            .map(|pose| {
                let seen = mission.landmarks.iter().filter(|landmark| {
                    let point = landmark.reference_in_world(0.0);
                    let pixel = flight.camera.project(&pose, &point);
                    pixel.is_some_and(|p| flight.camera.in_picture(&p, 30.0))
                });
                seen.count()
            })
            .collect()
    }

    #[test]
    fn every_scenario_has_nine_buildings_and_a_pool_and_sees_them_all_or_aids_in_their_place() {
        for scenario in Scenario::all() {
            let mission = scenario.mission();
            assert_eq!(mission.navigator.aids.len(), scenario.aids.len());
            if !scenario.by_landmarks {
                assert!(mission.landmarks.is_empty() && !scenario.aids.is_empty());
                continue;
            }
            assert_eq!(mission.landmarks.len(), 10);
            assert_eq!(mission.landmarks[9].name, "swimming pool");
            assert!(in_view(&scenario).iter().filter(|n| **n > 0).count() > 60);
        }
    }

    #[test]
    fn the_extended_flight_mostly_sees_a_landmark_and_sometimes_none() {
        let seen = in_view(&Scenario::all()[2]);
        let share = seen.iter().filter(|n| **n > 0).count() as f64 / seen.len() as f64;
        let gap = seen.split(|n| *n > 0).map(<[usize]>::len).max().unwrap();
        println!(
            "{share:.2} of the frames see a landmark, longest gap {} s",
            gap / 2
        );
        assert!((0.55..0.95).contains(&share), "{share}");
        assert!((20..=80).contains(&gap), "{gap} frames");
    }

    #[test]
    fn the_flight_by_roads_follows_one_that_is_straight_and_alone_in_view() {
        let scenario = Scenario::named("roads-400ft").unwrap();
        let mission = scenario.mission();
        assert!(mission.landmarks.is_empty());
        let roads = RoadMap::new(mission.roads.to_vec(), RoadJoining::SHARED_POINTS);
        let flight = scenario.fly(1, &Overrides::default());
        let truth = flight.truth.unwrap();
        for state in &truth.states {
            let below = GroundPoint::new(state.position.x, state.position.y);
            let near = roads.nearest(below, 30.0).unwrap();
            assert_eq!(roads.line_of(near.edge).name, "South Road");
        }
    }

    #[test]
    fn the_high_flights_take_large_pictures_and_know_that_a_bias_of_the_attitude_moves_all_of_them()
    {
        let shared = |scenario: &Scenario| {
            let aids = scenario.mission().navigator.aids;
            GENERIC_LANDMARKS.of(&aids).unwrap()
        };
        let low = shared(&Scenario::named("generic-1000ft").unwrap());
        for name in ["generic-2500ft-winter", "generic-3500ft-spring"] {
            let scenario = Scenario::named(name).unwrap();
            let flight = scenario.fly(1, &Overrides::default());
            assert_eq!(scenario.mission().camera, Some(flight.camera.clone()));
            assert_eq!((flight.camera.width, flight.camera.height), (1280, 960));
            // 0.15° of roll from so high.
            let moved = scenario.height * 0.15_f64.to_radians();
            assert!(shared(&scenario) >= moved && moved > low, "{name}");
        }
    }

    #[test]
    fn a_wind_from_the_north_west_blows_towards_the_south_east() {
        let wind = Scenario::all()[1].wind.velocity();
        assert!((wind.norm() - knots(10.0)).abs() < 1e-12);
        assert!((wind.x + 3.096).abs() < 1e-3 && (wind.y - 4.109).abs() < 1e-3);
    }
}
