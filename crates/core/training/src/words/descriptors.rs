//! Descriptors of the surroundings of places on a grid, as those of SURF (Bay et al. 2008): sums of the parts of the
//! gradient and of their amounts in four by four cells, turned to where most of it points.

use pilotage_raster::raster::{Gradient, Gray, gaussian_blur};
use std::f32::consts::TAU;

/// Numbers of a descriptor.
pub const DESCRIPTOR: usize = 64;
/// Descriptor of a place, of length one.
pub type WordDescriptor = [f32; DESCRIPTOR];

/// Sides of the squares that are described, pixels.
const SIDES: [f32; 3] = [16.0, 24.0, 36.0];
/// Distance of places, pixels.
const STEP: usize = 6;
/// Samples along the side of a square, and those of a cell.
const SAMPLES: usize = 20;
const CELL: usize = 5;
/// Directions that are told apart when the strongest is sought.
const TURNS: usize = 36;
/// Share of the descriptors of a window that is kept, those of the strongest gradients.
const KEPT: f64 = 0.8;

/// Descriptors of a window.
pub fn descriptors_of(window: &Gray) -> Vec<WordDescriptor> {
    let mut found: Vec<(f32, WordDescriptor)> = Vec::new();
    for side in SIDES {
        let gradient = Gradient::sobel(&gaussian_blur(window, f64::from(side / SAMPLES as f32)));
        let half = (0.5 * side) as usize;
        for row in (half..window.height().saturating_sub(half)).step_by(STEP) {
            for column in (half..window.width().saturating_sub(half)).step_by(STEP) {
                found.extend(described(&gradient, [column as f32, row as f32], side));
            }
        }
    }
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    let kept = (KEPT * found.len() as f64).ceil() as usize;
    found.into_iter().take(kept).map(|(_, d)| d).collect()
}

/// Strength and descriptor of a place; `None` where nothing changes.
fn described(gradient: &Gradient, [x, y]: [f32; 2], side: f32) -> Option<(f32, WordDescriptor)> {
    let spacing = side / SAMPLES as f32;
    let middle = 0.5 * (SAMPLES - 1) as f32;
    let (width, height) = (gradient.x.width(), gradient.x.height());
    let at = |u: f32, v: f32| {
        let inside = |place: f32, size: usize| (place.max(0.0) as usize).min(size - 1);
        let (column, row) = (inside(x + u, width), inside(y + v, height));
        [gradient.x.get(column, row), gradient.y.get(column, row)]
    };
    let weight = |i: usize, j: usize| {
        let (u, v) = (i as f32 - middle, j as f32 - middle);
        (-(u * u + v * v) / (0.66 * SAMPLES as f32 * 0.66 * SAMPLES as f32)).exp()
    };
    let mut turns = [0.0_f32; TURNS];
    for i in 0..SAMPLES {
        for j in 0..SAMPLES {
            let [gx, gy] = at((i as f32 - middle) * spacing, (j as f32 - middle) * spacing);
            let turn = gy.atan2(gx).rem_euclid(TAU) / TAU * TURNS as f32;
            turns[turn as usize % TURNS] += weight(i, j) * gx.hypot(gy);
        }
    }
    let evened = |k: usize| turns[(k + TURNS - 1) % TURNS] + turns[k] + turns[(k + 1) % TURNS];
    let strongest = (0..TURNS).max_by(|a, b| evened(*a).total_cmp(&evened(*b)))?;
    let (sin, cos) = ((strongest as f32 + 0.5) / TURNS as f32 * TAU).sin_cos();
    let mut descriptor = [0.0; DESCRIPTOR];
    for i in 0..SAMPLES {
        for j in 0..SAMPLES {
            let (u, v) = ((i as f32 - middle) * spacing, (j as f32 - middle) * spacing);
            let [gx, gy] = at(u * cos - v * sin, u * sin + v * cos);
            let weight = weight(i, j);
            let (along, across) = (
                weight * (gx * cos + gy * sin),
                weight * (gy * cos - gx * sin),
            );
            let cell = 4 * (i / CELL * (SAMPLES / CELL) + j / CELL);
            let parts = [along, across, along.abs(), across.abs()];
            for (sum, part) in descriptor[cell..].iter_mut().zip(parts) {
                *sum += part;
            }
        }
    }
    let length = descriptor.iter().map(|d| d * d).sum::<f32>().sqrt();
    (length > 1e-3).then(|| (length, descriptor.map(|d| d / length)))
}
