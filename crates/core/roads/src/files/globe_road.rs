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
    /// Middle of the box around all roads, the origin of a world for them; `None` without a road. Of two places, the box
    /// leads the shorter way around the globe.
    pub fn middle(&self) -> Option<Geodetic> {
        let places = self.roads.iter().flat_map(|road| &road.course);
        let around = places.fold(None, |around: Option<[f64; 5]>, (lon, lat)| {
            let [first, west, south, east, north] =
                around.unwrap_or([*lon, *lon, *lat, *lon, *lat]);
            // On both sides of the date line, longitudes differ by 360° from what they are beside the first.
            let lon = first + from_meridian(lon - first);
            Some([
                first,
                west.min(lon),
                south.min(*lat),
                east.max(lon),
                north.max(*lat),
            ])
        });
        let [_, west, south, east, north] = around?;
        Some(Geodetic::from_degrees(
            0.5 * (south + north),
            from_meridian(0.5 * (west + east)),
            0.0,
        ))
    }

    /// The roads in the world of `frame` without points on the other side of the globe, which have no place on its plane; a road
    /// of which less than two are left is left out.
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
                .filter(|point| point.north.is_finite() && point.east.is_finite())
                .collect(),
            ..RoadLine::default()
        };
        let lines = self.roads.iter().map(line);
        lines.filter(|line| line.course.len() > 1).collect()
    }
}

/// The same longitude from -180 to 180, degrees.
fn from_meridian(longitude: f64) -> f64 {
    longitude - 360.0 * (longitude / 360.0).round()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course_length;

    /// A tenth of a degree of longitude at 16.8° south is 10 659.81 m on WGS 84: 0.1° of its prime vertical radius,
    /// 6 379 921.9 m, times the cosine of the latitude.
    #[test]
    fn roads_on_both_sides_of_the_date_line_have_their_middle_on_it() {
        let across = GlobeRoad {
            course: vec![(179.95, -16.8), (-179.95, -16.8)],
            ..GlobeRoad::default()
        };
        let read = RoadsRead {
            roads: vec![across],
            ..RoadsRead::default()
        };
        let middle = read.middle().unwrap();
        assert!((middle.longitude.to_degrees().abs() - 180.0).abs() < 1e-9);
        let lines = read.in_world(&LocalFrame::new(middle));
        let length = course_length(&lines[0].course);
        assert!((length - 10_659.81).abs() < 0.1, "{length}");
    }

    #[test]
    fn the_middle_is_that_of_the_box_wherever_the_first_road_lies() {
        let road = |longitude: f64| GlobeRoad {
            course: vec![(longitude, 47.0), (longitude, 47.2)],
            ..GlobeRoad::default()
        };
        for longitudes in [[8.0, 8.4, 8.1], [8.4, 8.1, 8.0], [368.1, 8.4, 8.0]] {
            let read = RoadsRead {
                roads: longitudes.map(road).to_vec(),
                ..RoadsRead::default()
            };
            let middle = read.middle().unwrap();
            assert!((middle.longitude.to_degrees() - 8.2).abs() < 1e-9);
            assert!((middle.latitude.to_degrees() - 47.1).abs() < 1e-9);
        }
    }
    #[test]
    fn points_on_the_other_side_of_the_globe_are_left_out() {
        let road = |course: &[(f64, f64)]| GlobeRoad {
            course: course.to_vec(),
            ..GlobeRoad::default()
        };
        let read = RoadsRead {
            roads: vec![
                road(&[(-92.0, 46.8), (0.0, 0.0), (-92.0, 46.81)]),
                road(&[(88.0, -46.8), (88.0, -46.9)]),
            ],
            ..RoadsRead::default()
        };
        let duluth = LocalFrame::new(Geodetic::from_degrees(46.8, -92.0, 0.0));
        let lines = read.in_world(&duluth);
        // A hundredth of a degree of latitude.
        let length = course_length(&lines[0].course);
        assert!((length - 1111.8).abs() < 0.5, "{length}");
        assert_eq!(lines.len(), 1);
    }
}
