//! Tracks of the log beside that of the flight: the autopilot's own estimate, and other vehicles.

use egui::{Align2, Painter, Pos2, Shape, Stroke, vec2};
use nalgebra::Point3;
use pilotage_core::frames::{GroundPoint, LocalFrame};

use super::OpenLog;
use crate::context::ViewContext;
use crate::map::{Layer, MapLayer, ScreenFromWorld, carry, paint_halo_text, track_colour};

impl MapLayer for OpenLog {
    /// Draws the tracks, each with its name at its end.
    fn paint(
        &self,
        painter: &Painter,
        view: &ScreenFromWorld,
        context: &ViewContext<'_>,
        frame: Option<LocalFrame>,
    ) {
        let tokens = context.tokens;
        let (tracks, own) = &self.tracks;
        let carry = carry(frame, *own);
        let on_screen = |place: &GroundPoint| {
            let moved = carry * Point3::new(place.north, place.east, 0.0);
            view.apply(&GroundPoint::new(moved.x, moved.y))
        };
        for (number, track) in tracks.iter().enumerate() {
            let colour = track_colour(tokens, number);
            let line: Vec<Pos2> = track.places.iter().map(on_screen).collect();
            let Some(end) = line.last().copied() else {
                continue;
            };
            painter.add(Shape::line(line, Stroke::new(1.5, colour)));
            let at = end + vec2(6.0, -4.0);
            let align = Align2::LEFT_BOTTOM;
            paint_halo_text(painter, at, align, &track.name, tokens.small(), colour);
        }
    }

    fn row(&self) -> Option<Layer> {
        Some(Layer::Recorded)
    }

    fn places(&self) -> Vec<GroundPoint> {
        let tracks = self.tracks.0.iter();
        let places = tracks.flat_map(|track| track.places.iter().step_by(10));
        places.copied().collect()
    }
}
