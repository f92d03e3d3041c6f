//! Commands of planning.

use pilotage_core::frames::{Altitude, GroundPoint};
use pilotage_core::mission::WayPointAction;
use pilotage_core::simulate::Wind;

use super::find_command::FindCommand;
use super::heat_command::HeatCommand;
use super::patterns::Pattern;
use super::purpose::Purpose;
use super::rehearsal::RehearseCommand;
use super::suggest_command::SuggestCommand;
use super::tab::PlanTab;
use super::train_command::TrainCommand;
use crate::command::Command;
use crate::documents::landmarks::LandmarkChange;
use crate::feature_command::{FeatureCommand, FeatureId};

/// Identity of the feature.
pub const ID: FeatureId = "plan";

/// A change of a no-fly area.
#[derive(Clone, Debug, PartialEq)]
pub enum AreaChange {
    /// Another name.
    Name(String),
    /// Another place of a corner.
    Corner {
        /// Number of the ring: 0 is the outline, 1 the first hole.
        ring: usize,
        /// Number of the corner in it.
        corner: usize,
        /// Its new place.
        to: GroundPoint,
    },
    /// No hole of that number any more: it must not be flown over either.
    FillHole(usize),
}

/// A change of a rally point.
#[derive(Clone, Debug, PartialEq)]
pub enum RallyChange {
    /// Another name.
    Name(String),
    /// Another place.
    Place(GroundPoint),
    /// Another altitude at which the aircraft comes there.
    Altitude(Altitude),
}

/// Something to do in the Plan workspace. Way-points are those of the selected route, counted from 0.
#[derive(Clone, Debug, PartialEq)]
pub enum PlanCommand {
    /// Something about the route with an id that is otherwise about the selected one: views give it for the route that
    /// they show, whichever is selected once it is carried out.
    OfRoute(u32, Box<PlanCommand>),
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
        /// Place of the new way-point.
        at: GroundPoint,
        /// Whether it is one step of its own.
        finished: bool,
    },
    /// Move a way-point; `finished` is false while the drag goes on.
    MoveWayPoint {
        /// Index of the way-point.
        index: usize,
        /// New place of the way-point.
        to: GroundPoint,
        /// Whether the drag is over (one undo step).
        finished: bool,
    },
    /// Delete a way-point; the selected one if `None`.
    DeleteWayPoint(Option<usize>),
    /// Give a way-point, or all of them, another altitude; `finished` as for a drag.
    SetAltitude {
        /// Index of the way-point; all if `None`.
        index: Option<usize>,
        /// The altitude.
        altitude: Altitude,
        /// Whether the drag is over.
        finished: bool,
    },
    /// Airspeed of the leg that leads to a way-point, m/s; the aircraft's cruise if `None`.
    SetSpeed {
        /// Index of the way-point.
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
    /// Name a route.
    RenameRoute {
        /// Its id.
        id: u32,
        /// The name.
        name: String,
    },
    /// The standard deviation that is accepted, metres.
    SetLimit(f64),
    /// Action at a way-point; `finished` as for a drag.
    SetAction {
        /// Index of the way-point.
        index: usize,
        /// New action.
        action: WayPointAction,
        /// Whether the drag is over.
        finished: bool,
    },
    /// Take off at the first way-point, or fly past it.
    ToggleTakeOff,
    /// Return home at the end, or not.
    ToggleReturn,
    /// Land at the last way-point, or fly past it.
    ToggleLanding,
    /// Change a rally point; `finished` as for a drag.
    EditRally {
        /// Its number.
        index: usize,
        /// Change of the rally point.
        change: RallyChange,
        /// Whether the drag is over.
        finished: bool,
    },
    /// Delete a rally point, by its number.
    DeleteRally(usize),
    /// Make the selected route of another pattern; `finished` as for a drag.
    SetPattern {
        /// The pattern.
        pattern: Box<Pattern>,
        /// Whether the drag is over.
        finished: bool,
    },
    /// Passes along the selected route as a route of their own.
    CorridorAlong,
    /// Let the selected route be no pattern any more.
    ReleasePattern,
    /// Properties of the aircraft that the user states.
    SetAircraft {
        /// Bank limit, radians.
        bank: f64,
        /// Power in cruise, watts.
        power: Option<f64>,
        /// Energy on board, watt hours.
        energy: Option<f64>,
    },
    /// Show the heights of the route below the map instead of the uncertainty, or the other way round.
    ToggleProfile,
    /// Height of level ground, metres above mean sea level; `finished` as for a drag.
    SetGround {
        /// The height.
        height: f64,
        /// Whether the drag is over.
        finished: bool,
    },
    /// The wind to plan with; the flight's if `None`.
    SetWind(Option<Wind>),
    /// Measure how well landmarks are found.
    Assess(Vec<u32>),
    /// Measure the selected landmark.
    AssessSelected,
    /// Measure every landmark that is switched on.
    AssessAll,
    /// Measure from which heights and with which tilts the selected landmark is found.
    SurveyEnvelope,
    /// Something about the rehearsal of the selected route.
    Rehearse(RehearseCommand),
    /// Something about landmarks that are proposed.
    Suggest(SuggestCommand),
    /// Stop measuring.
    StopAssessing,
    /// Measure landmarks before anybody asks, or not.
    TestAhead(bool),
    /// Something about detectors that are trained.
    Train(TrainCommand),
    /// A second landmark like the selected one, or like each of the marked ones, beside it.
    DuplicateLandmark,
    /// Something about where fixes would be had.
    Heat(HeatCommand),
    /// Change a no-fly area; `finished` as for a drag.
    EditArea {
        /// Its number.
        index: usize,
        /// Change of the area.
        change: AreaChange,
        /// Whether the drag is over.
        finished: bool,
    },
    /// Delete a no-fly area, by its number.
    DeleteArea(usize),
    /// Something about finding a route.
    Find(FindCommand),
    /// Choose another tab of the column.
    ShowTab(PlanTab),
    /// Change landmarks; `finished` as for a drag.
    EditLandmarks {
        /// Ids of the landmarks.
        ids: Vec<u32>,
        /// Change of the landmarks.
        change: LandmarkChange,
        /// Whether the drag is over.
        finished: bool,
    },
    /// Delete landmarks.
    DeleteLandmarks(Vec<u32>),
    /// Mark landmarks in the table, beside the selected one.
    MarkLandmarks(Vec<u32>),
    /// Begin to mark something on the map by clicks, or stop.
    Mark(Purpose),
    /// Add a corner to the outline that is being marked.
    AddCorner(GroundPoint),
    /// Take the last corner back.
    RemoveCorner,
    /// Make of the corners what they are for.
    FinishMarking,
    /// Forget the corners.
    CancelMarking,
    /// Print the selected route with its map, legs, landmarks and prediction.
    PrintBrief,
}

