//! Ground with houses, trees and roads, drawn for lessons on seeing, on any day.

use std::f64::consts::TAU;

use pilotage_raster::raster::Gray;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Metres over which an edge goes from one side to the other.
const EDGE: f64 = 1.0;
/// Waves of the ground's own texture.
const WAVES: usize = 8;

/// Day on which the ground is looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DrawnDay {
    /// Snow on the ground, 0 to 1.
    pub snow: f64,
    /// Length and direction of shadows of houses: metres right and down.
    pub shadow: [f64; 2],
}

/// House: its middle, and half its width and height, metres right and down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct House {
    /// Middle.
    pub middle: [f64; 2],
    /// Half of its sides.
    pub half: [f64; 2],
}

impl House {
    /// House around a place, with half of its sides.
    pub fn new(x: f64, y: f64, half: [f64; 2]) -> Self {
        Self {
            middle: [x, y],
            half,
        }
    }
}

/// Piece of ground, in metres right and down of its upper left corner.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawnGround {
    /// Houses.
    pub houses: Vec<House>,
    /// Trees: middle and radius.
    pub trees: Vec<([f64; 2], f64)>,
    /// Straight roads, 4 m wide.
    pub roads: Vec<[[f64; 2]; 2]>,
    /// Grey levels of the ground's own texture.
    pub texture: f64,
    /// Seed of that texture.
    pub seed: u64,
}

/// 1 inside, 0 outside, by the distance within the edge.
fn inside(within: f64) -> f64 {
    let share = (0.5 + within / EDGE).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

fn mixed(from: f64, to: f64, share: f64) -> f64 {
    from + (to - from) * share
}

impl House {
    fn covers(&self, [x, y]: [f64; 2]) -> f64 {
        let out = (x - self.middle[0]).abs() - self.half[0];
        inside(-out.max((y - self.middle[1]).abs() - self.half[1]))
    }
}

impl DrawnGround {
    /// Brightness of places on a day, grey levels 0 to 255.
    pub fn on(&self, day: DrawnDay) -> impl Fn(f64, f64) -> f64 + '_ {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        let waves: Vec<[f64; 3]> = (0..WAVES)
            .map(|_| {
                let (turn, length) = (
                    TAU * random.random::<f64>(),
                    4.0 + 14.0 * random.random::<f64>(),
                );
                let (sin, cos) = turn.sin_cos();
                let phase = TAU * random.random::<f64>();
                [TAU * cos / length, TAU * sin / length, phase]
            })
            .collect();
        move |x, y| {
            let own: f64 = waves
                .iter()
                .map(|[a, b, c]| (a * x + b * y + c).sin())
                .sum();
            let own = self.texture * own / (WAVES as f64 / 2.0).sqrt();
            let mut value = mixed(95.0, 215.0, day.snow) + own * (1.0 - 0.7 * day.snow);
            for [from, to] in &self.roads {
                let (along, away) = (
                    [to[0] - from[0], to[1] - from[1]],
                    [x - from[0], y - from[1]],
                );
                let length = along[0].hypot(along[1]);
                let across = (along[0] * away[1] - along[1] * away[0]) / length;
                let share = inside(2.0 - across.abs());
                value = mixed(value, mixed(165.0, 120.0, day.snow), share);
            }
            let [dx, dy] = day.shadow;
            for house in &self.houses {
                // The shadow is the house drawn out along its direction.
                let steps = [0.25, 0.5, 0.75, 1.0];
                let dark = steps
                    .map(|part| house.covers([x - part * dx, y - part * dy]))
                    .into_iter()
                    .fold(0.0, f64::max);
                if dx.hypot(dy) > 0.0 {
                    value *= 1.0 - 0.6 * dark;
                }
            }
            for (middle, radius) in &self.trees {
                let share = inside(radius - (x - middle[0]).hypot(y - middle[1]));
                value = mixed(value, 55.0, share);
            }
            for house in &self.houses {
                value = mixed(value, mixed(185.0, 130.0, day.snow), house.covers([x, y]));
            }
            value.clamp(0.0, 255.0)
        }
    }
}

/// Picture of `width` × `height` pixels, each the brightness in its middle, with noise of `deviation` grey levels.
pub fn pictured(
    [width, height]: [usize; 2],
    (deviation, seed): (f64, u64),
    brightness: impl Fn(f64, f64) -> f64,
) -> Gray {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    Gray::from_fn(width, height, |column, row| {
        let noise: f64 = StandardNormal.sample(&mut random);
        (brightness(column as f64 + 0.5, row as f64 + 0.5) + deviation * noise) as f32
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn snow_turns_dark_and_bright_round() {
        let ground = DrawnGround {
            houses: vec![House {
                middle: [10.0, 10.0],
                half: [3.0, 4.0],
            }],
            ..DrawnGround::default()
        };
        let at = |snow, x| {
            ground.on(DrawnDay {
                snow,
                shadow: [0.0; 2],
            })(x, 10.0)
        };
        assert!(at(0.0, 10.0) > at(0.0, 2.0) + 50.0);
        assert!(at(1.0, 10.0) < at(1.0, 2.0) - 50.0);
    }
}
