//! Centre lines of roads in a picture of their probability.
//!
//! Across a road, the distance from its edges rises to the middle and falls behind it: a tent whose ridge is sharp
//! however wide the road is. Its ridge is found by second derivatives, to a part of a pixel (Steger 1998).

use pilotage_raster::raster::{Gray, Raster, gaussian_blur};

use super::distance::distance_inside;
use super::seen::{RoadPoint, along};

/// Standard deviation of the blur of the tents, pixels.
const BLUR: f64 = 2.0;
/// Second derivative across below which there is a ridge, 1 / pixels; an endless tent has -0.4,
/// that of a road of five pixels -0.17.
const BEND: f32 = -0.08;
/// Widest half of a road, pixels.
const FARTHEST: f32 = 40.0;
/// Least pixels of a piece of a centre line.
const SHORTEST: usize = 24;

/// Pixels that are road, and their distance from its edges.
pub(super) struct RoadBody {
    /// Whether a pixel is road.
    pub(super) mask: Raster<bool>,
    /// Distance to the nearest pixel that is not, pixels.
    pub(super) inside: Gray,
}

impl RoadBody {
    /// The set pixels.
    pub(super) fn new(mask: Raster<bool>) -> Self {
        let inside = distance_inside(&mask, FARTHEST);
        Self { mask, inside }
    }
}

/// Pixels of at least the probability `sure`, and those of at least `likely` that are connected with them.
pub fn road_mask(probability: &Gray, likely: f32, sure: f32) -> Raster<bool> {
    let (width, height) = (probability.width(), probability.height());
    let mut mask = probability.map(|p| p >= sure);
    let set = mask.pixels().iter().enumerate().filter(|(_, set)| **set);
    let mut open: Vec<usize> = set.map(|(at, _)| at).collect();
    while let Some(at) = open.pop() {
        let (x, y) = (at % width, at / width);
        for row in y.saturating_sub(1)..(y + 2).min(height) {
            for column in x.saturating_sub(1)..(x + 2).min(width) {
                if !mask.get(column, row) && probability.get(column, row) >= likely {
                    mask.set(column, row, true);
                    open.push(row * width + column);
                }
            }
        }
    }
    mask
}

