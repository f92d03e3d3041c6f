//! The last fraction of a pixel: aligns a patch with the picture over shift, turn and scale.
//!
//! Minimises `Σ ρ(p(W x) − a t(x) − b)` over a similarity `W`, gain `a` and bias `b` by Gauss-Newton
//! with Tukey's weights, so that a moved shadow or a parked car does not pull.
//!
//! The covariance of the answer comes from the shape of the minimum. With rows `j` of derivatives and
//! `H = Σ w j jᵀ` it would be `σ² H⁻¹` for white residuals. They are not white (a moved shadow is one
//! large blob), so the middle of the sandwich `H⁻¹ M H⁻¹` sums `w j e` over blocks before squaring:
//! right for residuals correlated within a block and not beyond it (the cluster-robust covariance of
//! least squares).

use nalgebra::{Matrix4, Matrix6, SMatrix, Vector4, Vector6};

use pilotage_raster::raster::{Gray, bilinear};

/// Blocks along each side of the patch.
const BLOCKS: usize = 8;
/// Most Gauss-Newton steps.
const STEPS: usize = 8;
/// Tukey's constant for 95 % efficiency with Gaussian residuals.
const TUKEY: f64 = 4.685;

/// Similarity that takes patch pixels to picture pixels, both from their middles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PatchSimilarity {
    /// Shift to the right, pixels.
    pub x: f64,
    /// Shift down, pixels.
    pub y: f64,
    /// Turn, radians clockwise.
    pub rotation: f64,
    /// Natural logarithm of the scale.
    pub log_scale: f64,
}

/// An alignment and how well it is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchAlignment {
    /// Place of the patch in the picture.
    pub similarity: PatchSimilarity,
    /// Covariance of (x, y, rotation, log scale), pixels and radians.
    pub covariance: Matrix4<f64>,
}

/// Residual of one pixel and its derivatives.
struct PixelResidual {
    residual: f64,
    row: Vector6<f64>,
    block: usize,
}

/// Aligns `patch` with `picture` from `start`; `None` if the patch leaves the picture, has too few
/// gradients, or the search runs away.
pub fn align(patch: &Gray, picture: &Gray, start: PatchSimilarity) -> Option<PatchAlignment> {
    let mut at = start;
    let (mut gain, mut bias) = (1.0, 0.0);
    let mut fresh = true;
    let mut samples = Vec::with_capacity(patch.pixels().len());
    for _ in 0..STEPS {
        collect(
            patch,
            picture,
            &at,
            &mut gain,
            &mut bias,
            fresh,
            &mut samples,
        )?;
        fresh = false;
        let limit = TUKEY * scale_of(&samples);
        let mut hessian = Matrix6::<f64>::zeros();
        let mut gradient = Vector6::<f64>::zeros();
        for sample in &samples {
            let weight = tukey(sample.residual, limit);
            if weight > 0.0 {
                hessian.syger(weight, &sample.row, &sample.row, 1.0);
                gradient.axpy(weight * sample.residual, &sample.row, 1.0);
            }
        }
        hessian.fill_upper_triangle_with_lower_triangle();
        let step = hessian.cholesky()?.solve(&gradient);
        at.x -= step[0];
        at.y -= step[1];
        at.rotation -= step[2];
        at.log_scale -= step[3];
        gain += step[4];
        bias += step[5];
        let moved = (at.x - start.x).hypot(at.y - start.y);
        if moved > 4.0 || (at.rotation - start.rotation).abs() > 0.2 {
            return None;
        }
        if step.fixed_rows::<2>(0).norm() < 1e-3 && step[2].abs() < 1e-5 {
            break;
        }
    }
    collect(
        patch,
        picture,
        &at,
        &mut gain,
        &mut bias,
        false,
        &mut samples,
    )?;
    Some(PatchAlignment {
        similarity: at,
        covariance: covariance(&samples)?,
    })
}

fn tukey(residual: f64, limit: f64) -> f64 {
    let r = residual / limit;
    if r.abs() >= 1.0 {
        0.0
    } else {
        (1.0 - r * r).powi(2)
    }
}

/// Robust standard deviation of the residuals, from their median magnitude.
fn scale_of(samples: &[PixelResidual]) -> f64 {
    let mut magnitudes: Vec<f64> = samples.iter().map(|s| s.residual.abs()).collect();
    let middle = magnitudes.len() / 2;
    let (_, median, _) = magnitudes.select_nth_unstable_by(middle, f64::total_cmp);
    (1.4826 * *median).max(0.5)
}

