//! The list of landmarks, and what is known of the selected one.

use egui::{
    Rect, Role, Sense, TextEdit, TextureHandle, TextureOptions, Ui, WidgetInfo, pos2, vec2,
};
use pilotage_core::frames::GroundRect;
use pilotage_core::landmark::Landmark;

use super::heat_image::heat_image;
use super::landmark_row::landmark_row;
use super::rows_in_view::rows_in_view;
use crate::command::Command;
use crate::context::ViewContext;
use crate::shell::icons::Icon;
use crate::shell::{caption, chip, heading, icon_button, muted, text_button};
use pilotage_jobs::Distinctness;

/// Distinctness of the selected landmark, as far as it is known.
#[derive(Clone, Copy, Debug, Default)]
pub struct Examined<'a> {
    /// Distinctness of the landmark, once compared with the map around it.
    pub found: Option<&'a Distinctness>,
    /// Why it could not be compared.
    pub trouble: Option<&'a str>,
}

/// The list's own state: the name being typed and the heat picture of the selected landmark.
#[derive(Default)]
pub struct LandmarkList {
    draft: Option<(u32, String)>,
    heat: Option<(GroundRect, TextureHandle)>,
}

impl LandmarkList {
    /// Draws the selected landmark and, below, the list.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        examined: Examined<'_>,
        can_undo: (bool, bool),
    ) {
        let tokens = context.tokens;
        ui.horizontal(|ui| {
            heading(ui, tokens, "Landmarks");
            ui.label(muted(tokens, context.mission.landmarks.len().to_string()));
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                ui.spacing_mut().item_spacing.x = 0.0;
                for (icon, label, command, enabled) in [
                    (Icon::Redo, "Redo", Command::Redo, can_undo.1),
                    (Icon::Undo, "Undo", Command::Undo, can_undo.0),
                ] {
                    ui.add_enabled_ui(enabled, |ui| {
                        if icon_button(ui, tokens, icon, label).clicked() {
                            context.commands.push(command);
                        }
                    });
                }
                if text_button(ui, tokens, Some(Icon::Pick), "Draw", false).clicked() {
                    context.commands.push(Command::TogglePickTool);
                }
            });
        });
        if context.mission.landmarks.is_empty() {
            ui.add_space(tokens.space);
            ui.label(muted(
                tokens,
                tokens.advice(
                    "None yet. Press N and draw a box around something that stands out on the map: \
                     a lone building, a crossing, a pool.",
                    "None yet. Press the first button at the right of the map and draw a box around \
                     something that stands out: a lone building, a crossing, a pool.",
                ),
            ));
            return;
        }
        // The selected one first: what was just drawn is seen without scrolling.
        let selected = context
            .selection
            .and_then(|id| context.mission.landmark(id));
        if let Some(landmark) = selected {
            self.selected(ui, landmark, context, examined);
            ui.add_space(tokens.space);
        }
        ui.add_space(4.0);
        let landmarks = &context.mission.landmarks;
        rows_in_view(ui, landmarks.len(), tokens.target(), |ui, number| {
            let landmark = &landmarks[number];
            let is_selected = context.selection == Some(landmark.id);
            let row = landmark_row(ui, context, landmark, is_selected, &landmark.name, |row| {
                row.name(row.rect);
            });
            if row.clicked() {
                let chosen = (!is_selected).then_some(landmark.id);
                context.commands.push(Command::SelectLandmark(chosen));
            }
        });
    }

    /// Draws what is known of the selected landmark.
    pub(crate) fn selected(
        &mut self,
        ui: &mut Ui,
        landmark: &Landmark,
        context: &mut ViewContext<'_>,
        examined: Examined<'_>,
    ) {
        let tokens = context.tokens;
        let id = landmark.id;
        caption(ui, tokens, "Selected");
        ui.horizontal(|ui| {
            let draft = match &mut self.draft {
                Some((of, text)) if *of == id => text,
                other => &mut other.insert((id, landmark.name.clone())).1,
            };
            let width = ui.available_width() - 44.0;
            let field = ui
                .add(
                    TextEdit::singleline(draft)
                        .align(egui::Align2::LEFT_CENTER)
                        .desired_width(width),
                )
                .accessible_name("Name of the selected landmark");
            if field.lost_focus() {
                let name = draft.trim().to_owned();
                if !name.is_empty() {
                    context.commands.push(Command::RenameLandmark { id, name });
                }
                self.draft = None;
            } else if !field.has_focus() {
                self.draft = None;
            }
            if icon_button(ui, tokens, Icon::Trash, "Delete the landmark").clicked() {
                context.commands.push(Command::DeleteLandmark(id));
            }
        });
        let (factor, unit) = context.units.length();
        ui.label(muted(
            tokens,
            format!(
                "{:.1} × {:.1} {unit}. {}",
                landmark.bounds.width() * factor,
                landmark.bounds.height() * factor,
                tokens.advice(
                    "Arrows move the row's box, Shift with arrows resizes it.",
                    "Drag its box on the map to move it, or a corner to resize it.",
                ),
            ),
        ));
        ui.add_space(4.0);
        distinctness_card(ui, context, examined, &mut self.heat);
    }
}

