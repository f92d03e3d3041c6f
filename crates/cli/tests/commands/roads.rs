//! `pilotage roads` as a user calls it.

use std::collections::BTreeMap;

use pilotage_core::frames::{Geodetic, LocalFrame};
use pilotage_core::mission::package::{MissionPackage, read_package, write_package};
use pilotage_core::mission::{Mission, read_mission, write_mission};
use pilotage_core::raster::{Picture, encode_png};
use pilotage_core::roads::files::read_roads;
use pilotage_core::roads::{course_length, place_along, place_near};
use pilotage_core::simulate::{Scenario, world_origin};

use super::folder::Folder;

const OSM: &str = r#"<osm version="0.6">
 <node id="1" lat="60.1700" lon="24.9400"/><node id="2" lat="60.1710" lon="24.9400"/>
 <node id="3" lat="60.1720" lon="24.9400"/><node id="4" lat="60.1710" lon="24.9420"/>
 <way id="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><tag k="highway" v="secondary"/><tag k="name" v="Quay"/></way>
 <way id="2"><nd ref="2"/><nd ref="4"/><tag k="highway" v="footway"/></way>
</osm>"#;

#[test]
fn roads_of_openstreetmap_are_printed_imported_exported_and_compared() {
    let folder = Folder::new("roads");
    folder.write("town.osm", OSM);
    let said = |words: &[&str]| folder.run(&[&["roads"], words].concat());
    let printed = said(&["print", "town.osm"]).unwrap();
    assert!(
        printed.contains("4 nodes, 3 edges, 1 crossings, 0.33"),
        "{printed}"
    );
    let import = [
        "import",
        "town.osm",
        "--mission",
        "m.geojson",
        "--least",
        "service",
    ];
    said(&import).unwrap();
    let mission = read_mission(&std::fs::read(folder.0.join("m.geojson")).unwrap()).unwrap();
    assert_eq!(mission.roads.len(), 1);
    assert_eq!(mission.roads[0].name, "Quay");
    // A mission in a zip stays one, with the files that are in it.
    let package = MissionPackage {
        mission: Mission::new("Town", mission.origin),
        settings: BTreeMap::new(),
        files: vec![("map.jgw".to_owned(), b"0.5".to_vec())],
    };
    folder.write("m.zip", write_package(&package).unwrap());
    said(&["import", "town.osm", "--mission", "m.zip"]).unwrap();
    let after = read_package(&std::fs::read(folder.0.join("m.zip")).unwrap()).unwrap();
    assert_eq!(
        (after.mission.roads.len(), after.files),
        (2, package.files.clone())
    );
    // As in the page, roads come beside those that are there, unless one says otherwise, those that are there already are
    // left out, and those far away are refused.
    let again = ["import", "town.osm", "--mission", "m.zip"];
    let added = said(&again).unwrap();
    assert!(
        added.contains("0 roads added, 2 left out that it has, 2 in all"),
        "{added}"
    );
    let replaced = said(&[&again[..], &["--replace"]].concat()).unwrap();
    assert!(
        replaced.contains("2 roads added in place of 2, 2 in all"),
        "{replaced}"
    );
    let far = Mission::new("Far", Geodetic::from_degrees(61.0, 24.94, 0.0));
    folder.write("far.geojson", write_mission(&far));
    let refused = said(&["import", "town.osm", "--mission", "far.geojson"]).unwrap_err();
    assert!(refused.contains("over 30 km from here"), "{refused}");
    said(&["export", "town.osm", "--out", "again.geojson"]).unwrap();
    let same = said(&["apls", "town.osm", "again.geojson"]).unwrap();
    assert!(same.starts_with("APLS 1.0000"), "{same}");
    let less = said(&["apls", "town.osm", "m.geojson"]).unwrap();
    assert!(less.starts_with("APLS 0."), "{less}");
    let refused = said(&["print", "nowhere.osm"]).unwrap_err();
    assert!(refused.contains("nowhere.osm"), "{refused}");
}

