//! Names beside landmarks, out of the way of panels, of lines, of other landmarks and of each other.

use egui::{Align2, Color32, Painter, Pos2, Rect, Vec2, vec2};
use pilotage_core::sorting::sort;

use super::symbols::paint_halo_text;
use crate::tokens::Tokens;

/// Rank of the name of a landmark that is not looked for.
pub const POSSIBLE: u8 = 3;

/// A name to be written beside a landmark.
pub struct LandmarkLabel {
    /// The smaller the sooner it gets a place; 0 always gets one.
    pub rank: u8,
    /// Part of the screen on which the landmark is drawn.
    pub around: Rect,
    /// Its topmost corner.
    pub top: Pos2,
    /// The name.
    pub text: String,
    /// Colour of the name.
    pub color: Color32,
}

/// Parts of the screen that names must not cover, and lines that they must not cross, by their ends.
pub type BusyScreen<'a> = (&'a [Rect], &'a [[Pos2; 2]]);

/// Writes each name beside its landmark where nothing else is; names without a place are left out.
pub fn paint_labels(
    painter: &Painter,
    screen: Rect,
    mut labels: Vec<LandmarkLabel>,
    (covered, lines): BusyScreen<'_>,
    tokens: &Tokens,
) {
    sort(&mut labels, &|a, b| a.rank.cmp(&b.rank));
    let boxes: Vec<Rect> = labels.iter().map(|label| label.around).collect();
    let mut taken: Vec<Rect> = covered.to_vec();
    for label in labels {
        let galley = painter.layout_no_wrap(label.text.clone(), tokens.small(), label.color);
        let free =
            |rect: Rect| screen.contains_rect(rect) && taken.iter().all(|t| !t.intersects(rect));
        let clear = |rect: Rect| {
            !lines.iter().any(|line| is_crossed(rect, *line))
                && !boxes
                    .iter()
                    .any(|it| *it != label.around && it.intersects(rect))
        };
        if let Some((place, align)) = place(&label, galley.size(), &free, &clear) {
            taken.push(paint_halo_text(
                painter,
                place,
                align,
                &label.text,
                tokens.small(),
                label.color,
            ));
        }
    }
}

/// Place of a name of that size: the first that is free and clear of lines and other landmarks. What is about the
/// flight just now may lie over a line, and the selected one over anything.
fn place(
    label: &LandmarkLabel,
    size: Vec2,
    is_free: &dyn Fn(Rect) -> bool,
    is_clear: &dyn Fn(Rect) -> bool,
) -> Option<(Pos2, Align2)> {
    let places = places(label);
    let rect = |(at, align): &(Pos2, Align2)| align.anchor_size(*at, size).expand(4.0);
    let mut free = places.iter().filter(|place| is_free(rect(place)));
    let first = free.clone().next();
    let clear = free.find(|place| is_clear(rect(place)));
    let next_best = first.filter(|_| label.rank < POSSIBLE);
    let last = (label.rank == 0).then_some(&places[0]);
    clear.or(next_best).or(last).copied()
}

/// Whether a line leads through a rectangle, by the part of it that lies between each pair of edges.
fn is_crossed(rect: Rect, [from, to]: [Pos2; 2]) -> bool {
    let way = to - from;
    let (mut begin, mut end) = (0.0_f32, 1.0_f32);
    for (at, step, low, high) in [
        (from.x, way.x, rect.left(), rect.right()),
        (from.y, way.y, rect.top(), rect.bottom()),
    ] {
        if step.abs() < 1e-6 {
            if at < low || at > high {
                return false;
            }
            continue;
        }
        let (a, b) = ((low - at) / step, (high - at) / step);
        (begin, end) = (begin.max(a.min(b)), end.min(a.max(b)));
    }
    begin <= end
}

/// Places for a name, the best first: above, below, at either side, beyond a corner.
fn places(label: &LandmarkLabel) -> [(Pos2, Align2); 8] {
    let around = label.around;
    let away = vec2(4.0, 4.0);
    [
        (label.top + vec2(0.0, -5.0), Align2::CENTER_BOTTOM),
        (around.center_bottom() + vec2(0.0, 5.0), Align2::CENTER_TOP),
        (around.right_center() + vec2(8.0, 0.0), Align2::LEFT_CENTER),
        (around.left_center() - vec2(8.0, 0.0), Align2::RIGHT_CENTER),
        (
            around.right_top() + vec2(away.x, -away.y),
            Align2::LEFT_BOTTOM,
        ),
        (around.left_top() - away, Align2::RIGHT_BOTTOM),
        (around.right_bottom() + away, Align2::LEFT_TOP),
        (
            around.left_bottom() + vec2(-away.x, away.y),
            Align2::RIGHT_TOP,
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    fn label(rank: u8) -> LandmarkLabel {
        let around = Rect::from_center_size(pos2(200.0, 200.0), vec2(30.0, 30.0));
        LandmarkLabel {
            rank,
            around,
            top: around.center_top(),
            text: "church".to_owned(),
            color: Color32::WHITE,
        }
    }

    fn placed(rank: u8, taken: &[Rect], lines: &[[Pos2; 2]]) -> Option<Align2> {
        let free = |rect: Rect| taken.iter().all(|it| !it.intersects(rect));
        let clear = |rect: Rect| !lines.iter().any(|line| is_crossed(rect, *line));
        place(&label(rank), vec2(60.0, 12.0), &free, &clear).map(|(_, align)| align)
    }

    #[test]
    fn a_name_keeps_off_lines_and_is_left_out_where_none_of_its_places_is_clear() {
        assert_eq!(placed(POSSIBLE, &[], &[]), Some(Align2::CENTER_BOTTOM));
        let above = [pos2(0.0, 175.0), pos2(400.0, 175.0)];
        assert_eq!(placed(POSSIBLE, &[], &[above]), Some(Align2::CENTER_TOP));
        let rows = (0..8).map(|row| 150.0 + 14.0 * row as f32);
        let rows: Vec<[Pos2; 2]> = rows.map(|y| [pos2(0.0, y), pos2(400.0, y)]).collect();
        assert_eq!(placed(POSSIBLE, &[], &rows), None);
        assert_eq!(placed(1, &[], &rows), Some(Align2::CENTER_BOTTOM));
        let everything = Rect::from_min_max(pos2(0.0, 0.0), pos2(400.0, 400.0));
        assert_eq!(placed(1, &[everything], &[]), None);
        assert_eq!(placed(0, &[everything], &[]), Some(Align2::CENTER_BOTTOM));
    }

    #[test]
    fn a_line_crosses_a_rectangle_that_it_enters_and_no_other() {
        let rect = Rect::from_min_max(pos2(10.0, 10.0), pos2(20.0, 20.0));
        let crossed = |a: (f32, f32), b: (f32, f32)| is_crossed(rect, [a.into(), b.into()]);
        assert!(crossed((0.0, 0.0), (30.0, 30.0)));
        assert!(crossed((15.0, 0.0), (15.0, 30.0)));
        assert!(crossed((12.0, 12.0), (13.0, 13.0)), "it lies inside");
        assert!(!crossed((0.0, 0.0), (9.0, 9.0)), "it ends before");
        assert!(!crossed((0.0, 25.0), (30.0, 25.0)));
        assert!(!crossed((0.0, 15.0), (15.0, 30.0)), "it passes the corner");
    }
}
