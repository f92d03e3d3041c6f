//! The look of one place: from the ground up, then the light.

use super::grid::cell_of;
use super::labels::SceneKind;
use super::light::{Color, mix, scale};
use super::noise::{fractal, smooth_step};
use super::parcels::Cover;
use super::plan::Segment;
use super::shape::{Spot, spot};
use super::things::{Ground, Roof, Solid};
use super::world::{World, crown_shadow};

/// Share of a pixel of that size covered at a signed distance from an edge.
#[inline]
pub(super) fn cover_share(distance: f32, gsd: f32) -> f32 {
    (0.5 - distance / gsd).clamp(0.0, 1.0)
}

impl World {
    /// Light that leaves a place upwards, averaged over about `gsd` metres; `None` outside.
    pub(super) fn light_at(&self, p: Spot, gsd: f32) -> Option<Color> {
        let cell = cell_of(p)?;
        let soft = gsd.clamp(0.12, 0.8);
        let mut albedo = self.ground(p, gsd);
        for &i in self.surface_grid.cell(cell) {
            let surface = &self.plan.surfaces[i as usize];
            let mut d = surface.outline.distance(p);
            if surface.ragged > 0.0 && d.abs() < 2.0 * surface.ragged {
                d += surface.ragged * fractal(p.n, p.e, 5.0, 4, gsd, 40);
            }
            let share = cover_share(d, soft);
            if share > 0.0 {
                albedo = mix(albedo, self.surface(surface.ground, p, gsd), share);
            }
        }
        let segments = self.segment_grid.cell(cell);
        if !segments.is_empty() {
            albedo = self.roads(albedo, segments, p, soft);
        }
        let sunlit = self.sun_reaching(p, 0.0, u32::MAX, soft);
        let mut light = self.light.reflect(
            albedo,
            sunlit * self.light.sin_elevation,
            0.75 + 0.25 * sunlit,
        );
        for &i in self.prop_grid.cell(cell) {
            let prop = &self.plan.props[i as usize];
            let share = cover_share(prop.slab.distance(p), soft);
            if share > 0.0 {
                let own = self
                    .light
                    .reflect(prop.color, self.light.sin_elevation, 1.0);
                light = mix(light, own, share);
            }
        }
        for &i in self.solid_grid.cell(cell) {
            let solid = &self.plan.solids[i as usize];
            let share = cover_share(solid.distance(p), soft);
            if share > 0.0 {
                light = mix(light, self.roof(solid, i, p, soft), share);
            }
        }
        for &i in self.crown_grid.cell(cell) {
            let c = &self.plan.crowns[i as usize];
            let d = p - c.center;
            let share = cover_share(d.length() - c.radius, soft);
            if share > 0.0 {
                let slope = d * (-0.9 / c.radius);
                let own = self
                    .light
                    .reflect([0.045, 0.065, 0.025], self.light.cosine(slope), 0.8);
                light = mix(light, own, share);
            }
        }
        Some(light)
    }

    fn ground(&self, p: Spot, gsd: f32) -> Color {
        let located = self.parcels.locate(p);
        let base = match self.parcels.parcels[located.parcel as usize].cover {
            Cover::Green => [0.06, 0.085, 0.03],
            Cover::Ripe => [0.24, 0.19, 0.1],
            Cover::Stubble => [0.22, 0.19, 0.12],
            Cover::Plough => [0.12, 0.09, 0.065],
            Cover::Sprouting => [0.11, 0.1, 0.06],
            Cover::Pasture => [0.075, 0.09, 0.035],
            Cover::Mown => [0.12, 0.125, 0.06],
            Cover::Floor => [0.05, 0.045, 0.03],
        };
        scale(base, 1.0 + 0.3 * fractal(p.n, p.e, 40.0, 6, gsd, 3))
    }

    fn surface(&self, ground: Ground, p: Spot, gsd: f32) -> Color {
        let base = match ground {
            Ground::Lawn | Ground::Turf => [0.065, 0.09, 0.032],
            Ground::Grass => [0.08, 0.09, 0.04],
            Ground::Asphalt | Ground::Stalls => [0.11, 0.11, 0.11],
            Ground::Concrete => [0.3, 0.29, 0.26],
            Ground::Gravel => [0.24, 0.22, 0.19],
            Ground::Dirt => [0.2, 0.16, 0.12],
            Ground::Paving => [0.3, 0.28, 0.25],
            Ground::Pool => [0.1, 0.36, 0.45],
            Ground::Pond => [0.025, 0.032, 0.03],
            Ground::Paint | Ground::Zebra => [0.55, 0.55, 0.52],
            Ground::Tartan => [0.24, 0.09, 0.06],
            Ground::Rock => [0.33, 0.3, 0.26],
            Ground::Beds => [0.1, 0.09, 0.05],
            Ground::Graves => [0.16, 0.17, 0.13],
        };
        scale(base, 1.0 + 0.15 * fractal(p.n, p.e, 6.0, 5, gsd, 9))
    }

