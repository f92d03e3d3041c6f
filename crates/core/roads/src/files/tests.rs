//! Roads of made-up and real files.

use std::io::Write;
use std::path::Path;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use pilotage_base::frames::LocalFrame;

use super::*;
use crate::{RoadClass, RoadJoining, RoadMap, course_length};

const XML: &str = r#"<?xml version="1.0"?><osm version="0.6">
 <node id="1" lat="60.1" lon="24.9"/><node id="-2" lat="60.101" lon="24.9"><tag k="highway" v="crossing"/></node>
 <node id="3" lat="60.102" lon="24.901"/><node id="9" visible="false"/>
 <way id="7"><nd ref="1"/><nd ref="-2"/><nd ref="3"/><tag k="highway" v="primary_link"/>
  <tag k="name" v="Pohjois &amp; Etelä"/><tag k="width" v="7.5 m"/></way>
 <way id="8"><nd ref="3"/><nd ref="4"/><nd ref="-2"/><nd ref="1"/><tag k="highway" v="residential"/><tag k="lanes" v="2"/></way>
 <way id="10"><nd ref="1"/><nd ref="3"/><tag k="building" v="yes"/></way>
 <way id="11"><nd ref="1"/><nd ref="3"/><tag k="highway" v="pedestrian"/><tag k="area" v="yes"/></way>
</osm>"#;

fn shared(name: &str) -> Option<Vec<u8>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/data/osm_vectors");
    let bytes = std::fs::read(root.join(name)).ok();
    if bytes.is_none() {
        println!("skipped: no shared data ({name})");
    }
    bytes
}

#[test]
fn xml_has_its_ways_with_class_width_and_name() {
    let read = read_roads(XML.as_bytes()).unwrap();
    assert_eq!(
        (read.roads.len(), read.others, read.missing_points),
        (2, 2, 1)
    );
    let first = &read.roads[0];
    assert_eq!(
        (first.name.as_str(), first.class),
        ("Pohjois & Etelä", RoadClass::Primary)
    );
    assert_eq!(first.width, 7.5);
    assert_eq!(
        first.course,
        [(24.9, 60.1), (24.9, 60.101), (24.901, 60.102)]
    );
    // Of the second, one point is missing: what lies before is no line.
    assert_eq!(read.roads[1].course, [(24.9, 60.101), (24.9, 60.1)]);
    assert_eq!(read.roads[1].width, 6.5);
}

/// A field of a message: its number, and bytes or a number.
fn field(number: u8, bytes: &[u8]) -> Vec<u8> {
    let mut out = vec![number << 3 | 2];
    let mut size = bytes.len();
    while size >= 0x80 {
        out.push(size as u8 | 0x80);
        size >>= 7;
    }
    out.push(size as u8);
    out.extend_from_slice(bytes);
    out
}

fn block(kind: &str, content: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(content).unwrap();
    let blob = field(3, &encoder.finish().unwrap());
    let mut header = field(1, kind.as_bytes());
    header.extend([3 << 3, blob.len() as u8]);
    let mut out = (header.len() as u32).to_be_bytes().to_vec();
    out.extend(header);
    out.extend(blob);
    out
}

#[test]
fn pbf_has_dense_nodes_and_ways_and_refuses_what_it_needs_beyond() {
    let texts = ["", "highway", "track"]
        .map(|text| field(1, text.as_bytes()))
        .concat();
    // Nodes 5 and 6 at 1 and 2, 0 and -3 steps of latitude and longitude; a way over both.
    let dense = [field(1, &[10, 2]), field(8, &[2, 2]), field(9, &[0, 5])].concat();
    let way = [field(2, &[1]), field(3, &[2]), field(8, &[10, 2])].concat();
    let groups = [field(2, &field(2, &dense)), field(2, &field(3, &way))].concat();
    let content = [field(1, &texts), groups].concat();
    let header = block("OSMHeader", &field(4, b"DenseNodes"));
    let file = [header, block("OSMData", &content)].concat();
    let read = read_roads(&file).unwrap();
    assert_eq!(read.roads[0].class, RoadClass::Track);
    let expected = [(0.0, 1e-7), (-3e-7, 2e-7)];
    for (place, expected) in read.roads[0].course.iter().zip(expected) {
        assert!((place.0 - expected.0).abs() < 1e-15 && (place.1 - expected.1).abs() < 1e-15);
    }
    let history = block("OSMHeader", &field(4, b"HistoricalInformation"));
    let refused = read_roads(&history).unwrap_err().to_string();
    assert!(refused.contains("HistoricalInformation"), "{refused}");
    for end in 0..file.len() {
        // Never a panic; a file that ends between blocks is a shorter file.
        let _ = read_roads(&file[..end]);
    }
}