impl PlanCommand {
    /// The same about a route, whichever is selected.
    #[must_use]
    pub fn of(self, route: u32) -> Self {
        Self::OfRoute(route, Box::new(self))
    }

    /// Whether it is about a way-point by its number, which is another one's once way-points came or went.
    pub(super) fn is_of_way_point(&self) -> bool {
        match self {
            Self::OfRoute(_, command) => command.is_of_way_point(),
            Self::MoveWayPoint { .. }
            | Self::InsertWayPoint { .. }
            | Self::SetSpeed { .. }
            | Self::SetAction { .. }
            | Self::SelectWayPoint(Some(_))
            | Self::DeleteWayPoint(Some(_))
            | Self::SetAltitude { index: Some(_), .. } => true,
            _ => false,
        }
    }

    /// Whether it is about a no-fly area or a rally point by its number, which is another one's once they came or went.
    pub(super) fn is_of_area_or_rally(&self) -> bool {
        matches!(
            self,
            Self::EditArea { .. }
                | Self::DeleteArea(_)
                | Self::EditRally { .. }
                | Self::DeleteRally(_)
        )
    }
}

impl From<PlanCommand> for Command {
    fn from(command: PlanCommand) -> Self {
        Self::Feature(FeatureCommand::new(ID, command))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_of_a_route_keeps_what_it_is_and_is_about_a_way_point_where_that_is() {
        let moved = PlanCommand::MoveWayPoint {
            index: 1,
            to: GroundPoint::default(),
            finished: true,
        };
        assert_eq!(
            moved.clone().of(7),
            PlanCommand::OfRoute(7, Box::new(moved.clone()))
        );
        for (command, is_of_way_point) in [
            (moved, true),
            (PlanCommand::DeleteWayPoint(Some(0)), true),
            (PlanCommand::DeleteWayPoint(None), false),
            (PlanCommand::SelectWayPoint(None), false),
            (PlanCommand::Reverse, false),
        ] {
            assert_eq!(command.is_of_way_point(), is_of_way_point, "{command:?}");
            assert_eq!(command.of(7).is_of_way_point(), is_of_way_point);
        }
    }
}
