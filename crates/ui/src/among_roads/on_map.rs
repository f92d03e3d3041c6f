//! Places of the picture on the map.

use egui::{Align2, Painter, Pos2, Shape, Stroke, vec2};
use pilotage_core::filter::probability_words;
use pilotage_core::frames::LocalFrame;

use super::AmongRoads;
use crate::context::ViewContext;
use crate::map::{MapLayer, ScreenFromWorld, paint_halo_text};
use crate::shell::FADED;

/// Radius of the ring below the camera, points of the screen.
const RADIUS: f32 = 6.0;

impl MapLayer for AmongRoads {
    /// Draws the ground that the picture shows at each place, the chosen one heavier, with number and probability.
    fn paint(
        &self,
        painter: &Painter,
        view: &ScreenFromWorld,
        context: &ViewContext<'_>,
        _frame: Option<LocalFrame>,
    ) {
        let tokens = context.tokens;
        let opacity = if self.of_before.is_some() { FADED } else { 1.0 };
        let places = self.found.iter().flat_map(|found| &found.places);
        for (number, place) in places.enumerate() {
            let width = if self.chosen == Some(number) {
                2.5
            } else {
                1.25
            };
            let outline: Vec<Pos2> = place.outline.iter().map(|it| view.apply(it)).collect();
            let at = view.apply(&place.below);
            for (width, colour) in [(width + 2.0, tokens.outline()), (width, tokens.accent)] {
                let stroke = Stroke::new(width, colour.gamma_multiply(opacity));
                painter.add(Shape::closed_line(outline.clone(), stroke));
                painter.circle_stroke(at, RADIUS, stroke);
            }
            let words = format!("{}: {}", number + 1, probability_words(place.probability));
            let (beside, font) = (at + vec2(RADIUS + 8.0, 0.0), tokens.small());
            let ink = tokens.sigma.gamma_multiply(opacity);
            paint_halo_text(painter, beside, Align2::LEFT_CENTER, &words, font, ink);
        }
    }
}
