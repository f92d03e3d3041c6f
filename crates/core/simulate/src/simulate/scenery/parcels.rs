//! The mosaic of fields and woods: the land cut again and again by slightly slanted lines.

use std::sync::Arc;

use super::day::{Day, Season};
use super::noise::{Dice, hash2, unit};
use super::parcel_tree::{Located, ParcelNode, ParcelTree};
use super::shape::{Spot, spot};

/// Use of a parcel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Use {
    Cereal,
    RowCrop,
    Grassland,
    Hay,
    Fallow,
    Orchard,
    Wood,
    ConiferWood,
}

/// Look of a field on the day.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FieldCover {
    Green,
    Ripe,
    Stubble,
    Plough,
    Sprouting,
    Pasture,
    Mown,
    Floor,
}

/// Parcel of land.
#[derive(Clone, Debug)]
pub(super) struct Parcel {
    pub(super) use_: Use,
    pub(super) cover: FieldCover,
    /// Direction of the rows.
    pub(super) axis: Spot,
    pub(super) variant: u32,
    pub(super) corners: Vec<Spot>,
    /// Whether its edges carry hedges.
    pub(super) hedged: bool,
}

/// All parcels with the tree that finds them.
#[derive(Clone, Debug)]
pub(super) struct Parcels {
    tree: Arc<ParcelTree>,
    pub(super) parcels: Vec<Parcel>,
}

impl Parcels {
    pub(super) fn new(seed: u64) -> Self {
        let mut dice = Dice::new(seed, 11);
        let mut cutting = Cutting::default();
        let r = 1320.0;
        let square = vec![spot(-r, -r), spot(r, -r), spot(r, r), spot(-r, r)];
        cutting.cut(square, 0, &mut dice);
        let mut parcels = Self {
            tree: Arc::new(ParcelTree::new(cutting.nodes)),
            parcels: cutting.parcels,
        };
        parcels.assign(seed);
        parcels
    }

    /// The same parcels with what they bear on `day`.
    pub(super) fn on_day(&self, seed: u64, day: &Day) -> Self {
        let mut there = self.clone();
        for (i, parcel) in there.parcels.iter_mut().enumerate() {
            let roll = unit(hash2(i as i32, day.growth_seed as i32, seed as u32));
            parcel.cover = cover(parcel.use_, day.season, roll);
        }
        there
    }

    fn assign(&mut self, seed: u64) {
        for (i, parcel) in self.parcels.iter_mut().enumerate() {
            let mut dice = Dice::new(seed, 1000 + i as u64);
            let center = center_of(&parcel.corners);
            parcel.use_ = if dice.chance(0.20) || is_always_wood(center) {
                if dice.chance(0.3) {
                    Use::ConiferWood
                } else {
                    Use::Wood
                }
            } else {
                dice.pick(&[
                    Use::Cereal,
                    Use::Cereal,
                    Use::RowCrop,
                    Use::Grassland,
                    Use::Grassland,
                    Use::Hay,
                    Use::Fallow,
                    Use::Cereal,
                    Use::RowCrop,
                    Use::Orchard,
                ])
            };
            if is_village(center) && parcel.use_ != Use::Wood {
                parcel.use_ = Use::Grassland;
            }
        }
    }

    /// The parcel at a place.
    #[inline]
    pub(super) fn locate(&self, p: Spot) -> Located {
        self.tree.locate(p)
    }
}

/// Nodes and parcels while the land is being cut.
#[derive(Default)]
struct Cutting {
    nodes: Vec<ParcelNode>,
    parcels: Vec<Parcel>,
}

