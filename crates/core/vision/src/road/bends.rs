//! The bends of a line that the probability of road is worth.

use pilotage_raster::raster::{Gray, Raster};

/// Least probability that counts: a crown or a truck may hide any road.
const LEAST: f32 = 0.01;

/// Choice between a line that follows what looks like a road and the straight one, by what the picture says of either.
///
/// Whoever draws a road expects it to be straight unless the picture says otherwise. The log-likelihood of a line is the
/// integral of ln p along it, divided by the length of one look: pixels that are nearer than a road is wide show
/// the same. So a longer way pays for its length. A corner has two coordinates, which cost ln n together, n the looks
/// along the straight line (Schwarz 1978).
pub(super) struct RoadBends<'a> {
    /// Probability of road.
    pub(super) probability: &'a Gray,
    /// Width of the road, pixels.
    pub(super) width: f64,
}

impl RoadBends<'_> {
    /// The line with a straight one in the place of every stretch that is not worth its corners, unless the stretch lies on a
    /// straight road of that width: it is the better middle of that. One that is worth no corner at all is straight.
    /// Places are pixels of the probability.
    pub(super) fn kept(&self, line: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let [first, .., last] = line else {
            return line.to_vec();
        };
        let looks = distance(*first, *last) / self.width;
        let corner = looks.max(1.0).ln();
        let corners = self.worth(line, corner).1;
        if corners.is_empty() {
            return vec![*first, *last];
        }
        let mut kept = vec![*first];
        let mut from = 0;
        for to in corners.into_iter().chain([line.len() - 1]) {
            let (_, off) = farthest(&line[from..=to]);
            if off <= 0.5 * self.width {
                kept.extend_from_slice(&line[from + 1..to]);
            }
            kept.push(line[to]);
            from = to;
        }
        kept
    }

    /// Greatest log-likelihood of a line less the cost of its corners, and those of the line of so much: numbers of places
    /// of `line`, which is cut where it is farthest from straight (Douglas and Peucker 1973) as long as that is worth it.
    fn worth(&self, line: &[[f64; 2]], corner: f64) -> (f64, Vec<usize>) {
        let last = line.len() - 1;
        let straight = self.log_likelihood(line[0], line[last]);
        if last < 2 {
            return (straight, Vec::new());
        }
        let (at, _) = farthest(line);
        let (before, mut corners) = self.worth(&line[..=at], corner);
        let (behind, rest) = self.worth(&line[at..], corner);
        let bent = before + behind - corner;
        if bent <= straight {
            return (straight, Vec::new());
        }
        corners.push(at);
        corners.extend(rest.into_iter().map(|it| it + at));
        (bent, corners)
    }

    /// Log-likelihood of a straight line.
    fn log_likelihood(&self, from: [f64; 2], to: [f64; 2]) -> f64 {
        let length = distance(from, to);
        let sum: f64 = samples(from, to)
            .map(|place| f64::from(value_at(self.probability, place).max(LEAST).ln()))
            .sum();
        sum * length / steps(length) as f64 / self.width
    }
}

/// Distance between places, pixels.
pub(super) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Value of the pixel at a place, the nearest one of the picture.
pub(super) fn value_at<T: Copy>(picture: &Raster<T>, [x, y]: [f64; 2]) -> T {
    let within = |at: f64, size: usize| (at.max(0.0) as usize).min(size - 1);
    picture.get(within(x, picture.width()), within(y, picture.height()))
}

/// Parts of a line of about a pixel each.
fn steps(length: f64) -> usize {
    length.ceil().max(1.0) as usize
}

/// Middles of the parts of a straight line.
pub(super) fn samples(from: [f64; 2], to: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    let count = steps(distance(from, to));
    (0..count).map(move |part| {
        let share = (part as f64 + 0.5) / count as f64;
        [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]))
    })
}

/// Number of the inner place of a line that is farthest from the straight one between its ends, and how far, pixels.
fn farthest(line: &[[f64; 2]]) -> (usize, f64) {
    let (from, to) = (line[0], line[line.len() - 1]);
    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    let off = |place: [f64; 2]| {
        let [x, y] = [place[0] - from[0], place[1] - from[1]];
        let share =
            ((x * dx + y * dy) / (dx * dx + dy * dy).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        (x - share * dx).hypot(y - share * dy)
    };
    let inner = (1..line.len() - 1).map(|i| (i, off(line[i])));
    let most = inner.max_by(|a, b| a.1.total_cmp(&b.1));
    most.unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A road of ten pixels to the right, in which a second one makes a detour of `by` pixels, as probable as said.
    fn with_detour(straight: f32, detour: f32, by: f64) -> (Gray, Vec<[f64; 2]>) {
        let line: Vec<[f64; 2]> = (0..=60)
            .map(|i| {
                let x = 10.0 + 3.0 * f64::from(i);
                [x, 60.0 - by * (1.0 - ((x - 100.0) / 90.0).powi(2))]
            })
            .collect();
        let probability = Gray::from_fn(200, 120, |x, y| {
            let place = [x as f64 + 0.5, y as f64 + 0.5];
            if line.iter().any(|it| distance(*it, place) < 5.0) {
                detour
            } else if (place[1] - 60.0).abs() < 5.0 {
                straight
            } else {
                0.02
            }
        });
        (probability, line)
    }

    fn kept(probability: &Gray, line: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let bends = RoadBends {
            probability,
            width: 10.0,
        };
        bends.kept(line)
    }

    #[test]
    fn a_detour_that_looks_little_better_is_straightened_and_one_that_looks_much_better_is_not() {
        let (probability, line) = with_detour(0.7, 0.9, 20.0);
        assert_eq!(kept(&probability, &line), [line[0], line[60]]);
        let (probability, line) = with_detour(0.05, 0.9, 20.0);
        assert_eq!(kept(&probability, &line), line);
    }

    #[test]
    fn a_stretch_that_leaves_a_straight_road_is_straightened_alone() {
        // Right, then down, with a bulge of 12 pixels on the way to the right.
        let is_road = |x: f64, y: f64| {
            (y - 60.0).abs() < 5.0 && x < 205.0 || (x - 200.0).abs() < 5.0 && y > 55.0
        };
        let probability = Gray::from_fn(240, 240, |x, y| {
            let bulge = (40..120).contains(&x) && (44..65).contains(&y);
            match (is_road(x as f64 + 0.5, y as f64 + 0.5), bulge) {
                (true, _) => 0.8,
                (false, true) => 0.85,
                _ => 0.02,
            }
        });
        let bulge = [[10.0, 60.0], [50.0, 52.0], [80.0, 48.0], [110.0, 52.0]];
        let rest = [[150.0, 60.0], [200.0, 60.0], [200.0, 150.0], [200.0, 230.0]];
        let kept = kept(&probability, &[bulge, rest].concat());
        let ends = [bulge[0], rest[1], rest[3]];
        assert!(ends.iter().all(|end| kept.contains(end)), "{kept:?}");
        assert!(!kept.contains(&bulge[2]), "{kept:?}");
    }
}
