//! Grid of the objects that can matter at a place: square cells with lists of object numbers.

use super::noise::floor;
use super::shape::Spot;

/// Half the side of the scenery, metres.
pub(super) const REACH: f32 = 1200.0;
const CELL: f32 = 8.0;
const SIDE: i32 = (2.0 * REACH / CELL) as i32;

/// Cell lists of one kind of object, in the objects' order.
#[derive(Clone, Debug, Default)]
pub(super) struct CellLists {
    starts: Vec<u32>,
    items: Vec<u32>,
}

/// Number of the cell of a place, if it lies inside the scenery.
#[inline]
pub(super) fn cell_of(p: Spot) -> Option<usize> {
    let row = floor((p.n + REACH) * (1.0 / CELL));
    let column = floor((p.e + REACH) * (1.0 / CELL));
    ((0..SIDE).contains(&row) && (0..SIDE).contains(&column))
        .then_some((row * SIDE + column) as usize)
}

/// Centres of all cells in the order of their numbers, and how far the places of a cell are from its centre at most,
/// metres.
pub(super) fn cells() -> impl Iterator<Item = (Spot, f32)> {
    let middle = |i: i32| (i as f32 + 0.5) * CELL - REACH;
    let centers = (0..SIDE * SIDE).map(move |i| Spot {
        n: middle(i / SIDE),
        e: middle(i % SIDE),
    });
    // A little more than half the diagonal, as places are rounded.
    centers.map(|center| (center, 0.7072 * CELL + 0.05))
}

impl CellLists {
    /// Lists every object in the cells that its corners' bounding box, grown by `margin`, touches
    /// and that `keeps` (given the cell's centre and half diagonal) does not rule out.
    pub(super) fn new<T>(
        objects: &[T],
        margin: f32,
        corners: impl Fn(&T) -> Vec<Spot>,
        keeps: impl Fn(&T, Spot, f32) -> bool,
    ) -> Self {
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        let index = |x: f32| (((x + REACH) / CELL).floor() as i32).clamp(0, SIDE - 1);
        for (number, object) in objects.iter().enumerate() {
            let corners = corners(object);
            let fold = |f: fn(f32, f32) -> f32, of: fn(&Spot) -> f32| {
                corners.iter().map(of).reduce(f).unwrap_or(0.0)
            };
            let (south, north) = (fold(f32::min, |c| c.n), fold(f32::max, |c| c.n));
            let (west, east) = (fold(f32::min, |c| c.e), fold(f32::max, |c| c.e));
            if north + margin < -REACH
                || south - margin > REACH
                || east + margin < -REACH
                || west - margin > REACH
            {
                continue;
            }
            for row in index(south - margin)..=index(north + margin) {
                for column in index(west - margin)..=index(east + margin) {
                    let center = Spot {
                        n: (row as f32 + 0.5) * CELL - REACH,
                        e: (column as f32 + 0.5) * CELL - REACH,
                    };
                    if keeps(object, center, CELL * 0.7072 + margin) {
                        pairs.push(((row * SIDE + column) as u32, number as u32));
                    }
                }
            }
        }
        // Sorted by counting: the pairs come in the order of the objects already.
        let mut starts = vec![0_u32; (SIDE * SIDE + 1) as usize];
        for &(cell, _) in &pairs {
            starts[cell as usize + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut next = starts.clone();
        let mut items = vec![0; pairs.len()];
        for (cell, number) in pairs {
            let place = &mut next[cell as usize];
            items[*place as usize] = number;
            *place += 1;
        }
        Self { starts, items }
    }

    /// The objects of a cell, in ascending order.
    #[inline]
    pub(super) fn cell(&self, cell: usize) -> &[u32] {
        if self.starts.is_empty() {
            return &[];
        }
        &self.items[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }

    /// The objects that can matter at a place.
    #[inline]
    pub(super) fn at(&self, p: Spot) -> &[u32] {
        cell_of(p).map_or(&[], |cell| self.cell(cell))
    }
}
