//! What the Plan workspace remembers beside the documents.

use pilotage_core::camera::CameraModel;
use pilotage_core::frames::{Altitude, AltitudeFrame, GroundPoint, GroundRect, LocalFrame};
use pilotage_core::mission::turn::turn_radius;
use pilotage_core::mission::{Mission, Route, WayPoint};
use pilotage_core::simulate::{Airframe, Scenario, SimulationChoice, Target, Wind};
use pilotage_core::training::TrainingPlan;
use serde::{Deserialize, Serialize};

use super::assessments::Assessments;
use super::chart::Chart;
use super::finder::{FindPreferences, Finder};
use super::forecast::Forecast;
use super::heat::{Heat, HeatPreferences};
use super::landmark_editor::LandmarkEditor;
use super::landmark_table::LandmarkTable;
use super::marking::Marking;
use super::patterns::Circumstances;
use super::profile::{Sample, on_leg, profile};
use super::remedy::Remedies;
use super::routes::route_of;
use super::suggestions::Suggestions;
use super::trainings::Trainings;
use crate::documents::Documents;
use crate::jobs::{FlightSource, PredictionOrder, scenario_wind};

/// Height of a first way-point where no flight says another, metres above ground.
const USUAL_HEIGHT: f64 = 120.0;

/// Where the ground lets the height change otherwise than evenly, a leg is predicted in pieces: from so
/// many metres off on, and none shorter than that many, so that turns have room before they begin.
const UNEVEN: f64 = 4.0;
const SHORTEST_PIECE: f64 = 200.0;
/// Places at which a piece is looked at.
const BENDS: u32 = 20;

/// What the user accepts and assumes; remembered between visits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct PlanPreferences {
    /// Standard deviation of the position that is accepted, metres.
    pub limit: f64,
    /// The wind to plan with; the flight's if `None`.
    pub wind: Option<Wind>,
    /// How the heat map is shown.
    pub heat: HeatPreferences,
    /// What is looked for when a route is found.
    pub find: FindPreferences,
    /// How many landmarks are proposed.
    pub suggest: usize,
    /// How many photos a detector learns from.
    pub photos: usize,
    /// Bank limit, radians.
    pub bank: f64,
    /// Power in cruise, watts, if the user states it.
    pub power: Option<f64>,
    /// Energy on board, watt hours, if the user states it.
    pub energy: Option<f64>,
    /// Whether the heights of the route are shown below the map.
    pub profile: bool,
}

impl Default for PlanPreferences {
    fn default() -> Self {
        Self {
            limit: 10.0,
            wind: None,
            heat: HeatPreferences::default(),
            find: FindPreferences::default(),
            suggest: 6,
            photos: TrainingPlan::default().photos,
            bank: Airframe::sig_kadet_senior().bank_limit,
            power: None,
            energy: None,
            profile: false,
        }
    }
}

/// What the column at the right shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PlanTab {
    /// Routes, legs and prediction.
    #[default]
    Route,
    /// Landmarks and how well they are found.
    Landmarks,
    /// Where fixes would be had, no-fly areas, and finding a route.
    Ground,
}

/// The state of the Plan workspace.
#[derive(Default)]
pub struct Planner {
    /// The selected route.
    pub route: Option<u32>,
    /// The selected way-point of it.
    pub way_point: Option<usize>,
    /// Whether clicks on the map add way-points.
    pub drawing: bool,
    /// What is being marked on the map by clicks.
    pub marking: Option<Marking>,
    /// The open tab.
    pub tab: PlanTab,
    /// What the user accepts and assumes.
    pub preferences: PlanPreferences,
    /// Distance along the flown path under the pointer in the chart, metres.
    pub hovered: Option<f64>,
    /// The prediction.
    pub forecast: Forecast,
    /// What would mend its worst stretch.
    pub remedies: Remedies,
    /// How well landmarks are found.
    pub assessments: Assessments,
    /// Detectors that are trained.
    pub trainings: Trainings,
    /// Landmarks that are proposed.
    pub suggestions: Suggestions,
    /// Where fixes would be had.
    pub heat: Heat,
    /// The search for a route.
    pub finder: Finder,
    /// The chart.
    pub(super) chart: Chart,
    /// The table of landmarks.
    pub(super) table: LandmarkTable,
    /// What is being typed of landmarks.
    pub(super) editor: LandmarkEditor,
    /// The name being typed for the selected route.
    pub(super) name_draft: Option<(u32, String)>,
    /// The name being typed for a no-fly area, by its number.
    pub(super) area_draft: Option<(usize, String)>,
    /// Whether the map was fitted to the plan.
    pub fitted: bool,
}

