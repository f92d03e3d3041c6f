//! Parts of the countryside that are the same on every day, with the grids that find them.

use std::sync::{Arc, Mutex, PoisonError};

use super::grid::{CellLists, REACH};
use super::parcels::Parcels;
use super::plan::{RoadPiece, SceneryPlan, segment_grid};
use super::shape::{Spot, spot};
use super::texture::PeriodicTextures;
use super::{distinct, network, settlement, water, woods};

/// The plan without the cars of a day, its grids, and the textures of the ground.
#[derive(Clone, Debug)]
pub(super) struct Land {
    pub(super) seed: u64,
    pub(super) plan: SceneryPlan,
    /// The parcels and their use; what they bear on a day is not settled yet.
    pub(super) parcels: Parcels,
    pub(super) segments: Vec<RoadPiece>,
    pub(super) segment_grid: CellLists,
    pub(super) surface_grid: CellLists,
    pub(super) solid_grid: CellLists,
    pub(super) crown_grid: CellLists,
    pub(super) textures: PeriodicTextures,
}

/// Land that was laid out last: its seed, whether it is settled, and itself. It takes as long to lay out as
/// a picture to draw, and most programs know a single seed.
type LastLand = Mutex<Option<(u64, bool, Arc<Land>)>>;

impl Land {
    /// The land of a seed, which is kept until that of another is asked for.
    pub(super) fn of(seed: u64, settled: bool) -> Arc<Self> {
        static LAST: LastLand = Mutex::new(None);
        let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((of, is_settled, land)) = &*last
            && (*of, *is_settled) == (seed, settled)
        {
            return Arc::clone(land);
        }
        let land = Arc::new(Self::new(seed, settled));
        *last = Some((seed, settled, Arc::clone(&land)));
        land
    }

    /// With the village and its roads, or open country without them.
    fn new(seed: u64, settled: bool) -> Self {
        let textures = PeriodicTextures::new(seed);
        let mut plan = SceneryPlan::default();
        if settled {
            distinct::build(&mut plan);
            network::build(&mut plan);
        }
        water::build(&mut plan);
        if settled {
            settlement::build(&mut plan, seed);
        }
        let parcels = Parcels::new(seed);
        let segments = plan.segments();
        let segment_grid = segment_grid(&segments);
        let surface_grid = CellLists::new(
            &plan.surfaces,
            2.0,
            |s| s.outline.corners(),
            |s, center, reach| s.outline.distance(center) < reach + 2.0 * s.ragged,
        );
        let solid_grid = CellLists::new(
            &plan.solids,
            1.0,
            |s| s.outline().corners(),
            |s, center, reach| s.distance(center) < reach,
        );
        let ground = woods::TreeObstacles {
            land: &textures.land,
            segments: &segments,
            segment_grid: &segment_grid,
            surface_grid: &surface_grid,
            solid_grid: &solid_grid,
        };
        woods::plant(&mut plan, &parcels, &ground, seed);
        plan.crowns
            .retain(|c| c.center.n.abs() < REACH + 8.0 && c.center.e.abs() < REACH + 8.0);
        let crown_grid = CellLists::new(
            &plan.crowns,
            1.0,
            |c| square(c.center, c.radius * 1.14),
            |c, center, reach| (c.center - center).length() < c.radius * 1.14 + reach,
        );
        Self {
            seed,
            plan,
            parcels,
            segments,
            segment_grid,
            surface_grid,
            solid_grid,
            crown_grid,
            textures,
        }
    }
}

/// Corners of a square around a place.
fn square(center: Spot, radius: f32) -> Vec<Spot> {
    vec![center + spot(radius, radius), center - spot(radius, radius)]
}
