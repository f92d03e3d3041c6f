//! One entry for all formats that are read.

use super::{ExchangeError, Format, csv_read, geojson, gpx, kml_read, plan, waypoints};
use crate::mission::Route;
use crate::mission::found;
use pilotage_base::frames::{Geodetic, LocalFrame};
use pilotage_vision::landmark::Landmark;

/// What a file brought.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// The format it was in.
    pub format: Format,
    /// The world frame in which routes and landmarks are placed.
    pub frame: LocalFrame,
    /// Its routes.
    pub routes: Vec<Route>,
    /// Its landmarks.
    pub landmarks: Vec<Landmark>,
    /// What was assumed, kept aside or left out, in sentences for people.
    pub notes: Vec<String>,
}

/// Reads the routes and landmarks of a file in any format, told by its content and its name.
///
/// They are placed in `frame`; without one around the middle of what was found. Identities are
/// unique within the file, not among those that the caller has already.
pub fn read_any(
    name: &str,
    bytes: &[u8],
    frame: Option<LocalFrame>,
) -> Result<Imported, ExchangeError> {
    let unknown = || ExchangeError::Unknown {
        file: name.to_owned(),
    };
    let format = Format::of(name, bytes).ok_or_else(unknown)?;
    let mut notes = Vec::new();
    let unpacked = match format {
        Format::Kmz => kml_read::unpack(name, bytes)?,
        _ => Vec::new(),
    };
    let bytes = if format == Format::Kmz {
        &unpacked
    } else {
        bytes
    };
    let found = {
        let content = text(bytes, &mut notes);
        match format {
            Format::Plan => plan::read(name, &content)?,
            Format::Waypoints => waypoints::read(name, &content)?,
            Format::GeoJson => geojson::read(name, &content)?,
            Format::Kml | Format::Kmz => kml_read::read(name, &content)?,
            Format::Gpx => gpx::read(name, &content)?,
            Format::Csv => csv_read::read(name, &content)?,
        }
    };
    if found.routes.is_empty() && found.landmarks.is_empty() {
        let mut cause = "there is neither a route nor a landmark in it".to_owned();
        for note in &found.notes {
            cause.push_str("; ");
            cause.push_str(note);
        }
        return Err(ExchangeError::File {
            file: name.to_owned(),
            cause,
        });
    }
    let frame = frame.unwrap_or_else(|| {
        let middle = found::middle(&found.landmarks, &found.routes);
        let origin = found.origin.or(middle);
        LocalFrame::new(origin.unwrap_or(Geodetic::from_degrees(0.0, 0.0, 0.0)))
    });
    notes.extend(found.notes);
    Ok(Imported {
        format,
        frame,
        routes: found::routes(found.routes, &frame),
        landmarks: found::landmarks(found.landmarks, &frame),
        notes,
    })
}

/// The text of a file: UTF-8, or else taken for Latin-1, which is said.
fn text(bytes: &[u8], notes: &mut Vec<String>) -> String {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    std::str::from_utf8(bytes).map_or_else(
        |_| {
            notes.push("the text is not UTF-8: it is read as Latin-1".to_owned());
            bytes.iter().map(|b| char::from(*b)).collect()
        },
        str::to_owned,
    )
}
