//! Tracks of the log beside that of the flight: the autopilot's own estimate, and other vehicles.

use egui::{Align2, Color32, Painter, Pos2, Shape, Stroke, vec2};
use nalgebra::Point3;
use pilotage_core::frames::{GroundPoint, LocalFrame};

use super::other_world::carry;
use super::symbols::paint_halo_text;
use super::transform::ScreenFromWorld;
use crate::log::OpenLog;
use crate::tokens::Tokens;

/// Colour of the track of that number.
pub(super) fn track_colour(tokens: &Tokens, number: usize) -> Color32 {
    [tokens.sigma, tokens.accent, tokens.observed, tokens.ghost][number % 4]
}

/// Draws the tracks into the world `frame`, each with its name at its end.
pub(super) fn paint_recorded(
    painter: &Painter,
    view: &ScreenFromWorld,
    log: &OpenLog,
    frame: Option<LocalFrame>,
    tokens: &Tokens,
) {
    let (tracks, own) = &log.tracks;
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
