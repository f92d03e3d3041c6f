//! Roads as they are written: a line each.

use std::collections::BTreeMap;

use pilotage_base::frames::{GroundPoint, GroundRect};
use serde::{Deserialize, Serialize};

use crate::course::between;

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

    /// Class of what OpenStreetMap calls `highway`.
    ///
    /// ```
    /// use pilotage_roads::RoadClass;
    ///
    /// assert_eq!(RoadClass::of_highway("motorway_link"), Some(RoadClass::Motorway));
    /// assert_eq!(RoadClass::of_highway("steps"), None);
    /// ```
    ///
    /// Ramps count as the road that they lead to; `None` for what is no
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
    pub name: String,
    /// Class.
    pub class: RoadClass,
    /// Width of what is driven on, metres.
    pub width: f64,
    /// Centre line, two points or more.
    pub course: Vec<GroundPoint>,
    /// Properties that a file brought and we do not know, by name, as JSON text.
    #[serde(default)]
    pub properties: BTreeMap<String, String>,
}

impl RoadLine {
    /// The parts of it within `rect`, cut at the edge.
    pub fn within(&self, rect: &GroundRect) -> Vec<Self> {
        let mut parts: Vec<Vec<GroundPoint>> = Vec::new();
        for pair in self.course.windows(2) {
            let Some((from, to)) = shares_within(pair[0], pair[1], rect) else {
                continue;
            };
            // Points of the line stay as they are to the bit: by them lines are joined.
            let ends = [from, to].map(|share| match share {
                1.0 => pair[1],
                share => between(pair[0], pair[1], share),
            });
            match parts.last_mut() {
                Some(part) if part.last() == Some(&ends[0]) => part.push(ends[1]),
                _ => parts.push(ends.to_vec()),
            }
        }
        let part = |course| Self {
            course,
            ..self.clone()
        };
        parts.into_iter().map(part).collect()
    }
}

/// Shares of the way from `from` to `to` between which it lies within `rect`, if it does.
fn shares_within(from: GroundPoint, to: GroundPoint, rect: &GroundRect) -> Option<(f64, f64)> {
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for (start, end, low, high) in [
        (from.north, to.north, rect.south, rect.north),
        (from.east, to.east, rect.west, rect.east),
    ] {
        let way = end - start;
        if way == 0.0 {
            if start < low || start > high {
                return None;
            }
            continue;
        }
        let (a, b) = ((low - start) / way, (high - start) / way);
        first = first.max(a.min(b));
        last = last.min(a.max(b));
    }
    (first < last).then_some((first, last))
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

    #[test]
    fn a_line_that_leaves_a_square_and_comes_back_has_two_parts_in_it() {
        let course = [(0.0, 0.0), (20.0, 0.0), (20.0, 6.0), (0.0, 6.0)];
        let line = RoadLine {
            course: course.map(|(n, e)| GroundPoint::new(n, e)).to_vec(),
            ..RoadLine::default()
        };
        let rect = GroundRect::centered(GroundPoint::default(), 20.0, 20.0);
        let parts = line.within(&rect);
        let courses: Vec<_> = parts.iter().map(|part| part.course.clone()).collect();
        let part = |east| vec![GroundPoint::new(0.0, east), GroundPoint::new(10.0, east)];
        assert_eq!(courses[0], part(0.0));
        assert_eq!(courses[1], [part(6.0)[1], part(6.0)[0]]);
        let whole = rect.grown(10.0);
        assert_eq!(line.within(&whole), [line]);
    }
}
