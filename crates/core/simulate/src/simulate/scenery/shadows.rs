//! How much of the sun reaches a place.

use super::grid::cell_of;
use super::light::Light;
use super::shape::{Slab, Spot, convex_hull};
use super::things::{Crown, Form, Habit, Prop};
use super::world::World;

/// The shadow of a solid or prop on level ground: a convex polygon as half planes.
#[derive(Clone, Debug)]
pub(super) struct Shadow {
    /// `normal · p - offset` is positive outside.
    planes: Vec<(Spot, f32)>,
    pub(super) corners: Vec<Spot>,
    /// Height of the caster's top, metres.
    top: f32,
    /// Number of the solid that casts it, or `u32::MAX`.
    caster: u32,
}

impl Shadow {
    /// Signed distance, metres, negative inside the shadow.
    #[inline]
    pub(super) fn distance(&self, p: Spot) -> f32 {
        self.planes
            .iter()
            .map(|(normal, offset)| normal.dot(p) - offset)
            .fold(f32::MIN, f32::max)
    }

    /// As [`Self::distance`], but gives up once the distance is over `limit`.
    #[inline]
    fn distance_below(&self, p: Spot, limit: f32) -> f32 {
        let mut most = f32::MIN;
        for (normal, offset) in &self.planes {
            most = most.max(normal.dot(p) - offset);
            if most > limit {
                break;
            }
        }
        most
    }

    /// The shadow of the convex hull of points (place, height).
    pub(super) fn cast(points: &[(Spot, f32)], light: &Light, caster: u32) -> Self {
        let away = light.toward * -light.shadow_per_height;
        let corners = convex_hull(points.iter().map(|&(p, h)| p + away * h).collect());
        let center = super::parcels::center_of(&corners);
        let planes = (0..corners.len())
            .map(|i| {
                let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
                let mut normal = (b - a).unit().right();
                if normal.dot(center - a) > 0.0 {
                    normal = normal * -1.0;
                }
                (normal, normal.dot(a))
            })
            .collect();
        let top = points.iter().map(|&(_, h)| h).fold(0.0, f32::max);
        Self {
            planes,
            corners,
            top,
            caster,
        }
    }
}

/// Points (place, height) whose hull stands for a car, bale or crate.
pub(super) fn prop_vertices(p: &Prop) -> Vec<(Spot, f32)> {
    let corners = p.slab.corners();
    let low = if p.form == Form::Car {
        0.55 * p.height
    } else {
        p.height
    };
    let cabin = Slab {
        half_along: 0.6 * p.slab.half_along,
        ..p.slab
    };
    corners
        .iter()
        .map(|&c| (c, 0.0))
        .chain(corners.iter().map(|&c| (c, low)))
        .chain(cabin.corners().into_iter().map(|c| (c, p.height)))
        .collect()
}

/// The elliptic shadow of a crown.
#[derive(Clone, Copy, Debug)]
pub(super) struct CrownShadow {
    center: Spot,
    inverse_along: f32,
    inverse_across: f32,
    /// Place and height of the crown's middle.
    crown: Spot,
    middle: f32,
    radius: f32,
    density: f32,
}

impl CrownShadow {
    /// The crown is taken as an ellipsoid in the upper part of the tree.
    pub(super) fn new(c: &Crown, light: &Light, bare: bool) -> Self {
        let semi = match c.habit {
            Habit::Conifer => 0.4 * c.height,
            Habit::Broadleaf | Habit::Dead => 0.36 * c.height,
            Habit::Shrub => 0.5 * c.height,
        };
        let k = light.shadow_per_height;
        let middle = c.height - semi;
        let leaves = c.habit != Habit::Conifer && bare || c.habit == Habit::Dead;
        Self {
            center: c.center - light.toward * (k * middle),
            inverse_along: 1.0 / c.radius.hypot(semi * k),
            inverse_across: 1.0 / (0.96 * c.radius),
            crown: c.center,
            middle,
            radius: c.radius,
            density: if leaves { 0.45 } else { 0.97 },
        }
    }

    /// The rectangle that holds the shadow.
    pub(super) fn slab(&self, light: &Light) -> Slab {
        Slab {
            center: self.center,
            axis: light.toward,
            half_along: 1.25 / self.inverse_along,
            half_across: 1.25 / self.inverse_across,
        }
    }
}

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

impl World {
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
