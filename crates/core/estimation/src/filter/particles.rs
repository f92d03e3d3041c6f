//! The particle filter: a belief of any shape, as a cloud of weighted states.

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, OMatrix, OVector, SMatrix, SVector};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

use super::cloud::{Cloud, SeenMeasurements};
use super::root::{cholesky_root, semidefinite_root, solve_lower, solve_semidefinite, solve_upper};
use super::{
    Correction, FilterError, Gaussian, Prediction, SigmaPoints, UnscentedSettings, Weights,
};

/// Most stages in which one measurement is taken in. Each moves the cloud by a third of its own width or
/// so, so that even a measurement at fifty standard deviations is reached.
const MOST_STAGES: usize = 200;
/// Halvings of the share of a measurement that a stage takes in; relative to it they leave 1e-9.
const HALVINGS: usize = 30;

/// Settings of the particle filter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ParticleSettings {
    /// Number of particles, at least 2.
    pub count: usize,
    /// Seed of everything random in the filter.
    pub seed: u64,
    /// Least effective share of the particles, in (0, 1): below, they are drawn anew.
    pub least_effective: f64,
}

impl Default for ParticleSettings {
    fn default() -> Self {
        Self {
            count: 2000,
            seed: 1,
            least_effective: 0.5,
        }
    }
}

/// Measurement that the filter expects, from all its particles.
#[derive(Clone, Debug)]
pub struct ExpectedMeasurement<const N: usize, M: Dim>
where
    DefaultAllocator: Allocator<M> + Allocator<M, M> + Allocator<Const<N>, M>,
{
    /// Mean over the particles.
    pub mean: OVector<f64, M>,
    /// Covariance over the particles, with the measurement noise.
    pub innovation_covariance: OMatrix<f64, M, M>,
    /// Covariance between state and measurement.
    pub cross_covariance: OMatrix<f64, Const<N>, M>,
}

/// Regularised particle filter with progressive correction over `N` state components.
///
/// - The prediction moves every particle and adds noise drawn from Q (the bootstrap filter of Gordon,
///   Salmond and Smith 1993).
/// - A correction weighs the particles by their likelihood. Where that would leave fewer effective
///   particles, 1/Σw², than the settings want, it is taken in by stages (progressive correction: Musso,
///   Oudjane and Le Gland 2001, section 12.4): a small power of the likelihood, then particles drawn
///   anew, until what is left of it leaves enough.
/// - They are drawn anew by systematic resampling and moved apart with a Gaussian kernel of the width
///   that is best for Gaussian densities, h = (4 / (n (N + 2)))^(1/(N+4)) (Silverman 1986, 4.14), and
///   drawn together before it by √(1 - h²) about their mean, so that the kernel does not widen the cloud
///   (Liu and West 2001).
/// - Whatever is drawn is then moved by the linear map that gives the cloud the mean and the covariance
///   which it should have on average (second-order exact sampling: Pham 2001). Without it, chance
///   correlations of what is drawn with states that hardly move would wear those states' covariance down.
#[derive(Clone, Debug)]
pub struct ParticleFilter<const N: usize> {
    cloud: Cloud<N>,
    /// Moments of the cloud.
    belief: Gaussian<N>,
    settings: ParticleSettings,
    /// Distance of the sigma points that are shown.
    eta: f64,
    random: ChaCha8Rng,
}

impl<const N: usize> ParticleFilter<N> {
    /// A filter whose particles are drawn from `prior`; `shown` says how far from the mean the sigma
    /// points lie that are shown of it.
    ///
    /// ```
    /// use nalgebra::{Matrix2, Vector2};
    /// use pilotage_estimation::filter::{
    ///     Gaussian, ParticleFilter, ParticleSettings, UnscentedSettings,
    /// };
    ///
    /// let prior = Gaussian::new(Vector2::new(5.0, -3.0), Matrix2::identity());
    /// let settings = ParticleSettings { count: 500, ..ParticleSettings::default() };
    /// let filter = ParticleFilter::new(&prior, settings, UnscentedSettings::default())?;
    /// // All weigh the same; the error of the mean of 500 is 1/√500 on each axis, 0.045.
    /// assert!((filter.effective_count() - 500.0).abs() < 1e-6);
    /// assert!((filter.state().mean - prior.mean).norm() < 4.0 * 0.045);
    /// # Ok::<(), pilotage_estimation::filter::FilterError>(())
    /// ```
    pub fn new(
        prior: &Gaussian<N>,
        settings: ParticleSettings,
        shown: UnscentedSettings,
    ) -> Result<Self, FilterError> {
        if settings.count < 2 {
            return Err(FilterError::Setting {
                name: "number of particles",
                value: settings.count as f64,
                allowed: "2 or more, 500 to 5000 as a rule",
            });
        }
        if !(settings.least_effective > 0.0 && settings.least_effective < 1.0) {
            return Err(FilterError::Setting {
                name: "least effective share of the particles",
                value: settings.least_effective,
                allowed: "a number between 0 and 1, 0.5 as a rule",
            });
        }
        if !prior.mean.iter().all(|v| v.is_finite()) {
            return Err(FilterError::NotFinite {
                place: "prior mean",
            });
        }
        let root = semidefinite_root(&prior.covariance, "prior covariance")?;
        let mut random = ChaCha8Rng::seed_from_u64(settings.seed);
        let states = (0..settings.count).map(|_| prior.mean + drawn(&root, &mut random));
        let cloud = Cloud::of(states.collect());
        Ok(Self {
            belief: cloud.moments(),
            cloud,
            settings,
            eta: Weights::new::<N>(&shown, 0.0)?.eta,
            random,
        })
    }

