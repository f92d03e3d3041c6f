//! Smaller copies of a picture, to the bit as OpenCV's `INTER_LINEAR_EXACT` makes them: weights of eight
//! bits, rounded to the nearest, halves to the even one.

use crate::raster::Raster;

/// For each pixel of the copy, the first of two source pixels and the weight of the second, of 256.
fn weights(from: usize, to: usize) -> Vec<(usize, u32)> {
    let scale = from as f64 / to as f64;
    (0..to)
        .map(|i| {
            let place = scale * (i as f64 + 0.5) - 0.5;
            let first = place.floor();
            if first < 0.0 || from < 2 {
                (0, 0)
            } else if first as usize >= from - 1 {
                (from - 1, 0)
            } else {
                let weight = ((place - first) * 256.0).round_ties_even();
                (first as usize, weight as u32)
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
    let line = |y: usize, out: &mut Vec<u32>| {
        let row = picture.row(y);
        out.clear();
        out.extend(across.iter().map(|&(x, weight)| {
            let second = u32::from(row[(x + 1).min(row.len() - 1)]);
            (256 - weight) * u32::from(row[x]) + weight * second
        }));
    };
    let mut pixels = Vec::with_capacity(width * height);
    let (mut upper, mut lower) = (Vec::new(), Vec::new());
    let mut held = None;
    for &(y, weight) in &down {
        let below = (y + 1).min(picture.height() - 1);
        if held != Some(y) {
            line(y, &mut upper);
            line(below, &mut lower);
            held = Some(y);
        }
        pixels.extend(upper.iter().zip(&lower).map(|(a, b)| {
            let value = (256 - weight) * a + weight * b;
            ((value + (1 << 15)) >> 16) as u8
        }));
    }
    Raster::from_pixels(width, height, pixels).unwrap_or_else(|| Raster::filled(0, 0, 0))
}
