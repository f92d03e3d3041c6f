//! Landmarks drawn and edited in the Plan workspace: its commands carried out.

use pilotage_core::frames::GroundPoint;
use pilotage_core::mission::Route;

use super::PlanCommand;
use super::flown;
use super::patterns::{CoveredGround, Pattern};
use super::planner::{Planner, circumstances};
use super::suggest_command::SuggestCommand;
use super::tab::PlanTab;
use crate::documents::landmarks::DrawnLandmark;
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
            other => return self.mark_places(other, context),
        }
        None
    }

    pub(super) fn add_survey(&mut self, corners: &[GroundPoint], context: &mut FeatureContext<'_>) {
        let documents = &mut *context.documents;
        let usual = flown::usual_altitude(documents);
        let selected = documents.mission.selected_route();
        let first = selected.and_then(|r| Some((r, r.way_points.first()?.altitude)));
        let relief = documents.relief();
        let height = first.and_then(|(r, _)| relief.first_altitude(r));
        let made_for = circumstances(self, documents, height.unwrap_or(usual), corners);
        let pattern = Pattern::new(CoveredGround::Survey, corners, &made_for.frame);
        let mut route = Route::default();
        pattern.apply(&mut route, first.map_or(usual, |it| it.1), &made_for);
        if let Some((selected, _)) = first {
            relief.keep_heights(selected, &mut route);
        }
        documents.mission.route = Some(documents.add_made(route, "Survey"));
        self.tab = PlanTab::Route;
        self.way_point = None;
        context.document_changed();
    }

    pub(super) fn add_drawn(&mut self, drawn: &DrawnLandmark, context: &mut FeatureContext<'_>) {
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
