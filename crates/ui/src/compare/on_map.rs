//! Trajectories that were kept to be compared, on the map.

use egui::{Painter, Pos2, Stroke};
use pilotage_core::frames::{GroundPoint, LocalFrame};

use super::shelf::{KeptTrack, Shelf};
use crate::context::ViewContext;
use crate::map::{MapLayer, ScreenFromWorld, carry, paint_dashed};
use crate::tokens::Tokens;

/// Pieces that a trajectory is drawn in at most.
const MOST_PIECES: usize = 2000;

impl MapLayer for Shelf {
    fn paint(
        &self,
        painter: &Painter,
        view: &ScreenFromWorld,
        context: &ViewContext<'_>,
        frame: Option<LocalFrame>,
    ) {
        for kept in self.kept().iter().filter(|kept| kept.is_shown) {
            paint_kept(painter, view, kept, frame, context.tokens);
        }
    }
}

/// Draws a trajectory into the world `frame`.
fn paint_kept(
    painter: &Painter,
    view: &ScreenFromWorld,
    kept: &KeptTrack,
    frame: Option<LocalFrame>,
    tokens: &Tokens,
) {
    let track = &kept.track;
    let carry = carry(frame, track.frame);
    let step = track.places.len().div_ceil(MOST_PIECES).max(1);
    let line: Vec<Pos2> = (track.places.iter().step_by(step).chain(track.places.last()))
        .map(|p| {
            let place = carry * p.place;
            view.apply(&GroundPoint::new(place.x, place.y))
        })
        .collect();
    let (colour, dash) = kept.look(tokens);
    paint_dashed(painter, line, Stroke::new(2.0, colour), dash);
}
