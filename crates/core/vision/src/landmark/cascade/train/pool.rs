//! The features that a training chooses among.

use rand::SeedableRng;
use rand::seq::index;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::super::{Area, CascadeFeature, HaarFeature};

/// Sides of the cells of a block of gradients, pixels.
const CELLS: [i32; 7] = [3, 4, 5, 6, 8, 12, 16];
/// Components of a block: nine directions in four cells.
const COMPONENTS: u8 = 36;
/// Haar features and binary patterns that are drawn from all there are.
const DRAWN: usize = 6000;

/// Kind of features that a cascade shall look at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum FeatureKind {
    /// Histograms of oriented gradients (Dalal and Triggs 2005), those of DeAngelo 2016, chapter 3.
    #[default]
    Hog,
    /// Local binary patterns of blocks.
    Lbp,
    /// Weighted sums of upright rectangles.
    Haar,
    /// The same, and some turned by 45°.
    TiltedHaar,
}

impl FeatureKind {
    /// Every kind, the usual first.
    pub const ALL: [Self; 4] = [Self::Hog, Self::Lbp, Self::Haar, Self::TiltedHaar];

    /// Name in files and tables.
    pub fn key(self) -> &'static str {
        match self {
            Self::Hog => "hog",
            Self::Lbp => "lbp",
            Self::Haar => "haar",
            Self::TiltedHaar => "tilted-haar",
        }
    }
}

/// Features of a kind for a window of `width` × `height` pixels; where there are too many, `seed` draws.
pub fn pool(kind: FeatureKind, width: usize, height: usize, seed: u64) -> Vec<CascadeFeature> {
    let size = (width as i32, height as i32);
    match kind {
        FeatureKind::Hog => blocks(size),
        FeatureKind::Lbp => drawn(&patterns(size), seed),
        FeatureKind::Haar => drawn(&upright(size), seed),
        FeatureKind::TiltedHaar => {
            let mut all = drawn(&upright(size), seed);
            all.truncate(DRAWN / 2);
            let mut turned = drawn(&tilted(size), seed);
            turned.truncate(DRAWN / 2);
            all.extend(turned);
            all
        }
    }
}

/// [`DRAWN`] of them at most, in an order drawn by `seed`.
fn drawn(all: &[CascadeFeature], seed: u64) -> Vec<CascadeFeature> {
    let mut random = ChaCha8Rng::seed_from_u64(seed ^ 0x0fea_70e5);
    let chosen = index::sample(&mut random, all.len(), all.len().min(DRAWN));
    chosen.iter().map(|i| all[i].clone()).collect()
}

/// Places of a box of `side` in `size`, `step` apart.
fn places(
    size: (i32, i32),
    side: (i32, i32),
    step: (i32, i32),
) -> impl Iterator<Item = (i32, i32)> {
    let rows = (0..=size.1 - side.1).step_by(step.1.max(1) as usize);
    rows.flat_map(move |y| {
        let columns = (0..=size.0 - side.0).step_by(step.0.max(1) as usize);
        columns.map(move |x| (x, y))
    })
}

fn blocks(size: (i32, i32)) -> Vec<CascadeFeature> {
    let mut all = Vec::new();
    for side in CELLS {
        for (w, h) in [(side, side), (side, 2 * side), (2 * side, side)] {
            for (x, y) in places(size, (2 * w, 2 * h), (w / 2, h / 2)) {
                let cell = [x, y, w, h];
                all.extend(
                    (0..COMPONENTS).map(|component| CascadeFeature::Hog { cell, component }),
                );
            }
        }
    }
    all
}

fn patterns(size: (i32, i32)) -> Vec<CascadeFeature> {
    let mut all = Vec::new();
    for h in 1..=size.1 / 3 {
        for w in 1..=size.0 / 3 {
            let places = places(size, (3 * w, 3 * h), (1, 1));
            all.extend(places.map(|(x, y)| CascadeFeature::Lbp([x, y, w, h])));
        }
    }
    all
}

