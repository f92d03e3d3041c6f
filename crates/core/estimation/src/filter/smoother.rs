//! The fixed-interval smoother: what was believed at a time, with all that was measured later.

use nalgebra::SMatrix;

use super::root::{semidefinite_root, solve_semidefinite, solve_semidefinite_transposed};
use super::{FilterError, Gaussian, Prediction, Weights};

/// Link between two times for the smoother, made of one prediction: two beliefs and the covariance between
/// them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmootherLink<const N: usize> {
    /// Belief of the filter at the beginning of the step, with all that was measured until then.
    pub before: Gaussian<N>,
    /// Belief that it predicted for the end, before anything was measured there.
    pub after: Gaussian<N>,
    /// Covariance between the state at the beginning (rows) and at the end (columns), N × N.
    pub cross_covariance: SMatrix<f64, N, N>,
}

impl<const N: usize> SmootherLink<N> {
    /// From the sigma points of a prediction of a filter with these `weights`.
    ///
    /// The centre lies in the mean before, so that the points enter in pairs only:
    /// `Σ w (X - x)(Y - y)ᵀ = w/2 Σ (X⁺ - X⁻)(Y⁺ - Y⁻)ᵀ` over the pairs, with w the weight of an outer
    /// point.
    pub fn of(prediction: &Prediction<N>, weights: &Weights) -> Self {
        let (before, after) = (
            &prediction.sigma_points_before,
            &prediction.sigma_points_after,
        );
        let spread_before = before.plus - before.minus;
        let spread_after = after.plus - after.minus;
        Self {
            before: prediction.before,
            after: prediction.after,
            cross_covariance: spread_before * spread_after.transpose() * (0.5 * weights.outer),
        }
    }

    /// The belief at the beginning of the step when that at its end is `later`.
    ///
    /// Särkkä 2008, eqs 15 and 16 (Unscented Rauch-Tung-Striebel Smoother, IEEE Transactions on Automatic
    /// Control 53): with the gain G = C P⁻¹ the mean is m + G (mˢ - m⁻) and the covariance
    /// P - G P⁻ Gᵀ + G Pˢ Gᵀ. A predicted covariance P⁻ may be singular: what it does not move is known at
    /// both ends alike.
    pub fn smoothed(&self, later: &Gaussian<N>) -> Result<Gaussian<N>, FilterError> {
        let root = semidefinite_root(&self.after.covariance, "predicted covariance")?;
        // With P⁻ = L Lᵀ and Z = L⁻¹ Cᵀ: Gᵀ = L⁻ᵀ Z and G P⁻ Gᵀ = Zᵀ Z.
        let whitened = solve_semidefinite(&root, self.cross_covariance.transpose());
        let gain_transposed = solve_semidefinite_transposed(&root, whitened);
        let mean = self.before.mean + gain_transposed.tr_mul(&(later.mean - self.after.mean));
        let added = gain_transposed.tr_mul(&(later.covariance * gain_transposed));
        let covariance = self.before.covariance - whitened.tr_mul(&whitened) + added;
        if !mean.iter().chain(covariance.iter()).all(|v| v.is_finite()) {
            return Err(FilterError::NotFinite {
                place: "smoothed state",
            });
        }
        Ok(Gaussian::new(
            mean,
            (covariance + covariance.transpose()) * 0.5,
        ))
    }
}

/// The beliefs at the beginning of every link and, last, at the end of the last one, each with all that
/// was measured over the whole interval. `links` in time order; `last` is what the filter believed at the
/// end.
///
/// For a linear process this is the Rauch-Tung-Striebel smoother (1965), whatever the weights.
///
/// ```
/// use nalgebra::{Matrix1, Vector1};
/// use pilotage_estimation::filter::{Gaussian, SmootherLink, Ukf, UnscentedSettings, smooth};
///
/// // A position that moves by 2 m and keeps its variance of 1.
/// let prior = Gaussian::new(Vector1::new(0.0), Matrix1::new(1.0));
/// let mut filter = Ukf::new(prior, UnscentedSettings::default())?;
/// let prediction = filter.predict(|x| x.add_scalar(2.0), &Matrix1::zeros())?;
/// let link = SmootherLink::of(&prediction, filter.weights());
/// // Measured at the end: 4, as good as the belief. Half of the surprise is that of the start.
/// let predicted = filter.predict_measurement(|x| Some(*x), &Matrix1::new(1.0))?;
/// filter.correct(&predicted, &Vector1::new(4.0))?;
/// let beliefs = smooth(&[link], &filter.state())?;
/// assert!((beliefs[0].mean[0] - 1.0).abs() < 1e-9);
/// # Ok::<(), pilotage_estimation::filter::FilterError>(())
/// ```
pub fn smooth<const N: usize>(
    links: &[SmootherLink<N>],
    last: &Gaussian<N>,
) -> Result<Vec<Gaussian<N>>, FilterError> {
    let mut backward = Vec::with_capacity(links.len() + 1);
    let mut later = *last;
    backward.push(later);
    for link in links.iter().rev() {
        later = link.smoothed(&later)?;
        backward.push(later);
    }
    backward.reverse();
    Ok(backward)
}
