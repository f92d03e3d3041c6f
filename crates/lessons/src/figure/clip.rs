//! Lines and areas cut off at the rim of a plot.

use nalgebra::Vector2;

/// Parts of the line through `points` that lie between the corners `low` and `high` (Liang and Barsky 1984, piece by
/// piece).
pub fn line(points: &[Vector2<f64>], [low, high]: [Vector2<f64>; 2]) -> Vec<Vec<Vector2<f64>>> {
    let mut parts: Vec<Vec<Vector2<f64>>> = Vec::new();
    for ends in points.windows(2) {
        let Some([from, to]) = piece([ends[0], ends[1]], [low, high]) else {
            continue;
        };
        match parts.last_mut() {
            Some(part) if part.last() == Some(&from) => part.push(to),
            _ => parts.push(vec![from, to]),
        }
    }
    parts
}

/// Part of a straight piece inside; its ends are those of the piece, to the bit, where they lie inside.
fn piece(
    [from, to]: [Vector2<f64>; 2],
    [low, high]: [Vector2<f64>; 2],
) -> Option<[Vector2<f64>; 2]> {
    let way = to - from;
    let (mut begin, mut end) = (0.0f64, 1.0f64);
    for axis in 0..2 {
        let (first, second) = (low[axis] - from[axis], high[axis] - from[axis]);
        if way[axis] == 0.0 {
            if first > 0.0 || second < 0.0 {
                return None;
            }
            continue;
        }
        let (first, second) = (first / way[axis], second / way[axis]);
        begin = begin.max(first.min(second));
        end = end.min(first.max(second));
    }
    if begin > end || !way.iter().chain(&from).all(|number| number.is_finite()) {
        return None;
    }
    let at = |share: f64| match share {
        0.0 => from,
        1.0 => to,
        share => from + share * way,
    };
    Some([at(begin), at(end)])
}

/// Part of the area within `outline` between the corners `low` and `high` (Sutherland and Hodgman 1974).
pub fn area(outline: &[Vector2<f64>], [low, high]: [Vector2<f64>; 2]) -> Vec<Vector2<f64>> {
    let mut inside: Vec<Vector2<f64>> = outline.to_vec();
    for (axis, limit, side) in [
        (0, low.x, 1.0),
        (0, high.x, -1.0),
        (1, low.y, 1.0),
        (1, high.y, -1.0),
    ] {
        let depth = |point: &Vector2<f64>| side * (point[axis] - limit);
        let mut kept = Vec::with_capacity(inside.len() + 4);
        for (index, to) in inside.iter().enumerate() {
            let from = &inside[(index + inside.len() - 1) % inside.len()];
            let (before, after) = (depth(from), depth(to));
            if (before < 0.0) != (after < 0.0) {
                kept.push(from + before / (before - after) * (to - from));
            }
            if after >= 0.0 {
                kept.push(*to);
            }
        }
        inside = kept;
    }
    inside
}

#[cfg(test)]
mod tests {
    use nalgebra::vector;

    use super::*;

    const CORNERS: [Vector2<f64>; 2] = [Vector2::new(0.0, 0.0), Vector2::new(10.0, 4.0)];

    #[test]
    fn a_line_ends_where_it_leaves_and_begins_anew_where_it_comes_back() {
        let points = [[1.0, 1.0], [1.0, 6.0], [3.0, 6.0], [3.0, 2.0], [5.0, 2.0]];
        let parts = line(&points.map(|[x, y]| vector![x, y]), CORNERS);
        let wanted = vec![
            vec![vector![1.0, 1.0], vector![1.0, 4.0]],
            vec![vector![3.0, 4.0], vector![3.0, 2.0], vector![5.0, 2.0]],
        ];
        assert_eq!(parts, wanted);
        // Through a corner of the plot without a point inside; and past it.
        let through = line(&[vector![-1.0, 3.0], vector![1.0, 5.0]], CORNERS);
        assert_eq!(through, vec![vec![vector![0.0, 4.0], vector![0.0, 4.0]]]);
        assert!(line(&[vector![-1.0, 4.0], vector![1.0, 6.0]], CORNERS).is_empty());
        assert!(line(&[vector![-3.0, 1.0], vector![-1.0, 2.0]], CORNERS).is_empty());
        assert!(line(&[vector![1.0, f64::NAN], vector![2.0, 2.0]], CORNERS).is_empty());
    }

    #[test]
    fn an_area_has_the_size_of_what_lies_inside() {
        let size = |outline: &[Vector2<f64>]| {
            let next = outline.iter().cycle().skip(1);
            0.5 * outline
                .iter()
                .zip(next)
                .map(|(a, b)| a.perp(b))
                .sum::<f64>()
                .abs()
        };
        // Half of the square on its corner lies above the plot's lower rim.
        let square = [[5.0, -2.0], [7.0, 0.0], [5.0, 2.0], [3.0, 0.0]].map(|[x, y]| vector![x, y]);
        assert!((size(&area(&square, CORNERS)) - 4.0).abs() < 1e-12);
        let all =
            [[-9.0, -9.0], [99.0, -9.0], [99.0, 9.0], [-9.0, 9.0]].map(|[x, y]| vector![x, y]);
        assert!((size(&area(&all, CORNERS)) - 40.0).abs() < 1e-12);
        let away = [[5.0, 5.0], [6.0, 5.0], [6.0, 6.0]].map(|[x, y]| vector![x, y]);
        assert!(area(&away, CORNERS).is_empty());
    }
}
