//! Leaf colours of one day.

use super::day::Season;
use super::light::{Color, mix, scale};
use super::noise::{hash2, unit, value_noise};
use super::things::{Crown, Habit};

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
    pub(super) fn density(self, habit: Habit) -> f32 {
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
    pub(super) fn color(self, crown: &Crown) -> Color {
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
