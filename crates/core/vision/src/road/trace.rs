//! Lines drawn with help: from place to place along what looks like a road.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use pilotage_raster::raster::Raster;

use super::bends::{RoadBends, distance, samples, value_at};
use super::probability::RoadProbability;
use super::ridge::{RoadBody, ridge_points};
use super::seen::{RoadPoint, along};

/// Cost of a pixel of a certain road, where one of none costs 1 more: a road is followed up to three times as far as the way
/// beside it, about as far as ways may be longer than the straight one.
const LENGTH_COST: f32 = 0.5;
/// Cost of a pixel from the edges, and the distance from them at which nothing more is gained, pixels.
const EDGE_COST: f32 = 0.015;
const DEEP: f32 = 6.0;
/// Pixels of the way whose points on the centre line make one corner of the line.
const SPACING: usize = 6;
/// Parts of a pixel in which costs are counted.
const PARTS: f32 = 256.0;
/// Pixels of the way that are looked over together for what lies beside them.
const STRETCH: usize = 32;
/// Greatest sine of the angle between a way and the roads that it follows.
const LIKE: f64 = 0.5;
/// Greatest ratio of widths of one road: where it seems to end, ever narrower lines lead from its middle into its corners,
/// and where others meet it, it is wide.
const ALIKE: f64 = 1.5;

/// A line along a road, in pixels of the picture; of two places where the road is straight.
#[derive(Clone, Debug, PartialEq)]
pub struct TracedRoad {
    /// Places (x, y) from the one end to the other: on the centre line where a road is seen, straight in between.
    pub line: Vec<[f64; 2]>,
    /// Median width of the road, pixels; `None` where no centre line is seen.
    pub width: Option<f64>,
    /// Share of the line that is expected to lie on a road: the mean of the probability along it.
    pub on_road: f64,
    /// Length of the longest stretch on which no road is seen, pixels.
    pub gap: f64,
}

impl TracedRoad {
    /// Whether it is rather a road than none, by what its pixels look like.
    pub fn is_road(&self) -> bool {
        self.on_road >= 0.5 && self.width.is_some()
    }
}

/// Search for the way between two places of a picture that costs least: each pixel costs less the more probable a road is
/// there, and less in the middle of a road than at its edges (Dijkstra 1959, as live-wire tools of drawing do). A line that the
/// picture makes little more likely than the straight one is straight.
///
/// ```
/// use pilotage_raster::raster::Gray;
/// use pilotage_vision::road::{RoadProbability, RoadTrace};
///
/// // A road that goes right, then down.
/// let is_road = |x: usize, y: usize| (8..15).contains(&y) && x < 53 || (46..53).contains(&x) && y > 8;
/// let probability = Gray::from_fn(60, 60, |x, y| if is_road(x, y) { 0.95 } else { 0.02 });
/// let seen = RoadProbability { probability, scale: [1.0, 1.0] };
/// let mut trace = RoadTrace::new(seen.clone(), [2.5, 10.5], [50.5, 57.5], 120.0).ok_or("outside")?;
/// while trace.advance() {}
/// let road = trace.traced([true, true]);
/// assert!(road.line.iter().all(|p| is_road(p[0] as usize, p[1] as usize)));
/// assert!((road.width.unwrap_or_default() - 7.0).abs() < 1.5 && road.on_road > 0.9);
/// assert!(RoadTrace::new(seen, [2.5, 10.5], [70.0, 3.0], 120.0).is_none());
/// # Ok::<(), &str>(())
/// ```
pub struct RoadTrace {
    seen: RoadProbability,
    body: RoadBody,
    ends: [[f64; 2]; 2],
    start: usize,
    end: usize,
    costs: Vec<f32>,
    cheapest: Vec<u32>,
    came_from: Vec<u32>,
    open: BinaryHeap<Reverse<(u32, usize)>>,
}

impl RoadTrace {
    /// Nothing searched yet. The way passes no pixel over which any way between the ends is longer than `longest`, pixels of
    /// the picture as all places are; `None` if an end lies outside.
    pub fn new(seen: RoadProbability, from: [f64; 2], to: [f64; 2], longest: f64) -> Option<Self> {
        let (width, height) = (seen.probability.width(), seen.probability.height());
        let scaled = [from, to].map(|[x, y]| [x * seen.scale[0], y * seen.scale[1]]);
        let [start, end] = scaled.map(|[x, y]| {
            let inside = x >= 0.0 && y >= 0.0 && x < width as f64 && y < height as f64;
            inside.then(|| y as usize * width + x as usize)
        });
        let body = RoadBody::new(seen.mask());
        let mut trace = Self {
            start: start?,
            end: end?,
            costs: Vec::new(),
            cheapest: vec![u32::MAX; width * height],
            came_from: vec![u32::MAX; width * height],
            open: BinaryHeap::new(),
            ends: [from, to],
            body,
            seen,
        };
        trace.costs = trace.costs_within(scaled, longest * trace.seen.mean_scale());
        trace.cheapest[trace.start] = 0;
        trace.open.push(Reverse((0, trace.start)));
        Some(trace)
    }

