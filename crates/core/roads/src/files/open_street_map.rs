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

/// Roads of a file, and the nodes of these. A file is gone through twice: most of its nodes and ways are those of houses,
/// and only the ways tell which are not.
#[derive(Default)]
pub struct OsmData {
    ways: Vec<(RoadClass, OsmWay)>,
    /// Number of ways that are no roads.
    others: usize,
    /// Numbers of the nodes of roads, ascending.
    numbers: Vec<i64>,
    /// Longitude and latitude of each in degrees, where the file has it.
    places: Vec<Option<(f64, f64)>>,
}

/// Half of the work on a file.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum OsmPass {
    /// Ways, the roads among which are kept.
    Ways,
    /// Nodes, those of the roads among which are kept.
    Nodes,
}

impl OsmData {
    /// The roads of a file that `go_through` goes through.
    pub fn read<E>(
        mut go_through: impl FnMut(OsmPass, &mut Self) -> Result<(), E>,
    ) -> Result<RoadsRead, E> {
        let mut own = Self::default();
        go_through(OsmPass::Ways, &mut own)?;
        let numbers = own.ways.iter().flat_map(|(_, way)| way.nodes.iter());
        own.numbers = numbers.copied().collect();
        own.numbers.sort_unstable();
        own.numbers.dedup();
        own.places = vec![None; own.numbers.len()];
        go_through(OsmPass::Nodes, &mut own)?;
        Ok(own.roads())
    }

    /// Keeps a way that is a road.
    pub fn add_way(&mut self, way: OsmWay) {
        let highway = way.highway.as_deref().filter(|_| !way.is_area);
        match highway.and_then(RoadClass::of_highway) {
            Some(class) => self.ways.push((class, way)),
            None => self.others += 1,
        }
    }

    /// Keeps a node that a road has: its number, longitude and latitude in degrees.
    pub fn add_node(&mut self, number: i64, longitude: f64, latitude: f64) {
        if let Ok(index) = self.numbers.binary_search(&number) {
            self.places[index] = Some((longitude, latitude));
        }
    }

    /// The roads, cut where the file lacks their points.
    fn roads(self) -> RoadsRead {
        let place = |number: &i64| {
            let index = self.numbers.binary_search(number).ok()?;
            self.places[index]
        };
        let mut read = RoadsRead {
            others: self.others,
            ..RoadsRead::default()
        };
        for (class, way) in &self.ways {
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
                let road = GlobeRoad::new(*class, &way.name, width, lanes, course);
                read.roads.push(road);
            }
        }
        read
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_million_nodes_of_houses_those_of_the_one_road_are_kept() {
        let way = |highway: Option<&str>, nodes: std::ops::Range<i64>| {
            let mut way = OsmWay {
                nodes: nodes.collect(),
                ..OsmWay::default()
            };
            way.tag("building", "yes");
            if let Some(highway) = highway {
                way.tag("highway", highway);
            }
            way
        };
        let mut kept = (0, 0);
        let read = OsmData::read(|pass, data| {
            if pass == OsmPass::Ways {
                for house in 0..100_000 {
                    data.add_way(way(None, 10 * house..10 * house + 10));
                }
                data.add_way(way(Some("residential"), 500..503));
                data.add_way(way(Some("steps"), 700..703));
            } else {
                for number in 0..1_000_000 {
                    data.add_node(number, 1e-7 * number as f64, 50.0);
                }
            }
            kept = (data.ways.len(), data.numbers.len());
            Ok::<(), ()>(())
        });
        let read = read.unwrap();
        assert_eq!(kept, (1, 3));
        assert_eq!((read.roads.len(), read.others), (1, 100_001));
        assert_eq!(read.roads[0].course[2], (1e-7 * 502.0, 50.0));
        assert_eq!(read.missing_points, 0);
    }
}
