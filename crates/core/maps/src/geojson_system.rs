//! GeoJSON of before 2016, which may state a reference system of its own: the same in degrees.

use pilotage_base::frames::ReferenceSystem;
use serde_json::Value;

use crate::systems::by_code;

/// Systems in degrees that are taken for WGS 84, which is one of them.
const AS_WGS_84: [u32; 8] = [4326, 4979, 4258, 4937, 4269, 4283, 7844, 4167];

/// The text of GeoJSON whose member `crs` names another system than WGS 84 and those within 2 m of it, with its coordinates in
/// degrees on WGS 84 and without that member, and a sentence that says so; `None` of any other text.
pub(crate) fn geojson_in_degrees(text: &str) -> Option<(String, Vec<String>)> {
    if !text.trim_start().starts_with('{') || !text.contains("\"crs\"") {
        return None;
    }
    let mut whole: Value = serde_json::from_str(text).ok()?;
    let stated = whole.pointer("/crs/properties")?;
    // Before 2008 its number stood alone.
    let name = stated.get("name").or_else(|| stated.get("code"))?;
    let code: u32 = match name.as_str() {
        Some(name) => name.rsplit([':', '/']).next()?.parse().ok()?,
        None => name.as_u64()?.try_into().ok()?,
    };
    if AS_WGS_84.contains(&code) {
        return None;
    }
    let system = by_code(code).ok()?;
    let mut notes = vec![format!("its coordinates are read in {}", system.name())];
    notes.extend(system.note());
    turn(&mut whole, &system)?;
    whole.as_object_mut()?.remove("crs");
    Some((whole.to_string(), notes))
}

/// Turns the coordinates of all geometries in a value; `None` where a place lies beyond the system.
fn turn(value: &mut Value, system: &ReferenceSystem) -> Option<()> {
    match value {
        Value::Object(members) => {
            for (name, member) in members {
                // Properties may be anything.
                match name.as_str() {
                    "coordinates" => degrees(member, system)?,
                    "features" | "geometry" | "geometries" => turn(member, system)?,
                    _ => {}
                }
            }
        }
        Value::Array(parts) => parts.iter_mut().try_for_each(|part| turn(part, system))?,
        _ => {}
    }
    Some(())
}

/// Turns a place, or a list of such.
fn degrees(value: &mut Value, system: &ReferenceSystem) -> Option<()> {
    let parts = value.as_array_mut()?;
    if let [Value::Number(x), Value::Number(y), ..] = &parts[..] {
        let place = system.geodetic(x.as_f64()?, y.as_f64()?)?;
        // A tenth of a millimetre.
        let rounded = |radians: f64| Value::from((radians.to_degrees() * 1e9).round() / 1e9);
        let pair = [rounded(place.longitude), rounded(place.latitude)];
        parts.splice(..2, pair);
        return Some(());
    }
    parts.iter_mut().try_for_each(|part| degrees(part, system))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_in_a_system_of_their_own_are_brought_to_degrees() {
        // By pyproj: 2683000, 1247000 of EPSG:2056 and 465429.756, 5246517.201 of EPSG:32632.
        for (code, [x, y], [longitude, latitude]) in [
            (
                2056,
                [2_683_000.0, 1_247_000.0],
                [8.537_504_877, 47.368_613_839],
            ),
            (32_632, [465_429.756, 5_246_517.201], [8.5421, 47.3712]),
            // DHDN, in degrees.
            (4314, [8.5, 47.4], [8.499_050_7, 47.399_148_3]),
        ] {
            let text = format!(
                r#"{{"type":"FeatureCollection","crs":{{"type":"name","properties":{{"name":"urn:ogc:def:crs:EPSG::{code}"}}}},
                "features":[{{"type":"Feature","properties":{{"coordinates":[1,2]}},"geometry":{{"type":"LineString","coordinates":[[{x},{y},5],[{x},{y}]]}}}}]}}"#
            );
            let (turned, notes) = geojson_in_degrees(&text).unwrap();
            let whole: Value = serde_json::from_str(&turned).unwrap();
            let place = whole.pointer("/features/0/geometry/coordinates/0").unwrap();
            let number = |at: usize| place[at].as_f64().unwrap();
            assert!(
                (number(0) - longitude).hypot(number(1) - latitude) < 1e-7,
                "{turned}"
            );
            assert!((number(2) - 5.0).abs() < 1e-9);
            assert_eq!(
                whole.pointer("/features/0/properties/coordinates/1"),
                Some(&Value::from(2))
            );
            assert!(whole.get("crs").is_none() && !notes.is_empty());
        }
        let of_2007 = r#"{"type":"Point","coordinates":[950000,6000000],"crs":{"type":"EPSG","properties":{"code":3857}}}"#;
        assert!(geojson_in_degrees(of_2007).is_some());
        for other in [
            r#"{"type":"Point","coordinates":[8,47]}"#,
            r#"{"type":"Point","coordinates":[8,47],"crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:OGC:1.3:CRS84"}}}"#,
            r#"{"type":"Point","coordinates":[8,47],"crs":{"type":"name","properties":{"name":"EPSG:4258"}}}"#,
            "name,crs\n1,2\n",
        ] {
            assert_eq!(geojson_in_degrees(other), None, "{other}");
        }
    }
}
