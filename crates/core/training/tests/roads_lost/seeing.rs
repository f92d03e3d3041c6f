//! Pictures drawn around the roads of a map, and what the network sees in them.

use nalgebra::Vector2;
use pilotage_base::frames::GroundPoint;
use pilotage_roads::lost::{RoadView, ViewCrossing, ViewPoint, ViewPose};
use pilotage_roads::{RoadMap, place_along};
use pilotage_training::road::drawn_over;
use pilotage_vision::road::{RoadDetection, SeenCrossing};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Side of a drawn picture, pixels and metres.
const SIDE: usize = 1200;
const METRES: f64 = 600.0;
const GSD: f64 = METRES / SIDE as f64;
/// Metres of ground that a view shows ahead; it shows 600 m across.
const AHEAD: f64 = 450.0;
/// Least probability of a point that counts.
const LEAST: f64 = 0.5;
/// Error of the map across, each edge by its own, at most, metres.
const OF_MAP: f64 = 3.0;

/// Pixel of a place of the view.
fn pixel(place: Vector2<f64>) -> [f32; 2] {
    [
        ((place.y + 0.5 * METRES) / GSD) as f32,
        ((0.5 * METRES - place.x) / GSD) as f32,
    ]
}

/// Roads around a pose as courses in pixels with half their width.
fn roads(map: &RoadMap, pose: &ViewPose, random: &mut ChaCha8Rng) -> Vec<(Vec<[f32; 2]>, f32)> {
    let mut roads = Vec::new();
    for (index, edge) in map.graph().edge_weights().enumerate() {
        let near = |p: &GroundPoint| p.distance(&pose.place) < METRES + edge.length;
        if !edge.course.first().is_some_and(near) {
            continue;
        }
        let off: f64 = random.random_range(-OF_MAP..OF_MAP);
        let (mut points, mut along, mut is_near) = (Vec::new(), 0.0, false);
        while along < edge.length + 3.0 {
            let on_road = place_along(&edge.course, along).unwrap();
            let (sin, cos) = on_road.heading.sin_cos();
            let moved = on_road.point.to_vector() + off * Vector2::new(-sin, cos);
            let place = pose.in_view(moved.into());
            is_near |= place.norm() < METRES;
            points.push(pixel(place));
            along += 3.0;
        }
        if is_near {
            roads.push((points, (0.5 * map.line_of(index).width / GSD) as f32));
        }
    }
    roads
}

/// View that the network has of 450 m by 600 m of drawn ground around a pose.
pub fn seen(map: &RoadMap, pose: &ViewPose, seed: u64) -> RoadView {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut picture = drawn_over(seed, SIDE, roads(map, pose, &mut random)).picture;
    let margin = ((0.5 * (METRES - AHEAD)) / GSD) as usize;
    for row in (0..margin).chain(SIDE - margin..SIDE) {
        picture.row_mut(row).fill([0; 4]);
    }
    let roads = RoadDetection::Network.roads_seen(&picture, GSD);
    let place = |[x, y]: [f64; 2]| Vector2::new(0.5 * METRES - GSD * y, GSD * x - 0.5 * METRES);
    let mut crossings = roads.crossings;
    crossings.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    let points = (roads.points.iter()).filter(|point| point.probability >= LEAST);
    let crossing = |crossing: &SeenCrossing| ViewCrossing {
        place: place(crossing.pixel),
        directions: crossing.directions.clone(),
    };
    RoadView {
        points: points
            .map(|point| ViewPoint {
                place: place(point.pixel),
                direction: point.direction,
            })
            .collect(),
        crossings: crossings.iter().map(crossing).collect(),
        outline: [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, y)| Vector2::new(0.5 * x * AHEAD, 0.5 * y * METRES))
            .to_vec(),
    }
}

/// Parts and wholes of what was seen: points that are true, road that was found, crossings that are true, crossings
/// that were found.
pub fn agreement(map: &RoadMap, pose: &ViewPose, view: &RoadView) -> [(usize, usize); 4] {
    let mut counts = [(0, 0); 4];
    let mut count = |of: usize, is_so: bool| {
        counts[of].0 += usize::from(is_so);
        counts[of].1 += 1;
    };
    for point in &view.points {
        let (at, direction) = (pose.on_map(point.place), point.direction + pose.turn);
        count(0, map.nearest_like(at, 5.0, direction, 0.4).is_some());
    }
    let inside = |place: &Vector2<f64>| place.x.abs() < 0.5 * AHEAD - 8.0 && place.y.abs() < 292.0;
    for edge in map.graph().edge_weights() {
        if edge.course[0].distance(&pose.place) > METRES + edge.length {
            continue;
        }
        let mut along = 4.0;
        while along < edge.length {
            let on_road = place_along(&edge.course, along).unwrap();
            let place = pose.in_view(on_road.point);
            let direction = on_road.heading - pose.turn;
            along += 8.0;
            if inside(&place) {
                let is_like = |p: &ViewPoint| {
                    (p.place - place).norm() < 6.0 && (p.direction - direction).sin().abs() < 0.4
                };
                count(1, view.points.iter().any(is_like));
            }
        }
    }
    let known = map.crossings().into_iter().map(|c| pose.in_view(c.place));
    let known: Vec<Vector2<f64>> = known.filter(inside).collect();
    for crossing in &view.crossings {
        let near = |k: &Vector2<f64>| (k - crossing.place).norm() < 8.0;
        count(2, known.iter().any(near));
    }
    for place in &known {
        let near = |c: &ViewCrossing| (c.place - place).norm() < 8.0;
        count(3, view.crossings.iter().any(near));
    }
    counts
}
