//! XMP: what camera drones write about gimbal and aircraft.

use std::collections::HashMap;

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

/// Vocabularies of makers: a part of the name of the namespace, and the prefix that stands for it here. Those of Autel
/// have DJI's words.
const VOCABULARIES: [(&str, &str); 9] = [
    ("dji.com/drone-dji", DJI),
    ("autel", DJI),
    ("parrot.com/drone-parrot", "drone-parrot"),
    ("skydio.com/drone-skydio", "drone-skydio"),
    ("pix4d.com/camera", CAMERA),
    ("sensefly.com/camera", CAMERA),
    ("ns.adobe.com/exif/1.0", "exif"),
    ("ns.adobe.com/xap/1.0", "xmp"),
    ("ns.adobe.com/photoshop/1.0", "photoshop"),
];
const DJI: &str = "drone-dji";
const CAMERA: &str = "Camera";
/// Prefixes that are known where a file declares no namespace for them.
const PREFIXES: [(&str, &str); 7] = [
    ("drone-dji", DJI),
    ("drone", DJI),
    ("drone-parrot", "drone-parrot"),
    ("drone-skydio", "drone-skydio"),
    ("skydio", "drone-skydio"),
    ("camera", CAMERA),
    ("exif", "exif"),
];

/// Properties by their names in small letters, with the usual prefixes of their namespaces, whatever the file calls them.
/// Those of a structure stand behind its name: `drone-skydio:cameraorientationned:yaw`.
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
        // Prefixes that were declared; XMP declares each once.
        let mut declared: HashMap<String, &'static str> = HashMap::new();
        let mut open: Vec<String> = Vec::new();
        while let Ok(event) = reader.read_event() {
            match event {
                Event::Start(element) => {
                    xmp.attributes(&element, &mut declared, &open);
                    let name = element.name();
                    open.push(plain(name.as_ref(), &declared));
                }
                Event::Empty(element) => {
                    // A structure may be an element with attributes alone.
                    let name = plain(element.name().as_ref(), &declared);
                    open.push(name);
                    xmp.attributes(&element, &mut declared, &open);
                    open.pop();
                }
                Event::Text(words) => {
                    let value = words.trim().to_owned();
                    if !value.is_empty()
                        && let Some((name, outer)) = open.split_last()
                    {
                        xmp.add(outer, name, value);
                    }
                }
                Event::End(_) => {
                    open.pop();
                }
                Event::Eof => break,
                _ => {}
            }
        }
        xmp
    }

    /// Takes the attributes of an element within others; those that declare namespaces first.
    fn attributes(
        &mut self,
        element: &BytesStart<'_>,
        declared: &mut HashMap<String, &'static str>,
        open: &[String],
    ) {
        let attributes = || element.attributes().flatten();
        for attribute in attributes() {
            let key = attribute.key.as_ref().to_owned();
            if let Some(prefix) = key.strip_prefix("xmlns:") {
                let namespace = attribute.value.to_string().to_lowercase();
                let mut known = VOCABULARIES.iter();
                let known = known.find(|(part, _)| namespace.contains(part));
                declared.insert(prefix.to_owned(), known.map_or("", |(_, usual)| usual));
            }
        }
        for attribute in attributes() {
            let name = plain(attribute.key.as_ref(), declared);
            self.add(open, &name, attribute.value.to_string());
        }
    }

    /// Adds a property, alone and as that of the structure that it stands in. The first of a name counts.
    fn add(&mut self, outer: &[String], name: &str, value: String) {
        let structure = outer.iter().rev().find(|outer| !is_frame(outer));
        if let Some(structure) = structure {
            let last = name.rsplit(':').next().unwrap_or(name);
            let name = format!("{structure}:{last}");
            self.properties.entry(name).or_insert_with(|| value.clone());
            return;
        }
        self.properties.entry(name.to_owned()).or_insert(value);
    }

    /// The text of a property.
    pub fn text(&self, name: &str) -> Option<&str> {
        let text = self.properties.get(&name.to_lowercase())?.trim();
        (!text.is_empty()).then_some(text)
    }

    /// The number of the first of these properties that has one.
    pub fn number(&self, names: &[&str]) -> Option<f64> {
        let number = |name: &&str| number(self.text(name)?);
        names.iter().find_map(number)
    }
}

