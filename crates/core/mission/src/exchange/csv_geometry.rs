//! Geometries in the cells of a table, as geographic programs write them: well-known text, which counts longitude first
//! (OGC 06-103r4, section 7), with the reference system that `PostGIS` puts before it; or GeoJSON.

use serde_json::{Value, json};

/// Deepest nesting of brackets: a collection of polygons has four.
const DEEPEST: usize = 8;
/// Reference systems whose places are longitude and latitude within two metres of those of WGS 84.
const SYSTEMS: [&str; 7] = ["4326", "4979", "4258", "4269", "4283", "7844", "4167"];
/// Geometries by their tags in well-known text, with the kind of GeoJSON.
const KINDS: [(&str, &str); 8] = [
    ("POINT", "Point"),
    ("LINESTRING", "LineString"),
    ("LINEARRING", "LineString"),
    ("POLYGON", "Polygon"),
    ("MULTIPOINT", "MultiPoint"),
    ("MULTILINESTRING", "MultiLineString"),
    ("MULTIPOLYGON", "MultiPolygon"),
    ("GEOMETRYCOLLECTION", "GeometryCollection"),
];

/// Geometries that are no points, lines nor polygons with straight sides, by their tags.
const OTHERS: [&str; 8] = [
    "CIRCULARSTRING",
    "COMPOUNDCURVE",
    "CURVEPOLYGON",
    "MULTICURVE",
    "MULTISURFACE",
    "POLYHEDRALSURFACE",
    "TIN",
    "TRIANGLE",
];

/// The geometry of GeoJSON that a cell says; `None` where it is none at all.
///
/// # Errors
/// In words, where it begins as a geometry and is none that can be read.
pub(super) fn geometry(cell: &str) -> Option<Result<Value, String>> {
    let cell = cell.trim();
    if cell.starts_with('{') {
        let value: Value = serde_json::from_str(cell).ok()?;
        let kind = value.get("type")?.as_str()?;
        let is_known = KINDS.iter().any(|(_, name)| *name == kind);
        return is_known.then_some(Ok(value));
    }
    let (system, text) = match cell.split_once(';') {
        Some((system, text)) if system.to_uppercase().starts_with("SRID=") => {
            (system.get(5..), text)
        }
        _ => (None, cell),
    };
    let tag: String = text.chars().take_while(char::is_ascii_alphabetic).collect();
    let rest = text[tag.len()..].trim_start();
    let tag = tag.to_uppercase();
    if !begins_numbers(rest) {
        return None;
    }
    if OTHERS.contains(&tag.trim_end_matches(['Z', 'M'])) {
        return Some(Err(format!(
            "a {tag} is not read: save it with straight lines"
        )));
    }
    kind(&tag)?;
    if let Some(system) = system.filter(|code| !SYSTEMS.contains(&code.trim())) {
        return Some(Err(format!(
            "its numbers are in EPSG:{system}, not in longitude and latitude: save it in EPSG:4326"
        )));
    }
    let mut reader = WktReader { rest: text };
    let read = reader.geometry(0);
    let is_over = reader.rest.trim().is_empty();
    Some(
        read.filter(|_| is_over)
            .ok_or_else(|| "it is no whole well-known text".to_owned()),
    )
}

/// Whether what stands behind a tag is that of a geometry: its dimensions and a bracket, or that it is empty.
fn begins_numbers(rest: &str) -> bool {
    let word: String = rest.chars().take_while(char::is_ascii_alphabetic).collect();
    let word = word.to_uppercase();
    let behind = rest[word.len()..].trim_start();
    match word.as_str() {
        "" | "Z" | "M" | "ZM" => {
            behind.starts_with('(') || behind.to_uppercase().starts_with("EMPTY")
        }
        "EMPTY" => behind.is_empty(),
        _ => false,
    }
}

/// Kind of GeoJSON and number of coordinates that count (longitude, latitude, height) by a tag with or without `Z`, `M`.
fn kind(tag: &str) -> Option<(&'static str, &'static str)> {
    KINDS.iter().find_map(|(name, kind)| {
        let dimensions = tag.strip_prefix(name)?;
        let known = ["", "Z", "M", "ZM"];
        let known = known.into_iter().find(|known| *known == dimensions)?;
        Some((*kind, known))
    })
}

/// Rest of a text that is still to be read.
struct WktReader<'a> {
    rest: &'a str,
}

