//! Ground of a plan: a map, a mission on it, an aircraft.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pilotage_core::camera::CameraModel;
use pilotage_core::frames::{
    Altitude, AltitudeFrame, Geodetic, GroundPoint, GroundRect, LocalFrame,
};
use pilotage_core::imagery::terrain::{HeightGrid, Terrain as _};
use pilotage_core::imagery::{CachedImagery, Imagery};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::{Mission, Route, WayPoint};
use pilotage_core::plan::{FlownWay, Proposal, RouteGround, planned_aircraft, take_off_place};
use pilotage_core::simulate::{Scenario, Wind};
use pilotage_jobs::{
    AssessmentOrder, FlightSource, HeightsOrder, JobEvent, MapSource, PlanCircumstances,
    PlannedPath, PredictionOrder,
};

use crate::files::DirectoryFiles;
use crate::maps::MAP_CACHE;
use crate::mission_file::OpenMission;
use crate::replaying::flight_at;
use crate::workers::{KEY, Lent, do_here};

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
    /// Height above ground, metres, in place of those of the route or scenario.
    pub height: Option<f64>,
    /// An elevation model of the ground; level where it says nothing.
    pub dem: Option<PathBuf>,
}

/// Refuses a stated height that is not above the ground.
///
/// ```
/// use pilotage_disk::planned_flight::above_ground;
///
/// assert!(above_ground(Some(120.0)).is_ok() && above_ground(None).is_ok());
/// assert!(above_ground(Some(-50.0)).is_err() && above_ground(Some(f64::NAN)).is_err());
/// ```
///
/// # Errors
/// The height, and what to give.
pub fn above_ground(height: Option<f64>) -> Result<(), String> {
    match height.filter(|metres| !(metres.is_finite() && *metres > 0.0)) {
        Some(metres) => Err(format!(
            "height: {metres} m is not above the ground; give metres above zero"
        )),
        None => Ok(()),
    }
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
    /// Mean height above ground, metres.
    pub height: f64,
    /// Altitude of the first way-point.
    pub altitude: Altitude,
    /// Heights of the ground, where an elevation model is open.
    pub heights: Option<HeightGrid>,
    /// Height of the ground elsewhere, metres above mean sea level.
    level: f64,
    /// Down coordinate of the ground plane, metres.
    pub ground_down: f64,
    /// Sentences on what was assumed of its files or left out.
    pub notes: Vec<String>,
    /// Files of the disk that it was read from: the mission, the map and what says where that lies, the flight whose camera is
    /// flown. The elevation model is not among them.
    pub read: Vec<PathBuf>,
    /// Pictures a second, where they are fewer than usual.
    frame_rate: Option<f64>,
    /// Way of the planned flight.
    pub way: FlownWay,
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
        above_ground(arguments.height)?;
        if let Some(name) = &arguments.scenario {
            return Self::of_scenario(name, arguments.height);
        }
        let Some(path) = &arguments.mission else {
            return Err("say --scenario NAME or --mission FILE".into());
        };
        let opened = OpenMission::read(path)?;
        let frame = LocalFrame::new(opened.package.mission.origin);
        let (source, map) = opened.map(arguments.map.as_deref(), frame, MAP_CACHE)?;
        let mut notes = map.notes;
        let mut read = vec![path.clone()];
        read.extend(map.read);
        let map = map.map;
        let beside = opened.simulation().map(FlightSource::Simulated);
        let beside = beside.unwrap_or(FlightSource::Nothing);
        let mission = opened.package.mission;
        let flown = match &arguments.flight {
            Some(path) => {
                let flown = flight_at(path, None, None)?;
                read.extend(flown.read);
                Some(flown.open.flight)
            }
            None => None,
        };
        let ground_down = flown.as_ref().map_or(0.0, |flight| flight.ground_down);
        let frame_rate = flown.as_ref().and_then(|it| PlannedPath::frame_rate_of(it));
        let frame_rate = PlannedPath::sparse(frame_rate);
        if let Some(rate) = frame_rate {
            notes.push(format!(
                "a picture every {:.1} s, as on the flight",
                1.0 / rate
            ));
        }
        let stated = mission.camera.clone();
        let stated = stated.or_else(|| Some(flown?.camera.clone()));
        if stated.is_none() && !matches!(source, MapSource::World(_)) {
            notes.push(
                "the mission states no camera: that of the built-in scenarios is taken; --flight PATH takes that of a flight"
                    .to_owned(),
            );
        }
        let camera = stated.unwrap_or_else(Scenario::camera);
        let route = match route {
            Some(name) => Some(mission.route_named(name)?),
            None => mission.routes.first(),
        };
        let mut route = route.cloned();
        if let (Some(route), Some(metres)) = (&mut route, arguments.height) {
            let stated = Altitude::new(metres, AltitudeFrame::AboveGround);
            let all = route.way_points.iter_mut();
            all.for_each(|way_point| way_point.altitude = stated);
        }
        let heights = match &arguments.dem {
            Some(path) => {
                let area = HeightsOrder::of_interest(Some(map.bounds()), &mission);
                let area = area.ok_or("the map is too large for heights and nothing is planned")?;
                Some(heights_of(path, frame.origin, area, &mut notes)?)
            }
            None => None,
        };
        let level = mission.level_ground_under(ground_down);
        let mut ground = Self {
            map,
            source,
            mission,
            camera,
            height: 0.0,
            altitude: Altitude::new(0.0, AltitudeFrame::AboveGround),
            heights,
            level,
            ground_down,
            notes,
            read,
            frame_rate,
            way: FlownWay::default(),
            plan: None,
        };
        let flown = route.as_ref().filter(|route| !route.way_points.is_empty());
        ground.height = flown
            .and_then(|route| ground.mean_above(route))
            .or(arguments.height)
            .unwrap_or(beside.usual_altitude().metres);
        let usual = Altitude::new(ground.height, AltitudeFrame::AboveGround);
        ground.altitude = flown.map_or(usual, |route| route.way_points[0].altitude);
        if let Some(route) = &route {
            ground.plan = Some(ground.planned(beside.wind().unwrap_or_default()));
            ground.fly_along(route);
        }
        Ok(ground)
    }

    /// Plans to fly along a route.
    pub fn fly_along(&mut self, route: &Route) {
        let frame = LocalFrame::new(self.mission.origin);
        let bank = planned_aircraft().bank_limit;
        let way = self.over(route, |ground| FlownWay::along(route, &frame, ground, bank));
        let height = self.mean_above(route).unwrap_or(self.height);
        self.follow(way, height);
    }

    fn follow(&mut self, way: FlownWay, height: f64) {
        if let Some(plan) = &mut self.plan {
            plan.path.way_points.clone_from(&way.places);
            plan.path.targets.clone_from(&way.targets);
            plan.path.height = height;
        }
        self.way = way;
    }

    /// A route over places at the altitude of the first way-point.
    pub fn at_its_altitude(&self, places: &[GroundPoint]) -> Route {
        let way_points = places.iter().map(|at| WayPoint::new(*at, self.altitude));
        Route {
            way_points: way_points.collect(),
            ..Route::default()
        }
    }

    fn of_scenario(name: &str, height: Option<f64>) -> Result<Self, Box<dyn std::error::Error>> {
        let scenario = Scenario::named(name)
            .ok_or_else(|| format!("there is no scenario \"{name}\"; see pilotage scenarios"))?;
        let mission = scenario.mission();
        let height = height.unwrap_or(scenario.height);
        let mut ground = Self {
            map: Arc::new(CachedImagery::new(Arc::new(Scenario::map()), MAP_CACHE)),
            source: MapSource::world("countryside"),
            level: mission.level_ground_under(0.0),
            mission,
            camera: Scenario::camera(),
            height,
            altitude: Altitude::new(height, AltitudeFrame::AboveGround),
            heights: None,
            ground_down: 0.0,
            notes: Vec::new(),
            read: Vec::new(),
            frame_rate: None,
            way: FlownWay::default(),
            plan: None,
        };
        let way = FlownWay {
            towards: (0..scenario.route.len()).collect(),
            places: scenario.route.clone(),
            targets: Vec::new(),
        };
        ground.plan = Some(ground.planned(scenario.wind));
        ground.follow(way, height);
        Ok(ground)
    }

    /// Plan in that wind, whose way is yet to be followed.
    fn planned(&self, wind: Wind) -> PredictionOrder {
        let path = PlannedPath {
            wind,
            ground_down: self.ground_down,
            frame_rate: self.frame_rate,
            ..PlannedPath::level(Vec::new(), self.height, self.camera.clone())
        };
        PredictionOrder::along(path, &self.mission)
    }

    /// Height of the ground at a place, metres.
    pub fn height_at(&self, place: &GroundPoint) -> f64 {
        let known = self.heights.as_ref().and_then(|it| it.height_at(place));
        known.unwrap_or(self.level)
    }

    /// Says of the ground under a route what is asked.
    fn over<T>(&self, route: &Route, ask: impl FnOnce(&RouteGround<'_>) -> T) -> T {
        let frame = LocalFrame::new(self.mission.origin);
        let known = |place: &GroundPoint| self.heights.as_ref()?.height_at(place);
        let take_off = take_off_place(route, &frame, |place| known(place).is_some());
        ask(&RouteGround {
            height_at: &|place| self.height_at(place),
            take_off: take_off.map_or(self.level, |place| self.height_at(&place)),
            is_level: self.heights.is_none(),
        })
    }

    /// Mean height of a route above the ground below it, metres; `None` without way-points.
    pub fn mean_above(&self, route: &Route) -> Option<f64> {
        self.over(route, |ground| ground.mean_above(route))
    }

    /// Circumstances with which its orders are made, where the position is known to `position` metres per axis.
    pub fn circumstances(&self, position: f64) -> PlanCircumstances {
        PlanCircumstances {
            map: self.source.clone(),
            camera: self.camera.clone(),
            height: self.height,
            ground_down: self.ground_down,
            navigator: self.mission.navigator.clone(),
            position,
        }
    }

    /// Order to measure a landmark, on the days of the page or those of `seed`.
    pub fn assessment(&self, landmark: &Landmark, seed: Option<u64>) -> AssessmentOrder {
        let usual = self.circumstances(Proposal::POSITION).assessment(landmark);
        AssessmentOrder {
            seed: seed.unwrap_or(usual.seed),
            ..usual
        }
    }

    /// Its map, for the workers.
    pub fn lent(&self) -> Lent {
        Lent::default().with_map(self.source.clone(), Arc::clone(&self.map))
    }
}

/// Heights of an elevation model over `area`, as the page takes them.
fn heights_of(
    path: &Path,
    origin: Geodetic,
    area: GroundRect,
    notes: &mut Vec<String>,
) -> Result<HeightGrid, Box<dyn std::error::Error>> {
    let name = path.file_name().unwrap_or(path.as_os_str());
    let order = HeightsOrder {
        key: KEY.to_owned(),
        origin,
        area,
        file: Some(name.to_string_lossy().into_owned()),
    };
    let lent = Lent::default().with_files(KEY, Arc::new(DirectoryFiles::around(path)?));
    let mut heights = None;
    do_here(order, &mut lent.worker(), &mut |event| {
        match event {
            JobEvent::Failed(why) => return Err(why),
            JobEvent::Remark(note) => notes.push(note),
            JobEvent::Heights(grid) => heights = Some(*grid),
            _ => {}
        }
        Ok(())
    })?;
    Ok(heights.ok_or("the elevation model told no heights")?)
}

#[cfg(test)]
#[path = "planned_flight_tests.rs"]
mod tests;
