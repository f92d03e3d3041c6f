//! Pointer and keyboard on the map.

use egui::{CursorIcon, Key, Painter, PointerButton, Rect, Response, StrokeKind, Ui};

use super::picking::{Drag, SMALLEST, box_between, handle_at, landmark_at, moved, resized};
use super::symbols::paint_middle;
use super::tool::{arrow_way, tool_keys};
use super::view::MapView;
use crate::command::Command;
use crate::context::ViewContext;
use crate::shell::keys::ShortcutListener;
use crate::shell::paint_focus_ring;
use crate::tokens::Tokens;

/// Part of the screen whose ground Enter takes as the box of a landmark.
fn box_in_the_middle(rect: Rect) -> Rect {
    Rect::from_center_size(rect.center(), egui::vec2(48.0, 36.0))
}

impl MapView {
    pub(super) fn interact(
        &mut self,
        ui: &Ui,
        rect: Rect,
        response: &Response,
        context: &mut ViewContext<'_>,
        busy: bool,
    ) {
        self.wheel(ui, rect, response);
        self.keyboard(ui, rect, response, context);
        if busy {
            return;
        }
        if response.drag_started() {
            self.begin_drag(rect, ui, response, context);
        }
        if response.dragged() {
            self.carry_on(rect, response, context);
        }
        if response.drag_stopped() {
            self.finish_drag(rect, response, context);
        }
        let view = self.camera.screen_from_world(rect);
        if response.clicked()
            && let Some(at) = response.interact_pointer_pos()
        {
            let hit = landmark_at(&context.mission.landmarks, &view, at);
            context.commands.push(Command::SelectLandmark(hit));
            self.finish_naming(context);
        }
        if response.double_clicked()
            && let Some(at) = response.interact_pointer_pos()
            && let Some(id) = landmark_at(&context.mission.landmarks, &view, at)
        {
            self.begin_naming(id, context);
        }
        if let Some(icon) = self.cursor(rect, response, context) {
            ui.ctx().set_cursor_icon(icon);
        }
    }

    /// Opens the field that names a landmark in place.
    pub fn begin_naming(&mut self, id: u32, context: &ViewContext<'_>) {
        if let Some(landmark) = context.mission.landmark(id) {
            self.name_draft.clone_from(&landmark.name);
            self.naming = Some(id);
        }
    }

    /// Opens the field that names a landmark called `name` in place.
    pub fn name_new(&mut self, id: u32, name: &str) {
        name.clone_into(&mut self.name_draft);
        self.naming = Some(id);
    }

    /// Closes the field that names a landmark in place, and keeps what was typed.
    pub(super) fn finish_naming(&mut self, context: &mut ViewContext<'_>) {
        let name = self.name_draft.trim().to_owned();
        if let Some(id) = self.naming.take().filter(|_| !name.is_empty()) {
            context.commands.push(Command::RenameLandmark { id, name });
        }
    }

    /// Escape leaves the tool that draws boxes, or lets a landmark under way go back to where it was taken.
    pub(super) fn take_escape(
        &mut self,
        ui: &Ui,
        response: &Response,
        context: &mut ViewContext<'_>,
    ) {
        let is_busy = self.picking || !matches!(self.drag, Drag::None | Drag::Pan);
        if !is_busy || !tool_keys(ui, response, [Key::Escape])[0] {
            return;
        }
        self.picking = false;
        if let Drag::Move { id, bounds, .. } | Drag::Resize { id, bounds, .. } =
            std::mem::take(&mut self.drag)
        {
            context.commands.push(Command::ReshapeLandmark {
                id,
                bounds,
                finished: true,
            });
        }
    }

    fn wheel(&mut self, ui: &Ui, rect: Rect, response: &Response) {
        let Some(pointer) = response.hover_pos().filter(|_| response.hovered()) else {
            return;
        };
        let (scroll, pinch, turn) = ui.input(|i| {
            (
                i.smooth_scroll_delta().y,
                i.zoom_delta(),
                i.multi_touch().map_or(0.0, |m| m.rotation_delta),
            )
        });
        let factor = f64::from(pinch) * (f64::from(scroll) * 0.004).exp();
        if (factor - 1.0).abs() > 1e-6 {
            let about = if self.follow { rect.center() } else { pointer };
            self.zoom(rect, factor, about);
        }
        if turn != 0.0 && !self.track_up {
            self.camera.turn(rect, f64::from(turn), pointer);
        }
    }

    fn keyboard(
        &mut self,
        ui: &Ui,
        rect: Rect,
        response: &Response,
        context: &mut ViewContext<'_>,
    ) {
        let (closer, farther, left, right, enter) = ui.input(|i| {
            (
                i.num_presses(Key::Plus) + i.num_presses(Key::Equals),
                i.num_presses(Key::Minus),
                i.key_down(Key::Q),
                i.key_down(Key::E),
                i.key_pressed(Key::Enter),
            )
        });
        if ShortcutListener::is_covered(ui.ctx()) {
            return;
        }
        let middle = rect.center();
        for _ in 0..closer {
            self.zoom(rect, 1.5, middle);
        }
        for _ in 0..farther {
            self.zoom(rect, 1.0 / 1.5, middle);
        }
        if (left || right) && !self.track_up {
            let angle = if left { 0.02 } else { -0.02 };
            self.camera.turn(rect, angle, middle);
            ui.ctx().request_repaint();
        }
        if enter && self.picking {
            let view = self.camera.screen_from_world(rect);
            let taken = box_in_the_middle(rect);
            let (a, b) = (view.inverse(taken.min), view.inverse(taken.max));
            context
                .commands
                .push(Command::AddLandmark(box_between(a, b)));
            self.picking = false;
        }
        if let Some(id) = context.selection {
            let deletes = tool_keys(ui, response, [Key::Delete, Key::Backspace]);
            if deletes.contains(&true) {
                context.commands.push(Command::DeleteLandmark(id));
            }
        }
        if response.has_focus() {
            paint_focus_ring(ui.painter(), rect.shrink(1.0), context.tokens);
            self.arrow_keys(ui, rect, response);
        }
    }

