//! Ground of a plan: a map, a mission on it, an aircraft.

use std::path::PathBuf;
use std::sync::Arc;

use pilotage_core::camera::CameraModel;
use pilotage_core::flight::read_flight;
use pilotage_core::frames::{AltitudeFrame, GroundPoint, LocalFrame};
use pilotage_core::imagery::{CachedImagery, Imagery};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::{Mission, Route, WayPoint};
use pilotage_core::simulate::{Airframe, Scenario, Target, Wind};
use pilotage_jobs::{AssessmentOrder, MapSource, PlannedPath, PredictionOrder};

use crate::files::{DirectoryFiles, MAP_CACHE};
use crate::mission_file::OpenMission;
use crate::workers::Lent;

/// Source of the map, the mission on it and the camera.
#[derive(Clone, Debug, Default)]
pub struct PlanSource {
    /// A built-in scenario: its map, aircraft, camera and route.
    pub scenario: Option<String>,
    /// A mission file (zip or GeoJSON); its first route is flown.
    pub mission: Option<PathBuf>,
    /// The map of the mission, if the file does not hold it.
    pub map: Option<PathBuf>,
    /// A flight folder whose camera is flown, if the mission states none.
    pub flight: Option<PathBuf>,
    /// Height above ground, metres, where neither route nor scenario states one.
    pub height: Option<f64>,
}

/// The map, the mission on it and how it is flown.
pub struct PlannedFlight {
    /// The map.
    pub map: Arc<dyn Imagery>,
    /// The source by which orders name the map.
    pub source: MapSource,
    /// The mission on it.
    pub mission: Mission,
    /// The camera that is flown.
    pub camera: CameraModel,
    /// Height above ground, metres.
    pub height: f64,
    /// The planned flight, of whose landmarks nothing is expected yet.
    pub plan: Option<PredictionOrder>,
}

impl PlannedFlight {
    /// Opens the ground that a source names, to be flown along the first route of its mission.
    ///
    /// ```
    /// use pilotage_disk::planned_flight::{PlanSource, PlannedFlight};
    ///
    /// let scenario = Some("distinct-400ft-calm".to_owned());
    /// let ground = PlannedFlight::at(&PlanSource { scenario, ..PlanSource::default() })?;
    /// assert!((ground.height - 400.0 * 0.3048).abs() < 0.5);
    /// assert!(ground.plan.is_some_and(|plan| plan.landmarks.is_empty()));
    /// let scenario = Some("to the moon".to_owned());
    /// assert!(PlannedFlight::at(&PlanSource { scenario, ..PlanSource::default() }).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn at(arguments: &PlanSource) -> Result<Self, Box<dyn std::error::Error>> {
        Self::along(arguments, None)
    }

    /// Opens the ground that a source names, to be flown along the route of that name, or else the first.
    pub fn along(
        arguments: &PlanSource,
        route: Option<&str>,
    ) -> Result<Self, Box<dyn std::error::Error>> {
        if let Some(name) = &arguments.scenario {
            let scenario = Scenario::named(name).ok_or_else(|| {
                format!("there is no scenario \"{name}\"; see pilotage scenarios")
            })?;
            let ground = Self {
                map: Arc::new(CachedImagery::new(Arc::new(Scenario::map()), MAP_CACHE)),
                source: MapSource::world("countryside"),
                mission: scenario.mission(),
                camera: Scenario::camera(),
                height: arguments.height.unwrap_or(scenario.height),
                plan: None,
            };
            let plan = ground.planned(scenario.route.clone(), Vec::new(), scenario.wind);
            return Ok(Self {
                plan: Some(plan),
                ..ground
            });
        }
        let Some(path) = &arguments.mission else {
            return Err("say --scenario NAME or --mission FILE".into());
        };
        let opened = OpenMission::read(path)?;
        let frame = LocalFrame::new(opened.package.mission.origin);
        let map = opened.map(arguments.map.as_deref(), frame, MAP_CACHE)?;
        let source = if arguments.map.is_none() && opened.is_over_scenery() {
            MapSource::world("countryside")
        } else {
            Lent::map_of_file()
        };
        let of_scenery = opened.is_over_scenery().then(Scenario::camera);
        let mission = opened.package.mission;
        let flown = match &arguments.flight {
            Some(path) => Some(read_flight(Arc::new(DirectoryFiles::open(path)?))?.flight),
            None => None,
        };
        let camera = mission
            .camera
            .clone()
            .or_else(|| flown.map(|f| f.camera))
            .or(of_scenery)
            .ok_or("the mission states no camera; say --flight DIR to take that of a flight")?;
        let route = match route {
            Some(name) => Some(route_named(&mission, name)?),
            None => mission.routes.first(),
        };
        let route = route.cloned();
        let targets = route
            .as_ref()
            .map_or_else(Vec::new, |route| targets(route, &mission, arguments));
        let height = arguments
            .height
            .or_else(|| Some(targets.first()?.height))
            .ok_or("neither the route nor --height says how high to fly")?;
        let ground = Self {
            map,
            source,
            mission,
            camera,
            height,
            plan: None,
        };
        let plan = route.map(|route| {
            let way_points = route.way_points.iter().map(|w| w.position).collect();
            ground.planned(way_points, targets, Scenario::all()[0].wind)
        });
        Ok(Self { plan, ..ground })
    }

    fn planned(
        &self,
        way_points: Vec<GroundPoint>,
        targets: Vec<Target>,
        wind: Wind,
    ) -> PredictionOrder {
        PredictionOrder {
            path: PlannedPath {
                way_points,
                height: self.height,
                targets,
                airspeed: None,
                bank: None,
                wind,
                camera: self.camera.clone(),
                ground_down: 0.0,
            },
            navigator: self.mission.navigator.clone(),
            landmarks: Vec::new(),
            worlds: 0,
            seed: PredictionOrder::SEED,
            limit: f64::INFINITY,
        }
    }

    /// Airspeed that is flown, m/s.
    pub fn cruise() -> f64 {
        Airframe::sig_kadet_senior().cruise
    }

    /// Down coordinate of the ground plane, metres.
    pub fn ground_down(&self) -> f64 {
        self.plan.as_ref().map_or(0.0, |plan| plan.path.ground_down)
    }

    /// Order to measure a landmark.
    pub fn assessment(&self, landmark: &Landmark, seed: u64) -> AssessmentOrder {
        AssessmentOrder {
            map: self.source.clone(),
            landmark: landmark.clone(),
            camera: self.camera.clone(),
            height: self.height,
            navigator: self.mission.navigator.clone(),
            ground_down: self.ground_down(),
            seed,
        }
    }

    /// Its map, for the workers.
    pub fn lent(&self) -> Lent {
        Lent::default().with_map(self.source.clone(), Arc::clone(&self.map))
    }
}

fn route_named<'a>(mission: &'a Mission, name: &str) -> Result<&'a Route, String> {
    let routes = &mission.routes;
    let found = routes.iter().find(|route| route.name == name);
    found.ok_or_else(|| {
        let names: Vec<String> = routes.iter().map(|r| format!("\"{}\"", r.name)).collect();
        let names = match &names[..] {
            [] => "none at all".to_owned(),
            names => names.join(", "),
        };
        format!("the mission has no route \"{name}\"; it has: {names}")
    })
}

/// Height above level ground and airspeed at each way-point; heights as the route states, or all at `--height`.
fn targets(route: &Route, mission: &Mission, arguments: &PlanSource) -> Vec<Target> {
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
