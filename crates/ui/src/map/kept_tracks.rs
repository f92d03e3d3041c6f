//! Trajectories that were kept to be compared, under those that are open.

use egui::{Painter, Pos2, Shape, Stroke};
use nalgebra::Isometry3;
use pilotage_core::frames::{GroundPoint, LocalFrame};

use super::transform::ScreenFromWorld;
use crate::compare::KeptTrack;
use crate::outage::colour;
use crate::tokens::Tokens;
use pilotage_jobs::OutageReport;

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

/// Draws the ways through a cut, each with a dot where it is at `now`.
pub(super) fn paint_cut(
    painter: &Painter,
    view: &ScreenFromWorld,
    cut: &OutageReport,
    now: f64,
    tokens: &Tokens,
) {
    for (number, result) in cut.results.iter().enumerate() {
        let colour = colour(tokens, number);
        let at = |p: &[f64; 3]| view.apply(&GroundPoint::new(p[1], p[2]));
        let line: Vec<Pos2> = result.places.iter().map(at).collect();
        painter.add(Shape::line(line, Stroke::new(2.0, colour)));
        let reached = result.places.iter().rev().find(|p| p[0] <= now);
        if let Some(place) = reached.filter(|_| now <= cut.span.1) {
            let rim = Stroke::new(1.0, tokens.outline());
            painter.circle(at(place), 4.0, colour, rim);
        }
    }
}
