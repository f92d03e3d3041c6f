//! The ground as it looks on days other than the map's.

use std::f64::consts::TAU;
use std::sync::Arc;

use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::frames::GroundRect;
use crate::imagery::{CachedImagery, Imagery, Window};
use crate::raster::{Gray, Raster, Rgba, gaussian_blur};
use crate::simulate::scenery::{Day, Scenery, Season};

/// Memory for tiles of one day, megabytes.
const CACHE_MEGABYTES: usize = 24;

/// The same ground on other days.
pub trait OtherDays: Send + Sync {
    /// The ground on a day drawn by `seed`, drawn anew wherever it is looked at.
    fn drawn(&self, seed: u64) -> Arc<dyn Imagery>;

    /// `count` days drawn by `seed` that lie as evenly among all days as so few can.
    fn spread(&self, count: usize, seed: u64) -> Vec<Arc<dyn Imagery>> {
        let seeds = (0..count as u64).map(|i| seed.wrapping_mul(0x9e37_79b9).wrapping_add(i));
        seeds.map(|seed| self.drawn(seed)).collect()
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

/// Other days of a picture of which nobody knows what it shows.
pub struct PictureDays {
    /// The map.
    pub map: Arc<dyn Imagery>,
}

impl OtherDays for PictureDays {
    fn drawn(&self, seed: u64) -> Arc<dyn Imagery> {
        Arc::new(ChangedPicture {
            map: Arc::clone(&self.map),
            seed,
        })
    }
}

/// A picture made to look as on another day and from another place, as far as that can be done without
/// knowing what it shows: shadows fall elsewhere, fine texture grew anew, light and contrast changed by
/// the field, and what stands up leans another way. Leaning is what tells woods from roads: every few
/// metres the ground moves, by half a metre anywhere and by metres where it is green and rough over
/// several metres, which is what a canopy looks like from above. A lawn is not rough, a bush not wide.
struct ChangedPicture {
    map: Arc<dyn Imagery>,
    seed: u64,
}

/// Width of the surroundings next to which a pixel counts as in shadow, metres.
const SURROUNDINGS: f64 = 6.0;
/// Size of the fields over which the light changes, metres.
const FIELD: f64 = 25.0;
/// Width below which texture is taken to be leaves and grass, metres.
const TEXTURE: f64 = 0.5;
/// Share of that texture that is the same on another day.
const TEXTURE_KEPT: f64 = 0.5;
/// Furthest that shadows move, metres.
const SHADOW_SHIFT: f64 = 3.0;
/// Size of what stands up, metres.
const CROWN: f64 = 4.0;
/// How far the ground leans at most where nothing is known to stand on it, metres.
const LEAN: f64 = 0.5;
/// How far a canopy leans at most, metres: a tree of 10 m seen 20° off.
const CANOPY_LEAN: f64 = 3.5;
/// Width over which a canopy is green and rough, metres: what is smaller is not high.
const CANOPY: f64 = 3.0;
/// Width of the surroundings next to which a canopy is rough, metres.
const FOLIAGE: f64 = 1.0;
/// Excess of green times roughness, both as shares of the brightness, from which on something may be a
/// canopy; from three times as much on it is one.
const ROUGH_GREEN: f32 = 0.006;
/// Brightness next to its surroundings below which a pixel is in shadow.
const SHADOW: f32 = 0.72;

impl Imagery for ChangedPicture {
    fn name(&self) -> &str {
        self.map.name()
    }

    fn bounds(&self) -> GroundRect {
        self.map.bounds()
    }

    fn native_gsd(&self) -> f64 {
        self.map.native_gsd()
    }

    fn window(&self, window: &Window) -> Raster<Rgba> {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        let bearing = TAU * random.random::<f64>();
        let shift = SHADOW_SHIFT * random.random::<f64>() / window.gsd;
        let contrast = 0.8 + 0.35 * random.random::<f64>();
        // Enough around the window that its pixels do not depend on how it was cut.
        let margin = ((2.0 * SURROUNDINGS + SHADOW_SHIFT) / window.gsd).ceil() as usize;
        let wide = Window {
            north_edge: window.north_edge + margin as f64 * window.gsd,
            west_edge: window.west_edge - margin as f64 * window.gsd,
            width: window.width + 2 * margin,
            height: window.height + 2 * margin,
            ..*window
        };
        let picture = self.map.window(&wide);
        let bright = picture.to_gray();
        let around = gaussian_blur(&bright, SURROUNDINGS / window.gsd);
        let smooth = gaussian_blur(&bright, (TEXTURE / window.gsd).max(0.3));
        let canopy = canopy(&picture, &bright, window.gsd);
        let (dx, dy) = (shift * bearing.sin(), -shift * bearing.cos());
        Raster::from_fn(window.width, window.height, |column, row| {
            let place = window.ground_at(column as f64 + 0.5, row as f64 + 0.5);
            let grown_over = f64::from(canopy.get(column + margin, row + margin));
            let most = LEAN + (CANOPY_LEAN - LEAN) * grown_over;
            let lean = |layer| {
                let metres = most * self.noise(place.north / CROWN, place.east / CROWN, layer);
                (metres / window.gsd).round() as isize
            };
            let (c, r) = (
                (column + margin).saturating_add_signed(lean(3)),
                (row + margin).saturating_add_signed(lean(4)),
            );
            let pixel = picture.get(c, r);
            let before = bright.get(c, r).max(1.0);
            let light = |c: usize, r: usize| shadow(&smooth, &around, c, r);
            let shaded = light(
                (c as f64 - dx).round().max(0.0) as usize,
                (r as f64 - dy).round().max(0.0) as usize,
            );
            let field = self.noise(place.north / FIELD, place.east / FIELD, 1);
            let leaf = self.noise(place.north / TEXTURE, place.east / TEXTURE, 2);
            let texture = bright.get(c, r) - smooth.get(c, r);
            let strength = texture.abs().min(30.0);
            let grown = TEXTURE_KEPT as f32 * texture
                + (1.0 - TEXTURE_KEPT) as f32 * strength * 2.0 * leaf as f32;
            let lit = smooth.get(c, r) / light(c, r) * shaded + grown;
            let after = (128.0 + contrast as f32 * (lit - 128.0)) * (1.0 + 0.25 * field as f32);
            let gain = after.max(0.0) / before;
            let scale = |v: u8| (f32::from(v) * gain).clamp(0.0, 255.0) as u8;
            [scale(pixel[0]), scale(pixel[1]), scale(pixel[2]), pixel[3]]
        })
    }
}

/// Share of the light that reaches a pixel: 1, or less where it is much darker than its surroundings.
fn shadow(bright: &Gray, around: &Gray, column: usize, row: usize) -> f32 {
    let (c, r) = (column.min(bright.width() - 1), row.min(bright.height() - 1));
    let ratio = bright.get(c, r) / around.get(c, r).max(1.0);
    if ratio < SHADOW { ratio.max(0.4) } else { 1.0 }
}

/// How much every pixel is canopy, 0 to 1.
fn canopy(picture: &Raster<Rgba>, bright: &Gray, gsd: f64) -> Gray {
    let smooth = gaussian_blur(bright, FOLIAGE / gsd);
    let rough_green = Gray::from_fn(bright.width(), bright.height(), |column, row| {
        let [red, green, blue, _] = picture.get(column, row).map(f32::from);
        let excess = (2.0 * green - red - blue) / (red + green + blue).max(1.0);
        let around = smooth.get(column, row).max(8.0);
        excess.max(0.0) * (bright.get(column, row) - around).abs() / around
    });
    let sure = |v: f32| (0.5 * (v - ROUGH_GREEN) / ROUGH_GREEN).clamp(0.0, 1.0);
    gaussian_blur(&rough_green, CANOPY / gsd).map(sure)
}

impl ChangedPicture {
    /// Smooth noise of unit cells, -1 to 1.
    fn noise(&self, north: f64, east: f64, layer: u64) -> f64 {
        let (n0, e0) = (north.floor(), east.floor());
        let ease = |t: f64| t * t * (3.0 - 2.0 * t);
        let (tn, te) = (ease(north - n0), ease(east - e0));
        let corner = |dn: f64, de: f64| {
            let mut hash = self.seed ^ layer.wrapping_mul(0x9e37_79b9_7f4a_7c15);
            for key in [(n0 + dn) as i64, (e0 + de) as i64] {
                hash = (hash ^ key as u64).wrapping_mul(0xbf58_476d_1ce4_e5b9);
                hash ^= hash >> 29;
            }
            (hash >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        let low = corner(0.0, 0.0) * (1.0 - te) + corner(0.0, 1.0) * te;
        let high = corner(1.0, 0.0) * (1.0 - te) + corner(1.0, 1.0) * te;
        low * (1.0 - tn) + high * tn
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

    /// How much the middle of a ground is canopy that is painted with the colour `paint` gives to a coarse
    /// random number, 0 to 1, within `half` metres of the middle, and lawn elsewhere.
    fn canopy_of(half: f64, paint: impl Fn(f64) -> [f64; 3]) -> f32 {
        const GSD: f64 = 0.25;
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let numbers: Vec<f64> = (0..40 * 40).map(|_| random.random()).collect();
        let picture = Raster::from_fn(160, 160, |column, row| {
            let off = |at: usize| (GSD * (at as f64 + 0.5) - 20.0).abs();
            let [r, g, b] = if off(column).max(off(row)) < half {
                paint(numbers[row / 4 * 40 + column / 4])
            } else {
                [100.0, 130.0, 60.0]
            };
            [r as u8, g as u8, b as u8, 255]
        });
        canopy(&picture, &picture.to_gray(), GSD).get(80, 80)
    }

    #[test]
    fn wide_rough_green_is_a_canopy_and_a_lawn_a_bush_and_gravel_are_not() {
        let leaves = |v: f64| [60.0, 90.0, 40.0].map(|c| c * (0.5 + v));
        let gravel = |v: f64| [90.0; 3].map(|c| c * (0.5 + v));
        let wood = canopy_of(18.0, leaves);
        assert!(wood > 0.8, "{wood}");
        let bush = canopy_of(1.0, leaves);
        assert!(bush < 0.3, "{bush}");
        let lawn = canopy_of(0.0, leaves);
        assert!(lawn < 0.05, "{lawn}");
        let stones = canopy_of(18.0, gravel);
        assert!(stones < 0.05, "{stones}");
    }
}
