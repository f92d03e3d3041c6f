//! Windows: samples averaged into pixels.

use super::shape::spot;
use super::world::SceneryWorld;
use pilotage_raster::imagery::Window;
use pilotage_raster::raster::{Raster, Rgba};

/// The pixels of a window. A coarse pixel averages a few samples, each of them already smoothed
/// over its own part of the pixel, so that the cost per pixel stays bounded at any scale.
pub(super) fn window(world: &SceneryWorld, window: &Window) -> Raster<Rgba> {
    let per_side = ((window.gsd / 1.25).ceil() as usize).clamp(1, 4);
    let step = window.gsd / per_side as f64;
    let share = 1.0 / (per_side * per_side) as f32;
    Raster::from_fn(window.width, window.height, |column, row| {
        let mut sum = [0.0_f32; 3];
        let mut covered = 0.0;
        for i in 0..per_side {
            let north = window.north_edge - window.gsd * row as f64 - step * (i as f64 + 0.5);
            for j in 0..per_side {
                let east = window.west_edge + window.gsd * column as f64 + step * (j as f64 + 0.5);
                if let Some(light) = world.light_at(spot(north as f32, east as f32), step as f32) {
                    for k in 0..3 {
                        sum[k] += light[k];
                    }
                    covered += share;
                }
            }
        }
        if covered < 0.5 {
            return [0; 4];
        }
        world.light.pixel(sum.map(|s| s * share / covered))
    })
}
