//! Noise that moves an aircraft besides its airspeed and a steady wind, by what a fit leaves of its velocity.

use nalgebra::{SMatrix, SVector, Vector2};
use serde::{Deserialize, Serialize};

use super::tuning::likeliest;

/// Length of the means that the noise is found from, seconds: what is shorter moves nobody far, is more of how receivers
/// smooth and airspeeds shake than of the air, and would say by its number what the slow changes are like.
const MEAN: f64 = 4.0;
/// Evaluations of the likelihood in the search for the likeliest noise.
const EVALUATIONS: usize = 70;
/// Least and greatest walk of a wind, m/s/√s: one that hardly changes, and one that is another in a minute. Steps of the
/// integral over them.
const WALKS: (f64, f64) = (0.001, 0.5);
const STEPS: usize = 12;
/// The same of gusts and their memories, times the likeliest.
const GUSTS: [f64; 6] = [0.6, 0.8, 1.0, 1.3, 1.7, 2.2];
const MEMORIES: [f64; 6] = [0.4, 0.65, 1.0, 1.6, 2.5, 4.0];

/// Noise that moves an aircraft besides its airspeed and a steady wind; per axis.
///
/// The velocity that a fit leaves is w(t) + g(t) + n(t): a wind that walks, gusts that remember themselves with
/// covariance σ² exp(-|Δt| / τ), and noise that is new each time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrackNoise {
    /// Standard deviation of what is new every time, m/s.
    pub white: f64,
    /// Standard deviation σ of the gusts, m/s.
    pub gust: f64,
    /// Correlation time τ of the gusts, seconds.
    pub memory: f64,
    /// Random walk of the wind, m/s/√s.
    pub walk: f64,
}

/// Prior of the noise before a flight tells it: medians, and standard deviations of the logarithms.
///
/// Gusts between those of calm air and of strong turbulence (MIL-F-8785C: 0.5 to 3 m/s near the ground), remembered
/// for as long as an aircraft takes to fly through tens to hundreds of metres; a wind that changes by 0.1 m/s
/// in a minute, as over the flights of the X-8, or by tens of times less or more: of that nearly nothing is known.
const EXPECTED: (TrackNoise, [f64; 4]) = (
    TrackNoise {
        white: 0.3,
        gust: 1.0,
        memory: 6.0,
        walk: 0.015,
    },
    [1.0, 0.8, 0.8, 2.0],
);

impl Default for TrackNoise {
    fn default() -> Self {
        EXPECTED.0
    }
}

/// Residual velocity of a fit over a while, with its dependence on the unknowns of the fit.
#[derive(Clone, Copy)]
pub(super) struct Left<const K: usize> {
    /// Middle of the while, seconds.
    pub(super) time: f64,
    /// Velocity that is left, m/s.
    pub(super) velocity: Vector2<f64>,
    /// Its change with each unknown.
    pub(super) design: [Vector2<f64>; K],
}

/// Means over whiles that are long enough to say what moves an aircraft for long.
pub(super) fn means<const K: usize>(all: impl Iterator<Item = Left<K>>) -> Vec<Left<K>> {
    means_over(MEAN, all)
}

/// Means over whiles of `length` seconds.
pub(super) fn means_over<const K: usize>(
    length: f64,
    all: impl Iterator<Item = Left<K>>,
) -> Vec<Left<K>> {
    let mut means: Vec<(f64, f64, Left<K>)> = Vec::new();
    for left in all {
        match means.last_mut() {
            Some((begin, count, sum)) if left.time - *begin < length => {
                *count += 1.0;
                sum.time += left.time;
                sum.velocity += left.velocity;
                for (sum, design) in sum.design.iter_mut().zip(&left.design) {
                    *sum += design;
                }
            }
            _ => means.push((left.time, 1.0, left)),
        }
    }
    let mean = |(_, count, sum): (f64, f64, Left<K>)| Left {
        time: sum.time / count,
        velocity: sum.velocity / count,
        design: sum.design.map(|d| d / count),
    };
    means.into_iter().map(mean).collect()
}

/// Gains of the filter that tells wind and gusts apart, the same for both axes; Kalman 1960.
struct Separation {
    noise: TrackNoise,
    /// Variances of wind and gust and their covariance, (m/s)².
    wind: f64,
    both: f64,
    gust: f64,
}

/// By what a filter makes a wind of samples.
pub(super) struct SampleWeights {
    /// Weight of each sample in the wind at the last of them.
    pub(super) of_wind: Vec<f64>,
    /// Variance of the gust then per axis, (m/s)².
    pub(super) gust_variance: f64,
}

/// Step of the separation.
struct SeparationStep {
    persistence: f64,
    gains: (f64, f64),
    variance: f64,
}

impl Separation {
    fn new(noise: &TrackNoise, wind_deviation: f64) -> Self {
        Self {
            noise: *noise,
            wind: wind_deviation * wind_deviation,
            both: 0.0,
            gust: noise.gust * noise.gust,
        }
    }

