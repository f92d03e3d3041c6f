//! Pixels of invented ground: fields of three greens.

use pilotage_core::imagery::Window;
use pilotage_core::raster::{Raster, Rgba};
use pilotage_jobs::JobEvent;

/// Size of a field to the north and to the east, metres.
const FIELD: (f64, f64) = (60.0, 85.0);

/// Pixels of a window, put together of its rows, of which there are three: computed pixel by pixel, and each made a
/// colour of the screen, the ground took two fifths of the time of journeys through logs.
pub fn tile(window: Window) -> JobEvent {
    let ground = |c: usize, r: usize| window.ground_at(c as f64 + 0.5, r as f64 + 0.5);
    let columns = (0..window.width).map(|c| (ground(c, 0).east / FIELD.1).floor());
    let columns: Vec<f64> = columns.collect();
    let rows = [0.0, 1.0, 2.0].map(|first: f64| {
        let shade = |column: &f64| -> Rgba {
            let green = 88 + (13.0 * (first + column).rem_euclid(3.0)) as u8;
            [74, green, 52, 255]
        };
        columns.iter().map(shade).collect::<Vec<_>>()
    });
    let mut pixels = Vec::with_capacity(window.width * window.height);
    for r in 0..window.height {
        let first = (ground(0, r).north / FIELD.0).floor().rem_euclid(3.0);
        pixels.extend_from_slice(&rows[first as usize]);
    }
    let pixels = Raster::from_pixels(window.width, window.height, pixels);
    JobEvent::Tile {
        window,
        pixels: pixels.expect("rows of its width"),
        whole: true,
    }
}
