//! Words: the middles of clusters of descriptors (k-means, Lloyd 1982).

use rand::seq::IndexedRandom;
use rand_chacha::ChaCha8Rng;

use super::descriptors::{DESCRIPTOR, WordDescriptor};

/// Words, by which descriptors are named.
#[derive(Clone, Debug, PartialEq)]
pub struct Vocabulary {
    /// Middles of the clusters.
    pub words: Vec<WordDescriptor>,
}

impl Vocabulary {
    /// At most `count` words of `descriptors`, in `rounds` rounds from drawn ones.
    pub fn of(
        descriptors: &[WordDescriptor],
        count: usize,
        rounds: usize,
        random: &mut ChaCha8Rng,
    ) -> Self {
        let drawn = descriptors.sample(random, count);
        let mut vocabulary = Self {
            words: drawn.copied().collect(),
        };
        for _ in 0..rounds {
            vocabulary = vocabulary.moved(descriptors);
        }
        vocabulary
    }

    /// Each word in the middle of the descriptors that it is nearest to; a word of none stays.
    fn moved(&self, descriptors: &[WordDescriptor]) -> Self {
        let mut sums = vec![([0.0_f64; DESCRIPTOR], 0_usize); self.words.len()];
        let halves = self.halves();
        for descriptor in descriptors {
            let (sum, count) = &mut sums[self.nearest(descriptor, &halves)];
            *count += 1;
            for (sum, value) in sum.iter_mut().zip(descriptor) {
                *sum += f64::from(*value);
            }
        }
        let moved = self.words.iter().zip(&sums).map(|(word, (sum, count))| {
            if *count == 0 {
                *word
            } else {
                sum.map(|sum| (sum / *count as f64) as f32)
            }
        });
        Self {
            words: moved.collect(),
        }
    }

    /// Histogram of the words of a window: the roots of their shares, so that the distance of two is Hellinger's.
    pub fn histogram(&self, descriptors: &[WordDescriptor]) -> Vec<f32> {
        let halves = self.halves();
        let mut counts = vec![0.0_f32; self.words.len()];
        for descriptor in descriptors {
            counts[self.nearest(descriptor, &halves)] += 1.0;
        }
        let share = 1.0 / descriptors.len().max(1) as f32;
        counts.iter().map(|count| (count * share).sqrt()).collect()
    }

    /// Half the squared length of each word.
    fn halves(&self) -> Vec<f32> {
        let half = |word: &WordDescriptor| 0.5 * dot(word, word);
        self.words.iter().map(half).collect()
    }

    /// The nearest word: that of the largest product less half its squared length.
    fn nearest(&self, descriptor: &WordDescriptor, halves: &[f32]) -> usize {
        let (mut best, mut most) = (0, f32::NEG_INFINITY);
        for (index, (word, half)) in self.words.iter().zip(halves).enumerate() {
            let score = dot(word, descriptor) - half;
            if score > most {
                (best, most) = (index, score);
            }
        }
        best
    }
}

fn dot(a: &WordDescriptor, b: &WordDescriptor) -> f32 {
    let mut sums = [0.0_f32; 8];
    let (a, _) = a.as_chunks::<8>();
    let (b, _) = b.as_chunks::<8>();
    for (a, b) in a.iter().zip(b) {
        for k in 0..8 {
            sums[k] += a[k] * b[k];
        }
    }
    sums.iter().sum()
}
