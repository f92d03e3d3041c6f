//! Found routes flown beside straight lines over generated counties: what a detour is worth.

use std::sync::Arc;

use nalgebra::Vector2;
use pilotage_core::flight::{Flight, FrameSource};
use pilotage_core::frames::GroundPoint;
use pilotage_core::frames::units::GRAVITY;
use pilotage_core::imagery::{CachedImagery, Imagery};
use pilotage_core::landmark::{Detector, TemplateDetector};
use pilotage_core::mission::Mission;
use pilotage_core::navigator::Navigator;
use pilotage_core::plan::{
    Aim, Assessor, BudgetOf, Circumstances, DetectionStatistics, ExpectedDetection, FieldBuilder,
    FieldView, FixSource, FoundRoute, FoundRoutes, Localizability, PlannedLandmark,
    PredictionRequest, Rehearsal, RoutePrediction, RouteQuestion, SceneryDays, Turns, as_stated,
    growth_before_first_fix,
};
use pilotage_core::simulate::scenery::Day;
use pilotage_core::simulate::{
    County, FlightDay, FlightPlan, GuidanceSettings, Overrides, Scenario, SimulatedFrames,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::threads::on_all_processors;

/// The scenario whose aircraft, camera and settings are flown; its wind is drawn anew for each flight.
const SCENARIO: &str = "distinct-400ft-wind";
/// Standard deviation of the position with which the field is computed, metres.
const POSITION: f64 = 15.0;
/// Side of a cell of the field, metres.
const STEP: f64 = 20.0;
/// Worlds of a prediction.
const WORLDS: usize = 32;
/// Memory for tiles of the county on either day, megabytes.
const CACHE: usize = 400;
/// Shortest and longest distance from A to B, metres.
const APART: (f64, f64) = (7000.0, 9500.0);
/// Least share of the straight line that is flown without a fix in one go.
const BLIND: f64 = 0.4;

/// Sight of the flights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RouteSight {
    /// Pictures of the county on another day, and the very detector.
    Pictures,
    /// No pictures: landmarks are found as often and as well as is expected of them.
    AsStated,
}

/// Results of one route.
#[derive(Clone, Debug, Default)]
pub struct FlownRoute {
    /// The route.
    pub route: FoundRoute,
    /// Largest predicted standard deviation of the longer axis, metres.
    pub predicted_worst: f64,
    /// Its mean along the route, metres.
    pub predicted_mean: f64,
    /// Duration of the plan in calm air with its turns, seconds.
    pub time: f64,
    /// Largest error of each flight, metres.
    pub largest: Vec<f64>,
    /// Root mean square error of all frames of all flights, metres.
    pub rms: f64,
}

impl FlownRoute {
    /// Largest error of all flights, metres.
    pub fn largest_of_all(&self) -> f64 {
        self.largest.iter().copied().fold(0.0, f64::max)
    }

    /// Median of the largest errors, metres.
    pub fn median_largest(&self) -> f64 {
        let mut sorted = self.largest.clone();
        sorted.sort_by(f64::total_cmp);
        sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
    }
}

/// A county, two places in it, and how one gets from one to the other.
pub struct Case {
    /// Seed of the county and of the places.
    pub seed: u64,
    mission: Mission,
    landmarks: Vec<PlannedLandmark>,
    map: Arc<dyn Imagery>,
    seen: Arc<CachedImagery>,
    scenario: Scenario,
    /// The straight line and the route that was found.
    pub found: FoundRoutes,
    /// Villages of the county.
    pub villages: usize,
}

/// Detection that is expected of each of the ten kinds of landmarks, measured in the village of the demo.
pub fn expectations() -> Result<Vec<(String, ExpectedDetection)>, String> {
    let scenario = Scenario::named(SCENARIO).ok_or("the scenario is gone")?;
    let mission = scenario.mission();
    let map: Arc<dyn Imagery> = Arc::new(CachedImagery::new(Arc::new(Scenario::map()), 64));
    let others = SceneryDays {
        scenery: Scenario::map(),
    };
    let days = Rehearsal::days(&others, 5);
    mission
        .landmarks
        .iter()
        .map(|landmark| {
            let circumstances = Circumstances {
                camera: Scenario::camera(),
                height: scenario.height,
                position: Rehearsal::POSITION,
                sensors: mission.navigator.sensors,
                detector: mission.navigator.detector,
                ground_down: 0.0,
                tilt: 0.0,
            };
            let map = Arc::clone(&map);
            let mut assessor = Assessor::new(landmark, map, &days, circumstances, 5);
            assessor.rehearse();
            let expected = assessor.expected().ok_or("a landmark cannot be seen")?;
            Ok((landmark.name.clone(), expected))
        })
        .collect()
}

