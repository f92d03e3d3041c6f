//! Roads of a mission: lines in its file.

use std::collections::BTreeMap;

use super::found::LonLat;
use super::globe;
use pilotage_base::frames::LocalFrame;
use pilotage_roads::{RoadClass, RoadLine};

/// A road of a file.
#[derive(Default)]
pub(crate) struct FoundRoad {
    /// Name for people.
    pub name: Option<String>,
    /// Class, as its name in files.
    pub class: Option<String>,
    /// Width, metres.
    pub width: Option<f64>,
    /// Centre line.
    pub course: Vec<LonLat>,
    /// Unknown properties, as JSON text.
    pub properties: BTreeMap<String, String>,
}

impl FoundRoad {
    /// The road in the world.
    pub fn in_world(self, frame: &LocalFrame) -> RoadLine {
        let class = self.class.as_deref().and_then(RoadClass::of_highway);
        let class = class.unwrap_or_default();
        let width = self.width.filter(|width| *width > 0.0);
        let course = self.course.iter();
        RoadLine {
            name: self.name.unwrap_or_default(),
            class,
            width: width.unwrap_or_else(|| class.usual_width()),
            course: course
                .map(|(lon, lat)| globe::ground(frame, *lon, *lat))
                .collect(),
            properties: self.properties,
        }
    }
}
