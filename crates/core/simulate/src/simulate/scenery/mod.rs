//! Generated scenery: a square of countryside with a village, seen from above.
//!
//! The picture is computed place by place on demand; only the plan (outlines, trees, shadows) is
//! kept. Everything follows from a seed and a [`Day`]: two days over the same seed share their
//! geometry and differ in light, season, crops and parked cars. The distinct places lie where the
//! built-in flight scenarios expect them, whatever the seed.

mod bend;
mod cast;
mod centre_lines;
mod coverings;
mod crowns;
mod day;
mod distinct;
mod face;
mod farm;
mod fields;
mod foliage;
mod grid;
mod house;
mod labels;
mod land;
mod light;
mod network;
pub(super) mod noise;
mod paint;
mod parcel_tree;
mod parcels;
mod plan;
mod render;
mod road_table;
mod roadway;
mod roofs;
mod scene_kind;
mod settlement;
mod shadows;
mod shape;
mod surfaces;
mod texture;
mod things;
mod turn;
mod vehicles;
mod water;
mod woods;
mod world;

#[cfg(test)]
mod tests;

use std::sync::Arc;

pub use day::{Day, Season};
pub use scene_kind::{DistinctFeature, SceneKind, SceneLabel};

use land::Land;
use pilotage_base::frames::GroundRect;
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::{Raster, Rgba};
use pilotage_roads::{RoadJoining, RoadLine, RoadMap};
use world::SceneryWorld;

/// The seed of the built-in demo.
pub const DEMO_SEED: u64 = 7;

/// Ground sample distance at which the scenery carries all its detail, metres per pixel.
pub const NATIVE_GSD: f64 = 0.15;

/// Rule by which roads of the scenery meet: they are drawn over each other, and end at the rim of a roundabout.
pub(super) const ROAD_JOINING: RoadJoining = RoadJoining {
    snap: 0.5,
    crossings: true,
    reach: 7.0,
};

/// A generated square of ground, 2,400 m on a side, centred on the world's origin.
///
/// The plan inside is drawn with its first leg towards the south-east; the world shows it turned by
/// 180°, so that the flights begin north-westward, into the wind of the wind scenario.
#[derive(Clone, Debug)]
pub struct Scenery {
    world: Arc<SceneryWorld>,
    day: Day,
}

impl Scenery {
    /// Lays out the scenery of `seed` under the light of `day` (a fraction of a second).
    pub fn new(seed: u64, day: Day) -> Self {
        Self::laid_out(seed, day, true)
    }

    /// The same square without village, roads and distinct places: fields, woods and water alone.
    pub fn open_country(seed: u64, day: Day) -> Self {
        Self::laid_out(seed, day, false)
    }

    fn laid_out(seed: u64, day: Day, settled: bool) -> Self {
        Self {
            world: Arc::new(SceneryWorld::new(Land::of(seed, settled), &in_plan(day))),
            day,
        }
    }

    /// The same ground on another day; everything but parcels, cars and shadows is shared.
    #[must_use]
    pub fn on_day(&self, day: Day) -> Self {
        Self {
            world: Arc::new(SceneryWorld::new(
                Arc::clone(&self.world.land),
                &in_plan(day),
            )),
            day,
        }
    }

    /// The seed it was made from.
    pub fn seed(&self) -> u64 {
        self.world.land.seed
    }

    /// The day it shows.
    pub fn day(&self) -> &Day {
        &self.day
    }

    /// The places made to serve as landmarks, in the order in which the flights meet them: the
    /// nine buildings under the first leg, the swimming pool, then others elsewhere.
    pub fn distinct_features(&self) -> Vec<DistinctFeature> {
        let in_plan = self.world.land.plan.features.iter();
        in_plan.map(turn::feature).collect()
    }

    /// Centre lines and widths of its roads and tracks, with the rule by which they meet.
    pub fn roads(&self) -> (Vec<RoadLine>, RoadJoining) {
        let roads = &self.world.land.plan.roads;
        (
            centre_lines::centre_lines(roads, &self.bounds()),
            ROAD_JOINING,
        )
    }

    /// Map of its roads and tracks.
    pub fn road_map(&self) -> RoadMap {
        let (lines, joining) = self.roads();
        RoadMap::new(lines, joining)
    }

    /// Outlines of everything labelled that touches `rect`.
    pub fn labels(&self, rect: &GroundRect) -> Vec<SceneLabel> {
        let in_plan = labels::labels(&self.world, &turn::rect(rect));
        in_plan.into_iter().map(turn::label).collect()
    }
}

/// The day as the plan sees it.
fn in_plan(day: Day) -> Day {
    Day {
        sun_azimuth: day.sun_azimuth + std::f64::consts::PI,
        ..day
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

    fn is_coarse_cheap(&self) -> bool {
        false
    }

    fn window(&self, window: &Window) -> Raster<Rgba> {
        let mut picture = render::window(&self.world, &turn::window(window));
        picture.pixels_mut().reverse();
        picture
    }
}
