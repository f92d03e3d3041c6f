//! Dense orientation fields: how strongly edges run in each direction, pixel by pixel.
//!
//! What two pictures of one place on different dates, by different sensors, have in common is where the edges
//! are and how they run, not which side of them is bright. So the gradient counts without its sign, in units of
//! what is usual around it, divided over eight directions; the family is that of channel features of oriented
//! gradients (Ye et al. 2019, CFOG).

use super::{Gradient, Gray, blur_interleaved, gaussian_blur};

/// Directions, π / 8 apart.
pub const DIRECTIONS: usize = 8;
/// Standard deviation of the surroundings that decide what is a strong edge, pixels.
const SURROUNDINGS: f64 = 8.0;
/// Gradient that is noise, grey levels per pixel.
const NOISE: f32 = 0.5;
/// Edges stronger than so many times the usual count as that.
const STRONGEST: f32 = 3.0;
/// Standard deviation over which edges are spread, pixels: what differs less in place is alike.
const SPREAD: f64 = 1.2;

/// The orientation field of a picture: one channel for each direction.
#[derive(Clone, Debug, PartialEq)]
pub struct OrientationField {
    /// Strength of edges whose gradient points to k π / [`DIRECTIONS`], from right towards down, without sign;
    /// zero where nothing is covered.
    pub channels: Vec<Gray>,
    /// Cover that is one where the field is known, else zero.
    pub covered: Gray,
}

impl OrientationField {
    /// Of the part of a picture that is `covered` (one, else zero), a pixel inside its edges.
    pub fn new(luminance: &Gray, covered: &Gray) -> Self {
        let (width, height) = (luminance.width(), luminance.height());
        let covered = eroded(covered);
        let gradient = Gradient::sobel(luminance);
        let mut strength = gradient.magnitude();
        for (value, cover) in strength.pixels_mut().iter_mut().zip(covered.pixels()) {
            *value *= cover;
        }
        let (usual, cover) = (
            gaussian_blur(&strength, SURROUNDINGS),
            gaussian_blur(&covered, SURROUNDINGS),
        );
        let mut channels = vec![Gray::filled(width, height, 0.0); DIRECTIONS];
        for (index, &strength) in strength.pixels().iter().enumerate() {
            if strength <= 0.0 {
                continue;
            }
            let usual = usual.pixels()[index] / cover.pixels()[index].max(1e-6);
            let relative = (strength / (usual + NOISE)).min(STRONGEST);
            let direction = undirected(gradient.x.pixels()[index], gradient.y.pixels()[index]);
            let place = direction * (DIRECTIONS as f32 / std::f32::consts::PI);
            let low = (place as usize).min(DIRECTIONS - 1);
            let part = place - low as f32;
            channels[low].pixels_mut()[index] += relative * (1.0 - part);
            channels[(low + 1) % DIRECTIONS].pixels_mut()[index] += relative * part;
        }
        for channel in &mut channels {
            blur_interleaved(channel.pixels_mut(), width, 1, SPREAD);
        }
        // A place where two edges meet does not count twice.
        let mut scales = vec![0.0_f32; width * height];
        for channel in &channels {
            for (sum, &value) in scales.iter_mut().zip(channel.pixels()) {
                *sum += value * value;
            }
        }
        for (scale, &cover) in scales.iter_mut().zip(covered.pixels()) {
            *scale = cover / (scale.sqrt() + 1e-3).sqrt();
        }
        for channel in &mut channels {
            for (value, &scale) in channel.pixels_mut().iter_mut().zip(&scales) {
                *value *= scale;
            }
        }
        Self { channels, covered }
    }
}

/// The part of a cover of which all eight neighbours are covered as well.
fn eroded(covered: &Gray) -> Gray {
    let width = covered.width();
    if covered.pixels().iter().all(|&c| c == 1.0) {
        return covered.clone();
    }
    // Whole rows at a time, by vector instructions.
    let mut across = covered.map(|cover| cover.min(1.0));
    for (row, of) in across
        .pixels_mut()
        .chunks_mut(width)
        .zip(covered.pixels().chunks(width))
    {
        lower(&mut row[1..], of);
        lower(row, &of[1..]);
    }
    let mut least = across.clone();
    lower(&mut least.pixels_mut()[width..], across.pixels());
    lower(least.pixels_mut(), &across.pixels()[width..]);
    least
}

/// Each value, or the other in its place where that is less; as many as the shorter has.
fn lower(values: &mut [f32], others: &[f32]) {
    for (value, &other) in values.iter_mut().zip(others) {
        *value = value.min(other);
    }
}