impl Cutting {
    fn cut(&mut self, corners: Vec<Spot>, depth: u32, dice: &mut Dice) -> u32 {
        let area = area_of(&corners);
        let target = dice.range(9_000.0, 42_000.0);
        let number = self.nodes.len() as u32;
        if area < target || depth > 12 {
            self.nodes.push(ParcelNode::Leaf(self.parcels.len() as u32));
            self.parcels.push(Parcel {
                use_: Use::Cereal,
                cover: FieldCover::Green,
                axis: longest_side(&corners),
                variant: dice.bits() as u32,
                corners,
                hedged: dice.chance(0.55),
            });
            return number;
        }
        let axis = longest_side(&corners);
        let slant = dice.range(-0.16, 0.16) + if depth == 0 { 0.3 } else { 0.0 };
        let (sin, cos) = slant.sin_cos();
        let normal = axis * cos + axis.right() * sin;
        let reach = |f: fn(f32, f32) -> f32| {
            corners
                .iter()
                .map(|c| c.dot(normal))
                .reduce(f)
                .unwrap_or(0.0)
        };
        let (low, high) = (reach(f32::min), reach(f32::max));
        let offset = low + (high - low) * dice.range(0.36, 0.64);
        let (first, second) = split(&corners, normal, offset);
        self.nodes.push(ParcelNode::Leaf(0));
        let track = (2..6).contains(&depth) && dice.chance(0.3);
        let a = self.cut(first, depth + 1, dice);
        let b = self.cut(second, depth + 1, dice);
        self.nodes[number as usize] = ParcelNode::Cut {
            normal,
            offset,
            children: [a, b],
            track,
        };
        number
    }
}

/// The built-up strip around the first leg.
fn is_village(c: Spot) -> bool {
    let d = c - spot(400.0, -420.0);
    let (along, right) = ((d.e - d.n) * 0.707, -(d.n + d.e) * 0.707);
    (160.0..760.0).contains(&along) && right.abs() < 175.0
}

fn is_always_wood(c: Spot) -> bool {
    // Woods beside the second leg, so that it passes through some.
    [
        spot(-350.0, 20.0),
        spot(-440.0, -60.0),
        spot(-300.0, -160.0),
    ]
    .into_iter()
    .any(|w| (c - w).length() < 70.0)
}

fn cover(use_: Use, season: Season, roll: f32) -> FieldCover {
    use FieldCover::{Floor, Green, Mown, Pasture, Plough, Ripe, Sprouting, Stubble};
    match (use_, season) {
        (Use::Wood | Use::ConiferWood, _) => Floor,
        (Use::Orchard | Use::Grassland, _) => Pasture,
        (Use::Hay, _) => {
            if roll < 0.5 {
                Mown
            } else {
                Pasture
            }
        }
        (Use::Fallow, _) => {
            if roll < 0.45 {
                Plough
            } else {
                Pasture
            }
        }
        (Use::Cereal, Season::Summer) => {
            if roll < 0.55 {
                Ripe
            } else if roll < 0.8 {
                Green
            } else {
                Stubble
            }
        }
        (Use::Cereal, Season::Autumn) => {
            if roll < 0.4 {
                Stubble
            } else if roll < 0.75 {
                Plough
            } else {
                Sprouting
            }
        }
        (Use::Cereal, _) => {
            if roll < 0.7 {
                Green
            } else {
                Sprouting
            }
        }
        (Use::RowCrop, Season::Summer) => {
            if roll < 0.8 {
                Green
            } else {
                Sprouting
            }
        }
        (Use::RowCrop, Season::Autumn) => {
            if roll < 0.5 {
                Ripe
            } else {
                Plough
            }
        }
        (Use::RowCrop, Season::Spring) => Sprouting,
        (Use::RowCrop, Season::LateWinter) => Plough,
    }
}

fn area_of(corners: &[Spot]) -> f32 {
    let mut sum = 0.0;
    for i in 0..corners.len() {
        sum += corners[i].cross(corners[(i + 1) % corners.len()]);
    }
    0.5 * sum.abs()
}

/// Mean of the corners.
pub(super) fn center_of(corners: &[Spot]) -> Spot {
    corners.iter().fold(spot(0.0, 0.0), |sum, &c| sum + c) * (1.0 / corners.len() as f32)
}

fn longest_side(corners: &[Spot]) -> Spot {
    let mut best = spot(0.0, 0.0);
    for i in 0..corners.len() {
        let side = corners[(i + 1) % corners.len()] - corners[i];
        if side.length() > best.length() {
            best = side;
        }
    }
    best.unit()
}

fn split(corners: &[Spot], normal: Spot, offset: f32) -> (Vec<Spot>, Vec<Spot>) {
    let (mut below, mut above) = (Vec::new(), Vec::new());
    for i in 0..corners.len() {
        let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
        let (da, db) = (a.dot(normal) - offset, b.dot(normal) - offset);
        if da < 0.0 {
            below.push(a);
        } else {
            above.push(a);
        }
        if (da < 0.0) != (db < 0.0) {
            let cut = a + (b - a) * (da / (da - db));
            below.push(cut);
            above.push(cut);
        }
    }
    (below, above)
}