#[test]
fn lines_of_geojson_are_roads_if_they_say_so_or_none_does() {
    let line = |properties: &str| {
        format!(
            r#"{{"type":"Feature","properties":{properties},"geometry":{{"type":"LineString","coordinates":[[14.0,50.0],[14.1,50.0,230]]}}}}"#
        )
    };
    let file = |features: &[String]| {
        format!(
            r#"{{"type":"FeatureCollection","features":[{}]}}"#,
            features.join(",")
        )
    };
    let mixed = file(&[
        line(r#"{"highway":"trunk","width":9}"#),
        line("{}"),
        line("null"),
    ]);
    let read = read_roads(mixed.as_bytes()).unwrap();
    assert_eq!((read.roads.len(), read.others), (1, 2));
    assert_eq!(
        (read.roads[0].class, read.roads[0].width),
        (RoadClass::Trunk, 9.0)
    );
    assert_eq!(read.roads[0].course, [(14.0, 50.0), (14.1, 50.0)]);
    let frame = LocalFrame::new(read.middle().unwrap());
    let again = write_roads(&read.in_world(&frame), &frame);
    let again = read_roads(again.as_bytes()).unwrap();
    assert_eq!(
        (again.roads[0].class, again.roads[0].width),
        (RoadClass::Trunk, 9.0)
    );
    for (a, b) in again.roads[0].course.iter().zip(&read.roads[0].course) {
        assert!(
            (a.0 - b.0).abs() < 2e-8 && (a.1 - b.1).abs() < 2e-8,
            "{a:?} {b:?}"
        );
    }
    let plain = read_roads(file(&[line("{}"), line("null")]).as_bytes()).unwrap();
    assert_eq!(plain.roads.len(), 2);
    assert!(
        read_roads(b"{\"type\": }")
            .unwrap_err()
            .to_string()
            .contains("byte 9")
    );
    assert_eq!(read_roads(b"PK\x03\x04"), Err(RoadFileError::Unknown));
}

/// Figures of another reader (osmium 4): lines, their points, length in metres on a sphere, missing points, named
/// lines.
#[test]
fn real_extracts_have_the_roads_that_another_reader_finds() {
    for (name, lines, points, length, missing, named) in [
        ("Helsinki.osm.pbf", 2161, 8718, 90_591.811_9, 747, 792),
        ("test.osm.pbf", 331, 1995, 66_138.932_6, 446, 127),
    ] {
        let Some(bytes) = shared(name) else {
            return;
        };
        let read = read_roads(&bytes).unwrap();
        assert_eq!(read.roads.len(), lines, "{name}");
        assert_eq!(read.missing_points, missing, "{name}");
        let places: usize = read.roads.iter().map(|road| road.course.len()).sum();
        assert_eq!(places, points, "{name}");
        assert_eq!(
            read.roads.iter().filter(|r| !r.name.is_empty()).count(),
            named
        );
        let on_sphere: f64 = read
            .roads
            .iter()
            .flat_map(|road| road.course.windows(2))
            .map(haversine)
            .sum();
        assert!(
            (on_sphere / length - 1.0).abs() < 1e-6,
            "{name}: {on_sphere} {length}"
        );
        // In the world of the middle, on the ellipsoid.
        let frame = LocalFrame::new(read.middle().unwrap());
        let lines = read.in_world(&frame);
        let in_world: f64 = lines.iter().map(|line| course_length(&line.course)).sum();
        assert!(
            (in_world / length - 1.0).abs() < 5e-3,
            "{name}: {in_world} {length}"
        );
        let map = RoadMap::new(lines, RoadJoining::SHARED_POINTS);
        println!(
            "{name}: {} nodes, {} edges, {} crossings, {:.3} km",
            map.graph().node_count(),
            map.graph().edge_count(),
            map.crossings().len(),
            map.length() / 1000.0
        );
        assert!((map.length() - in_world).abs() < 1.0);
    }
}

#[test]
fn streets_of_bubenec_are_read_as_they_are() {
    let Some(bytes) = shared("bubenec_streets.geojson") else {
        return;
    };
    let read = read_roads(&bytes).unwrap();
    assert_eq!(
        (read.roads.len(), read.others, read.missing_points),
        (35, 0, 0)
    );
}

/// Distance on osmium's sphere, metres.
fn haversine(pair: &[(f64, f64)]) -> f64 {
    let [from, to] = [pair[0], pair[1]].map(|(lon, lat)| (lon.to_radians(), lat.to_radians()));
    let half = |angle: f64| (0.5 * angle).sin().powi(2);
    let share = half(to.1 - from.1) + from.1.cos() * to.1.cos() * half(to.0 - from.0);
    2.0 * 6_372_797.560_856 * share.sqrt().asin()
}
