//! Roads as they are written: a line each.

use pilotage_base::frames::GroundPoint;
use serde::{Deserialize, Serialize};

/// Class of a road, from the least to the greatest, by the names of OpenStreetMap's `highway`.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
#[serde(rename_all = "lowercase")]
pub enum RoadClass {
    /// Way for people on foot or bicycles.
    Path,
    /// Way of fields and woods, mostly without a seal.
    Track,
    /// Way to a house, or within a car park.
    Service,
    /// Street of a village or town.
    #[default]
    Residential,
    /// Road between villages.
    Tertiary,
    /// Road between towns.
    Secondary,
    /// Main road.
    Primary,
    /// Road without crossings, or nearly so.
    Trunk,
    /// Motorway.
    Motorway,
}

impl RoadClass {
    /// Every class with its name in files and its usual width, metres.
    pub const ALL: [(Self, &'static str, f64); 9] = [
        (Self::Path, "path", 2.0),
        (Self::Track, "track", 2.7),
        (Self::Service, "service", 4.0),
        (Self::Residential, "residential", 5.8),
        (Self::Tertiary, "tertiary", 6.5),
        (Self::Secondary, "secondary", 7.2),
        (Self::Primary, "primary", 8.0),
        (Self::Trunk, "trunk", 10.0),
        (Self::Motorway, "motorway", 12.0),
    ];

    /// Name in files: a value of OpenStreetMap's `highway`.
    pub fn key(self) -> &'static str {
        Self::ALL[self as usize].1
    }

    /// Usual width, metres.
    pub fn usual_width(self) -> f64 {
        Self::ALL[self as usize].2
    }

    /// Class of what OpenStreetMap calls `highway`: ramps count as the road that they lead to; `None` for what is no
    /// road, such as steps, bus stops and roads that are not built.
    pub fn of_highway(value: &str) -> Option<Self> {
        let value = value.strip_suffix("_link").unwrap_or(value);
        let same = match value {
            "footway" | "cycleway" | "bridleway" => "path",
            "living_street" | "unclassified" | "road" | "pedestrian" => "residential",
            other => other,
        };
        let known = Self::ALL.iter().find(|(_, key, _)| *key == same);
        known.map(|(class, ..)| *class)
    }
}

/// A road as a line.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RoadLine {
    /// Name for people; empty where it has none.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Class.
    pub class: RoadClass,
    /// Width of what is driven on, metres.
    pub width: f64,
    /// Centre line, two points or more.
    pub course: Vec<GroundPoint>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_class_stands_at_its_place_in_the_list() {
        for (class, key, width) in RoadClass::ALL {
            assert_eq!((class.key(), class.usual_width()), (key, width));
            assert_eq!(RoadClass::of_highway(key), Some(class));
        }
    }

    #[test]
    fn ramps_are_roads_and_steps_are_none() {
        assert_eq!(
            RoadClass::of_highway("motorway_link"),
            Some(RoadClass::Motorway)
        );
        assert_eq!(
            RoadClass::of_highway("unclassified"),
            Some(RoadClass::Residential)
        );
        assert_eq!(RoadClass::of_highway("steps"), None);
        assert_eq!(RoadClass::of_highway("proposed"), None);
    }
}
