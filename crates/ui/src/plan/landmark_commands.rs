//! Landmarks drawn and edited in the Plan workspace: its commands carried out.

use pilotage_core::frames::GroundPoint;
use pilotage_core::mission::Route;

use super::PlanCommand;
use super::flown;
use super::marking::Marking;
use super::patterns::{CoveredGround, Pattern};
use super::planner::{Planner, circumstances};
use super::purpose::Purpose;
use super::suggest_command::SuggestCommand;
use super::tab::PlanTab;
use crate::documents::landmarks::{DrawnLandmark, LandmarkChange};
use crate::feature::FeatureContext;

impl Planner {
    /// Carries out what is about landmarks; gives back what is not.
    pub(super) fn edit_landmarks(
        &mut self,
        command: PlanCommand,
        context: &mut FeatureContext<'_>,
    ) -> Option<PlanCommand> {
        match command {
            PlanCommand::EditLandmarks {
                ids,
                change,
                finished,
            } => {
                context.document_changed();
                if context.documents.edit_landmarks(&ids, &change, finished) {
                    context.run_is_stale();
                }
            }
            PlanCommand::DeleteLandmarks(ids) => {
                delete(&ids, context);
            }
            PlanCommand::DuplicateLandmark => {
                let ids = self.marked(*context.selection);
                let copies = context.documents.duplicate_landmarks(&ids);
                if let Some(last) = copies.last() {
                    *context.selection = Some(*last);
                    self.mark(copies);
                    context.run_is_stale();
                }
            }
            PlanCommand::Suggest(command) => {
                if command == SuggestCommand::Start {
                    self.tab = PlanTab::Landmarks;
                }
                let ids = self.suggest_command(command, context.documents).landmarks;
                if let Some(last) = ids.last() {
                    // One is looked at; of several the proposals stay in sight.
                    *context.selection = Some(*last).filter(|_| ids.len() == 1);
                    context.run_is_stale();
                }
            }
            PlanCommand::MarkLandmarks(ids) => self.mark(ids),
            PlanCommand::Mark(purpose) => self.begin_marking(purpose, context),
            PlanCommand::AddCorner(at) => {
                if let Some(marking) = &mut self.marking {
                    // The second click of a double click marks no second corner.
                    let near = 3.0 * context.map.camera.metres_per_point;
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
                if let Some(marking) = &mut self.marking {
                    marking.corners.pop();
                }
            }
            PlanCommand::CancelMarking => self.marking = None,
            PlanCommand::FinishMarking => self.finish_marking(context),
            other => return Some(other),
        }
        None
    }

    fn begin_marking(&mut self, purpose: Purpose, context: &mut FeatureContext<'_>) {
        let marking = self.marking.as_ref();
        let same = marking.is_some_and(|m| m.purpose == purpose);
        self.marking = (!same).then(|| Marking::new(purpose));
        self.drawing = false;
        context.map.picking = false;
        if purpose == Purpose::Rally {
            self.tab = PlanTab::Ground;
        }
        if purpose != Purpose::Reference {
            *context.selection = None;
        }
    }

    fn finish_marking(&mut self, context: &mut FeatureContext<'_>) {
        let Some(marking) = self.marking.take() else {
            return;
        };
        let Marking { purpose, corners } = marking;
        match (purpose, corners.first().copied()) {
            (Purpose::Point, Some(point)) => self.add_drawn(&DrawnLandmark::Point(point), context),
            (Purpose::Reference, Some(place)) => {
                if let Some(id) = *context.selection {
                    let change = LandmarkChange::Reference(place);
                    context.document_changed();
                    if context.documents.edit_landmarks(&[id], &change, true) {
                        context.run_is_stale();
                    }
                }
            }
            (Purpose::Rally, Some(place)) => {
                context.documents.add_rally(place);
                context.document_changed();
            }
            (Purpose::Outline, _) if corners.len() >= 3 => {
                self.add_drawn(&DrawnLandmark::Outline(corners), context);
            }
            (Purpose::Survey, _) if corners.len() >= 3 => self.add_survey(&corners, context),
            (Purpose::Outline | Purpose::Survey, Some(_)) => {
                let text = "Click three corners or more before you end it.";
                context.note("An outline has three corners", text);
            }
            (_, None) => {}
        }
    }

    fn add_survey(&mut self, corners: &[GroundPoint], context: &mut FeatureContext<'_>) {
        let documents = &mut *context.documents;
        let usual = flown::usual_altitude(documents);
        let altitude = documents.mission.selected_route();
        let altitude = altitude
            .and_then(|r| r.way_points.first())
            .map_or(usual, |w| w.altitude);
        let made_for = circumstances(self, documents, altitude, corners);
        let pattern = Pattern::new(CoveredGround::Survey, corners, &made_for.frame);
        let mut route = Route::default();
        pattern.apply(&mut route, altitude, &made_for);
        documents.mission.route = Some(documents.add_made(route, "Survey"));
        self.tab = PlanTab::Route;
        self.way_point = None;
        context.document_changed();
    }

    fn add_drawn(&mut self, drawn: &DrawnLandmark, context: &mut FeatureContext<'_>) {
        let id = context.documents.add_drawn(drawn);
        self.tab = PlanTab::Landmarks;
        context.present(id);
        context.run_is_stale();
    }
}

/// Deletes landmarks; none of them stays selected.
pub(super) fn delete(ids: &[u32], context: &mut FeatureContext<'_>) {
    context.document_changed();
    let stale = context.documents.delete_landmarks(ids);
    *context.selection = context.selection.filter(|id| !ids.contains(id));
    if stale {
        context.run_is_stale();
    }
}
