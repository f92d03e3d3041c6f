//! The plan on paper: lists of objects, filled by the builders in their order.

use super::grid::CellLists;
use super::noise::Dice;
use super::scene_kind::{DistinctFeature, SceneKind};
use super::shape::{GroundOutline, Slab, Spot, spot};
use super::things::{
    Crown, FlatSurface, Habit, Prop, PropForm, Road, Roof, RoofCover, SceneryRoadClass, Solid,
    SurfaceMaterial,
};
use pilotage_base::frames::GroundRect;

/// Everything that stands or lies on the ground.
#[derive(Clone, Debug, Default)]
pub(super) struct SceneryPlan {
    pub(super) surfaces: Vec<FlatSurface>,
    pub(super) solids: Vec<Solid>,
    pub(super) crowns: Vec<Crown>,
    pub(super) props: Vec<Prop>,
    pub(super) roads: Vec<Road>,
    pub(super) features: Vec<DistinctFeature>,
    /// Places where houses may not be put.
    pub(super) reserved: Vec<Slab>,
    /// Places where cars may stand, with the chance that one does.
    pub(super) stalls: Vec<(Slab, f32)>,
}

impl SceneryPlan {
    /// Lays a surface.
    pub(super) fn lay(
        &mut self,
        outline: GroundOutline,
        ground: SurfaceMaterial,
        axis: Spot,
        ragged: f32,
        label: Option<SceneKind>,
    ) {
        let variant = (self.surfaces.len() as u32).wrapping_mul(0x9e37_79b9);
        self.surfaces.push(FlatSurface {
            outline,
            ground,
            axis,
            ragged,
            variant,
            label,
        });
    }

    /// Lays a rectangular surface with its stripes along the long side.
    pub(super) fn lay_slab(&mut self, slab: Slab, ground: SurfaceMaterial, ragged: f32) {
        self.lay(GroundOutline::Slab(slab), ground, slab.axis, ragged, None);
    }

    /// Puts up a volume.
    #[expect(
        clippy::too_many_arguments,
        reason = "a volume has that many independent traits"
    )]
    pub(super) fn raise(
        &mut self,
        slab: Slab,
        roof: Roof,
        cover: RoofCover,
        color: [f32; 3],
        eaves: f32,
        rise: f32,
        label: SceneKind,
    ) {
        let variant = (self.solids.len() as u32).wrapping_mul(0x85eb_ca77);
        self.solids.push(Solid {
            slab,
            roof,
            cover,
            color,
            eaves,
            rise,
            variant,
            label,
        });
    }

    /// Plants a tree.
    pub(super) fn plant(&mut self, center: Spot, radius: f32, habit: Habit, dice: &mut Dice) {
        let height = match habit {
            Habit::Broadleaf => radius * dice.range(1.9, 2.6) + 2.0,
            Habit::Conifer => radius * dice.range(3.6, 5.0) + 2.0,
            Habit::Shrub => radius * dice.range(0.9, 1.5),
            Habit::Dead => radius * 3.0 + 2.0,
        };
        self.crowns.push(Crown {
            center,
            radius,
            height,
            habit,
            variant: dice.bits() as u32,
        });
    }

    /// Puts down a small thing.
    pub(super) fn put(&mut self, slab: Slab, height: f32, form: PropForm, color: [f32; 3]) {
        self.props.push(Prop {
            slab,
            height,
            form,
            color,
        });
    }

    /// Announces a distinct feature around the solids and surfaces added since the given counts.
    pub(super) fn announce(
        &mut self,
        name: &str,
        kind: SceneKind,
        outline: Vec<Spot>,
        landmark: &Slab,
    ) {
        let corners = landmark.corners().map(Spot::ground);
        if let Some(landmark_box) = GroundRect::around(corners) {
            self.features.push(DistinctFeature {
                name: name.to_owned(),
                kind,
                outline: outline.into_iter().map(Spot::ground).collect(),
                landmark_box,
            });
        }
    }

    /// Whether a rectangle is free of solids and reserved places.
    pub(super) fn is_free(&self, slab: &Slab) -> bool {
        !self.reserved.iter().any(|r| r.overlaps(slab))
            && !self.solids.iter().any(|s| s.slab.overlaps(slab))
    }

    /// Whether a rectangle touches no solid.
    pub(super) fn is_clear_of_solids(&self, slab: &Slab) -> bool {
        !self.solids.iter().any(|s| s.slab.overlaps(slab))
    }

    /// Whether a place lies more than `margin` metres beside every road's edge.
    pub(super) fn is_clear_of_roads(&self, p: Spot, margin: f32) -> bool {
        // No piece of a curve is longer than 60 m.
        let far = |a: Spot| (a.n - p.n).abs() > 70.0 || (a.e - p.e).abs() > 70.0;
        !self.roads.iter().any(|road| {
            road.curve.windows(2).any(|w| {
                !far(w[0])
                    && super::shape::segment_distance(p, w[0], w[1]).0 < road.half_width + margin
            })
        })
    }

    /// A road's straight pieces with their road's number, for the grid.
    pub(super) fn segments(&self) -> Vec<RoadPiece> {
        let mut order: Vec<usize> = (0..self.roads.len()).collect();
        order.sort_by_key(|&i| self.roads[i].class);
        let mut segments = Vec::new();
        for i in order {
            let road = &self.roads[i];
            let mut along = 0.0;
            for w in road.curve.windows(2) {
                let length = (w[1] - w[0]).length();
                segments.push(RoadPiece {
                    road: i as u32,
                    class: road.class,
                    half_width: road.half_width,
                    start: w[0],
                    axis: (w[1] - w[0]).unit(),
                    length,
                    along,
                });
                along += length;
            }
        }
        segments
    }
}

/// A straight piece of a road.
#[derive(Clone, Copy, Debug)]
pub(super) struct RoadPiece {
    pub(super) road: u32,
    pub(super) class: SceneryRoadClass,
    pub(super) half_width: f32,
    pub(super) start: Spot,
    pub(super) axis: Spot,
    pub(super) length: f32,
    /// Distance from the road's start to the segment's, metres.
    pub(super) along: f32,
}

impl RoadPiece {
    /// (distance, signed offset to the right, distance along the road).
    #[inline]
    pub(super) fn measure(&self, p: Spot) -> (f32, f32, f32) {
        let d = p - self.start;
        let (u, v) = (d.dot(self.axis), self.axis.cross(d));
        let beyond = (u - u.clamp(0.0, self.length)).abs();
        let distance = if beyond > 0.0 {
            (beyond * beyond + v * v).sqrt()
        } else {
            v.abs()
        };
        (distance, v, self.along + u.clamp(0.0, self.length))
    }
    pub(super) fn end(&self) -> Spot {
        self.start + self.axis * self.length
    }
}

/// The grid over road segments.
pub(super) fn segment_grid(segments: &[RoadPiece]) -> CellLists {
    CellLists::new(
        segments,
        9.5,
        |s| vec![s.start, s.end()],
        |s, center, reach| s.measure(center).0 < reach,
    )
}

/// World place on the first leg: `along` metres from its start, `right` metres to the right.
pub(super) const fn leg_one(along: f32, right: f32) -> Spot {
    const K: f32 = std::f32::consts::FRAC_1_SQRT_2;
    spot(400.0 - K * (along + right), -420.0 + K * (along - right))
}

/// Heading of the first leg, radians.
pub(super) const LEG_ONE_HEADING: f32 = 0.75 * std::f32::consts::PI;
