//! State of the Plan workspace beside the documents.

use std::collections::BTreeMap;

use pilotage_core::frames::{Altitude, GroundPoint, LocalFrame};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::turn::turn_radius;
use pilotage_core::mission::{Mission, Route};
use pilotage_core::plan::{DetectionStatistics, cruise, planned_aircraft};
use pilotage_core::simulate::Wind;
use pilotage_core::training::TrainingPlan;
use serde::{Deserialize, Serialize};

use super::assessments::Assessments;
use super::chart::Chart;
use super::drawn_landmarks::DrawnLandmarks;
use super::examination::Examination;
use super::finder::Finder;
use super::flown::{
    camera, flight_wind, flown_way, ground_down, height, line, planned_frame_rate, planned_with,
    usual_altitude,
};
use super::forecast::Forecast;
use super::heat::Heat;
use super::heat_command::HeatPreferences;
use super::hit::PlanPointer;
use super::incursion_check::IncursionCheck;
use super::landmark_editor::LandmarkEditor;
use super::landmark_table::LandmarkTable;
use super::marking::{Marking, PutAway};
use super::numbered::NumberedPlaces;
use super::patterns::PassCircumstances;
use super::printing::Printing;
use super::rehearsal::{RehearsalPreferences, RouteRehearsal};
use super::remedy::Remedies;
use super::suggestions::Suggestions;
use super::tab::PlanTab;
use super::trainings::Trainings;
use super::untested::Untested;
use crate::documents::Documents;
use crate::map::ScreenFromWorld;
use crate::views::LandmarkList;
use pilotage_jobs::{
    AssessmentOrder, PlanCircumstances, PlannedPath, PredictionOrder, RouteWishes,
};

/// Preferences and assumptions of the user; remembered between visits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct PlanPreferences {
    /// Standard deviation of the position that is accepted, metres.
    pub limit: f64,
    /// The wind to plan with; the flight's if `None`, as far as it is known.
    pub wind: Option<Wind>,
    /// Preferences of the heat map.
    pub heat: HeatPreferences,
    /// Preferences of the search for a route.
    pub find: RouteWishes,
    /// Number of landmarks that are proposed.
    pub suggest: usize,
    /// Number of photos that a detector learns from.
    pub photos: usize,
    /// Bank limit, radians.
    pub bank: f64,
    /// Power in watts, if the user states it.
    pub power: Option<f64>,
    /// Energy on board, watt hours, if the user states it.
    pub energy: Option<f64>,
    /// Whether the heights of the route are shown below the map.
    pub profile: bool,
    /// Preferences of rehearsals.
    pub rehearsal: RehearsalPreferences,
    /// Whether landmarks are tested before anybody asks.
    pub tests_ahead: bool,
}

impl Default for PlanPreferences {
    fn default() -> Self {
        Self {
            limit: PredictionOrder::LIMIT,
            wind: None,
            heat: HeatPreferences::default(),
            find: RouteWishes::default(),
            suggest: 6,
            photos: TrainingPlan::default().photos,
            bank: planned_aircraft().bank_limit,
            power: None,
            energy: None,
            profile: false,
            rehearsal: RehearsalPreferences::default(),
            tests_ahead: true,
        }
    }
}

