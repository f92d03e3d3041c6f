//! The words of a bag of words and its support vector machine against scikit-learn.

use pilotage_core::training::words::{LinearMachine, Vocabulary, WordDescriptor};
use pilotage_tests::oracle::ask;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

/// Rounds of k-means: too few to settle, so that each of them counts.
const ROUNDS: usize = 4;
/// Price of an input on the wrong side.
const PRICE: f64 = 2.0;

#[derive(Serialize)]
struct Question<'a> {
    descriptors: Vec<&'a [f32]>,
    start: Vec<&'a [f32]>,
    rounds: usize,
    inputs: &'a [Vec<f32>],
    signs: &'a [bool],
    price: f64,
    asked: &'a [Vec<f32>],
}

#[derive(Deserialize)]
struct Answer {
    words: Vec<Vec<f64>>,
    margins: Vec<f64>,
    objective: f64,
}

/// Descriptors around a dozen middles, which overlap.
fn descriptors(random: &mut ChaCha8Rng) -> Vec<WordDescriptor> {
    let mut normal = || -> f32 { StandardNormal.sample(random) };
    let middles: Vec<WordDescriptor> = (0..12).map(|_| std::array::from_fn(|_| normal())).collect();
    (0..600)
        .map(|index| middles[index % 12].map(|middle| middle + 1.5 * normal()))
        .collect()
}

/// Inputs of two classes that no plane parts.
fn inputs(count: usize, random: &mut ChaCha8Rng) -> (Vec<Vec<f32>>, Vec<bool>) {
    let one = |random: &mut ChaCha8Rng| {
        let is_of_class = random.random_bool(0.3);
        let aside = if is_of_class { 0.8 } else { -0.2 };
        let input = (0..20).map(|axis| {
            let noise: f32 = StandardNormal.sample(random);
            noise + if axis < 4 { aside } else { 0.0 }
        });
        (input.collect(), is_of_class)
    };
    (0..count).map(|_| one(random)).unzip()
}

#[test]
fn words_and_margins_are_those_of_scikit_learn() {
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let descriptors = descriptors(&mut random);
    let (inputs, signs) = inputs(200, &mut random);
    let (asked, _) = self::inputs(50, &mut random);
    let drawn = || ChaCha8Rng::seed_from_u64(6);
    let start = Vocabulary::of(&descriptors, 12, 0, &mut drawn());
    let question = Question {
        descriptors: descriptors.iter().map(|it| &it[..]).collect(),
        start: start.words.iter().map(|it| &it[..]).collect(),
        rounds: ROUNDS,
        inputs: &inputs,
        signs: &signs,
        price: PRICE,
        asked: &asked,
    };
    let Some(answer) = ask::<_, Answer>("sklearn_words.py", &question) else {
        return;
    };

    let apart = |words: &[WordDescriptor]| {
        let pairs = words.iter().flatten().zip(answer.words.iter().flatten());
        pairs
            .map(|(ours, theirs)| (f64::from(*ours) - theirs).abs())
            .fold(0.0, f64::max)
    };
    let words = Vocabulary::of(&descriptors, 12, ROUNDS, &mut drawn()).words;
    assert_eq!(answer.words.len(), words.len());
    let before = Vocabulary::of(&descriptors, 12, ROUNDS - 1, &mut drawn()).words;
    println!(
        "words apart {:.1e}, a round before {:.1e}",
        apart(&words),
        apart(&before)
    );
    assert!(apart(&words) < 1e-5 && apart(&before) > 1e-3);

    let machine = LinearMachine::of(&inputs, &signs, PRICE, 3000, &mut drawn());
    let losses = inputs.iter().zip(&signs).map(|(input, is_of_class)| {
        let sign = if *is_of_class { 1.0 } else { -1.0 };
        (1.0 - sign * machine.margin(input)).max(0.0)
    });
    let square: f64 = machine.weights.iter().map(|w| f64::from(*w).powi(2)).sum();
    let objective = 0.5 * square + PRICE * losses.sum::<f64>();
    let margins = asked.iter().zip(&answer.margins);
    let margins = margins
        .map(|(input, theirs)| (machine.margin(input) - theirs).abs())
        .fold(0.0, f64::max);
    println!(
        "objective {objective:.4}, theirs {:.4}; margins apart {margins:.1e}",
        answer.objective
    );
    assert!((objective / answer.objective - 1.0).abs() < 1e-4 && margins < 1e-2);
}
