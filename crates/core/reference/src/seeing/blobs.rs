//! Connected cells.

use pilotage_raster::raster::Gray;

/// A set of connected cells, and the moments of what they weigh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Blob {
    /// Number of cells.
    pub cells: usize,
    /// Sum of their weights.
    pub weight: f64,
    /// Mean place: column and row of cells, middles at half integers.
    pub middle: [f64; 2],
    /// Second moments about it: columns, both, rows.
    pub spread: [f64; 3],
    /// Whether it ends only where cells are known that are not part of it.
    pub whole: bool,
}

/// Sets of cells with a weight of at least `least`, connected along their sides, of all that are `known`.
pub fn blobs(weights: &Gray, known: &[bool], least: f32) -> Vec<Blob> {
    let (width, height) = (weights.width(), weights.height());
    let mut is_left: Vec<bool> = weights.pixels().iter().map(|w| *w >= least).collect();
    let mut found = Vec::new();
    let mut stack = Vec::new();
    for start in 0..is_left.len() {
        if !is_left[start] {
            continue;
        }
        is_left[start] = false;
        stack.push(start);
        let mut blob = Blob {
            whole: true,
            ..Blob::default()
        };
        let (mut sums, mut squares) = ([0.0; 2], [0.0; 3]);
        while let Some(at) = stack.pop() {
            let (column, row) = (at % width, at / width);
            let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
            let weight = f64::from(weights.pixels()[at]);
            blob.cells += 1;
            blob.weight += weight;
            sums = [sums[0] + weight * x, sums[1] + weight * y];
            squares[0] += weight * x * x;
            squares[1] += weight * x * y;
            squares[2] += weight * y * y;
            let is_at_rim = column == 0 || row == 0 || column + 1 == width || row + 1 == height;
            if is_at_rim {
                blob.whole = false;
            }
            let beside = [
                (column > 0).then(|| at - 1),
                (column + 1 < width).then_some(at + 1),
                (row > 0).then(|| at.saturating_sub(width)),
                (row + 1 < height).then_some(at + width),
            ];
            for next in beside.into_iter().flatten() {
                blob.whole &= known[next];
                if is_left[next] {
                    is_left[next] = false;
                    stack.push(next);
                }
            }
        }
        let [x, y] = sums.map(|sum| sum / blob.weight);
        blob.middle = [x, y];
        blob.spread = [
            squares[0] / blob.weight - x * x,
            squares[1] / blob.weight - x * y,
            squares[2] / blob.weight - y * y,
        ];
        found.push(blob);
    }
    found
}

impl Blob {
    /// Direction of the longer axis, radians clockwise from north, 0 to less than π, of cells whose rows go south.
    pub fn orientation(&self) -> f64 {
        let [across, both, along] = self.spread;
        // North is up: the moment of north and east is minus that of row and column.
        let twice = (-2.0 * both).atan2(along - across);
        (0.5 * twice).rem_euclid(std::f64::consts::PI)
    }
}