/// Points of the centre lines, those of one pixel each; pieces of few pixels are left out.
pub(super) fn ridge_points(body: &RoadBody, probability: &Gray) -> Vec<RoadPoint> {
    let (width, height) = (probability.width(), probability.height());
    let mut ridge = Raster::filled(width, height, false);
    let (mut points, mut places) = (Vec::new(), Vec::new());
    let tent = gaussian_blur(&body.inside, BLUR);
    for y in 1..height.saturating_sub(1) {
        let (above, here, below) = (tent.row(y - 1), tent.row(y), tent.row(y + 1));
        for x in 1..width.saturating_sub(1) {
            let depth = body.inside.get(x, y);
            if depth < 1.5 {
                continue;
            }
            let slope = [
                0.5 * (here[x + 1] - here[x - 1]),
                0.5 * (below[x] - above[x]),
            ];
            let xx = here[x + 1] + here[x - 1] - 2.0 * here[x];
            let yy = below[x] + above[x] - 2.0 * here[x];
            let xy = 0.25 * (below[x + 1] + above[x - 1] - below[x - 1] - above[x + 1]);
            let root = (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt();
            let bend = 0.5 * (xx + yy) - root;
            if bend > BEND {
                continue;
            }
            // Across the ridge: the vector of the lesser eigenvalue.
            let across = if xx < yy {
                [bend - yy, xy]
            } else {
                [xy, bend - xx]
            };
            let length = across[0].hypot(across[1]).max(f32::MIN_POSITIVE);
            let [nx, ny] = across.map(|part| part / length);
            let offset = -(slope[0] * nx + slope[1] * ny) / bend;
            if (offset * nx).abs() > 0.6 || (offset * ny).abs() > 0.6 {
                continue;
            }
            ridge.set(x, y, true);
            places.push((x, y));
            points.push(RoadPoint {
                pixel: [
                    x as f64 + 0.5 + f64::from(offset * nx),
                    y as f64 + 0.5 + f64::from(offset * ny),
                ],
                direction: along(f64::from(-ny), f64::from(nx)),
                width: f64::from(2.0 * (depth + offset.abs()) - 1.0),
                probability: f64::from(probability.get(x, y)),
            });
        }
    }
    let long = long_pieces(ridge);
    let of_long = places
        .into_iter()
        .zip(points)
        .filter(|((x, y), _)| long.get(*x, *y));
    of_long.map(|(_, point)| point).collect()
}

/// The connected pieces of at least [`SHORTEST`] pixels, those two pixels apart taken as connected.
fn long_pieces(mut left: Raster<bool>) -> Raster<bool> {
    let (width, height) = (left.width(), left.height());
    let mut long = Raster::filled(width, height, false);
    for row in 0..height {
        for column in 0..width {
            if !left.get(column, row) {
                continue;
            }
            left.set(column, row, false);
            let mut piece = vec![(column, row)];
            let mut next = 0;
            while let Some(&(x, y)) = piece.get(next) {
                next += 1;
                for r in y.saturating_sub(2)..(y + 3).min(height) {
                    for c in x.saturating_sub(2)..(x + 3).min(width) {
                        if left.get(c, r) {
                            left.set(c, r, false);
                            piece.push((c, r));
                        }
                    }
                }
            }
            if piece.len() >= SHORTEST {
                for (x, y) in piece {
                    long.set(x, y, true);
                }
            }
        }
    }
    long
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strip(half: f64, sin: f64, cos: f64) -> Gray {
        // Distance from the line through (60, 50) along (cos, sin).
        Gray::from_fn(120, 100, |x, y| {
            let (dx, dy) = (x as f64 + 0.5 - 60.0, y as f64 + 0.5 - 50.0);
            if (dy * cos - dx * sin).abs() < half {
                0.9
            } else {
                0.05
            }
        })
    }

    #[test]
    fn the_middle_of_a_strip_is_found_whatever_its_width_and_direction() {
        for degrees in [0.0_f64, 17.0, 45.0, 100.0, 163.0] {
            for half in [2.5, 6.0, 14.0] {
                let (sin, cos) = degrees.to_radians().sin_cos();
                let probability = strip(half, sin, cos);
                let points = ridge_points(
                    &RoadBody::new(road_mask(&probability, 0.5, 0.5)),
                    &probability,
                );
                assert!(points.len() > 70, "{degrees} {half}: {}", points.len());
                let inner = |p: &&RoadPoint| {
                    (15.0..105.0).contains(&p.pixel[0]) && (15.0..85.0).contains(&p.pixel[1])
                };
                for point in points.iter().filter(inner) {
                    let (dx, dy) = (point.pixel[0] - 60.0, point.pixel[1] - 50.0);
                    let off = (dy * cos - dx * sin).abs();
                    assert!(off < 0.6, "{degrees} {half}: {off} px off");
                    assert!(
                        (point.width - 2.0 * half).abs() < 1.6,
                        "{half}: {}",
                        point.width
                    );
                    // Clockwise from up is a quarter turn before from right towards down.
                    let turn = (point.direction - (degrees + 90.0).to_radians())
                        .sin()
                        .abs();
                    assert!(turn < 0.12, "{degrees} {half}: {turn}");
                }
            }
        }
    }

    #[test]
    fn what_is_likely_counts_where_it_goes_on_from_what_is_sure() {
        let row = [0.3, 0.3, 0.1, 0.2, 0.6, 0.3, 0.2, 0.1, 0.3];
        let probability = Gray::from_fn(9, 1, |x, _| row[x]);
        let set = |likely| road_mask(&probability, likely, 0.5).pixels().to_vec();
        let of =
            |range: std::ops::Range<usize>| (0..9).map(|x| range.contains(&x)).collect::<Vec<_>>();
        assert_eq!(set(0.2), of(3..7));
        assert_eq!(set(0.5), of(4..5));
    }

    #[test]
    fn specks_are_no_roads() {
        let probability = Gray::from_fn(
            60,
            60,
            |x, y| if x % 15 < 6 && y % 15 < 6 { 0.9 } else { 0.0 },
        );
        let points = ridge_points(
            &RoadBody::new(road_mask(&probability, 0.5, 0.5)),
            &probability,
        );
        assert!(points.is_empty(), "{}", points.len());
    }
}
