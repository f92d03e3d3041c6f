//! Numbers of the tiles.

use std::f64::consts::PI;

use pilotage_base::frames::{Geodetic, GroundPoint, GroundRect, LocalFrame, ReferenceSystem};
use pilotage_base::georeference::{Georeference, WorldFile};

/// Half the side of the web map, metres of its own.
const HALF_WORLD: f64 = PI * 6_378_137.0;

/// Deepest zoom that is counted.
pub const DEEPEST: u8 = 28;

/// A tile of the web map: at zoom z the world is 2^z tiles wide and high.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TileNumber {
    /// Zoom, up to 28.
    pub zoom: u8,
    /// Column, from 180° west.
    pub x: u32,
    /// Row, from the north.
    pub y: u32,
}

/// Tiles of one zoom beside and below each other; over the date line it goes on in the first column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TileRectangle {
    /// The tile in its north-west corner.
    pub first: TileNumber,
    /// Number of columns, at most those of the world.
    pub across: u32,
    /// Number of rows.
    pub down: u32,
}

impl TileRectangle {
    /// The tiles of a zoom that cover `area` of the world frame `frame`.
    ///
    /// ```
    /// use pilotage_maps::frames::{Geodetic, GroundPoint, GroundRect, LocalFrame};
    /// use pilotage_maps::web_tiles::TileRectangle;
    ///
    /// // A kilometre around 180° west on the equator, in tiles of 1223 m: the last column and the first one.
    /// let frame = LocalFrame::new(Geodetic::from_degrees(0.005, -180.0, 0.0));
    /// let area = GroundRect::centered(GroundPoint::default(), 1000.0, 1000.0);
    /// let covering = TileRectangle::covering(&area, &frame, 15);
    /// let columns: Vec<u32> = covering.tiles().map(|(_, tile)| tile.x).collect();
    /// assert_eq!(columns, [32_767, 0]);
    /// ```
    pub fn covering(area: &GroundRect, frame: &LocalFrame, zoom: u8) -> Self {
        let zoom = zoom.min(DEEPEST);
        let columns = f64::from(1_u32 << zoom);
        let center = area.center();
        let column = |ground: &GroundPoint| {
            let place = frame.geodetic_from_ground(ground);
            let (x, _) = (ReferenceSystem::WebMercator.coordinates(&place)).unwrap_or_default();
            (
                (x + HALF_WORLD) / TileNumber::side(zoom),
                TileNumber::around(&place, zoom).y,
            )
        };
        let (middle, _) = column(&center);
        // Sides of the area are bent on the web map; their middles reach out farthest.
        let places = [area.south, center.north, area.north]
            .into_iter()
            .flat_map(|north| {
                [area.west, center.east, area.east].map(|east| GroundPoint::new(north, east))
            });
        let (mut west, mut east) = (f64::INFINITY, f64::NEG_INFINITY);
        let (mut north, mut south) = (u32::MAX, 0);
        for (x, y) in places.map(|place| column(&place)) {
            // Counted on from the middle's own column, also over the date line.
            let x = (x - ((x - middle) / columns).round() * columns).floor();
            (west, east) = (west.min(x), east.max(x));
            (north, south) = (north.min(y), south.max(y));
        }
        Self {
            first: TileNumber {
                zoom,
                x: west.rem_euclid(columns) as u32,
                y: north,
            },
            across: (east - west + 1.0).min(columns) as u32,
            down: south - north + 1,
        }
    }

    /// Number of its tiles.
    pub fn count(&self) -> u64 {
        u64::from(self.across) * u64::from(self.down)
    }

    /// Its tiles row by row, each with its column and row within the rectangle.
    pub fn tiles(&self) -> impl Iterator<Item = ((u32, u32), TileNumber)> + use<> {
        let Self {
            first,
            across,
            down,
        } = *self;
        let all = 1_u32 << first.zoom;
        (0..down).flat_map(move |row| {
            (0..across).map(move |column| {
                let x = (first.x + column) % all;
                let y = first.y + row;
                ((column, row), TileNumber { x, y, ..first })
            })
        })
    }
}

