//! The column beside picture and map: what to do next, the points, the fit and its errors.

use egui::{TextEdit, Ui};
use pilotage_core::imagery::georeferencer::TransformKind;

use super::coordinates::{Typed, parse};
use super::state::Pending;
use super::{GeoreferenceCommand, Georeferencer};
use crate::command::Command;
use crate::shell::icons::Icon;
use crate::shell::{caption, heading, icon_button, is_entered, muted, tab, text_button, title};
use crate::tokens::Tokens;
use crate::units::Units;
use crate::web_map::WebMapCommand;

/// Widths of the table's columns: number and switch, pixels, length, left out, button.
const COLUMNS: [f32; 5] = [44.0, 64.0, 72.0, 72.0, 32.0];

fn send(commands: &mut Vec<Command>, command: GeoreferenceCommand) {
    commands.push(Command::from(command));
}

/// Room for the button that adds the place which was typed, points.
const ADD_BUTTON: f32 = 104.0;

impl Georeferencer {
    /// Draws the column.
    pub fn panel(
        &mut self,
        ui: &mut Ui,
        tokens: &Tokens,
        units: Units,
        commands: &mut Vec<Command>,
    ) {
        if title(ui, tokens, "Georeference picture") {
            send(commands, GeoreferenceCommand::Close);
        }
        ui.label(muted(tokens, self.next_step(tokens)));
        ui.add_space(tokens.space);
        self.coordinates(ui, tokens);
        self.offer_map(ui, tokens, commands);
        self.list_of_places(ui, tokens);
        ui.add_space(tokens.space);
        caption(ui, tokens, "Transform");
        ui.horizontal(|ui| {
            for kind in TransformKind::ALL {
                if tab(ui, tokens, kind.name(), kind == self.kind, 28.0).clicked() {
                    self.set_kind(kind);
                }
            }
        });
        ui.label(muted(tokens, kind_words(self.kind)));
        ui.add_space(tokens.space);
        self.errors(ui, tokens, units);
        ui.add_space(tokens.space);
        self.table(ui, tokens, units);
        ui.add_space(tokens.space);
        self.buttons(ui, tokens, commands);
    }

    fn next_step(&self, tokens: &Tokens) -> String {
        match (self.pending.pixel, self.pending.place) {
            (Some(_), None) => {
                let by_mouse = "Now click the same place on the map, or type its coordinates.";
                let by_finger = "Now tap the same place on the map, or type its coordinates.";
                tokens.advice(by_mouse, by_finger).to_owned()
            }
            (None, Some(_)) => {
                let by_mouse = "Now click the same place in the picture.";
                let by_finger = "Now tap the same place in the picture.";
                tokens.advice(by_mouse, by_finger).to_owned()
            }
            _ => {
                let how = tokens.advice(
                    "Click a place in the picture, then the same on the map or its coordinates below. By keyboard, \
                     arrows move what has the focus, and Enter picks its middle.",
                    "Tap a place in the picture, then the same on the map or type its coordinates below.",
                );
                let needed = self.kind.least_points();
                format!("{how} {needed} points are needed; more show how good they are.")
            }
        }
    }

    fn coordinates(&mut self, ui: &mut Ui, tokens: &Tokens) {
        caption(ui, tokens, "Coordinates of the place");
        ui.horizontal(|ui| {
            let width = (ui.available_width() - ADD_BUTTON).max(80.0);
            let field = TextEdit::singleline(&mut self.typed)
                .align(egui::Align2::LEFT_CENTER)
                .desired_width(width)
                .hint_text("46.8571, -92.0765");
            let field = ui.add(field).accessible_name("Coordinates of the place");
            let entered = is_entered(&field);
            let pressed = text_button(ui, tokens, None, "Add point", false).clicked();
            if field.changed() {
                self.typed_wrong = None;
            }
            if (entered || pressed) && !self.typed.trim().is_empty() {
                match parse(&self.typed, self.system) {
                    Ok(Typed::Globe(at)) => self.pick_globe(&at),
                    Ok(Typed::Plane(place)) => self.pick_place(place),
                    Err(why) => self.typed_wrong = Some(why),
                }
            }
        });
        if let Some(why) = &self.typed_wrong {
            ui.label(muted(tokens, why.clone()).color(tokens.warning));
        } else if let Some(system) = self.system {
            ui.label(muted(
                tokens,
                format!("Coordinates in metres are those of {}.", system.name()),
            ));
        }
    }

