//! Linear support vector machine of two classes by descent along the coordinates of its dual (Hsieh et al. 2008).

use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;

/// Weights of a linear machine.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearMachine {
    /// Weight of each input, and that of a constant one at the end.
    pub weights: Vec<f32>,
}

impl LinearMachine {
    /// The machine of least ½|w|² + `price` · Σ max(0, 1 - y w·x), which is found but for the rest that `rounds` rounds leave;
    /// `signs` are whether each of `inputs` is of the class.
    pub fn of(
        inputs: &[Vec<f32>],
        signs: &[bool],
        price: f64,
        rounds: usize,
        random: &mut ChaCha8Rng,
    ) -> Self {
        let size = inputs.first().map_or(0, Vec::len);
        let mut weights = vec![0.0_f64; size + 1];
        let mut prices = vec![0.0_f64; inputs.len()];
        let squares = inputs.iter().map(|input| {
            let square: f64 = input.iter().map(|x| f64::from(*x).powi(2)).sum();
            square + 1.0
        });
        let squares: Vec<f64> = squares.collect();
        let mut order: Vec<usize> = (0..inputs.len()).collect();
        for _ in 0..rounds {
            order.shuffle(random);
            for &index in &order {
                let sign = if signs[index] { 1.0 } else { -1.0 };
                let with_constant = inputs[index].iter().copied().chain([1.0]);
                let told: f64 = with_constant
                    .clone()
                    .zip(&weights)
                    .map(|(x, w)| f64::from(x) * w)
                    .sum();
                let before = prices[index];
                let step = (sign * told - 1.0) / squares[index];
                prices[index] = (before - step).clamp(0.0, price);
                let moved = sign * (prices[index] - before);
                for (weight, x) in weights.iter_mut().zip(with_constant) {
                    *weight += moved * f64::from(x);
                }
            }
        }
        Self {
            weights: weights.iter().map(|w| *w as f32).collect(),
        }
    }

    /// Side of the border on which an input lies, in margins: positive on that of the class.
    pub fn margin(&self, input: &[f32]) -> f64 {
        let with_constant = input.iter().copied().chain([1.0]);
        let products = with_constant.zip(&self.weights);
        products.map(|(x, w)| f64::from(x * w)).sum()
    }
}
