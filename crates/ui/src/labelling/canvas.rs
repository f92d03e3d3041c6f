//! The picture with its boxes, and the pointer on it.

use egui::{
    Align2, CursorIcon, InputState, Key, Modifiers, Painter, PointerButton, Pos2, Rect, Sense,
    Shape, Stroke, StrokeKind, Ui, Vec2, pos2, vec2,
};
use pilotage_core::mission::{FrameLabels, LabelBox};

use super::drag::BoxDrag;
use super::{LabelCommand, Labeller, color_of, said_of};
use crate::command::Command;
use crate::context::ViewContext;
use crate::shell::keys::ShortcutListener;
use crate::views::{CameraView, parts};

/// Largest distance of a handle from the pointer at which it is taken, points.
const REACH: f32 = 9.0;
/// Furthest that the wheel goes in, in doublings.
const MOST_NEARNESS: f32 = 4.0;
/// Half the side of a handle, points.
const HANDLE: f32 = 4.0;

/// From pixels of the picture to points on the screen.
#[derive(Clone, Copy)]
struct CanvasPlacement {
    rect: Rect,
    scale: f32,
}

impl CanvasPlacement {
    fn at(&self, pixel: [f64; 2]) -> Pos2 {
        self.rect.min + self.scale * vec2(pixel[0] as f32, pixel[1] as f32)
    }

    fn pixel(&self, at: Pos2) -> [f64; 2] {
        let offset = (at - self.rect.min) / self.scale;
        [f64::from(offset.x), f64::from(offset.y)]
    }

    fn of(&self, label: &LabelBox) -> Rect {
        Rect::from_min_max(self.at(label.min), self.at(label.max))
    }
}

impl Labeller {
    /// Draws the picture at the cursor with its boxes into the space that is left, and takes pointer
    /// and keys.
    pub fn show(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, camera: &mut CameraView) {
        let tokens = context.tokens;
        let outer = ui.available_rect_before_wrap();
        self.take_escape(ui, context);
        let (Some(flight), Some(frame)) = (context.flight, context.shown_frame()) else {
            let hint = "Open a flight with pictures or simulate one, and go to its first picture.";
            return parts::empty(ui, tokens, "No picture to label", hint);
        };
        let shown = camera.picture_at(ui.ctx(), context, frame);
        self.propose(context, frame);
        let response = ui.allocate_rect(outer, Sense::click_and_drag());
        let size = (flight.camera.width as u32, flight.camera.height as u32);
        let name = flight.frames[frame].name.as_str();
        let labels = said_of(context, frame);
        parts::name(&response, described(labels.as_ref(), name));
        let placement = self.placement(ui, &response, outer, size);
        self.drawn = Some((placement.rect, size));
        let painter = ui.painter_at(outer);
        painter.rect_filled(outer, 0.0, tokens.background);
        let Some((texture, index)) = shown else {
            let text = camera.trouble().unwrap_or("The picture is on its way.");
            let (at, font) = (placement.rect.center(), parts::normal(tokens));
            painter.text(at, Align2::CENTER_CENTER, text, font, tokens.muted);
            return;
        };
        let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        painter.image(texture, placement.rect, uv, egui::Color32::WHITE);
        if index != frame {
            return;
        }
        self.take_pointer(ui, &response, context, frame, placement, size);
        Self::take_keys(ui, context, frame, size);
        self.paint(&painter, context, labels.as_ref(), placement);
    }

    fn placement(
        &mut self,
        ui: &Ui,
        response: &egui::Response,
        outer: Rect,
        size: (u32, u32),
    ) -> CanvasPlacement {
        let pixels = vec2(size.0 as f32, size.1 as f32);
        let fitted = parts::fitted(outer.shrink(8.0), pixels);
        let scale_of = |nearness: f32| fitted.width() / pixels.x.max(1.0) * nearness.exp2();
        if let Some(pointer) = response.hover_pos() {
            let input =
                |i: &egui::InputState| i.zoom_delta().log2() + i.smooth_scroll_delta().y / 200.0;
            let step = ui.input(input);
            if step != 0.0 {
                let nearness = (self.nearness + step).clamp(0.0, MOST_NEARNESS);
                let off = pointer - outer.center();
                self.shift += off / scale_of(nearness) - off / scale_of(self.nearness);
                self.nearness = nearness;
            }
        }
        let scale = scale_of(self.nearness);
        if response.dragged_by(PointerButton::Secondary)
            || response.dragged_by(PointerButton::Middle)
        {
            self.shift += response.drag_delta() / scale;
        }
        let most = (0.5 * (pixels - fitted.size() / scale)).max(Vec2::ZERO);
        self.shift = self.shift.clamp(-most, most);
        let center = outer.center() + self.shift * scale;
        CanvasPlacement {
            rect: Rect::from_center_size(center, pixels * scale),
            scale,
        }
    }

