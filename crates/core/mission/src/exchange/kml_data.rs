//! Data of a placemark beside its geometry, of all three kinds: names with values, columns of a schema, and elements in the name
//! space of some program.

use std::collections::BTreeMap;

use serde_json::Value;

use super::kml_elements::OWN;
use super::xml::XmlElement;

/// Contents of the data of a placemark.
#[derive(Default)]
pub(super) struct PlacemarkData {
    /// Contents that only we know, as we wrote them.
    pub own: Option<String>,
    /// Everything else, by its name, as JSON text.
    pub properties: BTreeMap<String, String>,
}

/// The data of `element`, an `ExtendedData` in `text`.
pub(super) fn data_of(text: &str, element: &XmlElement) -> PlacemarkData {
    let mut data = PlacemarkData::default();
    let pairs = element
        .all("Data")
        .map(|data| (data.attribute("name"), data.child_text("value")));
    let simple = element
        .all("SchemaData")
        .flat_map(|schema| schema.all("SimpleData"))
        .map(|data| (data.attribute("name"), Some(data.text.as_str())));
    for (name, value) in pairs.chain(simple) {
        match (name, value) {
            (Some(OWN), Some(own)) => data.own = Some(own.to_owned()),
            (Some(name), value) => {
                let value = Value::from(value.unwrap_or("")).to_string();
                data.properties.insert(name.to_owned(), value);
            }
            (None, _) => {}
        }
    }
    for (name, values) in foreign(text, element) {
        let value = match &values[..] {
            [value] => Value::from(value.as_str()),
            _ => Value::from(values),
        };
        data.properties.entry(name).or_insert(value.to_string());
    }
    data
}

/// Elements of other name spaces by their names with prefixes: their texts, or they themselves where they say more.
fn foreign(text: &str, element: &XmlElement) -> BTreeMap<String, Vec<String>> {
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for child in &element.children {
        if ["Data", "SchemaData"].contains(&child.name.as_str()) {
            continue;
        }
        let raw = text.get(child.begin..child.end).unwrap_or("");
        let head = raw.trim_start_matches('<');
        let name = head.split(|c: char| c.is_whitespace() || c == '>' || c == '/');
        let name = name.into_iter().next().unwrap_or("");
        let is_plain = child.children.is_empty() && child.attributes.is_empty();
        let value = if is_plain { &child.text } else { raw };
        found
            .entry(name.to_owned())
            .or_default()
            .push(value.to_owned());
    }
    found
}