    fn after(&mut self, dt: f64) -> SeparationStep {
        let noise = &self.noise;
        let persistence = (-dt / noise.memory).exp();
        self.wind += noise.walk * noise.walk * dt;
        self.both *= persistence;
        let fresh = noise.gust * noise.gust * (1.0 - persistence * persistence);
        self.gust = self.gust * persistence * persistence + fresh;
        let (of_wind, of_gust) = (self.wind + self.both, self.both + self.gust);
        let variance = of_wind + of_gust + noise.white * noise.white;
        let gains = (of_wind / variance, of_gust / variance);
        self.wind -= gains.0 * of_wind;
        self.both -= gains.0 * of_gust;
        self.gust -= gains.1 * of_gust;
        SeparationStep {
            persistence,
            gains,
            variance,
        }
    }
}

/// Wind and gust that a filter makes of a series of vectors.
#[derive(Clone, Copy, Default)]
struct WindAndGust {
    wind: Vector2<f64>,
    gust: Vector2<f64>,
}

impl WindAndGust {
    /// Innovation of a measurement.
    fn innovation(&mut self, step: &SeparationStep, measured: Vector2<f64>) -> Vector2<f64> {
        self.gust *= step.persistence;
        let new = measured - self.wind - self.gust;
        self.wind += new * step.gains.0;
        self.gust += new * step.gains.1;
        new
    }
}

impl TrackNoise {
    fn of(numbers: &[f64]) -> Self {
        Self {
            white: numbers[0],
            gust: numbers[1],
            memory: numbers[2],
            walk: numbers[3],
        }
    }

    fn numbers(&self) -> [f64; 4] {
        [self.white, self.gust, self.memory, self.walk]
    }

    /// Logarithm of what is expected of it beforehand, but for a constant.
    fn log_prior(&self) -> f64 {
        let (expected, spread) = (EXPECTED.0.numbers(), EXPECTED.1);
        let terms = self.numbers().into_iter().zip(expected).zip(spread);
        terms
            .map(|((own, expected), spread)| -0.5 * ((own / expected).ln() / spread).powi(2))
            .sum()
    }

    /// Logarithm of the likelihood of what a fit leaves, but for a constant, with the unknowns of the fit as uncertain
    /// as these samples leave them (Harville 1974): what was fitted looks smaller than it was. `prior` has the
    /// standard deviations of the unknowns, `wind_deviation` that of the wind at the beginning (m/s).
    fn log_likelihood<const K: usize>(
        &self,
        left: &[Left<K>],
        prior: &[f64; K],
        wind_deviation: f64,
    ) -> f64 {
        let mut separation = Separation::new(self, wind_deviation);
        let (mut velocity, mut designs) = (WindAndGust::default(), [WindAndGust::default(); K]);
        let mut information = SMatrix::<f64, K, K>::zeros();
        for (index, deviation) in prior.iter().enumerate() {
            information[(index, index)] = 1.0 / (deviation * deviation);
        }
        let mut sum = 0.0;
        let mut last = left.first().map_or(0.0, |l| l.time);
        for left in left {
            let step = separation.after(left.time - last);
            last = left.time;
            let new = velocity.innovation(&step, left.velocity);
            sum -= 0.5 * new.norm_squared() / step.variance + step.variance.ln();
            let mut rows = [SVector::<f64, K>::zeros(); 2];
            for (index, design) in designs.iter_mut().enumerate() {
                let new = design.innovation(&step, left.design[index]);
                (rows[0][index], rows[1][index]) = (new.x, new.y);
            }
            for row in &rows {
                information.ger(1.0 / step.variance, row, row, 1.0);
            }
        }
        let root = information.cholesky();
        let uncertain = root.map_or(f64::INFINITY, |root| {
            root.l().diagonal().iter().map(|d| d.ln()).sum::<f64>()
        });
        sum - uncertain
    }

    /// The noise that makes what a fit leaves likeliest, beginning from this.
    pub(super) fn likeliest<const K: usize>(
        &self,
        left: &[Left<K>],
        prior: &[f64; K],
        wind_deviation: f64,
    ) -> Self {
        let (numbers, _) = likeliest(&self.numbers(), EVALUATIONS, |numbers| {
            let noise = Self::of(numbers);
            noise.log_likelihood(left, prior, wind_deviation) + noise.log_prior()
        });
        Self::of(&numbers)
    }

