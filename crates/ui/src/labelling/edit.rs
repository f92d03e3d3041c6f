//! Labels of pictures: edits, files.

use pilotage_core::exchange::labels::{FoundLabels, LabelFormat};
use pilotage_core::mission::{LabelBox, LabelledPicture};
use pilotage_jobs::ExportOrder;

use super::LabelCommand;
use crate::context::shown_frame;
use crate::documents::Documents;
use crate::export_command::{ExportCommand, ExportedFile};
use crate::feature::FeatureContext;
use crate::host::stem;
use crate::shell::{counted, sentences};

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

fn picture_of(documents: &Documents, frame: usize) -> Option<LabelledPicture> {
    let flight = documents.flight.measured.as_ref()?;
    Some(LabelledPicture {
        flight: flight.identity(),
        frame: flight.frames.get(frame)?.name.clone(),
        size: (flight.camera.width as u32, flight.camera.height as u32),
    })
}

/// Puts a box into the picture of a frame; `finished` is false while a drag goes on.
pub(super) fn set_label(
    frame: usize,
    label: LabelBox,
    finished: bool,
    context: &mut FeatureContext<'_>,
) {
    let documents = &mut *context.documents;
    let Some(picture) = picture_of(documents, frame) else {
        return;
    };
    documents
        .mission
        .history
        .begin_drag(&documents.mission.content);
    let labels = documents.mission.labels_of(&picture.flight, &picture.frame);
    let had_outline =
        (labels.and_then(|l| l.of(label.landmark))).is_some_and(LabelBox::has_outline);
    let loses_outline = had_outline && !label.has_outline();
    documents.mission.set_label(&picture, label);
    if finished {
        documents
            .mission
            .history
            .finish_drag(&documents.mission.content);
    }
    labels_changed(context);
    if loses_outline {
        let text = "It was that of the box as the file had it. Undo brings both back.";
        context.note("The label's outline is left out", text);
    }
}

/// Says something of the selected landmark in the picture at the cursor; whether there are both.
pub(super) fn say_of_label(command: &LabelCommand, context: &mut FeatureContext<'_>) -> bool {
    let frame = frame_at_cursor(context);
    let documents = &mut *context.documents;
    let frame = frame.and_then(|frame| picture_of(documents, frame));
    let (Some(picture), Some(landmark)) = (frame, *context.selection) else {
        return false;
    };
    let before = documents.mission.clone();
    let mission = &mut documents.mission.content;
    match command {
        LabelCommand::MarkAbsent => mission.mark_absent(&picture, landmark),
        LabelCommand::ToggleDifficult => {
            let labels = mission.labels_of(&picture.flight, &picture.frame);
            let labels = labels.map(|l| l.at_size(picture.size));
            let own = labels.as_ref().and_then(|l| l.of(landmark));
            if let Some(mut label) = own.cloned() {
                label.difficult = !label.difficult;
                mission.set_label(&picture, label);
            }
        }
        LabelCommand::Delete => {
            mission.clear_label(&picture.flight, &picture.frame, landmark);
        }
        LabelCommand::Toggle
        | LabelCommand::Choose(_)
        | LabelCommand::Propose
        | LabelCommand::Accept
        | LabelCommand::Set { .. }
        | LabelCommand::Export(_) => return false,
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
    let (mut frames, mut notes) = found.placed(&documents.mission.landmarks);
    if frames.is_empty() {
        let title = format!("No labels were added from {file}");
        let text = "None of them is of a landmark of the mission".to_owned();
        notes.insert(0, text);
        return context.trouble(&title, sentences(&notes));
    }
    let flight = documents.flight.measured.as_ref();
    let identity = flight.map(pilotage_core::flight::Flight::identity);
    let identity = identity.unwrap_or_default();
    let flown = flight.into_iter().flat_map(|f| &f.frames);
    let flown: std::collections::BTreeSet<&str> = flown.map(|f| f.name.as_str()).collect();
    let mut others = 0;
    for labels in &mut frames {
        if flown.contains(labels.frame.as_str()) && labels.is_of(&identity) {
            labels.flight.clone_from(&identity);
        } else {
            others += 1;
        }
    }
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
