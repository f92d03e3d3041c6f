//! Connected pixels and their shape.

use pilotage_raster::raster::Raster;

/// Pixels that touch each other by sides or corners.
#[derive(Clone, Debug, PartialEq)]
pub struct BlobShape {
    /// Pixels (column, row).
    pub pixels: Vec<[u32; 2]>,
    /// Longer axis of the ellipse with the same second moments, pixels.
    pub major_axis: f64,
    /// Shorter axis of it, pixels.
    pub minor_axis: f64,
}

/// The mask with every set pixel spread over a square of `side` pixels (odd) around it.
pub fn dilated(mask: &Raster<bool>, side: usize) -> Raster<bool> {
    let reach = side / 2;
    let across = spread(mask, |x, y| {
        let last = (x + reach).min(mask.width() - 1);
        mask.row(y)[x.saturating_sub(reach)..=last].contains(&true)
    });
    spread(&across, |x, y| {
        let last = (y + reach).min(mask.height() - 1);
        (y.saturating_sub(reach)..=last).any(|row| across.get(x, row))
    })
}

fn spread(mask: &Raster<bool>, is_set: impl Fn(usize, usize) -> bool) -> Raster<bool> {
    Raster::from_fn(mask.width(), mask.height(), is_set)
}

/// The blobs of a mask, in the order of their first pixels row by row.
pub fn blobs(mask: &Raster<bool>) -> Vec<BlobShape> {
    let mut left = mask.clone();
    let mut all = Vec::new();
    for row in 0..mask.height() {
        for column in 0..mask.width() {
            if left.get(column, row) {
                all.push(shape(take(&mut left, [column as u32, row as u32])));
            }
        }
    }
    all
}

/// Takes what is connected with `first` out of the mask.
fn take(left: &mut Raster<bool>, first: [u32; 2]) -> Vec<[u32; 2]> {
    left.set(first[0] as usize, first[1] as usize, false);
    let mut pixels = vec![first];
    let mut next = 0;
    while let Some(&[x, y]) = pixels.get(next) {
        next += 1;
        let (x, y) = (x as usize, y as usize);
        for row in y.saturating_sub(1)..(y + 2).min(left.height()) {
            for column in x.saturating_sub(1)..(x + 2).min(left.width()) {
                if left.get(column, row) {
                    left.set(column, row, false);
                    pixels.push([column as u32, row as u32]);
                }
            }
        }
    }
    pixels
}

/// Axes of the ellipse whose second moments are those of the pixels, each pixel a unit square (moment 1/12).
fn shape(pixels: Vec<[u32; 2]>) -> BlobShape {
    let count = pixels.len() as f64;
    let mean = |axis: usize| pixels.iter().map(|p| f64::from(p[axis])).sum::<f64>() / count;
    let (mean_x, mean_y) = (mean(0), mean(1));
    let [mut xx, mut xy, mut yy] = [0.0; 3];
    for &[x, y] in &pixels {
        let (dx, dy) = (f64::from(x) - mean_x, f64::from(y) - mean_y);
        xx += dx * dx;
        xy += dx * dy;
        yy += dy * dy;
    }
    let (xx, xy, yy) = (xx / count + 1.0 / 12.0, xy / count, yy / count + 1.0 / 12.0);
    let root = ((xx - yy).powi(2) + 4.0 * xy * xy).sqrt();
    let axis = |moment: f64| 8.0_f64.sqrt() * moment.max(0.0).sqrt();
    BlobShape {
        major_axis: axis(xx + yy + root),
        minor_axis: axis(xx + yy - root),
        pixels,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dot_spreads_over_a_square_cut_at_the_border() {
        let mut mask = Raster::filled(9, 7, false);
        mask.set(1, 3, true);
        let spread = dilated(&mask, 5);
        for y in 0..7 {
            for x in 0..9 {
                assert_eq!(spread.get(x, y), x <= 3 && (1..=5).contains(&y), "{x} {y}");
            }
        }
    }

    #[test]
    fn corners_connect_and_gaps_do_not() {
        let rows = ["##...#", "..#...", "......", "#....#"];
        let mask = Raster::from_fn(6, 4, |x, y| rows[y].as_bytes()[x] == b'#');
        let sizes: Vec<usize> = blobs(&mask).iter().map(|b| b.pixels.len()).collect();
        assert_eq!(sizes, [3, 1, 1, 1]);
    }

    /// A rectangle of n by m unit squares has the second moments n²/12 and m²/12: axes 4 n/√12 and 4 m/√12.
    #[test]
    fn a_rectangle_has_the_axes_of_its_moments() {
        let mask = Raster::from_fn(60, 20, |x, y| (5..45).contains(&x) && (4..10).contains(&y));
        let blob = &blobs(&mask)[0];
        assert!((blob.major_axis - 160.0 / 12_f64.sqrt()).abs() < 1e-9);
        assert!((blob.minor_axis - 24.0 / 12_f64.sqrt()).abs() < 1e-9);
    }
}
