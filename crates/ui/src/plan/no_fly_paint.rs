//! No-fly areas on the map: drawn with their holes, and named.

use egui::{Painter, Pos2, Rect, Shape, Stroke, vec2};
use pilotage_core::mission::{Mission, NoFlyZone};
use pilotage_core::sorting::sort;

use crate::map::{LandmarkLabel, ScreenFromWorld};
use crate::tokens::Tokens;

/// Rank of their names, before those of landmarks.
const RANK: u8 = 1;
/// Part of the screen that a corner takes, points across.
const CORNER: f32 = 12.0;
/// Distance between the slanting lines, points along either axis.
const APART: f32 = 12.0;

/// Draws the areas; `held` says whether their corners can be taken.
pub fn paint_no_fly(
    painter: &Painter,
    view: &ScreenFromWorld,
    mission: &Mission,
    held: bool,
    tokens: &Tokens,
) {
    for area in &mission.no_fly {
        let rings = on_screen(view, area);
        hatch(painter, &rings, tokens);
        for ring in rings {
            for at in &ring {
                painter.circle_filled(*at, if held { 4.0 } else { 2.0 }, tokens.no_fly);
            }
            let edge = Stroke::new(4.0, tokens.outline());
            painter.add(Shape::closed_line(ring.clone(), edge));
            painter.add(Shape::closed_line(ring, Stroke::new(2.0, tokens.no_fly)));
        }
    }
}

/// Names of the areas, each at its topmost corner.
pub fn no_fly_labels(
    view: &ScreenFromWorld,
    mission: &Mission,
    tokens: &Tokens,
) -> Vec<LandmarkLabel> {
    let label = |area: &NoFlyZone| {
        let corners = area.corners.iter().map(|corner| view.apply(corner));
        let top = corners.min_by(|a, b| a.y.total_cmp(&b.y))?;
        let around = Rect::from_center_size(top, vec2(CORNER, CORNER));
        Some(LandmarkLabel {
            rank: RANK,
            around,
            top: around.center_top(),
            text: area.name.clone(),
            color: tokens.sigma,
        })
    };
    mission.no_fly.iter().filter_map(label).collect()
}

/// Outline and holes of an area on the screen.
fn on_screen(view: &ScreenFromWorld, area: &NoFlyZone) -> Vec<Vec<Pos2>> {
    let ring = |ring: &Vec<_>| ring.iter().map(|corner| view.apply(corner)).collect();
    area.rings().map(ring).collect()
}

/// Slanting lines over an area and not over its holes, which also work where it is no convex polygon.
fn hatch(painter: &Painter, rings: &[Vec<Pos2>], tokens: &Tokens) {
    let clip = painter.clip_rect();
    let color = tokens.no_fly.gamma_multiply(0.7);
    let levels = rings.iter().flatten().map(|at| level_of(*at));
    let low = levels.clone().fold(f32::INFINITY, f32::min);
    let high = levels.fold(f32::NEG_INFINITY, f32::max);
    let high = high.min(clip.right() + clip.bottom());
    let mut level = (low.max(clip.left() + clip.top()) / APART).ceil() * APART;
    while level < high {
        for pair in crossings(rings, level).chunks_exact(2) {
            painter.line_segment([pair[0], pair[1]], Stroke::new(1.0, color));
        }
        level += APART;
    }
}

/// The slanting line on which a point lies, by its x + y.
fn level_of(at: Pos2) -> f32 {
    at.x + at.y
}

/// Points in which the slanting line of that level crosses the rings, from left to right: it is inside between the first
/// and the second, the third and the fourth, and so on.
fn crossings(rings: &[Vec<Pos2>], level: f32) -> Vec<Pos2> {
    let of_ring = |ring: &Vec<Pos2>| -> Vec<Pos2> {
        let sides = ring.iter().zip(ring.iter().cycle().skip(1));
        let crossing = |(a, b): (&Pos2, &Pos2)| {
            let (from, to) = (level_of(*a) - level, level_of(*b) - level);
            ((from < 0.0) != (to < 0.0)).then(|| *a + (*b - *a) * (from / (from - to)))
        };
        sides.filter_map(crossing).collect()
    };
    let mut found: Vec<Pos2> = rings.iter().flat_map(of_ring).collect();
    sort(&mut found, &|a, b| a.x.total_cmp(&b.x));
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    #[test]
    fn a_slanting_line_leaves_a_hole_out() {
        let square = |low: f32, high: f32| {
            [(low, low), (high, low), (high, high), (low, high)]
                .map(|(x, y)| pos2(x, y))
                .to_vec()
        };
        let rings = [square(0.0, 100.0), square(40.0, 60.0)];
        // Through the middle, where x + y is 100: from x = 0 to the hole's 40, and from its 60 to 100.
        let across: Vec<f32> = crossings(&rings, 100.0).iter().map(|at| at.x).collect();
        assert_eq!(across, [0.0, 40.0, 60.0, 100.0]);
        assert_eq!(crossings(&rings, 30.0).len(), 2);
    }
}
