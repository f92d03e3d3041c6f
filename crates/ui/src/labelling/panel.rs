//! The landmarks beside the picture: which one is labelled, and how many labels each has.

use egui::{Align2, Rect, Role, Sense, Ui, WidgetInfo, pos2, vec2};
use pilotage_core::exchange::labels::LabelFormat;
use pilotage_core::flight::Flight;

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
        for (row, landmark) in context.mission.landmarks.iter().enumerate() {
            let (boxes, without) = context.mission.label_counts(&identity, landmark.id);
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
