use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;
use pilotage_raster::raster::Gray;

/// Stripes, rings or noise, turned and moved.
fn window(class: usize, random: &mut ChaCha8Rng) -> Gray {
    let (turn, shift) = (
        random.random_range(0.0..std::f32::consts::TAU),
        random.random_range(0.0..20.0_f32),
    );
    let (sin, cos) = turn.sin_cos();
    Gray::from_fn(64, 64, |x, y| {
        let (x, y) = (x as f32 - 20.0, y as f32 - 40.0);
        let noise = random.random_range(-12.0..12.0_f32);
        let value = match class {
            0 => ((x * cos + y * sin + shift) * 0.5).sin(),
            1 => (x * 0.4 + shift).sin() * (y * 0.4).sin(),
            _ => 0.0,
        };
        128.0 + 40.0 * value + noise
    })
}

#[test]
fn windows_are_told_by_their_words_however_they_are_turned() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let mut draw = |count: usize| -> Vec<WordWindow> {
        let each = (0..count).map(|i| WordWindow::of(&window(i % 3, &mut random), i % 3));
        each.collect()
    };
    let (learned, others) = (draw(24), draw(24));
    let training = WordTraining {
        words: 30,
        descriptors: 2000,
        ..WordTraining::default()
    };
    let names = ["stripes", "rings", "noise", "waves"].map(str::to_owned);
    let classifier = training.train(&learned, &names[..3]).unwrap();
    let mut right = 0;
    for other in &others {
        let told = classifier.probabilities(&other.descriptors);
        assert!((told.iter().sum::<f64>() - 1.0).abs() < 1e-9);
        right += usize::from(told.iter().all(|p| *p <= told[other.class]));
    }
    assert!(right >= 22, "{right} of 24");
    assert_eq!(
        training.train(&learned, &names[..3]),
        Ok(classifier.clone())
    );
    let refused = training.train(&learned, &names).unwrap_err();
    assert!(
        refused.to_string().contains("0 windows of waves"),
        "{refused}"
    );
    let bytes = classifier.to_bytes();
    assert_eq!(WordClassifier::from_bytes(&bytes), Ok(classifier));
    for length in [0, 3, 11, 20, bytes.len() - 1] {
        assert!(WordClassifier::from_bytes(&bytes[..length]).is_err());
    }
}

#[test]
fn the_border_of_two_heaps_is_that_of_the_widest_margin() {
    // The nearest points of the two are (1, 0) and (-1, 0): w = (1, 0), no constant, margins of ±1.
    let inputs = [[1.0, 0.0], [3.0, 2.0], [-1.0, 0.0], [-2.0, -5.0]].map(|p| p.to_vec());
    let signs = [true, true, false, false];
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let machine = LinearMachine::of(&inputs, &signs, 100.0, 2000, &mut random);
    for (weight, expected) in machine.weights.iter().zip([1.0, 0.0, 0.0]) {
        assert!((weight - expected).abs() < 1e-3, "{machine:?}");
    }
    assert!((machine.margin(&[3.0, 2.0]) - 3.0).abs() < 1e-2);
}
