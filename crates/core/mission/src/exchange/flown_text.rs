//! Flown tracks as text: GPX, GeoJSON and CSV.

use std::fmt::Write;

use serde_json::{Value, json};

use super::flown_track::{FlownTrack, angles, finite};
use pilotage_base::text::csv_cell;
use pilotage_base::text::without_markup;

/// Track as GPX.
pub(super) fn gpx(track: &FlownTrack) -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<gpx version=\"1.1\" creator=\"Pilotage\" \
         xmlns=\"http://www.topografix.com/GPX/1/1\" xmlns:pilotage=\"urn:pilotage:1\">\n",
    );
    let _ = writeln!(
        text,
        "<trk>\n  <name>{}</name>",
        without_markup(&track.name)
    );
    if let Some(values) = &track.values {
        let title = without_markup(&values.title());
        let _ = writeln!(text, "  <desc>with {title}</desc>");
    }
    text.push_str("  <trkseg>\n");
    for point in &track.points {
        let (latitude, longitude) = angles(&point.place);
        let _ = write!(text, "    <trkpt lat=\"{latitude}\" lon=\"{longitude}\">");
        if track.has_height {
            let _ = write!(text, "<ele>{}</ele>", point.place.height);
        }
        if let Some(utc) = track.utc(point) {
            let _ = write!(text, "<time>{utc}</time>");
        }
        if let Some((values, value)) = track.values.as_ref().zip(finite(point.value)) {
            let (name, unit) = (without_markup(&values.name), without_markup(&values.unit));
            let _ = write!(
                text,
                "<extensions><pilotage:value name=\"{name}\" unit=\"{unit}\">{value}</pilotage:value></extensions>"
            );
        }
        text.push_str("</trkpt>\n");
    }
    text.push_str("  </trkseg>\n</trk>\n</gpx>\n");
    text
}

/// GeoJSON of a single line; times and values stand in `coordinateProperties`, one each per place, as converters of
/// GPX and KML write them.
/// Track as GeoJSON.
pub(super) fn geojson(track: &FlownTrack) -> String {
    let number = |value: Option<f64>| finite(value).map_or(Value::Null, Value::from);
    let times = track.points.iter().map(|point| match track.utc(point) {
        Some(utc) => Value::from(utc),
        None => Value::from(point.time),
    });
    let mut beside = serde_json::Map::new();
    beside.insert("times".to_owned(), times.collect());
    let mut properties = serde_json::Map::new();
    properties.insert("name".to_owned(), track.name.clone().into());
    if let Some(values) = &track.values {
        let column = track.points.iter().map(|point| number(point.value));
        beside.insert(values.title(), column.collect());
    }
    properties.insert("coordinateProperties".to_owned(), Value::Object(beside));
    let coordinates: Vec<String> = track
        .points
        .iter()
        .map(|point| {
            let (latitude, longitude) = angles(&point.place);
            let height = if track.has_height {
                format!(",{}", json!(point.place.height))
            } else {
                String::new()
            };
            format!("[{longitude},{latitude}{height}]")
        })
        .collect();
    format!(
        "{{\"type\":\"FeatureCollection\",\"features\":[{{\"type\":\"Feature\",\"properties\":{},\
         \"geometry\":{{\"type\":\"LineString\",\"coordinates\":[{}]}}}}]}}\n",
        Value::Object(properties),
        coordinates.join(",")
    )
}

/// Track as CSV.
pub(super) fn csv(track: &FlownTrack) -> String {
    let mut text = String::from("time_s");
    if track.utc_at_zero.is_some() {
        text.push_str(",utc");
    }
    text.push_str(",latitude_deg,longitude_deg");
    if track.has_height {
        text.push_str(",altitude_m");
    }
    if let Some(values) = &track.values {
        text.push(',');
        text.push_str(&csv_cell(&values.title()));
    }
    text.push('\n');
    for point in &track.points {
        let (latitude, longitude) = angles(&point.place);
        text += &point.time.to_string();
        if let Some(utc) = track.utc(point) {
            let _ = write!(text, ",{utc}");
        }
        let _ = write!(text, ",{latitude},{longitude}");
        if track.has_height {
            let _ = write!(text, ",{}", point.place.height);
        }
        if track.values.is_some() {
            text.push(',');
            if let Some(value) = finite(point.value) {
                text += &value.to_string();
            }
        }
        text.push('\n');
    }
    text
}
