//! Roads at a place: surface, wear, markings, pavements and verges.

use super::fields::{line_share, repeated};
use super::light::{Color, mix, scale};
use super::noise::{smooth_step, unit};
use super::paint::cover_share;
use super::plan::RoadPiece;
use super::shape::Spot;
use super::surfaces::tarmac;
use super::things::SceneryRoadClass;
use super::world::SceneryWorld;

/// Road near a place.
#[derive(Clone, Copy)]
struct Near {
    road: u32,
    class: SceneryRoadClass,
    distance: f32,
    offset: f32,
    along: f32,
    half_width: f32,
}

const YELLOW: Color = [0.42, 0.285, 0.05];
const WHITE: Color = [0.43, 0.43, 0.41];

impl SceneryWorld {
    /// The nearest piece of each road of a cell, and how many there are.
    #[inline]
    fn nearest(&self, cell: &[u32], p: Spot) -> ([Option<Near>; 4], usize) {
        // A handful at most meet in one cell.
        let mut near: [Option<Near>; 4] = [None; 4];
        let mut count = 0;
        for &i in cell {
            let s: &RoadPiece = &self.land.segments[i as usize];
            let (distance, offset, along) = s.measure(p);
            if distance > s.half_width + 5.5 {
                continue;
            }
            let found = Near {
                road: s.road,
                class: s.class,
                distance,
                offset,
                along,
                half_width: s.half_width,
            };
            let known = near[..count]
                .iter()
                .flatten()
                .position(|n| n.road == s.road);
            match known {
                Some(k) if near[k].is_some_and(|n| n.distance <= distance) => {}
                Some(k) => near[k] = Some(found),
                None if count < 4 => {
                    near[count] = Some(found);
                    count += 1;
                }
                None => {}
            }
        }
        (near, count)
    }

    /// Paints the roads of a cell over `under`.
    #[expect(clippy::too_many_lines, reason = "layers of one road, in their order")]
    pub(super) fn roads(&self, under: Color, cell: &[u32], p: Spot, gsd: f32, soft: f32) -> Color {
        let (near, count) = self.nearest(cell, p);
        if count == 0 {
            return under;
        }
        let [speckle, clumps, patches, veins] = self.land.textures.grain.sample(p, gsd);
        let mut out = under;
        for n in near[..count].iter().flatten() {
            match n.class {
                SceneryRoadClass::Stream => out = stream(out, n, [speckle, clumps, patches]),
                SceneryRoadClass::Track => out = track(out, n, [speckle, clumps, patches], gsd),
                _ => {}
            }
        }
        // Sealed roads flow into each other with rounded corners.
        let mut depth = f32::MAX;
        let mut best: Option<&Near> = None;
        for n in near[..count]
            .iter()
            .flatten()
            .filter(|n| n.class > SceneryRoadClass::Track)
        {
            let d = n.distance - n.half_width;
            let h = (4.5 - (depth - d).abs()).max(0.0) / 4.5;
            depth = if depth > 1e6 {
                d
            } else {
                depth.min(d) - h * h * 4.5 * 0.25
            };
            if best
                .is_none_or(|b| n.class > b.class || n.class == b.class && n.distance < b.distance)
            {
                best = Some(n);
            }
        }
        let Some(main) = best else {
            return out;
        };
        let fray = depth + 0.1 * clumps + 0.08 * speckle;
        if main.class == SceneryRoadClass::Main || !self.land.plan.roads[main.road as usize].village
        {
            let grass = scale(
                mix(
                    [0.07, 0.08, 0.036],
                    [0.12, 0.112, 0.06],
                    0.5 + 0.5 * patches,
                ),
                1.0 + 0.2 * clumps + 0.12 * speckle,
            );
            out = mix(
                out,
                grass,
                0.85 * smooth_step(3.4, 2.2, fray + 0.8 * patches),
            );
            let shoulder = scale([0.2, 0.18, 0.145], 1.0 + 0.15 * speckle + 0.1 * clumps);
            out = mix(
                out,
                shoulder,
                0.8 * smooth_step(0.75, 0.25, fray + 0.25 * patches),
            );
        } else {
            let walk = cover_share((depth - 1.0).abs() - 0.8, soft);
            let slabs = line_share(repeated(main.along, 1.5), 0.03, gsd);
            let tone = scale(
                [0.215, 0.208, 0.19],
                1.0 + 0.08 * patches + 0.06 * clumps + 0.05 * speckle - 0.3 * slabs,
            );
            out = mix(out, tone, walk);
            out = mix(out, [0.3, 0.295, 0.28], line_share(depth - 0.1, 0.1, gsd));
        }
        let age = 0.45 + 0.5 * (unit(main.road.wrapping_mul(0x9e37_79b1)) - 0.5);
        let mut tar = tarmac([speckle, clumps, patches, veins], age);
        let v = main.offset;
        if main.class == SceneryRoadClass::Main || main.class == SceneryRoadClass::Street {
            // Wheel paths are worn pale, the lane's middle holds a darker oil line.
            let lane = v.abs() - 0.5 * main.half_width;
            let wheel = 1.0 - ((lane.abs() - 0.8) / 0.45).powi(2).min(1.0);
            let oil = 1.0 - (lane / 0.4).powi(2).min(1.0);
            tar = scale(tar, 1.0 + 0.07 * wheel - 0.06 * oil);
        }
        let sealed = cover_share(fray, soft);
        out = mix(out, tar, sealed);
        // Where another sealed road joins, lines stop.
        let joined = near[..count].iter().flatten().any(|n| {
            n.road != main.road
                && n.class > SceneryRoadClass::Track
                && n.distance < n.half_width + 1.2
        });
        let worn = (0.86 + 0.5 * clumps + 0.35 * patches).clamp(0.25, 1.0);
        if main.class == SceneryRoadClass::Main && main.distance > v.abs() + 1e-3 {
            return out;
        }
        if main.class == SceneryRoadClass::Main {
            let centre = line_share(v.abs() - 0.13, 0.06, gsd).max(if gsd > 0.3 {
                line_share(v, 0.12, gsd)
            } else {
                0.0
            });
            out = mix(out, YELLOW, worn * centre);
            if !joined {
                out = mix(
                    out,
                    WHITE,
                    worn * line_share(v.abs() - (main.half_width - 0.32), 0.07, gsd),
                );
            }
        } else if !joined
            && self.land.plan.roads[main.road as usize].village
            && main.half_width > 2.5
        {
            let dash = if repeated(main.along, 9.0).abs() < 1.5 {
                1.0
            } else {
                0.0
            };
            out = mix(out, WHITE, 0.8 * worn * dash * line_share(v, 0.06, gsd));
        }
        out
    }
}

