//! Trees from above: lobed crowns with a lit and a dark side.

use super::day::Season;
use super::light::{Color, mix, scale};
use super::noise::{hash2, smooth_step, unit, value_noise};
use super::shape::{Spot, spot};
use super::texture::{individual, turned_back};
use super::things::{Crown, Habit};
use super::world::World;

/// Leaf colours of one day.
#[derive(Clone, Copy, Debug)]
pub(super) struct Foliage {
    season: Season,
    growth: u32,
}

impl Foliage {
    pub(super) fn new(season: Season, growth_seed: u64) -> Self {
        Self {
            season,
            growth: growth_seed as u32,
        }
    }

    /// Share of the crown that leaves cover, 0 to 1.
    #[inline]
    fn density(self, habit: Habit) -> f32 {
        match (habit, self.season) {
            (Habit::Conifer, _) => 1.0,
            (Habit::Dead, _) => 0.3,
            (_, Season::Summer) => 0.97,
            (_, Season::Spring) => 0.85,
            (_, Season::Autumn) => 0.9,
            (_, Season::LateWinter) => 0.35,
        }
    }

    /// Leaf reflectance of a tree.
    #[inline]
    fn color(self, crown: &Crown) -> Color {
        let v = crown.variant;
        let (a, b) = (
            unit(v.rotate_left(3)),
            unit(v.rotate_left(17).wrapping_mul(0x9e37_79b1)),
        );
        let stand = 0.5 + 0.5 * value_noise(crown.center.n * 0.017, crown.center.e * 0.017, 301);
        let base = match crown.habit {
            Habit::Conifer => mix([0.034, 0.05, 0.028], [0.07, 0.074, 0.036], a),
            Habit::Dead => [0.105, 0.098, 0.09],
            Habit::Broadleaf | Habit::Shrub => {
                let cool = mix([0.036, 0.056, 0.02], [0.052, 0.078, 0.024], a);
                let warm = mix([0.066, 0.074, 0.024], [0.078, 0.096, 0.032], a);
                mix(cool, warm, (0.55 * b + 0.45 * stand).powi(2))
            }
        };
        let seasonal = match (crown.habit, self.season) {
            (Habit::Conifer | Habit::Dead, _) | (_, Season::Summer) => base,
            (_, Season::Spring) => mix(base, [0.085, 0.11, 0.035], 0.45),
            (_, Season::LateWinter) => [0.11, 0.095, 0.08],
            (_, Season::Autumn) => {
                let h = hash2(v as i32, self.growth as i32, 9);
                let turned = [
                    [0.13, 0.095, 0.028],
                    [0.15, 0.075, 0.025],
                    [0.1, 0.06, 0.03],
                    [0.095, 0.095, 0.03],
                    [0.07, 0.08, 0.027],
                ][(h % 5) as usize];
                mix(base, turned, 0.25 + 0.5 * unit(h.rotate_left(8)))
            }
        };
        scale(seasonal, 0.8 + 0.45 * unit(v.rotate_left(25)))
    }
}

/// The best crown found at a place.
struct Top {
    height: f32,
    share: f32,
    color: Color,
    slope: Spot,
    open: f32,
}

impl World {
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

    /// One crown at the displacement `d` from its centre.
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
