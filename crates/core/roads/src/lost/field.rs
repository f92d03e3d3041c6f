//! Distance to the nearest road that runs in a direction, for every place of a grid.

use std::f64::consts::PI;

use pilotage_base::frames::{GroundPoint, GroundRect};

use crate::course::{between, heading, nearest_share};
use crate::segments::angle_between_directions;

/// Directions that are kept apart.
const BINS: usize = 8;
/// Greatest angle between a road and the middle of a bin to which it counts, radians.
const ALIKE: f64 = 22.0 * PI / 180.0;
/// Metres in a step of what is stored.
const QUANTUM: f32 = 0.125;
/// Distance beyond which nothing is known, metres.
pub(super) const REACH: f64 = 30.0;
/// Longest piece that is laid down at once, metres.
const PIECE: f64 = 24.0;

/// Grid of distances to roads by their direction, up to [`REACH`].
#[derive(Clone, Debug)]
pub(super) struct DirectionField {
    south: f64,
    west: f64,
    cell: f64,
    rows: usize,
    columns: usize,
    values: Vec<[u8; BINS]>,
}

/// Bin of a direction.
pub(super) fn bin(direction: f64) -> usize {
    let share = direction.rem_euclid(PI) / PI * BINS as f64;
    (share + 0.5) as usize % BINS
}

impl DirectionField {
    /// The field of straight pieces over `bounds`, in cells of `cell` metres.
    pub fn new(
        bounds: &GroundRect,
        cell: f64,
        pieces: impl Iterator<Item = [GroundPoint; 2]>,
    ) -> Self {
        let count = |extent: f64| (extent / cell).ceil().max(1.0) as usize;
        let (rows, columns) = (count(bounds.height()), count(bounds.width()));
        let mut field = Self {
            south: bounds.south,
            west: bounds.west,
            cell,
            rows,
            columns,
            values: vec![[u8::MAX; BINS]; rows * columns],
        };
        for [from, to] in pieces {
            let parts = (from.distance(&to) / PIECE).ceil().max(1.0) as usize;
            for part in 0..parts {
                let at = |k: usize| between(from, to, k as f64 / parts as f64);
                field.lay(at(part), at(part + 1));
            }
        }
        field
    }

    fn lay(&mut self, from: GroundPoint, to: GroundPoint) {
        let direction = heading(from, to);
        let mut bins = [false; BINS];
        for (index, bin) in bins.iter_mut().enumerate() {
            let middle = index as f64 * PI / BINS as f64;
            *bin = angle_between_directions(direction, middle) <= ALIKE;
        }
        let range = |low: f64, high: f64, start: f64, count: usize| {
            let first = ((low - REACH - start) / self.cell).floor().max(0.0) as usize;
            let last = ((high + REACH - start) / self.cell).ceil().max(0.0) as usize;
            first..last.min(count)
        };
        let rows = range(
            from.north.min(to.north),
            from.north.max(to.north),
            self.south,
            self.rows,
        );
        let columns = range(
            from.east.min(to.east),
            from.east.max(to.east),
            self.west,
            self.columns,
        );
        for row in rows {
            let north = self.south + (row as f64 + 0.5) * self.cell;
            for column in columns.clone() {
                let east = self.west + (column as f64 + 0.5) * self.cell;
                let place = GroundPoint::new(north, east);
                let foot = between(from, to, nearest_share(from, to, place));
                let away = foot.to_vector() - place.to_vector();
                let squared = away.norm_squared();
                if squared > REACH * REACH {
                    continue;
                }
                let value = (squared.sqrt() as f32 / QUANTUM + 0.5) as u8;
                let cell = &mut self.values[row * self.columns + column];
                for (own, is_like) in cell.iter_mut().zip(bins) {
                    if is_like {
                        *own = value.min(*own);
                    }
                }
            }
        }
    }

    /// Distance in the cell of `point` to the nearest road of that bin, metres; beyond [`REACH`] where there is none.
    pub fn rough(&self, point: GroundPoint, bin: usize) -> f32 {
        let row = (point.north - self.south) / self.cell;
        let column = (point.east - self.west) / self.cell;
        if row < 0.0 || column < 0.0 {
            return f32::from(u8::MAX) * QUANTUM;
        }
        self.value(row as usize, column as usize, bin)
    }

    fn value(&self, row: usize, column: usize, bin: usize) -> f32 {
        if row >= self.rows || column >= self.columns {
            return f32::from(u8::MAX) * QUANTUM;
        }
        f32::from(self.values[row * self.columns + column][bin]) * QUANTUM
    }

    /// Distance at `point` between the middles of the cells around it, metres.
    pub fn distance(&self, point: GroundPoint, bin: usize) -> f64 {
        let row = (point.north - self.south) / self.cell - 0.5;
        let column = (point.east - self.west) / self.cell - 0.5;
        if row < 0.0 || column < 0.0 {
            return f64::from(u8::MAX) * f64::from(QUANTUM);
        }
        let (r, c) = (row as usize, column as usize);
        let (y, x) = ((row - r as f64) as f32, (column - c as f64) as f32);
        let at = |dr, dc| self.value(r + dr, c + dc, bin);
        let low = at(0, 0) + x * (at(0, 1) - at(0, 0));
        let high = at(1, 0) + x * (at(1, 1) - at(1, 0));
        f64::from(low + y * (high - low))
    }

    /// Bytes that it takes.
    pub fn bytes(&self) -> usize {
        self.values.len() * BINS
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_distance_is_that_to_a_road_that_runs_alike() {
        let bounds = GroundRect::centered(GroundPoint::default(), 400.0, 400.0);
        let lines = [
            [GroundPoint::new(-150.0, 0.0), GroundPoint::new(150.0, 0.0)],
            [
                GroundPoint::new(20.0, -150.0),
                GroundPoint::new(20.0, 150.0),
            ],
        ];
        let field = DirectionField::new(&bounds, 5.0, lines.into_iter());
        let at = GroundPoint::new(12.0, -17.0);
        let (north, east) = (field.distance(at, bin(0.05)), field.distance(at, bin(1.6)));
        assert!((north - 17.0).abs() < 0.2, "{north}");
        assert!((east - 8.0).abs() < 0.2, "{east}");
        assert!(field.distance(at, bin(0.8)) > REACH);
        assert!(f64::from(field.rough(at, bin(3.1))) - 17.0 < 3.0);
        assert!(field.distance(GroundPoint::new(900.0, 0.0), 0) > REACH);
    }
}
