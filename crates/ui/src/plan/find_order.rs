//! Order of the search for a route, and the use of its result.

use pilotage_core::frames::{Altitude, GroundPoint};
use serde_json::{Value, json};

use super::compared::RouteFigures;
use super::find_command::{FindCommand, FindPick};
use super::flown::{ground_down, height, line, planned_frame_rate, usual_altitude};
use super::planner::Planner;
use super::tab::PlanTab;
use crate::documents::Documents;
use pilotage_jobs::{FindOrder, Foreseen, HighGround, PlannedPath, PredictionOrder};

impl Planner {
    /// Order of the search for a route; `None` while an end or the map is missing.
    pub fn find_order(&self, documents: &Documents) -> Option<FindOrder> {
        let mission = &documents.mission;
        let (from, to) = (self.finder.from?, self.finder.to?);
        let wanted = &self.preferences.find;
        let height = height(
            &line(&[from, to], self.found_altitude(documents)),
            documents,
        );
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
        wanted.order(
            (from, to),
            field,
            flight,
            mission.no_fly.clone(),
            self.high_ground(documents),
        )
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

    fn high_ground(&self, documents: &Documents) -> Option<HighGround> {
        Some(HighGround {
            highest: self.highest_ground(documents)?,
            heights: documents.map.terrain.heights()?.as_ref().clone(),
        })
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
                let Some(found) = finder.found.take() else {
                    return false;
                };
                let altitude = self.found_altitude(documents);
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
