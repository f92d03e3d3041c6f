//! The line as a tool of the map.

use egui::{Align2, CursorIcon, Key, Pos2, Rect, Response, Shape, Stroke, Ui, vec2};
use pilotage_core::frames::GroundPoint;

use super::line::{LineStage, MeasuredLeg};
use super::{Measure, MeasureCommand};
use crate::context::ViewContext;
use crate::map::{
    MapCanvas, MapStage, MapTool, ScreenFromWorld, drag_origin, paint_halo_text, paint_lifted_line,
    tool_keys,
};

/// Distance from a point that still counts as on it, points of the screen.
const HIT_RADIUS: f32 = 12.0;
/// Shortest leg on the screen that is labelled, points.
const LABELLED: f32 = 48.0;

impl Measure {
    /// Index of the point of the line that lies at a place of the screen.
    fn hit(&self, view: &ScreenFromWorld, at: Pos2) -> Option<usize> {
        let places = self
            .line
            .points
            .iter()
            .map(|point| view.apply(point).distance(at));
        let near = places
            .enumerate()
            .filter(|(_, distance)| *distance <= HIT_RADIUS);
        near.min_by(|a, b| a.1.total_cmp(&b.1))
            .map(|(index, _)| index)
    }

    /// Takes Enter, Backspace and Escape, unless they are for somebody else: what is selected is not deleted meanwhile.
    fn keyboard(&mut self, ui: &Ui, response: &Response, context: &mut ViewContext<'_>) {
        let keys = [Key::Enter, Key::Backspace, Key::Escape];
        let [enter, back, escape] = tool_keys(ui, response, keys);
        if enter {
            self.line.end();
        }
        if back {
            self.line.take_back();
        }
        if escape {
            let is_clear = self.line.points.is_empty();
            let command = if is_clear {
                MeasureCommand::Toggle
            } else {
                MeasureCommand::Clear
            };
            context.commands.push(command.into());
        }
    }

    /// Draws a leg with its length and course beside its middle.
    fn paint_leg(&self, canvas: &MapCanvas<'_>, [from, to]: [GroundPoint; 2]) {
        let tokens = canvas.tokens;
        let ends = [from, to].map(|point| canvas.view.apply(&point));
        paint_lifted_line(canvas.painter, ends, 2.0, tokens.accent, tokens);
        if ends[0].distance(ends[1]) >= LABELLED {
            let words = MeasuredLeg::between(self.frame.as_ref(), &from, &to).words(self.units);
            let middle = ends[0].lerp(ends[1], 0.5);
            let (font, ink) = (tokens.small(), tokens.sigma);
            paint_halo_text(
                canvas.painter,
                middle,
                Align2::CENTER_CENTER,
                &words,
                font,
                ink,
            );
        }
    }
}

impl MapTool for Measure {
    fn interact(
        &mut self,
        ui: &Ui,
        view: &ScreenFromWorld,
        response: &Response,
        context: &mut ViewContext<'_>,
    ) -> bool {
        self.keyboard(ui, response, context);
        let at = response.interact_pointer_pos();
        if let Some(origin) = drag_origin(ui, response) {
            self.dragged = self.hit(view, origin);
        }
        if let Some(index) = self.dragged {
            if let (Some(point), Some(at)) = (self.line.points.get_mut(index), at) {
                *point = view.inverse(at);
            }
            if !response.dragged() {
                self.dragged = None;
            }
            ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
            return true;
        }
        if response.clicked()
            && let Some(at) = at
        {
            self.line.click(view.inverse(at), self.hit(view, at));
            return true;
        }
        if let Some(at) = response.hover_pos() {
            let is_on_point = self.hit(view, at).is_some();
            let icon = if is_on_point {
                CursorIcon::Grab
            } else {
                CursorIcon::Crosshair
            };
            ui.ctx().set_cursor_icon(icon);
        }
        // A drag moves the map.
        false
    }

    fn paint(&self, stage: MapStage, canvas: &MapCanvas<'_>) {
        if stage != MapStage::Last {
            return;
        }
        let MapCanvas {
            painter,
            view,
            tokens,
            ..
        } = *canvas;
        let line = &self.line;
        let places: Vec<Pos2> = line.points.iter().map(|point| view.apply(point)).collect();
        line.ends().for_each(|ends| self.paint_leg(canvas, ends));
        if line.stage == LineStage::Drawing
            && let (Some(last), Some(pointer)) = (line.points.last(), canvas.pointer)
            && self.hit(view, pointer).is_none()
        {
            self.paint_leg(canvas, [*last, view.inverse(pointer)]);
        }
        for place in &places {
            painter.add(Shape::circle_filled(*place, 4.5, tokens.accent));
            painter.add(Shape::circle_stroke(
                *place,
                4.5,
                Stroke::new(1.0, tokens.outline()),
            ));
        }
        let measures = line.measures(self.frame.as_ref());
        if let Some(last) = places.last().filter(|_| measures.legs.len() > 1) {
            // The last rows are the sum and the area.
            let rows = measures.rows(self.units).split_off(measures.legs.len());
            let (at, align) = if line.stage == LineStage::Closed {
                (Rect::from_points(&places).center(), Align2::CENTER_CENTER)
            } else {
                (*last + vec2(10.0, 8.0), Align2::LEFT_TOP)
            };
            let (font, ink) = (tokens.small(), tokens.sigma);
            paint_halo_text(painter, at, align, &rows.join("\n"), font, ink);
        }
    }
}