/// The state of the Plan workspace.
#[derive(Default)]
pub struct Planner {
    /// The selected way-point of the selected route.
    pub way_point: Option<usize>,
    /// Id of the selected route, and number of its way-points, as they were left.
    pub(super) counted: Option<(u32, usize)>,
    /// No-fly areas and rally points, as its own commands or undo left them.
    pub(super) numbered: NumberedPlaces,
    /// Pointer on routes of the map.
    pub pointer: PlanPointer,
    /// Whether clicks on the map add way-points.
    pub drawing: bool,
    /// Marking of places on the map by clicks.
    pub marking: Option<Marking>,
    /// Places that were marked when people turned to something else.
    pub(super) put_away: Option<PutAway>,
    /// The open tab.
    pub tab: PlanTab,
    /// Preferences and assumptions of the user.
    pub preferences: PlanPreferences,
    /// Distance along the flown path under the pointer in the chart, metres.
    pub hovered: Option<f64>,
    /// The prediction.
    pub forecast: Forecast,
    /// Flights of the route in the simulation.
    pub rehearsal: RouteRehearsal,
    /// Remedies of the worst stretch of the route.
    pub remedies: Remedies,
    /// Detection statistics of landmarks.
    pub assessments: Assessments,
    /// Worth of landmarks that nobody tested.
    pub untested: Untested,
    /// Landmarks that people draw and change.
    pub(super) drawn: DrawnLandmarks,
    /// Detectors that are trained.
    pub trainings: Trainings,
    /// Landmarks that are proposed.
    pub suggestions: Suggestions,
    /// Heat map of the probability of a fix.
    pub heat: Heat,
    /// The search for a route.
    pub finder: Finder,
    /// The chart.
    pub(super) chart: Chart,
    /// The table of landmarks.
    pub(super) table: LandmarkTable,
    /// Editor of landmarks, with the text being typed.
    pub(super) editor: LandmarkEditor,
    /// The name being typed for the selected route.
    pub(super) name_draft: Option<(u32, String)>,
    /// The name being typed for a no-fly area, by its number.
    pub(super) area_draft: Option<(usize, String)>,
    /// The name being typed for a rally point, by its number.
    pub(super) rally_draft: Option<(usize, String)>,
    /// Whether the map was fitted to the plan.
    pub fitted: bool,
    /// Comparison of the selected landmark with the map around it.
    pub(super) examination: Examination,
    /// The brief whose pictures are being made.
    pub(super) printing: Option<Printing>,
    /// The selected landmark in full, with the name being typed.
    pub(super) list: LandmarkList,
    /// Parts of the app beside it, as they were last.
    pub(super) seen: Seen,
    /// No-fly areas that the selected route leads over or near.
    pub(super) incursions: IncursionCheck,
}

/// Parts of the app on which the plan's report for journeys depends, as they were last.
#[derive(Debug, Default)]
pub struct Seen {
    /// Transform of the map to the screen.
    pub view: Option<ScreenFromWorld>,
    /// The selected landmark.
    pub selection: Option<u32>,
}

impl Planner {
    /// Takes up preferences that an earlier visit remembered; the usual ones if they are not readable.
    pub fn restore_preferences(&mut self, saved: &str) {
        self.preferences = serde_json::from_str(saved).unwrap_or_default();
    }

    /// Lets go of what does not exist any more, and selects the first route if none is.
    pub fn settle(&mut self, documents: &mut Documents) {
        let known = documents.mission.selected_route().map(|r| r.id);
        let first = || documents.mission.routes.first().map(|r| r.id);
        documents.mission.route = if self.drawing {
            known
        } else {
            known.or_else(first)
        };
        self.table.settle(&documents.mission);
        // By other hands, such as undo: the numbers are those of other way-points, areas and rally points.
        if self.counted != count(documents) {
            self.way_point = None;
            self.pointer.dragged = None;
        }
        self.keep_count(documents);
        if !self.numbered.is_as_in(&documents.mission) {
            (self.pointer.area, self.pointer.rally) = (None, None);
            (self.area_draft, self.rally_draft) = (None, None);
            self.numbered.keep(&documents.mission);
        }
    }

    /// Notes the way-points of the selected route, as its own commands or undo left them.
    pub(super) fn keep_count(&mut self, documents: &Documents) {
        self.counted = count(documents);
    }

    /// Part of the screen on which the chart's curves were drawn last.
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

    /// The wind that somebody stated, or else the open flight tells.
    pub fn known_wind(&self, documents: &Documents) -> Option<Wind> {
        self.preferences.wind.or_else(|| flight_wind(documents))
    }