/// Turns of the aircraft of the scenarios, with the wind behind it.
fn turns(scenario: &Scenario, wind: f64) -> Turns {
    let guidance = GuidanceSettings::default();
    let speed = scenario.plan(&Overrides::default()).airframe.cruise + wind;
    Turns {
        radius: speed * speed / (GRAVITY * guidance.planned_bank.tan()),
        roll_in: speed * guidance.roll_in,
    }
}

impl Case {
    /// Draws A and B until the straight line between them crosses blind ground, and finds a route for
    /// at most `budget` times the time.
    pub fn new(
        seed: u64,
        expected: &[(String, ExpectedDetection)],
        budget: f64,
    ) -> Result<Self, String> {
        let scenario = Scenario::named(SCENARIO).ok_or("the scenario is gone")?;
        let county = County::new(seed, Day::map_day());
        let villages = county.villages().len();
        let mut mission = scenario.mission();
        mission.landmarks = county.landmarks();
        let of = |name: &str| {
            let (_, known) = expected.iter().find(|(kind, _)| name.starts_with(kind))?;
            Some(DetectionStatistics::everywhere(*known))
        };
        let landmarks: Vec<PlannedLandmark> = mission
            .landmarks
            .iter()
            .map(|landmark| PlannedLandmark {
                detection: of(&landmark.name).unwrap_or_default(),
                landmark: landmark.clone(),
            })
            .collect();
        let view = FieldView {
            camera: Scenario::camera(),
            height: scenario.height,
            position: POSITION,
            tilt: mission.navigator.sensors.roll,
        };
        let sources = landmarks
            .iter()
            .filter_map(|l| FixSource::of(l, scenario.height))
            .collect();
        let mut builder = FieldBuilder::new(view.clone(), &county.bounds(), STEP, sources);
        while builder.advance() {}
        let field = Arc::new(builder.into_field());
        let pass = view.across().ok_or("the camera does not see the ground")?;
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let bounds = county.bounds().grown(-700.0);
        let mut place = || {
            GroundPoint::new(
                bounds.south + bounds.height() * random.random::<f64>(),
                bounds.west + bounds.width() * random.random::<f64>(),
            )
        };
        // One takes off where there is something to see; where one goes there may be nothing.
        let homes: Vec<GroundPoint> = mission.landmarks.iter().map(|l| l.reference).collect();
        for _ in 0..10_000 {
            let to = place();
            let from = homes[(to.north.abs() * 1e3) as usize % homes.len()];
            if !(APART.0..APART.1).contains(&from.distance(&to)) {
                continue;
            }
            let mut question = question(from, to, &field, pass, &scenario, budget);
            question.before_first_fix = growth_before_first_fix(&mission.navigator);
            let straight = question.judge(&[from, to]).ok_or("nothing is forbidden")?;
            if straight.worst_blind < BLIND * straight.length {
                continue;
            }
            // Blind is what one gets lost over: further off than the picture is wide.
            let line = flight_plan(&scenario, seed, &[from, to]);
            if worst(&predict(&mission, &landmarks, &line)?) < pass {
                continue;
            }
            let found = question.find().map_err(|e| e.to_string())?;
            let other = Arc::new(County::new(seed, Day::other_day()));
            return Ok(Self {
                seed,
                mission,
                landmarks,
                map: Arc::new(CachedImagery::new(Arc::new(county), CACHE)),
                seen: Arc::new(CachedImagery::new(other, CACHE)),
                scenario,
                found,
                villages,
            });
        }
        Err(format!("county {seed} has no blind ground"))
    }

