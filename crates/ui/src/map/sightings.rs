//! Things that aids saw in the last picture, where the believed pose puts them, and those of the map that they may be.

use egui::{Color32, Painter, Rect, Stroke};
use pilotage_core::navigator::{AidInfo, Run, SightingReport};

use super::symbols::paint_lifted_line;
use super::transform::ScreenFromWorld;
use crate::tokens::Tokens;
use crate::views::sighted;

/// Coarsest scale at which they are drawn, metres per point.
const COARSEST: f64 = 3.0;

/// Whether an aid of the run looks at pictures.
pub fn has_aids_that_see(run: &Run) -> bool {
    let chosen = run.settings.aids.iter();
    chosen
        .filter_map(|aid| AidInfo::named(&aid.key).ok())
        .any(AidInfo::sees)
}

/// Draws them: those of the map hollow, those of the picture filled if they told something of the place, and a line from
/// one to the other of a pair, which is what the believed pose was off.
pub fn paint(
    painter: &Painter,
    view: &ScreenFromWorld,
    screen: Rect,
    sightings: &[SightingReport],
    tokens: &Tokens,
) {
    if view.metres_per_point > COARSEST {
        return;
    }
    let room = screen.expand(2.0 * sighted::HALF);
    for sighting in sightings {
        for known in &sighting.known {
            let at = view.apply(&known.place);
            if room.contains(at) {
                let stroke = Stroke::new(1.0, tokens.text);
                sighted::mark(
                    painter,
                    at,
                    known.kind,
                    stroke,
                    Color32::TRANSPARENT,
                    tokens,
                );
            }
        }
        for seen in &sighting.seen {
            let at = view.apply(&seen.place);
            if !room.contains(at) {
                continue;
            }
            let color = sighted::color(tokens, seen);
            if let Some(known) = seen.pair.and_then(|pair| sighting.known.get(pair.known)) {
                paint_lifted_line(painter, [at, view.apply(&known.place)], 1.5, color, tokens);
            }
            let is_used = seen.pair.is_some_and(|pair| pair.accepted);
            let fill = if is_used { color } else { Color32::TRANSPARENT };
            sighted::mark(
                painter,
                at,
                seen.kind,
                Stroke::new(1.5, color),
                fill,
                tokens,
            );
        }
    }
}