    /// The wind that is planned with: calm where none is known.
    pub fn wind(&self, documents: &Documents) -> Wind {
        self.known_wind(documents).unwrap_or_default()
    }

    /// Order of the measurement of a landmark.
    pub fn assessment(&self, landmark: &Landmark, documents: &Documents) -> AssessmentOrder {
        self.planned_with(documents).assessment(landmark)
    }

    /// Circumstances with which orders of the plan are made.
    pub(super) fn planned_with(&self, documents: &Documents) -> PlanCircumstances {
        planned_with(documents, self.preferences.heat.position)
    }

    /// Expected detections of a landmark: as it was tested, or as of one that nobody tested.
    pub fn expected(&self, landmark: &Landmark) -> DetectionStatistics {
        let tested = self.assessments.expected(landmark);
        tested.unwrap_or_else(|| DetectionStatistics::everywhere(self.untested.expected()))
    }

    /// The landmarks that are switched on, as they are looked for, with what is expected of them.
    pub fn expected_landmarks(&self, mission: &Mission) -> Vec<(Landmark, DetectionStatistics)> {
        let enabled = mission.landmarks.iter().filter(|l| l.enabled);
        enabled
            .map(|l| (l.looked_for(), self.expected(l)))
            .collect()
    }

    /// Order of the prediction of the selected route; `None` while it is none that can be flown.
    pub fn order(&self, documents: &Documents) -> Option<PredictionOrder> {
        let mission = &documents.mission;
        let route = documents.mission.selected_route()?;
        if route.length() < 1.0 {
            return None;
        }
        let camera = camera(documents);
        let bank = self.preferences.bank;
        let way = flown_way(route, documents, bank);
        let path = PlannedPath {
            targets: way.targets,
            bank: Some(bank),
            wind: self.wind(documents),
            ground_down: ground_down(documents),
            frame_rate: planned_frame_rate(documents),
            ..PlannedPath::level(way.places, height(route, documents), camera)
        };
        Some(PredictionOrder {
            landmarks: self.expected_landmarks(mission),
            ..PredictionOrder::along(path, mission)
        })
    }
}

/// Id of the selected route, and number of its way-points.
pub(super) fn count(documents: &Documents) -> Option<(u32, usize)> {
    let route = documents.mission.selected_route();
    route.map(|it| (it.id, it.way_points.len()))
}

/// Circumstances of the passes of a pattern over `places`, if they are flown at `altitude`.
pub fn circumstances(
    planner: &Planner,
    documents: &Documents,
    altitude: Altitude,
    places: &[GroundPoint],
) -> PassCircumstances {
    PassCircumstances {
        frame: LocalFrame::new(documents.mission.origin),
        camera: camera(documents),
        height: height(&line(places, altitude), documents),
        radius: turn_radius(cruise(), planner.preferences.bank),
    }
}

/// Circumstances of the passes of a pattern, if a route is made of it.
pub fn made_for(
    planner: &Planner,
    documents: &Documents,
    route: Option<&Route>,
) -> PassCircumstances {
    let way_points = route.map_or(&[][..], |r| &r.way_points);
    let first = route.and_then(|it| documents.relief().first_altitude(it));
    let altitude = first.unwrap_or_else(|| usual_altitude(documents));
    let places: Vec<GroundPoint> = way_points.iter().map(|w| w.position).collect();
    circumstances(planner, documents, altitude, &places)
}

/// The landmarks of a prediction as they stand in the mission, in its order: what was asked knows what is looked for, and not
/// what it is called.
pub fn by_name<'a>(order: &'a PredictionOrder, mission: &'a Mission) -> Vec<&'a Landmark> {
    let all = mission.landmarks.iter().map(|it| (it.id, it));
    let all: BTreeMap<u32, &Landmark> = all.collect();
    let asked = order.landmarks.iter().map(|(landmark, _)| landmark);
    asked
        .map(|it| all.get(&it.id).copied().unwrap_or(it))
        .collect()
}
