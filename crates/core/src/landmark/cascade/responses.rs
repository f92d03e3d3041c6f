//! What a cascade says of every window of a picture.

use super::layout::Layout;
use super::model::Cascade;
use super::scan::Sight;
use crate::raster::Raster;

/// What a cascade says of every window, by the window's upper left pixel; narrower and lower than the
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
    let layout = Layout::new(
        &cascade.features,
        cascade.width,
        cascade.height,
        picture.width() + 1,
    );
    let sight = Sight::new(cascade, layout, picture);
    let columns = (picture.width() + 1).saturating_sub(cascade.width);
    let rows = (picture.height() + 1).saturating_sub(cascade.height);
    let mut stages = Raster::filled(columns, rows, 0);
    let score = Raster::from_fn(columns, rows, |x, y| {
        let seen = sight.look(x, y);
        stages.set(x, y, seen.passed.min(255) as u8);
        seen.margin as f32
    });
    Responses { stages, score }
}
