//! Roads of the mission on the map: those in view, with no more points than the scale shows.

use egui::{Painter, Pos2, Rect, Shape, Stroke};
use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_core::roads::{RoadClass, RoadLine, RoadsMark, SharedRoads, thinned};

use super::transform::ScreenFromWorld;
use crate::tokens::Tokens;

/// Width of the line of a road by its class, points.
const WEIGHTS: [f32; 9] = [1.0, 1.2, 1.4, 1.8, 2.2, 2.6, 3.0, 3.4, 4.0];
/// Farthest that a thinned line lies off the road, as a share of the least metres per point of its octave.
const TOLERANCE: f64 = 0.5;
/// Least size on the screen at which a road is drawn, points.
const LEAST: f32 = 2.0;
/// Most points of roads that are drawn: beyond, the lesser classes are left out.
const MOST_POINTS: usize = 20_000;
/// Most points with an edge that lifts the lines off the ground.
const MOST_EDGED: usize = 8_000;
/// Coarsest scale at which crossings have dots, metres per point.
const CROSSINGS: f64 = 1.5;

/// A road as it is drawn.
#[derive(Clone, Debug)]
struct DrawnRoad {
    class: RoadClass,
    width: f64,
    bounds: GroundRect,
    course: Vec<GroundPoint>,
}

/// The roads as they are drawn at about one scale.
#[derive(Clone, Debug, Default)]
pub struct DrawnRoads {
    /// Roads and octave of the scale that they were made for.
    made_of: (RoadsMark, i32),
    roads: Vec<DrawnRoad>,
    crossings: Vec<GroundPoint>,
}

impl DrawnRoads {
    /// Follows the mission's roads at a scale, metres per point.
    pub fn follow(&mut self, roads: &SharedRoads, metres_per_point: f64) {
        let octave = metres_per_point.log2().floor() as i32;
        let are_same = self.made_of.0.is_of(roads);
        if are_same && self.made_of.1 == octave {
            return;
        }
        if !are_same {
            self.crossings = crossings(roads);
        }
        self.made_of = (roads.mark(), octave);
        let tolerance = TOLERANCE * 2_f64.powi(octave);
        let drawn = roads.iter().filter_map(|road| {
            Some(DrawnRoad {
                class: road.class,
                width: road.width,
                bounds: GroundRect::around(road.course.iter().copied())?,
                course: thinned(&road.course, tolerance),
            })
        });
        self.roads = drawn.collect();
    }

    /// The roads that are drawn in `rect` of the screen.
    fn in_view(&self, view: &ScreenFromWorld, rect: Rect) -> Vec<&DrawnRoad> {
        let seen = view.visible(rect);
        let mut points = [0; RoadClass::ALL.len()];
        let is_seen = |road: &&DrawnRoad| {
            let size = road.bounds.width().max(road.bounds.height());
            road.bounds.grown(road.width).overlaps(&seen) && view.points(size) >= LEAST
        };
        let mut shown: Vec<&DrawnRoad> = self.roads.iter().filter(is_seen).collect();
        for road in &shown {
            points[road.class as usize] += road.course.len();
        }
        let mut total = 0;
        let is_enough = |count: &usize| {
            total += count;
            total > MOST_POINTS
        };
        let left_out = points.iter().rev().position(is_enough);
        // The greatest class is drawn however many roads it has.
        let kept = left_out.map_or(points.len(), |count| count.max(1));
        shown.retain(|road| road.class as usize + kept >= points.len());
        shown
    }

    /// Draws those in `rect` of the screen.
    pub fn paint(&self, painter: &Painter, view: &ScreenFromWorld, rect: Rect, tokens: &Tokens) {
        let shown = self.in_view(view, rect);
        let count: usize = shown.iter().map(|road| road.course.len()).sum();
        let mut lines = Vec::with_capacity(shown.len());
        for road in shown {
            let line: Vec<Pos2> = road.course.iter().map(|p| view.apply(p)).collect();
            let weight = WEIGHTS[road.class as usize];
            let width = view.points(road.width);
            if width > weight + 3.0 {
                let ground = Stroke::new(width, tokens.road.gamma_multiply(0.3));
                painter.add(Shape::line(line.clone(), ground));
            } else if count <= MOST_EDGED {
                let edge = Stroke::new(weight + 2.0, tokens.outline());
                painter.add(Shape::line(line.clone(), edge));
            }
            lines.push(Shape::line(line, Stroke::new(weight, tokens.road)));
        }
        painter.extend(lines);
        if view.metres_per_point > CROSSINGS {
            return;
        }
        let edge = Stroke::new(1.5, tokens.outline());
        for place in self.crossings.iter().map(|place| view.apply(place)) {
            if rect.contains(place) {
                painter.circle(place, 3.5, tokens.road, edge);
            }
        }
    }
}

