//! Maps of the web: which tiles a job needs, and those that were fetched.
//!
//! The page fetches (and its browser keeps) tiles; a worker gets them before the job that reads them.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use pilotage_core::frames::{Geodetic, GroundPoint, GroundRect, LocalFrame};
use pilotage_core::imagery::Window;
use pilotage_core::imagery::web_tiles::{TileNumber, TileStore, TileTemplate, WebTiles, tiles_for};
use pilotage_core::raster::{Raster, Rgba, decode_picture_with_coverage};
use serde::{Deserialize, Serialize};

use super::{Job, MapSource};

/// Key under which fetched tiles are given to a worker: files whose names are addresses.
pub const WEB_TILES: &str = "tiles of the web";
/// Bytes of tiles, as they were fetched, that a worker keeps.
const MOST_BYTES: usize = 48 << 20;
/// Bytes of unpacked tiles that a map keeps.
const UNPACKED: usize = 32 << 20;
/// How far the map reaches from the origin, metres: beyond, the plane leaves the globe.
const REACH: f64 = 100_000.0;
/// Most tiles that are fetched for one job.
const MOST_PER_JOB: usize = 512;
/// How far around a landmark pixels are needed to look for it, metres.
const AROUND_LANDMARK: f64 = 80.0;

/// A map of the web in a world frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WebMap {
    /// Where its tiles come from.
    pub template: TileTemplate,
    /// Origin of the world frame.
    pub origin: Geodetic,
}

impl WebMap {
    fn frame(&self) -> LocalFrame {
        LocalFrame::new(self.origin)
    }

    fn zooms(&self) -> (u8, u8) {
        (self.template.least_zoom, self.template.most_zoom)
    }

    /// The ground that it covers.
    pub fn area() -> GroundRect {
        GroundRect::centered(GroundPoint::default(), 2.0 * REACH, 2.0 * REACH)
    }

    /// Metres per pixel of its deepest tiles.
    pub fn finest(&self) -> f64 {
        let metres = TileNumber::side(self.template.most_zoom) * self.origin.latitude.cos();
        metres / self.template.side as f64
    }

    /// Addresses of the tiles that a window is drawn from.
    fn of_window(&self, window: &Window) -> Vec<String> {
        let tiles = tiles_for(window, &self.frame(), self.zooms(), self.template.side);
        tiles.map_or_else(Vec::new, |(first, last)| self.between(first, last))
    }

    fn between(&self, first: TileNumber, last: TileNumber) -> Vec<String> {
        let rows = first.y..=last.y;
        let all = rows.flat_map(|y| (first.x..=last.x).map(move |x| TileNumber { x, y, ..first }));
        all.map(|tile| self.template.address_of(&tile)).collect()
    }

    /// Number of tiles over `area` at every zoom from `zooms.0` to `zooms.1`.
    pub fn count_over(&self, area: &GroundRect, zooms: (u8, u8)) -> u64 {
        let of = |zoom| {
            let (first, last) = TileNumber::covering(area, &self.frame(), zoom);
            u64::from(last.x - first.x + 1) * u64::from(last.y - first.y + 1)
        };
        (zooms.0..=zooms.1).map(of).sum()
    }

    /// Addresses of those tiles, coarse ones first.
    pub fn addresses_over(&self, area: &GroundRect, zooms: (u8, u8)) -> Vec<String> {
        let of = |zoom| {
            let (first, last) = TileNumber::covering(area, &self.frame(), zoom);
            self.between(first, last)
        };
        (zooms.0..=zooms.1).flat_map(of).collect()
    }

    /// The map over the tiles that a worker has.
    pub fn open(&self, fetched: &FetchedTiles) -> WebTiles {
        let store = Store {
            template: self.template.clone(),
            fetched: fetched.clone(),
        };
        WebTiles::new(Box::new(store), self.frame(), Self::area(), UNPACKED)
    }
}

