//! Tiles of the web map as imagery.

use std::sync::{Arc, Mutex, PoisonError};

use super::{TileNumber, TileRectangle};
use pilotage_base::frames::{GroundRect, LocalFrame};
use pilotage_raster::imagery::kept::RecentValues;
use pilotage_raster::imagery::resample::{PyramidRegion, WindowPixels, samples_per_side};
use pilotage_raster::imagery::{Imagery, Placement, Window};
use pilotage_raster::raster::{Raster, Rgba};

/// Most tiles that are put together for a window.
const MOST_TILES: u64 = 1024;
/// Most problems that are remembered.
const MOST_PROBLEMS: usize = 4;

/// Why a tile that the map has is not shown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TileLack {
    /// It is on its way, or whoever fetches tiles tells what keeps it.
    Awaited,
    /// Its bytes could not be had this time, in words.
    Unreachable(String),
    /// Its bytes are damaged or of another kind, in words.
    Unreadable(String),
}

/// Source of tiles: an archive, or a store that a downloader fills.
pub trait TileStore: Send + Sync {
    /// Name for people.
    fn name(&self) -> &str;

    /// Coarsest and deepest zoom.
    fn zooms(&self) -> (u8, u8);

    /// Pixels along the side of a tile.
    fn side(&self) -> usize;

    /// Who made the map, if the store says so.
    fn attribution(&self) -> Option<&str> {
        None
    }

    /// The tile, `None` if the map leaves it out.
    ///
    /// # Errors
    /// The map has it, or may have it, but it is not to be had or not to be read.
    fn tile(&self, tile: &TileNumber) -> Result<Option<Raster<Rgba>>, TileLack>;
}

/// An area of a tiled map, in a world frame.
pub struct WebTiles {
    store: Box<dyn TileStore>,
    frame: LocalFrame,
    area: GroundRect,
    gsd: f64,
    kept: RecentValues<TileNumber, Option<Raster<Rgba>>>,
    problems: Mutex<Vec<String>>,
    note: Option<String>,
}

impl WebTiles {
    /// The part of `store` over `area` of the world frame `frame`; keeps at most `memory` bytes of
    /// tiles.
    pub fn new(
        store: Box<dyn TileStore>,
        frame: LocalFrame,
        area: GroundRect,
        memory: usize,
    ) -> Self {
        let place = frame.geodetic_from_ground(&area.center());
        let metres = TileNumber::side(store.zooms().1) * place.latitude.cos();
        Self {
            gsd: metres / store.side() as f64,
            store,
            frame,
            area,
            kept: RecentValues::new(memory),
            problems: Mutex::default(),
            note: None,
        }
    }

    /// The same map with a sentence on what of it is read.
    #[must_use]
    pub fn with_note(self, note: Option<String>) -> Self {
        Self { note, ..self }
    }

    /// A sentence on what of the map is read, if that is not all.
    pub fn note(&self) -> Option<&str> {
        self.note.as_deref()
    }

    /// The world frame.
    pub fn frame(&self) -> &LocalFrame {
        &self.frame
    }

    /// Coarsest and deepest zoom.
    pub fn zooms(&self) -> (u8, u8) {
        self.store.zooms()
    }

    fn remember(&self, problem: String) {
        let mut problems = self.problems.lock().unwrap_or_else(PoisonError::into_inner);
        if problems.len() < MOST_PROBLEMS && !problems.contains(&problem) {
            problems.push(problem);
        }
    }

