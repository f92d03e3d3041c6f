//! Examples of cells with their classes.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use pilotage_raster::raster::{Raster, Rgba};
use pilotage_vision::ground_class::{CoverFeatures, FEATURES, GroundCover};

/// Most cells of one class that are taken of a tile for training: neighbours tell the same.
const MOST_OF_CLASS: usize = 120;

/// A picture of the ground with the classes of its cells.
pub struct LabelledTile {
    /// Picture of which a pixel shows [`CLASS_GSD`](pilotage_vision::ground_class::CLASS_GSD) metres.
    pub picture: Raster<Rgba>,
    /// Class of each cell, row by row, where it is known.
    pub covers: Vec<Option<GroundCover>>,
}

/// Cells with their classes, and how often each class occurs on the ground.
#[derive(Clone)]
pub struct ClassExamples {
    /// Features of each cell.
    pub features: Vec<[f32; FEATURES]>,
    /// Its class.
    pub covers: Vec<GroundCover>,
    /// Number of cells of each class in all tiles, whether taken or not.
    pub on_the_ground: [u64; GroundCover::ALL.len()],
    random: ChaCha8Rng,
}

impl ClassExamples {
    /// No examples; those to be taken of a tile are drawn by `seed`.
    pub fn drawn_by(seed: u64) -> Self {
        Self {
            features: Vec::new(),
            covers: Vec::new(),
            on_the_ground: [0; GroundCover::ALL.len()],
            random: ChaCha8Rng::seed_from_u64(seed),
        }
    }

    /// Takes cells of a tile, about as many of each class.
    pub fn add(&mut self, tile: &LabelledTile) {
        let features = CoverFeatures::of(&tile.picture);
        for cover in GroundCover::ALL {
            let is_it = |at: &usize| tile.covers[*at] == Some(cover) && features.seen()[*at];
            let cells: Vec<usize> = (0..tile.covers.len()).filter(is_it).collect();
            self.on_the_ground[cover.index()] += cells.len() as u64;
            let share = MOST_OF_CLASS as f64 / cells.len().max(1) as f64;
            for at in cells {
                if self.random.random_range(0.0..1.0) < share {
                    let (column, row) = (at % features.width(), at / features.width());
                    self.features.push(features.cell(column, row));
                    self.covers.push(cover);
                }
            }
        }
    }
}
