//! Attitude against the way that the aircraft leans: what carries it pulls along its back, and so turns its velocity.

use super::Known;
use super::axes::{centred, compare};

/// Values less the part of them that is proportional to `other`.
fn without(values: &[f64], other: &[f64]) -> Vec<f64> {
    let pairs = || {
        values
            .iter()
            .zip(other)
            .filter(|(a, b)| a.is_finite() && b.is_finite())
    };
    let square: f64 = pairs().map(|(_, b)| b * b).sum();
    let product: f64 = pairs().map(|(a, b)| a * b).sum();
    let share = if square > 0.0 { product / square } else { 0.0 };
    values
        .iter()
        .zip(other)
        .map(|(a, b)| a - share * b)
        .collect()
}

const GRAVITY: f64 = 9.806_65;
/// Acceleration over ground below which nothing can be told, m/s², root mean square.
const LEAST: f64 = 0.15;

/// Correlation of the track's acceleration with that which an attitude (roll, pitch, heading per cell) makes:
/// gravity · the horizontal part of the aircraft's back over its vertical one; and what tilt is multiplied by to make
/// it. What goes with the velocity, as drag does, is taken away before. `None` where the track hardly changes.
pub(super) fn agreement(known: &Known, [roll, pitch, heading]: [&[f64]; 3]) -> Option<(f64, f64)> {
    let count = known.grid.count;
    let change = |values: &[f64], index: usize| {
        if index == 0 || index + 1 >= count {
            f64::NAN
        } else {
            (values[index + 1] - values[index - 1]) / (2.0 * known.grid.step)
        }
    };
    let mut changes = Vec::new();
    let mut leans = Vec::new();
    let mut moves = Vec::new();
    for axis in 0..2 {
        let changed: Vec<f64> = (0..count)
            .map(|i| change(&known.velocity[axis], i))
            .collect();
        let lean = (0..count).map(|i| {
            let turn = nalgebra::Rotation3::from_euler_angles(roll[i], pitch[i], heading[i]);
            let down = turn * nalgebra::Vector3::z();
            if down.z > 0.2 {
                -GRAVITY * down[axis] / down.z
            } else {
                f64::NAN
            }
        });
        let lean: Vec<f64> = lean.collect();
        changes.extend(centred(&changed));
        leans.extend(centred(&lean));
        moves.extend(centred(&known.velocity[axis]));
    }
    let finite: Vec<f64> = changes.iter().copied().filter(|v| v.is_finite()).collect();
    let size = (finite.iter().map(|v| v * v).sum::<f64>() / finite.len().max(1) as f64).sqrt();
    let (changes, leans) = (without(&changes, &moves), without(&leans, &moves));
    let (correlation, factor, _) = compare(&changes, &leans).filter(|_| size > LEAST)?;
    Some((correlation, factor))
}
