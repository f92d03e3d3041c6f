//! The roads of the scenery as a road map has them.

use super::things::{Road, SceneryRoadClass};
use super::turn;
use pilotage_base::frames::GroundRect;
use pilotage_roads::{RoadClass, RoadLine};

/// Centre lines within `bounds` of the world, in the plan's order: streams are none.
pub(super) fn centre_lines(roads: &[Road], bounds: &GroundRect) -> Vec<RoadLine> {
    let line = |road: &Road| {
        let class = match road.class {
            SceneryRoadClass::Stream => return None,
            SceneryRoadClass::Track => RoadClass::Track,
            SceneryRoadClass::Street => RoadClass::Residential,
            SceneryRoadClass::Main => RoadClass::Secondary,
        };
        Some(RoadLine {
            name: road.name.unwrap_or_default().to_owned(),
            class,
            width: 2.0 * f64::from(road.half_width),
            course: road
                .curve
                .iter()
                .map(|s| turn::point(&s.ground()))
                .collect(),
            ..RoadLine::default()
        })
    };
    let lines = roads.iter().filter_map(line);
    lines.flat_map(|line| line.within(bounds)).collect()
}
