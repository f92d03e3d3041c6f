//! OpenStreetMap's XML.

use quick_xml::Reader;
use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};

use super::error::RoadFileError;
use super::globe_road::RoadsRead;
use super::open_street_map::{OsmData, OsmWay};

/// Reads the roads of a file.
pub fn read(bytes: &[u8]) -> Result<RoadsRead, RoadFileError> {
    let text = std::str::from_utf8(bytes)
        .map_err(|error| RoadFileError::broken(error.valid_up_to(), "no text"))?;
    let mut reader = Reader::from_str(text);
    let (mut data, mut is_osm) = (OsmData::default(), false);
    let mut way: Option<OsmWay> = None;
    loop {
        let event = reader.read_event();
        let place = reader.buffer_position() as usize;
        match event.map_err(|error| RoadFileError::broken(place, error))? {
            Event::Eof => break,
            Event::Start(element) | Event::Empty(element) => match element.name().as_ref() {
                "osm" => is_osm = true,
                "node" => {
                    let number = number(&element, "id");
                    let (lon, lat) = (degrees(&element, "lon"), degrees(&element, "lat"));
                    // A node that was deleted has no place.
                    if let (Some(number), Some(lon), Some(lat)) = (number, lon, lat) {
                        data.nodes.push((number, lon, lat));
                    }
                }
                "way" => way = Some(OsmWay::default()),
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
                data.ways.extend(way.take());
            }
            _ => {}
        }
    }
    if !is_osm {
        return Err(RoadFileError::Unknown);
    }
    Ok(data.roads())
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