    /// Noise as far as it is known, begun from the likeliest: the likeliest gusts with the median of the
    /// wind's walks, and the mean over all gusts and walks that the samples leave possible.
    ///
    /// A few minutes hardly say how long gusts last and how the wind changes in a minute, and what is likeliest is too
    /// little of both. The power of gusts and the mean square of the walk are what the covariance of a prediction grows
    /// with; to follow the wind a filter does best to take the likelier.
    pub(super) fn known<const K: usize>(
        &self,
        left: &[Left<K>],
        prior: &[f64; K],
        wind_deviation: f64,
    ) -> (Self, Self) {
        let (least, most) = WALKS;
        let mut all = Vec::new();
        for gust in GUSTS {
            for memory in MEMORIES {
                for step in 0..STEPS {
                    let noise = Self {
                        gust: self.gust * gust,
                        memory: self.memory * memory,
                        walk: least * (most / least).powf((step as f64 + 0.5) / STEPS as f64),
                        ..*self
                    };
                    let likely = noise.log_likelihood(left, prior, wind_deviation);
                    all.push((step, noise, likely + noise.log_prior()));
                }
            }
        }
        let best = all.iter().map(|a| a.2).fold(f64::NEG_INFINITY, f64::max);
        let (mut whole, mut walked, mut strength, mut power) = (0.0, 0.0, 0.0, 0.0);
        let mut steps = [0.0; STEPS];
        for (step, noise, logarithm) in &all {
            let weight = (logarithm - best).exp();
            whole += weight;
            steps[*step] += weight;
            walked += weight * noise.walk * noise.walk;
            strength += weight * noise.gust * noise.gust;
            power += weight * noise.gust * noise.gust * noise.memory;
        }
        let mut below = 0.0;
        let mut median = most;
        for (step, weight) in steps.iter().enumerate() {
            let share = weight / whole;
            if below + share >= 0.5 {
                let part = (step as f64 + (0.5 - below) / share) / STEPS as f64;
                median = least * (most / least).powf(part);
                break;
            }
            below += share;
        }
        let expected = Self {
            gust: (strength / whole).sqrt(),
            memory: power / strength,
            walk: (walked / whole).sqrt(),
            ..*self
        };
        let likelier = Self {
            walk: median,
            ..*self
        };
        (likelier, expected)
    }

    /// Covariance of Σ zᵀ e over vectors z at rising times, of the errors e against the wind at the last of them.
    pub(super) fn covariance<const K: usize>(
        &self,
        instruments: &[(f64, [Vector2<f64>; K])],
    ) -> SMatrix<f64, K, K> {
        let mut covariance = SMatrix::<f64, K, K>::zeros();
        let Some((mut last, _)) = instruments.first().copied() else {
            return covariance;
        };
        let mut remembered = [SVector::<f64, K>::zeros(); 2];
        let mut sums = [SVector::<f64, K>::zeros(); 2];
        for (time, vectors) in instruments {
            let dt = time - last;
            last = *time;
            let persistence = (-dt / self.memory).exp();
            for axis in 0..2 {
                // What the wind walks in this while is missing from everything before it.
                covariance.ger(self.walk * self.walk * dt, &sums[axis], &sums[axis], 1.0);
                let now = SVector::<f64, K>::from_fn(|i, _| vectors[i][axis]);
                let before = remembered[axis] * persistence;
                let gust = self.gust * self.gust;
                covariance.ger(gust, &now, &before, 1.0);
                covariance.ger(gust, &before, &now, 1.0);
                covariance.ger(gust + self.white * self.white, &now, &now, 1.0);
                remembered[axis] = before + now;
                sums[axis] += now;
            }
        }
        covariance
    }

    /// The same noise where what is new is new with samples `step` seconds apart, not with means of some seconds.
    pub(super) fn of_samples(&self, step: f64) -> Self {
        Self {
            white: self.white * (MEAN / step.clamp(1e-3, MEAN)).sqrt(),
            ..*self
        }
    }

    /// Weights of samples at rising times in the wind at the last of them, as the filter for this noise has them that knows
    /// the wind to `wind_deviation` (m/s) at first.
    pub(super) fn weights(
        &self,
        times: impl Iterator<Item = f64>,
        wind_deviation: f64,
    ) -> SampleWeights {
        let mut separation = Separation::new(self, wind_deviation);
        let mut last = None;
        let steps: Vec<SeparationStep> = times
            .map(|time| separation.after(time - last.replace(time).unwrap_or(time)))
            .collect();
        // How the wind at the end depends on wind and gust at each time, from the end on.
        let (mut on_wind, mut on_gust) = (1.0, 0.0);
        let mut of_wind = vec![0.0; steps.len()];
        for (weight, step) in of_wind.iter_mut().zip(&steps).rev() {
            let (by_wind, by_gust) = step.gains;
            *weight = on_wind * by_wind + on_gust * by_gust;
            on_wind -= *weight;
            on_gust = (on_gust - *weight) * step.persistence;
        }
        SampleWeights {
            of_wind,
            gust_variance: separation.gust,
        }
    }

    /// Standard deviation of gusts and noise together, m/s.
    pub fn deviation(&self) -> f64 {
        self.gust.hypot(self.white)
    }

    /// Innovation in each velocity that a fit leaves, as logarithm of its likelihood but for a constant.
    pub(super) fn each<'a>(
        &'a self,
        left: &'a [Left<0>],
        wind_deviation: f64,
    ) -> impl Iterator<Item = (f64, f64)> + 'a {
        let mut separation = Separation::new(self, wind_deviation);
        let mut parts = WindAndGust::default();
        let mut last = left.first().map_or(0.0, |l| l.time);
        left.iter().map(move |left| {
            let step = separation.after(left.time - last);
            last = left.time;
            let new = parts.innovation(&step, left.velocity);
            let logarithm = -0.5 * new.norm_squared() / step.variance - step.variance.ln();
            (left.time, logarithm)
        })
    }
}
#[cfg(test)]
#[path = "track_noise_tests.rs"]
mod tests;