    /// Cost of each pixel, endless beyond the ellipse of the ways that are not too long.
    fn costs_within(&self, [from, to]: [[f64; 2]; 2], longest: f64) -> Vec<f32> {
        let width = self.seen.probability.width();
        // The straight way is within it, with the pixels that it touches.
        let longest = longest.max(distance(from, to)) + 3.0;
        let of = |at: usize| {
            let place = [(at % width) as f64 + 0.5, (at / width) as f64 + 0.5];
            if distance(place, from) + distance(place, to) > longest {
                return f32::INFINITY;
            }
            let p = self.seen.probability.pixels()[at];
            let depth = self.body.inside.pixels()[at].min(DEEP);
            LENGTH_COST + (1.0 - p) * (1.0 - p) + EDGE_COST * (DEEP - depth)
        };
        (0..self.cheapest.len()).map(of).collect()
    }

    /// Looks at the next pixels of the search; whether there are more.
    pub fn advance(&mut self) -> bool {
        /// Pixels between two looks at the clock.
        const PIXELS: usize = 20_000;
        let (width, height) = (
            self.seen.probability.width(),
            self.seen.probability.height(),
        );
        for _ in 0..PIXELS {
            let Some(Reverse((cost, at))) = self.open.pop() else {
                return false;
            };
            if at == self.end {
                return false;
            }
            if cost > self.cheapest[at] {
                continue;
            }
            let (x, y) = (at % width, at / width);
            for row in y.saturating_sub(1)..(y + 2).min(height) {
                for column in x.saturating_sub(1)..(x + 2).min(width) {
                    let next = row * width + column;
                    let length = if row != y && column != x {
                        std::f32::consts::SQRT_2
                    } else {
                        1.0
                    };
                    let step = 0.5 * PARTS * length * (self.costs[at] + self.costs[next]);
                    let total = cost.saturating_add(step as u32);
                    if next != at && total < self.cheapest[next] {
                        self.cheapest[next] = total;
                        self.came_from[next] = at as u32;
                        self.open.push(Reverse((total, next)));
                    }
                }
            }
        }
        true
    }

    /// The line that was found, once nothing is left to be searched; the straight one before. An end that is free to move
    /// and lies on a road is put into the middle of that.
    pub fn traced(self, is_free: [bool; 2]) -> TracedRoad {
        let way = self.way();
        let places: Vec<[f64; 2]> = way.iter().map(|at| self.middle(*at)).collect();
        let probability = &self.seen.probability;
        let points = ridge_points(&self.body, probability);
        let mut along = beside(&places, &points);
        let mut width = usual_width(&along);
        let line = self.line(&along, places.len(), is_free, width);
        let places: Vec<[f64; 2]> = line
            .windows(2)
            .flat_map(|piece| samples(piece[0], piece[1]))
            .collect();
        if line.len() == 2 && places.len() > 1 {
            // Of the road below it, which may be another one.
            along = beside(&places, &points);
            width = usual_width(&along);
        }
        let sum: f64 = places
            .iter()
            .map(|it| f64::from(value_at(probability, *it)))
            .sum();
        let mut line: Vec<[f64; 2]> = line.into_iter().map(|it| self.in_picture(it)).collect();
        let last = line.len() - 1;
        for (at, end) in [(0, self.ends[0]), (last, self.ends[1])] {
            // Ends that stay are the very ones.
            if distance(line[at], end) < 1e-9 {
                line[at] = end;
            }
        }
        let scale = self.seen.mean_scale();
        TracedRoad {
            width: width.map(|width| width / scale),
            on_road: sum / places.len().max(1) as f64,
            gap: gap(&self.body.mask, &places) / scale,
            line,
        }
    }