    /// Mean and covariance of the particles.
    pub fn state(&self) -> &Gaussian<N> {
        &self.belief
    }

    /// The particles.
    pub fn particles(&self) -> &[SVector<f64, N>] {
        &self.cloud.states
    }

    /// Their weights, which sum to 1.
    pub fn weights(&self) -> &[f64] {
        &self.cloud.weights
    }

    /// Number of equally weighted particles that would be worth as much, 1/Σw².
    pub fn effective_count(&self) -> f64 {
        self.cloud.effective_count()
    }

    /// Sigma points with the moments of the particles, for those who want to see some.
    pub fn sigma_points(&self) -> SigmaPoints<N> {
        let root: SMatrix<f64, N, N> =
            semidefinite_root(&self.belief.covariance, "covariance of the particles")
                .unwrap_or_else(|_| SMatrix::zeros());
        SigmaPoints::draw(&self.belief.mean, &root, self.eta)
    }

    /// Moves the particles apart about their mean until their covariance is `factor` times what it was.
    pub fn fade(&mut self, factor: f64) -> Result<(), FilterError> {
        if !(factor.is_finite() && factor >= 0.0) {
            return Err(FilterError::Setting {
                name: "fading factor",
                value: factor,
                allowed: "zero or more",
            });
        }
        let mean = self.belief.mean;
        for state in &mut self.cloud.states {
            *state = mean + (*state - mean) * factor.sqrt();
        }
        self.belief = self.cloud.moments();
        Ok(())
    }

    /// Moves every particle through `process` and adds noise drawn from `process_noise`, the covariance Q
    /// of this step, which may be singular.
    ///
    /// The sigma points of the answer have the moments of the particles before, and lie along the
    /// regression line of the later state on the earlier one.
    pub fn predict(
        &mut self,
        process: impl Fn(&SVector<f64, N>) -> SVector<f64, N>,
        process_noise: &SMatrix<f64, N, N>,
    ) -> Result<Prediction<N>, FilterError> {
        let noise_root = semidefinite_root(process_noise, "process noise")?;
        let before = self.belief;
        let root: SMatrix<f64, N, N> =
            semidefinite_root(&before.covariance, "covariance of the particles")?;
        let sigma_points_before = SigmaPoints::draw(&before.mean, &root, self.eta);
        let states: Vec<_> = self.cloud.states.iter().map(&process).collect();
        if !states.iter().flatten().all(|v| v.is_finite()) {
            return Err(FilterError::NotFinite {
                place: "process model",
            });
        }
        let mut moved = Cloud {
            states,
            weights: self.cloud.weights.clone(),
        };
        let mut after = moved.moments();
        after.covariance += process_noise;
        for state in &mut moved.states {
            *state += drawn(&noise_root, &mut self.random);
        }
        moved.straighten(&after)?;
        let cross = self
            .cloud
            .cross_covariance(&before.mean, &moved.states, &after.mean);
        // Regression of the later state on the earlier: Cᵀ P⁻¹ L = (L⁻¹ C)ᵀ.
        let along = solve_semidefinite(&root, cross).transpose();
        self.cloud = moved;
        self.belief = after;
        Ok(Prediction {
            before,
            sigma_points_before,
            sigma_points_after: SigmaPoints::draw(&self.belief.mean, &along, self.eta),
            after: self.belief,
        })
    }

    /// Predicts the measurement that `model` should give, with noise of covariance `noise`;
    /// `difference(a, b)` is a - b, but for components that are angles. Particles for which the model has no
    /// answer count for nothing.
    pub fn predict_measurement<M: Dim>(
        &self,
        model: impl Fn(&SVector<f64, N>) -> Option<OVector<f64, M>>,
        noise: &OMatrix<f64, M, M>,
        difference: impl Fn(&OVector<f64, M>, &OVector<f64, M>) -> OVector<f64, M>,
    ) -> Result<ExpectedMeasurement<N, M>, FilterError>
    where
        DefaultAllocator: Allocator<M> + Allocator<M, M> + Allocator<Const<N>, M>,
    {
        let seen = SeenMeasurements::by(&self.cloud, model, &difference)?;
        self.expect(&seen, noise)
    }

