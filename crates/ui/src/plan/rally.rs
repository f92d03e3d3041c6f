//! Edits of rally points, each one undo step; a drag is one.

use pilotage_core::frames::GroundPoint;
use pilotage_core::mission::RallyPoint;

use super::command::{PlanCommand, RallyChange};
use super::routes::EditStep;
use crate::documents::Documents;
use crate::feature::FeatureContext;

/// Carries out what is about rally points; gives back what is not.
pub fn edit_rally_points(
    command: PlanCommand,
    context: &mut FeatureContext<'_>,
) -> Option<PlanCommand> {
    match command {
        PlanCommand::EditRally {
            index,
            change,
            finished,
        } => {
            let step = EditStep::of(finished);
            context.documents.edit_rally(index, step, change);
        }
        PlanCommand::DeleteRally(index) => context.documents.delete_rally(index),
        other => return Some(other),
    }
    context.document_changed();
    None
}

impl Documents {
    /// Adds a rally point.
    pub fn add_rally(&mut self, place: GroundPoint) {
        self.mission.remember();
        self.mission.is_edited = true;
        let number = self.mission.rally.len() + 1;
        let mut point = RallyPoint::new(number, place);
        point.name = self.mission.free_rally_name(&point.name);
        self.mission.rally.push(point);
    }

    /// Changes a rally point.
    pub fn edit_rally(&mut self, index: usize, step: EditStep, change: RallyChange) {
        let Some(point) = self.mission.rally.get(index) else {
            return;
        };
        let mut point = point.clone();
        match change {
            RallyChange::Name(name) => point.name = name,
            RallyChange::Place(place) => point.position = place,
            RallyChange::Altitude(altitude) => point.altitude = altitude,
        }
        if point != self.mission.rally[index] {
            self.mission.history.begin_drag(&self.mission.content);
            self.mission.rally[index] = point;
            self.mission.is_edited = true;
        }
        if step == EditStep::Whole {
            self.mission.history.finish_drag(&self.mission.content);
        }
    }

    /// Deletes a rally point.
    pub fn delete_rally(&mut self, index: usize) {
        if index < self.mission.rally.len() {
            self.mission.remember();
            self.mission.is_edited = true;
            self.mission.rally.remove(index);
        }
    }
}
