//! Labelling as a feature: its commands, and the window that it fills.

use egui::Ui;
use pilotage_jobs::OpenedFiles;
use serde_json::Value;

use super::catalog::commands;
use super::edit::{
    add_labels, choose_landmark, export_labels, frame_at_cursor, say_of_label, set_label,
};
use super::{LabelCommand, Labeller};
use crate::command::{Command, Workspace};
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::feature::{
    Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace, PictureButton,
};
use crate::shell::CommandLack;
use crate::shell::icons::Icon;
use crate::state_json::object;
use crate::views::CameraView;

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: super::ID,
    tab: "",
    place: FeaturePlace::Window(Workspace::Replay),
    commands,
};

/// Labelling; the labels themselves are the mission's.
#[derive(Default)]
pub struct Labelling {
    /// The view in which pictures are labelled, while it is open.
    labeller: Option<Labeller>,
}

impl Labelling {
    fn toggle(&mut self, context: &mut FeatureContext<'_>) {
        if context.is_shown {
            self.labeller = None;
            return;
        }
        context.view.workspace = Workspace::Replay;
        context.playback.playing = false;
        self.labeller = Some(Labeller::default());
        let first = context.documents.mission.landmarks.first().map(|l| l.id);
        *context.selection = context.selection.or(first);
    }
}

impl Feature for Labelling {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        let Some(command) = command.action::<LabelCommand>() else {
            return false;
        };
        match command {
            LabelCommand::Toggle => self.toggle(context),
            LabelCommand::Export(format) => export_labels(*format, context),
            LabelCommand::Choose(_)
            | LabelCommand::Propose
            | LabelCommand::Accept
            | LabelCommand::Set { .. }
            | LabelCommand::Delete
            | LabelCommand::MarkAbsent
            | LabelCommand::ToggleDifficult => {}
        }
        let Some(labeller) = &mut self.labeller else {
            return true;
        };
        match command {
            LabelCommand::Toggle | LabelCommand::Export(_) => {}
            LabelCommand::Choose(rows) => choose_landmark(*rows, context),
            LabelCommand::Propose => {
                if let Some((frame, id)) = frame_at_cursor(context).zip(*context.selection) {
                    labeller.ask(frame, id);
                }
            }
            LabelCommand::Accept => {
                if let Some((frame, label)) = labeller.proposal() {
                    set_label(*frame, label.clone(), true, context);
                }
            }
            LabelCommand::Set {
                frame,
                label,
                finished,
            } => set_label(*frame, label.clone(), *finished, context),
            LabelCommand::Delete | LabelCommand::MarkAbsent | LabelCommand::ToggleDifficult => {
                if say_of_label(command, context) {
                    labeller.decline();
                }
            }
        }
        true
    }

    fn missing(
        &self,
        command: &FeatureCommand,
        documents: &Documents,
        selected: Option<u32>,
    ) -> Option<CommandLack> {
        let (is_there, what, advice) = match command.action()? {
            LabelCommand::Toggle => (
                documents.flight.measured.is_some(),
                "No flight is open",
                "Open one, or simulate one.",
            ),
            LabelCommand::Export(_) => (
                !documents.mission.labels.is_empty(),
                "No labels to export",
                "Press K and drag boxes around landmarks in the pictures of a flight.",
            ),
            _ => (
                self.labeller.is_some() && selected.is_some(),
                "No picture is being labelled",
                "Press K, and choose a landmark.",
            ),
        };
        CommandLack::unless(is_there, what, advice)
    }

    /// Whoever asks for the workspace that the labels are over wants to see it.
    fn intercept(&mut self, command: &Command, context: &mut FeatureContext<'_>) -> bool {
        if *command == Command::ShowWorkspace(Workspace::Replay) && context.is_shown {
            self.labeller = None;
        }
        false
    }

    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, documents: &Documents) {
        if let Some(labeller) = &mut self.labeller {
            let (past, future) = documents.mission.history.depth();
            labeller.panel(ui, context, (past > 0, future > 0));
        }
    }

    fn on_flight_changed(&mut self, _context: &mut FeatureContext<'_>) {
        self.labeller = self.labeller.take().map(|_| Labeller::default());
    }

    fn state(&self, _documents: &Documents) -> Value {
        self.labeller.as_ref().map_or(Value::Null, |it| {
            let rect = it.picture_rect();
            object!({
                "picture": rect.map(|r| [r.left(), r.top(), r.right(), r.bottom()]),
                "proposal": it.proposal().map(|(_, label)| [label.min, label.max]),
            })
        })
    }

    fn take_opened(
        &mut self,
        file: &str,
        opened: &mut OpenedFiles,
        context: &mut FeatureContext<'_>,
    ) {
        if let Some(labels) = opened.labels.take() {
            add_labels(file, labels, context);
        }
    }

    fn takes_window(&self) -> bool {
        self.labeller.is_some()
    }

    fn window(
        &mut self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        _documents: &Documents,
        camera: &mut CameraView,
    ) {
        if let Some(labeller) = &mut self.labeller {
            labeller.show(ui, context, camera);
        }
    }

    fn picture_button(&self) -> Option<PictureButton> {
        Some(PictureButton {
            icon: Icon::Tag,
            label: "Label landmarks in the pictures (K)",
            command: Command::from(LabelCommand::Toggle),
        })
    }
}
