//! Points told by the words of the window around them.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::patches::{FINE_GSD, PatchSite, WINDOW};
use crate::three_classes::{THREE, ThreeClasses};
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_simulate::other_days::any_day;
use pilotage_simulate::simulate::scenery::Scenery;
use pilotage_training::ground_classes::generated_tile;
use pilotage_training::words::{WordClassifier, WordTraining, WordWindow};
use pilotage_vision::ground_class::{CELL_PIXELS, CLASS_GSD};

/// Pixels along a side of a tile whose cells are labelled; windows of a class that are taken of it; tiles.
const TILE: usize = 320;
const OF_TILE: usize = 6;
const TILES: u64 = 100;
/// Cells to each side of the middle of a window that are of its class.
const AROUND: usize = 5;

fn class_of(cover: pilotage_vision::ground_class::GroundCover) -> Option<usize> {
    THREE.iter().position(|class| *class == cover)
}

/// Windows of generated countries.
pub fn generated() -> Vec<WordWindow> {
    let mut windows = Vec::new();
    for number in 0..TILES {
        let mut random = ChaCha8Rng::seed_from_u64(number);
        let scenery = Scenery::new(3000 + number / 2, any_day(3000 + number));
        let bounds = scenery.bounds();
        let mut along = |size: f64| random.random_range(-0.35 * size..0.35 * size);
        let middle = bounds.center();
        let middle = GroundPoint::new(
            middle.north + along(bounds.height()),
            middle.east + along(bounds.width()),
        );
        let tile = generated_tile(&scenery, middle, TILE);
        let metres = TILE as f64 * CLASS_GSD;
        let grid = Window::covering(&GroundRect::centered(middle, metres, metres), CLASS_GSD);
        let side = grid.width / CELL_PIXELS;
        for (class, cover) in THREE.into_iter().enumerate() {
            let (mut taken, mut tried) = (0, 0);
            while taken < OF_TILE && tried < 4000 {
                tried += 1;
                let inside = AROUND..side - AROUND;
                let (column, row) = (
                    random.random_range(inside.clone()),
                    random.random_range(inside),
                );
                // A roof is seldom wider than half a window.
                let reach = if class == 0 { 2 } else { AROUND };
                let is_it = (row - reach..=row + reach).all(|r| {
                    let cells = &tile.covers[r * side..][column - reach..=column + reach];
                    cells.iter().all(|own| *own == Some(cover))
                });
                if is_it {
                    let cells = CELL_PIXELS as f64;
                    let place =
                        grid.ground_at((column as f64 + 0.5) * cells, (row as f64 + 0.5) * cells);
                    let side = WINDOW as f64 * FINE_GSD;
                    let rect = GroundRect::centered(place, side, side);
                    let picture = scenery.window(&Window::covering(&rect, FINE_GSD));
                    windows.push(WordWindow::of(&picture.to_gray(), class));
                    taken += 1;
                }
            }
        }
    }
    windows
}

/// Windows of a place with their classes.
pub fn of_site(site: &PatchSite) -> Vec<WordWindow> {
    let windows = site.patches.iter().filter_map(|patch| {
        let class = class_of(patch.cover)?;
        Some(WordWindow::of(&site.window(patch), class))
    });
    windows.collect()
}

/// A classifier of the three classes.
pub fn trained(windows: &[WordWindow]) -> WordClassifier {
    let names = THREE.map(|class| class.key().to_owned());
    WordTraining::default().train(windows, &names).unwrap()
}

/// Windows of a place as they are told.
pub fn told(windows: &[WordWindow], classifier: &WordClassifier) -> ThreeClasses {
    let mut counts = ThreeClasses::default();
    for window in windows {
        let odds = classifier.probabilities(&window.descriptors);
        counts.add(THREE[window.class], [odds[0], odds[1], odds[2]]);
    }
    counts
}
