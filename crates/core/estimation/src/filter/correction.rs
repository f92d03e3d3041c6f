//! Taking a measurement into the belief.

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, OMatrix, OVector, SMatrix};

use super::root::{WideRoot, solve_lower, solve_upper};
use super::ukf::{Ukf, finite};
use super::{FilterError, Gaussian, PredictedMeasurement};

/// Record of a correction, for those who want to see it.
#[derive(Clone, Debug)]
pub struct Correction<const N: usize, M: Dim>
where
    DefaultAllocator: Allocator<M> + Allocator<M, M> + Allocator<Const<N>, M>,
{
    /// Kalman gain; DeAngelo 2016, eq. 20.
    pub gain: OMatrix<f64, Const<N>, M>,
    /// Measurement minus expectation.
    pub innovation: OVector<f64, M>,
    /// Covariance of the innovation; eq. 18.
    pub innovation_covariance: OMatrix<f64, M, M>,
    /// Normalised innovation squared.
    pub nis: f64,
    /// Belief before the correction.
    pub before: Gaussian<N>,
    /// Belief after the correction; eqs 21 and 22.
    pub after: Gaussian<N>,
}

impl<const N: usize> Ukf<N> {
    /// Corrects the belief with `measurement`; DeAngelo 2016, eqs 20-22.
    ///
    /// `predicted` must come from this filter as it is now.
    ///
    /// ```
    /// use nalgebra::{Matrix1, Vector1};
    /// use pilotage_estimation::filter::{Gaussian, Ukf, UnscentedSettings};
    ///
    /// let prior = Gaussian::new(Vector1::new(10.0), Matrix1::new(1.0));
    /// let mut filter = Ukf::new(prior, UnscentedSettings::default())?;
    /// let predicted = filter.predict_measurement(|x| Some(*x), &Matrix1::new(1.0))?;
    /// let correction = filter.correct(&predicted, &Vector1::new(12.0))?;
    /// // Two sources that are trusted alike: the mean of both, half the variance, NIS 2² / (1 + 1).
    /// assert!((filter.mean()[0] - 11.0).abs() < 1e-12);
    /// assert!((filter.state().covariance[(0, 0)] - 0.5).abs() < 1e-12);
    /// assert!((correction.nis - 2.0).abs() < 1e-12);
    /// # Ok::<(), pilotage_estimation::filter::FilterError>(())
    /// ```
    #[inline]
    pub fn correct<M: Dim>(
        &mut self,
        predicted: &PredictedMeasurement<N, M>,
        measurement: &OVector<f64, M>,
    ) -> Result<Correction<N, M>, FilterError>
    where
        DefaultAllocator:
            Allocator<M> + Allocator<M, M> + Allocator<M, Const<N>> + Allocator<Const<N>, M>,
    {
        if measurement.nrows() != predicted.dof() {
            return Err(FilterError::Size {
                what: "measurement",
                expected: predicted.dof(),
                found: measurement.nrows(),
            });
        }
        self.correct_by(predicted, predicted.innovation(measurement))
    }

    /// As [`Self::correct`], for an innovation that the caller formed, where components are angles.
    ///
    /// With K = Pₓᵣ S⁻¹ the new covariance P - K S Kᵀ equals the sum of squares
    /// (E - K F)(E - K F)ᵀ + K R Kᵀ, where E and F are the spreads of state and measurement: it is
    /// triangularised in that form, which stays positive whatever the rounding of K.
    #[inline]
    pub fn correct_by<M: Dim>(
        &mut self,
        predicted: &PredictedMeasurement<N, M>,
        innovation: OVector<f64, M>,
    ) -> Result<Correction<N, M>, FilterError>
    where
        DefaultAllocator:
            Allocator<M> + Allocator<M, M> + Allocator<M, Const<N>> + Allocator<Const<N>, M>,
    {
        if predicted.revision != self.revision {
            return Err(FilterError::Stale);
        }
        if !innovation.iter().all(|v| v.is_finite()) {
            return Err(FilterError::NotFinite {
                place: "measurement",
            });
        }
        let before = self.state();
        let whitened = solve_lower(&predicted.innovation_root, innovation.clone_owned());
        let nis = whitened.norm_squared();
        let half = solve_lower(
            &predicted.innovation_root,
            predicted.cross_covariance.transpose(),
        );
        let mut mean = self.mean;
        for (i, value) in mean.iter_mut().enumerate() {
            for (k, whitened) in whitened.iter().enumerate() {
                *value += half[(k, i)] * whitened;
            }
        }
        let gain_transposed = solve_upper(&predicted.innovation_root, half);
        let root = match self.carried.as_ref().filter(|_| !predicted.drawn) {
            None => {
                let mut wide = joseph::<N, 3, M>(predicted, &gain_transposed);
                add_to_block(&mut wide, 0, &self.root);
                wide.triangularise()
            }
            Some(carried) => {
                let mut wide = joseph::<N, 4, M>(predicted, &gain_transposed);
                add_to_block(&mut wide, 0, &carried.spread.odd);
                add_to_block(&mut wide, 1, &carried.spread.even);
                for i in 0..N {
                    wide.blocks[i][2][0] += carried.spread.shift[i];
                }
                add_to_block(&mut wide, 3, &carried.noise_root);
                wide.triangularise()
            }
        };
        if !finite(&mean, &root) {
            return Err(FilterError::NotFinite {
                place: "corrected state",
            });
        }
        self.commit(mean, root);
        Ok(Correction {
            gain: gain_transposed.transpose(),
            innovation,
            innovation_covariance: predicted.innovation_covariance.clone_owned(),
            nis,
            before,
            after: self.state(),
        })
    }
}

/// [-K F | K √R]: the blocks are odd part, even part, shift (one column).
#[inline]
fn joseph<const N: usize, const B: usize, M: Dim>(
    predicted: &PredictedMeasurement<N, M>,
    gain_transposed: &OMatrix<f64, M, Const<N>>,
) -> WideRoot<N, B, M>
where
    DefaultAllocator:
        Allocator<M> + Allocator<M, M> + Allocator<M, Const<N>> + Allocator<Const<N>, M>,
{
    let mut blocks = [[[0.0; N]; B]; N];
    for (i, row) in blocks.iter_mut().enumerate() {
        for k in 0..predicted.dof() {
            let gain = gain_transposed[(k, i)];
            for (j, value) in row[0].iter_mut().enumerate() {
                *value -= gain * predicted.odd[(k, j)];
            }
            for (j, value) in row[1].iter_mut().enumerate() {
                *value -= gain * predicted.even[(k, j)];
            }
            row[2][0] -= gain * predicted.shift[k];
        }
    }
    WideRoot {
        blocks,
        tail: predicted.noise_root.tr_mul(gain_transposed),
    }
}

#[inline]
fn add_to_block<const N: usize, const B: usize, M: Dim>(
    wide: &mut WideRoot<N, B, M>,
    block: usize,
    columns: &SMatrix<f64, N, N>,
) where
    DefaultAllocator: Allocator<M, Const<N>>,
{
    for i in 0..N {
        for j in 0..N {
            wide.blocks[i][block][j] += columns[(i, j)];
        }
    }
}
