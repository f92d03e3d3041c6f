//! The selected span of time: one for all plots and the timeline, drawn with Shift, moved at its edges.

use egui::{Color32, CursorIcon, Id, Painter, Rect, Response, Stroke, Ui};

use crate::command::Command;
use crate::tokens::Tokens;

/// First and last second of a span in the flight's time base.
pub type Span = (f64, f64);

/// Largest distance from an edge at which a pointer takes hold of it, points.
const REACH: f32 = 5.0;

/// Time along a screen axis: from seconds to screen x and back.
pub(crate) trait TimeOnScreen {
    /// Screen x of a time.
    fn x_of(&self, time: f64) -> f32;
    /// Time at a screen x.
    fn time_of(&self, x: f32) -> f64;
}

/// Drag of the selected span: with Shift a pointer draws a new one, at an edge it moves that edge.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SpanPointer {
    /// Widget in which the drag began, and the end of the span that stays where it is.
    drag: Option<(Id, f64)>,
}

impl SpanPointer {
    /// Follows the pointer over `response`; whether it is about the span and nothing else.
    pub fn follow(
        &mut self,
        ui: &Ui,
        commands: &mut Vec<Command>,
        response: &Response,
        scale: &dyn TimeOnScreen,
        selected: Option<Span>,
    ) -> bool {
        if response.drag_started()
            && let Some(origin) = ui.input(|i| i.pointer.press_origin())
        {
            let fixed = if ui.input(|i| i.modifiers.shift) {
                Some(scale.time_of(origin.x))
            } else {
                opposite_edge(scale, selected, origin.x)
            };
            self.drag = fixed.map(|fixed| (response.id, fixed));
        }
        let Some((_, fixed)) = self.drag.filter(|(id, _)| *id == response.id) else {
            let over = response.hover_pos();
            if over.is_some_and(|p| opposite_edge(scale, selected, p.x).is_some()) {
                ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal);
            }
            return false;
        };
        if let Some(pointer) = response.interact_pointer_pos() {
            let moved = scale.time_of(pointer.x);
            let span = (fixed.min(moved), fixed.max(moved));
            commands.push(Command::SelectSpan(Some(span)));
            ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal);
        }
        if !response.dragged() {
            self.drag = None;
        }
        true
    }
}

/// The edge that stays while the one at `x` is moved; `None` if there is none at `x`.
fn opposite_edge(scale: &dyn TimeOnScreen, selected: Option<Span>, x: f32) -> Option<f64> {
    let (from, to) = selected?;
    let (left, right) = ((scale.x_of(from) - x).abs(), (scale.x_of(to) - x).abs());
    match (left <= REACH, right <= REACH) {
        (true, true) if left < right => Some(to),
        (_, true) => Some(from),
        (true, false) => Some(to),
        (false, false) => None,
    }
}

/// Draws the selected span as a band over `rect`.
pub(crate) fn paint_span(
    painter: &Painter,
    rect: Rect,
    scale: &dyn TimeOnScreen,
    selected: Option<Span>,
    tokens: &Tokens,
) {
    let Some((from, to)) = selected else { return };
    let painter = painter.with_clip_rect(painter.clip_rect().intersect(rect));
    let (left, right) = (scale.x_of(from), scale.x_of(to));
    let band = Rect::from_x_y_ranges(left..=right, rect.y_range());
    painter.rect_filled(band, 0.0, veil(tokens));
    let edge = Stroke::new(1.0, tokens.accent.gamma_multiply(0.7));
    painter.vline(left, rect.y_range(), edge);
    painter.vline(right, rect.y_range(), edge);
}

/// Colour of the veil over the selected span.
fn veil(tokens: &Tokens) -> Color32 {
    tokens.accent.gamma_multiply(0.12)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A second every ten points.
    struct Tens;

    impl TimeOnScreen for Tens {
        fn x_of(&self, time: f64) -> f32 {
            10.0 * time as f32
        }
        fn time_of(&self, x: f32) -> f64 {
            f64::from(x) / 10.0
        }
    }

    #[test]
    fn the_nearer_edge_is_taken_hold_of_and_the_other_one_stays() {
        let span = Some((10.0, 20.0));
        assert_eq!(opposite_edge(&Tens, span, 102.0), Some(20.0));
        assert_eq!(opposite_edge(&Tens, span, 197.0), Some(10.0));
        assert_eq!(opposite_edge(&Tens, span, 150.0), None);
        assert_eq!(opposite_edge(&Tens, None, 100.0), None);
        let narrow = Some((10.0, 10.4));
        assert_eq!(opposite_edge(&Tens, narrow, 99.0), Some(10.4));
        assert_eq!(opposite_edge(&Tens, narrow, 105.0), Some(10.0));
    }
}
