//! Writing KML and KMZ.

use std::collections::BTreeSet;
use std::fmt::Write;

use serde_json::Value;

use super::embedded::{self, Embedded};
use super::item::counted;
use super::kml_elements::{ELEMENT, KML, OWN, elements_of, name_spaces};
use super::{ExchangeError, Places, route_actions};
use crate::mission::{degrees, globe, rings};
use pilotage_base::files::{FileSink, ZipSink};
use pilotage_base::frames::{AltitudeFrame, GroundPoint, LocalFrame};
use pilotage_base::text::without_markup;

/// Note of a flown track without a date.
pub(super) const UNDATED: &str =
    "the date is not known: times are counted from 1970-01-01T00:00:00Z";

/// Routes as lines, landmarks and no-fly areas as polygons, rally points as points.
pub(super) fn write(places: &Places, frame: &LocalFrame) -> (String, Vec<String>) {
    let Places {
        routes,
        landmarks,
        no_fly,
        rally,
    } = *places;
    let mut placemarks = Placemarks::default();
    let mut hidden = 0;
    for route in routes {
        let frames: BTreeSet<&str> = route
            .way_points
            .iter()
            .map(|w| w.altitude.frame.name())
            .collect();
        let first = route.way_points.first().map(|w| w.altitude.frame);
        let mode = match first {
            Some(AltitudeFrame::Amsl) if frames.len() == 1 => "absolute",
            Some(AltitudeFrame::AboveGround) if frames.len() == 1 => "relativeToGround",
            _ => "clampToGround",
        };
        hidden += usize::from(mode == "clampToGround" && first.is_some());
        let coordinates: Vec<String> = route
            .way_points
            .iter()
            .map(|w| {
                let height = w.altitude.metres;
                match mode {
                    "clampToGround" => position(frame, &w.position),
                    _ => format!("{},{}", position(frame, &w.position), Value::from(height)),
                }
            })
            .collect();
        let geometry = format!(
            "<LineString><tessellate>1</tessellate><altitudeMode>{mode}</altitudeMode>\
             <coordinates>{}</coordinates></LineString>",
            coordinates.join(" ")
        );
        let embedded = embedded::of_route(route, frame);
        placemarks.add(&route.name, &embedded, &geometry);
    }
    for landmark in landmarks {
        let geometry = polygon(&rings(landmark), frame);
        let embedded = embedded::of_landmark(landmark, frame);
        placemarks.add(&landmark.name, &embedded, &geometry);
    }
    for zone in no_fly {
        let closed = |ring: &Vec<GroundPoint>| ring.iter().chain(ring.first()).copied().collect();
        let rings: Vec<Vec<GroundPoint>> = std::iter::once(&zone.corners)
            .chain(&zone.holes)
            .map(closed)
            .collect();
        let embedded = embedded::of_no_fly(zone, frame);
        placemarks.add(&zone.name, &embedded, &polygon(&rings, frame));
    }
    for point in rally.unwrap_or_default() {
        let place = position(frame, &point.position);
        let geometry = format!("<Point><coordinates>{place}</coordinates></Point>");
        let embedded = embedded::of_rally(point, frame);
        placemarks.add(&point.name, &embedded, &geometry);
    }
    let text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml xmlns=\"{KML}\" xmlns:gx=\"http://www.google.com/kml/ext/2.2\"{}>\n\
         <Document>\n{}</Document>\n</kml>\n",
        name_spaces(&placemarks.prefixes),
        placemarks.text
    );
    let mut notes: Vec<String> = route_actions::unseen(routes).into_iter().collect();
    if hidden > 0 {
        notes.push(
            "KML has no altitudes above take-off: other programs see the route on the ground"
                .to_owned(),
        );
    }
    if !placemarks.left_out.is_empty() {
        notes.push(format!(
            "elements of placemarks that have no place beside what is written are left out: {}",
            counted(&placemarks.left_out)
        ));
    }
    (text, notes)
}

/// A polygon of rings, each with its first corner again at the end: the outer one, then holes.
fn polygon(rings: &[Vec<GroundPoint>], frame: &LocalFrame) -> String {
    let mut geometry = String::from("<Polygon>");
    for (i, ring) in rings.iter().enumerate() {
        let boundary = if i == 0 {
            "outerBoundaryIs"
        } else {
            "innerBoundaryIs"
        };
        let ring: Vec<String> = ring.iter().map(|corner| position(frame, corner)).collect();
        let _ = write!(
            geometry,
            "<{boundary}><LinearRing><coordinates>{}</coordinates></LinearRing></{boundary}>",
            ring.join(" ")
        );
    }
    geometry + "</Polygon>"
}

fn position(frame: &LocalFrame, p: &GroundPoint) -> String {
    let (longitude, latitude) = globe::lon_lat(frame, p);
    format!("{},{}", degrees(longitude), degrees(latitude))
}

/// Placemarks as they are written, one after another.
#[derive(Default)]
struct Placemarks {
    text: String,
    /// Prefixes of other programs' elements.
    prefixes: BTreeSet<&'static str>,
    /// Names of elements that have no place here.
    left_out: Vec<String>,
}

impl Placemarks {
    fn add(&mut self, name: &str, embedded: &Embedded, geometry: &str) {
        let text = &mut self.text;
        // Writing into a string cannot fail.
        let _ = write!(
            text,
            "<Placemark>\n  <name>{}</name>\n",
            without_markup(name)
        );
        let elements = elements_of(&embedded.texts);
        self.prefixes.extend(elements.prefixes);
        self.left_out.extend(elements.left_out);
        for raw in elements.before {
            let _ = writeln!(text, "  {raw}");
        }
        text.push_str("  <ExtendedData>\n");
        let datum = |text: &mut String, name: &str, value: &str| {
            let _ = writeln!(
                text,
                "    <Data name=\"{}\"><value>{}</value></Data>",
                without_markup(name),
                without_markup(value)
            );
        };
        datum(text, OWN, &embedded.own);
        for (name, value) in &embedded.texts {
            if !name.starts_with(ELEMENT) {
                datum(text, name, value);
            }
        }
        text.push_str("  </ExtendedData>\n");
        for raw in elements.after {
            let _ = writeln!(text, "  {raw}");
        }
        let _ = write!(text, "  {geometry}\n</Placemark>\n");
    }
}

/// The KML in a zip.
pub(super) fn pack(text: &str) -> Result<Vec<u8>, ExchangeError> {
    let mut zip = ZipSink::default();
    let packed = zip
        .write("doc.kml", text.as_bytes())
        .and_then(|()| zip.finish());
    packed.map_err(|cause| ExchangeError::File {
        file: "doc.kml".to_owned(),
        cause,
    })
}
