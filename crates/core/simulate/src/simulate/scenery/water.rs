//! The pond and the stream.

use super::plan::SceneryPlan;
use super::scene_kind::SceneKind;
use super::shape::{GroundOutline, Slab, Spot, polygon_distance, smooth_curve, spot};
use super::things::{Road, SceneryRoadClass, SurfaceMaterial};

/// Lays the pond and the stream that feeds and leaves it.
pub(super) fn build(plan: &mut SceneryPlan) {
    let s = spot;
    let course = [
        s(1250.0, 330.0),
        s(980.0, 420.0),
        s(760.0, 500.0),
        s(640.0, 560.0),
        s(520.0, 850.0),
        s(250.0, 760.0),
        s(170.0, 640.0),
        s(20.0, 700.0),
        s(-120.0, 640.0),
        s(-330.0, 660.0),
        s(-470.0, 560.0),
        s(-560.0, 380.0),
        s(-830.0, 330.0),
        s(-1250.0, 420.0),
    ];
    let curve = smooth_curve(&course, 7.0);
    let wander = |i: usize| 3.0 * (i as f32 * 0.9).sin() + 2.0 * (i as f32 * 0.37).cos();
    let points: Vec<Spot> = curve
        .iter()
        .enumerate()
        .map(|(i, &p)| p + spot(wander(i), wander(i + 40)))
        .collect();
    let pond = Slab::new(s(215.0, 690.0), 0.7, 92.0, 58.0);
    let shore: Vec<Spot> = (0..64)
        .map(|i| {
            let (sin, cos) = (i as f32 * std::f32::consts::TAU / 64.0).sin_cos();
            let wobble = 1.0
                + 0.12 * (i as f32 * 0.294).sin()
                + 0.08 * (i as f32 * 0.49 + 1.0).cos()
                + 0.03 * (i as f32 * 1.08).sin();
            pond.at(
                pond.half_along * cos * wobble,
                pond.half_across * sin * wobble,
            )
        })
        .collect();
    plan.reserved.push(pond.grown(10.0));
    let bank = shore
        .iter()
        .map(|&c| pond.center + (c - pond.center) * 1.12)
        .collect();
    plan.lay(
        GroundOutline::Polygon(bank),
        SurfaceMaterial::Grass,
        pond.axis,
        2.5,
        None,
    );
    plan.lay(
        GroundOutline::Polygon(shore.clone()),
        SurfaceMaterial::Pond,
        pond.axis,
        1.6,
        Some(SceneKind::Pond),
    );
    plan.announce("pond", SceneKind::Pond, shore.clone(), &pond.grown(12.0));
    // The stream runs into the pond on one side and out on the other.
    let wet = |p: Spot| polygon_distance(&shore, p) < 1.5;
    for reach in points.split(|&p| wet(p)) {
        if reach.len() > 1 {
            plan.roads.push(Road {
                class: SceneryRoadClass::Stream,
                curve: reach.to_vec(),
                half_width: 1.7,
                name: Some("stream"),
                village: false,
            });
        }
    }
}
