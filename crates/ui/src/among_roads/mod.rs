//! The place of a picture among the roads of the mission: sought in a worker, told on a card and on the map.

mod card;
mod feature;
mod on_map;

use pilotage_core::frames::Geodetic;
use pilotage_core::roads::RoadsMark;
use pilotage_jobs::{FoundAmongRoads, JobId, SoughtPicture};

use crate::command::Command;
use crate::feature_command::{AMONG_ROADS, FeatureCommand};

/// Something to do about the place of a picture among roads, once it is sought.
#[derive(Clone, Copy, Debug, PartialEq)]
enum AmongRoadsCommand {
    /// Stop the search.
    Stop,
    /// Show one of the places that were found, by its number.
    Choose(usize),
    /// Close the card, and stop the search.
    Close,
}

impl From<AmongRoadsCommand> for Command {
    fn from(command: AmongRoadsCommand) -> Self {
        Self::Feature(FeatureCommand::new(AMONG_ROADS, command))
    }
}

/// Picture that was sought, and the roads among which it was.
#[derive(Debug)]
struct AskedPlace {
    picture: SoughtPicture,
    /// Time of a camera picture, seconds in the flight's time base.
    time: Option<f64>,
    roads: RoadsMark,
    /// Origin of their world, if that has a place on the globe.
    origin: Option<Geodetic>,
}

/// Places of a picture among the roads of the mission.
#[derive(Debug, Default)]
pub struct AmongRoads {
    is_open: bool,
    asked: Option<AskedPlace>,
    job: Option<JobId>,
    /// Share of the search that is done, and what it does.
    at_work: (f32, String),
    /// Reason for which it came to nothing, in words.
    trouble: Option<String>,
    found: Option<FoundAmongRoads>,
    /// Number of the place that is looked at.
    chosen: Option<usize>,
    /// Whether there are roads, and a picture that can be sought.
    has_roads: bool,
    has_picture: bool,
    /// Words of how it is of something that is no longer open, if it is.
    of_before: Option<&'static str>,
}
