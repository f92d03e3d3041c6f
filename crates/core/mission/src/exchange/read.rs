//! Reading of files in all formats that are known.

use super::decoded_text::decoded;
use super::format_work::Read;
use super::{ExchangeError, Format};
use crate::mission::found::{self, LonLat};
use crate::mission::{NoFlyZone, RallyPoint, Route};
use pilotage_base::frames::{Geodetic, GroundPoint, LocalFrame};
use pilotage_base::text::of_utf_16;
use pilotage_vision::landmark::Landmark;

/// Distance from the middle beyond which lengths on the plane differ from those on the ground by more
/// than a thousandth, metres.
const FAR: f64 = 300_000.0;

/// Contents of a file that was read.
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
    /// Areas that must not be flown over: those of our own files, and fences that keep aircraft out.
    pub no_fly: Vec<NoFlyZone>,
    /// Places to land at when the aircraft cannot go on.
    pub rally: Vec<RallyPoint>,
    /// Notes on all that was assumed, kept aside or left out, in sentences for people.
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
    let mut notes = Vec::new();
    let utf_16 = of_utf_16(bytes);
    let bytes = utf_16.as_ref().map_or(bytes, |text| text.as_bytes());
    if utf_16.is_some() {
        notes.push("the text is UTF-16".to_owned());
    }
    let format = Format::of(name, bytes).ok_or_else(unknown)?;
    let found = match format.work().read {
        Read::Text(read) => read(name, &decoded(bytes, &mut notes))?,
        Read::Bytes(read) => read(name, bytes)?,
    };
    let has_areas = !found.no_fly.is_empty() || !found.rally.is_empty();
    if found.routes.is_empty() && found.landmarks.is_empty() && !has_areas {
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
    let mut places = found::places(&found.landmarks, &found.routes);
    places.extend(found.no_fly.iter().flat_map(|zone| &zone.corners));
    places.extend(found.rally.iter().map(|point| point.place));
    let origin = frame.map(|frame| frame.origin).or(found.origin);
    let origin = match (
        origin.or_else(|| found::middle_of(&places)),
        places.is_empty(),
    ) {
        (Some(origin), _) => origin,
        (None, true) => Geodetic::from_degrees(0.0, 0.0, 0.0),
        (None, false) => return Err(too_far(name, "lie around the whole globe")),
    };
    let frame = frame.unwrap_or_else(|| LocalFrame::new(origin));
    notes.extend(found.notes);
    notes.extend(reach(name, &frame, &places)?);
    Ok(Imported {
        format,
        frame,
        routes: found::routes(found.routes, &frame),
        landmarks: found::landmarks(found.landmarks, &frame),
        no_fly: found::no_fly(found.no_fly, &frame),
        rally: found::rally(found.rally, &frame),
        notes,
    })
}

/// Refuses places that the plane through the origin does not hold; a note where it holds them, but its
/// lengths are not those on the ground.
fn reach(
    file: &str,
    frame: &LocalFrame,
    places: &[LonLat],
) -> Result<Option<String>, ExchangeError> {
    let mut farthest = 0.0_f64;
    for (longitude, latitude) in places {
        let place = Geodetic::from_degrees(*latitude, *longitude, 0.0);
        let Some(ground) = frame.ground_if_near(&place) else {
            let cause = format!(
                "lie too far apart for one plane, as {latitude:.4}°, {longitude:.4}° does from {:.4}°, \
                 {:.4}° in the middle",
                frame.origin.latitude.to_degrees(),
                frame.origin.longitude.to_degrees()
            );
            return Err(too_far(file, &cause));
        };
        farthest = farthest.max(ground.distance(&GroundPoint::default()));
    }
    Ok((farthest > FAR).then(|| {
        format!(
            "places lie up to {:.0} km from the middle: they are exact, but lengths and courses on the \
             world's plane are not those on the ground",
            farthest / 1e3
        )
    }))
}

fn too_far(file: &str, what: &str) -> ExchangeError {
    ExchangeError::File {
        file: file.to_owned(),
        cause: format!("its places {what}: split the file into regions"),
    }
}