impl Planner {
    /// Lets go of what does not exist any more, and selects the first route if none is.
    pub fn settle(&mut self, mission: &Mission) {
        let known = self.route.filter(|id| route_of(mission, *id).is_some());
        let first = || mission.routes.first().map(|r| r.id);
        self.route = if self.drawing {
            known
        } else {
            known.or_else(first)
        };
        self.table.settle(mission);
        let count = self.selected(mission).map_or(0, |r| r.way_points.len());
        self.way_point = self.way_point.filter(|i| *i < count);
    }

    /// Where the chart's curves were drawn last.
    pub fn chart_rect(&self) -> Option<egui::Rect> {
        self.chart.rect()
    }

    /// The landmarks that are marked in the table, or else the selected one.
    pub fn marked(&self, selection: Option<u32>) -> Vec<u32> {
        let marked: Vec<u32> = self.table.marked().iter().copied().collect();
        if marked.len() > 1 {
            marked
        } else {
            selection.into_iter().collect()
        }
    }

    /// Marks landmarks in the table, and no others.
    pub fn mark(&mut self, ids: Vec<u32>) {
        self.table.mark(ids);
    }

    /// The selected route.
    pub fn selected<'m>(&self, mission: &'m Mission) -> Option<&'m Route> {
        route_of(mission, self.route?)
    }

    /// The wind that is planned with.
    pub fn wind(&self, documents: &Documents) -> Wind {
        self.preferences
            .wind
            .unwrap_or_else(|| flight_wind(documents))
    }

    /// What to predict for the selected route; `None` while it is none that can be flown.
    pub fn order(&self, documents: &Documents) -> Option<PredictionOrder> {
        let mission = &documents.mission;
        let route = self.selected(mission)?;
        if route.length() < 1.0 {
            return None;
        }
        let camera = camera(documents);
        let (way_points, targets) = flown_over(route, documents);
        Some(PredictionOrder {
            way_points,
            height: height(route, documents),
            targets,
            airspeed: None,
            bank: Some(self.preferences.bank),
            wind: self.wind(documents),
            camera,
            ground_down: ground_down(documents),
            navigator: mission.navigator.clone(),
            landmarks: mission
                .landmarks
                .iter()
                .filter(|l| l.enabled)
                .map(|l| (l.clone(), self.assessments.expected(l)))
                .collect(),
            worlds: 0,
        })
    }
}

/// Airspeed in cruise of the aircraft that is planned for, m/s.
pub fn cruise() -> f64 {
    Airframe::sig_kadet_senior().cruise
}

/// The mean wind of the open flight.
pub fn flight_wind(documents: &Documents) -> Wind {
    match &documents.flight_source {
        FlightSource::Simulated(options) => scenario_wind(options),
        FlightSource::Files(_) | FlightSource::Nothing => Wind::default(),
    }
}

/// The camera that is planned with.
pub fn camera(documents: &Documents) -> CameraModel {
    let flown = documents.flight.as_ref().map(|f| f.camera.clone());
    documents
        .mission
        .camera
        .clone()
        .or(flown)
        .unwrap_or_else(Scenario::camera)
}

/// Down coordinate of the ground plane, metres.
pub fn ground_down(documents: &Documents) -> f64 {
    documents.flight.as_ref().map_or(0.0, |f| f.ground_down)
}

/// What the passes of a pattern over `places` are made for, if they are flown at `altitude`.
pub fn circumstances(
    planner: &Planner,
    documents: &Documents,
    altitude: Altitude,
    places: &[GroundPoint],
) -> Circumstances {
    Circumstances {
        frame: LocalFrame::new(documents.mission.origin),
        camera: camera(documents),
        height: height(&line(places, altitude), documents),
        radius: turn_radius(cruise(), planner.preferences.bank),
    }
}

/// What the passes of a pattern are made for, if a route is made of it.
pub fn made_for(planner: &Planner, documents: &Documents, route: Option<&Route>) -> Circumstances {
    let way_points = route.map_or(&[][..], |r| &r.way_points);
    let first = way_points.first().map(|w| w.altitude);
    let altitude = first.unwrap_or_else(|| usual_altitude(documents));
    let places: Vec<GroundPoint> = way_points.iter().map(|w| w.position).collect();
    circumstances(planner, documents, altitude, &places)
}

