//! Views drawn from a road map, with the errors of seeing.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector2;
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_roads::lost::{RoadView, ViewCrossing, ViewPoint, ViewPose};
use pilotage_roads::{RoadCrossing, RoadMap};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Errors of seeing and of the map.
#[derive(Clone, Copy, Debug)]
pub struct SeeingErrors {
    /// Share of road that is seen, and mean length of what is seen or missed in one piece, metres.
    pub recall: f64,
    pub stretch: f64,
    /// Share of what is seen that is road.
    pub precision: f64,
    /// Standard deviations across: of a point, and of the map by road, metres.
    pub point: f64,
    pub of_map: f64,
    /// Share of crossings that are seen, and of those seen that are true.
    pub crossing_recall: f64,
    pub crossing_precision: f64,
    /// Standard deviations of a crossing: place per axis (m), arms (rad).
    pub crossing_place: f64,
    pub arm: f64,
    /// Share of arms that are missed.
    pub arm_missed: f64,
}

/// Ground that a picture shows, ahead and across, metres.
pub const GROUND: (f64, f64) = (450.0, 600.0);

/// Map of which views are drawn, with its crossings.
pub struct Source {
    pub map: RoadMap,
    crossings: Vec<RoadCrossing>,
}

impl Source {
    pub fn new(map: RoadMap) -> Self {
        Self {
            crossings: map.crossings(),
            map,
        }
    }
}

/// Random numbers of a view.
pub struct Draw(ChaCha8Rng);

impl Draw {
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0.random_range(low..high)
    }

    pub fn chance(&mut self, share: f64) -> bool {
        self.0.random_bool(share.clamp(0.0, 1.0))
    }

    pub fn gauss(&mut self) -> f64 {
        StandardNormal.sample(&mut self.0)
    }

    /// Place anywhere at least `margin` metres within a rectangle, with any heading.
    pub fn pose(&mut self, within: &GroundRect, margin: f64) -> ViewPose {
        let within = within.grown(-margin);
        ViewPose {
            place: GroundPoint::new(
                self.between(within.south, within.north),
                self.between(within.west, within.east),
            ),
            turn: self.between(-PI, PI),
            scale: 1.0,
        }
    }
}

/// Corners of the ground that is looked at.
pub fn outline() -> Vec<Vector2<f64>> {
    let (ahead, across) = (0.5 * GROUND.0, 0.5 * GROUND.1);
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .map(|(x, y)| Vector2::new(x * ahead, y * across))
        .to_vec()
}

/// The view from a pose, whose scale is that of the truth; drawn anew for every seed.
pub fn drawn_view(
    source: &Source,
    pose: &ViewPose,
    errors: &SeeingErrors,
    draw: &mut Draw,
) -> RoadView {
    let mut view = RoadView {
        outline: outline(),
        ..RoadView::default()
    };
    let (half_ahead, half_across) = (0.5 * GROUND.0, 0.5 * GROUND.1);
    let inside = |p: &Vector2<f64>| p.x.abs() < half_ahead && p.y.abs() < half_across;
    let far = half_ahead.hypot(half_across) + 20.0;
    // Roads that the index leaves out are seen all the same.
    for edge in source.map.graph().edge_weights() {
        let near = |p: &GroundPoint| p.distance(&pose.place) < far + edge.length;
        if !edge.course.first().is_some_and(near) {
            continue;
        }
        let of_map = errors.of_map * draw.gauss();
        let mut is_seen = draw.chance(errors.recall);
        let mut left = 0.0;
        for pair in edge.course.windows(2) {
            let length = pair[0].distance(&pair[1]);
            let steps = (length / 4.0).ceil().max(1.0) as usize;
            for step in 0..steps {
                left -= length / steps as f64;
                if left < 0.0 {
                    is_seen = draw.chance(errors.recall);
                    left = errors.stretch * draw.between(0.3, 1.7);
                }
                if !is_seen {
                    continue;
                }
                let share = (step as f64 + 0.5) / steps as f64;
                let (from, to) = (pose.in_view(pair[0]), pose.in_view(pair[1]));
                let along = (to - from).normalize();
                let across = Vector2::new(-along.y, along.x);
                let off = of_map + errors.point * draw.gauss();
                let place = from + share * (to - from) + off * across;
                if inside(&place) {
                    let direction = along.y.atan2(along.x) + 0.06 * draw.gauss();
                    view.points.push(ViewPoint {
                        place,
                        direction: direction.rem_euclid(PI),
                    });
                }
            }
        }
    }
    add_false(&mut view, errors, draw);
    let mut true_ones = 0.0;
    for crossing in &source.crossings {
        if crossing.place.distance(&pose.place) > far {
            continue;
        }
        let place = pose.in_view(crossing.place);
        if !inside(&(1.04 * place)) || !draw.chance(errors.crossing_recall) {
            continue;
        }
        let mut directions: Vec<f64> = Vec::new();
        for direction in &crossing.directions {
            if !draw.chance(errors.arm_missed) {
                directions
                    .push((direction - pose.turn + errors.arm * draw.gauss()).rem_euclid(TAU));
            }
        }
        if directions.len() < 3 {
            continue;
        }
        true_ones += 1.0;
        let off = errors.crossing_place * Vector2::new(draw.gauss(), draw.gauss());
        view.crossings.push(ViewCrossing {
            place: place + off,
            directions,
        });
    }
    let mut others = true_ones * (1.0 / errors.crossing_precision - 1.0);
    while others > 0.0 && draw.chance(others) {
        others -= 1.0;
        let first = draw.between(0.0, TAU);
        let directions = vec![first, first + draw.between(1.2, 1.9), first + PI];
        view.crossings.push(ViewCrossing {
            place: Vector2::new(
                draw.between(-half_ahead, half_ahead),
                draw.between(-half_across, half_across),
            ),
            directions,
        });
    }
    // In no order, as they are seen.
    let mut keys: Vec<(u64, usize)> = (0..view.crossings.len())
        .map(|i| (draw.0.random::<u64>(), i))
        .collect();
    keys.sort_unstable();
    view.crossings = keys
        .iter()
        .map(|(_, i)| view.crossings[*i].clone())
        .collect();
    view
}

/// Straight pieces that are no roads: drives, roofs, rows of trees.
fn add_false(view: &mut RoadView, errors: &SeeingErrors, draw: &mut Draw) {
    let wanted = view.points.len() as f64 * (1.0 / errors.precision - 1.0);
    let mut count = 0.0;
    while count < wanted {
        let length = draw.between(20.0, 80.0);
        let direction = if draw.chance(0.6) && !view.points.is_empty() {
            // Most run as the roads around do, or across.
            let like = draw.between(0.0, view.points.len() as f64) as usize;
            view.points[like].direction + if draw.chance(0.5) { 0.5 * PI } else { 0.0 }
        } else {
            draw.between(0.0, PI)
        };
        let along = Vector2::new(direction.cos(), direction.sin());
        let start = Vector2::new(
            draw.between(-0.5 * GROUND.0, 0.5 * GROUND.0),
            draw.between(-0.5 * GROUND.1, 0.5 * GROUND.1),
        );
        let mut at = 0.0;
        while at < length && count < wanted {
            let place = start + at * along;
            if place.x.abs() < 0.5 * GROUND.0 && place.y.abs() < 0.5 * GROUND.1 {
                view.points.push(ViewPoint {
                    place,
                    direction: direction.rem_euclid(PI),
                });
            }
            count += 1.0;
            at += 4.0;
        }
    }
}
