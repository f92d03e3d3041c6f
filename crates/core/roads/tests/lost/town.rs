//! Towns that never were.

use std::collections::BTreeMap;

use pilotage_base::frames::GroundPoint;
use pilotage_roads::{RoadJoining, RoadLine, RoadMap};

use super::drawn::Draw;

/// Mean distance between the crossings of a town, metres.
const BLOCK: f64 = 110.0;

/// A town of `blocks` by `blocks` irregular blocks by a seed, some streets missing.
pub fn town(seed: u64, blocks: i32) -> RoadMap {
    let mut draw = Draw::new(seed);
    let mut corners = BTreeMap::new();
    for row in 0..=blocks {
        for column in 0..=blocks {
            let (north, east) = (draw.between(-0.35, 0.35), draw.between(-0.35, 0.35));
            let corner = GroundPoint::new(
                BLOCK * (f64::from(row) + north),
                BLOCK * (f64::from(column) + east),
            );
            corners.insert((row, column), corner);
        }
    }
    let mut lines = Vec::new();
    for ((row, column), corner) in &corners {
        for next in [(row + 1, *column), (*row, column + 1)] {
            let Some(other) = corners.get(&next) else {
                continue;
            };
            if draw.chance(0.8) {
                lines.push(RoadLine {
                    width: 6.0,
                    course: vec![*corner, *other],
                    ..RoadLine::default()
                });
            }
        }
    }
    RoadMap::new(lines, RoadJoining::SHARED_POINTS)
}