    fn roads(&self, under: Color, cell: &[u32], p: Spot, soft: f32) -> Color {
        let mut out = under;
        for &i in cell {
            let s: &Segment = &self.segments[i as usize];
            let (distance, ..) = s.measure(p);
            let tone = match s.class {
                super::things::RoadClass::Track => [0.2, 0.17, 0.13],
                super::things::RoadClass::Main => [0.125, 0.125, 0.122],
                _ => [0.13, 0.13, 0.128],
            };
            out = mix(out, tone, cover_share(distance - s.half_width, soft));
        }
        let on_main = |s: &&Segment| s.class == super::things::RoadClass::Main;
        for s in cell
            .iter()
            .map(|&i| &self.segments[i as usize])
            .filter(on_main)
        {
            let (distance, v, _) = s.measure(p);
            if (distance - v.abs()).abs() < 1e-3 {
                out = mix(
                    out,
                    [0.5, 0.36, 0.06],
                    cover_share((v.abs() - 0.14).abs() - 0.06, soft),
                );
                let edge = (v.abs() - (s.half_width - 0.3)).abs();
                out = mix(out, [0.5, 0.5, 0.48], cover_share(edge - 0.06, soft));
            }
        }
        out
    }

    fn roof(&self, solid: &Solid, number: u32, p: Spot, soft: f32) -> Color {
        let (u, v) = solid.slab.local(p);
        let axis = solid.slab.axis;
        let pitch = solid.rise / solid.slab.half_across;
        let (slope, height) = match solid.roof {
            Roof::Gable | Roof::Vault => (
                axis.right() * (-pitch * v.signum()),
                solid.eaves + solid.rise - pitch * v.abs(),
            ),
            Roof::Hip => {
                let to_end = solid.slab.half_along - u.abs();
                let to_side = solid.slab.half_across - v.abs();
                if to_end < to_side {
                    (axis * (-pitch * u.signum()), solid.eaves + pitch * to_end)
                } else {
                    (
                        axis.right() * (-pitch * v.signum()),
                        solid.eaves + pitch * to_side,
                    )
                }
            }
            _ => (spot(0.0, 0.0), solid.eaves),
        };
        let sunlit = self.sun_reaching(p, height, number, soft);
        let albedo = scale(solid.color, 1.0 + 0.1 * fractal(p.n, p.e, 3.0, 4, soft, 21));
        self.light
            .reflect(albedo, sunlit * self.light.cosine(slope), 0.9)
    }

    /// Share of the sun that reaches a place at a height, 0 to 1.
    fn sun_reaching(&self, p: Spot, height: f32, caster: u32, soft: f32) -> f32 {
        let on_ground = p - self.light.toward * (self.light.shadow_per_height * height);
        let Some(cell) = cell_of(on_ground) else {
            return 1.0;
        };
        let mut lit: f32 = 1.0;
        for &i in self.shadow_grid.cell(cell) {
            let shadow = &self.shadows[i as usize];
            if shadow.caster != caster && shadow.top > height + 0.2 {
                lit = lit.min(1.0 - cover_share(shadow.distance(on_ground), soft));
            }
        }
        for &i in self.crown_shadow_grid.cell(cell) {
            let crown = &self.plan.crowns[i as usize];
            if crown.height > height {
                let e = crown_shadow(crown, &self.light);
                let (u, v) = e.local(on_ground);
                let k = ((u / e.half_along).powi(2) + (v / e.half_across).powi(2)).sqrt();
                lit = lit.min(smooth_step(0.85, 1.1, k).max(0.12));
            }
        }
        lit
    }

    /// What stands on top at a place.
    pub(super) fn kind_at(&self, p: Spot) -> Option<SceneKind> {
        let cell = cell_of(p)?;
        self.solid_grid
            .cell(cell)
            .iter()
            .map(|&i| &self.plan.solids[i as usize])
            .filter(|s| s.distance(p) < 0.0)
            .map(|s| s.label)
            .next_back()
    }
}
