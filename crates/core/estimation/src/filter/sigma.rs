//! Sigma points and their weights.

use nalgebra::{Const, OMatrix, SMatrix, SVector, U1};
use serde::{Deserialize, Serialize};

use super::FilterError;
use super::root::WideRoot;

/// Choice of the sigma points that go through the measurement model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Redraw {
    /// Drawn anew from the predicted mean and covariance, which contain the process noise.
    #[default]
    AfterProcessNoise,
    /// The propagated ones, as DeAngelo 2016, eq. 16 prints it. They lack the process noise, so
    /// that the reported covariance stays too large by about Q.
    CarriedThrough,
}

/// Settings of the scaled unscented transform.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct UnscentedSettings {
    /// Spread α of the sigma points, in (0, 1] as a rule; with α = 1 they stand √N standard
    /// deviations from the mean. DeAngelo 2016, eq. 10.
    pub alpha: f64,
    /// Weight β of the centre in the covariance; 2 suits Gaussians. DeAngelo 2016, eq. 12.
    pub beta: f64,
    /// Choice of the sigma points that go through the measurement model.
    pub redraw: Redraw,
}

impl Default for UnscentedSettings {
    fn default() -> Self {
        Self {
            alpha: 1.0,
            beta: 2.0,
            redraw: Redraw::default(),
        }
    }
}

/// Weights of the scaled unscented transform for `N` components; DeAngelo 2016, eqs 10-12.
///
/// | α (N = 4, β = 2) | η | `mean_centre` | `outer` | `covariance_centre` |
/// |---|---|---|---|---|
/// | 1 | 2 | 0 | 0.125 | 2 |
/// | 0.5 | 1 | -3 | 0.5 | -0.25 |
/// | 0.1 | 0.2 | -99 | 12.5 | -96.01 |
/// | 0.001 | 0.002 | -999 999 | 125 000 | -999 996.000 001 |
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Weights {
    /// Distance η of the outer points, in columns of the covariance's root.
    pub eta: f64,
    /// Weight of the centre in the mean.
    pub mean_centre: f64,
    /// Weight of the centre in the covariance.
    pub covariance_centre: f64,
    /// Weight of each outer point, in the mean and in the covariance.
    pub outer: f64,
    /// √(outer / 2), the factor of half differences and half sums of opposite points.
    pub(super) pair: f64,
    /// √(β + α² κ / N), the factor of the mean's shift; see [`Spread`].
    pub(super) shift: f64,
}

impl Weights {
    /// Weights of Table 3, or with a secondary scaling κ ≠ 0 those of Merwe.
    ///
    /// ```
    /// use pilotage_estimation::filter::{UnscentedSettings, Weights};
    ///
    /// // The second line of the table.
    /// let settings = UnscentedSettings { alpha: 0.5, ..UnscentedSettings::default() };
    /// let weights = Weights::new::<4>(&settings, 0.0)?;
    /// assert_eq!((weights.eta, weights.mean_centre, weights.outer), (1.0, -3.0, 0.5));
    /// // The centre and eight outer points together weigh 1.
    /// assert_eq!(weights.mean_centre + 8.0 * weights.outer, 1.0);
    /// # Ok::<(), pilotage_estimation::filter::FilterError>(())
    /// ```
    pub fn new<const N: usize>(
        settings: &UnscentedSettings,
        kappa: f64,
    ) -> Result<Self, FilterError> {
        let n = N as f64;
        let (alpha, beta) = (settings.alpha, settings.beta);
        if !(alpha.is_finite() && alpha > 0.0) {
            return Err(FilterError::Setting {
                name: "alpha",
                value: alpha,
                allowed: "a positive number, 1e-4 to 1 as a rule",
            });
        }
        if !(kappa.is_finite() && n + kappa > 0.0) {
            return Err(FilterError::Setting {
                name: "kappa",
                value: kappa,
                allowed: "more than minus the number of state components",
            });
        }
        let shift = beta + alpha * alpha * kappa / n;
        if !(shift.is_finite() && shift >= 0.0) {
            return Err(FilterError::Setting {
                name: "beta",
                value: beta,
                allowed: "zero or more (with kappa below zero: at least -alpha² kappa / N)",
            });
        }
        let spread = alpha * alpha * (n + kappa);
        let outer = 0.5 / spread;
        let mean_centre = (spread - n) / spread;
        Ok(Self {
            eta: spread.sqrt(),
            mean_centre,
            covariance_centre: mean_centre + (1.0 - alpha * alpha + beta),
            outer,
            pair: (0.5 * outer).sqrt(),
            shift: shift.sqrt(),
        })
    }
}

/// The 2N + 1 sigma points: the centre and a pair on each column of the covariance's root.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SigmaPoints<const N: usize> {
    /// The central point.
    pub centre: SVector<f64, N>,
    /// Columns: centre + η × column of the root (or what the process made of it).
    pub plus: SMatrix<f64, N, N>,
    /// Columns: centre - η × column of the root (or what the process made of it).
    pub minus: SMatrix<f64, N, N>,
}

