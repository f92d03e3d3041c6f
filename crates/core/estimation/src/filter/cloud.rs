//! Weighted states, and what they see.

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, OMatrix, OVector, SMatrix, SVector};
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardUniform};

use super::root::{semidefinite_root, solve_lower, solve_semidefinite};
use super::{FilterError, Gaussian};

/// States with weights that sum to 1.
#[derive(Clone, Debug)]
pub(super) struct Cloud<const N: usize> {
    pub(super) states: Vec<SVector<f64, N>>,
    pub(super) weights: Vec<f64>,
}

impl<const N: usize> Cloud<N> {
    /// Of equal weights.
    pub(super) fn of(states: Vec<SVector<f64, N>>) -> Self {
        let weights = vec![1.0 / states.len() as f64; states.len()];
        Self { states, weights }
    }

    /// 1/Σw².
    pub(super) fn effective_count(&self) -> f64 {
        1.0 / self.weights.iter().map(|w| w * w).sum::<f64>()
    }

    /// Factor that makes a weighted covariance about the weighted mean unbiased, 1/(1 - Σw²).
    fn unbiased(&self) -> f64 {
        1.0 / (1.0 - 1.0 / self.effective_count()).max(f64::EPSILON)
    }

    /// Weighted mean of other states, one for each of these.
    pub(super) fn mean_of(&self, states: &[SVector<f64, N>]) -> SVector<f64, N> {
        let weighted = states.iter().zip(&self.weights).map(|(x, w)| x * *w);
        weighted.sum()
    }

    /// Mean and covariance.
    pub(super) fn moments(&self) -> Gaussian<N> {
        let mean = self.mean_of(&self.states);
        let covariance = self.cross_covariance(&mean, &self.states, &mean);
        Gaussian::new(mean, covariance)
    }

    /// Covariance of these states, with their `mean`, and of others, with theirs.
    pub(super) fn cross_covariance(
        &self,
        mean: &SVector<f64, N>,
        others: &[SVector<f64, N>],
        mean_of_others: &SVector<f64, N>,
    ) -> SMatrix<f64, N, N> {
        let mut sum = SMatrix::<f64, N, N>::zeros();
        for ((x, y), w) in self.states.iter().zip(others).zip(&self.weights) {
            let y = y - mean_of_others;
            let x = (x - mean) * *w;
            for j in 0..N {
                for i in 0..N {
                    sum[(i, j)] += x[i] * y[j];
                }
            }
        }
        sum * self.unbiased()
    }

    /// Moves the states by the linear map that gives them the moments of `belief` exactly.
    pub(super) fn straighten(&mut self, belief: &Gaussian<N>) -> Result<(), FilterError> {
        let name = "covariance of the particles";
        let drawn = self.moments();
        let from: SMatrix<f64, N, N> = semidefinite_root(&drawn.covariance, name)?;
        let to: SMatrix<f64, N, N> = semidefinite_root(&belief.covariance, name)?;
        for state in &mut self.states {
            *state = belief.mean + to * solve_semidefinite(&from, *state - drawn.mean);
        }
        Ok(())
    }

    /// Relative weights after multiplication with exp(`share` × `fits`).
    fn weighed<'a>(&'a self, fits: &'a [f64], share: f64) -> impl Iterator<Item = f64> + 'a {
        let best = fits.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        // What is impossible is so for the smallest share of it, too.
        let weigh = move |(w, fit): (&f64, &f64)| match *fit {
            f64::NEG_INFINITY => 0.0,
            fit => w * (share * (fit - best)).exp(),
        };
        self.weights.iter().zip(fits).map(weigh)
    }

    /// Value that [`Self::effective_count`] would have after [`Self::weigh`].
    pub(super) fn effective_count_after(&self, fits: &[f64], share: f64) -> f64 {
        let (mut sum, mut squares) = (0.0, 0.0);
        for weight in self.weighed(fits, share) {
            sum += weight;
            squares += weight * weight;
        }
        sum * sum / squares
    }

    /// Multiplies the weights with exp(`share` × `fits`), one fit a state.
    pub(super) fn weigh(&mut self, fits: &[f64], share: f64) -> Result<(), FilterError> {
        let mut weights: Vec<f64> = self.weighed(fits, share).collect();
        let sum = weights.iter().sum::<f64>();
        if !(sum.is_finite() && sum > 0.0) {
            return Err(FilterError::NotFinite {
                place: "weights of the particles",
            });
        }
        for weight in &mut weights {
            *weight /= sum;
        }
        self.weights = weights;
        Ok(())
    }

    /// As many states of equal weight, each kept about as often as its weight says (systematic
    /// resampling: Kitagawa 1996, appendix).
    pub(super) fn resample(&mut self, random: &mut ChaCha8Rng) {
        let n = self.states.len();
        let begin: f64 = uniform(random);
        let mut kept = Vec::with_capacity(n);
        let (mut index, mut reached) = (0, self.weights[0]);
        for k in 0..n {
            let place = (k as f64 + begin) / n as f64;
            while place > reached && index + 1 < n {
                index += 1;
                reached += self.weights[index];
            }
            kept.push(self.states[index]);
        }
        *self = Self::of(kept);
    }
}

