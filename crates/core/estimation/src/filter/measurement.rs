//! Measurement that the filter expects.

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, OMatrix, OVector, SMatrix, SVector};

use super::root::{cholesky_root, semidefinite_root, solve_lower, solve_upper};
use super::ukf::Ukf;
use super::{FilterError, Gaussian, SigmaPoints, Weights};

/// A measurement as the filter expects it, and all that a correction with it needs.
///
/// `M` is `Const<2>` for one pixel place (nothing is allocated) or `Dyn` for several stacked.
#[derive(Clone, Debug)]
pub struct PredictedMeasurement<const N: usize, M: Dim>
where
    DefaultAllocator:
        Allocator<M> + Allocator<M, M> + Allocator<M, Const<N>> + Allocator<Const<N>, M>,
{
    /// Expected measurement; DeAngelo 2016, eq. 17.
    pub mean: OVector<f64, M>,
    /// Covariance of the innovation, with the measurement noise; eq. 18.
    pub innovation_covariance: OMatrix<f64, M, M>,
    /// Covariance between state and measurement; eq. 19.
    pub cross_covariance: OMatrix<f64, Const<N>, M>,
    /// Lower triangular root of `innovation_covariance`.
    pub(super) innovation_root: OMatrix<f64, M, M>,
    /// Lower triangular root of the measurement noise.
    pub(super) noise_root: OMatrix<f64, M, M>,
    /// As in [`super::sigma::Spread`].
    pub(super) odd: OMatrix<f64, M, Const<N>>,
    pub(super) even: OMatrix<f64, M, Const<N>>,
    pub(super) shift: OVector<f64, M>,
    /// Whether the state's part is its covariance root (or else the carried points).
    pub(super) drawn: bool,
    pub(super) revision: u64,
}

impl<const N: usize, M: Dim> PredictedMeasurement<N, M>
where
    DefaultAllocator:
        Allocator<M> + Allocator<M, M> + Allocator<M, Const<N>> + Allocator<Const<N>, M>,
{
    /// Measurement minus expectation, for measurements without angles.
    pub fn innovation(&self, measurement: &OVector<f64, M>) -> OVector<f64, M> {
        measurement - &self.mean
    }

    /// Normalised innovation squared of an innovation: νᵀ S⁻¹ ν.
    pub fn nis(&self, innovation: &OVector<f64, M>) -> f64 {
        solve_lower(&self.innovation_root, innovation.clone_owned()).norm_squared()
    }

    /// Number of measured components.
    pub fn dof(&self) -> usize {
        self.mean.nrows()
    }
}

/// Transformed points in measurement space, as in [`super::sigma::Spread`].
struct MeasurementSpread<const N: usize, M: Dim>
where
    DefaultAllocator: Allocator<M> + Allocator<M, Const<N>>,
{
    mean: OVector<f64, M>,
    odd: OMatrix<f64, M, Const<N>>,
    even: OMatrix<f64, M, Const<N>>,
    shift: OVector<f64, M>,
}

impl<const N: usize, M: Dim> MeasurementSpread<N, M>
where
    DefaultAllocator: Allocator<M> + Allocator<M, Const<N>>,
{
    #[inline]
    fn of(
        points: &SigmaPoints<N>,
        weights: &Weights,
        measurement_model: impl Fn(&SVector<f64, N>) -> Option<OVector<f64, M>>,
        difference: impl Fn(&OVector<f64, M>, &OVector<f64, M>) -> OVector<f64, M>,
    ) -> Result<Self, FilterError> {
        let at = |point: usize, state: &SVector<f64, N>| {
            measurement_model(state).ok_or(FilterError::NoMeasurement { point })
        };
        let centre = at(0, &points.centre)?;
        let size = centre.shape_generic().0;
        let mut odd = OMatrix::zeros_generic(size, Const::<N>);
        let mut even = OMatrix::zeros_generic(size, Const::<N>);
        let mut sum = OVector::<f64, M>::zeros_generic(size, Const::<1>);
        for j in 0..N {
            let plus = difference(&at(1 + j, &points.plus.column(j).into_owned())?, &centre);
            let minus = difference(
                &at(1 + N + j, &points.minus.column(j).into_owned())?,
                &centre,
            );
            for i in 0..size.value() {
                odd[(i, j)] = (plus[i] - minus[i]) * weights.pair;
                even[(i, j)] = plus[i] + minus[i];
                sum[i] += even[(i, j)];
            }
        }
        for j in 0..N {
            for i in 0..size.value() {
                even[(i, j)] = (even[(i, j)] - sum[i] / N as f64) * weights.pair;
            }
        }
        sum *= weights.outer;
        Ok(Self {
            mean: centre + &sum,
            odd,
            even,
            shift: sum * weights.shift,
        })
    }
}

