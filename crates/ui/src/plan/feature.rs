//! The plan as a feature: what it is asked by the app.

use egui::{Rect, Ui, vec2};
use pilotage_jobs::{Beside, JobEvent, JobId, OpenedFiles};
use serde_json::Value;

use super::RehearseCommand;
use super::catalog::commands;
use super::command::{ID, PlanCommand};
use super::find_command::FindPick;
use super::landmark_commands::delete;
use super::planner::{Planner, Seen, count};
use super::readouts::plan_readouts;
use super::tab::PlanTab;
use crate::command::{Command, Workspace};
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::export_command::ExportCommand;
use crate::feature::{Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace};
use crate::map::MapTool;
use crate::shell::CommandLack;
use crate::shell::icons::Icon;
use crate::shell::{BELOW_HUD, NextStep};
use crate::units::Units;
use crate::views::Examined;

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: ID,
    tab: "Plan",
    place: FeaturePlace::Workspace(Workspace::Plan),
    commands,
};

impl Feature for Planner {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        let Some(command) = command.action::<PlanCommand>().cloned() else {
            return false;
        };
        // Undo in the same frame came first: the number is that of another way-point, area or rally point.
        let is_of_before = self.counted != count(context.documents);
        let are_others = !self.numbered.is_as_in(&context.documents.mission);
        if is_of_before && command.is_of_way_point() || are_others && command.is_of_area_or_rally()
        {
            return true;
        }
        let is_done = self.carry_out(command, context);
        if !is_of_before {
            self.keep_count(context.documents);
        }
        if !are_others {
            self.numbered.keep(&context.documents.mission);
        }
        is_done
    }

    fn missing(
        &self,
        command: &FeatureCommand,
        documents: &Documents,
        selected: Option<u32>,
    ) -> Option<CommandLack> {
        self.lack_of(command.action()?, documents, selected)
    }

    /// Keeps to the landmark that is selected, and has its own answers to what is asked of the map and of landmarks
    /// while people plan. What is about the flight is out of place then.
    fn intercept(&mut self, command: &Command, context: &mut FeatureContext<'_>) -> bool {
        match command {
            Command::SelectLandmark(Some(id))
                if context.documents.mission.landmark(*id).is_some() =>
            {
                self.way_point = None;
                self.tab = PlanTab::Landmarks;
            }
            Command::AddLandmark(_) => self.tab = PlanTab::Landmarks,
            Command::Undo if context.is_shown => return self.take_corner_back(context),
            Command::Feature(command)
                if matches!(command.action(), Some(ExportCommand::Route(_))) =>
            {
                return self.asks_before_export(context);
            }
            _ if !context.is_shown => return false,
            Command::DeleteLandmark(id) => {
                let marked = self.marked(*context.selection);
                if marked.contains(id) {
                    delete(&marked, context);
                    return true;
                }
            }
            Command::FitMap => {
                let ground = context.documents.mission.planned_ground();
                if let Some(ground) = ground {
                    context.map.fit(ground);
                }
                return ground.is_some();
            }
            Command::TogglePlay
            | Command::StepFrames(_)
            | Command::Jump(_)
            | Command::GoToStart
            | Command::GoToEnd => return true,
            _ => return false,
        }
        false
    }

    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, documents: &Documents) {
        self.column(ui, documents, context);
    }

    fn fills_strip(&self, documents: &Documents) -> bool {
        documents.mission.selected_route().is_some() || self.drawing
    }

    fn plots(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, documents: &Documents) {
        self.strip(ui, documents, context);
    }

    fn over_map(&self, ui: &mut Ui, rect: Rect, context: &mut ViewContext<'_>) -> Vec<Rect> {
        let corner = rect.left_top() + vec2(16.0, 16.0);
        let readouts = plan_readouts(
            ui,
            context.tokens,
            context.units,
            self,
            context.mission,
            corner,
            rect.width() - 96.0,
        );
        let below = rect.left_top() + vec2(16.0, BELOW_HUD);
        let legend = self.heat_legend(ui, context.tokens, below);
        readouts.into_iter().chain(legend).collect()
    }

    fn tool(&mut self) -> Option<&mut dyn MapTool> {
        Some(self)
    }

    fn hides_flight(&self) -> bool {
        true
    }

    fn start(&mut self, context: &mut FeatureContext<'_>) {
        self.assessments.recall(context.host);
        self.trainings.recall(context.host);
    }

    fn restore(&mut self, saved: &str) {
        self.restore_preferences(saved);
    }

    fn save(&self) -> Option<String> {
        serde_json::to_string(&self.preferences).ok()
    }

    fn on_event(&mut self, job: JobId, event: JobEvent, context: &mut FeatureContext<'_>) -> bool {
        self.receive(job, &event, context)
    }

    fn leave_map(&mut self, context: &mut FeatureContext<'_>) {
        if self.drawing {
            self.finish_drawing(context);
        }
        self.finder.pick = FindPick::Nothing;
        if self.marking.is_some() {
            self.put_marking_away(context);
        }
    }

    fn on_flight_changed(&mut self, context: &mut FeatureContext<'_>) {
        if context.documents.flight.measured.is_some() {
            self.fitted = context.map.is_placed;
        }
        self.stop_examining(context);
        self.examination.forget();
    }

    fn examined(&self, landmark: u32, documents: &Documents) -> Option<Examined<'_>> {
        Some(self.examination.of(landmark, documents))
    }

    /// Draws no longer once something else is looked at, and lets nothing play while people plan.
    fn tend(&mut self, context: &mut FeatureContext<'_>) {
        if context.is_shown {
            context.playback.playing = false;
        } else {
            if self.drawing {
                self.finish_drawing(context);
            }
            if self.marking.is_some() {
                self.put_marking_away(context);
            }
        }
        self.work(context);
        self.seen = Seen {
            view: context.map.screen_from_world(),
            selection: *context.selection,
        };
    }

    fn take_opened(
        &mut self,
        _file: &str,
        opened: &mut OpenedFiles,
        context: &mut FeatureContext<'_>,
    ) {
        self.add_imports(std::mem::take(&mut opened.imports), context);
    }

    fn put_beside(&self, beside: &mut Beside, documents: &Documents) {
        beside.measured = self.assessments.to_keep(&documents.mission.landmarks);
    }

    fn take_beside(&mut self, beside: &mut Beside) {
        self.assessments.adopt(std::mem::take(&mut beside.measured));
    }

    fn state(&self, documents: &Documents) -> Value {
        self.json(documents)
    }

    fn next_step(&self, workspace: Workspace, documents: &Documents) -> Option<NextStep> {
        let has_route = documents.mission.selected_route().is_some();
        let is_next = has_route && self.rehearsal.progress().is_none();
        (is_next && workspace == Workspace::Plan).then(|| NextStep {
            icon: Icon::Play,
            label: "Rehearse route",
            command: Command::from(PlanCommand::Rehearse(RehearseCommand::Start)),
        })
    }

    fn summary(&self, documents: &Documents, units: Units) -> Option<String> {
        Some(self.text(documents, units))
    }
}
