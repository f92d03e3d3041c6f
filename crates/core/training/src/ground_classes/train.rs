//! Training of the network that tells classes: stochastic gradients of the cross entropy (Adam, Kingma 2015).

use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::ClassExamples;
use pilotage_vision::ground_class::{CoverNetwork, FEATURES, GroundCover, HIDDEN};

const CLASSES: usize = GroundCover::ALL.len();
/// Examples of a step.
const BATCH: usize = 64;
/// Decay of the means of gradients and of their squares.
const DECAY: (f32, f32) = (0.9, 0.999);
/// Pull of all weights towards zero.
const SHRINK: f32 = 1e-5;

/// Training of a network.
#[derive(Clone, Copy, Debug)]
pub struct ClassTraining {
    /// Rounds over all examples.
    pub rounds: usize,
    /// Length of the first steps; it falls to nothing towards the end.
    pub rate: f32,
    /// Draws the first weights and the order of the examples.
    pub seed: u64,
}

impl Default for ClassTraining {
    fn default() -> Self {
        Self {
            rounds: 40,
            rate: 3e-3,
            seed: 1,
        }
    }
}

/// Refusal to train.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ClassTrainingError {
    /// Too few examples of a class.
    #[error("there are {count} examples of {class}, which is too few; label at least {least}")]
    TooFew {
        /// Name of the class.
        class: &'static str,
        /// Examples that there are.
        count: usize,
        /// Examples that it takes.
        least: usize,
    },
}

/// Examples of a class without which it is not learned.
const LEAST: usize = 50;

impl ClassTraining {
    /// Trains a network; `tell` hears the round and the mean cross entropy of each round.
    ///
    /// Classes are about equally frequent in the examples; at the end their odds are set to those on the ground, so
    /// that probabilities are true there.
    ///
    /// # Errors
    /// A class that some examples have has too few of them.
    pub fn train(
        &self,
        examples: &ClassExamples,
        tell: &mut dyn FnMut(usize, f64),
    ) -> Result<CoverNetwork, ClassTrainingError> {
        let taken = GroundCover::ALL.map(|c| examples.covers.iter().filter(|e| **e == c).count());
        for cover in GroundCover::ALL {
            let count = taken[cover.index()];
            if count > 0 && count < LEAST {
                return Err(ClassTrainingError::TooFew {
                    class: cover.key(),
                    count,
                    least: LEAST,
                });
            }
        }
        let scale = Standardization::of(&examples.features);
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        let mut learner = Learner::new(&mut random);
        let mut order: Vec<usize> = (0..examples.covers.len()).collect();
        let steps = self.rounds * order.len().div_ceil(BATCH);
        let mut step = 0;
        for round in 0..self.rounds {
            order.shuffle(&mut random);
            let mut sum = 0.0;
            for batch in order.chunks(BATCH) {
                for index in batch {
                    let input = scale.apply(&examples.features[*index]);
                    sum += f64::from(learner.learn(&input, examples.covers[*index]));
                }
                let left = 1.0 - step as f32 / steps as f32;
                step += 1;
                learner.step(self.rate * left, batch.len(), step);
            }
            tell(round, sum / order.len().max(1) as f64);
        }
        let mut network = scale.folded(&learner.network);
        let all: u64 = examples.on_the_ground.iter().sum();
        for (class, output) in network.output.iter_mut().enumerate() {
            let here = taken[class].max(1) as f64 / examples.covers.len().max(1) as f64;
            let there = examples.on_the_ground[class].max(1) as f64 / all.max(1) as f64;
            output[HIDDEN] += (there / here).ln() as f32;
        }
        Ok(network)
    }
}

/// Mean and spread of each feature.
struct Standardization {
    mean: [f32; FEATURES],
    spread: [f32; FEATURES],
}

impl Standardization {
    fn of(features: &[[f32; FEATURES]]) -> Self {
        let count = features.len().max(1) as f64;
        let mean: [f64; FEATURES] =
            std::array::from_fn(|k| features.iter().map(|f| f64::from(f[k])).sum::<f64>() / count);
        let spread = std::array::from_fn(|k| {
            let squares = features.iter().map(|f| (f64::from(f[k]) - mean[k]).powi(2));
            ((squares.sum::<f64>() / count).sqrt() as f32).max(1e-4)
        });
        Self {
            mean: mean.map(|m| m as f32),
            spread,
        }
    }

