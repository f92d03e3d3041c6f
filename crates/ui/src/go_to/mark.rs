//! The mark at the place that was gone to.

use egui::{Align2, Painter, Stroke, vec2};
use pilotage_core::frames::{Geodetic, LocalFrame};

use crate::context::ViewContext;
use crate::map::{MapLayer, ScreenFromWorld, is_in_reach, paint_halo_text};

/// Radius of the ring, points of the screen.
const RADIUS: f32 = 6.0;

/// Place that was gone to, with what people called it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct GoToMark {
    pub(super) place: Geodetic,
    pub(super) text: String,
}

impl MapLayer for GoToMark {
    fn paint(
        &self,
        painter: &Painter,
        view: &ScreenFromWorld,
        context: &ViewContext<'_>,
        frame: Option<LocalFrame>,
    ) {
        let Some(frame) = frame.filter(|frame| is_in_reach(frame, &self.place)) else {
            return;
        };
        let height = frame.origin.height;
        let place = Geodetic {
            height,
            ..self.place
        };
        let (tokens, at) = (
            context.tokens,
            view.apply(&frame.ground_from_geodetic(&place)),
        );
        for (width, colour) in [(4.0, tokens.background), (2.0, tokens.accent)] {
            painter.circle_stroke(at, RADIUS, Stroke::new(width, colour));
        }
        let beside = at + vec2(RADIUS + 8.0, 0.0);
        let (font, ink) = (tokens.small(), tokens.sigma);
        paint_halo_text(painter, beside, Align2::LEFT_CENTER, &self.text, font, ink);
    }
}
