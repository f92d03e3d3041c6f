//! Elements and data of placemarks beside their geometry.

use super::super::{Format, read_any, write_landmarks};
use super::{assert_noted, frame};

#[test]
fn elements_of_placemarks_are_written_in_the_order_of_the_schema_or_told() {
    let text = r#"<kml xmlns="http://www.opengis.net/kml/2.2" xmlns:gx="http://www.google.com/kml/ext/2.2"
        xmlns:atom="http://www.w3.org/2005/Atom" xmlns:own="urn:own"><Document><Placemark><name>A</name>
        <Region><LatLonAltBox><north>48</north></LatLonAltBox></Region><gx:balloonVisibility>1</gx:balloonVisibility>
        <atom:link href="https://example.com/1"/><atom:link href="https://example.com/2"/>
        <atom:author><atom:name>Ann</atom:name></atom:author><description>d</description>
        <Metadata><own:x>1</own:x></Metadata><address><own:y/></address>
        <Point><coordinates>8.5,47.4</coordinates></Point></Placemark></Document></kml>"#;
    let back = read_any("a.kml", text.as_bytes(), Some(frame())).unwrap();
    let written = write_landmarks(Format::Kml, &back.landmarks, &frame()).unwrap();
    let out = String::from_utf8(written.bytes).unwrap();
    let order = [
        "xmlns:atom=\"http://www.w3.org/2005/Atom\"",
        "<atom:author>",
        "example.com/1",
        "example.com/2",
        "<description>",
        "<Region>",
        "<ExtendedData>",
        "<gx:balloonVisibility>",
        "<Polygon>",
    ];
    let places: Vec<Option<usize>> = order.iter().map(|words| out.find(words)).collect();
    assert!(
        places.is_sorted() && places[0].is_some(),
        "{places:?} {out}"
    );
    assert!(!out.contains("own:"), "{out}");
    assert_noted(&written.notes, |n| {
        n.contains("left out: Metadata, address")
    });
    read_any("b.kml", out.as_bytes(), Some(frame())).unwrap();
}
