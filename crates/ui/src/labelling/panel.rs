//! The landmarks beside the picture: which one is labelled, and how many labels each has.

use std::collections::BTreeMap;

use egui::{Align2, Rect, Role, Sense, Ui, WidgetInfo, pos2, vec2};
use pilotage_core::exchange::labels::LabelFormat;
use pilotage_core::flight::Flight;
use pilotage_core::mission::{LabelBox, Mission};

use super::{LabelCommand, Labeller, color, said_of};
use crate::command::Command;
use crate::context::ViewContext;
use crate::shell::icons::Icon;
use crate::shell::{caption, counted, icon_button, muted, paint_focus_ring, text_button, title};

impl Labeller {
    /// Draws what can be said of the picture, and the list of landmarks.
    pub fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, can_undo: (bool, bool)) {
        let tokens = context.tokens;
        let mut commands = Vec::new();
        if title(ui, tokens, "Label pictures") {
            commands.push(Command::from(LabelCommand::Toggle));
        }
        ui.horizontal(|ui| {
            let frame = context.shown_frame();
            let frames = context.flight.map_or(0, |f| f.frames.len());
            let number = frame.map_or(0, |i| i + 1);
            for (icon, label, step) in [
                (Icon::StepBack, "Previous picture (←)", -1),
                (Icon::StepForward, "Next picture (→)", 1),
            ] {
                if icon_button(ui, tokens, icon, label).clicked() {
                    commands.push(Command::StepFrames(step));
                }
            }
            let name = context
                .flight
                .zip(frame)
                .map(|(f, i)| f.frames[i].name.as_str());
            ui.label(format!("{number} of {frames}"));
            ui.label(muted(tokens, name.unwrap_or_default()));
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                ui.spacing_mut().item_spacing.x = 0.0;
                for (icon, label, command, on) in [
                    (Icon::Redo, "Redo", Command::Redo, can_undo.1),
                    (Icon::Undo, "Undo", Command::Undo, can_undo.0),
                ] {
                    ui.add_enabled_ui(on, |ui| {
                        if icon_button(ui, tokens, icon, label).clicked() {
                            commands.push(command);
                        }
                    });
                }
            });
        });
        ui.add_space(tokens.space);
        if context.mission.landmarks.is_empty() {
            let text = "The mission has no landmarks yet. Draw some on the map first.";
            ui.label(muted(tokens, text));
        } else {
            Self::rows(ui, context, &mut commands);
            ui.add_space(tokens.space);
            self.actions(ui, context, &mut commands);
        }
        ui.add_space(tokens.space);
        caption(ui, tokens, "Files");
        ui.horizontal_wrapped(|ui| {
            for (label, format, hint) in [
                (
                    "Save COCO",
                    LabelFormat::Coco,
                    "All labels as one JSON file",
                ),
                (
                    "Save Pascal VOC",
                    LabelFormat::Voc,
                    "An XML file for each picture, in a zip",
                ),
            ] {
                let button = text_button(ui, tokens, Some(Icon::Save), label, false);
                if button.on_hover_text(hint).clicked() {
                    commands.push(Command::from(LabelCommand::Export(format)));
                }
            }
        });
        ui.label(muted(
            tokens,
            "Drop such a file here to add its labels: landmarks are found by their names.",
        ));
        context.commands.append(&mut commands);
    }

    fn rows(ui: &mut Ui, context: &ViewContext<'_>, commands: &mut Vec<Command>) {
        let tokens = context.tokens;
        let labels = context.shown_frame().and_then(|i| said_of(context, i));
        let identity = context.flight.map(Flight::identity).unwrap_or_default();
        ui.horizontal(|ui| {
            caption(ui, tokens, "Landmark");
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                caption(ui, tokens, "Boxes · without");
            });
        });
        let counts = counts(context.mission, &identity);
        for (row, landmark) in context.mission.landmarks.iter().enumerate() {
            let (boxes, without) = counts.get(&landmark.id).copied().unwrap_or_default();
            let is_chosen = context.selection == Some(landmark.id);
            let said = match &labels {
                Some(l) if l.of(landmark.id).is_some() => "labelled here",
                Some(l) if l.lacks(landmark.id) => "not in this picture",
                _ => "",
            };
            let size = vec2(ui.available_width(), 26.0);
            let (rect, response) = ui.allocate_exact_size(size, Sense::click());
            let name = landmark.name.as_str();
            let text = format!(
                "{name}: {}, {without} without. {said}",
                counted(boxes, "box", "boxes")
            );
            response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_chosen, &text));
            let painter = ui.painter_at(rect);
            if is_chosen || response.hovered() {
                let fill = if is_chosen {
                    tokens.raised
                } else {
                    tokens.hover()
                };
                painter.rect_filled(rect, tokens.radius, fill);
            }
            let swatch =
                Rect::from_center_size(pos2(rect.left() + 14.0, rect.center().y), vec2(12.0, 12.0));
            painter.rect_filled(swatch, 2.0, color(row));
            let middle = rect.center().y;
            let written = painter.text(
                pos2(rect.left() + 28.0, middle),
                Align2::LEFT_CENTER,
                name,
                tokens.normal(),
                tokens.text,
            );
            painter.text(
                pos2(written.right() + 8.0, middle),
                Align2::LEFT_CENTER,
                said,
                tokens.small(),
                tokens.muted,
            );
            painter.text(
                pos2(rect.right() - 8.0, middle),
                Align2::RIGHT_CENTER,
                format!("{boxes} · {without}"),
                tokens.normal(),
                tokens.text,
            );
            if response.has_focus() {
                paint_focus_ring(&painter, rect, tokens);
            }
            if response
                .on_hover_text("Label this landmark (↑ ↓)")
                .clicked()
            {
                commands.push(Command::SelectLandmark(Some(landmark.id)));
            }
        }
        for words in context.mission.told_of_labels(&identity) {
            ui.label(muted(tokens, words));
        }
    }

    fn actions(&mut self, ui: &mut Ui, context: &ViewContext<'_>, commands: &mut Vec<Command>) {
        let tokens = context.tokens;
        let Some(landmark) = context
            .selection
            .and_then(|id| context.mission.landmark(id))
        else {
            ui.label(muted(
                tokens,
                "Choose a landmark, then drag a box around it in the picture.",
            ));
            return;
        };
        let frame = context.shown_frame();
        let labels = frame.and_then(|i| said_of(context, i));
        let is_labelled = labels.as_ref().is_some_and(|l| l.of(landmark.id).is_some());
        let is_said = labels.is_some_and(|l| l.tells_of(landmark.id));
        caption(ui, tokens, "In this picture");
        let buttons = [
            (
                "Propose",
                "Where the pose of the picture sees the landmark (Q)",
                LabelCommand::Propose,
                !is_said,
            ),
            (
                "Take it",
                "Make the proposal the label (Enter)",
                LabelCommand::Accept,
                self.proposal.is_some(),
            ),
            (
                "Not in it",
                "The landmark is certainly not in this picture (O)",
                LabelCommand::MarkAbsent,
                true,
            ),
            (
                "Hard to see",
                "Mark the label as hard to see, or not (Y)",
                LabelCommand::ToggleDifficult,
                is_labelled,
            ),
            (
                "Delete",
                "Take away what is said of the landmark here (Delete)",
                LabelCommand::Delete,
                is_said,
            ),
        ];
        for row in buttons.chunks(3) {
            ui.horizontal(|ui| {
                for (label, hint, command, on) in row {
                    ui.add_enabled_ui(*on, |ui| {
                        let button = text_button(ui, tokens, None, label, false);
                        if button.on_hover_text(*hint).clicked() {
                            commands.push(Command::from(command.clone()));
                        }
                    });
                }
            });
        }
        let asked = frame.map(|index| (index, landmark.id));
        if !is_said && self.proposal.is_none() && asked.is_some() && self.asked == asked {
            let text = "No proposal: the pose of the picture does not see the landmark in it.";
            ui.label(muted(tokens, text));
        }
        ui.checkbox(&mut self.always, "Propose in every picture")
            .on_hover_text("Then → and Enter label picture after picture");
        let text = "Drag: box. Drag inside: move. Drag an edge: size. Alt with arrows: one pixel, \
            with Shift the size. Wheel: nearer. Right drag: shift.";
        ui.label(muted(tokens, text));
    }
}

