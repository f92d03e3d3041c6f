//! Trees from above: lobed crowns with a lit and a dark side.

use super::light::{Color, mix, scale};
use super::noise::{smooth_step, unit};
use super::shape::{Spot, spot};
use super::texture::{individual, turned_back};
use super::things::{Crown, Habit};
use super::world::SceneryWorld;

/// The best crown found at a place.
struct Top {
    height: f32,
    share: f32,
    color: Color,
    slope: Spot,
    open: f32,
}

impl SceneryWorld {
    /// Paints the crowns of a cell over `light`.
    pub(super) fn crowns(&self, light: Color, cell: &[u32], p: Spot, gsd: f32, soft: f32) -> Color {
        let mut top: Option<Top> = None;
        for &i in cell {
            let c = &self.land.plan.crowns[i as usize];
            let d = p - c.center;
            let squared = d.dot(d);
            let reach = 1.14 * c.radius + 0.5 * soft;
            if squared > reach * reach {
                continue;
            }
            let distance = squared.sqrt();
            let found = self.crown(c, d, distance, gsd, soft);
            if found.share <= 0.0 {
                continue;
            }
            match &mut top {
                Some(best) if best.height > found.height => {
                    // The lower one only fills what the higher leaves open.
                    if best.share < 1.0 {
                        best.color = mix(found.color, best.color, best.share);
                        best.share = best.share.max(found.share);
                    }
                }
                Some(best) => {
                    let under = best.share;
                    *best = Top {
                        share: found.share.max(under),
                        ..found
                    };
                }
                None => top = Some(found),
            }
        }
        let Some(top) = top else {
            return light;
        };
        let sunlit = self.sun_reaching(p, top.height, u32::MAX, gsd, soft);
        let direct = self.light.cosine(top.slope) * sunlit;
        let mut own = self.light.reflect(
            top.color,
            direct * (0.35 + 0.65 * top.open),
            0.15 + 0.75 * top.open,
        );
        // Leaves let some sun through.
        own[1] += 0.05 * top.color[1] * sunlit;
        mix(light, own, top.share)
    }

    /// Top of one crown at the displacement `d` from its centre.
    #[inline]
    fn crown(&self, c: &Crown, d: Spot, distance: f32, gsd: f32, soft: f32) -> Top {
        let r = c.radius;
        let q = individual(
            if c.habit == Habit::Broadleaf {
                d
            } else {
                d * 1.5
            },
            c.variant,
        );
        let [relief, slope_n, slope_e, tone] = self.land.textures.foliage.sample(q, gsd);
        let detail = turned_back(spot(slope_n, slope_e), c.variant) * 2.5;
        let rim = distance / r;
        let outward = d * (1.0 / distance.max(0.05));
        // Two soft lobes make every plan a little different.
        let turn = Spot::heading(unit(c.variant.rotate_left(5)) * std::f32::consts::TAU);
        let (x, y) = (outward.dot(turn), turn.cross(outward));
        let lobes = 0.07 * x + 0.16 * x * y + 0.12 * (x * x - y * y) * x;
        let (dome, steep) = match c.habit {
            Habit::Conifer => (1.0 - rim, 1.1),
            _ => ((1.0 - 0.8 * rim * rim).max(0.0).sqrt(), 0.55),
        };
        // Towards the rim only the higher clumps of leaves remain.
        let density = self.foliage.density(c.habit);
        let bar = -1.25 + 1.5 * (1.0 - density) + 2.2 * smooth_step(0.45, 1.2, rim - lobes);
        let sharp = (2.2 * gsd).clamp(0.35, 1.6);
        let share = ((relief - bar) / sharp + 0.5).clamp(0.0, 1.0)
            * (0.5 - (distance - 1.13 * r) / soft).clamp(0.0, 1.0);
        let dome_slope = match c.habit {
            Habit::Conifer => outward * -steep,
            _ => d * (-steep / (r * (1.15 - rim.min(1.0) * 0.5))),
        };
        let crevice = smooth_step(-0.85, 0.75, relief);
        let open = (0.12 + 0.85 * crevice + 0.22 * (dome - 0.5)).clamp(0.05, 1.05);
        let color = self.foliage.color(c);
        Top {
            height: c.height * (0.6 + 0.4 * dome) + 0.25 * c.radius * relief,
            share,
            color: scale(color, 1.0 + 0.42 * tone),
            slope: dome_slope + detail * 0.8,
            open,
        }
    }
}
