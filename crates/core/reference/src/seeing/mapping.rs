//! A map made into a table, tile by tile.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::landmarks_seen;
use crate::{GenericLandmark, ReferenceTable};
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_vision::ground_class::{CLASS_GSD, CoverNetwork, classify_ground};

/// Side of a tile, metres.
const TILE: f64 = 384.0;
/// Ground around a tile that is looked at with it, metres. Most things in the tile are whole there; one that reaches farther,
/// as a long water may, is left out.
const AROUND: f64 = 66.0;

/// Looks at a tile of a map for landmarks; those beyond its border are left out afterwards.
pub type LookAtTile = Arc<dyn Fn(&dyn Imagery, &GroundRect) -> Vec<GenericLandmark> + Send + Sync>;

/// Landmarks of a map, tile by tile, of the tiles that were asked for.
#[derive(Clone)]
pub struct SeenTiles {
    map: Arc<dyn Imagery>,
    look: LookAtTile,
    /// By row from the south and column from the west, counted from the origin.
    tiles: BTreeMap<(i64, i64), Vec<GenericLandmark>>,
}

impl SeenTiles {
    /// Nothing looked at yet of `map`, of which `network` tells the classes.
    pub fn of(map: Arc<dyn Imagery>, network: CoverNetwork) -> Self {
        let look = move |map: &dyn Imagery, tile: &GroundRect| {
            let window = Window::covering(&tile.grown(AROUND), CLASS_GSD);
            let picture = map.window(&window);
            landmarks_seen(&classify_ground(&window, &picture, &network))
        };
        Self::by(map, Arc::new(look))
    }

    /// Nothing looked at yet of `map`, in the tiles of which `look` finds landmarks.
    pub fn by(map: Arc<dyn Imagery>, look: LookAtTile) -> Self {
        Self {
            map,
            look,
            tiles: BTreeMap::new(),
        }
    }

    /// Landmarks at most `reach` metres from `place`; tiles there that were not looked at yet are looked at now.
    pub fn near(&mut self, place: GroundPoint, reach: f64) -> Vec<GenericLandmark> {
        let mut found = Vec::new();
        let rect = GroundRect::centered(place, 2.0 * reach, 2.0 * reach);
        for number in tiles_of(&rect) {
            let landmarks = self.tile(number).iter();
            found.extend(landmarks.filter(|l| l.place.distance(&place) <= reach));
        }
        found
    }

    fn tile(&mut self, number: (i64, i64)) -> &[GenericLandmark] {
        let (map, look) = (&self.map, &self.look);
        let look = || look_at(map.as_ref(), look, number);
        self.tiles.entry(number).or_insert_with(look)
    }
}

/// Numbers of the tiles that touch `rect`.
fn tiles_of(rect: &GroundRect) -> impl Iterator<Item = (i64, i64)> + use<> {
    let number = |metres: f64| (metres / TILE).floor() as i64;
    let rows = number(rect.south)..=number(rect.north);
    let columns = number(rect.west)..=number(rect.east);
    rows.flat_map(move |row| columns.clone().map(move |column| (row, column)))
}

/// Landmarks of a tile.
fn look_at(map: &dyn Imagery, look: &LookAtTile, number: (i64, i64)) -> Vec<GenericLandmark> {
    let (south, west) = (number.0 as f64 * TILE, number.1 as f64 * TILE);
    let tile = GroundRect {
        south,
        north: south + TILE,
        west,
        east: west + TILE,
    };
    if !tile.overlaps(&map.bounds()) {
        return Vec::new();
    }
    let mut seen = look(map, &tile);
    // A place on the border of two tiles is in one of them.
    seen.retain(|landmark| {
        (tile.south..tile.north).contains(&landmark.place.north)
            && (tile.west..tile.east).contains(&landmark.place.east)
    });
    seen
}

/// A map that is made into a table; memory does not grow with the map but for the landmarks.
pub struct ReferenceMapping {
    tiles: SeenTiles,
    left: Vec<(i64, i64)>,
    all: usize,
}

impl ReferenceMapping {
    /// Nothing looked at yet of `map`.
    pub fn of(map: Arc<dyn Imagery>, network: CoverNetwork) -> Self {
        let left: Vec<(i64, i64)> = tiles_of(&map.bounds()).collect();
        Self {
            all: left.len(),
            left,
            tiles: SeenTiles::of(map, network),
        }
    }

    /// Number of tiles of a map with those bounds.
    pub fn tiles(bounds: &GroundRect) -> usize {
        tiles_of(bounds).count()
    }

    /// Only one of `of` parts of the tiles, in the order in which their landmarks come.
    #[must_use]
    pub fn part(mut self, part: usize, of: usize) -> Self {
        let end = |parts: usize| self.all * parts / of;
        self.left = self.left[end(part)..end(part + 1)].to_vec();
        self.all = self.left.len();
        self
    }

    /// Tiles that are done, and tiles in all.
    pub fn progress(&self) -> (usize, usize) {
        (self.all - self.left.len(), self.all)
    }

    /// Looks at the next tile; whether there was one.
    pub fn advance(&mut self) -> bool {
        let next = self.left.pop();
        if let Some(number) = next {
            self.tiles.tile(number);
        }
        next.is_some()
    }

    /// Landmarks that were found so far, by tiles.
    pub fn into_landmarks(self) -> Vec<GenericLandmark> {
        self.tiles.tiles.into_values().flatten().collect()
    }

    /// The table of what was found so far.
    pub fn into_table(self) -> ReferenceTable {
        ReferenceTable::new(self.into_landmarks(), Vec::new())
    }
}
