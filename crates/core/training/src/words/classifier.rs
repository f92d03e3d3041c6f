//! Classes of windows by their words.

use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;

use super::descriptors::{DESCRIPTOR, WordDescriptor, descriptors_of};
use super::machine::LinearMachine;
use super::vocabulary::Vocabulary;
use pilotage_raster::raster::Gray;

/// A window with the number of its class.
#[derive(Clone)]
pub struct WordWindow {
    /// Its descriptors.
    pub descriptors: Vec<WordDescriptor>,
    /// Number of its class, from 0.
    pub class: usize,
}

impl WordWindow {
    /// A window that shows one class.
    pub fn of(picture: &Gray, class: usize) -> Self {
        Self {
            descriptors: descriptors_of(picture),
            class,
        }
    }
}

/// Settings of the training; those of the thesis where it states them.
#[derive(Clone, Copy, Debug)]
pub struct WordTraining {
    /// Words.
    pub words: usize,
    /// Most descriptors of which words are made.
    pub descriptors: usize,
    /// Rounds of k-means.
    pub word_rounds: usize,
    /// Price of a window on the wrong side.
    pub price: f64,
    /// Rounds of the machines.
    pub rounds: usize,
    /// Draws words and orders.
    pub seed: u64,
}

impl Default for WordTraining {
    fn default() -> Self {
        Self {
            words: 500,
            descriptors: 20_000,
            word_rounds: 8,
            price: 10.0,
            rounds: 60,
            seed: 1,
        }
    }
}

/// Refusal to train, or of bytes.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum WordClassifierError {
    /// Too few windows of a class.
    #[error("there are {count} windows of {class}, which is too few; label at least {least}")]
    TooFew {
        /// Name of the class.
        class: String,
        /// Windows that there are.
        count: usize,
        /// Windows that it takes.
        least: usize,
    },
    /// Bytes that are no classifier.
    #[error("the file has no words; make it with `pilotage classes train --by words`")]
    NoWords,
}

/// Parts into which windows are cut so that probabilities are set on windows that were not learned.
const FOLDS: usize = 3;
/// Temperatures that are tried, each larger than the one before by this factor.
const WARMER: f64 = 1.15;
const TEMPERATURES: i32 = 20;

/// Vocabulary and machines, one for each class.
#[derive(Clone, Debug, PartialEq)]
pub struct WordClassifier {
    names: Vec<String>,
    vocabulary: Vocabulary,
    machines: Vec<LinearMachine>,
    temperature: f64,
}

impl WordTraining {
    /// Trains on `windows` of the classes of these names.
    ///
    /// Words are drawn from all windows; each class has a machine of its own against the others, and the exponentials
    /// of their margins over a temperature are probabilities. The temperature is that which makes the windows of each
    /// third likeliest by the machines of the other two.
    ///
    /// # Errors
    /// There are fewer than three windows of a class.
    pub fn train(
        &self,
        windows: &[WordWindow],
        names: &[String],
    ) -> Result<WordClassifier, WordClassifierError> {
        for (class, name) in names.iter().enumerate() {
            let count = windows.iter().filter(|w| w.class == class).count();
            if count < FOLDS {
                return Err(WordClassifierError::TooFew {
                    class: name.clone(),
                    count,
                    least: FOLDS,
                });
            }
        }
        let classes = names.len();
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        let mut all: Vec<WordDescriptor> = windows
            .iter()
            .flat_map(|w| &w.descriptors)
            .copied()
            .collect();
        all.shuffle(&mut random);
        all.truncate(self.descriptors);
        let vocabulary = Vocabulary::of(&all, self.words, self.word_rounds, &mut random);
        let histograms: Vec<(Vec<f32>, usize)> = windows
            .iter()
            .map(|w| (vocabulary.histogram(&w.descriptors), w.class))
            .collect();
        let mut held_out = Vec::new();
        for fold in 0..FOLDS {
            let is_of_fold = |index: usize| index % FOLDS == fold;
            let numbered = || histograms.iter().enumerate();
            let learned: Vec<_> = numbered()
                .filter(|(i, _)| !is_of_fold(*i))
                .map(|(_, h)| h)
                .collect();
            let machines = self.machines(&learned, classes, &mut random);
            let rest = numbered().filter(|(i, _)| is_of_fold(*i));
            held_out.extend(rest.map(|(_, (input, class))| (margins(&machines, input), *class)));
        }
        let likelihood = |temperature: f64| -> f64 {
            let each = held_out.iter();
            each.map(|(margins, class)| softmax(margins, temperature)[*class].max(1e-9).ln())
                .sum()
        };
        let tried = (-TEMPERATURES..TEMPERATURES).map(|k| WARMER.powi(k));
        let temperature = tried
            .max_by(|a, b| likelihood(*a).total_cmp(&likelihood(*b)))
            .unwrap_or(1.0);
        // As it is stored.
        let temperature = f64::from(temperature as f32);
        let learned: Vec<_> = histograms.iter().collect();
        Ok(WordClassifier {
            names: names.to_vec(),
            machines: self.machines(&learned, classes, &mut random),
            vocabulary,
            temperature,
        })
    }

