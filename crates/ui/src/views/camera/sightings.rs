//! Things that aids saw, marked in the camera picture.

use egui::{Painter, Pos2, Stroke};
use pilotage_core::navigator::{SeenReport, SightingReport};

use super::super::sighted;
use super::placement::CameraPlacement;
use crate::context::ViewContext;

/// Largest distance from a mark at which the pointer asks for its words, points.
const REACH: f32 = 10.0;

/// Draws the marks, filled where the thing told something of the place.
pub(super) fn draw(
    painter: &Painter,
    context: &ViewContext<'_>,
    sightings: &[SightingReport],
    placement: &CameraPlacement,
) {
    let tokens = context.tokens;
    for seen in sightings.iter().flat_map(|sighting| &sighting.seen) {
        let color = sighted::color(tokens, seen);
        let is_used = seen.pair.is_some_and(|pair| pair.accepted);
        let fill = color.gamma_multiply(if is_used { 0.9 } else { 0.0 });
        let stroke = Stroke::new(1.5, color);
        sighted::mark(
            painter,
            placement.at(&seen.pixel),
            seen.kind,
            stroke,
            fill,
            tokens,
        );
    }
}

/// Words for the thing under the pointer.
pub(super) fn explain(
    sightings: &[SightingReport],
    placement: &CameraPlacement,
    pointer: Pos2,
    context: &ViewContext<'_>,
) -> Option<String> {
    let distance = |seen: &SeenReport| placement.at(&seen.pixel).distance(pointer);
    let all = sightings
        .iter()
        .flat_map(|sighting| sighting.seen.iter().map(move |seen| (sighting, seen)));
    let (sighting, seen) = all
        .filter(|(_, seen)| distance(seen) <= REACH)
        .min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)))?;
    Some(sighted::explain(sighting, seen, context.units))
}
