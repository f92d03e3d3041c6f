//! Buttons, legend and the naming field that float on the map.

use egui::{
    Align2, Frame, Key, Rect, Role, ScrollArea, Sense, Stroke, TextEdit, Ui, UiBuilder, WidgetInfo,
    pos2, vec2,
};

use super::button::MapButton;
use super::layers::Layer;
use super::transform::ScreenFromWorld;
use super::view::MapView;
use crate::command::Command;
use crate::context::ViewContext;
use crate::shell::icons::Icon;
use crate::shell::{icon_button, icon_toggle};

/// Height below the buttons that they leave to the map's scale, points.
const BELOW_CONTROLS: f32 = 52.0;

impl MapView {
    /// The buttons at the right edge.
    pub(super) fn controls(
        &mut self,
        ui: &mut Ui,
        rect: Rect,
        buttons: &[MapButton],
        context: &mut ViewContext<'_>,
    ) {
        let tokens = context.tokens;
        let room = rect.height() - 16.0 - BELOW_CONTROLS;
        let at = Rect::from_min_size(
            pos2(rect.right() - 24.0 - tokens.target(), rect.top() + 16.0),
            vec2(tokens.target() + 8.0, room.max(tokens.target())),
        );
        let mut ui = ui.new_child(UiBuilder::new().max_rect(at).id_salt("map controls"));
        let panel = Frame::new()
            .fill(tokens.over_map())
            .stroke(Stroke::new(1.0, tokens.line))
            .corner_radius(tokens.radius)
            .inner_margin(3)
            .show(&mut ui, |ui| {
                ui.spacing_mut().item_spacing.y = 0.0;
                // On a low map they scroll, so that each can be reached.
                ScrollArea::vertical()
                    .id_salt("map controls")
                    .show(ui, |ui| {
                        if icon_toggle(ui, tokens, Icon::Pick, "Draw a landmark", self.picking)
                            .clicked()
                        {
                            context.commands.push(Command::TogglePickTool);
                        }
                        if icon_button(ui, tokens, Icon::Plus, "Zoom in").clicked() {
                            self.zoom(rect, 1.5, rect.center());
                        }
                        if icon_button(ui, tokens, Icon::Minus, "Zoom out").clicked() {
                            self.zoom(rect, 1.0 / 1.5, rect.center());
                        }
                        if icon_button(
                            ui,
                            tokens,
                            Icon::Fit,
                            if self.planning {
                                "Show the whole plan"
                            } else {
                                "Show the whole flight"
                            },
                        )
                        .clicked()
                        {
                            context.commands.push(Command::FitMap);
                        }
                        if self.planning {
                            // Nothing flies while people plan.
                        } else if icon_toggle(
                            ui,
                            tokens,
                            Icon::Follow,
                            "Follow the aircraft",
                            self.follow,
                        )
                        .clicked()
                        {
                            context.commands.push(Command::ToggleFollow);
                        }
                        for MapButton {
                            icon,
                            label,
                            command,
                            is_on,
                        } in buttons
                        {
                            if icon_toggle(ui, tokens, *icon, label, *is_on).clicked() {
                                context.commands.push(command.clone());
                            }
                        }
                        self.compass(ui, context);
                    });
            });
        self.cover(panel.response.rect);
    }