/// The angle of (x, y) without its sign, 0 up to π, within 0.004.
fn undirected(x: f32, y: f32) -> f32 {
    use std::f32::consts::{FRAC_PI_2, PI};
    // Turned by half a turn, y is not negative.
    let (x, y) = if y < 0.0 { (-x, -y) } else { (x, y) };
    let (small, large) = (x.abs().min(y), x.abs().max(y));
    let ratio = if large > 0.0 { small / large } else { 0.0 };
    let square = ratio * ratio;
    let octant = ratio * (0.995_354 - square * (0.288_679 - square * 0.079_331));
    let quadrant = if y > x.abs() {
        FRAC_PI_2 - octant
    } else {
        octant
    };
    let half = if x < 0.0 { PI - quadrant } else { quadrant };
    if half >= PI { half - PI } else { half }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whole(width: usize, height: usize) -> Gray {
        Gray::filled(width, height, 1.0)
    }

    #[test]
    fn the_angle_is_that_of_the_arc_tangent_without_sign() {
        for step in 0..720 {
            let angle = f32::to_radians(step as f32 * 0.5);
            let own = undirected(angle.cos(), angle.sin());
            let expected = angle.rem_euclid(std::f32::consts::PI);
            let off = (own - expected).abs();
            let off = off.min(std::f32::consts::PI - off);
            assert!(off < 0.004, "{angle}: {own} {expected}");
        }
    }

    #[test]
    fn brightness_contrast_and_which_side_is_bright_do_not_matter() {
        let picture = Gray::from_fn(60, 50, |x, y| {
            40.0 + 60.0 * f32::from(u8::from((x / 9 + y / 7) % 2 == 0)) + (x * y % 5) as f32
        });
        let other = picture.map(|v| 230.0 - 1.4 * v);
        let one = OrientationField::new(&picture, &whole(60, 50));
        let two = OrientationField::new(&other, &whole(60, 50));
        for (a, b) in one.channels.iter().zip(&two.channels) {
            for (a, b) in a.pixels().iter().zip(b.pixels()) {
                assert!((a - b).abs() < 0.05, "{a} {b}");
            }
        }
    }

    #[test]
    fn an_upright_edge_is_in_the_first_channel_and_a_slanting_one_in_the_third() {
        let strongest = |picture: &Gray| {
            let field = OrientationField::new(picture, &whole(40, 40));
            let at = |k: usize| field.channels[k].get(20, 20);
            (0..DIRECTIONS).max_by(|a, b| at(*a).total_cmp(&at(*b)))
        };
        let upright = Gray::from_fn(40, 40, |x, _| if x < 20 { 20.0 } else { 90.0 });
        let slanting = Gray::from_fn(40, 40, |x, y| if x + y < 40 { 20.0 } else { 90.0 });
        assert_eq!(
            (strongest(&upright), strongest(&slanting)),
            (Some(0), Some(2))
        );
    }

    #[test]
    fn a_cover_is_left_where_all_neighbours_are_covered() {
        for (width, height) in [(1, 1), (1, 5), (7, 1), (2, 2), (13, 9)] {
            let covered = Gray::from_fn(width, height, |x, y| {
                f32::from(u8::from((x * x + 3 * y) % 11 != 4))
            });
            let by_hand = Gray::from_fn(width, height, |x, y| {
                let columns = x.saturating_sub(1)..(x + 2).min(width);
                let around = columns.flat_map(|x| {
                    let rows = y.saturating_sub(1)..(y + 2).min(height);
                    rows.map(move |y| (x, y))
                });
                let is_whole = { around }.all(|(x, y)| covered.get(x, y) == 1.0);
                f32::from(u8::from(is_whole))
            });
            assert_eq!(eroded(&covered), by_hand, "{width} by {height}");
        }
    }

    #[test]
    fn what_is_not_covered_leaves_no_edge() {
        let covered = Gray::from_fn(40, 40, |x, _| if x < 25 { 1.0 } else { 0.0 });
        let even = Gray::from_fn(40, 40, |x, _| if x < 25 { 120.0 } else { 0.0 });
        let field = OrientationField::new(&even, &covered);
        assert!(
            field
                .channels
                .iter()
                .all(|c| c.pixels().iter().all(|&v| v == 0.0))
        );
        assert_eq!(field.covered.row(20)[22..26], [1.0, 1.0, 0.0, 0.0]);
    }
}
