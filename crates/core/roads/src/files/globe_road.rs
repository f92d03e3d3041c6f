//! Roads on the globe.

use pilotage_base::frames::{Geodetic, LocalFrame};

use crate::line::{RoadClass, RoadLine};

/// Width of a lane where only their number is known, metres.
const LANE: f64 = 3.25;

/// Road as a file has it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GlobeRoad {
    /// Name for people; empty where it has none.
    pub name: String,
    /// Class.
    pub class: RoadClass,
    /// Width, metres.
    pub width: f64,
    /// Centre line: longitude and latitude, degrees.
    pub course: Vec<(f64, f64)>,
}

/// Roads of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RoadsRead {
    /// The roads in the order of the file.
    pub roads: Vec<GlobeRoad>,
    /// Lines that are no roads, or of a kind that is not known.
    pub others: usize,
    /// Points of roads that the file lacks, as extracts do at their edge.
    pub missing_points: usize,
}

impl GlobeRoad {
    /// A road of that class, as wide as `width` (a number of metres, with or without a unit) or `lanes` say, else as
    /// usual.
    pub(super) fn new(
        class: RoadClass,
        name: &str,
        width: Option<&str>,
        lanes: Option<&str>,
        course: Vec<(f64, f64)>,
    ) -> Self {
        let stated = width.and_then(|text| {
            let text = text.trim().trim_end_matches('m').trim_end();
            text.parse::<f64>().ok()
        });
        let by_lanes = lanes.and_then(|text| text.trim().parse::<f64>().ok());
        let width = stated
            .or_else(|| by_lanes.map(|lanes| LANE * lanes))
            .filter(|width| (0.5..=60.0).contains(width));
        Self {
            name: name.to_owned(),
            class,
            width: width.unwrap_or_else(|| class.usual_width()),
            course,
        }
    }
}

impl RoadsRead {
    /// Middle of the box around all roads, the origin of a world for them; `None` without a road.
    pub fn middle(&self) -> Option<Geodetic> {
        let places = self.roads.iter().flat_map(|road| &road.course);
        let around = places.fold(None, |around: Option<[f64; 4]>, (lon, lat)| {
            let [west, south, east, north] = around.unwrap_or([*lon, *lat, *lon, *lat]);
            Some([
                west.min(*lon),
                south.min(*lat),
                east.max(*lon),
                north.max(*lat),
            ])
        });
        let [west, south, east, north] = around?;
        Some(Geodetic::from_degrees(
            0.5 * (south + north),
            0.5 * (west + east),
            0.0,
        ))
    }

    /// The roads in the world of `frame`.
    pub fn in_world(&self, frame: &LocalFrame) -> Vec<RoadLine> {
        let line = |road: &GlobeRoad| RoadLine {
            name: road.name.clone(),
            class: road.class,
            width: road.width,
            course: road
                .course
                .iter()
                .map(|(lon, lat)| {
                    frame.ground_from_geodetic(&Geodetic::from_degrees(*lat, *lon, 0.0))
                })
                .collect(),
            ..RoadLine::default()
        };
        self.roads.iter().map(line).collect()
    }
}
