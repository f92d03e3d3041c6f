//! The map's pixels: square tiles at power-of-two ground sample distances, asked for as they come
//! into view and kept as textures. A coarser tile stands in while a finer one is on its way.

use pilotage_core::sorting::sort;
use std::collections::{HashMap, HashSet};

use egui::epaint::{Mesh, Vertex};
use egui::{Color32, ColorImage, Painter, Rect, Shape, TextureHandle, TextureOptions, pos2};
use pilotage_core::frames::GroundRect;
use pilotage_core::imagery::Window;
use pilotage_core::raster::{Raster, Rgba};

use super::transform::ScreenFromWorld;
use pilotage_jobs::MapInfo;

/// Pixels on a tile's side.
const SIDE: usize = 256;
/// Most tiles asked for at a time.
pub const TILES_AT_A_TIME: usize = 4;
/// Textures kept.
const CAPACITY: usize = 320;
/// Number of levels up in which a stand-in is looked for.
const ANCESTORS: i32 = 6;

/// A tile: its level (ground sample distance 2^level metres) and its place in the level's grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TileKey {
    level: i32,
    north: i64,
    east: i64,
}

impl TileKey {
    fn extent(level: i32) -> f64 {
        SIDE as f64 * 2.0_f64.powi(level)
    }

    /// The window of the map that the tile shows.
    pub fn window(&self) -> Window {
        let extent = Self::extent(self.level);
        Window {
            north_edge: (self.north + 1) as f64 * extent,
            west_edge: self.east as f64 * extent,
            gsd: 2.0_f64.powi(self.level),
            width: SIDE,
            height: SIDE,
        }
    }

    /// The tile that shows `window`, if it is one of ours.
    ///
    /// ```
    /// use pilotage_core::imagery::Window;
    /// use pilotage_ui::map::TileKey;
    ///
    /// // Tiles of 256 pixels of 2 m begin at multiples of 512 m.
    /// let of = |west_edge| TileKey::of(&Window { north_edge: 1024.0, west_edge, gsd: 2.0, width: 256, height: 256 });
    /// assert_eq!(of(-512.0).map(|tile| tile.window().rect().east), Some(0.0));
    /// assert_eq!(of(-500.0), None);
    /// ```
    pub fn of(window: &Window) -> Option<Self> {
        let level = window.gsd.log2().round() as i32;
        let extent = Self::extent(level);
        let key = Self {
            level,
            north: (window.north_edge / extent).round() as i64 - 1,
            east: (window.west_edge / extent).round() as i64,
        };
        (key.window() == *window).then_some(key)
    }

    fn parent(&self) -> Self {
        Self {
            level: self.level + 1,
            north: self.north.div_euclid(2),
            east: self.east.div_euclid(2),
        }
    }

    /// The tiles of a level that touch `ground`.
    fn covering(level: i32, ground: &GroundRect) -> Vec<Self> {
        let extent = Self::extent(level);
        let index = |v: f64| (v / extent).floor() as i64;
        let (south, north) = (index(ground.south), index(ground.north));
        let (west, east) = (index(ground.west), index(ground.east));
        if (north - south + 1) * (east - west + 1) > 400 {
            return Vec::new();
        }
        (south..=north)
            .flat_map(|north| (west..=east).map(move |east| Self { level, north, east }))
            .collect()
    }
}

struct Held {
    texture: TextureHandle,
    last_used: u64,
}

/// The textures, and what is still missing.
#[derive(Default)]
pub struct TileCache {
    held: HashMap<TileKey, Held>,
    /// A picture of ground that stands in where there is no tile yet.
    ground: Option<(GroundRect, TextureHandle)>,
    empty: HashSet<TileKey>,
    /// Tiles that are not whole, with the refresh after which they came.
    partial: HashMap<TileKey, u64>,
    refreshes: u64,
    wanted: Vec<TileKey>,
    frame: u64,
}

impl TileCache {
    /// Forgets everything: another map is shown.
    pub fn clear(&mut self) {
        *self = Self::default();
    }

    /// Lays a picture of the map below its tiles, until another map is shown.
    pub fn lay_ground(&mut self, context: &egui::Context, ground: GroundRect, image: ColorImage) {
        let texture = context.load_texture("ground", image, TextureOptions::LINEAR);
        self.ground = Some((ground, texture));
    }