fn track(under: Color, n: &Near, [speckle, clumps, patches]: [f32; 3], gsd: f32) -> Color {
    let earth = scale(
        mix([0.2, 0.17, 0.128], [0.245, 0.22, 0.18], 0.5 + 0.6 * patches),
        1.0 + 0.16 * speckle + 0.13 * clumps,
    );
    let grass = scale([0.082, 0.086, 0.042], 1.0 + 0.25 * clumps + 0.15 * speckle);
    let v = n.distance + 0.22 * clumps + 0.25 * patches;
    let bed = smooth_step(n.half_width + 0.5, n.half_width - 0.3, v);
    let verge = smooth_step(n.half_width + 1.9, n.half_width + 0.6, v);
    let middle =
        smooth_step(0.5, 0.2, n.distance + 0.2 * clumps) * smooth_step(-0.6, 0.3, patches + 0.3);
    let wet = line_share(n.distance - 0.8, 0.25, gsd) * smooth_step(0.15, 0.5, patches);
    let bare = mix(scale(earth, 1.0 - 0.35 * wet), grass, 0.75 * middle);
    mix(mix(under, grass, 0.7 * verge), bare, bed)
}

/// Dark water with wet banks, reeds and grass.
fn stream(under: Color, n: &Near, [speckle, clumps, patches]: [f32; 3]) -> Color {
    let v = n.distance - n.half_width + 0.55 * patches + 0.3 * clumps;
    let grass = scale(
        mix([0.055, 0.068, 0.028], [0.1, 0.1, 0.05], 0.5 + 0.6 * patches),
        1.0 + 0.3 * clumps + 0.15 * speckle,
    );
    let mud = scale([0.075, 0.064, 0.045], 1.0 + 0.2 * clumps);
    let water = scale([0.022, 0.027, 0.023], 1.0 + 0.3 * patches + 0.15 * speckle);
    let out = mix(
        under,
        grass,
        0.92 * smooth_step(3.6, 2.2, v + 0.8 * patches),
    );
    let out = mix(out, mud, 0.8 * smooth_step(0.8, 0.1, v));
    mix(out, water, smooth_step(0.1, -0.35, v))
}
