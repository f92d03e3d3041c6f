//! Uncertainty of wind, airspeed and heading at the beginning of an outage, with what their errors have in
//! common.

use nalgebra::{SMatrix, Vector2};

use super::fit::{AirFit, Design, NO_WIND, OUTLIER, RoundGuess, SLIP_OFFSET, Solved, UNKNOWNS};
use super::problem::FitProblem;
use super::rows::rows;
use super::track_noise::{Left, SampleWeights, TrackNoise};

/// Unknowns of the fit that are no wind.
const OTHERS: usize = 5;
/// The wind's two components and them.
const ALL: usize = 2 + OTHERS;
/// Components of an outlook: wind north and east, airspeed scale, bias of the heading.
const KNOWN: usize = 4;

/// Uncertainty of wind, airspeed, heading and gusts when satellite navigation is lost.
///
/// The filter's wind is a weighted sum of what the fit leaves of each velocity, v - X θ. It errs by a sum over the same
/// errors e that the fit has erred by, and by what the fit's error adds: with the filter's weights k and the fit's gain G
/// on its sums Σ zᵀ e, the wind is off by -Σ (k - D G zᵀ) e and the unknowns by -G Σ zᵀ e, where D = Σ k X. So both
/// follow together from the noise and its memory ([`TrackNoise::covariance`]), whatever noise the filter was made for: a
/// filter that follows the likeliest wind is judged by all winds that may be (Gelb 1974, ch. 7.2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outlook {
    /// Covariance of wind north and east (m/s), airspeed scale, and heading as read minus truth (radians).
    pub(super) covariance: SMatrix<f64, KNOWN, KNOWN>,
    /// Variance of the gust per axis, (m/s)².
    pub(super) gust_variance: f64,
}

impl FitProblem<'_> {
    /// The outlook at the end of the stretch, with a fit to what came up to `as_of` (seconds, of satellite navigation) and
    /// delays of airspeed and satellite navigation; `None` with too few velocities.
    pub(super) fn outlook(
        &self,
        fit: &AirFit,
        as_of: f64,
        (airspeed_delay, gps_delay): (f64, f64),
    ) -> Option<Outlook> {
        let known = Solved::of(fit);
        let limit = (OUTLIER * fit.residual).max(1.0) * std::f64::consts::SQRT_2;
        let mut rows = rows(self, airspeed_delay, gps_delay);
        rows.retain(|row| known.left(row).velocity.norm() < limit);
        let fitted = rows.partition_point(|row| row.time + gps_delay <= as_of);
        let guess = RoundGuess {
            offset: fit.heading_offset,
            drift: fit.heading_drift,
            noise: fit.expected_noise,
            is_open: false,
        };
        let solved = self.round(&rows[..fitted], &guess)?;
        let last = rows.last()?;
        let step = (last.time - rows[0].time) / (rows.len() - 1).max(1) as f64;
        let noise = fit.noise.of_samples(step);
        let weights = noise.weights(rows.iter().map(|row| row.time), self.prior.wind);
        let errors = OutlookErrors {
            expected: &fit.expected_noise,
            wind_deviation: self.prior.wind,
            moments: &solved.moments,
            others_by: SMatrix::from_fn(|i, j| solved.gain[(NO_WIND[i], j)]),
            of_priors: SMatrix::from_fn(|i, j| solved.of_priors[(NO_WIND[i], NO_WIND[j])]),
        };
        let left: Vec<Left<OTHERS>> = rows.iter().map(|row| known.left(row)).collect();
        let covariance = errors.covariance(&left, &weights);
        let told = told(fit, last.airspeed, last.time);
        Some(Outlook {
            covariance: told * covariance * told.transpose(),
            gust_variance: weights.gust_variance,
        })
    }
}

/// Wind, scale and heading's bias by wind and the other unknowns, at an airspeed as read (m/s).
///
/// At one speed the offset of the sideslip is as another heading.
fn told(fit: &AirFit, airspeed: f64, time: f64) -> SMatrix<f64, KNOWN, ALL> {
    let place = |unknown| NO_WIND.iter().position(|i| *i == unknown).map(|i| 2 + i);
    let airspeed = airspeed.max(1.0);
    let mut told = SMatrix::<f64, KNOWN, ALL>::zeros();
    // The fit's factor is its scale along the air velocity, and turns it by what lies across.
    for (row, unknown, factor) in [
        (2, 0, 1.0),
        (3, 1, -1.0 / fit.scale),
        (3, 4, -(time - fit.reference) / fit.scale),
        (3, SLIP_OFFSET, -1.0 / (fit.scale * airspeed * airspeed)),
    ] {
        if let Some(column) = place(unknown) {
            told[(row, column)] = factor;
        }
    }
    told[(0, 0)] = 1.0;
    told[(1, 1)] = 1.0;
    told
}

/// By what an outlook errs.
struct OutlookErrors<'a> {
    expected: &'a TrackNoise,
    /// Prior of the wind per axis, m/s.
    wind_deviation: f64,
    moments: &'a [(f64, Design)],
    /// The gain of the unknowns that are no wind.
    others_by: SMatrix<f64, OTHERS, UNKNOWNS>,
    /// Part of the covariance of those unknowns that comes from their priors.
    of_priors: SMatrix<f64, OTHERS, OTHERS>,
}

impl OutlookErrors<'_> {
    /// Covariance of the wind's error and of those of the other unknowns.
    fn covariance(&self, left: &[Left<OTHERS>], weights: &SampleWeights) -> SMatrix<f64, ALL, ALL> {
        let mut design = SMatrix::<f64, 2, OTHERS>::zeros();
        for (left, weight) in left.iter().zip(&weights.of_wind) {
            design += SMatrix::<f64, 2, OTHERS>::from_columns(&left.design) * *weight;
        }
        // Rows of q in the sums Σ q e that wind and unknowns are off by.
        let of_row = |(index, left): (usize, &Left<OTHERS>)| {
            let mut vectors = [Vector2::zeros(); ALL];
            if let Some((_, instruments)) = self.moments.get(index) {
                for (other, vector) in vectors[2..].iter_mut().enumerate() {
                    let parts = instruments.iter().enumerate();
                    *vector = parts.map(|(j, z)| z * self.others_by[(other, j)]).sum();
                }
            }
            for axis in 0..2 {
                let by_unknowns: Vector2<f64> = (0..OTHERS)
                    .map(|other| vectors[2 + other] * design[(axis, other)])
                    .sum();
                vectors[axis] = -by_unknowns;
                vectors[axis][axis] += weights.of_wind[index];
            }
            (left.time, vectors)
        };
        let sums: Vec<_> = left.iter().enumerate().map(of_row).collect();
        let mut covariance = self.expected.covariance(&sums);
        // What the priors leave open of the unknowns shifts the wind as well, and so does its own.
        let mut shifts = SMatrix::<f64, ALL, OTHERS>::zeros();
        shifts.fixed_view_mut::<2, OTHERS>(0, 0).copy_from(&-design);
        shifts
            .fixed_view_mut::<OTHERS, OTHERS>(2, 0)
            .fill_with_identity();
        covariance += shifts * self.of_priors * shifts.transpose();
        let missing = self.wind_deviation * (1.0 - weights.of_wind.iter().sum::<f64>());
        for axis in 0..2 {
            covariance[(axis, axis)] += missing * missing;
        }
        covariance
    }
}
