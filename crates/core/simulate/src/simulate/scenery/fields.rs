//! Fields and woodland floor: crops in rows, tramlines, headlands, damp patches, worn edges.

use super::bend::BEND;
use super::light::{Color, mix, scale};
use super::noise::{floor, hash2, smooth_step, unit};
use super::parcels::FieldCover;
use super::shape::{Spot, spot};
use super::texture::{LAND_SCALE, individual};
use super::world::SceneryWorld;

/// A smooth periodic wave from -1 to 1, one crest per `period`, faded before it aliases.
#[inline]
pub(super) fn stripes(x: f32, period: f32, gsd: f32) -> f32 {
    let keep = ((period / gsd - 1.8) * 0.8).clamp(0.0, 1.0);
    if keep <= 0.0 {
        return 0.0;
    }
    let t = x / period;
    let t = ((t - floor(t) as f32) - 0.5).abs() * 4.0 - 1.0;
    keep * t * (1.5 - 0.5 * t * t)
}

/// Share of a pixel covered by a line of that half width at that distance from its middle.
#[inline]
pub(super) fn line_share(distance: f32, half_width: f32, gsd: f32) -> f32 {
    let d = distance.abs();
    ((d + 0.5 * gsd).min(half_width) - (d - 0.5 * gsd).max(-half_width)).max(0.0) / gsd
}

/// Distance to the nearest of lines repeated every `period`.
#[inline]
pub(super) fn repeated(x: f32, period: f32) -> f32 {
    x - period * floor(x / period + 0.5) as f32
}

