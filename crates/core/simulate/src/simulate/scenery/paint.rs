//! The look of one place: from the ground up, then the light.

use super::fields::line_share;
use super::grid::cell_of;
use super::light::{Color, mix};
use super::noise::fractal;
use super::shape::{GroundOutline, Spot};
use super::things::SurfaceMaterial;
use super::world::SceneryWorld;

/// Share of a pixel of that size covered at a signed distance from an edge.
#[inline]
pub(super) fn cover_share(distance: f32, gsd: f32) -> f32 {
    (0.5 - distance / gsd).clamp(0.0, 1.0)
}

impl SceneryWorld {
    /// Light that leaves a place upwards, averaged over about `gsd` metres; `None` outside.
    pub(super) fn light_at(&self, p: Spot, gsd: f32) -> Option<Color> {
        let cell = cell_of(p)?;
        let soft = (1.2 * gsd).clamp(0.2, 1.4);
        let mut albedo = self.land(p, gsd);
        let surfaces = self.land.surface_grid.cell(cell);
        let mut has_marks = false;
        for &i in surfaces {
            let surface = &self.land.plan.surfaces[i as usize];
            if surface.ground == SurfaceMaterial::Zebra {
                has_marks = true;
                continue;
            }
            let mut d = surface.outline.distance(p);
            if d > 2.0 * surface.ragged + 0.6 * soft {
                continue;
            }
            if surface.ragged > 0.0 && d.abs() < 2.0 * surface.ragged {
                d += surface.ragged * fractal(p.n, p.e, 1.2 + 2.0 * surface.ragged, 3, gsd, 40);
            }
            let share = match &surface.outline {
                GroundOutline::Slab(slab) if slab.half_across < 1.0 => {
                    let (u, v) = slab.local(p);
                    line_share(u, slab.half_along, gsd) * line_share(v, slab.half_across, gsd)
                }
                _ => cover_share(d, soft),
            };
            if share > 0.0 {
                albedo = mix(albedo, self.surface(surface, p, -d, gsd), share);
            }
        }
        let segments = self.land.segment_grid.cell(cell);
        if !segments.is_empty() {
            albedo = self.roads(albedo, segments, p, gsd, soft);
        }
        if has_marks {
            for &i in surfaces {
                let surface = &self.land.plan.surfaces[i as usize];
                if surface.ground == SurfaceMaterial::Zebra {
                    let d = surface.outline.distance(p);
                    let share = cover_share(d, soft);
                    if share > 0.0 {
                        albedo = mix(albedo, self.surface(surface, p, -d, gsd), share);
                    }
                }
            }
        }
        let sunlit = self.sun_reaching(p, 0.0, u32::MAX, gsd, soft);
        let open = self.sky_seen(p, cell) * (0.8 + 0.2 * sunlit);
        let mut light = self
            .light
            .reflect(albedo, sunlit * self.light.sin_elevation, open);
        for &i in self.prop_grid.cell(cell) {
            light = self.prop(light, &self.props[i as usize], p, gsd, soft);
        }
        for &i in self.land.solid_grid.cell(cell) {
            let solid = &self.land.plan.solids[i as usize];
            let d = solid.distance(p);
            if d > 0.6 * soft {
                continue;
            }
            let share = if solid.slab.half_across < 2.0 && !solid.is_round() {
                let (u, v) = solid.slab.local(p);
                line_share(u, solid.slab.half_along, soft)
                    * line_share(v, solid.slab.half_across, soft)
            } else {
                cover_share(d, soft)
            };
            if share > 0.0 {
                light = mix(light, self.roof(solid, i, p, gsd, soft), share);
            }
        }
        let crowns = self.land.crown_grid.cell(cell);
        if !crowns.is_empty() {
            light = self.crowns(light, crowns, p, gsd, soft);
        }
        Some(light)
    }

    /// Share of the sky that the ground at a place sees: less beside walls.
    fn sky_seen(&self, p: Spot, cell: usize) -> f32 {
        let mut open: f32 = 1.0;
        for &i in self.land.solid_grid.cell(cell) {
            let solid = &self.land.plan.solids[i as usize];
            let d = solid.distance(p);
            if d > 0.0 && d < 2.0 {
                open = open.min(0.62 + 0.19 * d);
            }
        }
        open
    }
}
