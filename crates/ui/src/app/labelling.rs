//! Labels of pictures: edits, proposals, files.

use pilotage_core::exchange::labels::{FoundLabels, LabelFormat};
use pilotage_core::mission::LabelBox;

use super::App;
use super::exchange::sentences;
use crate::command::Workspace;
use crate::context::shown_frame;
use crate::exports::ExportedFile;
use crate::host::Host;
use crate::labelling::{LabelCommand, Labeller};
use pilotage_jobs::ExportOrder;

/// Name of a picture, its size in pixels, and its number in the flight.
type LabelledFrame = (String, (u32, u32), usize);

impl App {
    pub(super) fn label(&mut self, command: LabelCommand, host: &mut dyn Host) {
        match command {
            LabelCommand::Toggle => self.toggle_labelling(),
            LabelCommand::Export(format) => self.export_labels(host, format),
            _ if self.views.labeller.is_none() => {}
            LabelCommand::Choose(rows) => self.choose_landmark(rows),
            LabelCommand::Propose => {
                let frame = self.labelled_frame();
                if let (Some(labeller), Some((.., frame)), Some(landmark)) =
                    (&mut self.views.labeller, frame, self.selection)
                {
                    labeller.ask(frame, landmark);
                }
            }
            LabelCommand::Accept => {
                let proposal = self
                    .views
                    .labeller
                    .as_ref()
                    .and_then(|l| l.proposal().cloned());
                if let Some((frame, label)) = proposal {
                    self.set_label(frame, label, true);
                }
            }
            LabelCommand::Set {
                frame,
                label,
                finished,
            } => self.set_label(frame, label, finished),
            LabelCommand::Delete | LabelCommand::MarkAbsent | LabelCommand::ToggleDifficult => {
                self.say_of_label(&command);
            }
        }
    }

    fn toggle_labelling(&mut self) {
        let is_shown = self.view.workspace == Workspace::Replay && self.views.labeller.is_some();
        if is_shown {
            self.views.labeller = None;
            return;
        }
        self.show_workspace(Workspace::Replay);
        self.playback.playing = false;
        self.views.labeller = Some(Labeller::default());
        let first = self.documents.mission.landmarks.first().map(|l| l.id);
        self.selection = self.selection.or(first);
    }

    fn choose_landmark(&mut self, rows: i32) {
        let landmarks = &self.documents.mission.landmarks;
        let at = landmarks.iter().position(|l| Some(l.id) == self.selection);
        let last = landmarks.len() as i64 - 1;
        let row = at
            .map_or(0, |at| at as i64 + i64::from(rows))
            .clamp(0, last.max(0));
        self.selection = landmarks.get(row as usize).map(|l| l.id);
    }

    /// The picture at the cursor.
    fn labelled_frame(&self) -> Option<LabelledFrame> {
        let flight = self.documents.flight.as_ref()?;
        self.frame_numbered(shown_frame(flight, self.playback.time)?)
    }

    fn frame_numbered(&self, frame: usize) -> Option<LabelledFrame> {
        let flight = self.documents.flight.as_ref()?;
        let size = (flight.camera.width as u32, flight.camera.height as u32);
        Some((flight.frames.get(frame)?.name.clone(), size, frame))
    }

    fn set_label(&mut self, frame: usize, label: LabelBox, finished: bool) {
        let Some((name, size, _)) = self.frame_numbered(frame) else {
            return;
        };
        let documents = &mut self.documents;
        documents.history.begin_drag(&documents.mission);
        documents.mission.set_label(&name, size, label);
        if finished {
            documents.history.finish_drag(&documents.mission);
        }
        self.labels_changed();
    }

    fn say_of_label(&mut self, command: &LabelCommand) {
        let (Some((name, size, _)), Some(landmark)) = (self.labelled_frame(), self.selection)
        else {
            return;
        };
        let documents = &mut self.documents;
        let before = documents.mission.clone();
        let mission = &mut documents.mission;
        match command {
            LabelCommand::MarkAbsent => mission.mark_absent(&name, size, landmark),
            LabelCommand::ToggleDifficult => {
                let own = mission.labels_of(&name).and_then(|l| l.of(landmark));
                if let Some(mut label) = own.cloned() {
                    label.difficult = !label.difficult;
                    mission.set_label(&name, size, label);
                }
            }
            _ => {
                mission.clear_label(&name, landmark);
            }
        }
        if *mission != before {
            documents.history.remember(&before);
            self.labels_changed();
        }
        if let Some(labeller) = &mut self.views.labeller {
            labeller.decline();
        }
    }

    fn labels_changed(&mut self) {
        self.documents.mission_edited = true;
        self.jobs.document_changed = true;
    }

    fn export_labels(&mut self, host: &mut dyn Host, format: LabelFormat) {
        let mission = &self.documents.mission;
        if mission.labels.is_empty() {
            let text = "Press K and drag boxes around landmarks in the pictures of a flight.";
            self.toasts.note(host.now(), "No labels to export", text);
            return;
        }
        let order = ExportOrder::Labels {
            format,
            frames: mission.labels.clone(),
            landmarks: mission.landmarks.clone(),
        };
        let name = format!("{}-{}", self.file_stem(), format.ending());
        let file = ExportedFile {
            what: "Labels",
            format: format.name(),
            name,
        };
        self.exports.make(file, order, host);
    }

    /// Adds the labels of opened files to the mission, as one step, and says what became of them.
    pub(super) fn add_labels(&mut self, now: f64, file: &str, found: FoundLabels) {
        let (frames, mut notes) = found.placed(&self.documents.mission.landmarks);
        if frames.is_empty() {
            let title = format!("No labels were added from {file}");
            let text = "None of them is of a landmark of the mission".to_owned();
            notes.insert(0, text);
            self.toasts.trouble(now, title, sentences(&notes));
            return;
        }
        let flown = self.documents.flight.iter().flat_map(|f| &f.frames);
        let flown: std::collections::BTreeSet<&str> = flown.map(|f| f.name.as_str()).collect();
        let others = frames.iter().filter(|f| !flown.contains(f.frame.as_str()));
        let others = others.count();
        if others > 0 {
            notes.push(format!(
                "{others} of the pictures are none of the flight that is open"
            ));
        }
        let boxes: usize = frames.iter().map(|f| f.boxes.len()).sum();
        let title = format!(
            "Added {boxes} labels in {} pictures from {file}",
            frames.len()
        );
        let documents = &mut self.documents;
        documents.history.remember(&documents.mission);
        documents.mission.add_labels(frames);
        self.labels_changed();
        self.toasts.note(now, title, sentences(&notes));
    }
}
