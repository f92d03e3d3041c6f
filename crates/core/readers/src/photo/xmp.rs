//! XMP: what camera drones write about gimbal and aircraft.

use std::collections::HashMap;

use quick_xml::Reader;
use quick_xml::events::Event;

/// Properties by their names with their usual prefixes.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Xmp {
    properties: HashMap<String, String>,
}

impl Xmp {
    /// The simple properties, as attributes or as elements, up to the first place that makes no sense.
    pub fn read(xml: &[u8]) -> Self {
        let mut xmp = Self::default();
        let text = String::from_utf8_lossy(xml);
        let mut reader = Reader::from_str(&text);
        let mut open = None;
        while let Ok(event) = reader.read_event() {
            match event {
                Event::Start(element) | Event::Empty(element) => {
                    for attribute in element.attributes().flatten() {
                        let name = attribute.key.as_ref().to_owned();
                        let value = attribute.value.to_string();
                        xmp.properties.entry(name).or_insert(value);
                    }
                    open = Some(element.name().as_ref().to_owned());
                }
                Event::Text(words) => {
                    if let Some(name) = open.take() {
                        let value = words.trim().to_owned();
                        xmp.properties.entry(name).or_insert(value);
                    }
                }
                Event::End(_) => open = None,
                Event::Eof => break,
                _ => {}
            }
        }
        xmp
    }

    /// The number of the first of these properties that has one.
    pub fn number(&self, names: &[&str]) -> Option<f64> {
        let number = |name: &&str| self.properties.get(*name)?.trim().parse::<f64>().ok();
        names
            .iter()
            .find_map(number)
            .filter(|number| number.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn properties_are_attributes_or_elements() {
        let xml = br#"<?xpacket begin="x"?><x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF>
            <rdf:Description rdf:about="" drone-dji:GimbalYawDegree="-132.00">
            <drone-dji:RelativeAltitude>+40.10</drone-dji:RelativeAltitude>
            </rdf:Description></rdf:RDF></x:xmpmeta>"#;
        let xmp = Xmp::read(xml);
        assert_eq!(xmp.number(&["drone-dji:GimbalYawDegree"]), Some(-132.0));
        assert_eq!(
            xmp.number(&["none", "drone-dji:RelativeAltitude"]),
            Some(40.1)
        );
        assert_eq!(xmp.number(&["rdf:about"]), None);
        assert_eq!(
            Xmp::read(&xml[..150]).number(&["drone-dji:GimbalYawDegree"]),
            Some(-132.0)
        );
    }
}
