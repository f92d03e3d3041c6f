//! Roads of a file or of a built-in scenario.

use std::path::Path;

use pilotage_core::frames::LocalFrame;
use pilotage_core::roads::files::{RoadsRead, read_roads};
use pilotage_core::roads::{RoadClass, RoadJoining, RoadLine, RoadMap};
use pilotage_core::simulate::{Scenario, world_origin};
use pilotage_jobs::{left_out_of_roads, without_roads};

/// Roads of a file, on the globe, or of the generated world.
pub enum RoadSource {
    /// Of a file.
    File(RoadsRead),
    /// Of the generated world, in its own frame.
    World(Vec<RoadLine>),
}

impl RoadSource {
    /// Opens the file, or the scenario of that name.
    pub fn open(name: &str) -> Result<Self, String> {
        if !Path::new(name).exists() && Scenario::named(name).is_some() {
            return Ok(Self::World(Scenario::map().road_map().lines().to_vec()));
        }
        let bytes = std::fs::read(name).map_err(|e| format!("{name}: {e}"))?;
        let read = read_roads(&bytes).map_err(|e| format!("{name}: {e}"))?;
        if read.roads.is_empty() {
            return Err(without_roads(name));
        }
        Ok(Self::File(read))
    }

    /// Frame of a world for the roads.
    pub fn frame(&self) -> Result<LocalFrame, String> {
        let origin = match self {
            Self::File(read) => read
                .middle()
                .ok_or("there are no roads; give a file with some")?,
            Self::World(_) => world_origin(),
        };
        Ok(LocalFrame::new(origin))
    }

    /// The lines in the world of `frame`, or in their own.
    pub fn lines(&self, frame: Option<&LocalFrame>) -> Vec<RoadLine> {
        match self {
            Self::File(read) => {
                let own = read.middle().map(LocalFrame::new);
                frame
                    .or(own.as_ref())
                    .map_or_else(Vec::new, |frame| read.in_world(frame))
            }
            Self::World(lines) => {
                let own = LocalFrame::new(world_origin());
                let Some(frame) = frame.filter(|frame| frame.origin != own.origin) else {
                    return lines.clone();
                };
                let moved = |line: &RoadLine| RoadLine {
                    course: line
                        .course
                        .iter()
                        .map(|p| frame.ground_from_geodetic(&own.geodetic_from_ground(p)))
                        .collect(),
                    ..line.clone()
                };
                lines.iter().map(moved).collect()
            }
        }
    }

    /// The map of them: shared points join lines.
    pub fn map(&self, frame: Option<&LocalFrame>) -> RoadMap {
        RoadMap::new(self.lines(frame), RoadJoining::SHARED_POINTS)
    }

    /// Sentences about what was left out.
    pub fn notes(&self) -> Vec<String> {
        match self {
            Self::File(read) => left_out_of_roads(read),
            Self::World(_) => Vec::new(),
        }
    }
}

/// The class of that name, given by an option.
pub fn class(name: &str, option: &str) -> Result<RoadClass, String> {
    let known = RoadClass::ALL.iter().find(|(_, key, _)| *key == name);
    known.map(|(class, ..)| *class).ok_or_else(|| {
        let keys: Vec<&str> = RoadClass::ALL.iter().map(|(_, key, _)| *key).collect();
        let keys = keys.join(", ");
        format!("{option}: there is no class \"{name}\"; there are {keys}")
    })
}
