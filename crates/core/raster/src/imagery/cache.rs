//! Tiles of a slow source, kept while memory allows.

use std::convert::Infallible;
use std::sync::Arc;

use super::kept::RecentValues;
use super::{Imagery, Window};
use crate::raster::{Raster, Rgba};
use pilotage_base::frames::GroundRect;

/// Pixels along the side of a tile of [`CachedImagery`].
pub const TILE_SIDE: usize = 128;
const TILE: i64 = TILE_SIDE as i64;

/// Place of a tile: scale level, row from the north, column from the west.
type TilePlace = (i32, i64, i64);

/// Imagery whose tiles at power-of-two multiples of the native scale are remembered, least recently
/// used out first. Windows on that grid are put together from tiles; others go to the source.
pub struct CachedImagery {
    source: Arc<dyn Imagery>,
    tiles: RecentValues<TilePlace, Raster<Rgba>>,
}

impl CachedImagery {
    /// Keeps at most `megabytes` of tiles of `source`.
    pub fn new(source: Arc<dyn Imagery>, megabytes: usize) -> Self {
        Self {
            source,
            tiles: RecentValues::new(megabytes * 1_000_000),
        }
    }

    /// Ground sample distance of a level, metres per pixel: level 0 is native.
    fn gsd(&self, level: i32) -> f64 {
        self.source.native_gsd() * f64::from(level).exp2()
    }

    /// The coarsest grid level at or below `gsd`, native at the finest.
    pub fn level_for(&self, gsd: f64) -> i32 {
        ((gsd / self.source.native_gsd()).log2() + 1e-9)
            .floor()
            .max(0.0) as i32
    }

    /// The window of the grid at `level` that covers `rect`.
    pub fn aligned(&self, rect: &GroundRect, level: i32) -> Window {
        let gsd = self.gsd(level);
        let west = (rect.west / gsd).floor();
        let north = (rect.north / gsd).ceil();
        Window {
            north_edge: north * gsd,
            west_edge: west * gsd,
            gsd,
            width: ((rect.east / gsd).ceil() - west).max(1.0) as usize,
            height: (north - (rect.south / gsd).floor()).max(1.0) as usize,
        }
    }

    fn tile(&self, place: TilePlace) -> Arc<Raster<Rgba>> {
        let make = || {
            let (level, row, column) = place;
            let gsd = self.gsd(level);
            let window = Window {
                north_edge: -((row * TILE) as f64) * gsd,
                west_edge: (column * TILE) as f64 * gsd,
                gsd,
                width: TILE as usize,
                height: TILE as usize,
            };
            let bytes = (TILE * TILE * 4) as usize;
            Ok::<_, Infallible>((self.source.window(&window), bytes))
        };
        let Ok(tile) = self.tiles.get_or_make(place, make);
        tile
    }

    /// Level, first row and first column of a window on the grid.
    fn on_grid(&self, window: &Window) -> Option<(i32, i64, i64)> {
        let level = (window.gsd / self.source.native_gsd()).log2();
        let row = -window.north_edge / window.gsd;
        let column = window.west_edge / window.gsd;
        let whole = |v: f64| (v - v.round()).abs() < 1e-6;
        (level > -0.5 && whole(level) && whole(row) && whole(column)).then(|| {
            (
                level.round() as i32,
                row.round() as i64,
                column.round() as i64,
            )
        })
    }
}

impl Imagery for CachedImagery {
    fn name(&self) -> &str {
        self.source.name()
    }

    fn bounds(&self) -> GroundRect {
        self.source.bounds()
    }

    fn native_gsd(&self) -> f64 {
        self.source.native_gsd()
    }

    fn source(&self) -> Option<&dyn Imagery> {
        Some(&self.source)
    }

    /// Of the source, whatever is kept: what is kept is whole.
    fn window_so_far(&self, window: &Window) -> (Raster<Rgba>, bool) {
        self.source.window_so_far(window)
    }

