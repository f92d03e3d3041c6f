//! Robust least squares over the frames.

use nalgebra::SMatrix;

use super::residual::{ReferenceLog, RegisteredPose, SAID, UNKNOWNS, Unknowns};

/// Rounds of Gauss and Newton, each with its own weights.
const ROUNDS: usize = 20;
/// Deviations beyond which a residual counts as an outlier (Huber).
const OUTLYING: f64 = 2.0;
/// Least standard deviations of the numbers that a frame says: metres, radians, logarithm of a height.
const LEAST: [f64; SAID] = [0.05, 0.05, 0.002, 0.002];
/// Median of the magnitudes of a normal variable of unit deviation.
const MEDIAN_OF_NORMAL: f64 = 0.674_489_75;
/// Steps of the central differences.
const STEPS: [f64; UNKNOWNS] = [1e-2, 1e-5, 1e-5, 1e-5, 1e-5, 1e-5, 1e-3, 1e-3];

type Matrix = SMatrix<f64, UNKNOWNS, UNKNOWNS>;

/// The best explanation of the frames around one guess.
#[derive(Clone, Debug)]
pub struct Solution {
    pub unknowns: Unknowns,
    pub covariance: Matrix,
    /// Cost: negative logarithm of the likelihood of residuals and prior, up to a constant.
    pub cost: f64,
    /// Frames that said something.
    pub frames: usize,
    /// Standard deviation of the places, metres per axis.
    pub place_deviation: f64,
}

/// The frames' residuals at `unknowns`.
fn residuals(
    log: &ReferenceLog<'_>,
    frames: &[RegisteredPose],
    unknowns: &Unknowns,
) -> Vec<[Option<f64>; SAID]> {
    let of = |frame: &RegisteredPose| log.residual(frame, unknowns).unwrap_or([None; SAID]);
    frames.iter().map(of).collect()
}

/// Standard deviation of each number over the frames, from the median of the magnitudes; both axes of the
/// place share one.
fn deviations(residuals: &[[Option<f64>; SAID]]) -> [f64; SAID] {
    let median = |which: &[usize]| -> f64 {
        let of = residuals
            .iter()
            .flat_map(|r| which.iter().filter_map(|i| r[*i]));
        let mut magnitudes: Vec<f64> = of.map(f64::abs).collect();
        if magnitudes.is_empty() {
            return 0.0;
        }
        let middle = magnitudes.len() / 2;
        *magnitudes.select_nth_unstable_by(middle, f64::total_cmp).1 / MEDIAN_OF_NORMAL
    };
    let place = median(&[0, 1]);
    let all = [place, place, median(&[2]), median(&[3])];
    std::array::from_fn(|i| all[i].max(LEAST[i]))
}

/// Redundancy of neighbouring frames, for each number: the factor by which that many frames say less than as
/// many independent ones, (1 + r) / (1 - r) for the correlation r of the errors from one to the next.
fn redundancy(residuals: &[[Option<f64>; SAID]]) -> [f64; SAID] {
    let of = |numbers: &[usize]| -> f64 {
        let (mut product, mut square) = (0.0, 0.0);
        for pair in residuals.windows(2) {
            for &number in numbers {
                if let (Some(a), Some(b)) = (pair[0][number], pair[1][number]) {
                    product += a * b;
                    square += 0.5 * (a * a + b * b);
                }
            }
        }
        let r = if square > 0.0 { product / square } else { 0.0 };
        let r = r.clamp(0.0, 0.95);
        (1.0 + r) / (1.0 - r)
    };
    let place = of(&[0, 1]);
    [place, place, of(&[2]), of(&[3])]
}

/// The normal equations about one point.
struct Normal {
    information: Matrix,
    gradient: Unknowns,
}

