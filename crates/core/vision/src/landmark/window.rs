//! Windows of the map about a place.

use pilotage_base::frames::GroundPoint;
use pilotage_raster::imagery::Window;

/// The window in which the patch (of `size` pixels) may be moved by `reach` pixels around `center`.
pub fn window_around(
    center: GroundPoint,
    gsd: f64,
    size: (usize, usize),
    reach: (usize, usize),
) -> Window {
    Window {
        north_edge: center.north + (0.5 * size.1 as f64 + reach.1 as f64) * gsd,
        west_edge: center.east - (0.5 * size.0 as f64 + reach.0 as f64) * gsd,
        gsd,
        width: size.0 + 2 * reach.0,
        height: size.1 + 2 * reach.1,
    }
}
