//! What the Plan workspace remembers beside the documents.

use pilotage_core::camera::CameraModel;
use pilotage_core::frames::{Altitude, AltitudeFrame, GroundPoint, GroundRect, LocalFrame};
use pilotage_core::mission::turn::turn_radius;
use pilotage_core::mission::{Mission, Route, WayPoint};
use pilotage_core::simulate::{Airframe, Scenario, Target, Wind};
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
use super::routes::route_of;
use crate::documents::Documents;
use crate::jobs::{FlightSource, PredictionOrder, scenario_wind};

/// Height of a first way-point where no flight says another, metres above ground.
const USUAL_HEIGHT: f64 = 120.0;

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
    /// How well landmarks are found.
    pub assessments: Assessments,
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
        let height = height(route, mission, documents);
        Some(PredictionOrder {
            way_points: route.way_points.iter().map(|w| w.position).collect(),
            height,
            targets: targets(route, mission, documents),
            airspeed: None,
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

/// What the passes of a pattern are made for, if the route is flown at `altitude`.
pub fn circumstances(
    planner: &Planner,
    documents: &Documents,
    altitude: &Altitude,
) -> Circumstances {
    let counted = altitude.counted_from(
        AltitudeFrame::AboveGround,
        &documents.mission.level_ground(),
    );
    Circumstances {
        frame: LocalFrame::new(documents.mission.origin),
        camera: camera(documents),
        height: (counted.metres + ground_down(documents)).max(1.0),
        radius: turn_radius(cruise(), planner.preferences.bank),
    }
}

/// Height of the ground at a place, metres above mean sea level: that of the mission's origin.
pub fn ground_at(documents: &Documents, _place: &GroundPoint) -> f64 {
    documents.mission.origin.height
}

/// Mean height of a route above ground, metres, each way-point by the length of its legs.
pub fn height(route: &Route, mission: &Mission, documents: &Documents) -> f64 {
    let reference = mission.level_ground();
    let above = |altitude: &Altitude| {
        let counted = altitude.counted_from(AltitudeFrame::AboveGround, &reference);
        counted.metres + ground_down(documents)
    };
    let (mut sum, mut weight) = (0.0, 0.0);
    for pair in route.way_points.windows(2) {
        let length = pair[0].position.distance(&pair[1].position);
        sum += length * 0.5 * (above(&pair[0].altitude) + above(&pair[1].altitude));
        weight += length;
    }
    if weight > 0.0 {
        (sum / weight).max(1.0)
    } else {
        route
            .way_points
            .first()
            .map_or(USUAL_HEIGHT, |w| above(&w.altitude))
    }
}

/// How each way-point is flown over: heights above level ground, metres, and airspeeds.
fn targets(route: &Route, mission: &Mission, documents: &Documents) -> Vec<Target> {
    let reference = mission.level_ground();
    let of = |w: &WayPoint| {
        let counted = w
            .altitude
            .counted_from(AltitudeFrame::AboveGround, &reference);
        Target {
            height: (counted.metres + ground_down(documents)).max(1.0),
            airspeed: w.speed,
        }
    };
    route.way_points.iter().map(of).collect()
}

/// The altitude of a first way-point.
pub fn usual_altitude(documents: &Documents) -> Altitude {
    let flown = match &documents.flight_source {
        FlightSource::Simulated(options) => options
            .height
            .or_else(|| Some(Scenario::named(&options.scenario)?.height)),
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
