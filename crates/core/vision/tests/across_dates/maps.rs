//! By how much two maps of one place differ there.
//!
//! A mosaic of its own date has its own seams and its own error of relief: the same ground lies at places that differ
//! by metres, and not by the same metres everywhere. What one frame finds on both is compared with that.

use nalgebra::Vector2;
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::{
    ChannelSearch, ChannelTemplate, Gray, OrientationField, highest_peak,
};

/// Side of the ground that is compared, metres; the farthest that it may be moved to each side; metres per pixel.
const SIDE: f64 = 150.0;
const FARTHEST: f64 = 14.0;
const GSD: f64 = 1.0;

/// Shift of the ground around `place` of the map `from` on the map `to`, (north, east), metres; found by
/// correlating the orientation fields of both, no frame involved. `None` where either ends.
pub fn shift_between(
    from: &dyn Imagery,
    to: &dyn Imagery,
    place: GroundPoint,
) -> Option<Vector2<f64>> {
    let side = |margin: f64| GroundRect::centered(place, SIDE + 2.0 * margin, SIDE + 2.0 * margin);
    let (window, field) = field(from, &side(0.0));
    let template = ChannelTemplate::new(&field.channels, &field.covered)?;
    let (around, ground) = self::field(to, &side(FARTHEST));
    let surface = ChannelSearch::new(&ground.channels, &ground.covered).correlate(&template)?;
    let peak = highest_peak(&surface.score)?;
    Some(Vector2::new(
        around.north_edge - peak.y * GSD - window.north_edge,
        around.west_edge + peak.x * GSD - window.west_edge,
    ))
}

fn field(map: &dyn Imagery, rect: &GroundRect) -> (Window, OrientationField) {
    let window = Window::covering(rect, GSD);
    let pixels = map.window(&window);
    let covered: Gray = pixels.map(|p| if p[3] == 255 { 1.0 } else { 0.0 });
    (window, OrientationField::new(&pixels.to_gray(), &covered))
}
