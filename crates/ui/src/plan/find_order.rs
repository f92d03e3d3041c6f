//! Order of the search for a route, and the use of its result.

use pilotage_core::frames::{Altitude, GroundPoint};
use serde_json::{Value, json};

use super::compared::RouteFigures;
use super::find_command::{FindCommand, FindPick};
use super::finder::FindQuestion;
use super::flown::{ground_down, height, line, planned_frame_rate, usual_altitude};
use super::planner::Planner;
use super::tab::PlanTab;
use crate::documents::Documents;
use pilotage_jobs::{FindOrder, Foreseen, PlannedPath, PredictionOrder};

impl Planner {
    /// Plan for which a route is to be found; `None` while an end or the map is missing.
    pub fn find_question(&self, documents: &Documents) -> Option<FindQuestion> {
        let mission = &documents.mission;
        let (from, to) = (self.finder.from?, self.finder.to?);
        let wanted = &self.preferences.find;
        let altitude = self.found_altitude(documents);
        let height = height(&line(&[from, to], altitude), documents);
        let field = self.field_order(documents, wanted.over, height)?;
        let path = PlannedPath {
            bank: Some(self.preferences.bank),
            wind: self.wind(documents),
            ground_down: ground_down(documents),
            frame_rate: planned_frame_rate(documents),
            ..PlannedPath::level(vec![from, to], field.view.height, field.view.camera.clone())
        };
        let flight = PredictionOrder {
            landmarks: self.expected_landmarks(mission),
            ..PredictionOrder::along(path, mission)
        };
        let no_fly = mission.no_fly.clone();
        let heights = documents.map.terrain.heights();
        Some(FindQuestion {
            order: wanted.order((from, to), field, flight, no_fly, None)?,
            high_ground: self.highest_ground(documents).zip(heights.cloned()),
            altitude,
        })
    }

    /// The altitude of a route that is found: that of the selected route.
    pub fn found_altitude(&self, documents: &Documents) -> Altitude {
        let route = documents.mission.selected_route();
        let first = route.and_then(|r| r.way_points.first());
        first.map_or_else(|| usual_altitude(documents), |w| w.altitude)
    }

    /// Greatest height of ground that is flown over, metres above the datum of the elevation model, where one is open and
    /// A is chosen.
    pub fn highest_ground(&self, documents: &Documents) -> Option<f64> {
        documents.map.terrain.heights()?;
        let take_off = documents.relief().at(&self.finder.from?);
        let wanted = &self.preferences.find;
        wanted.highest_ground(self.found_altitude(documents), take_off)
    }

    /// Carries a command out; true if the mission changed.
    pub fn find_command(&mut self, command: FindCommand, documents: &mut Documents) -> bool {
        let finder = &mut self.finder;
        match command {
            FindCommand::Begin => {
                (finder.from, finder.to, finder.found) = (None, None, None);
                finder.trouble = None;
                finder.pick = FindPick::From;
            }
            FindCommand::Pick(pick) => {
                finder.pick = if finder.pick == pick {
                    FindPick::Nothing
                } else {
                    pick
                };
            }
            FindCommand::Click(at) => finder.click(at),
            FindCommand::Set(preferences) => self.preferences.find = preferences,
            FindCommand::Start => finder.wants = Some(true),
            FindCommand::Stop => finder.wants = Some(false),
            FindCommand::Accept => {
                let Some((found, altitude)) = finder.found.take().zip(finder.altitude()) else {
                    return false;
                };
                let found = line(&found.surest.route.way_points, altitude);
                let id = documents.add_route(Some(FindOrder::FOUND), found.way_points);
                documents.mission.route = Some(id);
                self.way_point = None;
                self.tab = PlanTab::Route;
                return true;
            }
            FindCommand::Dismiss => finder.found = None,
        }
        false
    }

    /// The search for journeys.
    pub fn find_json(&self) -> Value {
        let finder = &self.finder;
        let place = |p: GroundPoint| json!([p.north, p.east]);
        let of = |foreseen: &Foreseen| {
            RouteFigures::of(foreseen).map(|c| {
                json!({
                    "length": c.length,
                    "time": c.time,
                    "worst": c.worst,
                    "mean": c.mean,
                    "way_points": foreseen.route.way_points.len(),
                })
            })
        };
        json!({
            "from": finder.from.map(place),
            "to": finder.to.map(place),
            "pick": format!("{:?}", finder.pick),
            "progress": finder.under_way().map(|(share, _)| share),
            "trouble": finder.trouble,
            "shortest": finder.found.as_ref().and_then(|f| of(&f.shortest)),
            "surest": finder.found.as_ref().and_then(|f| of(&f.surest)),
        })
    }
}
