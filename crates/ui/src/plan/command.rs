//! What people can ask for while they plan.

use pilotage_core::frames::{Altitude, GroundPoint};
use pilotage_core::simulate::Wind;

use super::finder::FindCommand;
use super::heat::HeatCommand;
use super::planner::PlanTab;

/// Something to do in the Plan workspace. Way-points are those of the selected route, counted from 0.
#[derive(Clone, Debug, PartialEq)]
pub enum PlanCommand {
    /// Begin to draw a new route, or finish it.
    ToggleDraw,
    /// Finish drawing.
    FinishDraw,
    /// Make the route of the built-in flight the first route.
    TakeFlightRoute,
    /// Select a route by id.
    SelectRoute(u32),
    /// Select a way-point, or none.
    SelectWayPoint(Option<usize>),
    /// Add a way-point at the end, or a new route that begins there; the middle of the map if `None`.
    AddWayPoint(Option<GroundPoint>),
    /// Insert a way-point behind another; `finished` is false while a drag goes on.
    InsertWayPoint {
        /// The way-point before it.
        behind: usize,
        /// Where.
        at: GroundPoint,
        /// Whether it is one step of its own.
        finished: bool,
    },
    /// Move a way-point; `finished` is false while the drag goes on.
    MoveWayPoint {
        /// Which.
        index: usize,
        /// Where to.
        to: GroundPoint,
        /// Whether the drag is over (one undo step).
        finished: bool,
    },
    /// Delete a way-point; the selected one if `None`.
    DeleteWayPoint(Option<usize>),
    /// Give a way-point, or all of them, another altitude; `finished` as for a drag.
    SetAltitude {
        /// Which; all if `None`.
        index: Option<usize>,
        /// The altitude.
        altitude: Altitude,
        /// Whether the drag is over.
        finished: bool,
    },
    /// Airspeed of the leg that leads to a way-point, m/s; the aircraft's cruise if `None`.
    SetSpeed {
        /// Which.
        index: usize,
        /// The speed.
        speed: Option<f64>,
        /// Whether the drag is over.
        finished: bool,
    },
    /// Fly the route the other way.
    Reverse,
    /// Make two routes of one at the selected way-point.
    Split,
    /// A second route like the selected one.
    DuplicateRoute,
    /// Delete the selected route.
    DeleteRoute,
    /// Name the selected route.
    RenameRoute(String),
    /// The standard deviation that is accepted, metres.
    SetLimit(f64),
    /// The wind to plan with; the flight's if `None`.
    SetWind(Option<Wind>),
    /// Measure how well landmarks are found.
    Assess(Vec<u32>),
    /// Measure the selected landmark.
    AssessSelected,
    /// Measure every landmark that is switched on.
    AssessAll,
    /// Stop measuring.
    StopAssessing,
    /// A second landmark like the selected one, beside it.
    DuplicateLandmark,
    /// Something about where fixes would be had.
    Heat(HeatCommand),
    /// Something about finding a route.
    Find(FindCommand),
    /// Choose another tab of the column.
    ShowTab(PlanTab),
}
