//! Share of the sun that reaches a place.

use super::grid::cell_of;
use super::shape::{Slab, Spot};
use super::world::SceneryWorld;

/// Length of the way from `p` in a direction, up to `reach`, that lies over a rectangle.
fn chord(slab: &Slab, p: Spot, direction: Spot, reach: f32) -> f32 {
    let (u, v) = slab.local(p);
    let (du, dv) = (direction.dot(slab.axis), slab.axis.cross(direction));
    let (mut from, mut to) = (0.0_f32, reach);
    for (x, d, half) in [(u, du, slab.half_along), (v, dv, slab.half_across)] {
        if d.abs() < 1e-4 {
            if x.abs() > half {
                return 0.0;
            }
        } else {
            let (a, b) = ((-half - x) / d, (half - x) / d);
            from = from.max(a.min(b));
            to = to.min(a.max(b));
        }
    }
    (to - from).max(0.0)
}

impl SceneryWorld {
    /// Share of the sun that reaches a place at a height, 0 to 1; `caster` casts none on itself.
    pub(super) fn sun_reaching(
        &self,
        p: Spot,
        height: f32,
        caster: u32,
        gsd: f32,
        soft: f32,
    ) -> f32 {
        let light = &self.light;
        let on_ground = p - light.toward * (light.shadow_per_height * height);
        let Some(cell) = cell_of(on_ground) else {
            return 1.0;
        };
        let mut lit: f32 = 1.0;
        let blur = soft.max(0.22);
        for &i in self.shadow_grid.cell(cell) {
            let shadow = &self.shadows[i as usize];
            if shadow.caster == caster || shadow.top <= height + 0.25 {
                continue;
            }
            let outside = shadow.distance_below(on_ground, 0.5 * blur);
            let mut shade = (0.5 - outside / blur).clamp(0.0, 1.0);
            if shade > 0.0 && height > 0.0 && shadow.caster != u32::MAX {
                // From a roof, only what stands between it and the sun counts.
                let slab = &self.land.plan.solids[shadow.caster as usize].slab;
                let reach = (shadow.top - height) * light.shadow_per_height;
                shade *= (chord(slab, p, light.toward, reach) / blur).clamp(0.0, 1.0);
            }
            lit = lit.min(1.0 - shade);
        }
        let crowns = self.crown_shadow_grid.cell(cell);
        if lit <= 0.0 || crowns.is_empty() {
            return lit;
        }
        let mut ragged = None;
        for &i in crowns {
            let s = &self.crown_shadows[i as usize];
            let d = on_ground - s.center;
            let u = d.dot(light.toward) * s.inverse_along;
            let v = light.toward.cross(d) * s.inverse_across;
            let k2 = u * u + v * v;
            if k2 > 1.5 {
                continue;
            }
            // Only what stands between the place and the sun.
            let ahead = (s.crown - p).dot(light.toward) * light.cos_elevation
                + (s.middle - height) * light.sin_elevation;
            if ahead < 0.35 * s.radius {
                continue;
            }
            let noise = *ragged.get_or_insert_with(|| {
                self.land.textures.foliage.sample(on_ground, gsd.max(0.2))[0]
            });
            let edge = (0.3 + 0.5 * soft) * s.inverse_across;
            let k = k2.sqrt() - 0.2 * noise;
            let shade = (0.5 - (k - 0.9) / edge).clamp(0.0, 1.0) * s.density;
            lit = lit.min(1.0 - shade);
        }
        lit
    }
}