impl WktReader<'_> {
    fn word(&mut self) -> String {
        self.rest = self.rest.trim_start();
        let letters = self
            .rest
            .find(|c: char| !c.is_ascii_alphabetic())
            .unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(letters);
        self.rest = rest;
        word.to_uppercase()
    }

    fn takes(&mut self, letter: char) -> bool {
        self.rest = self.rest.trim_start();
        let rest = self.rest.strip_prefix(letter);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn geometry(&mut self, depth: usize) -> Option<Value> {
        let (kind, mut dimensions) = kind(&self.word())?;
        let mut word = self.word();
        if let Some(stated) = ["Z", "M", "ZM"].into_iter().find(|d| *d == word) {
            dimensions = stated;
            word = self.word();
        }
        let is_collection = kind == "GeometryCollection";
        if word == "EMPTY" {
            return Some(json!({ "type": kind, "coordinates": [] }));
        }
        if !word.is_empty() || depth > DEEPEST {
            return None;
        }
        if is_collection {
            let mut parts = Vec::new();
            self.takes('(').then_some(())?;
            loop {
                parts.push(self.geometry(depth + 1)?);
                if !self.takes(',') {
                    break;
                }
            }
            self.takes(')').then_some(())?;
            return Some(json!({ "type": kind, "geometries": parts }));
        }
        let has_height = dimensions != "M";
        let list = self.list(has_height, depth)?;
        let coordinates = match kind {
            "Point" => list.get(0)?.clone(),
            // Each point may stand in brackets of its own.
            "MultiPoint" => {
                let points = list.as_array()?.iter();
                let point = |point: &Value| match point.get(0) {
                    Some(Value::Array(inner)) => Value::Array(inner.clone()),
                    _ => point.clone(),
                };
                points.map(point).collect()
            }
            _ => list,
        };
        Some(json!({ "type": kind, "coordinates": coordinates }))
    }

    /// A list in brackets, of positions or of lists.
    fn list(&mut self, has_height: bool, depth: usize) -> Option<Value> {
        if depth > DEEPEST || !self.takes('(') {
            return None;
        }
        let mut items = Vec::new();
        loop {
            self.rest = self.rest.trim_start();
            items.push(if self.rest.starts_with('(') {
                self.list(has_height, depth + 1)?
            } else {
                self.position(has_height)?
            });
            if !self.takes(',') {
                break;
            }
        }
        self.takes(')').then_some(Value::Array(items))
    }

    fn position(&mut self, has_height: bool) -> Option<Value> {
        let end = self.rest.find([',', ')'])?;
        let (text, rest) = self.rest.split_at(end);
        self.rest = rest;
        let numbers = text.split_whitespace().map(|word| word.parse::<f64>().ok());
        let numbers: Vec<f64> = numbers.collect::<Option<_>>()?;
        let most = if has_height { 3 } else { 2 };
        let is_position = (2..=4).contains(&numbers.len());
        is_position.then(|| numbers.into_iter().take(most).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(cell: &str) -> Value {
        geometry(cell).expect("a geometry").expect("a sound one")
    }

    #[test]
    fn well_known_text_is_read_in_all_its_kinds_and_dimensions() {
        // Places, rings and holes as the texts have them, longitude first.
        for (text, kind, coordinates) in [
            ("POINT (8.5 47.5)", "Point", json!([8.5, 47.5])),
            ("point(8.5 47.5)", "Point", json!([8.5, 47.5])),
            ("POINT Z (8.5 47.5 430)", "Point", json!([8.5, 47.5, 430.0])),
            ("POINTZ(8.5 47.5 430)", "Point", json!([8.5, 47.5, 430.0])),
            ("POINT M (8.5 47.5 9)", "Point", json!([8.5, 47.5])),
            ("POINT ZM (8.5 47.5 4 9)", "Point", json!([8.5, 47.5, 4.0])),
            (
                "SRID=4326;LINESTRING(8 47,8.1 47.1)",
                "LineString",
                json!([[8.0, 47.0], [8.1, 47.1]]),
            ),
            (
                "POLYGON ((0 0, 9 0, 9 9, 0 0), (1 1, 2 1, 2 2, 1 1))",
                "Polygon",
                json!([
                    [[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 0.0]],
                    [[1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 1.0]]
                ]),
            ),
            (
                "MULTIPOINT ((1 2), (3 4))",
                "MultiPoint",
                json!([[1.0, 2.0], [3.0, 4.0]]),
            ),
            (
                "MULTIPOINT (1 2, 3 4)",
                "MultiPoint",
                json!([[1.0, 2.0], [3.0, 4.0]]),
            ),
            (
                "MULTIPOLYGON (((0 0, 1 0, 1 1, 0 0)))",
                "MultiPolygon",
                json!([[[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0]]]]),
            ),
            ("LINESTRING EMPTY", "LineString", json!([])),
        ] {
            let expected = json!({ "type": kind, "coordinates": coordinates });
            assert_eq!(read(text), expected, "{text}");
        }
        let both = read("GEOMETRYCOLLECTION (POINT (1 2), LINESTRING (1 2, 3 4))");
        assert_eq!(both["geometries"][1]["coordinates"][1][0], json!(3.0));
        let json = r#"{"type":"Point","coordinates":[8.5,47.5]}"#;
        assert_eq!(read(json)["coordinates"][1], json!(47.5));
    }

    #[test]
    fn what_is_no_geometry_is_none_and_what_is_broken_is_told() {
        for cell in [
            "Point of view",
            "polygon",
            "47.5, 8.5",
            "",
            "{}",
            "POINT",
            "Point Mugu",
            "Point East",
            "Point Zero",
            "Martin Meier",
            "Destination (north)",
            "Curve (south)",
        ] {
            assert!(geometry(cell).is_none(), "{cell}");
        }
        let deep = format!("POLYGON {}", "(".repeat(100_000));
        for cell in [
            "POINT (8.5)",
            "LINESTRING (8 47, x y)",
            "POLYGON ((8 47, 9 48",
            "POINT (8 47) more",
            "SRID=2056;POINT (2600000 1200000)",
            "CIRCULARSTRING (0 0, 1 1, 1 0)",
            &deep,
        ] {
            assert!(
                geometry(cell).is_some_and(|read| read.is_err()),
                "{cell:.40}"
            );
        }
    }
}
