//! Poses moved to where the view fits best.

use nalgebra::{Matrix4, Vector2, Vector4};
use pilotage_base::frames::{GroundPoint, wrap_pi};

use super::field::bin;
use super::index::RoadIndex;
use super::prepared::PreparedView;
use super::view::{ViewPoint, ViewPose};
use crate::fix::{RoadFixSettings, RoadSighting, fix_on_roads};

/// Steps by the field of distances.
const STEPS: usize = 3;
/// Distance from which on a point pulls less, metres.
const BEND: f64 = 6.0;
/// Distance beyond which it does not pull, metres.
const PULL: f64 = 22.0;
/// Half the distance over which the slope of the field is taken, metres.
const SLOPE: f64 = 2.5;
/// Standard deviations of a hypothesis: place (m) and heading (rad).
const HYPOTHESIS: (f64, f64) = (15.0, 0.05);
/// Standard deviation of a point across its road, metres.
const POINT: f64 = 2.0;

/// Least share to which a scale is taken to be known: of one that is exact the weight would have no end.
const EXACT: f64 = 1e-6;

/// Moves `pose` by a few steps of Gauss-Newton on the field of distances; the scale is known to the share `scale`.
pub(super) fn settle(
    pose: ViewPose,
    points: &[ViewPoint],
    index: &RoadIndex,
    scale: f64,
) -> ViewPose {
    let start = pose;
    let mut pose = pose;
    for _ in 0..STEPS {
        let mut normal = Matrix4::from_diagonal(&Vector4::new(
            HYPOTHESIS.0.powi(-2),
            HYPOTHESIS.0.powi(-2),
            HYPOTHESIS.1.powi(-2),
            scale.max(EXACT).powi(-2),
        ));
        let moved = pose.place.to_vector() - start.place.to_vector();
        let off = Vector4::new(
            moved.x,
            moved.y,
            wrap_pi(pose.turn - start.turn),
            pose.scale - 1.0,
        );
        let mut gradient = -normal * off;
        for point in points {
            let at = pose.on_map(point.place);
            let bin = bin(point.direction + pose.turn);
            let distance = index.field.distance(at, bin);
            if distance > PULL {
                continue;
            }
            let beside = |north: f64, east: f64| {
                let place = GroundPoint::new(at.north + north, at.east + east);
                index.field.distance(place, bin).min(PULL + SLOPE)
            };
            let slope = Vector2::new(
                beside(SLOPE, 0.0) - beside(-SLOPE, 0.0),
                beside(0.0, SLOPE) - beside(0.0, -SLOPE),
            ) / (2.0 * SLOPE);
            // On a centre line the slope vanishes, and so does what there is to correct.
            if slope.norm_squared() < 0.1 {
                continue;
            }
            let away = slope.normalize();
            let q = at.to_vector() - pose.place.to_vector();
            let row = Vector4::new(
                away.x,
                away.y,
                away.dot(&Vector2::new(-q.y, q.x)),
                away.dot(&q) / pose.scale,
            );
            let weight = POINT.powi(-2) / (1.0 + (distance / BEND).powi(2));
            normal += weight * row * row.transpose();
            gradient -= weight * distance * row;
        }
        let Some(step) = normal.cholesky().map(|c| c.solve(&gradient)) else {
            break;
        };
        pose.place = GroundPoint::from(pose.place.to_vector() + step.xy());
        pose.turn = wrap_pi(pose.turn + step.z);
        pose.scale += step.w;
    }
    pose
}

/// Mean distance of the points of a view from roads that run alike, those far off as far as they pull, metres.
pub(super) fn misfit(pose: &ViewPose, points: &[ViewPoint], index: &RoadIndex) -> f64 {
    let distance = |point: &ViewPoint| {
        let at = pose.on_map(point.place);
        let bin = bin(point.direction + pose.turn);
        index.field.distance(at, bin).min(PULL)
    };
    points.iter().map(distance).sum::<f64>() / points.len().max(1) as f64
}

/// Moves `pose` by the distances from the centre lines themselves; as it was where they tell nothing.
pub(super) fn fix(pose: ViewPose, view: &PreparedView, index: &RoadIndex, scale: f64) -> ViewPose {
    let sightings: Vec<RoadSighting> = view
        .points
        .iter()
        .map(|point| RoadSighting {
            place: pose.on_map(point.place),
            direction: point.direction + pose.turn,
        })
        .collect();
    let settings = RoadFixSettings {
        reach: 15.0,
        turn: 0.3,
        point: POINT,
        shared: 1.0,
        scale,
        least_known: 20.0,
    };
    let Some(fix) = fix_on_roads(&index.map, &sightings, pose.place, &settings) else {
        return pose;
    };
    ViewPose {
        place: GroundPoint::from(pose.place.to_vector() + fix.correction.xy()),
        turn: wrap_pi(pose.turn + fix.correction.z),
        scale: pose.scale,
    }
}