    fn expect<M: Dim>(
        &self,
        seen: &SeenMeasurements<M>,
        noise: &OMatrix<f64, M, M>,
    ) -> Result<ExpectedMeasurement<N, M>, FilterError>
    where
        DefaultAllocator: Allocator<M> + Allocator<M, M> + Allocator<Const<N>, M>,
    {
        if noise.nrows() != seen.mean.nrows() {
            return Err(FilterError::Size {
                what: "measurement noise",
                expected: seen.mean.nrows(),
                found: noise.nrows(),
            });
        }
        Ok(ExpectedMeasurement {
            mean: seen.mean.clone_owned(),
            innovation_covariance: seen.covariance(&self.cloud) + noise,
            cross_covariance: seen.cross_covariance(&self.cloud, &self.belief.mean),
        })
    }

    /// Corrects the belief with a `measurement` of `noise` (positive definite) by `model`; see
    /// [`Self::predict_measurement`] for `difference`.
    ///
    /// Gain, innovation and its covariance in the answer are those of the cloud's moments, which the
    /// correction of the particles does not use.
    pub fn correct<M: Dim>(
        &mut self,
        model: impl Fn(&SVector<f64, N>) -> Option<OVector<f64, M>>,
        noise: &OMatrix<f64, M, M>,
        measurement: &OVector<f64, M>,
        difference: impl Fn(&OVector<f64, M>, &OVector<f64, M>) -> OVector<f64, M>,
    ) -> Result<Correction<N, M>, FilterError>
    where
        DefaultAllocator:
            Allocator<M> + Allocator<M, M> + Allocator<M, Const<N>> + Allocator<Const<N>, M>,
    {
        if !measurement.iter().all(|v| v.is_finite()) {
            return Err(FilterError::NotFinite {
                place: "measurement",
            });
        }
        let noise_root = cholesky_root(noise, "measurement noise")?;
        let before = self.belief;
        let mut seen = SeenMeasurements::by(&self.cloud, &model, &difference)?;
        let expected = self.expect(&seen, noise)?;
        let innovation = difference(measurement, &expected.mean);
        let innovation_root =
            cholesky_root(&expected.innovation_covariance, "innovation covariance")?;
        let nis = solve_lower(&innovation_root, innovation.clone_owned()).norm_squared();
        let half = solve_lower(&innovation_root, expected.cross_covariance.transpose());
        let gain = solve_upper(&innovation_root, half).transpose();

        let mut left = 1.0;
        for stage in 0..MOST_STAGES {
            let fits = seen.log_likelihoods(measurement, &noise_root, &difference);
            let last = stage + 1 == MOST_STAGES || self.leaves_enough(&fits, left);
            let share = if last {
                left
            } else {
                self.gentle_share(&fits, left)
            };
            self.cloud.weigh(&fits, share)?;
            left -= share;
            if last {
                break;
            }
            self.draw_anew()?;
            seen = SeenMeasurements::by(&self.cloud, &model, &difference)?;
        }
        self.belief = self.cloud.moments();
        Ok(Correction {
            gain,
            innovation,
            innovation_covariance: expected.innovation_covariance,
            nis,
            before,
            after: self.belief,
        })
    }

    /// Whether this share of the log likelihoods leaves enough effective particles.
    fn leaves_enough(&self, fits: &[f64], share: f64) -> bool {
        let wanted = self.settings.least_effective * self.settings.count as f64;
        self.cloud.effective_count_after(fits, share) >= wanted
    }

    /// The largest share up to `left` of the log likelihoods that moves the cloud by no more than the
    /// kernel can fill up ahead of it.
    ///
    /// A likelihood that moves a Gaussian by c deviations leaves exp(-c²) of its particles effective; those that are
    /// impossible are lost by any share.
    fn gentle_share(&self, fits: &[f64], left: f64) -> f64 {
        let wanted =
            self.cloud.effective_count_after(fits, 0.0) * (-self.kernel_width().powi(2)).exp();
        let (mut low, mut high) = (0.0, left);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if self.cloud.effective_count_after(fits, middle) >= wanted {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }

    /// Deviation of the kernel in deviations of the cloud.
    fn kernel_width(&self) -> f64 {
        let (n, dimensions) = (self.settings.count as f64, N as f64);
        (4.0 / (n * (dimensions + 2.0))).powf(1.0 / (dimensions + 4.0))
    }

    /// As many particles of equal weight with the same moments, on average.
    fn draw_anew(&mut self) -> Result<(), FilterError> {
        let belief = self.cloud.moments();
        let root = semidefinite_root(&belief.covariance, "covariance of the particles")?;
        let width = self.kernel_width();
        let together = (1.0 - width * width).max(0.0).sqrt();
        self.cloud.resample(&mut self.random);
        for state in &mut self.cloud.states {
            let apart = drawn(&root, &mut self.random) * width;
            *state = belief.mean + (*state - belief.mean) * together + apart;
        }
        self.cloud.straighten(&belief)
    }
}

/// A draw of the normal distribution with this root of its covariance.
fn drawn<const N: usize>(root: &SMatrix<f64, N, N>, random: &mut ChaCha8Rng) -> SVector<f64, N> {
    root * SVector::<f64, N>::from_fn(|_, _| StandardNormal.sample(random))
}