/// Residuals and derivatives at `at`; with `fresh`, gain and bias are fitted first.
fn collect(
    patch: &Gray,
    picture: &Gray,
    at: &PatchSimilarity,
    gain: &mut f64,
    bias: &mut f64,
    fresh: bool,
    samples: &mut Vec<PixelResidual>,
) -> Option<()> {
    let (width, height) = (patch.width(), patch.height());
    let (sin, cos) = at.rotation.sin_cos();
    let scale = at.log_scale.exp();
    let (half_w, half_h) = (0.5 * width as f64, 0.5 * height as f64);
    let (mid_x, mid_y) = (
        0.5 * picture.width() as f64 + at.x,
        0.5 * picture.height() as f64 + at.y,
    );
    samples.clear();
    for row in 1..height.saturating_sub(1) {
        let (above, here, below) = (patch.row(row - 1), patch.row(row), patch.row(row + 1));
        let y = row as f64 + 0.5 - half_h;
        for column in 1..width - 1 {
            let x = column as f64 + 0.5 - half_w;
            let u = mid_x + scale * (cos * x - sin * y);
            let v = mid_y + scale * (sin * x + cos * y);
            let seen = f64::from(bilinear(picture, u as f32, v as f32)?);
            let t = f64::from(here[column]);
            let gx = 0.5 * f64::from(here[column + 1] - here[column - 1]);
            let gy = 0.5 * f64::from(below[column] - above[column]);
            samples.push(PixelResidual {
                // For now the raw picture value; the residual follows once gain and bias are known.
                residual: seen,
                row: Vector6::new(gx, gy, gy * x - gx * y, gx * x + gy * y, t, 1.0),
                block: (row * BLOCKS / height) * BLOCKS + column * BLOCKS / width,
            });
        }
    }
    if fresh {
        (*gain, *bias) = gain_and_bias(samples);
    }
    // A patch that the picture does not resemble at all gives no direction to go.
    if *gain <= 0.05 {
        return None;
    }
    for sample in samples.iter_mut() {
        sample.residual -= *gain * sample.row[4] + *bias;
        // Shifting the picture under the patch by d changes the residual by +a ∇t d; in patch axes.
        let (gx, gy) = (sample.row[0], sample.row[1]);
        sample.row[0] = *gain * (cos * gx - sin * gy);
        sample.row[1] = *gain * (sin * gx + cos * gy);
        sample.row[2] *= *gain;
        sample.row[3] *= *gain;
    }
    Some(())
}

/// Least-squares `picture ≈ gain · patch + bias`.
fn gain_and_bias(samples: &[PixelResidual]) -> (f64, f64) {
    let n = samples.len() as f64;
    let mt = samples.iter().map(|s| s.row[4]).sum::<f64>() / n;
    let mp = samples.iter().map(|s| s.residual).sum::<f64>() / n;
    let (mut tt, mut tp) = (1e-9, 0.0);
    for s in samples {
        tt += (s.row[4] - mt).powi(2);
        tp += (s.row[4] - mt) * (s.residual - mp);
    }
    (tp / tt, mp - tp / tt * mt)
}

