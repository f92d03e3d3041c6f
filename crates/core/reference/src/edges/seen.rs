//! Straight edges of pictures and maps as landmarks.

use pilotage_base::frames::GroundRect;
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::{Gray, Raster, Rgba};
use pilotage_vision::straight_edge::straight_edges;

use crate::{GenericClass, GenericLandmark};

/// Name of their class in a table.
pub const EDGE: &str = "edge";
/// Their class in a table that names nothing else.
pub const EDGES: GenericClass = GenericClass::Other(0);
/// Ground in a pixel of pictures in which edges are sought, metres, from 100 m above it.
pub const EDGE_GSD: f64 = 0.5;
/// Length of the shortest edges, pixels.
const LEAST: f64 = 10.0;
/// Side of a tile of a map, metres, and the ground around that is looked at with it.
const TILE: f64 = 256.0;
const AROUND: f64 = 48.0;

/// Straight edges of `picture`, which shows `window`, north up, as landmarks of `class`: the place is the middle, the
/// size the length and the orientation the direction.
///
/// ```
/// use pilotage_raster::imagery::Window;
/// use pilotage_raster::raster::Raster;
/// use pilotage_reference::edges::{EDGES, edges_seen};
///
/// // Dark ground west of 20 m east, bright ground east of it, in pixels of half a metre.
/// let window = Window { north_edge: 40.0, west_edge: 0.0, gsd: 0.5, width: 80, height: 80 };
/// let shade = |column| if column < 40 { 60 } else { 180 };
/// let picture = Raster::from_fn(80, 80, |column, _| [shade(column), shade(column), shade(column), 255]);
/// let [edge] = &edges_seen(&window, &picture, EDGES)[..] else { panic!("one edge") };
/// assert!((edge.place.east - 20.0).abs() < 0.5 && edge.orientation.sin().abs() < 0.02);
/// ```
pub fn edges_seen(
    window: &Window,
    picture: &Raster<Rgba>,
    class: GenericClass,
) -> Vec<GenericLandmark> {
    let covered: Gray = picture.map(|pixel| f32::from(u8::from(pixel[3] == u8::MAX)));
    let edges = straight_edges(&picture.to_gray(), &covered, LEAST);
    let on_ground = edges.iter().map(|edge| GenericLandmark {
        place: window.ground_at(edge.middle[0], edge.middle[1]),
        class,
        size: edge.length * window.gsd,
        orientation: edge.direction,
        confidence: 1.0,
        stability: 1.0,
    });
    on_ground.collect()
}

/// Straight edges in and around a `tile` of a map, sought in pixels of `gsd` metres.
pub fn edges_of_tile(
    map: &dyn Imagery,
    tile: &GroundRect,
    gsd: f64,
    class: GenericClass,
) -> Vec<GenericLandmark> {
    let window = Window::covering(&tile.grown(AROUND), gsd);
    edges_seen(&window, &map.window(&window), class)
}

/// Straight edges of a map, sought in pixels of `gsd` metres, tile by tile: memory grows with the edges alone.
pub fn edges_in_map(map: &dyn Imagery, gsd: f64, class: GenericClass) -> Vec<GenericLandmark> {
    let bounds = map.bounds();
    let along = |size: f64| 0..(size / TILE).ceil() as usize;
    let tiles = along(bounds.height()).flat_map(|row| along(bounds.width()).map(move |c| (row, c)));
    let of_tile = tiles.flat_map(|(row, column)| {
        let (south, west) = (
            bounds.south + row as f64 * TILE,
            bounds.west + column as f64 * TILE,
        );
        let tile = GroundRect {
            south,
            north: south + TILE,
            west,
            east: west + TILE,
        };
        let mut edges = edges_of_tile(map, &tile, gsd, class);
        // An edge on the border of two tiles is in one of them.
        edges.retain(|edge| {
            (tile.south..tile.north).contains(&edge.place.north)
                && (tile.west..tile.east).contains(&edge.place.east)
        });
        edges
    });
    of_tile.collect()
}