impl SceneryWorld {
    /// Reflectance of the open land at a place.
    #[expect(clippy::too_many_lines, reason = "one arm for each crop")]
    pub(super) fn land(&self, p: Spot, gsd: f32) -> Color {
        // Boundaries wander a little.
        let [bend_n, bend_e, wet, bright] = self
            .land
            .textures
            .land
            .sample(p * LAND_SCALE, gsd * LAND_SCALE);
        let q = p + spot(bend_n, bend_e) * BEND;
        let located = self.parcels.locate(q);
        let parcel = &self.parcels.parcels[located.parcel as usize];
        let v = parcel.variant;
        let growth = hash2(v as i32, self.growth as i32, 12);
        let tint = unit(growth);
        let second = unit(growth.rotate_left(9));
        let g = individual(p, v);
        let [speckle, clumps, patches, veins] = self.land.textures.grain.sample(g, gsd);
        let wide = self
            .land
            .textures
            .grain
            .sample(spot(g.e * 0.23, g.n * 0.23), gsd * 0.23);
        let damp = 0.9 * wet + 0.25 * wide[2];
        let mottle = 0.6 * wide[2] + 0.5 * patches;

        // Near the edge the machine turns: rows run along the boundary.
        let headland = 13.0 + 3.0 * (tint - 0.5);
        let inner = located.edge > headland;
        let axis = parcel.axis;
        let across = if inner {
            axis.cross(q - spot(0.0, 0.0))
        } else {
            located.edge
        };
        let wiggle = 0.05 * clumps;

        // The seed of the boundary rows: grass, weeds, hedge bottoms.
        let verge_width = if parcel.hedged { 2.3 } else { 1.2 };
        let grass = scale(
            mix(
                [0.066, 0.076, 0.036],
                [0.11, 0.1, 0.055],
                0.5 + 0.5 * mottle,
            ),
            1.0 + 0.25 * clumps + 0.15 * speckle,
        );
        let verge = smooth_step(
            verge_width + 0.6,
            verge_width - 0.5,
            located.edge + 0.9 * clumps + 1.1 * patches,
        );

        let tram_period = 21.0 + 3.0 * (v >> 7 & 1) as f32;
        let tram = |half: f32| {
            let d = repeated(across + 6.0, tram_period).abs();
            line_share(d - 0.95, half, gsd)
        };
        let soil = {
            let dry = mix([0.17, 0.138, 0.1], [0.205, 0.175, 0.135], second);
            let wet = mix([0.075, 0.058, 0.043], [0.1, 0.078, 0.056], second);
            mix(dry, wet, smooth_step(-0.45, 0.4, damp + 0.25 * patches))
        };
        let body = match parcel.cover {
            FieldCover::Green => {
                let young = mix([0.05, 0.078, 0.034], [0.085, 0.102, 0.034], second);
                let leaf = mix([0.042, 0.06, 0.02], young, tint);
                let weak = mix([0.1, 0.105, 0.05], soil, 0.35);
                let poor = smooth_step(0.15, 0.8, damp + 0.45 * mottle);
                let rows = stripes(across + wiggle, 0.76, gsd);
                let mut c = mix(leaf, weak, 0.75 * poor);
                let gap = (0.3 + 0.45 * poor) * (0.5 - 0.5 * rows) + 0.25 * (clumps * clumps);
                c = mix(c, scale(soil, 0.5), (gap * 0.42).clamp(0.0, 0.8));
                c = scale(
                    c,
                    1.0 + 0.12 * rows * (1.0 - 0.4 * poor)
                        + 0.2 * clumps
                        + 0.14 * speckle
                        + 0.12 * mottle,
                );
                let drill = stripes(across + 0.1 * wide[1], 6.1, gsd) * 0.035;
                mix(scale(c, 1.0 + drill), scale(soil, 0.75), 0.7 * tram(0.3))
            }
            FieldCover::Ripe => {
                let ear = mix([0.165, 0.138, 0.076], [0.215, 0.178, 0.105], tint);
                let green = [0.1, 0.105, 0.05];
                let late = smooth_step(0.0, 0.9, -damp + 0.4 * mottle);
                let lodged = smooth_step(0.42, 0.6, wide[2] + 0.35 * patches);
                let mut c = mix(ear, green, 0.5 * late);
                c = scale(
                    c,
                    1.0 + 0.1 * stripes(across + wiggle, 0.5, gsd)
                        + 0.09 * clumps
                        + 0.1 * speckle
                        + 0.1 * mottle,
                );
                c = scale(c, 1.0 + lodged * (0.16 * clumps - 0.12));
                let drill = stripes(across, 6.1, gsd) * 0.03;
                mix(
                    scale(c, 1.0 + drill),
                    mix(soil, green, 0.5),
                    0.62 * tram(0.32),
                )
            }
            FieldCover::Stubble => {
                let straw = mix([0.165, 0.142, 0.095], [0.2, 0.175, 0.12], tint);
                let swath = stripes(across + 0.25 * patches, 7.4, gsd);
                let row = stripes(across + wiggle, 0.62, gsd);
                let mut c = mix(straw, soil, 0.28 + 0.22 * damp.clamp(-1.0, 1.0));
                c = scale(
                    c,
                    1.0 + 0.07 * swath.signum() * swath.abs().sqrt()
                        + 0.07 * row
                        + 0.1 * clumps
                        + 0.1 * speckle
                        + 0.1 * mottle,
                );
                let straw_line = line_share(repeated(across + 0.4 * clumps, 7.4), 0.75, gsd);
                c = mix(
                    c,
                    [0.23, 0.205, 0.14],
                    0.4 * straw_line * (0.7 + 0.5 * clumps).clamp(0.0, 1.0),
                );
                mix(
                    c,
                    [0.085, 0.095, 0.042],
                    0.5 * smooth_step(0.25, 0.7, mottle + 0.3 * damp),
                )
            }
            FieldCover::Plough => {
                let furrow = stripes(across + 0.12 * clumps, 0.42, gsd);
                let pass = stripes(across, 2.9, gsd);
                let c = scale(
                    soil,
                    1.0 + 0.17 * furrow
                        + 0.07 * pass
                        + 0.2 * clumps
                        + 0.16 * speckle
                        + 0.08 * mottle,
                );
                mix(
                    c,
                    [0.21, 0.19, 0.16],
                    0.3 * smooth_step(0.4, 0.9, mottle - damp),
                )
            }
            FieldCover::Sprouting => {
                let rows = stripes(across + wiggle, 0.6, gsd);
                let vigour = (0.45 + 0.4 * tint - 0.35 * damp + 0.25 * mottle).clamp(0.08, 0.95);
                let green = [0.062, 0.088, 0.034];
                let share = (vigour * (0.62 + 0.38 * rows) * (1.0 + 0.5 * clumps)).clamp(0.0, 1.0);
                let c = scale(mix(soil, green, share), 1.0 + 0.1 * speckle);
                mix(c, scale(soil, 0.9), 0.85 * tram(0.3))
            }
            FieldCover::Pasture => {
                let lush = mix([0.05, 0.066, 0.022], [0.076, 0.092, 0.034], tint);
                let dry = mix([0.115, 0.112, 0.058], [0.14, 0.125, 0.075], second);
                let wear = smooth_step(
                    -0.25,
                    0.85,
                    damp * 0.8 + 0.6 * mottle + 0.4 * (second - 0.5),
                );
                let mut c = mix(lush, dry, wear);
                let tussock = smooth_step(-0.1, 0.9, clumps + 0.6 * patches);
                c = mix(c, scale(lush, 0.62), 0.4 * tussock);
                let path = veins * smooth_step(0.35, 0.7, wide[2]);
                c = mix(c, [0.17, 0.145, 0.1], 0.22 * path);
                scale(c, 1.0 + 0.16 * clumps + 0.13 * speckle + 0.08 * mottle)
            }
            FieldCover::Mown => {
                let swath = stripes(across + 0.15 * patches, 5.6, gsd);
                let cut = mix([0.088, 0.1, 0.046], [0.13, 0.128, 0.066], tint);
                let lying = line_share(repeated(across + 0.3 * clumps, 5.6), 0.7, gsd);
                let mut c = scale(
                    cut,
                    1.0 + 0.05 * swath + 0.1 * clumps + 0.09 * speckle + 0.14 * mottle,
                );
                if second > 0.45 {
                    c = mix(
                        c,
                        [0.135, 0.13, 0.072],
                        0.5 * lying * (0.8 + 0.6 * clumps).clamp(0.0, 1.0),
                    );
                }
                c
            }
            FieldCover::Floor => {
                let litter = [0.058, 0.046, 0.03];
                let herb = [0.045, 0.06, 0.022];
                let c = mix(
                    litter,
                    herb,
                    smooth_step(-0.4, 0.5, mottle + 0.4 * clumps + damp),
                );
                scale(c, 1.0 + 0.4 * clumps + 0.25 * speckle)
            }
        };
        // No two fields have quite the same tone and hue.
        let tone = 0.85 + 0.3 * unit(growth.rotate_left(17));
        let warm = 0.2 * (unit(growth.rotate_left(23)) - 0.5);
        let body = if parcel.cover == FieldCover::Floor {
            body
        } else {
            let [r, g, b] = scale(body, tone);
            [r * (1.0 + warm), g, b * (1.0 - warm)]
        };
        let mut out = mix(
            body,
            grass,
            if parcel.cover == FieldCover::Floor {
                0.5 * verge
            } else {
                0.88 * verge
            },
        );
        // Farm tracks along some boundaries: two worn wheel lines.
        let rut = line_share((located.track - 0.85) + 0.15 * clumps, 0.45, gsd);
        let bed = smooth_step(2.3, 1.3, located.track + 0.7 * patches + 0.2 * clumps);
        if bed > 0.0 && located.track < 4.0 {
            let earth = scale([0.2, 0.172, 0.128], 1.0 + 0.15 * speckle + 0.12 * clumps);
            out = mix(out, grass, 0.7 * bed);
            out = mix(
                out,
                earth,
                (rut * (0.8 + 0.3 * patches)).clamp(0.0, 1.0) * bed,
            );
        }
        scale(out, 1.0 + 0.12 * bright)
    }
}
