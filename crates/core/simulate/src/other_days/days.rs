//! The ground as it looks on days other than the map's.

use std::sync::Arc;

use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::simulate::scenery::{Day, Scenery, Season};
use pilotage_raster::imagery::{CachedImagery, Imagery};

/// Memory for tiles of one day, megabytes.
const CACHE_MEGABYTES: usize = 24;

/// Seeds of `count` days that are drawn by `seed`.
pub fn seeds(count: usize, seed: u64) -> impl Iterator<Item = u64> {
    (0..count as u64).map(move |i| seed.wrapping_mul(0x9e37_79b9).wrapping_add(i))
}

/// The same ground on other days.
pub trait OtherDays: Send + Sync {
    /// The ground on a day drawn by `seed`, drawn anew wherever it is looked at.
    fn drawn(&self, seed: u64) -> Arc<dyn Imagery>;

    /// `count` days drawn by `seed` that lie as evenly among all days as so few can.
    fn spread(&self, count: usize, seed: u64) -> Vec<Arc<dyn Imagery>> {
        seeds(count, seed).map(|seed| self.drawn(seed)).collect()
    }

    /// The same as photographs of a landmark show them, from which its looks are learned: what stands up
    /// leans one way in each of them.
    fn photographed(&self, count: usize, seed: u64) -> Vec<Arc<dyn Imagery>> {
        self.spread(count, seed)
    }

    /// The ground on a day drawn by `seed`, kept where it was looked at.
    fn day(&self, seed: u64) -> Arc<dyn Imagery> {
        Arc::new(CachedImagery::new(self.drawn(seed), CACHE_MEGABYTES))
    }
}

/// Other days of generated scenery: it knows what throws a shadow and what grows.
pub struct SceneryDays {
    /// The scenery on any day; what does not change from day to day is shared with it.
    pub scenery: Scenery,
}

/// Properties of a day that are drawn.
const PROPERTIES: usize = 7;

/// A day between spring and autumn with a sun that one flies under.
pub fn any_day(seed: u64) -> Day {
    let mut random = ChaCha8Rng::seed_from_u64(seed ^ 0x5eed_da75);
    let drawn = [(); PROPERTIES].map(|()| random.random::<f64>());
    day_of(&drawn, seed)
}

/// The day with those properties, each a share of its range; `seed` parks the cars and grows the crops.
fn day_of(drawn: &[f64; PROPERTIES], seed: u64) -> Day {
    let between = |i: usize, low: f64, high: f64| low + (high - low) * drawn[i];
    let season = match between(0, 0.0, 3.0) as u32 {
        0 => Season::Spring,
        1 => Season::Summer,
        _ => Season::Autumn,
    };
    Day {
        season,
        sun_azimuth: between(1, 100.0, 260.0).to_radians(),
        sun_elevation: between(2, 28.0, 58.0).to_radians(),
        haze: between(3, 0.03, 0.18),
        exposure: between(4, 0.88, 1.12),
        tint: [between(5, 0.96, 1.06), 1.0, between(6, 0.93, 1.05)],
        cars_seed: seed.wrapping_add(101),
        growth_seed: seed.wrapping_add(202),
    }
}

/// `count` days as [`any_day`] draws them, but evenly spread: on each property one day per `count`-th
/// of its range (Latin hypercube, `McKay` 1979), the first three together as evenly as a Halton sequence
/// (bases 3, 2 and 5) lies, shifted by a random share (`Cranley` and `Patterson` 1976).
fn spread_days(count: usize, seed: u64) -> Vec<Day> {
    let mut random = ChaCha8Rng::seed_from_u64(seed ^ 0x05e7_0f0a);
    let shift = [(); 3].map(|()| random.random::<f64>());
    let mut strata: [Vec<usize>; PROPERTIES] = std::array::from_fn(|_| (0..count).collect());
    for of_property in &mut strata {
        of_property.shuffle(&mut random);
    }
    (0..count)
        .map(|i| {
            let drawn = std::array::from_fn(|property| match [3, 2, 5].get(property) {
                Some(base) => (radical_inverse(i as u64 + 1, *base) + shift[property]).fract(),
                None => (strata[property][i] as f64 + random.random::<f64>()) / count as f64,
            });
            day_of(&drawn, random.random::<u64>() >> 1)
        })
        .collect()
}

/// The digits of `n` in a base, mirrored at the point.
fn radical_inverse(mut n: u64, base: u64) -> f64 {
    let (mut share, mut sum) = (1.0, 0.0);
    while n > 0 {
        share /= base as f64;
        sum += share * (n % base) as f64;
        n /= base;
    }
    sum
}

impl OtherDays for SceneryDays {
    fn drawn(&self, seed: u64) -> Arc<dyn Imagery> {
        Arc::new(self.scenery.on_day(any_day(seed)))
    }

    fn spread(&self, count: usize, seed: u64) -> Vec<Arc<dyn Imagery>> {
        let days = spread_days(count, seed).into_iter();
        days.map(|day| Arc::new(self.scenery.on_day(day)) as Arc<dyn Imagery>)
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spread_days_are_of_every_season_with_the_sun_all_over_its_range() {
        for seed in 0..40 {
            let days = spread_days(9, seed);
            for season in [Season::Spring, Season::Summer, Season::Autumn] {
                let of_it = days.iter().filter(|d| d.season == season).count();
                assert!((2..=4).contains(&of_it), "seed {seed}: {of_it} {season:?}");
            }
            for (low, high) in [(100.0, 180.0), (180.0, 260.0)] {
                let range = f64::to_radians(low)..f64::to_radians(high);
                let there = days.iter().filter(|d| range.contains(&d.sun_azimuth));
                assert!((3..=6).contains(&there.count()), "seed {seed}");
            }
            let mean: f64 = days.iter().map(|d| d.exposure).sum::<f64>() / 9.0;
            assert!((mean - 1.0).abs() < 0.02, "seed {seed}: {mean}");
        }
        assert_ne!(spread_days(3, 1), spread_days(3, 2));
    }
}