/// Adds up the frames, each number of theirs counting for one in `redundancy`.
fn normal_equations(
    log: &ReferenceLog<'_>,
    frames: &[RegisteredPose],
    at: &Unknowns,
    prior: &Unknowns,
    redundancy: &[f64; SAID],
) -> Normal {
    let is_sought = |i: usize| prior[i] > 0.0;
    let here = residuals(log, frames, at);
    let sigma = deviations(&here);
    let mut information = Matrix::zeros();
    let mut gradient = Unknowns::zeros();
    for i in 0..UNKNOWNS {
        if is_sought(i) {
            information[(i, i)] = prior[i].powi(-2);
            gradient[i] = -at[i] * prior[i].powi(-2);
        } else {
            information[(i, i)] = 1.0;
        }
    }
    for (frame, said) in frames.iter().zip(&here) {
        let Some(slopes) = slopes(log, frame, at, &is_sought) else {
            continue;
        };
        for (number, value) in said.iter().enumerate() {
            let Some(value) = value else { continue };
            let slope = slopes.row(number).transpose();
            let weight =
                huber(value / sigma[number]).0 / sigma[number].powi(2) / redundancy[number];
            information += weight * slope * slope.transpose();
            gradient -= weight * slope * *value;
        }
    }
    Normal {
        information,
        gradient,
    }
}

/// Huber's weight of a residual of `r` deviations, and its cost.
fn huber(r: f64) -> (f64, f64) {
    let r = r.abs();
    if r <= OUTLYING {
        (1.0, 0.5 * r * r)
    } else {
        (OUTLYING / r, OUTLYING * (r - 0.5 * OUTLYING))
    }
}

/// Gauss and Newton from `guess`; `prior` are standard deviations about zero, zero for what is not sought.
pub fn solve(
    log: &ReferenceLog<'_>,
    frames: &[RegisteredPose],
    guess: &Unknowns,
    prior: &Unknowns,
) -> Option<Solution> {
    let is_sought = |i: usize| prior[i] > 0.0;
    let mut at = *guess;
    for _ in 0..ROUNDS {
        let normal = normal_equations(log, frames, &at, prior, &[1.0; SAID]);
        let scale = normal.information.diagonal().map(f64::sqrt);
        let step = normal.information.cholesky()?.solve(&normal.gradient);
        at += step;
        if step.component_mul(&scale).norm() < 1e-6 {
            break;
        }
    }
    let here = residuals(log, frames, &at);
    let sigma = deviations(&here);
    let said = here.iter().filter(|r| r[0].is_some()).count();
    let mut cost = 0.0;
    for (number, value) in here.iter().flatten().enumerate() {
        let sigma = sigma[number % SAID];
        cost += value.map_or(0.0, |value| huber(value / sigma).1 + sigma.ln());
    }
    for i in (0..UNKNOWNS).filter(|i| is_sought(*i)) {
        cost += 0.5 * (at[i] / prior[i]).powi(2);
    }
    // Neighbouring frames err alike: as an estimate all the same, but it is less sure.
    let alike = redundancy(&here);
    let normal = normal_equations(log, frames, &at, prior, &alike);
    let mut covariance = normal.information.try_inverse()?;
    for i in (0..UNKNOWNS).filter(|i| !is_sought(*i)) {
        covariance.fill_row(i, 0.0);
        covariance.fill_column(i, 0.0);
    }
    Some(Solution {
        unknowns: at,
        covariance,
        cost: cost / said.max(1) as f64,
        frames: said,
        place_deviation: sigma[0],
    })
}

/// Jacobian of a frame's numbers by the unknowns, from central differences.
fn slopes(
    log: &ReferenceLog<'_>,
    frame: &RegisteredPose,
    at: &Unknowns,
    is_sought: &dyn Fn(usize) -> bool,
) -> Option<SMatrix<f64, SAID, UNKNOWNS>> {
    let mut slopes = SMatrix::zeros();
    for i in (0..UNKNOWNS).filter(|i| is_sought(*i)) {
        let mut step = Unknowns::zeros();
        step[i] = STEPS[i];
        let after = log.residual(frame, &(at + step))?;
        let before = log.residual(frame, &(at - step))?;
        for number in 0..SAID {
            if let (Some(after), Some(before)) = (after[number], before[number]) {
                slopes[(number, i)] = (after - before) / (2.0 * STEPS[i]);
            }
        }
    }
    Some(slopes)
}
