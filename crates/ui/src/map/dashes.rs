//! Long dashed lines on the map: what is out of view has no dashes.

use egui::{Painter, Pos2, Rect, Shape, Stroke};

/// Draws a line, dashed by the lengths of a dash and of the gap behind it in points, if they are given.
pub(crate) fn paint_dashed(
    painter: &Painter,
    line: Vec<Pos2>,
    stroke: Stroke,
    dash: Option<(f32, f32)>,
) {
    match dash {
        Some(dash) => painter.extend(dashes(&line, stroke, dash, painter.clip_rect())),
        None => {
            painter.add(Shape::line(line, stroke));
        }
    }
}

/// Dashes of the parts of a line that are in view, at the places at which those of the whole line are.
fn dashes(line: &[Pos2], stroke: Stroke, (dash, gap): (f32, f32), view: Rect) -> Vec<Shape> {
    let period = dash + gap;
    let grown = view.expand(2.0 * period + stroke.width);
    let mut shapes = Vec::new();
    for (before, part) in parts_within(grown, line) {
        // The first dash of a part begins as far behind its cut; the gap there is out of view.
        let behind = -before.rem_euclid(f64::from(period)) as f32;
        let offset = if behind < 0.0 { behind + period } else { 0.0 };
        let part = Shape::dashed_line_with_offset(&part, stroke, &[dash], &[gap], offset);
        shapes.extend(part);
    }
    shapes
}

/// Parts of a line in a rectangle, each with the length of the line before it.
fn parts_within(rect: Rect, line: &[Pos2]) -> Vec<(f64, Vec<Pos2>)> {
    let mut parts: Vec<(f64, Vec<Pos2>)> = Vec::new();
    let mut length = 0.0;
    let mut goes_on = false;
    for ends in line.windows(2) {
        let [from, to] = [ends[0], ends[1]];
        let piece = f64::from(from.distance(to));
        if piece <= 0.0 {
            continue;
        }
        let seen = shares_within(rect, from, to);
        if let Some((begin, end)) = seen {
            let at = |share: f32| from + share * (to - from);
            if !(goes_on && begin <= 0.0) {
                parts.push((length + f64::from(begin) * piece, vec![at(begin)]));
            }
            if let Some((_, part)) = parts.last_mut() {
                part.push(at(end));
            }
        }
        goes_on = seen.is_some_and(|(_, end)| end >= 1.0);
        length += piece;
    }
    parts
}

/// Shares of the way from a point to another at which it is first and last in a rectangle; `None` if it never is.
fn shares_within(rect: Rect, from: Pos2, to: Pos2) -> Option<(f32, f32)> {
    let way = to - from;
    let (mut begin, mut end) = (0.0_f32, 1.0_f32);
    for (at, way, least, most) in [
        (from.x, way.x, rect.left(), rect.right()),
        (from.y, way.y, rect.top(), rect.bottom()),
    ] {
        if way.abs() < f32::EPSILON {
            if at < least || at > most {
                return None;
            }
            continue;
        }
        let (one, other) = ((least - at) / way, (most - at) / way);
        begin = begin.max(one.min(other));
        end = end.min(one.max(other));
    }
    (begin < end).then_some((begin, end))
}

#[cfg(test)]
mod tests {
    use egui::{Color32, pos2, vec2};

    use super::*;

    const DASH: (f32, f32) = (7.0, 3.0);

    fn stroke() -> Stroke {
        Stroke::new(2.0, Color32::WHITE)
    }

    fn ends(shapes: &[Shape]) -> Vec<[Pos2; 2]> {
        let ends = shapes.iter().map(|shape| match shape {
            Shape::LineSegment { points, .. } => *points,
            other => panic!("{other:?}"),
        });
        ends.collect()
    }

    #[test]
    fn a_way_of_kilometres_has_dashes_in_view_alone() {
        let view = Rect::from_min_size(pos2(0.0, 0.0), vec2(800.0, 600.0));
        let line = [pos2(-300_000.0, 100.0), pos2(300_000.0, 110.0)];
        let shapes = dashes(&line, stroke(), DASH, view);
        assert!((80..100).contains(&shapes.len()), "{}", shapes.len());
        let far = [pos2(-300_000.0, 900.0), pos2(300_000.0, 900.0)];
        assert!(dashes(&far, stroke(), DASH, view).is_empty());
    }

    #[test]
    fn dashes_in_view_are_those_of_the_whole_line() {
        let view = Rect::from_min_size(pos2(0.0, 0.0), vec2(200.0, 200.0));
        // In, out above, in again, with a corner in view.
        let line = [
            pos2(-503.0, 40.0),
            pos2(90.0, 50.0),
            pos2(90.0, 50.0),
            pos2(120.0, -700.0),
            pos2(180.0, 650.0),
        ];
        let whole = ends(&Shape::dashed_line(&line, stroke(), DASH.0, DASH.1));
        let is_seen =
            |dash: &&[Pos2; 2]| dash[0] != dash[1] && dash.iter().any(|end| view.contains(*end));
        let cut = ends(&dashes(&line, stroke(), DASH, view));
        let (whole, cut): (Vec<_>, Vec<_>) = (
            whole.iter().filter(is_seen).collect(),
            cut.iter().filter(is_seen).collect(),
        );
        assert_eq!(whole.len(), cut.len());
        for (one, other) in whole.iter().zip(&cut) {
            let apart = one[0].distance(other[0]).max(one[1].distance(other[1]));
            assert!(apart < 0.05, "{one:?} {other:?}");
        }
    }
}