/// Addresses of the tiles of web maps that a job needs; none for other maps.
pub fn wanted_addresses(job: &Job) -> Vec<String> {
    let around = |map: &WebMap, areas: &mut dyn Iterator<Item = GroundRect>| {
        let deepest = (map.template.most_zoom, map.template.most_zoom);
        let mut all: Vec<String> = Vec::new();
        for area in areas {
            all.extend(map.addresses_over(&area, deepest));
        }
        all
    };
    let mut all = match job {
        Job::Tile {
            map: MapSource::Web(map),
            window,
        } => map.of_window(window),
        Job::Distinctness {
            map: MapSource::Web(map),
            bounds,
            radius,
        } => around(map, &mut std::iter::once(bounds.grown(*radius))),
        Job::Assess(order) | Job::Envelope(order) => match &order.map {
            MapSource::Web(map) => {
                let area = order.landmark.bounds.grown(AROUND_LANDMARK);
                around(map, &mut std::iter::once(area))
            }
            _ => Vec::new(),
        },
        Job::Fly {
            map: MapSource::Web(map),
            mission: Some(mission),
            ..
        } => {
            let landmarks = mission.landmarks.iter();
            around(map, &mut landmarks.map(|l| l.bounds.grown(AROUND_LANDMARK)))
        }
        _ => Vec::new(),
    };
    all.sort_unstable();
    all.dedup();
    all.truncate(MOST_PER_JOB);
    all
}

/// Tiles as they were fetched, by address; clones share them.
#[derive(Clone, Default)]
pub struct FetchedTiles(Arc<Mutex<Fetched>>);

#[derive(Default)]
struct Fetched {
    tiles: HashMap<String, (u64, Arc<[u8]>)>,
    bytes: usize,
    clock: u64,
}

impl FetchedTiles {
    /// Keeps a tile; those that were not asked for longest go for it.
    pub fn keep(&self, address: &str, bytes: Arc<[u8]>) {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        all.clock += 1;
        let now = all.clock;
        all.bytes += bytes.len();
        if let Some((_, old)) = all.tiles.insert(address.to_owned(), (now, bytes)) {
            all.bytes -= old.len();
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
                all.bytes -= gone.len();
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

    fn tile(&self, tile: &TileNumber) -> Option<Raster<Rgba>> {
        let bytes = self.fetched.get(&self.template.address_of(tile))?;
        decode_picture_with_coverage(&bytes).ok()
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::imagery::Imagery as _;
    use pilotage_core::raster::{Picture, encode_png};

    use super::*;

    fn map() -> WebMap {
        WebMap {
            template: TileTemplate {
                name: "Tiles".to_owned(),
                address: "http://127.0.0.1/{z}/{x}/{y}.png".to_owned(),
                attribution: "© whoever".to_owned(),
                least_zoom: 10,
                most_zoom: 17,
                side: 256,
            },
            origin: Geodetic::from_degrees(46.857, -92.076, 0.0),
        }
    }

    #[test]
    fn a_window_is_whole_once_the_tiles_that_its_job_wants_are_there() {
        let map = map();
        let window = Window::covering(
            &GroundRect::centered(GroundPoint::default(), 300.0, 400.0),
            1.0,
        );
        let job = Job::Tile {
            map: MapSource::Web(map.clone()),
            window,
        };
        let wanted = wanted_addresses(&job);
        assert!((4..30).contains(&wanted.len()), "{wanted:?}");
        assert!(wanted.iter().all(|a| a.starts_with("http://127.0.0.1/17/")));
        let fetched = FetchedTiles::default();
        let open = map.open(&fetched);
        assert!(open.window(&window).pixels().iter().all(|p| p[3] == 0));
        let tile = encode_png(&Picture::filled(256, 256, [10, 200, 30])).unwrap();
        for address in &wanted {
            fetched.keep(address, tile.clone().into());
        }
        assert!(
            open.window(&window)
                .pixels()
                .iter()
                .all(|p| *p == [10, 200, 30, 255])
        );
    }

    #[test]
    fn an_area_has_four_times_the_tiles_at_every_deeper_zoom() {
        let map = map();
        let area = GroundRect::centered(GroundPoint::default(), 3000.0, 3000.0);
        let all = map.addresses_over(&area, (12, 17));
        assert_eq!(all.len() as u64, map.count_over(&area, (12, 17)));
        let deep = map.count_over(&area, (17, 17)) as f64 / map.count_over(&area, (16, 16)) as f64;
        assert!((2.5..4.5).contains(&deep), "{deep}");
        assert!(all[0].contains("/12/") && all[all.len() - 1].contains("/17/"));
    }

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
}