/// A town of 19 by 19 crooked blocks around a place, as GeoJSON; `seed` bends it, and all of it is turned by `turn`
/// radians about its middle. `within` keeps streets within so many degrees of the middle.
fn town(seed: u64, turn: f64, within: f64) -> String {
    let noise = |row: i32, column: i32, axis: u64| {
        let mut state = seed ^ ((row as u64 & 0xff) << 16) ^ ((column as u64 & 0xff) << 8) ^ axis;
        for _ in 0..3 {
            state = state
                .wrapping_mul(0x5851_f42d_4c95_7f2d)
                .wrapping_add(0x1405_7b7e_f767_814f);
            state ^= state >> 29;
        }
        (state % 1000) as f64 / 1000.0 - 0.5
    };
    let corner = |row: i32, column: i32| {
        let north = 0.001 * (f64::from(row) + 0.7 * noise(row, column, 1));
        let east = 0.001 * (f64::from(column) + 0.7 * noise(row, column, 2));
        (north, east)
    };
    // At the equator a degree is as long both ways.
    let turned = |(north, east): (f64, f64)| {
        let (sin, cos) = turn.sin_cos();
        [sin * north + cos * east, cos * north - sin * east]
    };
    let mut streets = Vec::new();
    for row in -9..=9 {
        for column in -9..=9 {
            for (other, axis) in [((row + 1, column), 3), ((row, column + 1), 4)] {
                let ends = [corner(row, column), corner(other.0, other.1)];
                let is_near = ends
                    .iter()
                    .all(|(n, e)| n.abs() < within && e.abs() < within);
                if is_near && noise(row, column, axis) > -0.3 {
                    let [[a, b], [c, d]] = ends.map(turned);
                    streets.push(format!(
                        r#"{{"type":"Feature","properties":{{"highway":"residential"}},"geometry":{{"type":"LineString","coordinates":[[{a},{b}],[{c},{d}]]}}}}"#
                    ));
                }
            }
        }
    }
    format!(
        r#"{{"type":"FeatureCollection","features":[{}]}}"#,
        streets.join(",")
    )
}

#[test]
fn roads_that_were_seen_are_found_in_their_town_and_not_in_another() {
    let folder = Folder::new("roads-lost");
    folder.write("town.geojson", town(1, 0.0, 1.0));
    folder.write("other.geojson", town(2, 0.0, 1.0));
    // Some blocks of the first, seen with north turned to the right by half a radian.
    folder.write("seen.geojson", town(1, 0.5, 0.0033));
    let said = |words: &[&str]| folder.run(&[&["roads", "lost"], words].concat());
    let found = said(&["town.geojson", "seen.geojson"]).unwrap();
    assert!(found.contains("heading 331."), "{found}");
    let elsewhere = said(&["other.geojson", "seen.geojson"]).unwrap();
    assert!(elsewhere.starts_with("no place"), "{elsewhere}");
    let refused = said(&["town.geojson", "seen.geojson", "seen.geojson"]).unwrap_err();
    assert!(refused.contains("2 views need 1 ways"), "{refused}");
    let at = format!("--around={}", found.split(':').next().unwrap());
    let around = said(&["town.geojson", "seen.geojson", &at, "--within=1"]).unwrap();
    assert!(around.contains("heading 331."), "{around}");
    let away = said(&["town.geojson", "seen.geojson", "--around=10,10"]).unwrap_err();
    assert!(away.contains("no road around that place"), "{away}");
    // Roads as they are drawn have the scale that they have.
    let exact = said(&["town.geojson", "seen.geojson", "--height-within=0"]).unwrap();
    assert!(exact.contains("heading 331."), "{exact}");
    for range in ["--height-within=nan", "--heading-within=-1"] {
        let refused = said(&["town.geojson", "seen.geojson", range]).unwrap_err();
        assert!(refused.contains("give a number, zero or more"), "{refused}");
    }
}