    fn window(&self, window: &Window) -> Raster<Rgba> {
        let Some((level, first_row, first_column)) = self.on_grid(window) else {
            return self.source.window(window);
        };
        let mut out = Raster::filled(window.width, window.height, [0; 4]);
        let (last_row, last_column) = (
            first_row + window.height as i64,
            first_column + window.width as i64,
        );
        for tile_row in first_row.div_euclid(TILE)..=(last_row - 1).div_euclid(TILE) {
            for tile_column in first_column.div_euclid(TILE)..=(last_column - 1).div_euclid(TILE) {
                let tile = self.tile((level, tile_row, tile_column));
                let rows = (tile_row * TILE).max(first_row)..((tile_row + 1) * TILE).min(last_row);
                let from = (tile_column * TILE).max(first_column);
                let to = ((tile_column + 1) * TILE).min(last_column);
                for row in rows {
                    let source = &tile.row((row - tile_row * TILE) as usize)
                        [(from - tile_column * TILE) as usize..(to - tile_column * TILE) as usize];
                    out.row_mut((row - first_row) as usize)
                        [(from - first_column) as usize..(to - first_column) as usize]
                        .copy_from_slice(source);
                }
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::super::InsetImagery;
    use super::*;

    /// Every native pixel tells its own place.
    struct Places;

    impl Imagery for Places {
        fn name(&self) -> &'static str {
            "places"
        }
        fn bounds(&self) -> GroundRect {
            GroundRect {
                south: -500.0,
                north: 500.0,
                west: -500.0,
                east: 500.0,
            }
        }
        fn native_gsd(&self) -> f64 {
            0.5
        }
        fn window(&self, window: &Window) -> Raster<Rgba> {
            Raster::from_fn(window.width, window.height, |c, r| {
                let p = window.ground_at(c as f64 + 0.5, r as f64 + 0.5);
                [
                    (p.north.rem_euclid(200.0)) as u8,
                    (p.east.rem_euclid(200.0)) as u8,
                    0,
                    255,
                ]
            })
        }
    }

    /// Ground that takes long, of which a part cannot be read.
    struct Damaged;

    impl Imagery for Damaged {
        fn name(&self) -> &'static str {
            "damaged"
        }
        fn bounds(&self) -> GroundRect {
            Places.bounds()
        }
        fn native_gsd(&self) -> f64 {
            0.5
        }
        fn window(&self, window: &Window) -> Raster<Rgba> {
            Places.window(window)
        }
        fn is_coarse_cheap(&self) -> bool {
            false
        }
        fn window_so_far(&self, window: &Window) -> (Raster<Rgba>, bool) {
            (Raster::filled(window.width, window.height, [0; 4]), false)
        }
        fn prepare(&self, pieces: usize) -> (usize, usize) {
            (pieces, 9)
        }
        fn attribution(&self) -> Option<&str> {
            Some("somebody")
        }
        fn problems(&self) -> Vec<String> {
            vec!["tile 0, 0".to_owned()]
        }
    }

    #[test]
    fn a_map_in_memory_says_all_that_its_source_says() {
        let damaged: Arc<dyn Imagery> = Arc::new(Damaged);
        let inset = InsetImagery::new(damaged.clone(), Places.bounds(), Arc::new(Places));
        let around = InsetImagery::new(Arc::new(Places), Places.bounds(), damaged.clone());
        let window = CachedImagery::new(Arc::new(Places), 1).aligned(&Places.bounds(), 0);
        let maps: [&dyn Imagery; 2] = [&CachedImagery::new(damaged.clone(), 1), &inset];
        for map in maps {
            assert_eq!(map.problems(), ["tile 0, 0"]);
            assert_eq!(map.attribution(), Some("somebody"));
            assert_eq!(map.prepare(4), (4, 9));
            assert!(!map.is_coarse_cheap());
            assert!(!map.window_so_far(&window).1);
        }
        // What is shown around is read as well.
        assert_eq!(around.problems(), ["tile 0, 0"]);
    }

    #[test]
    fn a_window_from_tiles_equals_the_window_from_the_source() {
        let cached = CachedImagery::new(Arc::new(Places), 1);
        let rect = GroundRect {
            south: -210.0,
            north: 93.3,
            west: -77.7,
            east: 180.0,
        };
        for level in 0..3 {
            let window = cached.aligned(&rect, level);
            assert_eq!(
                cached.window(&window),
                Places.window(&window),
                "level {level}"
            );
            assert_eq!(
                cached.window(&window),
                Places.window(&window),
                "again, level {level}"
            );
        }
    }

    #[test]
    fn memory_is_bounded() {
        let cached = CachedImagery::new(Arc::new(Places), 2);
        for east in 0..40 {
            let rect = GroundRect {
                south: -500.0,
                north: 500.0,
                west: f64::from(east) * 25.0 - 500.0,
                east: f64::from(east) * 25.0 - 475.0,
            };
            cached.window(&cached.aligned(&rect, 0));
        }
        assert!(cached.tiles.bytes() <= 2_000_000);
    }
}
