//! Generated scenery: a square of countryside with a village, seen from above.
//!
//! The picture is computed place by place on demand; only the plan (outlines, trees, shadows) is
//! kept. Everything follows from a seed and a [`Day`]: two days over the same seed share their
//! geometry and differ in light, season, crops and parked cars. The distinct places lie where the
//! built-in flight scenarios expect them, whatever the seed.

mod crowns;
mod day;
mod distinct;
mod fields;
mod grid;
mod labels;
mod light;
mod network;
mod noise;
mod paint;
mod parcels;
mod plan;
mod render;
mod roadway;
mod roofs;
mod settlement;
mod shadows;
mod shape;
mod surfaces;
mod texture;
mod things;
mod vehicles;
mod water;
mod woods;
mod world;

#[cfg(test)]
mod tests;

use std::sync::Arc;

pub use day::{Day, Season};
pub use labels::{DistinctFeature, SceneKind, SceneLabel};

use crate::frames::GroundRect;
use crate::imagery::{Imagery, Window};
use crate::raster::{Raster, Rgba};
use world::World;

/// The seed of the built-in demo.
pub const DEMO_SEED: u64 = 7;

/// Ground sample distance at which the scenery carries all its detail, metres per pixel.
pub const NATIVE_GSD: f64 = 0.15;

/// A generated square of ground, 2,400 m on a side, centred on the world's origin.
#[derive(Clone, Debug)]
pub struct Scenery {
    world: Arc<World>,
    seed: u64,
    day: Day,
}

impl Scenery {
    /// Lays out the scenery of `seed` under the light of `day` (a fraction of a second).
    pub fn new(seed: u64, day: Day) -> Self {
        Self {
            world: Arc::new(World::new(seed, &day)),
            seed,
            day,
        }
    }

    /// The seed it was made from.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// The day it shows.
    pub fn day(&self) -> &Day {
        &self.day
    }

    /// The places made to serve as landmarks, in the order in which the flights meet them: the
    /// nine buildings under the first leg, the swimming pool, then others elsewhere.
    pub fn distinct_features(&self) -> Vec<DistinctFeature> {
        self.world.plan.features.clone()
    }

    /// Outlines of everything labelled that touches `rect`.
    pub fn labels(&self, rect: &GroundRect) -> Vec<SceneLabel> {
        labels::labels(&self.world, rect)
    }
}

impl Imagery for Scenery {
    fn name(&self) -> &'static str {
        "generated scenery"
    }

    fn bounds(&self) -> GroundRect {
        let reach = f64::from(grid::REACH);
        GroundRect {
            south: -reach,
            north: reach,
            west: -reach,
            east: reach,
        }
    }

    fn native_gsd(&self) -> f64 {
        NATIVE_GSD
    }

    fn window(&self, window: &Window) -> Raster<Rgba> {
        render::window(&self.world, window)
    }
}
