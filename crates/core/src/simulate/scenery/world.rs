//! The plan made ready for painting: grids over everything and the shadows of the day.

use super::crowns::Foliage;
use super::day::Day;
use super::day::Season;
use super::grid::{Grid, REACH};
use super::light::Light;
use super::noise::{hash2, unit};
use super::parcels::Parcels;
use super::plan::{Plan, Segment, segment_grid};
use super::shadows::{CrownShadow, Shadow, prop_vertices};
use super::shape::{Outline, Slab, Spot, spot};
use super::texture::{Texture, Textures};
use super::things::Form;
use super::{distinct, network, settlement, water, woods};

/// The plan, its grids, and the light of the day.
#[derive(Clone, Debug)]
pub(super) struct World {
    pub(super) plan: Plan,
    pub(super) parcels: Parcels,
    pub(super) segments: Vec<Segment>,
    pub(super) segment_grid: Grid,
    pub(super) surface_grid: Grid,
    pub(super) solid_grid: Grid,
    pub(super) crown_grid: Grid,
    pub(super) prop_grid: Grid,
    pub(super) shadows: Vec<Shadow>,
    pub(super) shadow_grid: Grid,
    pub(super) crown_shadow_grid: Grid,
    pub(super) crown_shadows: Vec<CrownShadow>,
    pub(super) foliage: Foliage,
    pub(super) foliage_texture: Texture,
    pub(super) grain_texture: Texture,
    pub(super) land_texture: Texture,
    pub(super) growth: u32,
    pub(super) light: Light,
}

fn square(center: Spot, radius: f32) -> Vec<Spot> {
    vec![center + spot(radius, radius), center - spot(radius, radius)]
}

impl World {
    /// With the village and its roads, or open country without them.
    pub(super) fn new(seed: u64, day: &Day, settled: bool) -> Self {
        Self::with_textures(seed, day, settled, Textures::new(seed))
    }

    /// The same ground on another day: what takes long and does not change is shared.
    pub(super) fn on_day(&self, seed: u64, day: &Day, settled: bool) -> Self {
        let textures = Textures {
            foliage: self.foliage_texture.clone(),
            grain: self.grain_texture.clone(),
            land: self.land_texture.clone(),
        };
        Self::with_textures(seed, day, settled, textures)
    }

    fn with_textures(seed: u64, day: &Day, settled: bool, textures: Textures) -> Self {
        let light = Light::new(day);
        let mut plan = Plan::default();
        if settled {
            distinct::build(&mut plan);
            network::build(&mut plan);
        }
        water::build(&mut plan);
        if settled {
            settlement::build(&mut plan, seed);
        }
        let parcels = Parcels::new(seed, day);
        let segments = plan.segments();
        let segment_grid = segment_grid(&segments);
        let surface_grid = Grid::new(
            &plan.surfaces,
            2.0,
            |s| s.outline.corners(),
            |s, center, reach| s.outline.distance(center) < reach + 2.0 * s.ragged,
        );
        let solid_grid = Grid::new(
            &plan.solids,
            1.0,
            |s| s.outline().corners(),
            |s, center, reach| s.distance(center) < reach,
        );
        let ground = woods::Ground {
            land: &textures.land,
            segments: &segments,
            segment_grid: &segment_grid,
            surface_grid: &surface_grid,
            solid_grid: &solid_grid,
        };
        woods::plant(&mut plan, &parcels, &ground, seed);
        park(&mut plan, day);
        plan.crowns
            .retain(|c| c.center.n.abs() < REACH + 8.0 && c.center.e.abs() < REACH + 8.0);
        let crown_grid = Grid::new(
            &plan.crowns,
            1.0,
            |c| square(c.center, c.radius * 1.14),
            |c, center, reach| (c.center - center).length() < c.radius * 1.14 + reach,
        );
        let prop_grid = Grid::new(
            &plan.props,
            0.6,
            |p| p.slab.corners().to_vec(),
            |p, center, reach| p.slab.distance(center) < reach,
        );
        let mut shadows: Vec<Shadow> = plan
            .solids
            .iter()
            .enumerate()
            .map(|(i, solid)| Shadow::cast(&solid.vertices(), &light, i as u32))
            .collect();
        shadows.extend(
            plan.props
                .iter()
                .map(|p| Shadow::cast(&prop_vertices(p), &light, u32::MAX)),
        );
        let shadow_grid = Grid::new(
            &shadows,
            1.0,
            |s| s.corners.clone(),
            |s, center, reach| s.distance(center) < reach,
        );
        let bare = day.season == Season::LateWinter;
        let crown_shadows: Vec<CrownShadow> = plan
            .crowns
            .iter()
            .map(|c| CrownShadow::new(c, &light, bare))
            .collect();
        let crown_shadow_grid = Grid::new(
            &crown_shadows,
            0.5,
            |s| s.slab(&light).corners().to_vec(),
            |s, center, reach| s.slab(&light).distance(center) < reach,
        );
        Self {
            plan,
            parcels,
            segments,
            segment_grid,
            surface_grid,
            solid_grid,
            crown_grid,
            prop_grid,
            shadows,
            shadow_grid,
            crown_shadow_grid,
            crown_shadows,
            foliage: Foliage::new(day.season, day.growth_seed),
            foliage_texture: textures.foliage,
            land_texture: textures.land,
            grain_texture: textures.grain,
            growth: day.growth_seed as u32,
            light,
        }
    }
}

/// Parks the day's cars.
fn park(plan: &mut Plan, day: &Day) {
    const PAINTS: [[f32; 3]; 10] = [
        [0.62, 0.62, 0.61],
        [0.6, 0.6, 0.6],
        [0.34, 0.35, 0.36],
        [0.3, 0.3, 0.31],
        [0.03, 0.03, 0.034],
        [0.04, 0.042, 0.045],
        [0.1, 0.1, 0.105],
        [0.05, 0.09, 0.2],
        [0.26, 0.025, 0.025],
        [0.2, 0.18, 0.14],
    ];
    for (i, (stall, chance)) in plan.stalls.clone().into_iter().enumerate() {
        let h = hash2(i as i32, day.cars_seed as i32, 5);
        if unit(h) < chance {
            let paint = PAINTS[(h.rotate_left(7) % 10) as usize];
            let jitter = unit(h.rotate_left(13)) - 0.5;
            let turned = if h & 1 == 0 {
                stall.axis
            } else {
                stall.axis * -1.0
            };
            let angle = turned.e.atan2(turned.n) + 0.06 * jitter;
            let slab = Slab::new(
                stall.at(0.6 * jitter, 0.3 * (unit(h.rotate_left(19)) - 0.5)),
                angle,
                4.3 + 0.5 * unit(h.rotate_left(23)),
                1.76 + 0.14 * jitter,
            );
            plan.put(slab, 1.5, Form::Car, paint);
        }
    }
}

/// Corners of an outline in world metres.
pub(super) fn ground_polygon(outline: &Outline) -> Vec<crate::frames::GroundPoint> {
    outline.corners().into_iter().map(Spot::ground).collect()
}