/// Draws the distinctness of the selected landmark: a verdict, the surface around it, the strongest
/// look-alike.
fn distinctness_card(
    ui: &mut Ui,
    context: &ViewContext<'_>,
    examined: Examined<'_>,
    heat: &mut Option<(GroundRect, TextureHandle)>,
) {
    let tokens = context.tokens;
    caption(ui, tokens, "Look-alikes on this map");
    let Some(found) = examined.found else {
        let text = examined.trouble.map_or_else(
            || "Comparing it with the map around it …".to_owned(),
            |why| format!("It could not be compared with the map: {why}"),
        );
        ui.label(muted(tokens, text));
        return;
    };
    ui.horizontal_wrapped(|ui| {
        if found.flat {
            chip(ui, tokens, "flat", tokens.warning);
        }
        match found.look_alike {
            Some((_, score)) => {
                let most = context.mission.navigator.detector.greatest_ambiguity;
                let margin = most - score;
                let tone = match margin {
                    m if m < 0.0 => tokens.warning,
                    m if m < 0.15 => tokens.accent,
                    _ => tokens.muted,
                };
                chip(ui, tokens, &format!("margin {margin:.2}"), tone);
                chip(
                    ui,
                    tokens,
                    &format!("look-alike {score:.2}, refused from {most:.2}"),
                    tokens.muted,
                );
            }
            None => {
                chip(ui, tokens, "no look-alike", tokens.muted);
            }
        }
        chip(
            ui,
            tokens,
            &format!("contrast {:.0} of 255", found.contrast),
            tokens.muted,
        );
    });
    ui.label(egui::RichText::new(&found.verdict).color(tokens.text));
    if found.surface.is_empty() {
        return;
    }
    if heat.as_ref().is_none_or(|(of, _)| *of != found.bounds) {
        let image = heat_image(&found.surface);
        let texture = ui
            .ctx()
            .load_texture("distinctness", image, TextureOptions::LINEAR);
        *heat = Some((found.bounds, texture));
    }
    if let Some((_, texture)) = heat {
        heat_picture(ui, context, found, texture);
    }
}

fn heat_picture(
    ui: &mut Ui,
    context: &ViewContext<'_>,
    found: &Distinctness,
    texture: &TextureHandle,
) {
    let tokens = context.tokens;
    let width = ui.available_width();
    let aspect = found.surface.height() as f32 / found.surface.width() as f32;
    let height = (width * aspect).min(232.0);
    let (rect, response) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
    response.widget_info(|| {
        WidgetInfo::labeled(
            Role::Image,
            true,
            "Correlation of the box with the map around it",
        )
    });
    let picture = Rect::from_center_size(rect.center(), vec2(height / aspect, height));
    let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    let painter = ui.painter();
    painter.image(texture.id(), picture, uv, egui::Color32::WHITE);
    let ground = found.surface_rect;
    let at = |p: &pilotage_core::frames::GroundPoint| {
        let x = (p.east - ground.west) / ground.width().max(1e-9);
        let y = (ground.north - p.north) / ground.height().max(1e-9);
        picture.min + vec2(x as f32 * picture.width(), y as f32 * picture.height())
    };
    let own = at(&found.bounds.center());
    let light = egui::Stroke::new(1.5, tokens.sigma);
    painter.circle_stroke(own, 7.0, light);
    if let Some((place, _)) = &found.look_alike {
        let other = at(place);
        let square = Rect::from_center_size(other, vec2(12.0, 12.0));
        painter.rect_stroke(square, 0.0, light, egui::StrokeKind::Middle);
    }
    ui.label(muted(
        tokens,
        "Bright: the map looks like the box. Circle: the box itself. Square: its look-alike, marked on the map, too.",
    ));
}
