//! Thing of the plan under the pointer, and the one that is being dragged.

use pilotage_core::frames::GroundPoint;

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
    /// A corner of a no-fly area: number of the area and of the corner.
    Area(usize, usize),
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
    /// The no-fly area and the corner of it that is being dragged.
    pub(super) area: Option<(usize, usize)>,
    /// The rally point that is being dragged.
    pub(super) rally: Option<usize>,
    /// Thing that the pointer is over.
    pub(super) hovered: Option<Hit>,
    /// Place of the pointer, while something is drawn.
    pub(super) pointer: Option<GroundPoint>,
}
