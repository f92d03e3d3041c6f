//! Ground of a plan: a map, a mission on it, an aircraft.

use std::sync::Arc;

use pilotage_core::camera::CameraModel;
use pilotage_core::flight::read_flight;
use pilotage_core::frames::{AltitudeFrame, GroundPoint, LocalFrame};
use pilotage_core::imagery::{CachedImagery, Imagery};
use pilotage_core::mission::{Mission, Route, WayPoint};
use pilotage_core::plan::{OtherDays, PictureDays, SceneryDays, random_route};
use pilotage_core::simulate::{FlightPlan, Overrides, Scenario, SensorSpec, Target};

use super::arguments::Arguments;
use super::source::Source;
use crate::files::{Directory, MAP_CACHE};
use crate::mission_file::OpenMission;

/// The map, the mission on it and how it is flown.
pub struct Ground {
    pub map: Arc<dyn Imagery>,
    pub days: Box<dyn OtherDays>,
    pub mission: Mission,
    pub camera: CameraModel,
    pub height: f64,
    pub plan: Option<FlightPlan>,
}

impl Ground {
    /// Opens the ground that the arguments of a plan name.
    pub fn of(arguments: &Arguments) -> Result<Self, Box<dyn std::error::Error>> {
        let mut ground = Self::at(&arguments.source)?;
        if let Some(plan) = ground
            .plan
            .as_mut()
            .filter(|_| arguments.source.scenario.is_some())
        {
            if let Some(text) = &arguments.route {
                plan.way_points = way_points(text)?;
            }
            if let Some(seed) = arguments.random_route {
                plan.way_points = random_route(seed);
                plan.wind = nalgebra::Vector2::zeros();
            }
        }
        Ok(ground)
    }

    /// Opens the ground that a source names.
    pub fn at(arguments: &Source) -> Result<Self, Box<dyn std::error::Error>> {
        if let Some(name) = &arguments.scenario {
            let scenario = Scenario::named(name).ok_or_else(|| {
                format!("there is no scenario \"{name}\"; see pilotage scenarios")
            })?;
            let overrides = Overrides {
                height: arguments.height,
                ..Overrides::default()
            };
            let plan = scenario.plan(&overrides);
            return Ok(Self {
                map: Arc::new(CachedImagery::new(Arc::new(Scenario::map()), MAP_CACHE)),
                days: Box::new(SceneryDays {
                    scenery: Scenario::map(),
                }),
                mission: scenario.mission(),
                camera: Scenario::camera(),
                height: arguments.height.unwrap_or(scenario.height),
                plan: Some(plan),
            });
        }
        let Some(path) = &arguments.mission else {
            return Err("say --scenario NAME or --mission FILE".into());
        };
        let opened = OpenMission::read(path)?;
        let frame = LocalFrame::new(opened.package.mission.origin);
        let map = opened.map(arguments.map.as_deref(), frame, MAP_CACHE)?;
        let days: Box<dyn OtherDays> = if arguments.map.is_none() && opened.is_over_scenery() {
            let scenery = Scenario::map();
            Box::new(SceneryDays { scenery })
        } else {
            let map = Arc::clone(&map);
            Box::new(PictureDays::new(map))
        };
        let of_scenery = opened.is_over_scenery().then(Scenario::camera);
        let mission = opened.package.mission;
        let flown = match &arguments.flight {
            Some(path) => Some(read_flight(Arc::new(Directory::open(path)?))?.flight),
            None => None,
        };
        let camera = mission
            .camera
            .clone()
            .or_else(|| flown.map(|f| f.camera))
            .or(of_scenery)
            .ok_or("the mission states no camera; say --flight DIR to take that of a flight")?;
        let route = mission.routes.first();
        let targets = route.map_or_else(Vec::new, |route| targets(route, &mission, arguments));
        let height = arguments
            .height
            .or_else(|| Some(targets.first()?.height))
            .ok_or("neither the route nor --height says how high to fly")?;
        let plan = route.map(|route| FlightPlan {
            name: route.name.clone(),
            way_points: route.way_points.iter().map(|w| w.position).collect(),
            height,
            targets,
            camera: camera.clone(),
            sensors: SensorSpec::default(),
            frame_on_globe: frame,
            ..Scenario::all()[0].plan(&Overrides::default())
        });
        Ok(Self {
            map,
            days,
            mission,
            camera,
            height,
            plan,
        })
    }
}

/// Height above level ground and airspeed at each way-point; heights as the route states, or all at `--height`.
fn targets(route: &Route, mission: &Mission, arguments: &Source) -> Vec<Target> {
    let level = mission.level_ground();
    let height = |w: &WayPoint| {
        let counted = w.altitude.counted_from(AltitudeFrame::AboveGround, &level);
        arguments.height.unwrap_or(counted.metres).max(1.0)
    };
    let of = |w: &WayPoint| Target {
        height: height(w),
        airspeed: w.speed,
    };
    route.way_points.iter().map(of).collect()
}

/// Way-points as `--route` states them.
pub fn way_points(text: &str) -> Result<Vec<GroundPoint>, String> {
    text.split(';')
        .map(|pair| {
            let (north, east) = pair.split_once(',')?;
            let number = |t: &str| t.trim().parse().ok();
            Some(GroundPoint::new(number(north)?, number(east)?))
        })
        .collect::<Option<_>>()
        .ok_or_else(|| format!("--route: \"{text}\" is not NORTH,EAST;NORTH,EAST;…"))
}
