//! Sums over rectangles of a picture.

use super::grid::RowGrid;
use pilotage_raster::raster::Raster;

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
    /// Fills the tables for a picture.
    pub fn fill(
        &mut self,
        picture: &Raster<u8>,
        grid: RowGrid,
        with_squares: bool,
        with_tilted: bool,
    ) {
        if with_squares {
            sums_and_squares(picture, grid, &mut self.sum, &mut self.squares);
        } else {
            sums(picture, grid, &mut self.sum);
        }
        if with_tilted {
            tilted(picture, grid, &mut self.tilted);
        }
    }
}

fn sums(picture: &Raster<u8>, grid: RowGrid, table: &mut Vec<i32>) {
    grid.prepare(picture.height(), table);
    let mut line = vec![0_i32; picture.width() + 1];
    for y in 0..picture.height() {
        let mut running = 0_i32;
        for (sum, &pixel) in line[1..].iter_mut().zip(picture.row(y)) {
            running = running.wrapping_add(i32::from(pixel));
            *sum = sum.wrapping_add(running);
        }
        grid.store(&line, y + 1, table);
    }
}

/// Both tables in one go: each addition waits for the one before, and two rows of them wait together.
fn sums_and_squares(
    picture: &Raster<u8>,
    grid: RowGrid,
    table: &mut Vec<i32>,
    squares: &mut Vec<i32>,
) {
    grid.prepare(picture.height(), table);
    grid.prepare(picture.height(), squares);
    let mut line = vec![0_i32; picture.width() + 1];
    let mut line_of_squares = line.clone();
    for y in 0..picture.height() {
        let (mut running, mut running_squares) = (0_i32, 0_i32);
        let sums = line[1..].iter_mut().zip(&mut line_of_squares[1..]);
        for ((sum, square), &pixel) in sums.zip(picture.row(y)) {
            let pixel = i32::from(pixel);
            running = running.wrapping_add(pixel);
            running_squares = running_squares.wrapping_add(pixel * pixel);
            *sum = sum.wrapping_add(running);
            *square = square.wrapping_add(running_squares);
        }
        grid.store(&line, y + 1, table);
        grid.store(&line_of_squares, y + 1, squares);
    }
}

/// Entry (x, y): the sum of the pixels (i, j) with j < y and |i - x + 1| ≤ y - j - 1 (Lienhart 2002).
fn tilted(picture: &Raster<u8>, grid: RowGrid, table: &mut Vec<i32>) {
    let (width, height) = (picture.width(), picture.height());
    grid.prepare(height, table);
    // T(x, y) = T(x-1, y-1) + T(x+1, y-1) - T(x, y-2) + I(x-1, y-1) + I(x-1, y-2). What of T(-1, y-1)
    // lies in the picture is T(0, y-2), and what of T(width+1, y-1) does is T(width, y-2).
    let mut before = vec![0_i32; width + 1];
    let mut last = vec![0_i32; width + 1];
    let mut next = vec![0_i32; width + 1];
    let nothing = vec![0_u8; width];
    for y in 1..=height {
        let own = picture.row(y - 1);
        let above = if y > 1 { picture.row(y - 2) } else { &nothing };
        next[0] = last[1];
        for x in 1..width {
            next[x] = last[x - 1]
                .wrapping_add(last[x + 1])
                .wrapping_sub(before[x])
                .wrapping_add(i32::from(own[x - 1]) + i32::from(above[x - 1]));
        }
        next[width] =
            last[width - 1].wrapping_add(i32::from(own[width - 1]) + i32::from(above[width - 1]));
        grid.store(&next, y, table);
        std::mem::swap(&mut before, &mut last);
        std::mem::swap(&mut last, &mut next);
    }
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
        for step in [1, 2] {
            check(&picture, RowGrid::new(9, step));
        }
    }

    fn check(picture: &Raster<u8>, grid: RowGrid) {
        let mut integral = Integral::default();
        integral.fill(picture, grid, true, true);
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
                let at = grid.place(x as usize, y as usize);
                assert_eq!(integral.sum[at], sum);
                assert_eq!(integral.squares[at], squares);
                assert_eq!(integral.tilted[at], tilted, "{x} {y}");
            }
        }
    }
}