impl<const N: usize> Ukf<N> {
    /// Predicts the measurement that `measurement_model` should give, with noise of covariance `noise`,
    /// without using it yet.
    ///
    /// DeAngelo 2016, eqs 16-19. The model returns `None` where it has no answer.
    #[inline]
    pub fn predict_measurement<M: Dim>(
        &self,
        measurement_model: impl Fn(&SVector<f64, N>) -> Option<OVector<f64, M>>,
        noise: &OMatrix<f64, M, M>,
    ) -> Result<PredictedMeasurement<N, M>, FilterError>
    where
        DefaultAllocator:
            Allocator<M> + Allocator<M, M> + Allocator<M, Const<N>> + Allocator<Const<N>, M>,
    {
        self.predict_measurement_with(measurement_model, noise, |a, b| a - b)
    }

    /// As [`Self::predict_measurement`], with `difference(a, b)` in place of a - b, for components
    /// that are angles.
    #[inline]
    pub fn predict_measurement_with<M: Dim>(
        &self,
        measurement_model: impl Fn(&SVector<f64, N>) -> Option<OVector<f64, M>>,
        noise: &OMatrix<f64, M, M>,
        difference: impl Fn(&OVector<f64, M>, &OVector<f64, M>) -> OVector<f64, M>,
    ) -> Result<PredictedMeasurement<N, M>, FilterError>
    where
        DefaultAllocator:
            Allocator<M> + Allocator<M, M> + Allocator<M, Const<N>> + Allocator<Const<N>, M>,
    {
        let points = self.measurement_points();
        let spread = MeasurementSpread::of(&points, &self.weights, measurement_model, difference)?;
        let cross_covariance = if let Some(carried) = &self.carried {
            let state = &carried.spread;
            let mut cross = state.odd * spread.odd.transpose();
            cross += state.even * spread.even.transpose();
            for (k, shift) in spread.shift.iter().enumerate() {
                for i in 0..N {
                    cross[(i, k)] += state.shift[i] * shift;
                }
            }
            cross
        } else {
            self.root * spread.odd.transpose()
        };
        self.expect(spread, cross_covariance, noise)
    }

    /// As [`Self::predict_measurement_with`], but with the measurement model linearised
    /// statistically around another belief than the present one.
    ///
    /// For iterated corrections (posterior linearisation: García-Fernández et al. 2015): predict,
    /// correct a copy, linearise around its posterior, repeat. With A = (odd part) L⁻¹ of that
    /// belief, the model is z ≈ z₀ + A (x - x₀) with the rest of the spread as noise.
    pub fn predict_measurement_around<M: Dim>(
        &self,
        linearisation: &Gaussian<N>,
        measurement_model: impl Fn(&SVector<f64, N>) -> Option<OVector<f64, M>>,
        noise: &OMatrix<f64, M, M>,
        difference: impl Fn(&OVector<f64, M>, &OVector<f64, M>) -> OVector<f64, M>,
    ) -> Result<PredictedMeasurement<N, M>, FilterError>
    where
        DefaultAllocator:
            Allocator<M> + Allocator<M, M> + Allocator<M, Const<N>> + Allocator<Const<N>, M>,
    {
        let root: SMatrix<f64, N, N> = cholesky_root::<Const<N>>(
            &linearisation.covariance,
            "covariance of the linearisation",
        )?;
        let points = SigmaPoints::draw(&linearisation.mean, &root, self.weights.eta);
        let mut spread =
            MeasurementSpread::of(&points, &self.weights, measurement_model, difference)?;
        // A = odd L⁻¹, from Lᵀ Aᵀ = oddᵀ.
        let slope = solve_upper::<Const<N>, M>(&root, spread.odd.transpose()).transpose();
        spread.mean += &slope * (self.mean - linearisation.mean);
        spread.odd = &slope * self.root;
        let cross_covariance = self.root * spread.odd.transpose();
        let mut predicted = self.expect(spread, cross_covariance, noise)?;
        predicted.drawn = true;
        Ok(predicted)
    }

