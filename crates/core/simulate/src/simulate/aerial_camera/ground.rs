//! Light from the ground plane at every pixel.

use std::collections::BTreeMap;
use std::ops::Range;

use nalgebra::Rotation3;

use pilotage_base::frames::Pose;
use pilotage_raster::camera::{CameraModel, FARTHEST_HEIGHTS, RayTable};
use pilotage_raster::imagery::{Imagery, TILE_SIDE, Window};
use pilotage_raster::raster::Rgba;

use crate::simulate::channels::{between, floats, plus, times};

/// Side of the cells of the picture that share one level of detail, pixels.
const CELL: usize = 16;
/// Ground sample distance of the level of detail over the footprint of a pixel.
///
/// Two bilinear samples a quarter pixel off the centre on a diagonal cancel whatever repeats once
/// per pixel across or down; together they blur about as much as a square pixel with a good lens:
/// by √(0.25² + (0.5·0.5)²) = 0.35 pixels.
const SAMPLE_PER_FOOTPRINT: f64 = 0.5;
/// Coarsest level of detail.
const COARSEST: u32 = 16;
/// Colour where there is no ground: haze.
const HAZE: [f32; 3] = [168.0, 178.0, 188.0];

/// Red, green and blue of all pixels, 0 to 255.
pub(super) struct PixelLight {
    pub width: usize,
    pub samples: Vec<f32>,
}

/// The plane seen through the rays of a camera.
struct PlaneView<'a> {
    rays: &'a RayTable,
    /// Rows of the rotation from camera to world.
    world_from_camera: [[f32; 3]; 3],
    /// Lens over the ground, metres.
    height: f64,
    /// A quarter of a pixel in units of the rays.
    quarter: f32,
    /// Least downward part of a ray (z = 1 in the camera) that still meets near enough ground.
    lowest: f32,
}

impl PlaneView<'_> {
    /// Ground at a ray, metres (north, east) from the nadir point, and the downward part of the
    /// ray; `None` at the horizon.
    #[inline]
    fn ground(&self, [x, y]: [f32; 2]) -> Option<(f32, f32, f32)> {
        let [north, east, down] = &self.world_from_camera;
        let turn = |row: &[f32; 3]| row[0] * x + row[1] * y + row[2];
        let z = turn(down);
        if z <= self.lowest {
            return None;
        }
        let scale = self.height as f32 / z;
        Some((scale * turn(north), scale * turn(east), z))
    }
}

/// Level of detail and the weight of the next coarser one.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Detail {
    level: u32,
    coarser: f32,
}

impl Detail {
    /// For a footprint of so many native pixels: one level in the middle of its range, two beside
    /// its ends, so that no seam shows.
    fn of(footprint: f64) -> Self {
        let ideal = (SAMPLE_PER_FOOTPRINT * footprint)
            .log2()
            .clamp(0.0, f64::from(COARSEST));
        let level = ideal.floor();
        let t = ((ideal - level - 0.25) / 0.5).clamp(0.0, 1.0);
        Self {
            level: level as u32,
            coarser: (t * t * (3.0 - 2.0 * t)) as f32,
        }
    }

    /// Levels that take part.
    fn levels(self) -> Range<u32> {
        let from = if self.coarser < 1.0 {
            self.level
        } else {
            self.level + 1
        };
        let to = if self.coarser > 0.0 {
            self.level + 2
        } else {
            self.level + 1
        };
        from..to
    }
}

/// Ground sample distance of a level of detail, metres per pixel.
fn gsd_of(native: f64, level: u32) -> f64 {
    native * 2f64.powi(level as i32)
}

/// A tile of the grid that [`CachedImagery`](pilotage_raster::imagery::CachedImagery) keeps.
fn tile_window(native: f64, level: u32, row: i64, column: i64) -> Window {
    let gsd = gsd_of(native, level);
    Window {
        north_edge: -((row * TILE_SIDE as i64) as f64) * gsd,
        west_edge: (column * TILE_SIDE as i64) as f64 * gsd,
        gsd,
        width: TILE_SIDE,
        height: TILE_SIDE,
    }
}

/// Tiles of one level put together.
struct TileMosaic {
    /// Pixels of the level's grid from the nadir point to the mosaic's corner, and per metre.
    south: f32,
    east: f32,
    per_metre: f32,
    width: usize,
    /// Largest coordinates at which the next pixel exists too.
    last: [f32; 2],
    pixels: Vec<Rgba>,
}