impl<const N: usize> SigmaPoints<N> {
    /// Around `mean`, on the columns of `root`, DeAngelo 2016, eq. 9.
    #[inline]
    pub(super) fn draw(mean: &SVector<f64, N>, root: &SMatrix<f64, N, N>, eta: f64) -> Self {
        let (mut plus, mut minus) = (*root, *root);
        for j in 0..N {
            for i in 0..N {
                let step = eta * root[(i, j)];
                plus[(i, j)] = mean[i] + step;
                minus[(i, j)] = mean[i] - step;
            }
        }
        Self {
            centre: *mean,
            plus,
            minus,
        }
    }

    /// Every point sent through `map`.
    #[inline]
    pub(super) fn map(&self, map: impl Fn(&SVector<f64, N>) -> SVector<f64, N>) -> Self {
        let mut mapped = *self;
        mapped.centre = map(&self.centre);
        for j in 0..N {
            mapped
                .plus
                .set_column(j, &map(&self.plus.column(j).into_owned()));
        }
        for j in 0..N {
            mapped
                .minus
                .set_column(j, &map(&self.minus.column(j).into_owned()));
        }
        mapped
    }

    /// The points in the order of DeAngelo 2016, eq. 9: centre, plus, minus.
    pub fn iter(&self) -> impl Iterator<Item = SVector<f64, N>> + '_ {
        std::iter::once(self.centre)
            .chain(self.plus.column_iter().map(nalgebra::Matrix::into_owned))
            .chain(self.minus.column_iter().map(nalgebra::Matrix::into_owned))
    }

    /// Number of points.
    pub const fn count() -> usize {
        2 * N + 1
    }
}

/// Spread of transformed sigma points around their weighted mean, as columns that are squared and added with
/// weight +1.
///
/// Let δᵢ be the outer points seen from the transformed centre, w their weight, W = 2Nw,
/// d = w Σ δᵢ the mean seen from the centre. Table 3's covariance, with its negative centre weight,
/// is Σ w (δᵢ - d)(δᵢ - d)ᵀ + `W_c` d dᵀ. Multiplying out gives
/// `w Σ (δᵢ - d/W)(δᵢ - d/W)ᵀ + (β + α² κ/N) d dᵀ`: the same matrix, as a sum of squares for
/// every α, without the cancelling of large weights. A pair of opposite points δ⁺, δ⁻ is turned by
/// 45° into (δ⁺ - δ⁻)/√2 and (δ⁺ + δ⁻)/√2, which changes no square and makes the second one vanish
/// for linear maps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spread<const N: usize> {
    /// Weighted mean.
    pub(super) mean: SVector<f64, N>,
    /// √(w/2) (δ⁺ - δ⁻), a column per pair.
    pub(super) odd: SMatrix<f64, N, N>,
    /// √(w/2) (δ⁺ + δ⁻ - 2 d/W), a column per pair.
    pub(super) even: SMatrix<f64, N, N>,
    /// √(β + α² κ/N) d.
    pub(super) shift: SVector<f64, N>,
}

impl<const N: usize> Spread<N> {
    /// Of transformed points with their weights.
    #[inline]
    pub(super) fn of(points: &SigmaPoints<N>, weights: &Weights) -> Self {
        let mut odd = points.plus - points.minus;
        let mut even = SMatrix::<f64, N, N>::zeros();
        let mut sum = SVector::<f64, N>::zeros();
        for j in 0..N {
            for i in 0..N {
                let value = (points.plus[(i, j)] - points.centre[i])
                    + (points.minus[(i, j)] - points.centre[i]);
                even[(i, j)] = value;
                sum[i] += value;
            }
        }
        let pair_mean = sum / N as f64;
        odd *= weights.pair;
        for mut column in even.column_iter_mut() {
            column -= pair_mean;
            column *= weights.pair;
        }
        let offset = sum * weights.outer;
        Self {
            mean: points.centre + offset,
            odd,
            even,
            shift: offset * weights.shift,
        }
    }

    /// Lower triangular root of the spread's covariance with the noise of `noise_root` added.
    #[inline]
    pub(super) fn root_with(&self, noise_root: &SMatrix<f64, N, N>) -> SMatrix<f64, N, N> {
        let mut wide = WideRoot {
            blocks: [[[0.0; N]; 3]; N],
            tail: OMatrix::<f64, U1, Const<N>>::zeros(),
        };
        for i in 0..N {
            for j in 0..N {
                wide.blocks[i][0][j] = self.odd[(i, j)];
                wide.blocks[i][1][j] = self.even[(i, j)];
                wide.blocks[i][2][j] = noise_root[(i, j)];
            }
            wide.tail[i] = self.shift[i];
        }
        wide.triangularise()
    }
}
