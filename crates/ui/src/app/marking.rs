//! Landmarks drawn and edited in the Plan workspace: its commands carried out.

use pilotage_core::frames::GroundPoint;
use pilotage_core::mission::Route;

use super::{App, SideTab};
use crate::documents::landmarks::{Drawn, LandmarkChange};
use crate::plan::{
    Cover, Marking, Pattern, PlanCommand, PlanTab, Purpose, SuggestCommand, flown,
    planner as planning,
};

impl App {
    /// Carries out what is about landmarks; gives back what is not.
    pub(super) fn edit_landmarks(&mut self, command: PlanCommand, now: f64) -> Option<PlanCommand> {
        match command {
            PlanCommand::EditLandmarks {
                ids,
                change,
                finished,
            } => {
                self.jobs.document_changed = true;
                let stale = self.documents.edit_landmarks(&ids, &change, finished);
                self.after_landmarks(stale, now);
            }
            PlanCommand::DeleteLandmarks(ids) => {
                self.jobs.document_changed = true;
                let stale = self.documents.delete_landmarks(&ids);
                self.selection = self.selection.filter(|id| !ids.contains(id));
                self.after_landmarks(stale, now);
            }
            PlanCommand::DuplicateLandmark => {
                let ids = self.views.planner.marked(self.selection);
                let copies = self.documents.duplicate_landmarks(&ids);
                if let Some(last) = copies.last() {
                    self.jobs.document_changed = true;
                    self.selection = Some(*last);
                    self.views.planner.mark(copies);
                    self.after_landmarks(true, now);
                }
            }
            PlanCommand::Suggest(command) => {
                let planner = &mut self.views.planner;
                if command == SuggestCommand::Start {
                    planner.tab = PlanTab::Landmarks;
                }
                let ids = planner
                    .suggest_command(command, &mut self.documents)
                    .landmarks;
                if let Some(last) = ids.last() {
                    self.jobs.document_changed = true;
                    // One is looked at; of several the proposals stay in sight.
                    self.selection = Some(*last).filter(|_| ids.len() == 1);
                    self.after_landmarks(true, now);
                }
            }
            PlanCommand::MarkLandmarks(ids) => self.views.planner.mark(ids),
            PlanCommand::Mark(purpose) => self.begin_marking(purpose),
            PlanCommand::AddCorner(at) => {
                if let Some(marking) = &mut self.views.planner.marking {
                    // The second click of a double click marks no second corner.
                    let near = 3.0 * self.views.map.camera.metres_per_point;
                    if marking
                        .corners
                        .last()
                        .is_none_or(|l| l.distance(&at) > near)
                    {
                        marking.corners.push(at);
                    }
                }
            }
            PlanCommand::RemoveCorner => {
                if let Some(marking) = &mut self.views.planner.marking {
                    marking.corners.pop();
                }
            }
            PlanCommand::CancelMarking => self.views.planner.marking = None,
            PlanCommand::FinishMarking => self.finish_marking(now),
            other => return Some(other),
        }
        None
    }

    fn begin_marking(&mut self, purpose: Purpose) {
        let planner = &mut self.views.planner;
        let same = planner
            .marking
            .as_ref()
            .is_some_and(|m| m.purpose == purpose);
        planner.marking = (!same).then(|| Marking::new(purpose));
        planner.drawing = false;
        self.views.map.picking = false;
        if purpose != Purpose::Reference {
            self.selection = None;
        }
    }

    fn finish_marking(&mut self, now: f64) {
        let Some(marking) = self.views.planner.marking.take() else {
            return;
        };
        let Marking { purpose, corners } = marking;
        match (purpose, corners.first().copied()) {
            (Purpose::Point, Some(point)) => self.add_drawn(&Drawn::Point(point), now),
            (Purpose::Reference, Some(place)) => {
                if let Some(id) = self.selection {
                    let change = LandmarkChange::Reference(place);
                    let stale = self.documents.edit_landmarks(&[id], &change, true);
                    self.jobs.document_changed = true;
                    self.after_landmarks(stale, now);
                }
            }
            (Purpose::Outline, _) if corners.len() >= 3 => {
                self.add_drawn(&Drawn::Outline(corners), now);
            }
            (Purpose::Survey, _) if corners.len() >= 3 => self.add_survey(&corners),
            (Purpose::Outline | Purpose::Survey, Some(_)) => {
                let text = "Click three corners or more before you end it.";
                self.toasts.note(now, "An outline has three corners", text);
            }
            (_, None) => {}
        }
    }

    fn add_survey(&mut self, corners: &[GroundPoint]) {
        let planner = &mut self.views.planner;
        let documents = &mut self.documents;
        let usual = flown::usual_altitude(documents);
        let altitude = documents.selected_route();
        let altitude = altitude
            .and_then(|r| r.way_points.first())
            .map_or(usual, |w| w.altitude);
        let made_for = planning::circumstances(planner, documents, altitude, corners);
        let pattern = Pattern::new(Cover::Survey, corners, &made_for.frame);
        let mut route = Route::default();
        pattern.apply(&mut route, altitude, &made_for);
        documents.route = Some(documents.add_made(route, "Survey"));
        planner.tab = PlanTab::Route;
        planner.way_point = None;
        self.jobs.document_changed = true;
    }

    fn add_drawn(&mut self, drawn: &Drawn, now: f64) {
        let id = self.documents.add_drawn(drawn);
        self.jobs.document_changed = true;
        self.selection = Some(id);
        self.side_tab = SideTab::Landmarks;
        self.views.planner.tab = PlanTab::Landmarks;
        let name = self.documents.mission.landmark(id).map(|l| l.name.clone());
        self.views.map.name_new(id, &name.unwrap_or_default());
        self.after_landmarks(true, now);
    }

    fn after_landmarks(&mut self, stale: bool, now: f64) {
        if stale {
            self.examine_soon(now);
            self.run_is_stale(now);
        }
    }
}
