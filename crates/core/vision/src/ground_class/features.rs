//! Numbers by which the class of a cell is told.

use super::planes::CoverPlanes;
use pilotage_raster::raster::{Raster, Rgba};

/// Number of features of a cell.
pub const FEATURES: usize = 33;

/// Radii of squares over which channels are averaged, cells.
const RADII: [usize; 3] = [1, 3, 8];
/// Number of the smaller ones of these squares over which directions are averaged, too.
const DIRECTED: usize = 2;
/// Distance of the cells around that are looked at, cells.
const AWAY: isize = 4;
/// Cells around: brightness is looked at in all, colour in the first four.
const AROUND: [(isize, isize); 8] = [
    (AWAY, 0),
    (-AWAY, 0),
    (0, AWAY),
    (0, -AWAY),
    (3, 3),
    (3, -3),
    (-3, 3),
    (-3, -3),
];

/// Features of every cell of a picture.
pub struct CoverFeatures {
    planes: CoverPlanes,
}

impl CoverFeatures {
    /// Features of a picture of which a pixel shows [`CLASS_GSD`](super::CLASS_GSD) metres; clear pixels were not seen.
    pub fn of(picture: &Raster<Rgba>) -> Self {
        Self {
            planes: CoverPlanes::of(picture),
        }
    }

    /// Cells from west to east.
    pub fn width(&self) -> usize {
        self.planes.width
    }

    /// Cells from north to south.
    pub fn height(&self) -> usize {
        self.planes.height
    }

    /// Cells that were seen, row by row.
    pub fn seen(&self) -> &[bool] {
        &self.planes.seen
    }

    /// Features of the cell in `column` and `row`.
    pub fn cell(&self, column: usize, row: usize) -> [f32; FEATURES] {
        let planes = &self.planes;
        let mut features = [0.0; FEATURES];
        let mut next = 0;
        let mut add = |value: f32| {
            features[next] = value;
            next += 1;
        };
        let bright = planes.bright.get(column, row);
        let green = |c: usize, r: usize| -planes.red.get(c, r) - planes.blue.get(c, r);
        add(bright);
        add(planes.red.get(column, row));
        add(planes.blue.get(column, row));
        add(planes.texture.get(column, row));
        let boxes = RADII.map(|radius| planes.means((column, row), radius));
        for [mean, square, red, blue, texture, ..] in boxes {
            add(mean);
            add((square - mean * mean).max(0.0).sqrt());
            add(red);
            add(blue);
            add(texture);
        }
        for [.., along, across, length] in &boxes[..DIRECTED] {
            add(along.hypot(*across) / (*length + 1e-4));
        }
        let inside =
            |at: usize, step: isize, size: usize| at.saturating_add_signed(step).min(size - 1);
        for (k, (right, down)) in AROUND.into_iter().enumerate() {
            let (c, r) = (
                inside(column, right, planes.width),
                inside(row, down, planes.height),
            );
            add(planes.bright.get(c, r) - bright);
            if k < 4 {
                add(green(c, r) - green(column, row));
            }
        }
        features
    }
}