    /// Whether a picture of the map lies below its tiles.
    pub fn has_ground(&self) -> bool {
        self.ground.is_some()
    }

    /// Tiles that are missing, the most urgent first.
    pub fn wanted(&self) -> &[TileKey] {
        &self.wanted
    }

    /// Whether every tile in sight is there, and whole.
    pub fn is_whole(&self) -> bool {
        self.wanted.is_empty() && self.partial.is_empty()
    }

    /// Textures that are kept.
    pub fn count(&self) -> usize {
        self.held.len()
    }

    /// Whether there are tiles that are not whole.
    pub fn is_partial(&self) -> bool {
        !self.partial.is_empty()
    }

    /// Tiles that came empty are asked for again.
    pub fn forget_empty(&mut self) {
        self.empty.clear();
        self.refresh();
    }

    /// More of the map is ready: tiles that are not whole are asked for again.
    pub fn refresh(&mut self) {
        self.refreshes += 1;
    }

    /// Whether a tile has to be asked for.
    fn is_missing(&self, key: &TileKey) -> bool {
        match self.partial.get(key) {
            Some(came) => *came < self.refreshes,
            None => !self.held.contains_key(key) && !self.empty.contains(key),
        }
    }

    /// Takes the pixels of a tile; one that is not `whole` is asked for again after a refresh.
    pub fn insert(
        &mut self,
        context: &egui::Context,
        window: &Window,
        pixels: &Raster<Rgba>,
        whole: bool,
    ) {
        let Some(key) = TileKey::of(window) else {
            return;
        };
        self.wanted.retain(|k| *k != key);
        if whole {
            self.partial.remove(&key);
        } else {
            self.partial.insert(key, self.refreshes);
        }
        let is_empty = pixels.is_empty() || pixels.pixels().iter().all(|p| p[3] == 0);
        if is_empty && !whole {
            return;
        }
        if is_empty {
            self.held.remove(&key);
            self.empty.insert(key);
            return;
        }
        let size = [pixels.width(), pixels.height()];
        let image = ColorImage::from_rgba_unmultiplied(size, pixels.pixels().as_flattened());
        let name = format!("tile {} {} {}", key.level, key.north, key.east);
        let texture = context.load_texture(name, image, TextureOptions::LINEAR);
        let last_used = self.frame;
        self.held.insert(key, Held { texture, last_used });
    }

    /// Draws the map in `screen` and notes what is missing.
    pub fn paint(
        &mut self,
        painter: &Painter,
        view: &ScreenFromWorld,
        screen: Rect,
        map: &MapInfo,
    ) {
        self.frame += 1;
        let pixel = view.metres_per_point / f64::from(painter.pixels_per_point());
        let finest = map.native_gsd.max(0.01).log2().floor() as i32;
        let level = (pixel.log2() + 0.25).floor().max(f64::from(finest)) as i32;
        let visible = view.visible(screen);
        let Some(ground) = visible.intersection(&map.bounds) else {
            self.wanted.clear();
            return;
        };
        let tiles = TileKey::covering(level, &ground);
        let mut stand_ins: Vec<TileKey> = Vec::new();
        let mut missing: Vec<TileKey> = Vec::new();
        for key in &tiles {
            if self.is_missing(key) {
                missing.push(*key);
            }
            if self.held.contains_key(key) || self.empty.contains(key) {
                continue;
            }
            let mut ancestor = *key;
            for _ in 0..ANCESTORS {
                ancestor = ancestor.parent();
                if self.held.contains_key(&ancestor) {
                    stand_ins.push(ancestor);
                    break;
                }
            }
        }
        if !missing.is_empty()
            && let Some((ground, texture)) = &self.ground
        {
            paint_textured(painter, view, ground, texture);
        }
        let coarse_first = |k: &TileKey| (-k.level, k.north, k.east);
        sort(&mut stand_ins, &|a, b| {
            coarse_first(a).cmp(&coarse_first(b))
        });
        stand_ins.dedup();
        for key in stand_ins.iter().chain(&tiles) {
            self.paint_tile(painter, view, *key);
        }
        self.note_missing(
            missing,
            view,
            &ground,
            map.is_coarse_cheap.then_some(level + 1),
        );
        self.evict();
    }