    /// Marks what a key takes in the middle of the map: a place for one of the tools, or a box; not while the pointer is
    /// there and something else has the keyboard.
    pub(super) fn mark_middle(
        &mut self,
        painter: &Painter,
        response: &Response,
        takes: impl Fn(bool) -> bool,
        tokens: &Tokens,
    ) {
        let focused = response.ctx.memory(egui::Memory::focused);
        let has_keyboard = response.has_focus();
        let is_asked = has_keyboard || focused.is_none() && !response.hovered() && !tokens.touch;
        self.marks_middle = is_asked && (self.picking || takes(has_keyboard));
        if !self.marks_middle {
            return;
        }
        if self.picking {
            let taken = box_in_the_middle(response.rect);
            for (width, color) in [(4.0, tokens.outline()), (1.5, tokens.sigma)] {
                painter.rect_stroke(taken, 0.0, (width, color), StrokeKind::Middle);
            }
        } else {
            paint_middle(painter, response.rect.center(), tokens);
        }
    }

    /// Arrows move the map while it has the keyboard.
    fn arrow_keys(&mut self, ui: &Ui, rect: Rect, response: &Response) {
        let way = arrow_way(ui, response);
        if way != egui::Vec2::ZERO {
            self.follow = false;
            self.camera.pan(rect, -way);
        }
    }

    fn begin_drag(&mut self, rect: Rect, ui: &Ui, response: &Response, context: &ViewContext<'_>) {
        let view = self.camera.screen_from_world(rect);
        // Where the button went down, not where egui was sure that it is a drag.
        let at = ui
            .input(|i| i.pointer.press_origin())
            .or(response.interact_pointer_pos());
        let Some(at) = at else { return };
        let ground = view.inverse(at);
        let primary = response.drag_started_by(PointerButton::Primary);
        self.drag = Drag::Pan;
        if primary && self.picking {
            self.drag = Drag::Draw(ground);
        } else if primary
            && let Some(landmark) = context
                .selection
                .and_then(|id| context.mission.landmark(id))
        {
            let (id, bounds) = (landmark.id, landmark.bounds);
            if let Some(handle) = handle_at(landmark, &view, at) {
                self.drag = Drag::Resize { id, bounds, handle };
            } else if bounds.contains(&ground) {
                self.drag = Drag::Move {
                    id,
                    bounds,
                    grip: ground,
                };
            }
        }
        if self.drag == Drag::Pan {
            self.follow = false;
        }
    }

    fn carry_on(&mut self, rect: Rect, response: &Response, context: &mut ViewContext<'_>) {
        let view = self.camera.screen_from_world(rect);
        let Some(to) = response.interact_pointer_pos().map(|p| view.inverse(p)) else {
            return;
        };
        let change = match self.drag {
            Drag::Pan => {
                self.camera.pan(rect, response.drag_delta());
                None
            }
            Drag::Move { id, bounds, grip } => Some((id, moved(&bounds, grip, to))),
            Drag::Resize { id, bounds, handle } => Some((id, resized(&bounds, handle, to))),
            Drag::None | Drag::Draw(_) => None,
        };
        if let Some((id, bounds)) = change {
            context.commands.push(Command::ReshapeLandmark {
                id,
                bounds,
                finished: false,
            });
        }
    }

    fn finish_drag(&mut self, rect: Rect, response: &Response, context: &mut ViewContext<'_>) {
        let view = self.camera.screen_from_world(rect);
        let to = response.interact_pointer_pos().map(|p| view.inverse(p));
        match std::mem::take(&mut self.drag) {
            Drag::Draw(from) => {
                if let Some(bounds) = to.map(|to| box_between(from, to))
                    && bounds.width() >= SMALLEST
                    && bounds.height() >= SMALLEST
                {
                    context.commands.push(Command::AddLandmark(bounds));
                    self.picking = false;
                }
            }
            Drag::Move { id, .. } | Drag::Resize { id, .. } => {
                if let Some(landmark) = context.mission.landmark(id) {
                    context.commands.push(Command::ReshapeLandmark {
                        id,
                        bounds: landmark.bounds,
                        finished: true,
                    });
                }
            }
            Drag::Pan | Drag::None => {}
        }
    }

    fn cursor(
        &self,
        rect: Rect,
        response: &Response,
        context: &ViewContext<'_>,
    ) -> Option<CursorIcon> {
        let at = response.hover_pos()?;
        let view = self.camera.screen_from_world(rect);
        if self.picking {
            return Some(CursorIcon::Crosshair);
        }
        if let Some(landmark) = context
            .selection
            .and_then(|id| context.mission.landmark(id))
        {
            if let Some(handle) = handle_at(landmark, &view, at) {
                return Some(match handle {
                    1 | 5 => CursorIcon::ResizeVertical,
                    3 | 7 => CursorIcon::ResizeHorizontal,
                    0 | 4 => CursorIcon::ResizeNwSe,
                    _ => CursorIcon::ResizeNeSw,
                });
            }
            if landmark.bounds.contains(&view.inverse(at)) {
                return Some(CursorIcon::Move);
            }
        }
        if landmark_at(&context.mission.landmarks, &view, at).is_some() {
            return Some(CursorIcon::PointingHand);
        }
        matches!(self.drag, Drag::Pan).then_some(CursorIcon::Grabbing)
    }
}
