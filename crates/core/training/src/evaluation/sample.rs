//! Looks of a made-up detector, for tests.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

use super::{EvaluatedLook, EvaluatedMark};

pub fn mark(score: f64, right: bool) -> EvaluatedMark {
    EvaluatedMark {
        score,
        offset: [0.0, 0.0],
        right,
        rotation: 0.0,
        log_scale: 0.0,
    }
}

pub fn look(day: usize, marks: &[EvaluatedMark]) -> EvaluatedLook {
    EvaluatedLook {
        day,
        height: 100.0,
        tilt: 0.1,
        heading_error: 0.0,
        log_scale: 0.0,
        real: false,
        present: true,
        marks: marks.to_vec(),
    }
}

/// Properties of the made-up detector.
#[derive(Clone, Copy)]
pub struct SyntheticDetector {
    /// Separation of right and wrong scores, standard deviations.
    pub separation: f64,
    /// Standard deviation by which days move the scores of right marks.
    pub day: f64,
    /// Share of the looks with the landmark in which it is marked.
    pub marked: f64,
    /// Wrong marks in a look.
    pub wrong: usize,
}

impl SyntheticDetector {
    pub const USUAL: Self = Self {
        separation: 3.0,
        day: 0.5,
        marked: 0.97,
        wrong: 2,
    };

    /// `each` looks on each of `days` days; every fifth without the landmark.
    pub fn looks(&self, days: usize, each: usize, seed: u64) -> Vec<EvaluatedLook> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut looks = Vec::new();
        for day in 0..days {
            let shift = self.day * random.sample::<f64, _>(StandardNormal);
            for i in 0..each {
                let mut normal = || random.sample::<f64, _>(StandardNormal);
                let mut marks: Vec<_> = (0..self.wrong).map(|_| mark(normal(), false)).collect();
                for m in &mut marks {
                    m.offset = [20.0 * normal(), 20.0 * normal()];
                }
                let score = self.separation + shift + normal();
                let offset = [0.3 + 0.8 * normal(), -0.2 + 0.5 * normal()];
                let present = i % 5 != 4;
                if present && random.random::<f64>() < self.marked {
                    marks.push(EvaluatedMark {
                        score,
                        offset,
                        right: true,
                        rotation: 0.0,
                        log_scale: 0.0,
                    });
                }
                looks.push(EvaluatedLook {
                    day,
                    height: random.random_range(60.0..180.0),
                    tilt: random.random_range(0.0..0.4),
                    heading_error: random.random_range(-0.1..0.1),
                    log_scale: 0.0,
                    real: i % 2 == 1,
                    present,
                    marks,
                });
            }
        }
        looks
    }
}
