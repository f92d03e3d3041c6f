//! Responses of a cascade to every window of a picture.

use super::model::Cascade;
use super::rows::{BATCH, RowsOfWindows, Scratch};
use pilotage_raster::raster::Raster;

/// Responses of a cascade to every window, by the window's upper left pixel; narrower and lower than the
/// picture by the window less one pixel, and empty if the window is larger.
#[derive(Clone, Debug, PartialEq)]
pub struct Responses {
    /// Stages that the window passed, at most 255.
    pub stages: Raster<u8>,
    /// Sum over all stages that the window met of its votes less the stage's threshold; to be compared
    /// among windows that met as many stages. Minus infinity for a window so flat that no stage
    /// is asked.
    pub score: Raster<f32>,
}

/// Shows `cascade` every window of `picture` at scale one, none left out.
pub fn responses(cascade: &Cascade, picture: &Raster<u8>) -> Responses {
    let columns = (picture.width() + 1).saturating_sub(cascade.width);
    let rows = (picture.height() + 1).saturating_sub(cascade.height);
    if columns == 0 || rows == 0 || cascade.stages.is_empty() {
        return Responses {
            stages: Raster::filled(0, 0, 0),
            score: Raster::filled(0, 0, 0.0),
        };
    }
    let mut scratch = Scratch::default();
    let shown = RowsOfWindows::new(cascade, picture, 1, &mut scratch);
    let mut stages = Raster::filled(columns, rows, 0_u8);
    let mut score = Raster::filled(columns, rows, f32::NEG_INFINITY);
    for y in (0..rows).step_by(BATCH) {
        let ys = (y..rows).take(BATCH);
        shown.show(ys, Some(1), &mut scratch, |seen| {
            let (x, y) = shown.position(seen.place);
            score.set(x, y, seen.margin as f32);
            if seen.passed {
                stages.set(x, y, (seen.stage + 1).min(255) as u8);
            }
        });
    }
    Responses { stages, score }
}