    fn note_missing(
        &mut self,
        mut missing: Vec<TileKey>,
        view: &ScreenFromWorld,
        ground: &GroundRect,
        rough: Option<i32>,
    ) {
        let distance = |k: &TileKey| k.window().rect().center().distance(&view.center);
        sort(&mut missing, &|a, b| distance(a).total_cmp(&distance(b)));
        // A rougher picture first, where there is nothing at all yet.
        let mut wanted: Vec<TileKey> = rough
            .into_iter()
            .flat_map(|level| TileKey::covering(level, ground))
            .filter(|k| self.is_missing(k))
            .collect();
        sort(&mut wanted, &|a, b| distance(a).total_cmp(&distance(b)));
        if missing.is_empty() {
            wanted.clear();
        }
        wanted.extend(missing);
        self.wanted = wanted;
    }

    fn paint_tile(&mut self, painter: &Painter, view: &ScreenFromWorld, key: TileKey) {
        let Some(held) = self.held.get_mut(&key) else {
            return;
        };
        held.last_used = self.frame;
        paint_textured(painter, view, &key.window().rect(), &held.texture);
    }

    fn evict(&mut self) {
        if self.held.len() <= CAPACITY {
            return;
        }
        let mut ages: Vec<u64> = self.held.values().map(|h| h.last_used).collect();
        ages.sort_unstable();
        let oldest_kept = ages[self.held.len() - CAPACITY * 3 / 4];
        let now = self.frame;
        self.held
            .retain(|_, h| h.last_used >= oldest_kept || h.last_used == now);
        if self.partial.len() > 8 * CAPACITY {
            self.partial.clear();
        }
    }
}

/// Draws a picture of ground where it lies.
fn paint_textured(
    painter: &Painter,
    view: &ScreenFromWorld,
    ground: &GroundRect,
    texture: &TextureHandle,
) {
    let mut mesh = Mesh::with_texture(texture.id());
    let uv = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    for (pos, (u, v)) in view.corners(ground).into_iter().zip(uv) {
        mesh.vertices.push(Vertex {
            pos,
            uv: pos2(u, v),
            color: Color32::WHITE,
        });
    }
    mesh.add_triangle(0, 1, 2);
    mesh.add_triangle(0, 2, 3);
    painter.add(Shape::mesh(mesh));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tile_that_is_not_whole_is_asked_for_again_and_one_of_nothing_only_by_hand() {
        let context = egui::Context::default();
        let mut cache = TileCache::default();
        let key = |east| TileKey {
            level: 0,
            north: 0,
            east,
        };
        let nothing = Raster::filled(SIDE, SIDE, [0; 4]);
        cache.insert(&context, &key(0).window(), &nothing, false);
        cache.insert(&context, &key(1).window(), &nothing, true);
        let missing = |cache: &TileCache| [0, 1].map(|east| cache.is_missing(&key(east)));
        assert_eq!(missing(&cache), [false, false]);
        assert!(cache.is_partial());
        cache.refresh();
        assert_eq!(missing(&cache), [true, false]);
        cache.forget_empty();
        assert_eq!(missing(&cache), [true, true]);
        let pixels = Raster::filled(SIDE, SIDE, [9, 9, 9, 255]);
        cache.insert(&context, &key(0).window(), &pixels, true);
        assert!(!cache.is_missing(&key(0)) && !cache.is_partial());
    }

    #[test]
    fn a_tile_is_found_again_by_its_window() {
        for (level, north, east) in [(0, 3, -4), (-2, -7, 12), (3, 0, 0)] {
            let key = TileKey { level, north, east };
            assert_eq!(TileKey::of(&key.window()), Some(key));
        }
    }

    #[test]
    fn a_parent_covers_its_child() {
        let child = TileKey {
            level: -1,
            north: -3,
            east: 5,
        };
        let outer = child.parent().window().rect();
        let inner = child.window().rect();
        assert!(outer.contains(&inner.center()));
        assert!((outer.width() - 2.0 * inner.width()).abs() < 1e-9);
    }

    #[test]
    fn the_tiles_of_a_view_cover_it() {
        let ground = GroundRect {
            south: -100.0,
            north: 300.0,
            west: -20.0,
            east: 700.0,
        };
        let tiles = TileKey::covering(0, &ground);
        for corner in [(-100.0, -20.0), (300.0, 700.0), (0.0, 350.0)] {
            let p = pilotage_core::frames::GroundPoint::new(corner.0, corner.1);
            assert!(tiles.iter().any(|t| t.window().rect().contains(&p)));
        }
    }
}