    /// As [`Self::predict_measurement`] where the model is linear: `mean` here, and `jacobian` (m × N).
    pub(super) fn predict_measurement_along<M: Dim>(
        &self,
        mean: OVector<f64, M>,
        jacobian: &OMatrix<f64, M, Const<N>>,
        noise: &OMatrix<f64, M, M>,
    ) -> Result<PredictedMeasurement<N, M>, FilterError>
    where
        DefaultAllocator:
            Allocator<M> + Allocator<M, M> + Allocator<M, Const<N>> + Allocator<Const<N>, M>,
    {
        let (size, states) = jacobian.shape_generic();
        if jacobian.nrows() != mean.nrows() {
            return Err(FilterError::Size {
                what: "measurement Jacobian",
                expected: mean.nrows(),
                found: jacobian.nrows(),
            });
        }
        let spread = MeasurementSpread {
            mean,
            odd: jacobian * self.root,
            even: OMatrix::zeros_generic(size, states),
            shift: OVector::<f64, M>::zeros_generic(size, Const::<1>),
        };
        let cross_covariance = self.root * spread.odd.transpose();
        let mut predicted = self.expect(spread, cross_covariance, noise)?;
        predicted.drawn = true;
        Ok(predicted)
    }

    #[inline]
    fn expect<M: Dim>(
        &self,
        spread: MeasurementSpread<N, M>,
        cross_covariance: OMatrix<f64, Const<N>, M>,
        noise: &OMatrix<f64, M, M>,
    ) -> Result<PredictedMeasurement<N, M>, FilterError>
    where
        DefaultAllocator:
            Allocator<M> + Allocator<M, M> + Allocator<M, Const<N>> + Allocator<Const<N>, M>,
    {
        let size = spread.mean.nrows();
        if noise.nrows() != size {
            return Err(FilterError::Size {
                what: "measurement noise",
                expected: size,
                found: noise.nrows(),
            });
        }
        let noise_root = semidefinite_root(noise, "measurement noise")?;
        let mut innovation_covariance = noise.clone_owned();
        for j in 0..size {
            for i in j..size {
                let mut sum = spread.shift[i] * spread.shift[j];
                for k in 0..N {
                    sum += spread.odd[(i, k)] * spread.odd[(j, k)];
                    sum += spread.even[(i, k)] * spread.even[(j, k)];
                }
                innovation_covariance[(i, j)] += sum;
                innovation_covariance[(j, i)] = innovation_covariance[(i, j)];
            }
        }
        if !spread.mean.iter().all(|v| v.is_finite()) {
            return Err(FilterError::NotFinite {
                place: "measurement model",
            });
        }
        Ok(PredictedMeasurement {
            innovation_root: cholesky_root(&innovation_covariance, "innovation covariance")?,
            mean: spread.mean,
            innovation_covariance,
            cross_covariance,
            noise_root,
            odd: spread.odd,
            even: spread.even,
            shift: spread.shift,
            drawn: self.carried.is_none(),
            revision: self.revision,
        })
    }
}