impl TileMosaic {
    fn new(imagery: &dyn Imagery, level: u32, tiles: &[(i64, i64)], nadir: (f64, f64)) -> Self {
        let span = |values: &mut dyn Iterator<Item = i64>| {
            values.fold((i64::MAX, i64::MIN), |(low, high), v| {
                (low.min(v), high.max(v))
            })
        };
        let (top, bottom) = span(&mut tiles.iter().map(|t| t.0));
        let (left, right) = span(&mut tiles.iter().map(|t| t.1));
        let width = (right - left + 1) as usize * TILE_SIDE;
        let height = (bottom - top + 1) as usize * TILE_SIDE;
        let mut pixels = vec![[0u8; 4]; width * height];
        let native = imagery.native_gsd();
        for &(row, column) in tiles {
            let tile = imagery.window(&tile_window(native, level, row, column));
            let start =
                (row - top) as usize * TILE_SIDE * width + (column - left) as usize * TILE_SIDE;
            for (y, line) in (0..tile.height()).map(|y| (y, tile.row(y))) {
                pixels[start + y * width..][..line.len()].copy_from_slice(line);
            }
        }
        let gsd = gsd_of(native, level);
        let side = TILE_SIDE as f64;
        Self {
            south: (-nadir.0 / gsd - top as f64 * side) as f32,
            east: (nadir.1 / gsd - left as f64 * side) as f32,
            per_metre: (1.0 / gsd) as f32,
            width,
            last: [(width - 2) as f32, (height - 2) as f32],
            pixels,
        }
    }

    /// Red, green, blue and coverage at a ground point from the nadir point, bilinear.
    #[inline]
    fn sample(&self, north: f32, east: f32) -> [f32; 4] {
        let x = (self.east + east * self.per_metre - 0.5).clamp(0.0, self.last[0]);
        let y = (self.south - north * self.per_metre - 0.5).clamp(0.0, self.last[1]);
        let (column, row) = (x as usize, y as usize);
        let (u, v) = (x - column as f32, y - row as f32);
        let start = row * self.width + column;
        let above = &self.pixels[start..][..2];
        let below = &self.pixels[start + self.width..][..2];
        let across = |pair: &[Rgba]| between(floats(pair[0]), floats(pair[1]), u);
        between(across(above), across(below), v)
    }
}

/// The light at each pixel of a camera over the plane `ground_down` metres below the origin.
pub(super) fn render(
    camera: &CameraModel,
    rays: &RayTable,
    imagery: &dyn Imagery,
    pose: &Pose,
    ground_down: f64,
) -> PixelLight {
    let mut light = PixelLight {
        width: camera.width,
        samples: HAZE.repeat(camera.width * camera.height),
    };
    let world_from_camera: Rotation3<f64> = camera.camera_from_world(pose).inverse();
    let lens = camera.lens_in_world(pose);
    let height = ground_down - lens.z;
    if !(height > 0.0 && height.is_finite() && lens.coords.norm().is_finite()) {
        return light;
    }
    let view = PlaneView {
        rays,
        world_from_camera: std::array::from_fn(|r| {
            std::array::from_fn(|c| world_from_camera[(r, c)] as f32)
        }),
        height,
        quarter: (0.25 / camera.focal) as f32,
        // A ray of the length of the axis; longer ones, off the axis, end a little farther out.
        lowest: (1.0 / FARTHEST_HEIGHTS) as f32,
    };
    let nadir = (lens.x, lens.y);
    let cells = cells(camera, &view, imagery.native_gsd(), nadir);
    let mut wanted: BTreeMap<u32, Vec<(i64, i64)>> = BTreeMap::new();
    for cell in &cells {
        for (level, rows, columns) in &cell.tiles {
            let tiles = wanted.entry(*level).or_default();
            for row in rows.clone() {
                tiles.extend(columns.clone().map(|column| (row, column)));
            }
        }
    }
    let mosaics: BTreeMap<u32, TileMosaic> = wanted
        .into_iter()
        .map(|(level, mut tiles)| {
            tiles.sort_unstable();
            tiles.dedup();
            (level, TileMosaic::new(imagery, level, &tiles, nadir))
        })
        .collect();
    for cell in &cells {
        let fine = mosaics
            .get(&cell.detail.level)
            .filter(|_| cell.detail.coarser < 1.0);
        let coarse = mosaics
            .get(&(cell.detail.level + 1))
            .filter(|_| cell.detail.coarser > 0.0);
        match (fine, coarse) {
            (Some(only), None) | (None, Some(only)) => {
                paint(&mut light, &view, cell, |north, east| {
                    only.sample(north, east)
                });
            }
            (Some(fine), Some(coarse)) => {
                let weight = cell.detail.coarser;
                paint(&mut light, &view, cell, |north, east| {
                    let (a, b) = (fine.sample(north, east), coarse.sample(north, east));
                    between(a, b, weight)
                });
            }
            (None, None) => {}
        }
    }
    light
}