    fn machines(
        &self,
        learned: &[&(Vec<f32>, usize)],
        classes: usize,
        random: &mut ChaCha8Rng,
    ) -> Vec<LinearMachine> {
        let inputs: Vec<Vec<f32>> = learned.iter().map(|(input, _)| input.clone()).collect();
        let of_class = |class: usize| {
            let signs: Vec<bool> = learned.iter().map(|(_, own)| *own == class).collect();
            LinearMachine::of(&inputs, &signs, self.price, self.rounds, random)
        };
        (0..classes).map(of_class).collect()
    }
}

/// First bytes of a file: the format and its version.
const MAGIC: [u8; 4] = *b"PGW1";

impl WordClassifier {
    /// Names of the classes, in the order of probabilities.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The classifier as bytes: names a line each, then the number of words and all numbers in single precision.
    pub fn to_bytes(&self) -> Vec<u8> {
        let names = self.names.join("\n");
        let mut bytes = MAGIC.to_vec();
        for number in [names.len(), self.vocabulary.words.len()] {
            bytes.extend((number as u32).to_le_bytes());
        }
        bytes.extend(names.as_bytes());
        let words = self.vocabulary.words.as_flattened().iter();
        let machines = self.machines.iter().flat_map(|machine| &machine.weights);
        let temperature = self.temperature as f32;
        let all = words.chain(machines).chain([&temperature]);
        bytes.extend(all.flat_map(|number| number.to_le_bytes()));
        bytes
    }

    /// The classifier of such bytes.
    ///
    /// # Errors
    /// The bytes are none.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, WordClassifierError> {
        Self::read(bytes).ok_or(WordClassifierError::NoWords)
    }

    fn read(bytes: &[u8]) -> Option<Self> {
        let (head, _) = bytes.strip_prefix(&MAGIC)?.split_at_checked(8)?;
        let number =
            |at: usize| u32::from_le_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]);
        let (length, count) = (number(0) as usize, number(4) as usize);
        let (names, rest) = bytes[MAGIC.len() + 8..].split_at_checked(length)?;
        let names: Vec<String> = std::str::from_utf8(names)
            .ok()?
            .lines()
            .map(str::to_owned)
            .collect();
        let all = count
            .checked_mul(DESCRIPTOR)?
            .checked_add(names.len().checked_mul(count + 1)? + 1)?;
        if rest.len() != all.checked_mul(4)? || names.is_empty() {
            return None;
        }
        let (fours, _) = rest.as_chunks::<4>();
        let numbers: Vec<f32> = fours.iter().map(|four| f32::from_le_bytes(*four)).collect();
        let (words, rest) = numbers.split_at(count * DESCRIPTOR);
        let (machines, temperature) = rest.split_at(names.len() * (count + 1));
        Some(Self {
            vocabulary: Vocabulary {
                words: words.as_chunks::<DESCRIPTOR>().0.to_vec(),
            },
            machines: machines
                .chunks_exact(count + 1)
                .map(|weights| LinearMachine {
                    weights: weights.to_vec(),
                })
                .collect(),
            names,
            temperature: f64::from(temperature[0]),
        })
    }

    /// Probabilities of the classes of a window.
    pub fn probabilities(&self, descriptors: &[WordDescriptor]) -> Vec<f64> {
        let input = self.vocabulary.histogram(descriptors);
        softmax(&margins(&self.machines, &input), self.temperature)
    }
}

fn margins(machines: &[LinearMachine], input: &[f32]) -> Vec<f64> {
    machines
        .iter()
        .map(|machine| machine.margin(input))
        .collect()
}

fn softmax(margins: &[f64], temperature: f64) -> Vec<f64> {
    let most = margins.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let grown = margins.iter().map(|m| ((m - most) / temperature).exp());
    let grown: Vec<f64> = grown.collect();
    let sum: f64 = grown.iter().sum();
    grown.iter().map(|value| value / sum).collect()
}