impl TileNumber {
    /// The tile at `zoom` that holds a place; places beyond the map's rim at 85° fall into its
    /// outermost row.
    ///
    /// ```
    /// use pilotage_maps::frames::Geodetic;
    /// use pilotage_maps::web_tiles::TileNumber;
    ///
    /// // At zoom 1 the world has four tiles; Sydney lies in the south-east.
    /// let sydney = Geodetic::from_degrees(-33.86, 151.21, 0.0);
    /// assert_eq!(TileNumber::around(&sydney, 1), TileNumber { zoom: 1, x: 1, y: 1 });
    /// ```
    pub fn around(place: &Geodetic, zoom: u8) -> Self {
        let zoom = zoom.min(DEEPEST);
        let side = Self::side(zoom);
        let (x, y) = (ReferenceSystem::WebMercator.coordinates(place)).unwrap_or_default();
        let index = |v: f64| (v.floor().max(0.0) as u32).min((1 << zoom) - 1);
        Self {
            zoom,
            x: index((x + HALF_WORLD) / side),
            y: index((HALF_WORLD - y) / side),
        }
    }

    /// Side of a tile in metres of the web map.
    pub fn side(zoom: u8) -> f64 {
        2.0 * HALF_WORLD / f64::from(1_u32 << zoom.min(DEEPEST))
    }

    /// Georeference of the pixels of the rectangle of tiles that begins with this one, for tiles of `side`
    /// pixels.
    pub fn georeference(&self, side: usize) -> Georeference {
        let metres = Self::side(self.zoom);
        let pixel = metres / side as f64;
        Georeference::Projected {
            system: ReferenceSystem::WebMercator,
            file: WorldFile {
                a: pixel,
                d: 0.0,
                b: 0.0,
                e: -pixel,
                c: -HALF_WORLD + f64::from(self.x) * metres + 0.5 * pixel,
                f: HALF_WORLD - f64::from(self.y) * metres - 0.5 * pixel,
            },
        }
    }

    /// The coarsest zoom whose pixels at `latitude` (radians) are no larger than `gsd` metres, for
    /// tiles of `side` pixels.
    ///
    /// ```
    /// use pilotage_maps::web_tiles::TileNumber;
    ///
    /// // 40 075 017 m around the equator are 256 · 2^14 pixels of 9.55 m.
    /// assert_eq!(TileNumber::zoom_for(10.0, 0.0, 256), 14);
    /// assert_eq!(TileNumber::zoom_for(9.5, 0.0, 256), 15);
    /// ```
    pub fn zoom_for(gsd: f64, latitude: f64, side: usize) -> u8 {
        let at_zero = 2.0 * HALF_WORLD * latitude.cos() / side as f64;
        let zoom = (at_zero / gsd).log2() - 1e-6;
        zoom.ceil().clamp(0.0, f64::from(DEEPEST)) as u8
    }

    /// Number of the tile along the Hilbert curves of all zooms, as `PMTiles` orders them.
    pub fn hilbert(&self) -> u64 {
        let mut number: u64 = (0..self.zoom).map(|z| 1_u64 << (2 * z)).sum();
        let (mut x, mut y) = (u64::from(self.x), u64::from(self.y));
        let side = 1_u64 << self.zoom;
        let mut step = side / 2;
        while step > 0 {
            let right = u64::from(x & step > 0);
            let down = u64::from(y & step > 0);
            number += step * step * ((3 * right) ^ down);
            // Turn the quadrant, so that the curve runs on in it.
            if down == 0 {
                if right == 1 {
                    x = (side - 1).wrapping_sub(x) & (side - 1);
                    y = (side - 1).wrapping_sub(y) & (side - 1);
                }
                std::mem::swap(&mut x, &mut y);
            }
            step /= 2;
        }
        number
    }
}
