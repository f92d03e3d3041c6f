//! Commands about roads, and their rows of the table of all commands.

use egui::Key;
use pilotage_core::frames::GroundPoint;
use pilotage_core::roads::RoadClass;

use crate::command::Command;
use crate::feature_command::{FeatureCommand, FeatureId};
use crate::shell::catalog::{BarMenu, CommandEntry, CommandGroup, entry, shift};

/// Identity of the feature.
pub const ID: FeatureId = "roads";

/// Label of the command that begins the work on roads.
pub const LABEL: &str = "Draw and edit roads";

/// Label of the switch by which legs follow the road in the map's picture.
pub const FOLLOW: &str = "Follow the road in the picture";

/// Change of a road.
#[derive(Clone, Debug, PartialEq)]
pub enum RoadChange {
    /// Another name.
    Name(String),
    /// Another class.
    Class(RoadClass),
    /// Another width, metres.
    Width(f64),
    /// A new point before the one of that index.
    Insert(usize, GroundPoint),
}

/// Something to do about roads.
#[derive(Clone, Debug, PartialEq)]
pub enum RoadCommand {
    /// Begin, or leave.
    Toggle,
    /// Begin a road, or end the one that is being drawn.
    Draw,
    /// Put a point of the road that is being drawn there, in the middle of the map if nowhere else.
    Add(Option<GroundPoint>),
    /// Put a point there, with a straight line to it.
    AddStraight(GroundPoint),
    /// Take the last leg of the road that is being drawn back.
    TakeBack,
    /// Have the legs that are drawn next follow the road in the map's picture, or no more.
    ToggleFollowing,
    /// Leave what is under way, step by step.
    Back,
    /// Select a road, and one of its points.
    Select(Option<usize>, Option<usize>),
    /// Select the next road.
    Next,
    /// Select the next point of the selected road.
    NextPoint,
    /// Put the selected point into the middle of the map.
    MoveHere,
    /// Put these points, each of a road and its index there, to a place.
    Move {
        /// Points: one of the selected road, and those of other roads that it is a crossing with.
        points: Vec<(usize, usize)>,
        /// Place.
        to: GroundPoint,
        /// Whether the drag is over.
        finished: bool,
    },
    /// Change the selected road.
    Change {
        /// Change.
        change: RoadChange,
        /// Whether it is over.
        finished: bool,
    },
    /// Delete the selected point, with those of other roads that it is a crossing with, else the road.
    DeletePoint,
    /// Delete the selected road.
    Delete,
    /// Split the selected road at its selected point.
    Split,
    /// Join the selected road with one that meets its end, or with the one that is clicked next.
    Join,
    /// Join the selected road with that one.
    JoinWith(usize),
}

/// Command that changes the selected road; `finished` at the end of a drag or of typing.
pub fn change(change: RoadChange, finished: bool) -> RoadCommand {
    RoadCommand::Change { change, finished }
}

impl From<RoadCommand> for Command {
    fn from(command: RoadCommand) -> Self {
        Self::Feature(FeatureCommand::new(ID, command))
    }
}

/// Rows of the table of all commands.
pub fn commands() -> Vec<CommandEntry> {
    let of = |label, command: RoadCommand| {
        entry(CommandGroup::Edit, label, vec![], Command::from(command))
    };
    let toggle = RoadCommand::Toggle.into();
    let toggle = entry(CommandGroup::Edit, LABEL, vec![shift(Key::Y)], toggle);
    vec![
        toggle
            .also("street centre line osm trace")
            .under(BarMenu::View),
        of("Begin a road, or end it", RoadCommand::Draw),
        of(
            "Point of a road in the middle of the map",
            RoadCommand::Add(None),
        ),
        entry(
            CommandGroup::Edit,
            FOLLOW,
            vec![shift(Key::K)],
            RoadCommand::ToggleFollowing.into(),
        )
        .also("trace ridge snap centre line draw along"),
        of("Select the next road", RoadCommand::Next),
        of("Select the next point of the road", RoadCommand::NextPoint),
        of(
            "Put the point of the road into the middle of the map",
            RoadCommand::MoveHere,
        ),
        of("Delete the point of the road", RoadCommand::DeletePoint),
        of("Delete the road", RoadCommand::Delete),
        of("Split the road at the point", RoadCommand::Split),
        of("Join the road with one that meets it", RoadCommand::Join),
    ]
}
