//! The time axis that plots share: how much of the time is shown, and how pointers move it.

use egui::{Rect, Response, Sense, Ui, pos2, vec2};

use super::chart::ChartAxes;
use super::parts;
use crate::command::Command;
use crate::context::ViewContext;
use crate::timeline::{SpanPointer, TimeOnScreen};
use crate::tokens::Tokens;

/// Shortest stretch of time that can be shown, seconds.
pub(crate) const LEAST_SPAN: f64 = 0.5;

/// Span of time that plots show, and time under the pointer.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct TimeAxis {
    /// Time shown, if not all of it.
    pub zoom: Option<(f64, f64)>,
    /// Time under the pointer, from the last frame.
    pub hover: Option<f64>,
    span_pointer: SpanPointer,
}

impl TimeOnScreen for ChartAxes {
    fn x_of(&self, time: f64) -> f32 {
        self.screen_x(time)
    }
    fn time_of(&self, x: f32) -> f64 {
        self.x_at(x)
    }
}

impl TimeAxis {
    /// First and last time shown: the part of `whole` that was chosen, or all of it where that lies elsewhere.
    pub fn span(&self, whole: (f64, f64)) -> (f64, f64) {
        let chosen = self.zoom.map(|(a, b)| (a.max(whole.0), b.min(whole.1)));
        chosen.filter(|(a, b)| a < b).unwrap_or(whole)
    }

    /// Chips for less time, more, the selected span, and all of it.
    pub fn chips(&mut self, ui: &mut Ui, context: &ViewContext<'_>, whole: (f64, f64)) {
        let (tokens, time) = (context.tokens, context.time);
        let span = self.span(whole);
        for (text, name, factor) in [("+", "Less time", 0.5), ("−", "More time", 2.0)] {
            if parts::chip(ui, tokens, false, text, name).clicked() {
                self.zoom = zoomed(span, time, factor, whole);
            }
        }
        if let Some(selected) = context.selected_span.filter(|s| Some(*s) != self.zoom)
            && parts::chip(ui, tokens, false, "Selected", "Selected time").clicked()
        {
            self.zoom = Some(wide_enough(selected, whole));
        }
        if self.zoom.is_some() && parts::chip(ui, tokens, false, "All", "All time").clicked() {
            self.zoom = None;
        }
    }

    /// Click and drag seek, with Shift or at an edge they select a span, wheel with Ctrl zooms, sideways wheel moves; returns the hovered time.
    pub fn interact(
        &mut self,
        ui: &Ui,
        context: &mut ViewContext<'_>,
        response: &Response,
        axes: &ChartAxes,
        whole: (f64, f64),
    ) -> Option<f64> {
        let selected = context.selected_span;
        let selects = (self.span_pointer).follow(ui, context.commands, response, axes, selected);
        if !selects
            && (response.clicked() || response.dragged())
            && let Some(pointer) = response.interact_pointer_pos()
        {
            let time = axes.x_at(pointer.x).clamp(whole.0, whole.1);
            context.commands.push(Command::SeekTo(time));
        }
        if response.double_clicked() {
            self.zoom = None;
        }
        let pointer = response.hover_pos()?;
        let time = axes.x_at(pointer.x);
        let (factor, sideways) = ui.input(|i| (i.zoom_delta(), i.smooth_scroll_delta().x));
        if factor != 1.0 {
            self.zoom = zoomed(axes.x, time, 1.0 / f64::from(factor), whole);
        } else if sideways != 0.0 && self.zoom.is_some() {
            let shift = -f64::from(sideways / axes.rect.width()) * (axes.x.1 - axes.x.0);
            let shift = shift.min(whole.1 - axes.x.1).max(whole.0 - axes.x.0);
            self.zoom = Some((axes.x.0 + shift, axes.x.1 + shift));
        }
        axes.rect.x_range().contains(pointer.x).then_some(time)
    }

    /// Height of the labels below the curves, points.
    pub fn height(tokens: &Tokens) -> f32 {
        1.8 * tokens.text_sizes[0]
    }

    /// Labels of the axis, in seconds since the zero of every clock.
    pub fn draw(ui: &mut Ui, context: &ViewContext<'_>, span: (f64, f64)) {
        let tokens = context.tokens;
        let size = vec2(ui.available_width(), Self::height(tokens));
        let (outer, _) = ui.allocate_exact_size(size, Sense::hover());
        let rect = Self::curves_rect(outer, tokens);
        let axes = ChartAxes {
            rect: Rect::from_min_max(rect.left_top(), pos2(rect.right(), outer.top())),
            x: span,
            y: (0.0, 1.0),
            log: false,
        };
        axes.draw_time(&ui.painter_at(outer), tokens, context.clock_zero);
    }

    /// Part of a plot for the curves: right of the y axis' labels.
    pub fn curves_rect(outer: Rect, tokens: &Tokens) -> Rect {
        let left = 3.4 * tokens.text_sizes[0];
        Rect::from_min_max(
            pos2(outer.left() + left, outer.top() + 1.0),
            pos2(outer.right() - tokens.space, outer.bottom() - 1.0),
        )
    }
}

/// The span, or where it is too short to be shown alone, one around its middle.
fn wide_enough(span: (f64, f64), whole: (f64, f64)) -> (f64, f64) {
    let missing = 0.5 * (LEAST_SPAN - (span.1 - span.0)).max(0.0);
    (
        (span.0 - missing).max(whole.0),
        (span.1 + missing).min(whole.1),
    )
}

/// The span scaled around `time`; `None` for all of it.
fn zoomed(span: (f64, f64), time: f64, factor: f64, whole: (f64, f64)) -> Option<(f64, f64)> {
    let length = ((span.1 - span.0) * factor).max(LEAST_SPAN);
    if length >= whole.1 - whole.0 {
        return None;
    }
    let time = time.clamp(span.0, span.1);
    let before = (time - span.0) / (span.1 - span.0) * length;
    let low = (time - before).clamp(whole.0, whole.1 - length);
    Some((low, low + length))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stretch_that_was_chosen_of_another_flight_is_not_kept() {
        let axis = TimeAxis {
            zoom: Some((20.0, 40.0)),
            ..TimeAxis::default()
        };
        assert_eq!(axis.span((0.0, 60.0)), (20.0, 40.0));
        assert_eq!(axis.span((0.0, 12.0)), (0.0, 12.0));
        assert_eq!(axis.span((800.0, 1500.0)), (800.0, 1500.0));
    }

    #[test]
    fn what_is_under_the_pointer_stays_there_when_time_is_stretched() {
        let (low, high) = zoomed((0.0, 100.0), 25.0, 0.5, (0.0, 100.0)).unwrap();
        assert!((25.0 - low) / (high - low) - 0.25 < 1e-12);
        assert_eq!(zoomed((40.0, 60.0), 50.0, 10.0, (0.0, 100.0)), None);
    }
}