    /// The north arrow; a click turns the map with the track or north up again.
    fn compass(&self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        let (rect, response) = ui.allocate_exact_size(
            vec2(tokens.target(), tokens.target().max(36.0)),
            Sense::click(),
        );
        let label = if self.track_up {
            "Track up. Change to north up"
        } else {
            "North up. Change to track up"
        };
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, self.track_up, label));
        if response.gained_focus() {
            response.scroll_to_me(None);
        }
        let painter = ui.painter();
        if response.hovered() || response.has_focus() || self.track_up {
            painter.rect_filled(rect.shrink(2.0), tokens.radius, tokens.hover());
        }
        let angle = -self.camera.up as f32;
        let (sin, cos) = angle.sin_cos();
        let center = rect.center();
        let turned = |x: f32, y: f32| center + vec2(x * cos - y * sin, x * sin + y * cos);
        let north = vec![turned(0.0, -12.0), turned(4.5, 0.0), turned(-4.5, 0.0)];
        let south = vec![turned(0.0, 12.0), turned(-4.5, 0.0), turned(4.5, 0.0)];
        painter.add(egui::Shape::convex_polygon(
            north,
            tokens.corrected,
            Stroke::NONE,
        ));
        painter.add(egui::Shape::convex_polygon(
            south,
            tokens.muted,
            Stroke::NONE,
        ));
        if response.on_hover_text(label).clicked() {
            context.commands.push(Command::ToggleTrackUp);
        }
    }

    /// The legend at the bottom left.
    pub(super) fn legend(&mut self, ui: &mut Ui, rect: Rect, context: &ViewContext<'_>) {
        let (planning, has_recorded) = (self.planning, self.has_recorded);
        let present = |layer: Layer| match layer {
            Layer::Truth => context.flight.is_some_and(|f| f.truth.is_some()),
            Layer::Recorded => has_recorded,
            Layer::Ghost => context.ghost.is_some(),
            Layer::Landmarks => !context.mission.landmarks.is_empty(),
            Layer::Roads => !context.mission.roads.is_empty(),
            Layer::Sighted => context.run.is_some_and(super::sightings::has_aids_that_see),
            Layer::Route | Layer::Corridor => planning && !context.mission.routes.is_empty(),
            _ => context.run.is_some(),
        };
        let rows = Layer::ALL.into_iter().filter(|l| present(*l)).count();
        let size = self.layers.legend_size(rows);
        let corner = rect.left_bottom() + vec2(16.0, -16.0);
        let at = Align2::LEFT_BOTTOM.anchor_size(corner, size);
        self.cover(at);
        let mut ui = ui.new_child(UiBuilder::new().max_rect(at).id_salt("legend"));
        let name = |layer: Layer| match layer {
            Layer::Truth if context.is_recorded => "Recorded track",
            _ => layer.label(),
        };
        self.layers.legend(&mut ui, context.tokens, |layer| {
            present(layer).then(|| name(layer))
        });
    }

    /// The field that names a landmark in place.
    pub(super) fn naming_field(
        &mut self,
        ui: &mut Ui,
        view: &ScreenFromWorld,
        rect: Rect,
        context: &mut ViewContext<'_>,
    ) {
        let Some(landmark) = self.naming.and_then(|id| context.mission.landmark(id)) else {
            self.naming = None;
            return;
        };
        let corners = view.corners(&landmark.bounds);
        let below = Rect::from_points(&corners).center_bottom() + vec2(0.0, 12.0);
        let size = vec2(208.0, 36.0);
        let mut at = Align2::CENTER_TOP.anchor_size(below, size);
        at = at.translate(vec2(
            (rect.left() + 8.0 - at.left()).max(0.0) - (at.right() - rect.right() + 8.0).max(0.0),
            -(at.bottom() - rect.bottom() + 8.0).max(0.0),
        ));
        let mut ui = ui.new_child(UiBuilder::new().max_rect(at).id_salt("naming"));
        Frame::new()
            .fill(context.tokens.raised)
            .stroke(Stroke::new(1.0, context.tokens.accent))
            .corner_radius(context.tokens.radius)
            .inner_margin(4)
            .show(&mut ui, |ui| {
                let letters = self.name_draft.chars().count();
                let mut output = TextEdit::singleline(&mut self.name_draft)
                    .desired_width(192.0)
                    .hint_text("Name")
                    .show(ui);
                let field = output.response.response.clone();
                let field = field.accessible_name("Name of the landmark");
                if !field.has_focus() && !field.lost_focus() {
                    field.request_focus();
                    // Whoever types a name replaces the one that was made up.
                    let [start, end] = [0, letters].map(egui::text::CCursor::new);
                    let all = egui::text::CCursorRange::two(start, end);
                    output.state.cursor.set_char_range(Some(all));
                    output.state.store(ui.ctx(), field.id);
                }
                let escape = ui.input(|i| i.key_pressed(Key::Escape));
                if field.lost_focus() || escape {
                    // The next key is not for a field that is gone.
                    field.surrender_focus();
                    if escape {
                        self.naming = None;
                    } else {
                        self.finish_naming(context);
                    }
                }
            });
    }
}