/// A route over places, all at one altitude.
pub fn line(places: &[GroundPoint], altitude: Altitude) -> Route {
    let way_points = places.iter().map(|p| WayPoint::new(*p, altitude));
    Route {
        way_points: way_points.collect(),
        ..Route::default()
    }
}

/// Mean height of a route above the ground below it, metres.
pub fn height(route: &Route, documents: &Documents) -> f64 {
    let relief = documents.relief();
    let samples = profile(route, &|p| relief.at(p), relief.take_off(route));
    let (mut sum, mut length) = (0.0, 0.0);
    for pair in samples.windows(2) {
        let step = pair[1].distance - pair[0].distance;
        sum += step * 0.5 * (pair[0].above() + pair[1].above());
        length += step;
    }
    let first = || route.way_points.first().map(|w| relief.above(route, w));
    let mean = (length > 0.0).then(|| sum / length).or_else(first);
    mean.unwrap_or(USUAL_HEIGHT).max(1.0)
}

/// Where a route is flown and how: its way-points with their heights above ground, metres, and
/// airspeeds, and between them places from which on the ground lets the height change otherwise.
fn flown_over(route: &Route, documents: &Documents) -> (Vec<GroundPoint>, Vec<Target>) {
    let relief = documents.relief();
    let ground = |p: &GroundPoint| relief.at(p);
    let take_off = relief.take_off(route);
    let (mut places, mut targets) = (Vec::new(), Vec::new());
    let mut add = |sample: &Sample, airspeed| {
        places.push(sample.place);
        targets.push(Target {
            height: sample.above().max(1.0),
            airspeed,
        });
    };
    for (index, way_point) in route.way_points.iter().enumerate() {
        let before = index.checked_sub(1).map(|i| &route.way_points[i]);
        let leg = on_leg((before.unwrap_or(way_point), way_point), &ground, take_off);
        if let Some(before) = before.filter(|_| !relief.is_level()) {
            let length = before.position.distance(&way_point.position);
            let mut bends = Vec::new();
            let above = |share: f64| leg(share).above();
            bend(&above, (0.0, 1.0), SHORTEST_PIECE / length, &mut bends);
            for share in bends {
                add(&leg(share), way_point.speed);
            }
        }
        add(&leg(1.0), way_point.speed);
    }
    (places, targets)
}

/// Shares of a leg between `a` and `b` at which its height above ground stops to change evenly, no two
/// closer than `least`.
fn bend(above: &dyn Fn(f64) -> f64, (a, b): (f64, f64), least: f64, bends: &mut Vec<f64>) {
    let (from, to) = (above(a), above(b));
    let off = |s: f64| (above(s) - from - (s - a) / (b - a) * (to - from)).abs();
    let inner = (1..BENDS).map(|i| a + (b - a) * f64::from(i) / f64::from(BENDS));
    let worst = inner
        .filter(|s| s - a >= least && b - s >= least)
        .map(|s| (s, off(s)))
        .max_by(|x, y| x.1.total_cmp(&y.1));
    if let Some((at, _)) = worst.filter(|(_, off)| *off > UNEVEN) {
        bend(above, (a, at), least, bends);
        bends.push(at);
        bend(above, (at, b), least, bends);
    }
}

/// The altitude of a first way-point.
pub fn usual_altitude(documents: &Documents) -> Altitude {
    let flown = match &documents.flight_source {
        FlightSource::Simulated(options) => options
            .height
            .or_else(|| Some(SimulationChoice::named(&options.scenario)?.height)),
        FlightSource::Files(_) | FlightSource::Nothing => None,
    };
    Altitude::new(flown.unwrap_or(USUAL_HEIGHT), AltitudeFrame::AboveGround)
}

/// The ground that the plan is about: routes and landmarks.
pub fn plan_ground(mission: &Mission) -> Option<GroundRect> {
    let routes = mission.routes.iter().flat_map(|r| &r.way_points);
    let places = routes.map(|w| w.position);
    let landmarks = mission.landmarks.iter();
    let corners = landmarks.flat_map(|l| {
        let b = l.bounds;
        [
            GroundPoint::new(b.north, b.west),
            GroundPoint::new(b.south, b.east),
        ]
    });
    GroundRect::around(places.chain(corners))
}
