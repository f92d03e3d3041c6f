//! Noise that makes a flight's measurements likeliest.

/// Climbs to a maximum of `score` over the logarithms of positive numbers, by the simplex of Nelder and Mead (1965)
/// with its usual coefficients: reflection 1, expansion 2, contraction and shrinkage a half.
///
/// Begins at `start` (positive), each corner half as large again, and ends after `evaluations` calls of `score` or a
/// few more. Answers with the best numbers and their score.
///
/// ```
/// use pilotage_navigator::instruments::likeliest;
///
/// // Greatest where the numbers are 3 and 0.5.
/// let score = |x: &[f64]| -(x[0] / 3.0).ln().powi(2) - (x[1] / 0.5).ln().powi(2);
/// let (found, _) = likeliest(&[1.0, 1.0], 200, score);
/// assert!((found[0] - 3.0).abs() < 1e-2 && (found[1] - 0.5).abs() < 1e-2);
/// ```
pub fn likeliest(
    start: &[f64],
    evaluations: usize,
    mut score: impl FnMut(&[f64]) -> f64,
) -> (Vec<f64>, f64) {
    let size = start.len();
    let mut used = 0;
    let mut at = |logarithms: &[f64]| {
        used += 1;
        let numbers: Vec<f64> = logarithms.iter().map(|l| l.exp()).collect();
        let score = score(&numbers);
        (
            if score.is_finite() {
                score
            } else {
                f64::NEG_INFINITY
            },
            used,
        )
    };
    let origin: Vec<f64> = start.iter().map(|v| v.ln()).collect();
    let mut corners: Vec<(Vec<f64>, f64)> = Vec::with_capacity(size + 1);
    for corner in 0..=size {
        let mut place = origin.clone();
        if let Some(moved) = corner.checked_sub(1) {
            place[moved] += 0.5;
        }
        let (score, _) = at(&place);
        corners.push((place, score));
    }
    loop {
        corners.sort_by(|a, b| b.1.total_cmp(&a.1));
        let worst = corners[size].clone();
        let centre: Vec<f64> = (0..size)
            .map(|k| corners[..size].iter().map(|c| c.0[k]).sum::<f64>() / size as f64)
            .collect();
        let along = |t: f64| -> Vec<f64> {
            let pairs = centre.iter().zip(&worst.0);
            pairs.map(|(c, w)| c + t * (w - c)).collect()
        };
        let reflected = along(-1.0);
        let (score, used) = at(&reflected);
        if score > corners[0].1 {
            let expanded = along(-2.0);
            let (further, _) = at(&expanded);
            corners[size] = if further > score {
                (expanded, further)
            } else {
                (reflected, score)
            };
        } else if score > corners[size - 1].1 {
            corners[size] = (reflected, score);
        } else {
            let contracted = along(0.5);
            let (nearer, _) = at(&contracted);
            if nearer > worst.1 {
                corners[size] = (contracted, nearer);
            } else {
                let best = corners[0].0.clone();
                for corner in corners.iter_mut().skip(1) {
                    for (place, best) in corner.0.iter_mut().zip(&best) {
                        *place = 0.5 * (*place + best);
                    }
                    corner.1 = at(&corner.0).0;
                }
            }
        }
        if used >= evaluations {
            break;
        }
    }
    corners.sort_by(|a, b| b.1.total_cmp(&a.1));
    let (place, score) = corners.swap_remove(0);
    (place.into_iter().map(f64::exp).collect(), score)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_likeliest_deviation_is_that_of_the_samples() {
        // Log-likelihood of zero-mean normal samples of variance 4, and of a second one of 0.25.
        let score = |x: &[f64]| {
            let term = |deviation: f64, variance: f64| {
                -deviation.ln() - 0.5 * variance / (deviation * deviation)
            };
            term(x[0], 4.0) + term(x[1], 0.25)
        };
        let (best, _) = likeliest(&[0.3, 3.0], 200, score);
        assert!(
            (best[0] - 2.0).abs() < 1e-3 && (best[1] - 0.5).abs() < 1e-3,
            "{best:?}"
        );
    }
}