    /// The line through the points beside a way of so many pixels, with the bends that the picture is worth.
    fn line(
        &self,
        along: &[(usize, RoadPoint)],
        pixels: usize,
        is_free: [bool; 2],
        width: Option<f64>,
    ) -> Vec<[f64; 2]> {
        let usual = width.unwrap_or_default();
        let is_usual = |point: &RoadPoint| (usual / ALIKE..=usual * ALIKE).contains(&point.width);
        let beside: Vec<(usize, RoadPoint)> =
            along.iter().filter(|it| is_usual(&it.1)).copied().collect();
        let [from, to] = [0, 1].map(|end| {
            let [x, y] = self.ends[end];
            let own = [x * self.seen.scale[0], y * self.seen.scale[1]];
            let at = if end == 0 { self.start } else { self.end };
            let is_moved = is_free[end] && self.body.mask.pixels()[at];
            let middle = is_moved.then(|| nearest(&beside, own)).flatten();
            middle.unwrap_or(own)
        });
        let mut line = vec![from];
        line.extend(corners(&beside, pixels));
        line.push(to);
        let bends = width.map(|width| RoadBends {
            probability: &self.seen.probability,
            width,
        });
        bends.map_or_else(|| vec![from, to], |bends| bends.kept(&line))
    }

    /// Pixels of the cheapest way, from the start to the end.
    fn way(&self) -> Vec<usize> {
        let mut way = vec![self.end];
        let mut at = self.end;
        while at != self.start && self.came_from[at] != u32::MAX {
            at = self.came_from[at] as usize;
            way.push(at);
        }
        way.reverse();
        way
    }

    /// Middle of a pixel of the probability.
    fn middle(&self, at: usize) -> [f64; 2] {
        let width = self.seen.probability.width();
        [(at % width) as f64 + 0.5, (at / width) as f64 + 0.5]
    }

    fn in_picture(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [x / self.seen.scale[0], y / self.seen.scale[1]]
    }
}

/// Points of centre lines that run with the way, which lies on their roads: each with the number of the nearest place of it.
fn beside(way: &[[f64; 2]], points: &[RoadPoint]) -> Vec<(usize, RoadPoint)> {
    let direction = |at: usize| {
        let (from, to) = (
            way[at.saturating_sub(SPACING)],
            way[(at + SPACING).min(way.len() - 1)],
        );
        along(to[0] - from[0], to[1] - from[1])
    };
    let near = |point: &RoadPoint| {
        let half = 0.5 * point.width + 1.0;
        let mut nearest: Option<(f64, usize)> = None;
        for (stretch, places) in way.chunks(STRETCH).enumerate() {
            if distance(places[0], point.pixel) > half + 1.5 * STRETCH as f64 {
                continue;
            }
            for (i, place) in places.iter().enumerate() {
                let off = distance(*place, point.pixel);
                if off <= half && nearest.is_none_or(|(least, _)| off < least) {
                    nearest = Some((off, stretch * STRETCH + i));
                }
            }
        }
        nearest.map(|(_, at)| at)
    };
    let found = points.iter().filter_map(|point| {
        let at = near(point)?;
        let is_like = (direction(at) - point.direction).sin().abs() < LIKE;
        is_like.then_some((at, *point))
    });
    found.collect()
}

/// Place on a centre line that is nearest to a place on the road.
fn nearest(beside: &[(usize, RoadPoint)], place: [f64; 2]) -> Option<[f64; 2]> {
    let on = beside.iter().filter_map(|(_, point)| {
        let off = distance(point.pixel, place);
        (off <= 0.5 * point.width + 1.0).then_some((off, point.pixel))
    });
    on.min_by(|a, b| a.0.total_cmp(&b.0)).map(|it| it.1)
}

/// Places of the line between its ends: the mean of the points beside every few pixels of a way of so many, but for the first
/// and last of them, so that no end is passed.
fn corners(beside: &[(usize, RoadPoint)], pixels: usize) -> Vec<[f64; 2]> {
    let mut sums = vec![([0.0; 2], 0.0); pixels.div_ceil(SPACING)];
    for (at, point) in beside {
        if (SPACING..pixels.saturating_sub(SPACING)).contains(at) {
            let (sum, count) = &mut sums[at / SPACING];
            sum[0] += point.pixel[0];
            sum[1] += point.pixel[1];
            *count += 1.0;
        }
    }
    let seen = sums.into_iter().filter(|it| it.1 > 0.0);
    seen.map(|([x, y], count)| [x / count, y / count]).collect()
}

/// Median width of the roads of points, pixels.
fn usual_width(along: &[(usize, RoadPoint)]) -> Option<f64> {
    let mut widths: Vec<f64> = along.iter().map(|(_, point)| point.width).collect();
    widths.sort_unstable_by(f64::total_cmp);
    widths.get(widths.len() / 2).copied()
}

