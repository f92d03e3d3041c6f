//! Tiles of the web that were fetched, and maps over them.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use pilotage_core::imagery::web_tiles::{TileLack, TileNumber, TileStore, TileTemplate, WebTiles};
use pilotage_core::raster::{Raster, Rgba, decode_picture_with_coverage};

use super::WebMap;

/// Key under which fetched tiles are given to a worker: files whose names are addresses.
pub const WEB_TILES: &str = "tiles of the web";
/// Bytes of tiles, as they were fetched, that a worker keeps, with their addresses.
const MOST_BYTES: usize = 48 << 20;
/// Bytes that a tile takes beside its own and those of its address, about: that a server has none is kept, too.
const BESIDE: usize = 96;
/// Bytes of unpacked tiles that a map keeps.
const UNPACKED: usize = 32 << 20;

/// Tiles as they were fetched, by address; clones share them.
#[derive(Clone, Default)]
pub struct FetchedTiles(Arc<Mutex<FetchedTile>>);

#[derive(Default)]
struct FetchedTile {
    tiles: HashMap<String, (u64, Arc<[u8]>)>,
    bytes: usize,
    clock: u64,
}

impl FetchedTiles {
    /// Keeps a tile, without bytes one that the server has not; those that were not asked for longest go for it.
    pub fn keep(&self, address: &str, bytes: Arc<[u8]>) {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        all.clock += 1;
        let now = all.clock;
        all.bytes += weight(address, &bytes);
        if let Some((_, old)) = all.tiles.insert(address.to_owned(), (now, bytes)) {
            all.bytes -= weight(address, &old);
        }
        while all.bytes > MOST_BYTES && all.tiles.len() > 1 {
            let ages = all
                .tiles
                .iter()
                .map(|(address, (used, _))| (*used, address));
            let Some(oldest) = ages.min().map(|(_, address)| address.clone()) else {
                return;
            };
            if let Some((_, gone)) = all.tiles.remove(&oldest) {
                all.bytes -= weight(&oldest, &gone);
            }
        }
    }

    fn get(&self, address: &str) -> Option<Arc<[u8]>> {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        all.clock += 1;
        let now = all.clock;
        let (used, bytes) = all.tiles.get_mut(address)?;
        *used = now;
        Some(bytes.clone())
    }
}

/// Bytes that a tile takes.
fn weight(address: &str, tile: &[u8]) -> usize {
    BESIDE + address.len() + tile.len()
}

/// The tiles of one template.
struct Store {
    template: TileTemplate,
    fetched: FetchedTiles,
}

impl TileStore for Store {
    fn name(&self) -> &str {
        &self.template.name
    }

    fn zooms(&self) -> (u8, u8) {
        (self.template.least_zoom, self.template.most_zoom)
    }

    fn side(&self) -> usize {
        self.template.side
    }

    fn tile(&self, tile: &TileNumber) -> Result<Option<Raster<Rgba>>, TileLack> {
        let bytes = self.fetched.get(&self.template.address_of(tile));
        let bytes = bytes.ok_or(TileLack::Awaited)?;
        if bytes.is_empty() {
            return Ok(None);
        }
        let pixels = decode_picture_with_coverage(&bytes);
        pixels.map(Some).map_err(|cause| {
            let TileNumber { zoom, x, y } = tile;
            let name = self.name();
            TileLack::Unreadable(format!("{name}, tile {zoom}/{x}/{y}: {cause}"))
        })
    }
}

impl WebMap {
    /// The map over the tiles that a worker has.
    pub fn open(&self, fetched: &FetchedTiles) -> WebTiles {
        let store = Store {
            template: self.template.clone(),
            fetched: fetched.clone(),
        };
        WebTiles::new(Box::new(store), self.frame(), Self::area(), UNPACKED)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_worker_keeps_no_more_than_its_share() {
        let fetched = FetchedTiles::default();
        for i in 0..30 {
            fetched.keep(&i.to_string(), vec![0; 4 << 20].into());
        }
        let all = fetched.0.lock().unwrap();
        assert!(all.bytes <= MOST_BYTES && all.tiles.contains_key("29"));
        assert!(!all.tiles.contains_key("0"));
    }

    #[test]
    fn tiles_that_a_server_has_not_are_forgotten_too_and_those_looked_at_last_stay() {
        let fetched = FetchedTiles::default();
        let address = |i: usize| format!("https://example.org/{i}/{}", "a".repeat(1 << 20));
        for i in 0..100 {
            fetched.keep(&address(i), Arc::new([]));
            assert!(fetched.get(&address(0)).is_some());
        }
        let all = fetched.0.lock().unwrap();
        assert!(all.tiles.len() < 50 && all.bytes <= MOST_BYTES);
        assert!(!all.tiles.contains_key(&address(1)));
        assert!(all.tiles.contains_key(&address(99)));
    }
}
