//! Evidence of a search by templates: what it was given of the picture, and what it shows of itself.

use super::FrameView;
use pilotage_base::frames::GroundRect;
use pilotage_raster::imagery::Window;
use pilotage_raster::raster::Gray;

/// Pictures that explain a search.
#[derive(Clone, Debug, PartialEq)]
pub struct MatchEvidence {
    /// The map patch.
    pub patch: Gray,
    /// The rectified picture over the search region.
    pub rectified: Gray,
    /// Combined score at every offset of the patch.
    pub surface: Gray,
    /// Best places of the surface, best first: (column, row).
    pub peaks: Vec<(f64, f64)>,
    /// Metres per pixel.
    pub gsd: f64,
}

/// Ground sample distance of the camera in the middle of the picture, metres per pixel.
pub(super) fn camera_gsd(view: &FrameView<'_>) -> f64 {
    (view.ground_down - view.pose.position_in_world.z).max(0.1) / view.camera.focal
}

/// Part of `window` that can lie in the picture, cut at its pixels; `None` if nothing of it can.
pub(super) fn in_picture(window: &Window, view: &FrameView<'_>) -> Option<Window> {
    let footprint = view.camera.footprint(&view.pose, view.ground_down);
    let seen = GroundRect::around(footprint)?;
    window.touching(&seen).map(|(part, _)| part)
}