fn uniform(random: &mut impl Rng) -> f64 {
    StandardUniform.sample(random)
}

/// Measurements that the states of a cloud see.
pub(super) struct SeenMeasurements<M: Dim>
where
    DefaultAllocator: Allocator<M>,
{
    /// Weighted mean.
    pub(super) mean: OVector<f64, M>,
    /// Seen minus mean; `None` for a state that sees nothing.
    offsets: Vec<Option<OVector<f64, M>>>,
}

impl<M: Dim> SeenMeasurements<M>
where
    DefaultAllocator: Allocator<M> + Allocator<M, M>,
{
    /// By the states of `cloud` through `model`.
    pub(super) fn by<const N: usize>(
        cloud: &Cloud<N>,
        model: impl Fn(&SVector<f64, N>) -> Option<OVector<f64, M>>,
        difference: &impl Fn(&OVector<f64, M>, &OVector<f64, M>) -> OVector<f64, M>,
    ) -> Result<Self, FilterError> {
        let mut offsets: Vec<_> = cloud.states.iter().map(model).collect();
        let about = offsets.iter().flatten().next();
        let about = about
            .cloned()
            .ok_or(FilterError::NoMeasurement { point: 0 })?;
        // Seen from one of them, so that angles do not wrap.
        let mut sum = about.clone_owned();
        sum.fill(0.0);
        let mut weight = 0.0;
        for (seen, w) in offsets.iter_mut().zip(&cloud.weights) {
            if let Some(seen) = seen {
                *seen = difference(seen, &about);
                sum += &*seen * *w;
                weight += w;
            }
        }
        sum /= weight;
        for seen in offsets.iter_mut().flatten() {
            *seen -= &sum;
        }
        let mean = about + sum;
        if !mean.iter().all(|v| v.is_finite()) {
            return Err(FilterError::NotFinite {
                place: "measurement model",
            });
        }
        Ok(Self { mean, offsets })
    }

    /// Factor that makes a weighted covariance over the states that see something unbiased: 1/(1 - Σw²) for their share of
    /// the weights.
    fn unbiased<const N: usize>(&self, cloud: &Cloud<N>) -> f64 {
        if self.offsets.iter().all(Option::is_some) {
            return cloud.unbiased();
        }
        let (mut sum, mut squares) = (0.0, 0.0);
        for (offset, w) in self.offsets.iter().zip(&cloud.weights) {
            if offset.is_some() {
                sum += w;
                squares += w * w;
            }
        }
        1.0 / (sum * (1.0 - squares / (sum * sum)).max(f64::EPSILON))
    }

    /// Covariance over the states that see something, without noise.
    pub(super) fn covariance<const N: usize>(&self, cloud: &Cloud<N>) -> OMatrix<f64, M, M> {
        let size = self.mean.shape_generic().0;
        let mut sum = OMatrix::<f64, M, M>::zeros_generic(size, size);
        for (offset, w) in self.offsets.iter().zip(&cloud.weights) {
            if let Some(offset) = offset {
                sum.ger(*w, offset, offset, 1.0);
            }
        }
        sum * self.unbiased(cloud)
    }

    /// Covariance between the states that see something, and what they see; `mean` is that of all states.
    pub(super) fn cross_covariance<const N: usize>(
        &self,
        cloud: &Cloud<N>,
        mean: &SVector<f64, N>,
    ) -> OMatrix<f64, Const<N>, M>
    where
        DefaultAllocator: Allocator<Const<N>, M>,
    {
        let size = self.mean.shape_generic().0;
        let mut sum = OMatrix::<f64, Const<N>, M>::zeros_generic(Const::<N>, size);
        for ((state, offset), w) in cloud.states.iter().zip(&self.offsets).zip(&cloud.weights) {
            if let Some(offset) = offset {
                sum.ger(*w, &(state - mean), offset, 1.0);
            }
        }
        sum * self.unbiased(cloud)
    }

    /// Logarithm of the likelihood of `measurement` for every state, but for a constant, under noise with
    /// this root of its covariance.
    pub(super) fn log_likelihoods(
        &self,
        measurement: &OVector<f64, M>,
        noise_root: &OMatrix<f64, M, M>,
        difference: &impl Fn(&OVector<f64, M>, &OVector<f64, M>) -> OVector<f64, M>,
    ) -> Vec<f64> {
        let innovation = difference(measurement, &self.mean);
        let fit = |offset: &Option<OVector<f64, M>>| {
            offset.as_ref().map_or(f64::NEG_INFINITY, |offset| {
                let off = difference(&innovation, offset);
                -0.5 * solve_lower(noise_root, off).norm_squared()
            })
        };
        self.offsets.iter().map(fit).collect()
    }
}
