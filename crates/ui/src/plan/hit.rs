//! Thing of the plan under the pointer, and the one that is being dragged.

use pilotage_core::frames::GroundPoint;

/// A corner of a no-fly area.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AreaCorner {
    /// Number of the area.
    pub area: usize,
    /// Number of the ring: 0 is the outline, 1 the first hole.
    pub ring: usize,
    /// Number of the corner in it.
    pub corner: usize,
}

/// Thing under the pointer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hit {
    /// A way-point of the selected route.
    WayPoint(usize),
    /// The middle of the leg behind a way-point of the selected route.
    Middle(usize),
    /// Another route.
    Route(u32),
    /// A corner of the selected landmark's outline.
    Corner(usize),
    /// A corner of a no-fly area.
    Area(AreaCorner),
    /// A rally point.
    Rally(usize),
}

/// The pointer's own state.
#[derive(Debug, Default)]
pub struct PlanPointer {
    /// The way-point that is being dragged.
    pub(super) dragged: Option<usize>,
    /// The landmark and the corner of its outline that is being dragged.
    pub(super) corner: Option<(u32, usize)>,
    /// The corner of a no-fly area that is being dragged.
    pub(super) area: Option<AreaCorner>,
    /// The rally point that is being dragged.
    pub(super) rally: Option<usize>,
    /// Thing that the pointer is over.
    pub(super) hovered: Option<Hit>,
    /// Place of the pointer, while something is drawn.
    pub(super) pointer: Option<GroundPoint>,
}