/// A whole that counts -1 and a part that counts so that both are level on even ground.
fn parts(whole: Area, inner: &[Area], tilted: bool) -> CascadeFeature {
    let size = |[_, _, w, h]: Area| f64::from(w * h);
    let weight = size(whole) / inner.iter().map(|a| size(*a)).sum::<f64>();
    let mut areas = [(whole, -1.0), ([1, 0, 1, 1], 0.0), ([1, 0, 1, 1], 0.0)];
    for (slot, area) in areas[1..].iter_mut().zip(inner) {
        *slot = (*area, weight as f32);
    }
    CascadeFeature::Haar(HaarFeature { areas, tilted })
}

/// Edges, lines, chequers and spots.
fn upright(size: (i32, i32)) -> Vec<CascadeFeature> {
    let mut all = Vec::new();
    for h in 2..=size.1 / 2 {
        for w in 2..=size.0 / 2 {
            let step = (w.min(4), h.min(4));
            let mut lay = |across: i32, down: i32, inner: &dyn Fn(i32, i32) -> Vec<Area>| {
                for (x, y) in places(size, (across * w, down * h), step) {
                    all.push(parts([x, y, across * w, down * h], &inner(x, y), false));
                }
            };
            lay(2, 1, &|x, y| vec![[x + w, y, w, h]]);
            lay(1, 2, &|x, y| vec![[x, y + h, w, h]]);
            lay(3, 1, &|x, y| vec![[x + w, y, w, h]]);
            lay(1, 3, &|x, y| vec![[x, y + h, w, h]]);
            lay(2, 2, &|x, y| vec![[x, y, w, h], [x + w, y + h, w, h]]);
            lay(3, 3, &|x, y| vec![[x + w, y + h, w, h]]);
        }
    }
    all
}

/// Edges and lines turned by 45°; a rectangle goes from its upper corner right and left downward.
fn tilted((width, height): (i32, i32)) -> Vec<CascadeFeature> {
    let mut all = Vec::new();
    for h in 2..=height / 2 {
        for w in 2..=width / 2 {
            for times in [2, 3] {
                for (x, y) in places((width, height), (1, 1), (2, 2)) {
                    let fits = |w: i32, h: i32| x - h >= 0 && x + w <= width && y + w + h <= height;
                    if fits(times * w, h) {
                        let inner = [x + w, y + w, w, h];
                        all.push(parts([x, y, times * w, h], &[inner], true));
                    }
                    if fits(w, times * h) {
                        let inner = [x - h, y + h, w, h];
                        all.push(parts([x, y, w, times * h], &[inner], true));
                    }
                }
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pool_has_many_features_that_all_lie_within_the_window() {
        for kind in FeatureKind::ALL {
            let all = pool(kind, 32, 24, 3);
            assert!(
                (2000..60_000).contains(&all.len()),
                "{kind:?}: {}",
                all.len()
            );
            assert_eq!(all, pool(kind, 32, 24, 3));
            for feature in &all {
                let ([x, y, w, h], grown) = match feature {
                    CascadeFeature::Hog { cell, component } => {
                        assert!(*component < COMPONENTS);
                        (*cell, 2)
                    }
                    CascadeFeature::Lbp(area) => (*area, 3),
                    CascadeFeature::Haar(haar) => (haar.areas[0].0, 1),
                };
                let turned = matches!(feature, CascadeFeature::Haar(h) if h.tilted);
                let inside = if turned {
                    x - h >= 0 && x + w <= 32 && y + w + h <= 24
                } else {
                    x + grown * w <= 32 && y + grown * h <= 24
                };
                assert!(inside && x >= 0 && y >= 0, "{feature:?}");
            }
        }
    }

    #[test]
    fn a_haar_feature_is_level_on_even_ground() {
        for feature in pool(FeatureKind::TiltedHaar, 24, 24, 1) {
            let CascadeFeature::Haar(haar) = feature else {
                panic!("{feature:?} in a pool of Haar features");
            };
            let sum: f32 = haar
                .areas
                .iter()
                .map(|([_, _, w, h], v)| (w * h) as f32 * v)
                .sum();
            assert!(sum.abs() < 1e-3, "{haar:?}");
        }
    }
}
