//! Archives and JSON whose parts lie in one another.

use super::assert_noted;
use crate::exchange::read_any;
use pilotage_base::files::{FileSink, ZipSink};

fn kmz(files: &[(&str, &str)]) -> Vec<u8> {
    let files: Vec<_> = files
        .iter()
        .map(|(name, text)| (*name, text.as_bytes()))
        .collect();
    packed(&files)
}

fn packed(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut sink = ZipSink::default();
    for (name, bytes) in files {
        sink.write(name, bytes).unwrap();
    }
    sink.finish().unwrap()
}

fn link(href: &str) -> String {
    format!("<NetworkLink><Link><href>{href}</href></Link></NetworkLink>")
}

fn place(name: &str) -> String {
    format!(
        "<Placemark><name>{name}</name><Point><coordinates>8,47</coordinates></Point></Placemark>"
    )
}

fn document(parts: &[String]) -> String {
    format!("<kml><Document>{}</Document></kml>", parts.concat())
}

#[test]
fn links_within_an_archive_are_followed_as_deep_as_they_go_and_never_in_circles() {
    let main = document(&[
        link("parts/a.kml"),
        place("first"),
        link("http://there/x.kml"),
    ]);
    let line = "<Placemark><name>way</name><LineString><coordinates>8,47 8.1,47</coordinates></LineString></Placemark>";
    let first = document(&[link("deep/b.kml"), line.to_owned()]);
    let second = document(&[place("deepest"), link("../../doc.kml"), link("../a.kml")]);
    let bytes = kmz(&[
        ("doc.kml", &main),
        ("parts/a.kml", &first),
        ("parts/deep/b.kml", &second),
        ("alone.kml", &document(&[place("alone")])),
    ]);
    let found = read_any("a.kmz", &bytes, None).unwrap();
    let names: Vec<&str> = found.landmarks.iter().map(|l| l.name.as_str()).collect();
    assert_eq!(names, ["first", "deepest"]);
    assert_eq!(found.routes.len(), 1);
    assert_eq!(found.routes[0].name, "way");
    assert_noted(&found.notes, |note| note.contains("http://there/x.kml"));
    assert_noted(&found.notes, |note| note.contains("1 other .kml"));
}

#[test]
fn links_to_archives_within_an_archive_are_followed() {
    let part = document(&[place("part"), link("more.kml")]);
    let more = document(&[place("more"), link("../other.kml")]);
    let inner = kmz(&[("a.kml", &part), ("more.kml", &more)]);
    let main = document(&[link("files/part.kmz"), link("files/broken.kmz")]);
    let bytes = packed(&[
        ("doc.kml", main.as_bytes()),
        ("files/part.kmz", &inner),
        ("files/broken.kmz", b"PK"),
        ("files/other.kml", document(&[place("other")]).as_bytes()),
    ]);
    let found = read_any("a.kmz", &bytes, None).unwrap();
    let names: Vec<&str> = found.landmarks.iter().map(|l| l.name.as_str()).collect();
    assert_eq!(names, ["part", "more", "other"]);
    assert_noted(&found.notes, |note| note.contains("files/broken.kmz"));
}

#[test]
fn a_fault_in_a_linked_document_names_it() {
    let broken = "<kml><Placemark><Point><coordinates>x</coordinates></Point></Placemark></kml>";
    let bytes = kmz(&[("doc.kml", &document(&[link("b.kml")])), ("b.kml", broken)]);
    let error = read_any("a.kmz", &bytes, None).unwrap_err().to_string();
    assert!(error.starts_with("a.kmz/b.kml, line 1"), "{error}");
}

#[test]
fn a_linked_document_that_cannot_be_read_is_left_out_of_a_sound_archive() {
    let main = document(&[place("first"), link("b.kml"), link("c.kml")]);
    let second = document(&[place("third")]);
    let bytes = kmz(&[("doc.kml", &main), ("b.kml", ""), ("c.kml", &second)]);
    let found = read_any("a.kmz", &bytes, None).unwrap();
    assert_eq!(found.landmarks.len(), 2);
    assert_noted(&found.notes, |note| {
        note.contains("b.kml") && note.contains("left out")
    });
}

#[test]
fn notes_on_many_linked_documents_are_summed_and_the_limit_is_told() {
    let names: Vec<String> = (0..1100).map(|i| format!("tiles/{i}.kml")).collect();
    let mut parts: Vec<String> = names.iter().map(|name| link(name)).collect();
    parts.push(place("first"));
    let main = document(&parts);
    let tile = document(&["<GroundOverlay/>".to_owned()]);
    let mut files = vec![("doc.kml", main.as_str())];
    files.extend(names.iter().map(|name| (name.as_str(), tile.as_str())));
    let found = read_any("a.kmz", &kmz(&files), None).unwrap();
    assert!(found.notes.len() < 6, "{:?}", found.notes);
    assert_noted(&found.notes, |note| note.starts_with("999 × GroundOverlay"));
    assert_noted(&found.notes, |note| {
        note.starts_with("101 linked documents") && note.contains("1000")
    });
    let is_unlinked = |note: &String| note.contains("no link leads to");
    assert!(!found.notes.iter().any(is_unlinked));
}

