//! Labelled tiles of the generated country on many days.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::LabelledTile;
use super::label_grid::label_grid;
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::{Raster, Rgba};
use pilotage_simulate::other_days::any_day;
use pilotage_simulate::simulate::scenery::Scenery;
use pilotage_vision::ground_class::{CELL_PIXELS, CLASS_GSD};

/// Side of a tile, pixels.
const TILE: usize = 400;
/// Most noise of a pixel, a standard deviation, eighths of a bit.
const MOST_NOISE: f64 = 4.0;

/// Tiles of several generated countries, each on a day of its own, one after the other.
pub struct GeneratedTiles {
    scenery: Scenery,
    random: ChaCha8Rng,
}

impl GeneratedTiles {
    /// Tiles of the country of `country`, on a day drawn by `day`, at places drawn by both.
    pub fn of(country: u64, day: u64) -> Self {
        Self {
            scenery: Scenery::new(country, any_day(day)),
            random: ChaCha8Rng::seed_from_u64(country ^ day.rotate_left(32)),
        }
    }
}

impl Iterator for GeneratedTiles {
    type Item = LabelledTile;

    fn next(&mut self) -> Option<LabelledTile> {
        let bounds = self.scenery.bounds();
        let side = TILE as f64 * CLASS_GSD;
        let reach = 0.5 * (bounds.width() - side);
        let middle = bounds.center();
        let along = |random: &mut ChaCha8Rng| random.random_range(-reach..reach);
        let center = GroundPoint::new(
            middle.north + along(&mut self.random),
            middle.east + along(&mut self.random),
        );
        let mut tile = generated_tile(&self.scenery, center, TILE);
        let noise = self.random.random_range(0.0..MOST_NOISE);
        tile.picture = noisy(&tile.picture, noise, &mut self.random);
        Some(tile)
    }
}

/// The tile of so many pixels a side around `center`.
pub fn generated_tile(scenery: &Scenery, center: GroundPoint, side: usize) -> LabelledTile {
    let metres = side as f64 * CLASS_GSD;
    let rect = GroundRect::centered(center, metres, metres);
    let window = Window::covering(&rect, CLASS_GSD);
    let grid = Window {
        gsd: CELL_PIXELS as f64 * CLASS_GSD,
        width: window.width / CELL_PIXELS,
        height: window.height / CELL_PIXELS,
        ..window
    };
    LabelledTile {
        picture: scenery.window(&window),
        covers: label_grid(&scenery.labels(&rect), &grid),
    }
}

/// The picture with noise that is the same in all colours of a pixel and some that is not.
fn noisy(picture: &Raster<Rgba>, sigma: f64, random: &mut ChaCha8Rng) -> Raster<Rgba> {
    // The sum of three uniform numbers is near enough to normal, with a variance of a quarter of their range's square.
    let mut normal = || -> f64 { (0..3).map(|_| random.random_range(-1.0..1.0)).sum() };
    picture.map(|[r, g, b, alpha]| {
        let shared = normal();
        let mut add = |value: u8| {
            let noise = sigma * (0.7 * shared + 0.7 * normal());
            (f64::from(value) + noise).round().clamp(0.0, 255.0) as u8
        };
        [add(r), add(g), add(b), alpha]
    })
}
