//! Roofs: planes towards and away from the sun, coverings, parapets, stains.

use super::coverings::{Grain, covering};
use super::face::Face;
use super::fields::{line_share, repeated, stripes};
use super::light::{Color, mix, scale};
use super::noise::{hash2, unit};
use super::shape::{Spot, spot};
use super::texture::individual;
use super::things::{Roof, RoofCover, Solid};
use super::world::SceneryWorld;

fn face(solid: &Solid, u: f32, v: f32) -> Face {
    let (a, b) = (solid.slab.half_along, solid.slab.half_across);
    let axis = solid.slab.axis;
    let right = axis.right();
    let pitch = solid.rise / b;
    let flat = Face {
        slope: spot(0.0, 0.0),
        height: solid.eaves,
        down: b - v.abs(),
        along: u,
        glazing: 0.0,
        ridge: 1e3,
    };
    match solid.roof {
        Roof::Flat => flat,
        Roof::Gable => Face {
            slope: right * (-pitch * v.signum()),
            height: solid.eaves + solid.rise - pitch * v.abs(),
            down: v.abs(),
            ridge: v.abs(),
            ..flat
        },
        Roof::Hip => {
            let (to_end, to_side) = (a - u.abs(), b - v.abs());
            let ridge =
                ((to_end - to_side).abs() * 0.7).min(if to_end > to_side { v.abs() } else { 1e3 });
            if to_end < to_side {
                Face {
                    slope: axis * (-pitch * u.signum()),
                    height: solid.eaves + pitch * to_end,
                    down: b - to_end,
                    along: v,
                    ridge,
                    ..flat
                }
            } else {
                Face {
                    slope: right * (-pitch * v.signum()),
                    height: solid.eaves + pitch * to_side,
                    down: v.abs(),
                    ridge,
                    ..flat
                }
            }
        }
        Roof::Vault => {
            let t = (v / b).clamp(-0.97, 0.97);
            let rest = (1.0 - t * t).sqrt();
            Face {
                slope: right * (-solid.rise / b * t / rest),
                height: solid.eaves + solid.rise * rest,
                down: v,
                ..flat
            }
        }
        Roof::Sawtooth(period) => {
            let t = (u + a) / period;
            let phase = t - t.floor();
            if phase < 0.22 {
                Face {
                    slope: axis * (solid.rise / (0.22 * period)),
                    height: solid.eaves + solid.rise * phase / 0.22,
                    glazing: 1.0,
                    down: phase * period,
                    along: v,
                    ..flat
                }
            } else {
                let fall = (phase - 0.22) / 0.78;
                Face {
                    slope: axis * (-solid.rise / (0.78 * period)),
                    height: solid.eaves + solid.rise * (1.0 - fall),
                    down: fall * period,
                    along: v,
                    ..flat
                }
            }
        }
        Roof::Cone | Roof::Dome => {
            let d = axis * u + right * v;
            let r = d.length().max(0.05);
            let t = r / a;
            let grade = if solid.roof == Roof::Cone {
                solid.rise / a
            } else {
                1.6 * solid.rise / a * t / (1.04 - t * t).max(0.1).sqrt()
            };
            Face {
                slope: d * (-grade / r),
                height: solid.eaves + solid.rise * (1.0 - t * t),
                down: r,
                along: a * v.atan2(u),
                ..flat
            }
        }
    }
}

impl SceneryWorld {
    /// Light from a roof at a place.
    pub(super) fn roof(&self, solid: &Solid, number: u32, p: Spot, gsd: f32, soft: f32) -> Color {
        let (u, v) = solid.slab.local(p);
        let f = face(solid, u, v);
        let inside = -solid.distance(p);
        let [speckle, clumps, patches, veins] = self
            .land
            .textures
            .grain
            .sample(individual(p, solid.variant), gsd);
        let tint = unit(hash2(solid.variant as i32, 6, 6));
        let mut slope = f.slope;
        let found = Grain {
            speckle,
            clumps,
            patches,
            veins,
            tint,
        };
        let mut c = covering(solid, &f, (u, v, inside), &found, gsd);
        if solid.cover == RoofCover::Metal {
            slope = slope + solid.slab.axis * (0.1 * stripes(f.along, 0.9, gsd));
        }
        if f.glazing > 0.0 {
            let bar = line_share(repeated(f.along, 1.2), 0.08, gsd);
            c = mix([0.09, 0.11, 0.125], [0.36, 0.37, 0.37], 0.3 + 0.6 * bar);
        }
        let mut sunlit = self.sun_reaching(p, f.height, number, gsd, soft);
        let mut open = 0.95;
        if solid.roof == Roof::Flat && solid.slab.half_across > 2.0 {
            // The parapet: a light rim, and its shadow on the side of the sun.
            c = mix(
                c,
                [0.36, 0.355, 0.34],
                0.75 * line_share(inside - 0.15, 0.17, gsd),
            );
            let toward_sun = solid
                .slab
                .distance(p + self.light.toward * (0.7 * self.light.shadow_per_height));
            if inside > 0.3 {
                sunlit *= 1.0 - 0.85 * (0.5 + (toward_sun + 0.3) / soft).clamp(0.0, 1.0);
            }
        } else if matches!(solid.roof, Roof::Gable | Roof::Hip) {
            c = mix(
                c,
                scale(c, 0.62),
                0.7 * line_share(inside - 0.07, 0.08, gsd),
            );
        }
        if f.glazing > 0.0 {
            open = 0.8;
        }
        self.light
            .reflect(c, sunlit * self.light.cosine(slope), open)
    }
}
