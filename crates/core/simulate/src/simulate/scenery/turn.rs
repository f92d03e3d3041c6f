//! From the plan's coordinates to the world's and back: half a turn about the origin.

use super::scene_kind::{DistinctFeature, SceneLabel};
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_raster::imagery::Window;

/// The place on the other side.
pub(super) fn point(p: &GroundPoint) -> GroundPoint {
    GroundPoint::new(-p.north, -p.east)
}

/// The rectangle on the other side.
pub(super) fn rect(r: &GroundRect) -> GroundRect {
    GroundRect {
        south: -r.north,
        north: -r.south,
        west: -r.east,
        east: -r.west,
    }
}

/// The window on the other side; its pixels come in reverse order.
pub(super) fn window(w: &Window) -> Window {
    let turned = rect(&w.rect());
    Window {
        north_edge: turned.north,
        west_edge: turned.west,
        ..*w
    }
}

/// The feature on the other side.
pub(super) fn feature(f: &DistinctFeature) -> DistinctFeature {
    DistinctFeature {
        outline: f.outline.iter().map(point).collect(),
        landmark_box: rect(&f.landmark_box),
        ..f.clone()
    }
}

/// The label on the other side.
pub(super) fn label(l: SceneLabel) -> SceneLabel {
    SceneLabel {
        polygon: l.polygon.iter().map(point).collect(),
        ..l
    }
}
