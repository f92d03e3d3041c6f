//! The built-in scenarios, by name.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use super::flight::FlightPlan;
use super::flight_airframe::Airframe;
use super::route;
use super::sensors::SensorSpec;
use crate::camera::CameraModel;
use crate::flight::Flight;
use crate::frames::units::{feet, knots};
use crate::frames::{Geodetic, GroundPoint, LocalFrame};

/// Where the generated world lies on the globe: a place without a map, in the North Atlantic.
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
    /// Velocity of the air (north, east), m/s.
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
    /// What happens in it.
    pub description: &'static str,
    /// Way-points over the ground.
    pub route: Vec<GroundPoint>,
    /// Height above ground, metres.
    pub height: f64,
    /// Mean wind.
    pub wind: Wind,
}

/// What the user wants otherwise than the scenario has it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Overrides {
    /// Mean wind.
    pub wind: Option<Wind>,
    /// Height above ground, metres.
    pub height: Option<f64>,
    /// Sensor errors.
    pub sensors: Option<SensorSpec>,
}

impl Scenario {
    /// Every scenario, in the order in which people read them.
    pub fn all() -> Vec<Self> {
        vec![
            Self {
                name: "distinct-400ft-calm",
                title: "Nine buildings and a pool, 400 ft, calm",
                description: "A leg over nine buildings, a right turn, and a leg along a road \
                              without any landmark until a pool near its end. Calm air.",
                route: route::two_legs(),
                height: feet(400.0),
                wind: Wind::default(),
            },
            Self {
                name: "distinct-400ft-wind",
                title: "The same in wind, 400 ft, 307° at 10 kt",
                description: "The same route in a wind from 307° at 10 kt of which the filter \
                              knows nothing at the start: it has to learn it from the landmarks.",
                route: route::two_legs(),
                height: feet(400.0),
                wind: Wind {
                    from: 307.0_f64.to_radians(),
                    speed: knots(10.0),
                },
            },
            Self {
                name: "distinct-1000ft-extended",
                title: "S-turns over the same places, 1000 ft, calm",
                description: "Four minutes at 1000 ft with S-turns in several directions over the \
                              same ten landmarks, with gaps in which none is in view. Calm air.",
                route: route::extended(),
                height: feet(1000.0),
                wind: Wind::default(),
            },
        ]
    }

    /// The scenario of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|s| s.name == name)
    }

    /// The camera of every scenario: 640×480, 60° across, fixed to the airframe, looking down.
    pub fn camera() -> CameraModel {
        CameraModel::pinhole(640, 480, 60.0_f64.to_radians())
    }

    /// What is flown.
    pub fn plan(&self, overrides: &Overrides) -> FlightPlan {
        FlightPlan {
            name: self.name.to_owned(),
            way_points: self.route.clone(),
            height: overrides.height.unwrap_or(self.height),
            wind: overrides.wind.unwrap_or(self.wind).velocity(),
            longest: 900.0,
            airframe: Airframe::sig_kadet_senior(),
            sensors: overrides.sensors.unwrap_or_default(),
            camera: Self::camera(),
            frame_on_globe: LocalFrame::new(world_origin()),
            ground_down: 0.0,
        }
    }

    /// The flight alone, without pictures.
    pub fn fly(&self, seed: u64, overrides: &Overrides) -> Flight {
        self.plan(overrides)
            .simulate(seed)
            .expect("the routes of the scenarios have more than two way-points")
    }
}
