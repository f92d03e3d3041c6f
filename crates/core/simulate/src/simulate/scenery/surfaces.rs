//! Flat surfaces: lawns, yards, car parks, water, graves.

use super::fields::{line_share, repeated, stripes};
use super::light::{Color, mix, scale};
use super::noise::{fractal, hash2, smooth_step, unit};
use super::shape::Spot;
use super::texture::individual;
use super::things::{FlatSurface, SurfaceMaterial};
use super::world::SceneryWorld;

impl SceneryWorld {
    /// Reflectance of a surface at a place `depth` metres inside its edge.
    #[expect(clippy::too_many_lines, reason = "one arm for each material")]
    pub(super) fn surface(&self, s: &FlatSurface, p: Spot, depth: f32, gsd: f32) -> Color {
        let g = individual(p, s.variant);
        let [speckle, clumps, patches, veins] = self.land.textures.grain.sample(g, gsd);
        let tint = unit(hash2(s.variant as i32, 3, 8));
        let along = s.axis.dot(p);
        let across = s.axis.cross(p);
        match s.ground {
            SurfaceMaterial::Lawn => {
                let care = unit(hash2(s.variant as i32, self.growth as i32, 4));
                let green = mix([0.058, 0.076, 0.028], [0.078, 0.1, 0.036], tint);
                let dry = [0.128, 0.12, 0.062];
                let stripe = stripes(across + 0.1 * patches, 1.3, gsd) * 0.06 * care;
                let c = mix(
                    green,
                    dry,
                    smooth_step(-0.1, 1.1, patches * 0.8 + 0.9 * (tint - 0.35)),
                );
                scale(c, 1.0 + stripe + 0.13 * clumps + 0.1 * speckle)
            }
            SurfaceMaterial::Turf => {
                let stripe = stripes(along, 10.0, gsd);
                let c = mix(
                    [0.06, 0.085, 0.03],
                    [0.085, 0.1, 0.045],
                    0.4 + 0.4 * patches,
                );
                scale(
                    c,
                    1.0 + 0.09 * stripe.signum() * stripe.abs().sqrt()
                        + 0.08 * clumps
                        + 0.08 * speckle,
                )
            }
            SurfaceMaterial::Grass => {
                let c = mix(
                    [0.062, 0.074, 0.032],
                    [0.12, 0.112, 0.06],
                    0.45 + 0.5 * patches,
                );
                scale(c, 1.0 + 0.22 * clumps + 0.14 * speckle)
            }
            SurfaceMaterial::Asphalt => tarmac([speckle, clumps, patches, veins], tint),
            SurfaceMaterial::Stalls => {
                let mut c = tarmac([speckle, clumps, patches, veins], 0.35);
                let oil = smooth_step(0.3, 0.05, repeated(along + 1.3, 2.6).abs() * 0.4)
                    * smooth_step(0.2, 0.7, clumps + patches);
                c = scale(c, 1.0 - 0.2 * oil);
                let line =
                    line_share(repeated(along, 2.6), 0.06, gsd) * smooth_step(0.0, 0.3, depth);
                let middle = line_share(across - s.axis.cross(surface_center(s)), 0.06, gsd);
                mix(
                    c,
                    [0.5, 0.5, 0.48],
                    (0.85 + 0.4 * clumps).clamp(0.0, 1.0) * line.max(middle),
                )
            }
            SurfaceMaterial::Concrete => {
                let joint = line_share(repeated(along, 4.5), 0.05, gsd).max(line_share(
                    repeated(across, 4.5),
                    0.05,
                    gsd,
                ));
                let slab = unit(hash2(
                    (along / 4.5).round() as i32,
                    (across / 4.5).round() as i32,
                    s.variant,
                ));
                let c = scale(
                    [0.25, 0.238, 0.21],
                    0.92 + 0.16 * slab + 0.12 * patches + 0.05 * clumps + 0.06 * speckle,
                );
                mix(
                    mix(
                        c,
                        [0.12, 0.11, 0.095],
                        0.4 * smooth_step(0.35, 0.9, patches + 0.5 * clumps),
                    ),
                    [0.09, 0.085, 0.07],
                    0.6 * joint,
                )
            }
            SurfaceMaterial::Gravel => {
                let c = mix([0.205, 0.19, 0.165], [0.24, 0.215, 0.175], tint);
                let c = scale(c, 1.0 + 0.16 * speckle + 0.07 * clumps + 0.1 * patches);
                mix(
                    c,
                    [0.09, 0.095, 0.05],
                    0.55 * smooth_step(0.3, 0.7, clumps + 0.7 * patches - 0.25 * depth),
                )
            }
            SurfaceMaterial::Dirt => {
                let wet = smooth_step(0.15, 0.65, patches + 0.35 * clumps);
                let c = mix([0.2, 0.17, 0.13], [0.115, 0.092, 0.068], wet);
                let ruts = smooth_step(
                    0.35,
                    0.7,
                    fractal(along * 0.35, across * 2.2, 4.0, 3, gsd, 61),
                );
                let c = scale(
                    mix(c, [0.1, 0.082, 0.06], 0.35 * ruts),
                    1.0 + 0.14 * clumps + 0.14 * speckle,
                );
                mix(
                    c,
                    [0.075, 0.085, 0.037],
                    0.7 * smooth_step(0.1, 0.7, clumps + patches - 0.35 * depth + 0.5),
                )
            }
            SurfaceMaterial::Paving => {
                let joint = line_share(repeated(along, 1.0), 0.025, gsd).max(line_share(
                    repeated(across, 1.0),
                    0.025,
                    gsd,
                ));
                let slab = unit(hash2(
                    (along).round() as i32,
                    (across).round() as i32,
                    s.variant,
                ));
                let base = mix(
                    [0.27, 0.245, 0.21],
                    [0.2, 0.165, 0.14],
                    (tint - 0.4).clamp(0.0, 1.0),
                );
                let c = scale(
                    base,
                    0.93 + 0.14 * slab + 0.1 * patches + 0.07 * clumps + 0.04 * speckle,
                );
                mix(c, scale(base, 0.5), joint)
            }
            SurfaceMaterial::Pool => {
                let wave = fractal(p.n, p.e, 1.6, 3, gsd, 71);
                let ripple = (1.0 - wave.abs() * 3.0).max(0.0);
                let lanes = line_share(
                    repeated(across - s.axis.cross(surface_center(s)) + 1.25, 2.5),
                    0.14,
                    gsd,
                );
                let deep = mix(
                    [0.085, 0.3, 0.38],
                    [0.13, 0.36, 0.42],
                    smooth_step(-12.0, 12.0, along - s.axis.dot(surface_center(s))),
                );
                let c = mix(
                    scale(deep, 0.97 + 0.22 * ripple * ripple + 0.04 * speckle),
                    [0.02, 0.07, 0.15],
                    0.6 * lanes * smooth_step(0.4, 0.9, depth),
                );
                mix([0.42, 0.42, 0.4], c, smooth_step(0.15, 0.35, depth))
            }
            SurfaceMaterial::Pond => {
                let ripple = fractal(p.n * 0.7, p.e * 1.4, 2.4, 3, gsd, 72);
                let deep = scale([0.017, 0.024, 0.024], 1.0 + 0.18 * ripple + 0.2 * patches);
                let algae = [0.04, 0.05, 0.018];
                let c = mix(
                    deep,
                    algae,
                    0.7 * smooth_step(0.25, 0.7, patches + 0.3 * clumps - 0.08 * depth),
                );
                mix(
                    [0.075, 0.066, 0.042],
                    c,
                    smooth_step(0.1, 1.3, depth + 0.6 * clumps),
                )
            }
            SurfaceMaterial::Paint => scale([0.45, 0.45, 0.43], 0.9 + 0.1 * clumps),
            SurfaceMaterial::Zebra => {
                let bar = smooth_step(-0.25, 0.25, stripes(along, 1.1, gsd));
                let worn = (0.9 + 0.5 * clumps + 0.2 * speckle).clamp(0.2, 1.0);
                mix([0.1, 0.1, 0.098], [0.5, 0.5, 0.48], bar * worn)
            }
            SurfaceMaterial::Tartan => scale(
                [0.135, 0.068, 0.054],
                1.0 + 0.1 * patches + 0.06 * clumps + 0.05 * speckle,
            ),
            SurfaceMaterial::Rock => {
                let from_rim = depth + 2.5 * patches + 1.5 * clumps;
                let face = smooth_step(1.6, 0.4, (from_rim - 3.0).abs())
                    + smooth_step(1.5, 0.5, (from_rim - 14.0).abs());
                let floor = smooth_step(14.0, 17.0, from_rim);
                let c = mix(
                    [0.15, 0.132, 0.105],
                    [0.24, 0.22, 0.185],
                    0.5 + 0.9 * patches,
                );
                let ruts = smooth_step(
                    0.3,
                    0.7,
                    fractal(along * 0.3, across * 1.1, 6.0, 3, gsd, 62),
                ) * floor;
                let c = mix(c, [0.27, 0.25, 0.215], 0.5 * ruts);
                let c = scale(c, 1.0 + 0.16 * clumps + 0.16 * speckle - 0.14 * veins);
                let c = mix(
                    c,
                    [0.085, 0.075, 0.06],
                    0.75 * face.min(1.0) * (0.75 + 0.6 * clumps).clamp(0.0, 1.0),
                );
                mix(
                    c,
                    [0.075, 0.08, 0.04],
                    0.7 * smooth_step(0.1, 0.7, patches + clumps - 0.06 * depth),
                )
            }
            SurfaceMaterial::Beds => {
                let row = stripes(across, 0.9, gsd);
                let kind = hash2((across / 3.6).floor() as i32, s.variant as i32, self.growth);
                let green = [
                    [0.05, 0.075, 0.026],
                    [0.085, 0.1, 0.04],
                    [0.06, 0.06, 0.035],
                    [0.1, 0.082, 0.056],
                ][(kind & 3) as usize];
                scale(
                    mix(
                        [0.1, 0.08, 0.058],
                        green,
                        smooth_step(-0.3, 0.4, row + 0.5 * clumps),
                    ),
                    1.0 + 0.2 * speckle + 0.15 * clumps,
                )
            }
            SurfaceMaterial::Graves => {
                let grass = scale(
                    mix(
                        [0.06, 0.078, 0.03],
                        [0.11, 0.108, 0.055],
                        0.4 + 0.4 * patches,
                    ),
                    1.0 + 0.12 * clumps + 0.1 * speckle,
                );
                let (row, place) = ((across / 2.7).round(), (along / 1.5).round());
                let h = hash2(row as i32, place as i32, s.variant);
                if h.is_multiple_of(4) {
                    return grass;
                }
                let (u, v) = (along - 1.5 * place, across - 2.7 * row);
                let length = 0.8 + 0.25 * unit(h);
                let stone = line_share(u, 0.42, gsd) * line_share(v, length, gsd);
                let tone = [
                    [0.3, 0.29, 0.27],
                    [0.2, 0.2, 0.2],
                    [0.1, 0.1, 0.1],
                    [0.24, 0.2, 0.17],
                    [0.1, 0.085, 0.06],
                ][(h >> 4) as usize % 5];
                let head = line_share(u, 0.36, gsd) * line_share(v - length, 0.13, gsd);
                let dark = line_share(u, 0.4, gsd) * line_share(v - length - 0.26, 0.16, gsd);
                let c = mix(grass, scale(tone, 1.0 + 0.15 * clumps), 0.9 * stone);
                mix(
                    mix(c, [0.05, 0.055, 0.04], 0.7 * dark),
                    [0.4, 0.39, 0.37],
                    head,
                )
            }
        }
    }
}

fn surface_center(s: &FlatSurface) -> Spot {
    match &s.outline {
        super::shape::GroundOutline::Slab(slab) | super::shape::GroundOutline::Ellipse(slab) => {
            slab.center
        }
        super::shape::GroundOutline::Disc(center, _) => *center,
        super::shape::GroundOutline::Polygon(corners) => super::parcels::center_of(corners),
    }
}

/// Worn asphalt.
pub(super) fn tarmac([speckle, clumps, patches, veins]: [f32; 4], age: f32) -> Color {
    let base = mix([0.075, 0.075, 0.077], [0.15, 0.147, 0.14], age);
    let c = scale(base, 1.0 + 0.11 * patches + 0.05 * clumps + 0.08 * speckle);
    mix(
        c,
        scale(base, 0.55),
        0.5 * veins * smooth_step(-0.2, 0.4, patches),
    )
}
