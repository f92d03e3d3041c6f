//! Elements of a placemark that are kept as they stand, and their place in it by KML's schema.
//!
//! <https://schemas.opengis.net/kml/2.2.0/ogckml22.xsd>

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// Name of the datum that holds what only we know.
pub(super) const OWN: &str = "pilotage";
/// Prefix of properties that are elements of a placemark, as they stand.
pub(super) const ELEMENT: &str = "kml:";
/// Name space of KML.
pub(super) const KML: &str = "http://www.opengis.net/kml/2.2";

/// Elements in the order that the schema asks for, before the data and behind them; the geometry follows. In place of the
/// data there may be `Metadata`, not beside them.
const BEFORE: [&str; 18] = [
    "visibility",
    "open",
    "author",
    "link",
    "address",
    "AddressDetails",
    "phoneNumber",
    "Snippet",
    "snippet",
    "description",
    "Camera",
    "LookAt",
    "TimeStamp",
    "TimeSpan",
    "styleUrl",
    "Style",
    "StyleMap",
    "Region",
];
const AFTER: [&str; 1] = ["balloonVisibility"];

/// Prefixes of names that are declared where they are used, beside that of Google's elements, which always is.
const NAME_SPACES: [(&str, &str); 3] = [
    ("atom", "http://www.w3.org/2005/Atom"),
    ("xal", "urn:oasis:names:tc:ciq:xsdschema:xAL:2.0"),
    ("kml", KML),
];
const GOOGLE: &str = "gx";

/// Elements to be written in one placemark.
#[derive(Default)]
pub(super) struct PlacemarkElements<'a> {
    /// Those before the data.
    pub before: Vec<&'a str>,
    /// Those behind the data.
    pub after: Vec<&'a str>,
    /// Prefixes of their names that have to be declared.
    pub prefixes: BTreeSet<&'static str>,
    /// Names of those that have no place.
    pub left_out: Vec<String>,
}

/// The elements among the properties of a placemark.
pub(super) fn elements_of(properties: &BTreeMap<String, String>) -> PlacemarkElements<'_> {
    let mut found = PlacemarkElements::default();
    let (mut before, mut after) = (BTreeMap::new(), BTreeMap::new());
    for (name, raw) in properties {
        let Some(name) = name.strip_prefix(ELEMENT) else {
            continue;
        };
        let place = |order: &[&str]| order.iter().position(|own| *own == name);
        let (list, place) = match (place(&BEFORE), place(&AFTER)) {
            (Some(place), _) => (&mut before, place),
            (None, Some(place)) => (&mut after, place),
            (None, None) => {
                found.left_out.push(name.to_owned());
                continue;
            }
        };
        match declared(raw) {
            Some(prefixes) => {
                found.prefixes.extend(prefixes);
                list.insert(place, raw.as_str());
            }
            None => found.left_out.push(name.to_owned()),
        }
    }
    found.before = before.into_values().collect();
    found.after = after.into_values().collect();
    found
}

/// Prefixes of elements in a text that have to be declared; `None` where one is not known.
fn declared(raw: &str) -> Option<BTreeSet<&'static str>> {
    let mut prefixes = BTreeSet::new();
    for piece in raw.split('<').skip(1) {
        let piece = piece.strip_prefix('/').unwrap_or(piece);
        let end = piece.find(|c: char| !(c.is_alphanumeric() || "-_.:".contains(c)));
        let name = &piece[..end.unwrap_or(piece.len())];
        let Some((prefix, _)) = name.split_once(':') else {
            continue;
        };
        if prefix == GOOGLE || raw.contains(&format!("xmlns:{prefix}=")) {
            continue;
        }
        let known = NAME_SPACES.iter().find(|(known, _)| *known == prefix);
        prefixes.insert(known?.0);
    }
    Some(prefixes)
}

/// Declarations of prefixes, as attributes.
pub(super) fn name_spaces(prefixes: &BTreeSet<&'static str>) -> String {
    let used = NAME_SPACES
        .iter()
        .filter(|(prefix, _)| prefixes.contains(prefix));
    let mut text = String::new();
    for (prefix, space) in used {
        // Writing into a string cannot fail.
        let _ = write!(text, " xmlns:{prefix}=\"{space}\"");
    }
    text
}