/// The sandwich, reduced to shift, turn and scale.
fn covariance(samples: &[PixelResidual]) -> Option<Matrix4<f64>> {
    let limit = TUKEY * scale_of(samples);
    let mut hessian = Matrix6::<f64>::zeros();
    let mut blocks = vec![Vector6::<f64>::zeros(); BLOCKS * BLOCKS];
    let mut total = Vector6::<f64>::zeros();
    for sample in samples {
        let weight = tukey(sample.residual, limit);
        if weight > 0.0 {
            hessian.syger(weight, &sample.row, &sample.row, 1.0);
            let score = sample.row * (weight * sample.residual);
            blocks[sample.block] += score;
            total += score;
        }
    }
    hessian.fill_upper_triangle_with_lower_triangle();
    let inverse = hessian.cholesky()?.inverse();
    let n = blocks.len() as f64;
    let mean = total / n;
    let middle = blocks.iter().fold(Matrix6::zeros(), |sum, b| {
        sum + (b - mean) * (b - mean).transpose()
    });
    // Six parameters were fitted to the blocks' scores.
    let full: SMatrix<f64, 6, 6> = inverse * middle * inverse * (n / (n - 6.0));
    let own = full.fixed_view::<4, 4>(0, 0).into_owned();
    let symmetric = 0.5 * (own + own.transpose());
    let spread: Vector4<f64> = symmetric.diagonal();
    spread
        .iter()
        .all(|v| v.is_finite() && *v >= 0.0)
        .then_some(symmetric)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(x: f64, y: f64) -> f32 {
        let wave = (0.31 * x).sin() + (0.23 * y + 0.1 * x).cos() + (0.17 * (x - 2.0 * y)).sin();
        (120.0 + 25.0 * wave) as f32
    }

    fn patch() -> Gray {
        Gray::from_fn(56, 56, |c, r| {
            scene(c as f64 + 0.5 - 28.0, r as f64 + 0.5 - 28.0)
        })
    }

    /// The scene moved by a similarity, seen with another gain and bias.
    fn picture(s: PatchSimilarity, noise: f32) -> Gray {
        let (sin, cos) = s.rotation.sin_cos();
        let scale = s.log_scale.exp();
        let mut state = 12345_u32;
        Gray::from_fn(72, 72, |c, r| {
            let (dx, dy) = (c as f64 + 0.5 - 36.0 - s.x, r as f64 + 0.5 - 36.0 - s.y);
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let random = (state >> 8) as f32 / 8_388_608.0 - 1.0;
            let value = scene((cos * dx + sin * dy) / scale, (cos * dy - sin * dx) / scale);
            0.7 * value + 20.0 + noise * random
        })
    }

    #[test]
    fn a_moved_turned_and_scaled_patch_is_found_to_a_fiftieth_of_a_pixel() {
        let truth = PatchSimilarity {
            x: 0.62,
            y: -0.83,
            rotation: 0.03,
            log_scale: -0.02,
        };
        let found = align(&patch(), &picture(truth, 0.0), PatchSimilarity::default())
            .unwrap()
            .similarity;
        assert!(
            (found.x - truth.x).abs() < 0.02 && (found.y - truth.y).abs() < 0.02,
            "{found:?}"
        );
        assert!((found.rotation - truth.rotation).abs() < 1e-3, "{found:?}");
        assert!(
            (found.log_scale - truth.log_scale).abs() < 1e-3,
            "{found:?}"
        );
    }

    #[test]
    fn the_covariance_foretells_the_errors_of_noisy_pictures() {
        let truth = PatchSimilarity {
            x: 0.3,
            y: 0.2,
            rotation: 0.0,
            log_scale: 0.0,
        };
        let (mut squared, mut claimed, mut n) = (0.0, 0.0, 0.0);
        for seed in 0..30 {
            let moved = PatchSimilarity {
                x: truth.x + 0.01 * f64::from(seed),
                ..truth
            };
            let mut seen = picture(moved, 0.0);
            let mut state = 977_u32 * (seed as u32 + 1);
            for pixel in seen.pixels_mut() {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                *pixel += 12.0 * ((state >> 8) as f32 / 8_388_608.0 - 1.0);
            }
            let found = align(&patch(), &seen, PatchSimilarity::default()).unwrap();
            squared += (found.similarity.x - moved.x).powi(2);
            claimed += found.covariance[(0, 0)];
            n += 1.0;
        }
        let ratio = squared / claimed;
        assert!((0.4..2.5).contains(&ratio), "{ratio} over {n} pictures");
    }

    #[test]
    fn a_shadow_over_a_fifth_of_the_patch_does_not_pull() {
        let truth = PatchSimilarity {
            x: 0.4,
            y: -0.3,
            rotation: 0.0,
            log_scale: 0.0,
        };
        let mut seen = picture(truth, 2.0);
        for row in 10..62 {
            for column in 12..24 {
                seen.set(column, row, 0.35 * seen.get(column, row));
            }
        }
        let found = align(&patch(), &seen, PatchSimilarity::default())
            .unwrap()
            .similarity;
        assert!(
            (found.x - truth.x).hypot(found.y - truth.y) < 0.1,
            "{found:?}"
        );
    }

    #[test]
    fn a_flat_patch_has_no_place() {
        let flat = Gray::filled(40, 40, 90.0);
        assert_eq!(
            align(
                &flat,
                &Gray::filled(60, 60, 90.0),
                PatchSimilarity::default()
            ),
            None
        );
    }
}