#[test]
fn collections_of_features_may_lie_in_one_another_and_other_json_is_named() {
    let point = r#"{"type":"Feature","properties":{"name":"in"},"geometry":{"type":"Point","coordinates":[8,47]}}"#;
    let inner = format!(r#"{{"type":"FeatureCollection","features":[{point}]}}"#);
    let outer = format!(r#"{{"type":"FeatureCollection","features":[{inner},{point}]}}"#);
    let found = read_any("a.geojson", outer.as_bytes(), None).unwrap();
    assert_eq!(found.landmarks.len(), 2);
    for (text, word) in [
        (r#"{"type":"Topology","objects":{},"arcs":[]}"#, "TopoJSON"),
        (
            r#"{"geometryType":"esriGeometryPoint","features":[{"geometry":{"x":8,"y":47}}]}"#,
            "ArcGIS",
        ),
    ] {
        let error = read_any("a.json", text.as_bytes(), None).unwrap_err();
        assert!(error.to_string().contains(word), "{error}");
    }
}

#[test]
fn a_mission_of_version_2_is_known_by_its_commands_without_its_name() {
    let text = r#"{"version":2,"items":[{"autoContinue":true,"command":16,"doJumpId":1,"frame":3,
        "params":[0,0,0,null,47.5,8.5,60],"type":"SimpleItem"}],"plannedHomePosition":[47.4,8.4,430]}"#;
    let found = read_any("old.mission", text.as_bytes(), None).unwrap();
    let way_point = &found.routes[0].way_points[0];
    let place = found.frame.geodetic_from_ground(&way_point.position);
    assert!((place.latitude.to_degrees() - 47.5).abs() < 1e-9);
    assert_eq!(way_point.altitude.metres, 60.0);
    // A list of things is no mission.
    let error = read_any("a.json", br#"{"items":[{"command":"go"}]}"#, None);
    assert!(error.is_err());
}

#[test]
fn way_points_with_decimal_commas_are_read_and_the_first_version_is_named() {
    let line = "0\t1\t0\t16\t0\t0\t0\t0\t47,5\t8,5\t430,0\t1\n1\t0\t3\t16\t0\t0\t0\t0\t47,6\t8,5\t50,5\t1\n";
    let text = format!("QGC WPL 110\n{line}");
    let found = read_any("a.waypoints", text.as_bytes(), None).unwrap();
    assert_eq!(found.routes[0].way_points[0].altitude.metres, 50.5);
    let old = format!("QGC WPL 100\n{line}");
    let error = read_any("a.waypoints", old.as_bytes(), None).unwrap_err();
    assert!(error.to_string().contains("version 100"), "{error}");
}

#[test]
fn three_digits_behind_a_comma_are_decimals_only_where_other_fields_are() {
    let file = |place: &str, height: &str| {
        format!(
            "QGC WPL 110\n0\t1\t0\t16\t0\t0\t0\t0\t{place}\t430\t1\n1\t0\t3\t16\t0\t0\t0\t0\t{place}\t{height}\t1\n"
        )
    };
    let read = |text: String| read_any("a.waypoints", text.as_bytes(), None);
    let error = read(file("47.5\t8.5", "1,250")).unwrap_err().to_string();
    assert!(error.contains("`1,250` may be thousands"), "{error}");
    for (place, height, metres) in [("47,5\t8,5", "1,250", 1.25), ("47.5\t8.5", "0,250", 0.25)] {
        let found = read(file(place, height)).unwrap();
        assert_eq!(found.routes[0].way_points[0].altitude.metres, metres);
    }
}

#[test]
fn a_link_to_a_file_of_the_archive_that_is_no_kml_is_not_told_as_one_that_leads_out() {
    let main = document(&[
        place("first"),
        link("broken.kmz"),
        link("notes.txt"),
        link("gone.kml"),
    ]);
    let bytes = kmz(&[
        ("doc.kml", &main),
        ("broken.kmz", "no zip"),
        ("notes.txt", "words"),
    ]);
    let notes = read_any("a.kmz", &bytes, None).unwrap().notes;
    for (name, told) in [
        ("broken.kmz", "leads to no KML that can be read"),
        ("notes.txt", "leads to no KML that can be read"),
        ("gone.kml", "leads out of the file"),
    ] {
        assert_noted(&notes, |note| note.contains(name) && note.contains(told));
    }
}
