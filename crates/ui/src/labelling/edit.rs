//! Labels of pictures: edits, files.

use pilotage_core::exchange::labels::{FoundLabels, LabelFormat};
use pilotage_core::mission::LabelBox;
use pilotage_jobs::ExportOrder;

use super::LabelCommand;
use crate::context::shown_frame;
use crate::documents::Documents;
use crate::export_command::{ExportCommand, ExportedFile};
use crate::feature::FeatureContext;
use crate::host::stem;
use crate::shell::{counted, sentences};

/// Name of a picture, and its size in pixels.
type LabelledFrame = (String, (u32, u32));

/// Selects the landmark so many rows further down the list.
pub(super) fn choose_landmark(rows: i32, context: &mut FeatureContext<'_>) {
    let landmarks = &context.documents.mission.landmarks;
    let at = landmarks
        .iter()
        .position(|l| Some(l.id) == *context.selection);
    let last = landmarks.len() as i64 - 1;
    let row = at
        .map_or(0, |at| at as i64 + i64::from(rows))
        .clamp(0, last.max(0));
    *context.selection = landmarks.get(row as usize).map(|l| l.id);
}

/// Index of the frame at the cursor.
pub(super) fn frame_at_cursor(context: &FeatureContext<'_>) -> Option<usize> {
    let flight = context.documents.flight.measured.as_ref()?;
    shown_frame(flight, context.playback.time)
}

fn frame_numbered(documents: &Documents, frame: usize) -> Option<LabelledFrame> {
    let flight = documents.flight.measured.as_ref()?;
    let size = (flight.camera.width as u32, flight.camera.height as u32);
    Some((flight.frames.get(frame)?.name.clone(), size))
}

/// Puts a box into the picture of a frame; `finished` is false while a drag goes on.
pub(super) fn set_label(
    frame: usize,
    label: LabelBox,
    finished: bool,
    context: &mut FeatureContext<'_>,
) {
    let documents = &mut *context.documents;
    let Some((name, size)) = frame_numbered(documents, frame) else {
        return;
    };
    documents
        .mission
        .history
        .begin_drag(&documents.mission.content);
    documents.mission.set_label(&name, size, label);
    if finished {
        documents
            .mission
            .history
            .finish_drag(&documents.mission.content);
    }
    labels_changed(context);
}

/// Says something of the selected landmark in the picture at the cursor; whether there are both.
pub(super) fn say_of_label(command: &LabelCommand, context: &mut FeatureContext<'_>) -> bool {
    let frame = frame_at_cursor(context);
    let documents = &mut *context.documents;
    let frame = frame.and_then(|frame| frame_numbered(documents, frame));
    let (Some((name, size)), Some(landmark)) = (frame, *context.selection) else {
        return false;
    };
    let before = documents.mission.clone();
    let mission = &mut documents.mission.content;
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
        documents.mission.history.remember(&before);
        labels_changed(context);
    }
    true
}

fn labels_changed(context: &mut FeatureContext<'_>) {
    context.documents.mission.is_edited = true;
    context.document_changed();
}

/// Saves all labels as a file of other programs.
pub(super) fn export_labels(format: LabelFormat, context: &mut FeatureContext<'_>) {
    let mission = &context.documents.mission;
    if mission.labels.is_empty() {
        let text = "Press K and drag boxes around landmarks in the pictures of a flight.";
        return context.note("No labels to export", text);
    }
    let order = ExportOrder::Labels {
        format,
        frames: mission.labels.clone(),
        landmarks: mission.landmarks.clone(),
    };
    let file = ExportedFile {
        what: "Labels".to_owned(),
        format: format.name(),
        name: format!("{}-{}", stem(&mission.name), format.ending()),
    };
    context.ask(ExportCommand::File(Box::new((file, order))));
}

/// Adds the labels of opened files to the mission, as one step, and says what became of them.
pub(super) fn add_labels(file: &str, found: FoundLabels, context: &mut FeatureContext<'_>) {
    let documents = &mut *context.documents;
    let (frames, mut notes) = found.placed(&documents.mission.landmarks);
    if frames.is_empty() {
        let title = format!("No labels were added from {file}");
        let text = "None of them is of a landmark of the mission".to_owned();
        notes.insert(0, text);
        return context.trouble(&title, sentences(&notes));
    }
    let flown = documents.flight.measured.iter().flat_map(|f| &f.frames);
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
        "Added {} in {} from {file}",
        counted(boxes, "label", "labels"),
        counted(frames.len(), "picture", "pictures")
    );
    documents.mission.remember();
    documents.mission.add_labels(frames);
    labels_changed(context);
    context.note(&title, sentences(&notes));
}
