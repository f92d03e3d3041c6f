//! Lack for which commands of planning can do nothing now.

use super::planner::Planner;
use super::print::NO_ROUTE;
use super::purpose::Purpose;
use super::{FindCommand, PlanCommand, RehearseCommand, TrainCommand};
use crate::documents::Documents;
use crate::shell::CommandLack;

impl Planner {
    /// Lack for which a command can do nothing now.
    pub(super) fn lack_of(
        &self,
        command: &PlanCommand,
        documents: &Documents,
        selected: Option<u32>,
    ) -> Option<CommandLack> {
        let mission = &documents.mission;
        let has_route = mission.selected_route().is_some();
        let (is_there, what, advice) = match command {
            PlanCommand::PrintBrief => return (!has_route).then_some(NO_ROUTE),
            PlanCommand::Reverse
            | PlanCommand::ToggleTakeOff
            | PlanCommand::ToggleReturn
            | PlanCommand::ToggleLanding
            | PlanCommand::CorridorAlong
            | PlanCommand::ToggleProfile
            | PlanCommand::DuplicateRoute
            | PlanCommand::DeleteRoute
            | PlanCommand::Rehearse(RehearseCommand::Start) => (
                has_route,
                "No route is selected",
                "Draw one in the Plan workspace.",
            ),
            PlanCommand::Split | PlanCommand::DeleteWayPoint(None) => (
                has_route && self.way_point.is_some(),
                "No way-point is selected",
                "Click one on the map, in the Plan workspace.",
            ),
            PlanCommand::Rehearse(RehearseCommand::Watch(None)) => (
                self.rehearsal.worst().is_some(),
                "No rehearsal yet",
                "Rehearse the route first.",
            ),
            PlanCommand::Rehearse(RehearseCommand::Stop) => (
                self.rehearsal.progress().is_some(),
                "No rehearsal is under way",
                "",
            ),
            PlanCommand::AssessSelected
            | PlanCommand::DuplicateLandmark
            | PlanCommand::Mark(Purpose::Reference)
            | PlanCommand::Train(TrainCommand::Selected) => (
                selected.is_some(),
                "No landmark is selected",
                "Click one on the map or in the list.",
            ),
            PlanCommand::Mark(Purpose::Hole) => (
                !mission.no_fly.is_empty(),
                "No no-fly area is there",
                "Draw one in Plan, under Ground.",
            ),
            PlanCommand::AssessAll | PlanCommand::Train(TrainCommand::All) => (
                !mission.landmarks.is_empty(),
                "No landmarks",
                "Draw one on the map.",
            ),
            PlanCommand::StopAssessing => (!self.assessments.is_idle(), "No test is under way", ""),
            PlanCommand::Train(
                TrainCommand::Pause(None) | TrainCommand::Resume(None) | TrainCommand::Cancel(None),
            ) => (
                self.trainings.unfinished(documents).next().is_some(),
                "No training is under way",
                "",
            ),
            PlanCommand::Find(FindCommand::Start) => (
                self.finder.from.is_some() && self.finder.to.is_some(),
                "A and B are not chosen",
                "Choose them on the map, in Plan under Ground.",
            ),
            _ => return None,
        };
        CommandLack::unless(is_there, what, advice)
    }
}
