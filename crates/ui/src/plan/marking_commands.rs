//! Commands that mark places on the map: begun, ended, put away and taken up again.

use pilotage_core::frames::GroundPoint;

use super::PlanCommand;
use super::find_command::FindPick;
use super::marking::{Marking, PutAway};
use super::planner::Planner;
use super::purpose::{FEWEST, Purpose};
use super::tab::PlanTab;
use crate::documents::landmarks::{DrawnLandmark, LandmarkChange};
use crate::feature::FeatureContext;

impl Planner {
    /// Carries out what marks places; gives back what does not.
    pub(super) fn mark_places(
        &mut self,
        command: PlanCommand,
        context: &mut FeatureContext<'_>,
    ) -> Option<PlanCommand> {
        match command {
            PlanCommand::Mark(purpose) => self.begin_marking(purpose, context),
            PlanCommand::AddCorner(at) => {
                if let Some(marking) = &mut self.marking {
                    // The second click of a double click marks no second corner.
                    let near = 3.0 * context.map.camera.metres_per_point;
                    let last = marking.corners.last();
                    if last.is_none_or(|last| last.distance(&at) > near) {
                        marking.corners.push(at);
                    }
                }
            }
            PlanCommand::RemoveCorner => {
                if let Some(marking) = &mut self.marking {
                    marking.corners.pop();
                }
            }
            PlanCommand::CancelMarking => {
                let has_corners = self
                    .marking
                    .as_ref()
                    .is_some_and(|it| !it.corners.is_empty());
                self.put_marking_away(context);
                if has_corners {
                    context.note("The outline is not drawn", "Undo brings its corners back.");
                }
            }
            PlanCommand::FinishMarking => self.finish_marking(context),
            other => return Some(other),
        }
        None
    }

    /// Leaves what is being marked; undo takes it up again.
    pub(super) fn put_marking_away(&mut self, context: &FeatureContext<'_>) {
        let marking = self.marking.take().filter(|it| !it.corners.is_empty());
        let edits = context.documents.mission.history.edits();
        let put_away = marking.map(|marking| PutAway { marking, edits });
        // What was put away before stays, where nothing was marked since.
        self.put_away = put_away.or(self.put_away.take());
    }

    /// Takes the last corner of what is being marked back, or up what was put away just now; whether there was one.
    pub(super) fn take_corner_back(&mut self, context: &FeatureContext<'_>) -> bool {
        let corners = self.marking.as_mut().map(|it| &mut it.corners);
        if corners.and_then(Vec::pop).is_some() {
            return true;
        }
        let edits = context.documents.mission.history.edits();
        let put_away = self.put_away.take().filter(|it| it.edits == edits);
        let is_there = put_away.is_some();
        self.marking = put_away.map(|it| it.marking).or(self.marking.take());
        is_there
    }

    fn begin_marking(&mut self, purpose: Purpose, context: &mut FeatureContext<'_>) {
        let marking = self.marking.as_ref();
        let same = marking.is_some_and(|m| m.purpose == purpose);
        self.put_marking_away(context);
        self.marking = (!same).then(|| Marking::new(purpose));
        self.drawing = false;
        self.finder.pick = FindPick::Nothing;
        context.take_map();
        if purpose == Purpose::Rally || purpose.is_about_no_fly() {
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
        let Some(first) = corners.first().copied() else {
            return;
        };
        if !purpose.is_point() && corners.len() < FEWEST {
            let text = "Click three corners or more before you end it.";
            context.note("An outline has three corners", text);
            self.marking = Some(Marking { purpose, corners });
            return;
        }
        match purpose {
            Purpose::Point => self.add_drawn(&DrawnLandmark::Point(first), context),
            Purpose::Reference => {
                if let Some(id) = *context.selection {
                    let change = LandmarkChange::Reference(first);
                    context.document_changed();
                    if context.documents.edit_landmarks(&[id], &change, true) {
                        context.run_is_stale();
                    }
                }
            }
            Purpose::Rally => {
                context.documents.add_rally(first);
                context.document_changed();
            }
            Purpose::Outline => self.add_drawn(&DrawnLandmark::Outline(corners), context),
            Purpose::Survey => self.add_survey(&corners, context),
            Purpose::NoFlyArea => {
                context.documents.add_no_fly(corners);
                context.document_changed();
            }
            Purpose::Hole => self.cut_hole(corners, context),
        }
    }

    fn cut_hole(&mut self, corners: Vec<GroundPoint>, context: &mut FeatureContext<'_>) {
        if context.documents.cut_hole(corners.clone()) {
            context.document_changed();
            return;
        }
        let text = "Take corners back and click others, all of them inside of one area.";
        context.note("A hole lies inside of a no-fly area", text);
        self.marking = Some(Marking {
            purpose: Purpose::Hole,
            corners,
        });
    }
}
