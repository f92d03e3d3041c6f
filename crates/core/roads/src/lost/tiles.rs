//! Pieces of roads, and points along them, found by tiles.

use pilotage_base::frames::{GroundPoint, GroundRect};

use crate::course::{between, heading};
use crate::map::RoadMap;

/// Side of a tile, metres.
const TILE: f64 = 100.0;
/// Distance between points along roads, metres.
pub(super) const MAP_SPACING: f64 = 12.0;

/// Point of a road of the map.
#[derive(Clone, Copy, Debug)]
pub(super) struct MapPoint {
    pub place: GroundPoint,
    pub direction: f64,
}

/// Values by the tiles of a rectangle, in the order of the tiles.
#[derive(Clone, Debug)]
struct Tiled<T> {
    south: f64,
    west: f64,
    rows: usize,
    columns: usize,
    /// First value of every tile, and their number at the end.
    first: Vec<u32>,
    values: Vec<T>,
}

impl<T: Copy> Tiled<T> {
    fn new(bounds: &GroundRect, values: &[(GroundPoint, T)]) -> Self {
        let count = |extent: f64| (extent / TILE).ceil().max(1.0) as usize + 1;
        let mut own = Self {
            south: bounds.south,
            west: bounds.west,
            rows: count(bounds.height()),
            columns: count(bounds.width()),
            first: Vec::new(),
            values: Vec::new(),
        };
        let mut order: Vec<(usize, usize)> = (values.iter().enumerate())
            .map(|(index, (place, _))| (own.tile(*place), index))
            .collect();
        order.sort_unstable();
        own.first = vec![0; own.rows * own.columns + 1];
        for (tile, _) in &order {
            own.first[tile + 1] += 1;
        }
        for tile in 0..own.rows * own.columns {
            own.first[tile + 1] += own.first[tile];
        }
        own.values = order.iter().map(|(_, index)| values[*index].1).collect();
        own
    }

    fn tile(&self, place: GroundPoint) -> usize {
        let at = |value: f64, count: usize| ((value / TILE).max(0.0) as usize).min(count - 1);
        at(place.north - self.south, self.rows) * self.columns
            + at(place.east - self.west, self.columns)
    }

    fn visit(&self, rect: &GroundRect, mut visit: impl FnMut(&T)) {
        let range = |low: f64, high: f64, start: f64, count: usize| {
            let at = |value: f64| ((value - start) / TILE).max(0.0) as usize;
            if high < start {
                return 0..0;
            }
            at(low).min(count)..(at(high) + 1).min(count)
        };
        let columns = range(rect.west, rect.east, self.west, self.columns);
        for row in range(rect.south, rect.north, self.south, self.rows) {
            if columns.is_empty() {
                return;
            }
            let tile = row * self.columns;
            let (from, to) = (
                self.first[tile + columns.start] as usize,
                self.first[tile + columns.end] as usize,
            );
            self.values[from..to].iter().for_each(&mut visit);
        }
    }
}

/// Pieces of all roads and points along them.
#[derive(Clone, Debug)]
pub(super) struct PieceTiles {
    pieces: Tiled<[GroundPoint; 2]>,
    points: Tiled<MapPoint>,
}

impl PieceTiles {
    pub fn new(map: &RoadMap, bounds: &GroundRect) -> Self {
        let mut pieces = Vec::new();
        let mut points = Vec::new();
        for edge in map.graph().edge_weights() {
            let mut next = 0.5 * MAP_SPACING.min(edge.length);
            for pair in edge.course.windows(2) {
                let length = pair[0].distance(&pair[1]);
                // No longer than a tile, so that looking a tile around is enough.
                let parts = (length / (0.5 * TILE)).ceil().max(1.0) as usize;
                for part in 0..parts {
                    let at = |k: usize| between(pair[0], pair[1], k as f64 / parts as f64);
                    let piece = [at(part), at(part + 1)];
                    pieces.push((between(piece[0], piece[1], 0.5), piece));
                }
                while next <= length && length > 0.0 {
                    let place = between(pair[0], pair[1], next / length);
                    let direction = heading(pair[0], pair[1]);
                    points.push((place, MapPoint { place, direction }));
                    next += MAP_SPACING;
                }
                next -= length;
            }
        }
        Self {
            pieces: Tiled::new(bounds, &pieces),
            points: Tiled::new(bounds, &points),
        }
    }

    /// Visits all pieces that come within `reach` of a place, and others.
    pub fn visit_pieces(
        &self,
        place: GroundPoint,
        reach: f64,
        mut visit: impl FnMut([GroundPoint; 2]),
    ) {
        let extent = 2.0 * reach + 0.5 * TILE;
        let rect = GroundRect::centered(place, extent, extent);
        self.pieces.visit(&rect, |piece| visit(*piece));
    }

    /// Visits all points within a rectangle, and others.
    pub fn visit_points(&self, rect: &GroundRect, visit: impl FnMut(&MapPoint)) {
        self.points.visit(rect, visit);
    }

    /// The pieces, in no order.
    pub fn pieces(&self) -> impl Iterator<Item = [GroundPoint; 2]> + '_ {
        self.pieces.values.iter().copied()
    }

    /// Bytes that it takes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.pieces.values[..])
            + size_of_val(&self.points.values[..])
            + 2 * size_of_val(&self.points.first[..])
    }
}