    /// Offers a map of where the picture lies, while the open one is of another country.
    fn offer_map(&self, ui: &mut Ui, tokens: &Tokens, commands: &mut Vec<Command>) {
        let place = self.far_from_map().and_then(|_| self.somewhere());
        if let Some(place) = place
            && text_button(ui, tokens, None, "Map from the web here…", false).clicked()
        {
            commands.push(WebMapCommand::BeginAt(place).into());
        }
    }

    fn list_of_places(&mut self, ui: &mut Ui, tokens: &Tokens) {
        if self.places.is_empty() {
            return;
        }
        ui.add_space(tokens.space);
        caption(ui, tokens, "Places of the opened file");
        let mut taken = None;
        egui::ScrollArea::vertical()
            .id_salt("places")
            .max_height(96.0)
            .show(ui, |ui| {
                for place in &self.places {
                    if ui.button(&place.name).clicked() {
                        taken = Some(place.at);
                    }
                }
            });
        if let Some(at) = taken {
            self.pick_globe(&at);
        }
    }

    fn errors(&self, ui: &mut Ui, tokens: &Tokens, units: Units) {
        let (factor, unit) = units.length();
        let fit = match self.fitted() {
            Ok(fit) => fit,
            Err(why) => {
                let on = self.points.iter().filter(|point| point.enabled).count();
                let needed = self.kind.least_points();
                let words = if on < needed {
                    format!("{on} of {needed} points set.")
                } else {
                    format!("No fit: {why}.")
                };
                ui.label(muted(tokens, words));
                return;
            }
        };
        if self.is_exact() {
            let text = format!(
                "{} points always fit a transform of this kind: nothing is checked yet. One point more shows how far a \
                 place between them may be off.",
                self.kind.least_points()
            );
            ui.label(muted(tokens, text).color(tokens.warning));
            return;
        }
        heading(
            ui,
            tokens,
            &format!(
                "RMS {} px, {} {unit}",
                hundredths(fit.rms_in_pixels),
                hundredths(fit.rms_in_plane * factor)
            ),
        );
        let left_out = fit.rms_left_out.map_or_else(
            || "More points, apart from each other, would show how far a place between them may be off.".to_owned(),
            |rms| format!("Each point left out of its own fit: RMS {} {unit}. That is what to expect between the points.", hundredths(rms * factor)),
        );
        ui.label(muted(tokens, left_out));
    }

