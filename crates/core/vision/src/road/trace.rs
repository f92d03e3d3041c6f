//! Lines drawn with help: from place to place along what looks like a road.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::distance::distance_inside;
use super::probability::RoadProbability;

/// Cost of a pixel of a certain road, against that of a pixel of none.
const LEAST_COST: f32 = 0.05;
/// Distance from the edges at which nothing more is gained, pixels.
const DEEP: f32 = 6.0;
/// Pixels between the corners of a traced line.
const SPACING: usize = 6;
/// Parts of a pixel in which costs are counted.
const PARTS: f32 = 256.0;

/// The line from place to place (pixels of the picture) that costs least: each pixel of it costs less the more probable
/// a road is there, and less in the middle of a road than at its edges. The ends are the given ones; `None` if either
/// lies outside.
///
/// ```
/// use pilotage_raster::raster::Gray;
/// use pilotage_vision::road::{RoadProbability, trace};
///
/// // A road that goes right, then down.
/// let is_road = |x: usize, y: usize| (8..13).contains(&y) && x < 53 || (48..53).contains(&x) && y > 8;
/// let probability = Gray::from_fn(60, 60, |x, y| if is_road(x, y) { 0.95 } else { 0.02 });
/// let seen = RoadProbability { probability, scale: [1.0, 1.0] };
/// let line = trace(&seen, [2.5, 10.5], [50.5, 57.5]).ok_or("outside")?;
/// assert!(line.iter().all(|p| is_road(p[0] as usize, p[1] as usize)));
/// assert!(trace(&seen, [2.5, 10.5], [70.0, 3.0]).is_none());
/// # Ok::<(), &str>(())
/// ```
pub fn trace(seen: &RoadProbability, from: [f64; 2], to: [f64; 2]) -> Option<Vec<[f64; 2]>> {
    let (width, height) = (seen.probability.width(), seen.probability.height());
    let pixel = |[x, y]: [f64; 2]| {
        let (x, y) = ((x * seen.scale[0]).floor(), (y * seen.scale[1]).floor());
        let inside = x >= 0.0 && y >= 0.0 && x < width as f64 && y < height as f64;
        inside.then(|| y as usize * width + x as usize)
    };
    let (start, end) = (pixel(from)?, pixel(to)?);
    let costs = costs(seen);
    let mut cheapest = vec![u32::MAX; width * height];
    let mut came_from = vec![u32::MAX; width * height];
    let mut open = BinaryHeap::from([Reverse((0_u32, start))]);
    cheapest[start] = 0;
    while let Some(Reverse((cost, at))) = open.pop() {
        if at == end {
            break;
        }
        if cost > cheapest[at] {
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
                let step = 0.5 * PARTS * length * (costs[at] + costs[next]);
                let total = cost.saturating_add(step as u32);
                if next != at && total < cheapest[next] {
                    cheapest[next] = total;
                    came_from[next] = at as u32;
                    open.push(Reverse((total, next)));
                }
            }
        }
    }
    let mut line = vec![to];
    let mut at = end;
    let mut count = 0;
    while at != start {
        at = came_from[at] as usize;
        count += 1;
        if at != start && count % SPACING == 0 {
            line.push([
                ((at % width) as f64 + 0.5) / seen.scale[0],
                ((at / width) as f64 + 0.5) / seen.scale[1],
            ]);
        }
    }
    line.push(from);
    line.reverse();
    Some(line)
}

/// Cost of each pixel.
fn costs(seen: &RoadProbability) -> Vec<f32> {
    let inside = distance_inside(&seen.mask(), DEEP);
    let pairs = seen.probability.pixels().iter().zip(inside.pixels());
    let cost = |(p, depth): (&f32, &f32)| {
        let by_road = (1.0 - p) * (1.0 - p);
        LEAST_COST + by_road + 0.3 * LEAST_COST * (DEEP - depth)
    };
    pairs.map(cost).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_raster::raster::Gray;

    #[test]
    fn a_line_follows_a_bent_road_in_its_middle_over_a_gap() {
        // A quarter of a ring around the origin, 9 pixels wide, with a crown over it.
        let seen = RoadProbability {
            probability: Gray::from_fn(140, 140, |x, y| {
                let radius = (x as f32 + 0.5).hypot(y as f32 + 0.5);
                let hidden = (60..68).contains(&x) && y > 60;
                if (radius - 100.0).abs() < 4.5 && !hidden {
                    0.9
                } else {
                    0.05
                }
            }),
            scale: [0.5, 0.5],
        };
        let line = trace(&seen, [200.0, 6.0], [6.0, 200.0]).expect("inside");
        assert_eq!(
            (line[0], line[line.len() - 1]),
            ([200.0, 6.0], [6.0, 200.0])
        );
        assert!(line.len() > 15);
        for [x, y] in &line {
            let off = (0.5 * x).hypot(0.5 * y) - 100.0;
            assert!(off.abs() < 3.0, "{x} {y}: {off} pixels off the middle");
        }
    }
}
