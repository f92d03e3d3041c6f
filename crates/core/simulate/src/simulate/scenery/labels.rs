//! Labels by which the scenery tells what is in it.

use super::bend::bent;
use super::parcels::FieldCover;
use super::scene_kind::{SceneKind, SceneLabel};
use super::shape::{GroundOutline, Spot};
use super::things::{Habit, PropForm, SceneryRoadClass, SurfaceMaterial};
use super::world::SceneryWorld;
use pilotage_base::frames::{GroundPoint, GroundRect};

/// A parcel's outline as it lies on the ground, with corners every 20 m or so.
fn bent_outline(world: &SceneryWorld, corners: &[Spot]) -> Vec<GroundPoint> {
    let mut polygon = Vec::new();
    for i in 0..corners.len() {
        let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
        let steps = ((b - a).length() / 20.0).ceil().max(1.0);
        for k in 0..steps as usize {
            let planned = a + (b - a) * (k as f32 / steps);
            polygon.push(bent(&world.land.textures.land, planned).ground());
        }
    }
    polygon
}

/// All labels whose outline's bounding box touches `rect`.
pub(super) fn labels(world: &SceneryWorld, rect: &GroundRect) -> Vec<SceneLabel> {
    let mut labels = Vec::new();
    let mut add = |kind, name: Option<&str>, polygon: Vec<GroundPoint>| {
        if GroundRect::around(polygon.iter().copied()).is_some_and(|b| b.overlaps(rect)) {
            labels.push(SceneLabel {
                kind,
                name: name.map(ToOwned::to_owned),
                polygon,
            });
        }
    };
    for feature in &world.land.plan.features {
        add(feature.kind, Some(&feature.name), feature.outline.clone());
    }
    for parcel in &world.parcels.parcels {
        let kind = if parcel.cover == FieldCover::Floor {
            SceneKind::Wood
        } else {
            SceneKind::Field
        };
        add(kind, None, bent_outline(world, &parcel.corners));
    }
    for surface in &world.land.plan.surfaces {
        let kind = match (surface.label, surface.ground) {
            (Some(kind), _) => kind,
            (None, SurfaceMaterial::Stalls) => SceneKind::CarPark,
            (None, SurfaceMaterial::Zebra) => SceneKind::Crossing,
            _ => continue,
        };
        add(kind, None, ground_polygon(&surface.outline));
    }
    for segment in &world.land.segments {
        let kind = match segment.class {
            SceneryRoadClass::Stream => SceneKind::Stream,
            SceneryRoadClass::Track => SceneKind::Track,
            _ => SceneKind::Road,
        };
        let side = segment.axis.right() * segment.half_width;
        let (a, b) = (segment.start, segment.end());
        let polygon = [a - side, b - side, b + side, a + side];
        let name = world.land.plan.roads[segment.road as usize].name;
        add(kind, name, polygon.map(Spot::ground).to_vec());
    }
    for solid in &world.land.plan.solids {
        add(solid.label, None, ground_polygon(&solid.outline()));
    }
    for prop in world.props.iter().filter(|p| p.form == PropForm::Car) {
        add(
            SceneKind::Car,
            None,
            ground_polygon(&GroundOutline::Slab(prop.slab)),
        );
    }
    for crown in &world.land.plan.crowns {
        if crown.habit != Habit::Shrub {
            add(
                SceneKind::Tree,
                None,
                ground_polygon(&GroundOutline::Disc(crown.center, crown.radius)),
            );
        }
    }
    labels
}

/// Corners of an outline in world metres.
fn ground_polygon(outline: &GroundOutline) -> Vec<GroundPoint> {
    outline.corners().into_iter().map(Spot::ground).collect()
}
