//! How well a patch can be aligned with a picture: the covariance of the least-squares shift.
//!
//! Aligning template `t` with picture `p` minimises `Σ (p − a t − b)²` over the shift. The peak's shape
//! is `G = Σ g gᵀ` with `g = a ∇t`; if residuals `e` were white, the covariance of the shift would be
//! `σ² G⁻¹`. They are not (a moved shadow is one large blob), so the middle of the sandwich
//! `G⁻¹ M G⁻¹` sums `g e` over blocks before squaring, which is right for residuals that are
//! correlated within a block and not beyond it (the cluster-robust covariance of least squares).

use nalgebra::{Matrix2, Vector2};

use crate::raster::Gray;

/// Blocks along each side of the patch.
const BLOCKS: usize = 8;
/// Pixels of uncertainty per axis that remain however good the match: the sub-pixel bias of sampling.
const FLOOR: f64 = 0.1;

/// Covariance (x, y) in pixels² of the shift that aligns `template` with `picture`, both of one size.
///
/// A patch without gradients in some direction gets a huge variance there.
pub fn alignment_covariance(template: &Gray, picture: &Gray) -> Matrix2<f64> {
    let (width, height) = (template.width(), template.height());
    let (gain, bias) = gain_and_bias(template, picture);
    let mut shape = Matrix2::<f64>::zeros();
    let mut blocks = vec![Vector2::<f64>::zeros(); BLOCKS * BLOCKS];
    let mut residual_energy = 0.0;
    for row in 1..height.saturating_sub(1) {
        let (above, here, below) = (
            template.row(row - 1),
            template.row(row),
            template.row(row + 1),
        );
        let seen = picture.row(row);
        let block_row = (row * BLOCKS / height) * BLOCKS;
        for column in 1..width - 1 {
            let gx = 0.5 * gain * f64::from(here[column + 1] - here[column - 1]);
            let gy = 0.5 * gain * f64::from(below[column] - above[column]);
            let residual = f64::from(seen[column]) - gain * f64::from(here[column]) - bias;
            let g = Vector2::new(gx, gy);
            shape += g * g.transpose();
            blocks[block_row + column * BLOCKS / width] += g * residual;
            residual_energy += residual * residual;
        }
    }
    let n = (width * height) as f64;
    // A direction without gradients keeps a tiny curvature, so that its variance is huge, not infinite.
    let ridge = 1e-6 * n + 1e-3 * residual_energy / n.max(1.0);
    let inverse = (shape + Matrix2::identity() * ridge)
        .try_inverse()
        .unwrap_or_else(Matrix2::identity);
    let middle = blocks
        .iter()
        .fold(Matrix2::zeros(), |sum, b| sum + b * b.transpose());
    let white = Matrix2::identity() * (residual_energy / n) * ridge;
    let covariance = inverse * (middle + white) * inverse;
    0.5 * (covariance + covariance.transpose()) + Matrix2::identity() * (FLOOR * FLOOR)
}

/// Least-squares `picture ≈ gain · template + bias`.
fn gain_and_bias(template: &Gray, picture: &Gray) -> (f64, f64) {
    let n = template.pixels().len() as f64;
    let mean = |g: &Gray| g.pixels().iter().map(|v| f64::from(*v)).sum::<f64>() / n;
    let (mt, mp) = (mean(template), mean(picture));
    let (mut tt, mut tp) = (0.0, 0.0);
    for (t, p) in template.pixels().iter().zip(picture.pixels()) {
        let (t, p) = (f64::from(*t) - mt, f64::from(*p) - mp);
        tt += t * t;
        tp += t * p;
    }
    let gain = if tt > 0.0 { tp / tt } else { 0.0 };
    (gain, mp - gain * mt)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stripes(phase: f32) -> Gray {
        Gray::from_fn(48, 48, |c, _| {
            100.0 + 40.0 * ((c as f32 + phase) * 0.5).sin()
        })
    }

    #[test]
    fn stripes_fix_the_place_across_and_not_along() {
        let mut seen = stripes(0.0);
        for (i, pixel) in seen.pixels_mut().iter_mut().enumerate() {
            *pixel += ((i * 7919) % 13) as f32 - 6.0;
        }
        let c = alignment_covariance(&stripes(0.0), &seen);
        assert!(c[(0, 0)] < 0.05, "{c}");
        assert!(c[(1, 1)] > 100.0 * c[(0, 0)], "{c}");
    }

    #[test]
    fn more_noise_means_more_covariance() {
        let patch = Gray::from_fn(48, 48, |c, r| {
            100.0 + 30.0 * (c as f32 * 0.4).sin() + 30.0 * (r as f32 * 0.3).cos()
        });
        let noisy = |amplitude: f32| {
            let mut seen = patch.clone();
            for (i, pixel) in seen.pixels_mut().iter_mut().enumerate() {
                *pixel += amplitude * (((i * 7919) % 101) as f32 / 50.0 - 1.0);
            }
            alignment_covariance(&patch, &seen).trace()
        };
        assert!(noisy(40.0) > 2.0 * noisy(5.0));
    }
}