/// A name in small letters, with the usual prefix of its namespace; as it is where that is not known.
fn plain(name: &str, declared: &HashMap<String, &'static str>) -> String {
    let Some((prefix, last)) = name.split_once(':') else {
        return name.to_lowercase();
    };
    let by_prefix = || {
        let prefix = prefix.to_lowercase();
        let known = PREFIXES.iter().find(|(known, _)| *known == prefix);
        known.map(|(_, usual)| *usual)
    };
    let usual = match declared.get(prefix) {
        Some(usual) if !usual.is_empty() => Some(*usual),
        _ => by_prefix(),
    };
    format!("{}:{last}", usual.unwrap_or(prefix)).to_lowercase()
}

/// Whether an element is one of RDF's own, in which properties stand.
fn is_frame(name: &str) -> bool {
    name.starts_with("rdf:") || name.starts_with("x:")
}

/// A number as makers write it: `+12.5`, `12.5 m`, `125/10`.
fn number(text: &str) -> Option<f64> {
    let text = text.split_whitespace().next()?;
    let value = match text.split_once('/') {
        Some((above, below)) => above.parse::<f64>().ok()? / below.parse::<f64>().ok()?,
        None => text.parse().ok()?,
    };
    value.is_finite().then_some(value)
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
        assert_eq!(xmp.text("drone-dji:RelativeAltitude"), Some("+40.10"));
        assert_eq!(
            Xmp::read(&xml[..150]).number(&["drone-dji:GimbalYawDegree"]),
            Some(-132.0)
        );
    }

    #[test]
    fn a_namespace_counts_whatever_prefix_the_file_gives_it() {
        let xml = br#"<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF>
            <rdf:Description rdf:about="" xmlns:a="http://www.dji.com/drone-dji/1.0/" xmlns:Camera="http://example.org/other/"
              a:GimbalPitchDegree="-90.00" xmlns:b="http://pix4d.com/camera/1.0/">
            <b:Yaw>35/2</b:Yaw><b:AboveGroundAltitude>81.5 m</b:AboveGroundAltitude>
            </rdf:Description></rdf:RDF></x:xmpmeta>"#;
        let xmp = Xmp::read(xml);
        assert_eq!(xmp.number(&["drone-dji:GimbalPitchDegree"]), Some(-90.0));
        assert_eq!(xmp.number(&["Camera:Yaw"]), Some(17.5));
        assert_eq!(xmp.number(&["Camera:AboveGroundAltitude"]), Some(81.5));
    }

    #[test]
    fn parts_of_a_structure_stand_behind_its_name() {
        for inside in [
            r#"<s:CameraOrientationNED rdf:parseType="Resource"><s:Roll>0.2</s:Roll><s:Pitch>-84</s:Pitch></s:CameraOrientationNED>"#,
            r#"<s:CameraOrientationNED><rdf:Description s:Roll="0.2" s:Pitch="-84"/></s:CameraOrientationNED>"#,
            r#"<s:CameraOrientationNED s:Roll="0.2" s:Pitch="-84"/>"#,
        ] {
            let xml = format!(
                r#"<x:xmpmeta><rdf:RDF><rdf:Description xmlns:s="https://www.skydio.com/drone-skydio/1.0/">{inside}</rdf:Description></rdf:RDF></x:xmpmeta>"#
            );
            let xmp = Xmp::read(xml.as_bytes());
            let part =
                |part: &str| xmp.number(&[&format!("drone-skydio:CameraOrientationNED:{part}")]);
            assert_eq!(
                (part("Roll"), part("Pitch")),
                (Some(0.2), Some(-84.0)),
                "{inside}"
            );
        }
    }
}
