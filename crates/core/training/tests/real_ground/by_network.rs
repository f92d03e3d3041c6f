//! Points told by the features of the cell below them, and networks that learned otherwise than the program's.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::patches::PatchSite;
use crate::three_classes::{THREE, ThreeClasses};
use pilotage_raster::raster::Raster;
use pilotage_training::ground_classes::{
    ClassExamples, ClassTraining, GeneratedTiles, LabelledTile,
};
use pilotage_training::road::{RoadExample, RoadTruth, changed};
use pilotage_vision::ground_class::{
    CELL_PIXELS, CoverFeatures, CoverNetwork, FEATURES, GroundCover,
};

/// Generated countries, and tiles of each.
const COUNTRIES: u64 = 12;
const TILES: usize = 8;
/// Rounds of the training.
const ROUNDS: usize = 12;
/// Cells to each side of a point that are taken as it is, and how often each is learned beside generated ground.
const AROUND: isize = 1;
const REPEATED: usize = 12;

/// Features of the cell at so many cells to the right and below a point.
fn features_at(
    features: &CoverFeatures,
    [x, y]: [f64; 2],
    (right, down): (isize, isize),
) -> Option<[f32; FEATURES]> {
    let cell = |pixels: f64, step: isize| {
        ((pixels / CELL_PIXELS as f64) as usize).checked_add_signed(step)
    };
    let (column, row) = (cell(x, right)?, cell(y, down)?);
    let is_seen = column < features.width()
        && row < features.height()
        && features.seen()[row * features.width() + column];
    is_seen.then(|| features.cell(column, row))
}

/// The points of a place as the network tells them.
pub fn told(site: &PatchSite, network: &CoverNetwork) -> ThreeClasses {
    let features = CoverFeatures::of(&site.picture);
    let mut counts = ThreeClasses::default();
    for patch in &site.patches {
        let Some(own) = features_at(&features, patch.pixel, (0, 0)) else {
            continue;
        };
        let told = network.probabilities(&own);
        let odds = THREE.map(|class| f64::from(told[class.index()]));
        counts.add(patch.cover, odds);
    }
    counts
}

/// Examples of generated ground, as it is and in so many other colours, sharpnesses and noises.
pub fn generated(others: usize) -> ClassExamples {
    let mut examples = ClassExamples::drawn_by(1);
    let mut random = ChaCha8Rng::seed_from_u64(5);
    for number in 0..COUNTRIES {
        for tile in GeneratedTiles::of(4000 + number, 4000 + number).take(TILES) {
            examples.add(&tile);
            let truth = tile.picture.map(|_| RoadTruth::Unknown);
            let as_it_is = RoadExample {
                picture: tile.picture,
                truth,
            };
            for _ in 0..others {
                let picture: Raster<_> = changed(&as_it_is, &mut random).picture;
                examples.add(&LabelledTile {
                    picture,
                    covers: tile.covers.clone(),
                });
            }
        }
    }
    // As often as they are learned: nobody knows how often they are on real ground.
    for cover in GroundCover::ALL {
        let count = examples.covers.iter().filter(|own| **own == cover).count();
        examples.on_the_ground[cover.index()] = count as u64;
    }
    examples
}

/// Adds the points of a place.
pub fn add(examples: &mut ClassExamples, site: &PatchSite) {
    let features = CoverFeatures::of(&site.picture);
    for patch in &site.patches {
        for right in -AROUND..=AROUND {
            for down in -AROUND..=AROUND {
                let Some(own) = features_at(&features, patch.pixel, (right, down)) else {
                    continue;
                };
                for _ in 0..REPEATED {
                    examples.features.push(own);
                    examples.covers.push(patch.cover);
                    examples.on_the_ground[patch.cover.index()] += 1;
                }
            }
        }
    }
}

pub fn trained(examples: &ClassExamples) -> CoverNetwork {
    let training = ClassTraining {
        rounds: ROUNDS,
        ..ClassTraining::default()
    };
    training.train(examples, &mut |_, _| ()).unwrap()
}
