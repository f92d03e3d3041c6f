//! A frame drawn over the map where it was laid, for people to judge.

use super::look::{FrameLook, MapPose};
use pilotage_raster::imagery::Window;
use pilotage_raster::raster::{Picture, Raster};

/// Squares of the chequerboard across the picture.
const SQUARES: f64 = 10.0;
/// Part of the footprint that is shown around it.
const AROUND: f64 = 0.15;

/// The map in colour around a laid frame, with the frame in grey in every other square of a chequerboard: roads
/// and roofs run on from square to square where it lies right. `across` is the picture's width in pixels.
pub fn overlay(
    look: &FrameLook<'_>,
    at: &MapPose,
    stored_turn: f64,
    across: usize,
) -> Option<Picture> {
    let camera = look.camera.stored_turned(stored_turn);
    let look = FrameLook {
        camera: &camera,
        ..*look
    };
    let footprint = look.footprint(at)?;
    let longer = footprint.width().max(footprint.height());
    let rect = footprint.grown(AROUND * longer);
    let window = Window::covering(&rect, rect.width() / across.max(1) as f64);
    let map = look.map.window(&window);
    let frame = look.rectified(at, &window);
    let side = (rect.width() / SQUARES / window.gsd).max(1.0);
    Some(Raster::from_fn(window.width, window.height, |x, y| {
        let is_frame = ((x as f64 / side) as usize + (y as f64 / side) as usize).is_multiple_of(2);
        let is_seen = frame.complete || frame.seen.get(x, y) > 0.0;
        if is_frame && is_seen {
            [frame.luminance.get(x, y).clamp(0.0, 255.0) as u8; 3]
        } else {
            let [r, g, b, _] = map.get(x, y);
            [r, g, b]
        }
    }))
}