    fn take_pointer(
        &mut self,
        ui: &Ui,
        response: &egui::Response,
        context: &mut ViewContext<'_>,
        frame: usize,
        placement: CanvasPlacement,
        size: (u32, u32),
    ) {
        let labels = said_of(context, frame);
        let selected = context.selection;
        let own = labels.as_ref().zip(selected);
        let own = own.and_then(|(labels, id)| labels.of(id));
        if let Some(at) = response.hover_pos() {
            let grip = own.and_then(|label| grip(placement.of(label), at));
            ui.ctx().set_cursor_icon(match grip {
                Some([[true, true], [true, true]]) => CursorIcon::Move,
                Some([[_, _], [_, true]] | [[_, true], _]) => CursorIcon::ResizeVertical,
                Some(_) => CursorIcon::ResizeHorizontal,
                None => CursorIcon::Crosshair,
            });
        }
        if response.drag_started_by(PointerButton::Primary)
            && let Some(at) = ui.input(|i| i.pointer.press_origin())
        {
            let pixel = placement.pixel(at);
            self.drag = selected.map(|landmark| {
                let (from, edges, of) = own
                    .and_then(|label| {
                        let edges = grip(placement.of(label), at)?;
                        Some(([label.min, label.max], edges, Some(label.clone())))
                    })
                    .unwrap_or(([pixel, pixel], [[false; 2], [true; 2]], None));
                BoxDrag {
                    frame,
                    landmark,
                    from,
                    at: pixel,
                    edges,
                    of,
                }
            });
        }
        let is_over = response.drag_stopped();
        if (response.dragged_by(PointerButton::Primary) || is_over)
            && let (Some(drag), Some(at)) = (&self.drag, response.interact_pointer_pos())
            && drag.frame == frame
        {
            let corners = drag.corners(placement.pixel(at));
            let drawn = || {
                let landmark = context.mission.landmark(drag.landmark);
                let name = landmark.map_or("", |l| l.name.as_str());
                LabelBox::new(drag.landmark, name, corners, size)
            };
            let label = (drag.of.as_ref()).map_or_else(drawn, |of| of.reshaped(corners, size));
            if let Some(label) = label {
                let finished = is_over;
                let set = LabelCommand::Set {
                    frame,
                    label,
                    finished,
                };
                context.commands.push(Command::from(set));
            }
        }
        if is_over {
            self.drag = None;
        }
        if response.clicked()
            && let Some(at) = response.interact_pointer_pos()
        {
            let mut hit = labels.iter().flat_map(|l| &l.boxes);
            let hit = hit.find(|label| placement.of(label).expand(REACH).contains(at));
            if let Some(label) = hit {
                let id = Some(label.landmark);
                context.commands.push(Command::SelectLandmark(id));
            }
        }
    }

    /// Escape declines what is proposed, or else leaves, also while no picture is there.
    fn take_escape(&mut self, ui: &Ui, context: &mut ViewContext<'_>) {
        let is_elsewhere = ShortcutListener::is_covered(ui.ctx());
        let is_pressed = |input: &mut InputState| input.consume_key(Modifiers::NONE, Key::Escape);
        if is_elsewhere || self.drag.is_some() || !ui.input_mut(is_pressed) {
            return;
        }
        if self.proposal.is_none() {
            context.commands.push(LabelCommand::Toggle.into());
        }
        self.decline();
    }

    /// Keys that mean something here only.
    fn take_keys(ui: &Ui, context: &mut ViewContext<'_>, frame: usize, size: (u32, u32)) {
        let is_elsewhere = ShortcutListener::is_covered(ui.ctx());
        if is_elsewhere || ui.memory(|m| m.focused().is_some()) {
            return;
        }
        // A slow frame may hold several presses of a key.
        let presses = |key| ui.input(|i| i.num_presses(key));
        let pressed = |key| presses(key) > 0;
        let mut send = |command| context.commands.push(Command::from(command));
        if pressed(Key::Delete) || pressed(Key::Backspace) {
            send(LabelCommand::Delete);
        }
        if pressed(Key::Enter) {
            send(LabelCommand::Accept);
        }
        let (alt, shift) = ui.input(|i| (i.modifiers.alt, i.modifiers.shift));
        if !alt {
            for (key, rows) in [(Key::ArrowUp, -1), (Key::ArrowDown, 1)] {
                for _ in 0..presses(key) {
                    send(LabelCommand::Choose(rows));
                }
            }
            return;
        }
        let step = |less, more| presses(more) as f64 - presses(less) as f64;
        let by = [
            step(Key::ArrowLeft, Key::ArrowRight),
            step(Key::ArrowUp, Key::ArrowDown),
        ];
        if by == [0.0; 2] {
            return;
        }
        let labels = said_of(context, frame);
        let own = labels.as_ref().zip(context.selection);
        let own = own.and_then(|(labels, id)| labels.of(id));
        let Some(own) = own else { return };
        let moved = |corner: [f64; 2]| [corner[0] + by[0], corner[1] + by[1]];
        let low = if shift { own.min } else { moved(own.min) };
        let corners = [low, moved(own.max)];
        if let Some(label) = own.reshaped(corners, size) {
            let set = LabelCommand::Set {
                frame,
                label,
                finished: true,
            };
            context.commands.push(Command::from(set));
        }
    }

