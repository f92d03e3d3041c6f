//! Roads among dropped files: `OpenStreetMap`'s XML and PBF, and GeoJSON with lines that name a `highway`.

use pilotage_core::flight::files::has_ending;
use pilotage_core::frames::{GroundPoint, GroundRect, LocalFrame};
use pilotage_core::roads::files::{RoadsRead, names_roads, read_roads};
use pilotage_core::roads::{RoadClass, RoadLine};

use super::ImportedFile;
use super::far_away::{FARTHEST, too_far};
use super::file_pool::contains;

/// Farthest from the mission's origin that roads are taken over, metres along each axis: an extract may be of a whole
/// country, of which a flight sees little.
const REACH: f64 = 30e3;

/// Endings of files of OpenStreetMap.
pub(super) const OF_OSM: [&str; 2] = ["osm", "pbf"];

/// Whether a file holds roads.
pub fn is_of_roads(name: &str, bytes: &[u8]) -> bool {
    has_ending(name, &OF_OSM)
        || has_ending(name, &["geojson", "json"])
            && contains(bytes, b"\"FeatureCollection\"")
            && contains(bytes, b"\"highway\"")
            && names_roads(bytes)
}

/// The roads of a file in the world of `frame`, with what was left out in sentences.
///
/// # Errors
/// A file that cannot be read, without a road, or from far away, in words.
pub fn roads_of(name: String, bytes: &[u8], frame: &LocalFrame) -> Result<ImportedFile, String> {
    let read = read_roads(bytes).map_err(|cause| format!("{name}: {cause}"))?;
    roads_in_world(name, &read, frame)
}

/// The roads that were read of a file in the world of `frame`, those near its origin, with what was left out in
/// sentences.
///
/// # Errors
/// A file without a road, or from far away, in words.
pub fn roads_in_world(
    name: String,
    read: &RoadsRead,
    frame: &LocalFrame,
) -> Result<ImportedFile, String> {
    let all = read.in_world(frame);
    let near = GroundRect::centered(GroundPoint::default(), 2.0 * REACH, 2.0 * REACH);
    let is_near = |road: &RoadLine| road.course.iter().any(|point| near.contains(point));
    let roads: Vec<RoadLine> = all.iter().filter(|road| is_near(road)).cloned().collect();
    if read.roads.is_empty() {
        return Err(without_roads(&name));
    }
    if roads.is_empty() {
        let places = all.iter().flat_map(|road| &road.course);
        let nearest = places.map(|p| p.distance(&GroundPoint::default()));
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        return Err(if nearest > FARTHEST {
            too_far(&name)
        } else {
            format!(
                "{name}: its roads lie over {:.0} km from here. Open a map of that place first",
                REACH / 1e3
            )
        });
    }
    Ok(ImportedFile {
        format: if has_ending(&name, &OF_OSM) {
            "OpenStreetMap"
        } else {
            "GeoJSON"
        }
        .to_owned(),
        name,
        notes: notes(&roads, read, read.roads.len() - roads.len()),
        roads,
        ..ImportedFile::default()
    })
}

/// Counts of the classes, and what was left out.
fn notes(roads: &[RoadLine], read: &RoadsRead, far: usize) -> Vec<String> {
    let classes = RoadClass::ALL.iter().rev().filter_map(|(class, key, _)| {
        let count = roads.iter().filter(|road| road.class == *class).count();
        (count > 0).then(|| format!("{count} {key}"))
    });
    let classes: Vec<String> = classes.collect();
    let mut notes = vec![format!("By class: {}", classes.join(", "))];
    if far > 0 {
        let reach = REACH / 1e3;
        notes.push(format!("{far} over {reach:.0} km from here were left out"));
    }
    notes.extend(left_out_of_roads(read));
    notes
}

/// Sentences on all that was left out of a file of roads.
pub fn left_out_of_roads(read: &RoadsRead) -> Vec<String> {
    let mut notes = Vec::new();
    if read.others > 0 {
        notes.push(format!(
            "Left out because they are no roads: {}",
            read.others
        ));
    }
    if read.missing_points > 0 {
        let missing = read.missing_points;
        notes.push(format!(
            "Points of roads that the file lacks, as at the edge of an extract: {missing}; roads end there"
        ));
    }
    notes
}

/// The complaint about a file without a road.
pub fn without_roads(name: &str) -> String {
    format!("{name}: no road is in it. Export an area with ways that have the tag highway")
}

#[cfg(test)]
mod tests {
    use pilotage_core::frames::Geodetic;

    use super::*;

    const TOWN: &str = r#"<osm version="0.6">
        <node id="1" lat="47.0" lon="8.0"/><node id="2" lat="47.001" lon="8.0"/>
        <node id="3" lat="47.001" lon="8.002"/><node id="4" lat="48.0" lon="8.0"/>
        <node id="5" lat="48.0" lon="8.1"/>
        <way id="9"><nd ref="1"/><nd ref="2"/><nd ref="99"/><tag k="highway" v="residential"/></way>
        <way id="10"><nd ref="2"/><nd ref="3"/><tag k="highway" v="track"/></way>
        <way id="11"><nd ref="4"/><nd ref="5"/><tag k="highway" v="primary"/></way>
        <way id="12"><nd ref="1"/><nd ref="3"/><tag k="waterway" v="stream"/></way></osm>"#;

