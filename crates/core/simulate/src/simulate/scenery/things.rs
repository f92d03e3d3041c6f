//! The objects that the scenery is made of.

use super::scene_kind::SceneKind;
use super::shape::{GroundOutline, Slab, Spot};

/// Material of a flat surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SurfaceMaterial {
    /// Mown grass; stripes along the surface's axis.
    Lawn,
    /// Rough grass.
    Grass,
    Asphalt,
    Concrete,
    Gravel,
    /// Trodden earth of yards.
    Dirt,
    /// Parking: asphalt with stalls across the axis.
    Stalls,
    /// Paving slabs.
    Paving,
    /// Pool water.
    Pool,
    /// Pond water.
    Pond,
    /// White paint.
    Paint,
    /// Pedestrian crossing: white bars along the axis.
    Zebra,
    /// Red running track.
    Tartan,
    /// Striped sports turf.
    Turf,
    /// Bare quarry rock.
    Rock,
    /// Vegetable beds.
    Beds,
    /// Graves in rows.
    Graves,
}

/// A flat surface painted over the ground.
#[derive(Clone, Debug)]
pub(super) struct FlatSurface {
    pub(super) outline: GroundOutline,
    pub(super) ground: SurfaceMaterial,
    /// Direction of stripes, stalls and slabs.
    pub(super) axis: Spot,
    /// Amplitude of the ragged edge, metres.
    pub(super) ragged: f32,
    /// Individual variation.
    pub(super) variant: u32,
    /// Kind under which it is labelled, if it is.
    pub(super) label: Option<SceneKind>,
}

/// The form of a roof over a [`Slab`]; ridges run along the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Roof {
    /// Flat with a parapet.
    Flat,
    /// Two planes that meet at a ridge.
    Gable,
    /// Four planes.
    Hip,
    /// A barrel along the axis.
    Vault,
    /// Teeth that repeat along the axis.
    Sawtooth(f32),
    /// A disc with a shallow cone.
    Cone,
    /// A disc with a dome.
    Dome,
}

/// Covering of a roof.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RoofCover {
    /// Tiles or shingles in courses.
    Tiles,
    /// Standing seam or corrugated metal.
    Metal,
    /// Felt or membrane with patches and puddles.
    Felt,
    /// Gravel ballast.
    Ballast,
    /// Glass in a metal frame.
    Glass,
    /// Plain painted steel or concrete.
    Plain,
}

/// Simple building volume.
#[derive(Clone, Debug)]
pub(super) struct Solid {
    pub(super) slab: Slab,
    pub(super) roof: Roof,
    pub(super) cover: RoofCover,
    /// Linear reflectance of the roof.
    pub(super) color: [f32; 3],
    /// Height of the eaves, metres.
    pub(super) eaves: f32,
    /// Height of the ridge above the eaves, metres.
    pub(super) rise: f32,
    /// Individual variation.
    pub(super) variant: u32,
    /// The kind that its label has.
    pub(super) label: SceneKind,
}

impl Solid {
    /// Whether the plan is a disc.
    pub(super) fn is_round(&self) -> bool {
        matches!(self.roof, Roof::Cone | Roof::Dome)
    }
    /// Its outline on the ground.
    pub(super) fn outline(&self) -> GroundOutline {
        if self.is_round() {
            GroundOutline::Disc(self.slab.center, self.slab.half_along)
        } else {
            GroundOutline::Slab(self.slab)
        }
    }
    /// Signed distance to the plan, metres, negative inside.
    #[inline]
    pub(super) fn distance(&self, p: Spot) -> f32 {
        if self.is_round() {
            (p - self.slab.center).length() - self.slab.half_along
        } else {
            self.slab.distance(p)
        }
    }
    /// Points (place, height) whose convex hull is the volume.
    pub(super) fn vertices(&self) -> Vec<(Spot, f32)> {
        let (a, b) = (self.slab.half_along, self.slab.half_across);
        let top = self.eaves + self.rise;
        let mut points: Vec<(Spot, f32)> = Vec::new();
        let plan = self.outline().corners();
        points.extend(plan.iter().map(|&c| (c, 0.0)));
        points.extend(plan.iter().map(|&c| (c, self.eaves)));
        match self.roof {
            Roof::Flat => {}
            Roof::Gable => points.extend([-a, a].map(|u| (self.slab.at(u, 0.0), top))),
            Roof::Hip => {
                let r = (a - b).max(0.0);
                points.extend([-r, r].map(|u| (self.slab.at(u, 0.0), top)));
            }
            Roof::Vault => {
                for i in 1..8 {
                    let (sin, cos) = (i as f32 * std::f32::consts::PI / 8.0).sin_cos();
                    points.extend(
                        [-a, a].map(|u| (self.slab.at(u, b * cos), self.eaves + self.rise * sin)),
                    );
                }
            }
            Roof::Sawtooth(_) => {
                points.extend(self.slab.corners().map(|c| (c, top)));
            }
            Roof::Cone => points.push((self.slab.center, top)),
            Roof::Dome => {
                for &c in &plan {
                    let mid = self.slab.center + (c - self.slab.center) * 0.7;
                    points.push((mid, self.eaves + 0.7 * self.rise));
                }
                points.push((self.slab.center, top));
            }
        }
        points
    }
}

/// The habit of a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Habit {
    Broadleaf,
    Conifer,
    Shrub,
    Dead,
}

/// Tree or shrub.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crown {
    pub(super) center: Spot,
    /// Crown radius, metres.
    pub(super) radius: f32,
    /// Height of the top, metres.
    pub(super) height: f32,
    pub(super) habit: Habit,
    /// Individual variation.
    pub(super) variant: u32,
}

/// A small movable or low thing drawn as a box with its own picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Prop {
    pub(super) slab: Slab,
    pub(super) height: f32,
    pub(super) form: PropForm,
    /// Linear reflectance.
    pub(super) color: [f32; 3],
}

/// Kind of a [`Prop`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PropForm {
    Car,
    Truck,
    Bale,
    Crate,
}

/// The class of a road.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum SceneryRoadClass {
    Stream,
    Track,
    Street,
    Main,
}

/// A road along a curve.
#[derive(Clone, Debug)]
pub(super) struct Road {
    pub(super) class: SceneryRoadClass,
    pub(super) curve: Vec<Spot>,
    pub(super) half_width: f32,
    pub(super) name: Option<&'static str>,
    /// Whether it has pavements on both sides.
    pub(super) village: bool,
}