    /// Predicts a route and flies it with every seed below `flights`, each in a wind of its own, over
    /// what is seen.
    pub fn fly(
        &self,
        route: &FoundRoute,
        flights: u64,
        seen: RouteSight,
    ) -> Result<FlownRoute, String> {
        let plan = flight_plan(&self.scenario, self.seed, &route.way_points);
        let prediction = predict(&self.mission, &self.landmarks, &plan)?;
        let samples = &prediction.samples;
        let sigmas = || samples.iter().map(|s| s.corridor.sigma_major);
        let errors = on_all_processors(0..flights, |seed| self.errors(&plan, seed, seen));
        let errors = errors.into_iter().collect::<Result<Vec<_>, String>>()?;
        let all = || errors.iter().flatten();
        Ok(FlownRoute {
            route: route.clone(),
            predicted_worst: worst(&prediction),
            predicted_mean: sigmas().sum::<f64>() / samples.len().max(1) as f64,
            time: samples.last().map_or(0.0, |s| s.time),
            largest: errors
                .iter()
                .map(|flight| flight.iter().copied().fold(0.0, f64::max))
                .collect(),
            rms: (all().map(|e| e * e).sum::<f64>() / all().count().max(1) as f64).sqrt(),
        })
    }

    /// Error after every step of one flight, metres.
    fn errors(&self, plan: &FlightPlan, seed: u64, seen: RouteSight) -> Result<Vec<f64>, String> {
        let named = |e: &dyn std::fmt::Display| format!("county {}, seed {seed}: {e}", self.seed);
        let settings = &self.mission.navigator;
        let flight = plan
            .in_wind_of(seed, settings.start.wind)
            .simulate(seed)
            .ok_or_else(|| named(&"the route needs two way-points"))?;
        let landmarks = &self.mission.landmarks;
        let (detector, mut frames): (Box<dyn Detector>, Box<dyn FrameSource>) = match seen {
            RouteSight::Pictures => {
                let map = Arc::clone(&self.map);
                let detector = TemplateDetector::new(map, settings.detector);
                let frames = SimulatedFrames::new(&flight, FlightDay::Other, seed);
                (
                    Box::new(detector),
                    Box::new(frames.over(Arc::clone(&self.seen))),
                )
            }
            RouteSight::AsStated => {
                let stated = as_stated(&flight, &self.landmarks, seed);
                let (detector, frames) = stated.ok_or_else(|| named(&"there is no truth"))?;
                (Box::new(detector), Box::new(frames))
            }
        };
        let flight = Arc::new(flight);
        let mut navigator =
            Navigator::with_detector(Arc::clone(&flight), landmarks, detector, settings)
                .map_err(|e| named(&e))?
                .sparing();
        let mut errors = Vec::new();
        while let Some(step) = navigator.advance(frames.as_mut(), &|| 0.0) {
            let step = step.map_err(|e| named(&e))?;
            errors.extend(error(&flight, step.time, &step.after.position()));
        }
        Ok(errors)
    }
}

fn flight_plan(scenario: &Scenario, seed: u64, way_points: &[GroundPoint]) -> FlightPlan {
    FlightPlan {
        name: format!("county {seed}"),
        way_points: way_points.to_vec(),
        wind: Vector2::zeros(),
        longest: 3600.0,
        ..scenario.plan(&Overrides::default())
    }
}

fn predict(
    mission: &Mission,
    landmarks: &[PlannedLandmark],
    plan: &FlightPlan,
) -> Result<RoutePrediction, String> {
    let request = PredictionRequest {
        plan,
        settings: &mission.navigator,
        landmarks,
        wind_deviation: mission.navigator.start.wind,
        worlds: WORLDS,
        seed: 1,
        limit: f64::INFINITY,
    };
    request.predict().map_err(|e| e.to_string())
}

/// Largest standard deviation of the longer axis, metres.
fn worst(prediction: &RoutePrediction) -> f64 {
    let sigmas = prediction.samples.iter();
    sigmas.map(|s| s.corridor.sigma_major).fold(0.0, f64::max)
}

fn error(flight: &Flight, time: f64, estimate: &GroundPoint) -> Option<f64> {
    let truth = flight.truth.as_ref()?.position(time)?;
    Some((estimate.north - truth.x).hypot(estimate.east - truth.y))
}

fn question(
    from: GroundPoint,
    to: GroundPoint,
    field: &Arc<Localizability>,
    pass: f64,
    scenario: &Scenario,
    budget: f64,
) -> RouteQuestion {
    RouteQuestion {
        from,
        to,
        field: Arc::clone(field),
        pass,
        no_fly: Vec::new(),
        clearance: 0.0,
        forbidden: None,
        airspeed: scenario.plan(&Overrides::default()).airframe.cruise,
        wind: Vector2::zeros(),
        before_first_fix: 1.0,
        turns: turns(scenario, 0.0),
        budget,
        budget_of: BudgetOf::Time,
        aim: Aim::Worst,
    }
}