/// Distance between the ends of the longest stretch of a line of such places off all roads, pixels.
fn gap(mask: &Raster<bool>, places: &[[f64; 2]]) -> f64 {
    let mut longest = 0.0_f64;
    let mut begun = None;
    for place in places {
        if value_at(mask, *place) {
            begun = None;
        } else {
            longest = longest.max(distance(*begun.get_or_insert(*place), *place));
        }
    }
    longest
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_raster::raster::Gray;

    fn traced(seen: RoadProbability, from: [f64; 2], to: [f64; 2]) -> TracedRoad {
        let longest = 2.0 * distance(from, to);
        let mut trace = RoadTrace::new(seen, from, to, longest).expect("inside");
        while trace.advance() {}
        trace.traced([true, true])
    }

    /// A quarter of a ring around the origin, of radius 100 and 9 pixels wide, but where it is hidden.
    fn ring(is_hidden: impl Fn(usize, usize) -> bool) -> RoadProbability {
        RoadProbability {
            probability: Gray::from_fn(140, 140, |x, y| {
                let radius = (x as f32 + 0.5).hypot(y as f32 + 0.5);
                if (radius - 100.0).abs() < 4.5 && !is_hidden(x, y) {
                    0.9
                } else {
                    0.05
                }
            }),
            scale: [0.5, 0.5],
        }
    }

    #[test]
    fn a_line_follows_a_bent_road_in_its_middle_over_a_gap() {
        // With a crown over it.
        let seen = ring(|x, y| (60..68).contains(&x) && y > 60);
        let road = traced(seen, [204.0, 6.0], [6.0, 196.0]);
        assert!(road.line.len() > 15);
        for [x, y] in &road.line {
            let off = (0.5 * x).hypot(0.5 * y) - 100.0;
            // The road seems to end at the crown, and a corner of its end is as far away as a side.
            assert!(off.abs() < 1.5, "{x} {y}: {off} pixels off the middle");
        }
        let width = road.width.expect("a road");
        assert!((width - 18.0).abs() < 2.0, "{width}");
        let pieces = road.line.windows(2);
        let length: f64 = pieces.map(|piece| distance(piece[0], piece[1])).sum();
        assert!((length - 307.0).abs() < 12.0, "{length}");
        let (on_road, gap) = (road.on_road, road.gap);
        assert!(
            on_road > 0.7 && (14.0..50.0).contains(&gap),
            "{on_road}, {gap}"
        );
    }

    #[test]
    fn ends_that_are_not_free_stay_and_so_do_those_beside_the_road() {
        let ends = [[204.0, 6.0], [6.0, 250.0]];
        let mut trace = RoadTrace::new(ring(|_, _| false), ends[0], ends[1], 900.0).expect("in");
        while trace.advance() {}
        let line = trace.traced([false, true]).line;
        assert_eq!([line[0], line[line.len() - 1]], ends);
    }

    #[test]
    fn no_way_leaves_the_ellipse_of_the_ways_that_are_not_too_long() {
        // The road leads around; the way along it is 307 pixels, the straight one 270.
        let [from, to] = [[200.0, 6.0], [6.0, 200.0]];
        let mut trace = RoadTrace::new(ring(|_, _| false), from, to, 275.0).expect("in");
        while trace.advance() {}
        let way = trace.way();
        assert_eq!(way.last(), Some(&trace.end));
        for at in way {
            let [x, y] = trace.in_picture(trace.middle(at));
            let over = distance([x, y], from) + distance([x, y], to);
            assert!(over < 275.0 + 8.0, "{over}");
        }
    }

    #[test]
    fn a_straight_road_is_not_left_for_a_bent_one_that_looks_little_better() {
        // Ten pixels wide both, from the same begin to the same end.
        let is_bent = |x: f32, y: f32| (y - 40.0 - 0.002_5 * (x - 100.0).powi(2)).abs() < 5.0;
        let probability = Gray::from_fn(200, 120, |x, y| {
            let (x, y) = (x as f32 + 0.5, y as f32 + 0.5);
            if is_bent(x, y) {
                0.9
            } else if (y - 60.0).abs() < 5.0 {
                0.7
            } else {
                0.02
            }
        });
        let seen = RoadProbability {
            probability,
            scale: [1.0, 1.0],
        };
        let road = traced(seen, [10.5, 60.5], [189.5, 60.5]);
        assert_eq!(road.line.len(), 2, "{:?}", road.line);
        assert!((road.on_road - 0.75).abs() < 0.05 && road.gap == 0.0);
        assert!(road.width.is_some_and(|width| width > 7.0));
    }

    #[test]
    fn where_no_road_is_the_line_is_straight_and_says_so() {
        let seen = RoadProbability {
            probability: Gray::filled(90, 40, 0.03),
            scale: [1.0, 1.0],
        };
        let road = traced(seen, [5.0, 5.0], [80.0, 33.0]);
        assert_eq!(road.line, [[5.0, 5.0], [80.0, 33.0]]);
        assert!(road.width.is_none() && road.on_road < 0.1 && road.gap > 75.0);
    }
}
