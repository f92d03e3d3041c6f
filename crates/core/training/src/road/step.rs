//! Steps down the gradient.

use pilotage_vision::road::network::{NETWORK_STEPS, NetworkStep, RoadNetwork};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Weights to begin with, drawn by `seed`: zero mean, 2 / inputs as variance (He et al. 2015), less where a step is
/// added to what was kept.
pub fn first_weights(seed: u64) -> Vec<f32> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut weights = Vec::new();
    for step in NETWORK_STEPS {
        let (inputs, offsets, scale) = match step {
            NetworkStep::Matrix {
                inputs,
                outputs,
                cut,
            } => (inputs, outputs, if cut { 1.0 } else { 0.4 }),
            NetworkStep::Depthwise { channels, .. } => (9, channels, 1.0),
            _ => continue,
        };
        let deviation = scale * (2.0 / inputs as f32).sqrt();
        weights.extend((0..step.weights() - offsets).map(|_| {
            let drawn: f32 = StandardNormal.sample(&mut random);
            deviation * drawn
        }));
        weights.extend(std::iter::repeat_n(0.0, offsets));
    }
    weights
}

/// Adam's steps (Kingma and Ba 2015).
#[derive(Clone, Debug)]
pub struct GradientSteps {
    weights: Vec<f32>,
    mean: Vec<f32>,
    square: Vec<f32>,
    count: i32,
}

impl GradientSteps {
    /// Shares of the past in the means of slopes and of their squares.
    const PAST: [f32; 2] = [0.9, 0.999];

    /// Steps that begin at these weights.
    pub fn new(weights: Vec<f32>) -> Self {
        let zeros = vec![0.0; weights.len()];
        Self {
            weights,
            mean: zeros.clone(),
            square: zeros,
            count: 0,
        }
    }

    /// The network as it is after the last step; `None` if the weights are not those of one.
    pub fn network(&self) -> Option<RoadNetwork> {
        RoadNetwork::new(self.weights.clone())
    }

    /// Steps once against the gradient, `rate` per weight where slopes agree, each weight drawn to zero by `decay` of it.
    pub fn step(&mut self, gradient: &[f32], rate: f32, decay: f32) {
        self.count += 1;
        let [past, past_square] = Self::PAST;
        let so_far = 1.0 - past.powi(self.count);
        let so_far_square = 1.0 - past_square.powi(self.count);
        for (i, slope) in gradient.iter().enumerate() {
            self.mean[i] += (1.0 - past) * (slope - self.mean[i]);
            self.square[i] += (1.0 - past_square) * (slope * slope - self.square[i]);
            let spread = (self.square[i] / so_far_square).sqrt() + 1e-8;
            let weight = &mut self.weights[i];
            *weight -= rate * (self.mean[i] / so_far / spread + decay * *weight);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{RoadExample, RoadTruth, loss_gradient};
    use super::*;
    use pilotage_raster::raster::Raster;

    /// A pale road on dark ground is learned from one picture in some steps.
    #[test]
    fn steps_lead_down() {
        let is_road = |x: usize| (12..22).contains(&x);
        let example = RoadExample {
            picture: Raster::from_fn(48, 24, |x, y| {
                let noise = ((x * 37 + y * 91) % 23) as u8;
                let value = if is_road(x) { 140 } else { 80 };
                [value + noise, value + noise, value, 255]
            }),
            truth: Raster::from_fn(48, 24, |x, _| {
                if is_road(x) {
                    RoadTruth::Road
                } else {
                    RoadTruth::Open
                }
            }),
        };
        let mut steps = GradientSteps::new(first_weights(1));
        let loss = |steps: &GradientSteps| loss_gradient(&steps.network().unwrap(), &example);
        let before = loss(&steps).loss;
        for _ in 0..60 {
            let gradient = loss(&steps).weights;
            steps.step(&gradient, 0.003, 0.0);
        }
        let after = loss(&steps).loss;
        assert!(after < 0.1 && after < 0.3 * before, "{before} {after}");
    }
}
