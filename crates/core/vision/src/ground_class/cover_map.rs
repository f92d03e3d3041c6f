//! Probabilities of classes over a piece of ground.

use super::network::TOGETHER;
use super::{CELL_PIXELS, CoverFeatures, CoverNetwork, FEATURES, GroundCover};
use pilotage_raster::imagery::Window;
use pilotage_raster::raster::{Gray, Raster, Rgba};

/// Probabilities of classes on a grid of cells.
#[derive(Clone, Debug)]
pub struct CoverMap {
    /// The grid: a pixel of the window is a cell.
    pub window: Window,
    /// Probabilities of the classes in the order of [`GroundCover::ALL`], row by row; all zero where nothing was seen.
    pub probabilities: Vec<[f32; GroundCover::ALL.len()]>,
    /// Whether each cell was seen.
    pub seen: Vec<bool>,
}

impl CoverMap {
    /// Probability of one class.
    pub fn of(&self, cover: GroundCover) -> Gray {
        let (width, height) = (self.window.width, self.window.height);
        Gray::from_fn(width, height, |column, row| {
            self.probabilities[row * width + column][cover.index()]
        })
    }
}

/// Classes of the ground in `picture`, which shows `window`, north up, at [`CLASS_GSD`](super::CLASS_GSD) metres per pixel or nearly;
/// clear pixels were not seen.
pub fn classify_ground(
    window: &Window,
    picture: &Raster<Rgba>,
    network: &CoverNetwork,
) -> CoverMap {
    let features = CoverFeatures::of(picture);
    let (width, height) = (features.width(), features.height());
    let mut probabilities = vec![[0.0; GroundCover::ALL.len()]; width * height];
    for (row, out) in probabilities.chunks_exact_mut(width.max(1)).enumerate() {
        let seen = &features.seen()[row * width..][..width];
        for (group, out) in out.chunks_mut(TOGETHER).enumerate() {
            let first = group * TOGETHER;
            let seen = &seen[first..][..out.len()];
            if seen.iter().all(|seen| !seen) {
                continue;
            }
            let mut together = [[0.0; TOGETHER]; FEATURES];
            for k in 0..out.len() {
                let own = features.cell(first + k, row);
                for (all, value) in together.iter_mut().zip(own) {
                    all[k] = value;
                }
            }
            let told = network.several(&together);
            for ((out, told), seen) in out.iter_mut().zip(told).zip(seen) {
                if *seen {
                    *out = told;
                }
            }
        }
    }
    CoverMap {
        window: Window {
            gsd: window.gsd * CELL_PIXELS as f64,
            width,
            height,
            ..*window
        },
        probabilities,
        seen: features.seen().to_vec(),
    }
}