    fn apply(&self, features: &[f32; FEATURES]) -> [f32; FEATURES] {
        std::array::from_fn(|k| (features[k] - self.mean[k]) / self.spread[k])
    }

    /// The same network for features as they are.
    fn folded(&self, network: &CoverNetwork) -> CoverNetwork {
        let mut folded = network.clone();
        for unit in &mut folded.hidden {
            for k in 0..FEATURES {
                unit[k] /= self.spread[k];
                unit[FEATURES] -= unit[k] * self.mean[k];
            }
        }
        folded
    }
}

/// A network with the gradients of its weights and their means.
struct Learner {
    network: CoverNetwork,
    gradient: CoverNetwork,
    first: CoverNetwork,
    second: CoverNetwork,
}

impl Learner {
    fn new(random: &mut ChaCha8Rng) -> Self {
        let zero = CoverNetwork {
            hidden: [[0.0; FEATURES + 1]; HIDDEN],
            output: [[0.0; HIDDEN + 1]; CLASSES],
        };
        let mut network = zero.clone();
        let mut draw = |inputs: usize| {
            let reach = (6.0 / inputs as f32).sqrt();
            random.random_range(-reach..reach)
        };
        for unit in &mut network.hidden {
            unit[..FEATURES].fill_with(|| draw(FEATURES));
        }
        for class in &mut network.output {
            class[..HIDDEN].fill_with(|| draw(2 * HIDDEN));
        }
        Self {
            network,
            gradient: zero.clone(),
            first: zero.clone(),
            second: zero,
        }
    }

    /// Adds the gradient of an example; gives its cross entropy.
    fn learn(&mut self, input: &[f32; FEATURES], cover: GroundCover) -> f32 {
        let mut hidden = [0.0_f32; HIDDEN];
        for (value, weights) in hidden.iter_mut().zip(&self.network.hidden) {
            let sum: f32 = input.iter().zip(weights).map(|(x, w)| x * w).sum();
            *value = (sum + weights[FEATURES]).max(0.0);
        }
        let told = self.network.output.map(|weights| {
            hidden.iter().zip(&weights).map(|(x, w)| x * w).sum::<f32>() + weights[HIDDEN]
        });
        let most = told.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        let grown = told.map(|score| (score - most).exp());
        let sum: f32 = grown.iter().sum();
        let mut back = [0.0_f32; HIDDEN];
        let classes = self.gradient.output.iter_mut().zip(&self.network.output);
        for (class, (gradient, weights)) in classes.enumerate() {
            let error = grown[class] / sum - f32::from(u8::from(class == cover.index()));
            for unit in 0..HIDDEN {
                gradient[unit] += error * hidden[unit];
                back[unit] += error * weights[unit];
            }
            gradient[HIDDEN] += error;
        }
        for (unit, gradient) in self.gradient.hidden.iter_mut().enumerate() {
            if hidden[unit] > 0.0 {
                for (gradient, x) in gradient.iter_mut().zip(input) {
                    *gradient += back[unit] * x;
                }
                gradient[FEATURES] += back[unit];
            }
        }
        sum.ln() + most - told[cover.index()]
    }

    /// Moves the weights by the gradients of `count` examples, which begin anew; `number` counts the steps from 1.
    fn step(&mut self, rate: f32, count: usize, number: usize) {
        let settled = |decay: f32| 1.0 - decay.powi(number.min(100_000) as i32);
        let (first_share, second_share) = (settled(DECAY.0), settled(DECAY.1));
        let update =
            |weights: &mut [f32], gradients: &mut [f32], first: &mut [f32], second: &mut [f32]| {
                for k in 0..weights.len() {
                    let gradient = gradients[k] / count as f32 + SHRINK * weights[k];
                    first[k] = DECAY.0 * first[k] + (1.0 - DECAY.0) * gradient;
                    second[k] = DECAY.1 * second[k] + (1.0 - DECAY.1) * gradient * gradient;
                    let spread = (second[k] / second_share).sqrt() + 1e-8;
                    weights[k] -= rate * first[k] / first_share / spread;
                    gradients[k] = 0.0;
                }
            };
        update(
            self.network.hidden.as_flattened_mut(),
            self.gradient.hidden.as_flattened_mut(),
            self.first.hidden.as_flattened_mut(),
            self.second.hidden.as_flattened_mut(),
        );
        update(
            self.network.output.as_flattened_mut(),
            self.gradient.output.as_flattened_mut(),
            self.first.output.as_flattened_mut(),
            self.second.output.as_flattened_mut(),
        );
    }
}
