//! Nodes and ways of OpenStreetMap, and the roads among them.

use super::globe_road::{GlobeRoad, RoadsRead};
use crate::line::RoadClass;

/// A way with the tags that matter for a road.
#[derive(Default)]
pub struct OsmWay {
    pub nodes: Vec<i64>,
    highway: Option<String>,
    name: String,
    width: Option<String>,
    lanes: Option<String>,
    is_area: bool,
}

impl OsmWay {
    pub fn tag(&mut self, key: &str, value: &str) {
        match key {
            "highway" => self.highway = Some(value.to_owned()),
            "name" => value.clone_into(&mut self.name),
            "width" => self.width = Some(value.to_owned()),
            "lanes" => self.lanes = Some(value.to_owned()),
            "area" => self.is_area = value == "yes",
            _ => {}
        }
    }
}

/// Content of a file.
#[derive(Default)]
pub struct OsmData {
    /// Number, longitude and latitude in degrees.
    pub nodes: Vec<(i64, f64, f64)>,
    pub ways: Vec<OsmWay>,
}

impl OsmData {
    /// The roads, cut where the file lacks their points.
    pub fn roads(mut self) -> RoadsRead {
        self.nodes.sort_unstable_by_key(|node| node.0);
        let place = |number: &i64| {
            let index = self
                .nodes
                .binary_search_by_key(number, |node| node.0)
                .ok()?;
            let (_, longitude, latitude) = self.nodes[index];
            Some((longitude, latitude))
        };
        let mut read = RoadsRead::default();
        for way in &self.ways {
            let highway = way.highway.as_deref().filter(|_| !way.is_area);
            let Some(class) = highway.and_then(RoadClass::of_highway) else {
                read.others += 1;
                continue;
            };
            let mut runs = vec![Vec::new()];
            for number in &way.nodes {
                if let (Some(place), Some(run)) = (place(number), runs.last_mut()) {
                    run.push(place);
                } else {
                    read.missing_points += 1;
                    runs.push(Vec::new());
                }
            }
            for course in runs.into_iter().filter(|run| run.len() > 1) {
                let (width, lanes) = (way.width.as_deref(), way.lanes.as_deref());
                let road = GlobeRoad::new(class, &way.name, width, lanes, course);
                read.roads.push(road);
            }
        }
        read
    }
}