    fn table(&mut self, ui: &mut Ui, tokens: &Tokens, units: Units) {
        if self.points.is_empty() {
            return;
        }
        let (factor, unit) = units.length();
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 0.0;
            let heads = [
                "Point".to_owned(),
                "px".to_owned(),
                unit.to_owned(),
                format!("left out, {unit}"),
            ];
            for (width, head) in COLUMNS.into_iter().zip(heads) {
                cell(ui, width, |ui| ui.label(muted(tokens, head)));
            }
        });
        let mut switched = None;
        let mut deleted = None;
        for index in 0..self.points.len() {
            let residual = self
                .fitted()
                .as_ref()
                .ok()
                .and_then(|fit| fit.residuals.get(index).copied());
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 0.0;
                cell(ui, COLUMNS[0], |ui| {
                    let mut on = self.points[index].enabled;
                    let number = (index + 1).to_string();
                    let check = ui.checkbox(&mut on, &number);
                    if check.accessible_name(format!("Point {number}")).changed() {
                        switched = Some((index, on));
                    }
                });
                let residual =
                    residual.filter(|_| !(self.points[index].enabled && self.is_exact()));
                let numbers = [
                    residual.and_then(|r| r.in_pixels).map(|r| r.norm()),
                    residual.map(|r| r.in_plane.norm() * factor),
                    residual.and_then(|r| r.left_out).map(|r| r.norm() * factor),
                ];
                for (width, number) in COLUMNS[1..4].iter().zip(numbers) {
                    let text = number
                        .filter(|v| v.is_finite())
                        .map_or("–".to_owned(), |v| format!("{v:.2}"));
                    cell(ui, *width, |ui| {
                        ui.label(
                            egui::RichText::new(text)
                                .font(tokens.small())
                                .color(tokens.text),
                        )
                    });
                }
                let label = format!("Delete point {}", index + 1);
                if icon_button(ui, tokens, Icon::Close, &label).clicked() {
                    deleted = Some(index);
                }
            });
        }
        if let Some((index, on)) = switched {
            self.edit(|points| points[index].enabled = on);
        }
        if let Some(index) = deleted {
            self.edit(|points| {
                points.remove(index);
            });
            self.chosen = None;
        }
    }

    fn buttons(&mut self, ui: &mut Ui, tokens: &Tokens, commands: &mut Vec<Command>) {
        let fits = self.fitted().is_ok();
        let holds = fits && self.kind != TransformKind::Projective;
        ui.add_enabled_ui(fits, |ui| {
            if text_button(ui, tokens, None, "Use as the map", true).clicked() {
                send(commands, GeoreferenceCommand::UseAsMap);
            }
        });
        ui.horizontal_wrapped(|ui| {
            ui.add_enabled_ui(holds, |ui| {
                if text_button(ui, tokens, None, "Save world file", false).clicked() {
                    send(commands, GeoreferenceCommand::SaveWorldFile);
                }
            });
            ui.add_enabled_ui(!self.points.is_empty(), |ui| {
                if text_button(ui, tokens, None, "Save points", false).clicked() {
                    send(commands, GeoreferenceCommand::SavePoints);
                }
            });
            if text_button(ui, tokens, None, "Load…", false).clicked() {
                send(commands, GeoreferenceCommand::Load);
            }
        });
        if fits && !holds {
            ui.label(muted(
                tokens,
                "No world file can hold a projective transform; save the points.",
            ));
        }
        ui.horizontal(|ui| {
            let (past, future) = self.depth();
            let is_picking = self.pending != Pending::default();
            ui.add_enabled_ui(past > 0 || is_picking, |ui| {
                if icon_button(ui, tokens, Icon::Undo, "Undo").clicked() {
                    self.undo();
                }
            });
            ui.add_enabled_ui(future > 0, |ui| {
                if icon_button(ui, tokens, Icon::Redo, "Redo").clicked() {
                    self.redo();
                }
            });
        });
        let text = "Load… reads QGIS .points, and places from KML, GPX or GeoJSON.";
        ui.add(egui::Label::new(muted(tokens, text)).wrap());
    }
}

/// A cell of the table.
fn cell<R>(ui: &mut Ui, width: f32, contents: impl FnOnce(&mut Ui) -> R) {
    let size = egui::vec2(width, 24.0);
    let layout = egui::Layout::left_to_right(egui::Align::Center);
    ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.set_min_width(width);
        contents(ui);
    });
}

/// A kind of transform in words.
fn kind_words(kind: TransformKind) -> &'static str {
    match kind {
        TransformKind::Similarity => {
            "Moved, turned and scaled: for a picture that looks straight down."
        }
        TransformKind::Affine => "Also stretched and skewed: for a scan or an orthophoto.",
        TransformKind::Projective => {
            "Also in perspective: for flat ground that is seen from the side."
        }
    }
}

/// An error to two decimals; a lesser one is not said to be none.
fn hundredths(error: f64) -> String {
    if error < 0.005 {
        "under 0.01".to_owned()
    } else {
        format!("{error:.2}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_error_is_not_said_to_be_none() {
        assert_eq!(hundredths(0.04), "0.04");
        assert_eq!(hundredths(0.0004), "under 0.01");
    }
}