    fn paint(
        &self,
        painter: &Painter,
        context: &ViewContext<'_>,
        labels: Option<&FrameLabels>,
        placement: CanvasPlacement,
    ) {
        let tokens = context.tokens;
        let mut taken = Vec::new();
        for label in labels.into_iter().flat_map(|l| &l.boxes) {
            let (rect, color) = (placement.of(label), color_of(context, label.landmark));
            let is_selected = context.selection == Some(label.landmark);
            let width = if is_selected { 2.0 } else { 1.5 };
            painter.rect_stroke(
                rect,
                0.0,
                Stroke::new(width + 2.0, parts::rim(tokens)),
                StrokeKind::Middle,
            );
            painter.rect_stroke(rect, 0.0, Stroke::new(width, color), StrokeKind::Middle);
            if is_selected {
                for handle in handles(rect) {
                    let square = Rect::from_center_size(handle, Vec2::splat(2.0 * HANDLE));
                    painter.rect_filled(square, 1.0, color);
                    let rim = Stroke::new(1.0, parts::rim(tokens));
                    painter.rect_stroke(square, 1.0, rim, StrokeKind::Outside);
                }
            }
            let landmark = context.mission.landmark(label.landmark);
            let name = landmark.map_or(label.name.as_str(), |l| l.name.as_str());
            let hard = if label.difficult { ", hard to see" } else { "" };
            let at = rect.left_top() + vec2(0.0, -22.0);
            parts::tag(
                painter,
                tokens,
                at,
                &format!("{name}{hard}"),
                color,
                &mut taken,
            );
        }
        if let Some((_, label)) = &self.proposal {
            let (rect, color) = (placement.of(label), color_of(context, label.landmark));
            let corners = [
                rect.left_top(),
                rect.right_top(),
                rect.right_bottom(),
                rect.left_bottom(),
                rect.left_top(),
            ];
            for (width, color) in [(3.5, parts::rim(tokens)), (1.5, color)] {
                let stroke = Stroke::new(width, color);
                painter.extend(Shape::dashed_line(&corners, stroke, 6.0, 5.0));
            }
            let text = format!("{}: Enter takes this", label.name);
            let at = rect.left_top() + vec2(0.0, -22.0);
            parts::tag(painter, tokens, at, &text, tokens.text, &mut taken);
        }
    }
}

/// The eight places at which a box is given another size.
fn handles(rect: Rect) -> [Pos2; 8] {
    let middle = rect.center();
    [
        rect.left_top(),
        pos2(middle.x, rect.top()),
        rect.right_top(),
        pos2(rect.left(), middle.y),
        pos2(rect.right(), middle.y),
        rect.left_bottom(),
        pos2(middle.x, rect.bottom()),
        rect.right_bottom(),
    ]
}

/// Edges of a box that follow a pointer that goes down at `at`; `None` if none do.
fn grip(rect: Rect, at: Pos2) -> Option<[[bool; 2]; 2]> {
    if !rect.expand(REACH).contains(at) {
        return None;
    }
    let near = |edge: f32, at: f32| (edge - at).abs() <= REACH;
    let low = [near(rect.left(), at.x), near(rect.top(), at.y)];
    let high = [near(rect.right(), at.x), near(rect.bottom(), at.y)];
    if low == [false; 2] && high == [false; 2] {
        return Some([[true; 2]; 2]);
    }
    // A small box is held by its far edges.
    let low = [low[0] && !high[0], low[1] && !high[1]];
    Some([low, high])
}

/// Description of the picture's labels in a line, for those who do not see it.
fn described(labels: Option<&FrameLabels>, name: &str) -> String {
    let boxes: Vec<String> = labels
        .into_iter()
        .flat_map(|l| &l.boxes)
        .map(|b| {
            let [width, height] = b.size();
            format!("{} {width:.0} by {height:.0} pixels", b.name)
        })
        .collect();
    if boxes.is_empty() {
        format!("Picture to label {name}: no boxes")
    } else {
        format!("Picture to label {name}: {}", boxes.join(", "))
    }
}
