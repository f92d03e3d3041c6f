//! Ways through an outage, on the map.

use egui::{Painter, Pos2, Stroke};
use pilotage_core::frames::{GroundPoint, LocalFrame};

use super::chart::look;
use super::state::Outages;
use crate::context::ViewContext;
use crate::map::{MapLayer, ScreenFromWorld, paint_dashed};
use crate::shell::FADED;

impl MapLayer for Outages {
    /// Draws the ways through the outage, each with a dot where it is at the time cursor.
    fn paint(
        &self,
        painter: &Painter,
        view: &ScreenFromWorld,
        context: &ViewContext<'_>,
        _frame: Option<LocalFrame>,
    ) {
        let Some(outage) = &self.report else { return };
        let (tokens, now) = (context.tokens, context.time);
        for (number, result) in outage.results.iter().enumerate() {
            let opacity = if self.is_of_before { FADED } else { 1.0 };
            let (colour, dash) = look(tokens, number);
            let colour = colour.gamma_multiply(opacity);
            let at = |p: &[f64; 3]| view.apply(&GroundPoint::new(p[1], p[2]));
            let line: Vec<Pos2> = result.places.iter().map(at).collect();
            paint_dashed(painter, line, Stroke::new(2.0, colour), dash);
            let reached = result.places.iter().rev().find(|p| p[0] <= now);
            if let Some(place) = reached.filter(|_| now <= outage.span.1) {
                let rim = Stroke::new(1.0, tokens.outline());
                painter.circle(at(place), 4.0, colour, rim);
            }
        }
    }
}
