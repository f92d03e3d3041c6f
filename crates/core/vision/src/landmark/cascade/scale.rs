//! Smaller copies of a picture, to the bit as OpenCV's `INTER_LINEAR_EXACT` makes them: weights of eight
//! bits, rounded to the nearest, halves to the even one.

use super::simd;
use pilotage_raster::raster::Raster;

/// For each pixel of the copy, the first of two source pixels and the weight of the second, of 256;
/// that is zero where there is no second.
fn weights(from: usize, to: usize) -> Vec<(u32, u16)> {
    let scale = from as f64 / to as f64;
    (0..to)
        .map(|i| {
            let place = scale * (i as f64 + 0.5) - 0.5;
            let first = place.floor();
            if first < 0.0 || from < 2 {
                (0, 0)
            } else if first as usize >= from - 1 {
                (from as u32 - 1, 0)
            } else {
                let weight = ((place - first) * 256.0).round_ties_even();
                (first as u32, weight as u16)
            }
        })
        .collect()
}

/// The picture in another size, bilinear.
pub(super) fn resized(picture: &Raster<u8>, width: usize, height: usize) -> Raster<u8> {
    if (width, height) == (picture.width(), picture.height()) {
        return picture.clone();
    }
    let across = weights(picture.width(), width);
    let down = weights(picture.height(), height);
    let mut padded = Vec::new();
    let mut line = |y: usize, out: &mut [u16]| {
        padded.clear();
        padded.extend_from_slice(picture.row(y));
        padded.push(0);
        for (out, &(x, weight)) in out.iter_mut().zip(&across) {
            if let [first, second, ..] = padded[x as usize..] {
                *out = (256 - weight) * u16::from(first) + weight * u16::from(second);
            }
        }
    };
    let mut copy = Raster::filled(width, height, 0);
    let (mut upper, mut lower) = (vec![0; width], vec![0; width]);
    let (mut in_upper, mut in_lower) = (usize::MAX, usize::MAX);
    for (row, &(y, weight)) in down.iter().enumerate() {
        let y = y as usize;
        let below = (y + 1).min(picture.height() - 1);
        if in_upper != y {
            std::mem::swap(&mut upper, &mut lower);
            std::mem::swap(&mut in_upper, &mut in_lower);
        }
        if in_upper != y {
            line(y, &mut upper);
            in_upper = y;
        }
        if in_lower != below {
            line(below, &mut lower);
            in_lower = below;
        }
        simd::blend(&upper, &lower, u32::from(weight), copy.row_mut(row));
    }
    copy
}
