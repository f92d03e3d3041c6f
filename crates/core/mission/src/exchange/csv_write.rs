//! Writing tables of way-points or landmarks, units in the header.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

use super::csv_rows::{of_routes_left_out, quoted};
use super::file_look::{Claim, FileForm, FileLook};
use super::format_info::{FormatInfo, HeldBeside, HeldTogether};
use super::format_work::{FormatWork, Read, TrackWork};
use super::written::WrittenFile;
use super::{ExchangeError, Format, csv_read, fence, flown_text, rally};
use crate::mission::way_point_file::{StatedCircles, action_word, frame_word};
use crate::mission::{FEATURE_MEMBER, Route, WayPoint, degrees, globe};
use pilotage_base::frames::{GroundPoint, LocalFrame};
use pilotage_vision::landmark::Landmark;

/// The format.
pub(super) const INFO: FormatInfo = FormatInfo {
    name: "CSV",
    as_words: "CSV",
    extensions: &["csv", "tsv"],
    anybodys: &[],
    maker: None,
    together: HeldTogether::Either,
    holds_tracks: true,
    beside: HeldBeside::Nothing,
};

/// Any table that is nobody else's. No text has zeros.
fn claims(look: &FileLook<'_>) -> Claim {
    let is_text = || Format::of_name(look.name).is_some() || !look.head.contains('\0');
    match look.form {
        FileForm::Text if look.is_named(&INFO) => Claim::Named,
        FileForm::Text if look.is_table() && is_text() => Claim::Possible,
        _ => Claim::None,
    }
}

/// Its reader and writers.
pub(super) const WORK: FormatWork = FormatWork {
    claims,
    read: Read::Text(csv_read::read),
    write: |places, frame| {
        let text = match (places.routes, places.landmarks) {
            ([], landmarks) => write_landmarks(landmarks, frame),
            (routes, []) => write_routes(routes, frame),
            _ => {
                return Err(ExchangeError::CannotHold {
                    format: INFO.name,
                    what: "routes and landmarks in one table".to_owned(),
                    advice: "write them into two files",
                });
            }
        };
        let mut notes: Vec<String> = fence::left_out(&[], places.no_fly, frame)
            .into_iter()
            .chain(rally::left_out(places))
            .collect();
        if places.routes.iter().any(|route| route.returns) {
            notes.push("the return at the end is left out: rows are way-points".to_owned());
        }
        notes.extend(of_routes_left_out(places.routes));
        Ok(WrittenFile::of_text((text, notes)))
    },
    track: Some(TrackWork {
        write: |track| Ok(flown_text::csv(track).into_bytes()),
        undated: None,
    }),
};

/// Way-points of routes, one a row.
pub(super) fn write_routes(routes: &[Route], frame: &LocalFrame) -> String {
    let rows: Vec<(&Route, &WayPoint)> = routes
        .iter()
        .flat_map(|route| route.way_points.iter().map(move |w| (route, w)))
        .collect();
    let others = other_columns(rows.iter().map(|(_, w)| &w.properties));
    let mut table = CsvTableWriter::new(&[
        "route",
        "latitude_deg",
        "longitude_deg",
        "altitude_m",
        "altitude_frame",
        "speed_m/s",
        "action",
        "radius_m",
        "turns",
        "seconds",
    ]);
    table.row_of(&others);
    for (route, way_point) in rows {
        let (latitude, longitude) = place(frame, &way_point.position);
        let StatedCircles {
            radius,
            turns,
            seconds,
        } = StatedCircles::of(&way_point.action);
        let [radius, turns, seconds] =
            [radius, turns, seconds].map(|n| n.map_or_else(String::new, |n| n.to_string()));
        table.row(&[
            &route.name,
            &latitude,
            &longitude,
            &way_point.altitude.metres.to_string(),
            frame_word(way_point.altitude.frame),
            &way_point.speed.map_or_else(String::new, |v| v.to_string()),
            action_word(&way_point.action),
            &radius,
            &turns,
            &seconds,
        ]);
        table.row_of(&cells(&others, &way_point.properties));
    }
    table.finish()
}

/// Landmarks, one a row.
pub(super) fn write_landmarks(landmarks: &[Landmark], frame: &LocalFrame) -> String {
    let others = other_columns(landmarks.iter().map(|l| &l.properties));
    let mut table = CsvTableWriter::new(&[
        "id",
        "name",
        "latitude_deg",
        "longitude_deg",
        "height_m",
        "enabled",
        "box_north_m",
        "box_east_m",
        "offset_north_m",
        "offset_east_m",
    ]);
    table.row_of(&others);
    // A hundredth of a millimetre, as places are written.
    // A hundredth of a millimetre below zero is no -0.
    let metres = |value: f64| ((value * 1e5).round() / 1e5 + 0.0).to_string();
    for landmark in landmarks {
        let (latitude, longitude) = place(frame, &landmark.reference);
        let middle = landmark.bounds.center();
        table.row(&[
            &landmark.id.to_string(),
            &landmark.name,
            &latitude,
            &longitude,
            &landmark.height.to_string(),
            &landmark.enabled.to_string(),
            &metres(landmark.bounds.height()),
            &metres(landmark.bounds.width()),
            &metres(middle.north - landmark.reference.north),
            &metres(middle.east - landmark.reference.east),
        ]);
        table.row_of(&cells(&others, &landmark.properties));
    }
    table.finish()
}

fn place(frame: &LocalFrame, p: &GroundPoint) -> (String, String) {
    let (longitude, latitude) = globe::lon_lat(frame, p);
    (degrees(latitude), degrees(longitude))
}

/// Names of properties that any row has.
fn other_columns<'a>(rows: impl Iterator<Item = &'a BTreeMap<String, String>>) -> Vec<String> {
    let names: BTreeSet<&String> = rows
        .flat_map(BTreeMap::keys)
        .filter(|name| !name.starts_with(FEATURE_MEMBER))
        .collect();
    names.into_iter().cloned().collect()
}

fn cells(columns: &[String], properties: &BTreeMap<String, String>) -> Vec<String> {
    columns
        .iter()
        .map(|name| {
            let text = properties.get(name).map_or("", String::as_str);
            match serde_json::from_str(text) {
                Ok(Value::String(plain)) => plain,
                _ => text.to_owned(),
            }
        })
        .collect()
}

/// A table that is written in pieces of rows: the known columns, then the others.
struct CsvTableWriter {
    text: String,
    row: Vec<String>,
}

impl CsvTableWriter {
    fn new(columns: &[&str]) -> Self {
        let mut table = Self {
            text: String::new(),
            row: Vec::new(),
        };
        table.row(columns);
        table
    }

    fn row(&mut self, cells: &[&str]) {
        self.row = cells.iter().map(|cell| quoted(cell)).collect();
    }

    /// Adds the last cells of the row and ends it.
    fn row_of(&mut self, cells: &[String]) {
        self.row.extend(cells.iter().map(|cell| quoted(cell)));
        self.text.push_str(&self.row.join(","));
        self.text.push('\n');
    }

    fn finish(self) -> String {
        self.text
    }
}