/// Pictures of a flight with a box of each landmark, and those that are marked as without it: all labels are gone through
/// once.
fn counts(mission: &Mission, flight: &str) -> BTreeMap<u32, (usize, usize)> {
    let mut counts: BTreeMap<u32, (usize, usize)> = BTreeMap::new();
    for labels in mission.labels.iter().filter(|it| it.is_of(flight)) {
        for (index, label) in labels.boxes.iter().enumerate() {
            let is_first = |other: &LabelBox| other.landmark != label.landmark;
            if labels.boxes[..index].iter().all(is_first) {
                counts.entry(label.landmark).or_default().0 += 1;
            }
        }
        for (index, landmark) in labels.absent.iter().enumerate() {
            if !labels.absent[..index].contains(landmark) {
                counts.entry(*landmark).or_default().1 += 1;
            }
        }
    }
    counts
}

#[cfg(test)]
mod tests {
    use pilotage_core::mission::FrameLabels;

    use super::*;
    use crate::documents::empty_mission;

    #[test]
    fn all_landmarks_are_counted_at_once_as_each_by_itself() {
        let picture = |flight: &str, number: u32| FrameLabels {
            flight: flight.to_owned(),
            frame: format!("{number}.jpg"),
            size: (640, 480),
            boxes: [1, 2, 2]
                .into_iter()
                .filter(|id| number.is_multiple_of(*id))
                .filter_map(|id| LabelBox::new(id, "", [[10.0; 2], [60.0; 2]], (640, 480)))
                .collect(),
            absent: vec![3, 3 + number % 2],
            ..FrameLabels::default()
        };
        let mut mission = empty_mission();
        for number in 0..12 {
            let flight = ["here", "there", ""][number as usize % 3];
            mission.labels.push(picture(flight, number));
        }
        let counts = counts(&mission, "here");
        for id in 0..6 {
            let counted = counts.get(&id).copied().unwrap_or_default();
            assert_eq!(counted, mission.label_counts("here", id), "{id}");
        }
        assert!(counts[&2].0 > 0 && counts[&3].1 > 0);
    }
}