    fn read(name: &str, text: &str, latitude: f64) -> Result<ImportedFile, String> {
        assert!(is_of_roads(name, text.as_bytes()));
        let frame = LocalFrame::new(Geodetic::from_degrees(latitude, 8.0, 0.0));
        roads_of(name.to_owned(), text.as_bytes(), &frame)
    }

    #[test]
    fn roads_near_the_mission_are_counted_by_class_and_the_rest_is_said_to_be_left_out() {
        let file = read("town.osm", TOWN, 47.0).unwrap();
        let classes: Vec<_> = file.roads.iter().map(|road| road.class).collect();
        assert_eq!(classes, [RoadClass::Residential, RoadClass::Track]);
        assert!((file.roads[0].course[1].north - 111.2).abs() < 0.3);
        let said = file.notes.join(". ");
        for part in [
            "By class: 1 residential, 1 track",
            "1 over 30 km",
            "no roads: 1",
            "edge of an extract: 1",
        ] {
            assert!(said.contains(part), "{said}");
        }
    }

    #[test]
    fn roads_from_far_away_are_refused_with_what_helps() {
        let cause = read("town.osm", TOWN, 10.0).unwrap_err();
        assert!(cause.contains("Open a map of that place first"), "{cause}");
        let cause = read("town.osm", TOWN, 47.5).unwrap_err();
        assert!(cause.contains("over 30 km from here"), "{cause}");
    }

    #[test]
    fn a_point_on_the_other_side_of_the_globe_is_left_out_of_its_road() {
        let file = |course: &str| {
            format!(
                r#"{{"type": "FeatureCollection", "features": [{{"type": "Feature",
                    "properties": {{"highway": "track"}},
                    "geometry": {{"type": "LineString", "coordinates": {course}}}}}]}}"#
            )
        };
        let stray = file("[[8.0, 47.0], [-172.0, -47.0], [8.001, 47.0]]");
        let course = &read("stray.geojson", &stray, 47.0).unwrap().roads[0].course;
        assert!(course.len() == 2 && course.iter().all(|p| p.distance(&course[0]) < 100.0));
        let far = file("[[-172.0, -47.0], [-172.001, -47.0]]");
        let cause = read("far.geojson", &far, 47.0).unwrap_err();
        assert!(cause.contains("Open a map of that place first"), "{cause}");
    }

    #[test]
    fn lines_of_geojson_with_a_highway_are_roads_and_no_routes() {
        let text = r#"{"type": "FeatureCollection", "features": [{"type": "Feature",
            "properties": {"highway": "tertiary", "name": "Mill Lane"},
            "geometry": {"type": "LineString", "coordinates": [[8.0, 47.0], [8.001, 47.0]]}}]}"#;
        let file = read("lanes.geojson", text, 47.0).unwrap();
        assert_eq!(file.roads[0].name, "Mill Lane");
        assert!(file.routes.is_empty());
        assert!(!is_of_roads("lanes.geojson", b"{\"FeatureCollection\": 1}"));
    }

    #[test]
    fn points_with_a_highway_are_no_roads_whatever_lines_are_beside_them() {
        let feature = |kind: &str, properties: &str, coordinates: &str| {
            format!(
                r#"{{"type": "Feature", "properties": {properties},
                    "geometry": {{"type": "{kind}", "coordinates": {coordinates}}}}}"#
            )
        };
        let file = |features: &[&str]| {
            let features = features.join(",");
            format!(r#"{{"type": "FeatureCollection", "features": [{features}]}}"#)
        };
        let line = "[[8.0, 47.0], [8.001, 47.0]]";
        let stop = feature("Point", r#"{"highway": "bus_stop"}"#, "[8.0, 47.0]");
        let route = feature("LineString", r#"{"name": "Flight"}"#, line);
        let roads = format!("[{line}]");
        let roads = feature("MultiLineString", r#"{"highway": "track"}"#, &roads);
        let is_of_roads = |text: String| is_of_roads("stops.geojson", text.as_bytes());
        assert!(!is_of_roads(file(&[&stop])));
        assert!(!is_of_roads(file(&[&stop, &route])));
        assert!(is_of_roads(file(&[&stop, &roads])));
    }

    #[test]
    fn a_broken_file_is_named() {
        let broken = r#"{"type": "FeatureCollection", "features": [{"highway": "#;
        let cause = read("lanes.geojson", broken, 47.0).unwrap_err();
        assert!(cause.starts_with("lanes.geojson: "), "{cause}");
        let cause = read("town.osm", "<osm><node id='x'", 47.0).unwrap_err();
        assert!(cause.starts_with("town.osm: "), "{cause}");
    }
}
