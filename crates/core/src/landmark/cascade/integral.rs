//! Sums over rectangles of a picture.

use crate::raster::Raster;

/// Sums of all pixels above and to the left of each corner, in a table of one column and one row more
/// than the picture. They may overflow: differences of them do not.
#[derive(Clone, Debug, Default)]
pub(super) struct Integral {
    /// Sums of the pixels.
    pub sum: Vec<i32>,
    /// Sums of their squares.
    pub squares: Vec<i32>,
    /// Sums over the triangle above each corner that opens upward by 45° to both sides; empty if no
    /// feature asks for it.
    pub tilted: Vec<i32>,
}

impl Integral {
    /// Of a picture.
    pub fn of(picture: &Raster<u8>, with_squares: bool, with_tilted: bool) -> Self {
        let (width, height) = (picture.width(), picture.height());
        let stride = width + 1;
        let mut sum = vec![0_i32; stride * (height + 1)];
        let mut squares = vec![0_i32; if with_squares { sum.len() } else { 0 }];
        for y in 0..height {
            let (above, own) = sum.split_at_mut((y + 1) * stride);
            let above = &above[y * stride..];
            let mut running = 0_i32;
            for (x, &pixel) in picture.row(y).iter().enumerate() {
                running = running.wrapping_add(i32::from(pixel));
                own[x + 1] = above[x + 1].wrapping_add(running);
            }
            if with_squares {
                let (above, own) = squares.split_at_mut((y + 1) * stride);
                let above = &above[y * stride..];
                let mut running = 0_i32;
                for (x, &pixel) in picture.row(y).iter().enumerate() {
                    running = running.wrapping_add(i32::from(pixel) * i32::from(pixel));
                    own[x + 1] = above[x + 1].wrapping_add(running);
                }
            }
        }
        let tilted = if with_tilted {
            tilted(picture)
        } else {
            Vec::new()
        };
        Self {
            sum,
            squares,
            tilted,
        }
    }
}

/// Entry (x, y): the sum of the pixels (i, j) with j < y and |i - x + 1| ≤ y - j - 1 (Lienhart 2002).
fn tilted(picture: &Raster<u8>) -> Vec<i32> {
    let (width, height) = (picture.width(), picture.height());
    let stride = width + 1;
    let mut table = vec![0_i32; stride * (height + 1)];
    let pixel = |x: isize, y: isize| {
        let inside = x >= 0 && y >= 0 && (x as usize) < width && (y as usize) < height;
        if inside {
            i32::from(picture.row(y as usize)[x as usize])
        } else {
            0
        }
    };
    // T(x, y) = T(x-1, y-1) + T(x+1, y-1) - T(x, y-2) + I(x-1, y-1) + I(x-1, y-2); beyond the right
    // edge the triangles are kept in one more column per side.
    let margin = height + 2;
    let wide = width + 1 + 2 * margin;
    let mut before = vec![0_i32; wide];
    let mut last = vec![0_i32; wide];
    for y in 1..=height as isize {
        let mut next = vec![0_i32; wide];
        for i in 1..wide - 1 {
            let x = i as isize - margin as isize;
            next[i] = last[i - 1]
                .wrapping_add(last[i + 1])
                .wrapping_sub(before[i])
                .wrapping_add(pixel(x - 1, y - 1))
                .wrapping_add(pixel(x - 1, y - 2));
        }
        table[y as usize * stride..][..stride].copy_from_slice(&next[margin..][..stride]);
        before = last;
        last = next;
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture() -> Raster<u8> {
        Raster::from_fn(9, 7, |x, y| ((x * 37 + y * 91 + x * y * 11) % 251) as u8)
    }

    #[test]
    fn the_tables_are_the_sums_that_they_are_said_to_be() {
        let picture = picture();
        let integral = Integral::of(&picture, true, true);
        for y in 0..=7_i32 {
            for x in 0..=9_i32 {
                let (mut sum, mut squares, mut tilted) = (0, 0, 0);
                for j in 0..7 {
                    for i in 0..9 {
                        let value = i32::from(picture.row(j as usize)[i as usize]);
                        if i < x && j < y {
                            sum += value;
                            squares += value * value;
                        }
                        if j < y && (i - x + 1).abs() < y - j {
                            tilted += value;
                        }
                    }
                }
                let at = y as usize * 10 + x as usize;
                assert_eq!(integral.sum[at], sum);
                assert_eq!(integral.squares[at], squares);
                assert_eq!(integral.tilted[at], tilted, "{x} {y}");
            }
        }
    }
}
