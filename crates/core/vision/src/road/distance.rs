//! Distance to what is not set.

use pilotage_raster::raster::{Gray, Raster};

/// Distance from the middle of each set pixel to that of the nearest one that is not set, pixels; 0 where nothing is
/// set. Beyond the border nothing is known: it is no end. At most `farthest`.
///
/// Lower envelopes of parabolas along rows, then along columns (Felzenszwalb and Huttenlocher 2012).
pub(super) fn distance_inside(mask: &Raster<bool>, farthest: f32) -> Gray {
    let (width, height) = (mask.width(), mask.height());
    let most = farthest * farthest;
    let mut squares = mask.map(|set| if set { most } else { 0.0 });
    let mut envelope = Envelope::default();
    for row in 0..height {
        envelope.lower(squares.row_mut(row));
    }
    let mut column_values = vec![0.0; height];
    for column in 0..width {
        for (row, value) in column_values.iter_mut().enumerate() {
            *value = squares.get(column, row);
        }
        if column_values.iter().all(|v| *v == 0.0) {
            continue;
        }
        envelope.lower(&mut column_values);
        for (row, value) in column_values.iter().enumerate() {
            squares.set(column, row, *value);
        }
    }
    squares.map(|square| square.min(most).sqrt())
}

/// Parabolas of which none lies above the others everywhere.
#[derive(Default)]
struct Envelope {
    /// Vertex of each, place and height.
    vertices: Vec<(f32, f32)>,
    /// Place from which each is the lowest.
    starts: Vec<f32>,
}

impl Envelope {
    /// Replaces values f(q) by the least of f(q') + (q - q')² over all q'.
    fn lower(&mut self, values: &mut [f32]) {
        self.vertices.clear();
        self.starts.clear();
        for (place, &height) in values.iter().enumerate() {
            let place = place as f32;
            let mut start = f32::NEG_INFINITY;
            while let (Some(&(other, low)), Some(&from)) =
                (self.vertices.last(), self.starts.last())
            {
                start =
                    ((height + place * place) - (low + other * other)) / (2.0 * (place - other));
                if start > from {
                    break;
                }
                self.vertices.pop();
                self.starts.pop();
                start = f32::NEG_INFINITY;
            }
            self.vertices.push((place, height));
            self.starts.push(start);
        }
        let mut which = 0;
        for (place, value) in values.iter_mut().enumerate() {
            let place = place as f32;
            while self
                .starts
                .get(which + 1)
                .is_some_and(|start| *start < place)
            {
                which += 1;
            }
            let (vertex, height) = self.vertices[which];
            *value = height + (place - vertex) * (place - vertex);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_of_a_search_through_all_pixels() {
        let mut state = 7_u32;
        let mask = Raster::from_fn(41, 29, |_, _| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            !(state >> 8).is_multiple_of(60)
        });
        let found = distance_inside(&mask, 30.0);
        for y in 0..29 {
            for x in 0..41 {
                let mut least = 900.0_f32;
                for row in 0..29 {
                    for column in 0..41 {
                        if !mask.get(column, row) {
                            let (dx, dy) = (column as f32 - x as f32, row as f32 - y as f32);
                            least = least.min(dx * dx + dy * dy);
                        }
                    }
                }
                assert!((found.get(x, y) - least.sqrt()).abs() < 1e-4, "{x} {y}");
            }
        }
        let all = distance_inside(&Raster::filled(5, 4, true), 12.0);
        assert!(all.pixels().iter().all(|d| *d == 12.0));
    }
}
