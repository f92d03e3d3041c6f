//! Archives and JSON whose parts lie in one another.

use super::assert_noted;
use crate::exchange::read_any;
use pilotage_base::files::{FileSink, ZipSink};

fn kmz(files: &[(&str, &str)]) -> Vec<u8> {
    let mut sink = ZipSink::default();
    for (name, text) in files {
        sink.write(name, text.as_bytes()).unwrap();
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
fn a_fault_in_a_linked_document_names_it() {
    let broken = "<kml><Placemark><Point><coordinates>x</coordinates></Point></Placemark></kml>";
    let bytes = kmz(&[("doc.kml", &document(&[link("b.kml")])), ("b.kml", broken)]);
    let error = read_any("a.kmz", &bytes, None).unwrap_err().to_string();
    assert!(error.starts_with("a.kmz/b.kml, line 1"), "{error}");
}