/// A part of the picture at one level of detail.
struct Cell {
    columns: Range<usize>,
    rows: Range<usize>,
    detail: Detail,
    /// Tiles that it needs: level, rows, columns.
    tiles: Vec<(u32, Range<i64>, Range<i64>)>,
}

/// All cells that see ground.
fn cells(camera: &CameraModel, view: &PlaneView<'_>, native: f64, nadir: (f64, f64)) -> Vec<Cell> {
    let mut all = Vec::new();
    for top in (0..camera.height).step_by(CELL) {
        let rows = top..(top + CELL).min(camera.height);
        for left in (0..camera.width).step_by(CELL) {
            let columns = left..(left + CELL).min(camera.width);
            let corners = [rows.start, rows.end - 1]
                .into_iter()
                .flat_map(|row| [columns.start, columns.end - 1].map(|column| (row, column)));
            let seen: Vec<_> = corners
                .filter_map(|(row, column)| view.ground(view.rays.row(row)[column]))
                .map(|(north, east, z)| (f64::from(north), f64::from(east), f64::from(z)))
                .collect();
            if seen.is_empty() {
                continue;
            }
            // The plane seen through a ray (x, y, 1) has the area h² / z³ per unit of x and y,
            // with z the downward part of the ray; a pixel is 1/f wide.
            let z = seen.iter().map(|s| s.2).sum::<f64>() / seen.len() as f64;
            let footprint = view.height / (z.powf(1.5) * camera.focal);
            let detail = Detail::of(footprint / native);
            let span = |values: &mut dyn Iterator<Item = f64>| {
                values.fold((f64::MAX, f64::MIN), |(low, high), v| {
                    (low.min(v), high.max(v))
                })
            };
            let (south_end, north_end) = span(&mut seen.iter().map(|s| s.0 + nadir.0));
            let (west_end, east_end) = span(&mut seen.iter().map(|s| s.1 + nadir.1));
            let tiles = detail
                .levels()
                .map(|level| {
                    let gsd = gsd_of(native, level);
                    let side = TILE_SIDE as f64 * gsd;
                    let tile = |metres: f64| (metres / side).floor() as i64;
                    // One pixel for the interpolation, one for the bend of a distorted edge.
                    let margin = 2.0 * gsd;
                    (
                        level,
                        tile(-north_end - margin)..tile(-south_end + margin) + 1,
                        tile(west_end - margin)..tile(east_end + margin) + 1,
                    )
                })
                .collect();
            all.push(Cell {
                columns,
                rows: rows.clone(),
                detail,
                tiles,
            });
        }
    }
    all
}

/// Fills a cell from `sample(north, east)`.
#[inline]
fn paint(
    light: &mut PixelLight,
    view: &PlaneView<'_>,
    cell: &Cell,
    sample: impl Fn(f32, f32) -> [f32; 4],
) {
    for row in cell.rows.clone() {
        let rays = &view.rays.row(row)[cell.columns.clone()];
        let start = 3 * (row * light.width + cell.columns.start);
        let line = light.samples[start..][..3 * rays.len()]
            .as_chunks_mut::<3>()
            .0;
        for (target, &ray) in line.iter_mut().zip(rays) {
            let quarter = view.quarter;
            let one = view.ground([ray[0] - quarter, ray[1] - quarter]);
            let other = view.ground([ray[0] + quarter, ray[1] + quarter]);
            if let (Some((north, east, _)), Some((other_north, other_east, _))) = (one, other) {
                let (a, b) = (sample(north, east), sample(other_north, other_east));
                let [r, g, b, coverage] = times(plus(a, b), 0.5);
                // Pixels without data are black: their colour is already weighted.
                let missing = 1.0 - coverage * (1.0 / 255.0);
                *target = [
                    r + missing * HAZE[0],
                    g + missing * HAZE[1],
                    b + missing * HAZE[2],
                ];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_level_of_detail_follows_the_footprint_without_a_jump() {
        assert_eq!(
            Detail::of(0.2),
            Detail {
                level: 0,
                coarser: 0.0
            }
        );
        assert_eq!(Detail::of(2.9).levels(), 0..2);
        let mut last = 0.0;
        for step in 0..4000 {
            let detail = Detail::of(1.002f64.powi(step));
            let now = f64::from(detail.level) + f64::from(detail.coarser);
            assert!(
                now >= last - 1e-6 && now - last < 0.02,
                "{step}: {last} {now}"
            );
            last = now;
        }
    }
}
