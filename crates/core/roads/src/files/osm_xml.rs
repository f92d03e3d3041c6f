//! OpenStreetMap's XML.

use quick_xml::Reader;
use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};

use super::error::RoadFileError;
use super::globe_road::RoadsRead;
use super::open_street_map::{OsmData, OsmPass, OsmWay};

/// Reads the roads of a file.
pub fn read(bytes: &[u8]) -> Result<RoadsRead, RoadFileError> {
    let text = std::str::from_utf8(bytes)
        .map_err(|error| RoadFileError::broken(error.valid_up_to(), "no text"))?;
    OsmData::read(|pass, data| go_through(text, pass, data))
}

fn go_through(text: &str, pass: OsmPass, data: &mut OsmData) -> Result<(), RoadFileError> {
    let mut reader = Reader::from_str(text);
    let mut is_osm = false;
    let mut way: Option<OsmWay> = None;
    loop {
        let event = reader.read_event();
        let place = reader.buffer_position() as usize;
        match event.map_err(|error| RoadFileError::broken(place, error))? {
            Event::Eof => break,
            Event::Start(element) | Event::Empty(element) => match element.name().as_ref() {
                "osm" => is_osm = true,
                "node" if pass == OsmPass::Nodes => {
                    let number = number(&element, "id");
                    let (lon, lat) = (degrees(&element, "lon"), degrees(&element, "lat"));
                    // A node that was deleted has no place, or still that which it had.
                    if let (Some(number), Some(lon), Some(lat)) = (number, lon, lat)
                        && !is_deleted(&element)
                    {
                        data.add_node(number, lon, lat);
                    }
                }
                "way" if pass == OsmPass::Ways => {
                    way = (!is_deleted(&element)).then(OsmWay::default);
                }
                "nd" => {
                    if let (Some(way), Some(node)) = (&mut way, number(&element, "ref")) {
                        way.nodes.push(node);
                    }
                }
                "tag" => {
                    let (key, value) = (attribute(&element, "k"), attribute(&element, "v"));
                    if let (Some(way), Some(key), Some(value)) = (&mut way, key, value) {
                        way.tag(&key, &value);
                    }
                }
                _ => {}
            },
            Event::End(element) if element.name().as_ref() == "way" => {
                if let Some(way) = way.take() {
                    data.add_way(way);
                }
            }
            _ => {}
        }
    }
    if !is_osm {
        return Err(RoadFileError::Unknown);
    }
    Ok(())
}

/// Whether an element is no longer there: marked as deleted by the editor JOSM, which keeps it until it is uploaded, or by
/// the server.
fn is_deleted(element: &BytesStart<'_>) -> bool {
    let says = |name: &str, value: &str| attribute(element, name).as_deref() == Some(value);
    says("action", "delete") || says("visible", "false")
}

fn attribute(element: &BytesStart<'_>, name: &str) -> Option<String> {
    let found = element.try_get_attribute(name).ok().flatten()?;
    let value = found.normalized_value(XmlVersion::Implicit1_0).ok()?;
    Some(value.into_owned())
}

fn number(element: &BytesStart<'_>, name: &str) -> Option<i64> {
    attribute(element, name)?.parse().ok()
}

fn degrees(element: &BytesStart<'_>, name: &str) -> Option<f64> {
    let value: f64 = attribute(element, name)?.parse().ok()?;
    value.is_finite().then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_an_editor_marks_as_deleted_is_not_there() {
        let file = r#"<osm version="0.6" generator="JOSM">
            <node id="1" lat="47.0" lon="8.0"/><node id="2" lat="47.1" lon="8.0"/>
            <node id="3" lat="47.2" lon="8.0" action="delete" visible="true"/>
            <node id="4" lat="47.3" lon="8.0" action="modify" visible="true"/>
            <way id="5" action="delete"><nd ref="1"/><nd ref="2"/><tag k="highway" v="track"/></way>
            <way id="6" visible="false"><nd ref="1"/><nd ref="2"/><tag k="highway" v="track"/></way>
            <way id="7" action="modify"><nd ref="1"/><nd ref="2"/><nd ref="4"/><tag k="highway" v="primary"/></way>
            <way id="8"><nd ref="2"/><nd ref="3"/><tag k="highway" v="service"/></way>
        </osm>"#;
        let read = read(file.as_bytes()).unwrap();
        let courses: Vec<_> = read.roads.iter().map(|road| road.course.clone()).collect();
        assert_eq!(courses, [[(8.0, 47.0), (8.0, 47.1), (8.0, 47.3)]]);
        assert_eq!((read.others, read.missing_points), (0, 1));
    }
}