    /// The tile as it is shown, `None` if nothing is; an error if it may come when it is asked for again.
    fn tile(&self, tile: TileNumber) -> Result<Arc<Option<Raster<Rgba>>>, ()> {
        self.kept.get_or_make(tile, || {
            let side = self.store.side();
            let pixels = match self.store.tile(&tile) {
                Ok(Some(pixels)) if (pixels.width(), pixels.height()) != (side, side) => {
                    let TileNumber { zoom, x, y } = tile;
                    let (width, height) = (pixels.width(), pixels.height());
                    self.remember(format!(
                        "{}, tile {zoom}/{x}/{y}: {width} × {height} pixels, not {side} × {side}",
                        self.store.name()
                    ));
                    None
                }
                Ok(pixels) => pixels,
                Err(TileLack::Unreadable(why)) => {
                    self.remember(why);
                    None
                }
                Err(TileLack::Unreachable(why)) => {
                    self.remember(why);
                    return Err(());
                }
                Err(TileLack::Awaited) => return Err(()),
            };
            let bytes = pixels.as_ref().map_or(64, |p| p.pixels().len() * 4);
            Ok((pixels, bytes))
        })
    }

    /// Copies tiles beside each other; also whether none of them is still to come.
    fn rectangle(&self, tiles: &TileRectangle) -> (Raster<Rgba>, bool) {
        let side = self.store.side();
        let (across, down) = (tiles.across as usize, tiles.down as usize);
        let mut out = Raster::filled(across * side, down * side, [0; 4]);
        let mut is_whole = true;
        for ((column, row), number) in tiles.tiles() {
            let Ok(tile) = self.tile(number) else {
                is_whole = false;
                continue;
            };
            let Some(pixels) = tile.as_ref() else {
                continue;
            };
            let (left, top) = (column as usize * side, row as usize * side);
            for row in 0..side {
                out.row_mut(top + row)[left..][..side].copy_from_slice(pixels.row(row));
            }
        }
        (out, is_whole)
    }
}

/// The rectangle of tiles that a window of the world frame `frame` is drawn from: of the coarsest of the `zooms` that is fine
/// enough. `None` if they would be too many.
pub fn tiles_for(
    window: &Window,
    frame: &LocalFrame,
    (least, most): (u8, u8),
    side: usize,
) -> Option<TileRectangle> {
    let rect = window.rect();
    let place = frame.geodetic_from_ground(&rect.center());
    let mut zoom = TileNumber::zoom_for(window.gsd, place.latitude, side).clamp(least, most);
    loop {
        let tiles = TileRectangle::covering(&rect, frame, zoom);
        if tiles.count() <= MOST_TILES {
            return Some(tiles);
        }
        if zoom == least {
            return None;
        }
        zoom -= 1;
    }
}

impl Imagery for WebTiles {
    fn name(&self) -> &str {
        self.store.name()
    }

    fn bounds(&self) -> GroundRect {
        self.area
    }

    fn native_gsd(&self) -> f64 {
        self.gsd
    }

    fn attribution(&self) -> Option<&str> {
        self.store.attribution()
    }

    /// From the coarsest zoom that is fine enough.
    fn window(&self, window: &Window) -> Raster<Rgba> {
        self.window_so_far(window).0
    }

    /// The window is not whole while tiles in it are still to come.
    fn window_so_far(&self, window: &Window) -> (Raster<Rgba>, bool) {
        let empty = || Raster::filled(window.width, window.height, [0; 4]);
        let rect = window.rect();
        if !rect.overlaps(&self.area) {
            return (empty(), true);
        }
        let side = self.store.side();
        let tiles = tiles_for(window, &self.frame, self.store.zooms(), side);
        let Some(tiles) = tiles else {
            return (empty(), true);
        };
        let (pixels, is_whole) = self.rectangle(&tiles);
        let size = (pixels.width(), pixels.height());
        let georeference = tiles.first.georeference(side);
        let placement = Placement::on_globe(georeference, self.frame, size.0, size.1);
        let Ok(placement) = placement else {
            return (empty(), true);
        };
        let part = PyramidRegion {
            pixels: &pixels,
            first: (0, 0),
            level: size,
            scale: (1.0, 1.0),
        };
        let per_side = samples_per_side(window.gsd / placement.gsd());
        let drawn = WindowPixels::new(window, &placement).draw(&part, per_side);
        (drawn, is_whole)
    }

    fn problems(&self) -> Vec<String> {
        let problems = self.problems.lock().unwrap_or_else(PoisonError::into_inner);
        problems.clone()
    }
}