/// A town of [`town`] with a road at a latitude beside.
fn with_stray(town: &str, latitude: f64) -> String {
    let stray = format!(
        r#""features":[{{"type":"Feature","properties":{{"highway":"residential"}},"geometry":{{"type":"LineString","coordinates":[[0,{latitude}],[0.01,{latitude}]]}}}},"#
    );
    town.replacen(r#""features":["#, &stray, 1)
}

#[test]
fn a_road_far_off_is_one_more_square_of_a_map_and_refused_of_a_view() {
    let folder = Folder::new("roads-lost-far");
    let said = |words: &[&str]| folder.run(&[&["roads", "lost"], words].concat());
    let seen = town(1, 0.5, 0.0033);
    folder.write("town.geojson", town(1, 0.0, 1.0));
    folder.write("seen.geojson", seen.as_str());
    folder.write("far.geojson", with_stray(&town(1, 0.0, 1.0), 2.7));
    let found = said(&["far.geojson", "seen.geojson"]).unwrap();
    assert!(found.contains("heading 331."), "{found}");
    folder.write("farthest.geojson", with_stray(&town(1, 0.0, 1.0), 50.0));
    let refused = said(&["farthest.geojson", "seen.geojson"]).unwrap_err();
    assert!(refused.contains("give --around"), "{refused}");
    let around = said(&["farthest.geojson", "seen.geojson", "--around=0.003,0"]).unwrap();
    assert!(around.contains("heading 331."), "{around}");
    folder.write("stray.geojson", with_stray(&seen, 2.7));
    let refused = said(&["town.geojson", "stray.geojson"]).unwrap_err();
    assert!(
        refused.contains("stray.geojson: it shows roads") && refused.contains("at most 5 km"),
        "{refused}"
    );
    // A view that cannot be read is told before the map is looked for.
    let first = said(&["nowhere.osm", "nothing.geojson"]).unwrap_err();
    assert!(first.contains("nothing.geojson"), "{first}");
    let picture = Picture::from_fn(64, 48, |column, row| [column as u8, row as u8, 0]);
    folder.write("photo.png", encode_png(&picture).unwrap());
    let high = ["town.geojson", "photo.png", "--height=30000", "--focal=50"];
    let refused = said(&high).unwrap_err();
    assert!(
        refused.contains("a pixel of the picture shows 600.0 m"),
        "{refused}"
    );
}

#[test]
fn a_road_is_traced_from_place_to_place_in_the_picture_of_a_map() {
    let folder = Folder::new("roads-trace");
    let frame = LocalFrame::new(world_origin());
    let scenario = &Scenario::all()[0];
    let map = Scenario::map().road_map();
    let line = map
        .lines()
        .iter()
        .find(|line| course_length(&line.course) > 400.0)
        .expect("a long road");
    let places: Vec<String> = [100.0, 200.0, 300.0]
        .map(|along| place_along(&line.course, along).expect("on it").point)
        .map(|place| {
            let place = frame.geodetic_from_ground(&place);
            let [latitude, longitude] = [place.latitude, place.longitude].map(f64::to_degrees);
            format!("{latitude:.8},{longitude:.8}")
        })
        .into();
    let trace = |map: &str, places: &[String]| {
        let mut words = vec!["roads", "trace", map, "--out", "road.geojson"];
        for place in places {
            words.extend(["--at", place]);
        }
        folder.run(&words)
    };
    let said = trace(scenario.name, &places).unwrap();
    assert!(
        said.contains("leg 2: ") && said.contains(" m wide"),
        "{said}"
    );
    let read = read_roads(&std::fs::read(folder.0.join("road.geojson")).unwrap()).unwrap();
    let [road] = &read.in_world(&frame)[..] else {
        panic!("one road")
    };
    assert!((course_length(&road.course) - 200.0).abs() < 10.0, "{said}");
    for place in &road.course {
        let near = place_near(&line.course, *place).expect("a line").point;
        assert!(near.distance(place) < line.width, "{place:?}: {said}");
    }
    let alone = trace(scenario.name, &places[..1]).unwrap_err();
    assert!(alone.contains("two places at least"), "{alone}");
    folder.write(
        "town.png",
        encode_png(&Picture::filled(40, 20, [90; 3])).unwrap(),
    );
    folder.write("town.pgw", "0.5\n0\n0\n-0.5\n0.25\n-0.25\n");
    let nowhere = trace("town.png", &places).unwrap_err();
    assert!(
        nowhere.contains("nothing says where on the globe"),
        "{nowhere}"
    );
}
