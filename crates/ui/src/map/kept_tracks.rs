//! Trajectories that were kept to be compared, under those that are open.

use egui::{Painter, Pos2, Shape, Stroke};
use nalgebra::Isometry3;
use pilotage_core::frames::{GroundPoint, LocalFrame};

use super::transform::ScreenFromWorld;
use crate::compare::KeptTrack;
use crate::tokens::Tokens;

/// Pieces that a trajectory is drawn in at most.
const MOST_PIECES: usize = 2000;

/// Motion that brings places of the world frame `from` into that of `to`; none where either lies nowhere on the globe.
pub(super) fn carry(to: Option<LocalFrame>, from: Option<LocalFrame>) -> Isometry3<f64> {
    to.zip(from).map_or_else(Isometry3::identity, |(to, from)| {
        to.world_from_other_world(&from)
    })
}

/// Draws a trajectory into the world `frame`.
pub(super) fn paint_kept(
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
    let stroke = Stroke::new(2.0, colour);
    match dash {
        Some((dash, gap)) => {
            painter.extend(Shape::dashed_line(&line, stroke, dash, gap));
        }
        None => {
            painter.add(Shape::line(line, stroke));
        }
    }
}