/// Places where three ways or more meet in a point that they share.
fn crossings(roads: &[RoadLine]) -> Vec<GroundPoint> {
    let mut ways = Vec::new();
    for road in roads {
        for (index, point) in road.course.iter().enumerate() {
            let is_end = index == 0 || index + 1 == road.course.len();
            ways.push((point.north, point.east, if is_end { 1 } else { 2 }));
        }
    }
    ways.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let same = ways.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1));
    let met = same.filter(|ways| ways.iter().map(|way| way.2).sum::<usize>() > 2);
    met.map(|ways| GroundPoint::new(ways[0].0, ways[0].1))
        .collect()
}

#[cfg(test)]
mod tests {
    use egui::{pos2, vec2};

    use super::super::transform::MapCamera;
    use super::*;

    fn road(class: RoadClass, course: &[(f64, f64)]) -> RoadLine {
        RoadLine {
            class,
            width: class.usual_width(),
            course: course
                .iter()
                .map(|(n, e)| GroundPoint::new(*n, *e))
                .collect(),
            ..RoadLine::default()
        }
    }

    fn shown(roads: &[RoadLine], metres_per_point: f64) -> Vec<(RoadClass, usize)> {
        let rect = Rect::from_min_size(pos2(0.0, 0.0), vec2(800.0, 600.0));
        let camera = MapCamera {
            metres_per_point,
            ..MapCamera::default()
        };
        let mut drawn = DrawnRoads::default();
        drawn.follow(&roads.to_vec().into(), metres_per_point);
        let shown = drawn.in_view(&camera.screen_from_world(rect), rect);
        shown.iter().map(|it| (it.class, it.course.len())).collect()
    }

    #[test]
    fn only_roads_in_view_are_drawn_and_none_too_small_to_be_seen() {
        let near = road(RoadClass::Track, &[(0.0, 0.0), (50.0, 0.0)]);
        let far = road(RoadClass::Track, &[(9000.0, 0.0), (9050.0, 0.0)]);
        assert_eq!(shown(&[near.clone(), far], 1.0), [(RoadClass::Track, 2)]);
        assert_eq!(shown(&[near], 40.0), []);
    }

    #[test]
    fn a_bend_keeps_its_points_near_by_and_loses_them_from_afar() {
        let bend: Vec<_> = (0..=100)
            .map(|i| (f64::from(i), 4.0 * (f64::from(i) / 20.0).sin()))
            .collect();
        let bend = [road(RoadClass::Primary, &bend)];
        let near = shown(&bend, 0.1)[0].1;
        let far = shown(&bend, 10.0)[0].1;
        assert!(near > 20 && far < 6, "{near}, {far}");
    }

    #[test]
    fn of_too_many_roads_the_lesser_classes_are_left_out() {
        let zigzag: Vec<_> = (0..80)
            .map(|i| (f64::from(i), 20.0 * f64::from(i % 2)))
            .collect();
        let mut roads = vec![road(RoadClass::Track, &zigzag); 300];
        roads.push(road(RoadClass::Primary, &[(0.0, 0.0), (100.0, 0.0)]));
        assert_eq!(shown(&roads, 1.0), [(RoadClass::Primary, 2)]);
        roads.truncate(200);
        assert_eq!(shown(&roads, 1.0).len(), 200);
    }

    #[test]
    fn three_ways_make_a_crossing_and_two_make_none() {
        let through = road(RoadClass::Primary, &[(0.0, 0.0), (50.0, 0.0), (90.0, 0.0)]);
        let side = road(RoadClass::Track, &[(50.0, 0.0), (50.0, 40.0)]);
        let on = road(RoadClass::Track, &[(50.0, 40.0), (80.0, 40.0)]);
        let met = crossings(&[through, side, on]);
        assert_eq!(met, [GroundPoint::new(50.0, 0.0)]);
    }

    #[test]
    fn a_road_that_was_moved_is_drawn_where_it_is() {
        let mut drawn = DrawnRoads::default();
        let mut roads = SharedRoads::from(vec![road(RoadClass::Track, &[(0.0, 0.0), (50.0, 0.0)])]);
        drawn.follow(&roads, 1.0);
        roads.make_mut()[0].course[1].east = 7.0;
        drawn.follow(&roads, 1.0);
        assert_eq!(drawn.roads[0].course, roads[0].course);
    }
}
