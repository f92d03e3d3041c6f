//! GPX: routes and tracks as routes, way-points as landmarks.

use std::fmt::Write;

use serde_json::Value;

use super::embedded::{self, EmbeddedItem};
use super::file_look::{Claim, FileForm, FileLook};
use super::format_info::{FormatInfo, HeldBeside, HeldTogether};
use super::format_work::{FormatWork, Read, TrackWork};
use super::found::{GeodeticContent, POINT_BOX};
use super::written::WrittenFile;
use super::xml::{NamedText, XmlElement};
use super::{ExchangeError, Places, fence, flown_text, little_navmap, route_actions};
use crate::mission::found::{
    FoundLandmark, FoundRally, LandmarkExtent, LonLat, ReadRoute, on_globe,
};
use crate::mission::{USUAL_ALTITUDE, WayPoint, degrees, globe};
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint, LocalFrame};
use pilotage_base::text::without_markup;

/// The format.
pub(super) const INFO: FormatInfo = FormatInfo {
    name: "GPX",
    as_words: "GPX",
    extensions: &["gpx", "lnmpln"],
    anybodys: &[],
    maker: None,
    together: HeldTogether::Both,
    holds_tracks: true,
    beside: HeldBeside::Rally,
};

fn claims(look: &FileLook<'_>) -> Claim {
    let has = |word: &str| look.head.contains(word);
    match look.form {
        FileForm::Xml if has("<gpx") || has("<LittleNavmap") => Claim::Sure,
        FileForm::Xml if look.is_named(&INFO) => Claim::Named,
        _ => look.named_text(&INFO),
    }
}

/// Its reader and writers.
pub(super) const WORK: FormatWork = FormatWork {
    claims,
    read: Read::Text(read),
    write: |places, frame| {
        let (text, mut notes) = write(places, frame);
        notes.extend(fence::left_out(&[], places.no_fly, frame));
        Ok(WrittenFile::of_text((text, notes)))
    },
    track: Some(TrackWork {
        write: |track| Ok(flown_text::gpx(track).into_bytes()),
        undated: Some("the date is not known: the points have no times"),
    }),
};

/// Element in a route's extensions that holds what only we know.
const OWN: &str = "feature";

/// Reads routes, tracks and way-points.
pub(super) fn read(file: &str, text: &str) -> Result<GeodeticContent, ExchangeError> {
    let source = NamedText { file, text };
    let root = source.root()?;
    if root.name == little_navmap::ROOT {
        return little_navmap::read(&source, &root);
    }
    let mut found = GeodeticContent::default();
    let mut is_assumed = false;
    for route in root.all("rte") {
        is_assumed |= line(&source, route, route, "rtept", &mut found)?;
    }
    for track in root.all("trk") {
        for segment in track.all("trkseg") {
            is_assumed |= line(&source, track, segment, "trkpt", &mut found)?;
        }
    }
    if is_assumed {
        found
            .notes
            .push(format!("points without elevation are at {USUAL_ALTITUDE}"));
    }
    let mut points = 0;
    for point in root.all("wpt") {
        if let Some(rally) = rally(&source, point)? {
            found.rally.push(rally);
            continue;
        }
        points += 1;
        let mut landmark = FoundLandmark::new(LandmarkExtent::Point(place(&source, point)?));
        landmark.name = point.child_text("name").map(str::to_owned);
        for child in &point.children {
            if child.name != "name" && child.children.is_empty() && !child.text.is_empty() {
                let value = Value::from(child.text.as_str()).to_string();
                landmark.properties.insert(child.name.clone(), value);
            }
        }
        found.landmarks.push(landmark);
    }
    if points > 0 {
        found.notes.push(format!(
            "{points} way-points outside of routes are landmarks, each in a box of {POINT_BOX} m"
        ));
    }
    Ok(found)
}

/// The rally point that a way-point says it is; its altitude is embedded.
fn rally(source: &NamedText, point: &XmlElement) -> Result<Option<FoundRally>, ExchangeError> {
    let own = point.child("extensions").and_then(|e| e.child_text(OWN));
    let Some(own) = own else { return Ok(None) };
    let Some((EmbeddedItem::Rally(mut rally), _)) =
        embedded::read(own, &[place(source, point)?], &[])
    else {
        return Ok(None);
    };
    rally.name = point.child_text("name").map(str::to_owned);
    Ok(Some(rally))
}

/// Adds the line of `points` in `holder`; says whether an elevation had to be assumed.
fn line(
    source: &NamedText,
    named: &XmlElement,
    holder: &XmlElement,
    points: &str,
    found: &mut GeodeticContent,
) -> Result<bool, ExchangeError> {
    let mut is_assumed = false;
    let mut way_points = Vec::new();
    for point in holder.all(points) {
        let place = place(source, point)?;
        let elevation = point.child_text("ele").map(|text| {
            text.parse::<f64>().map_err(|_| {
                source.error(point.begin, format!("{points}/ele: `{text}` is no number"))
            })
        });
        let elevation = elevation.transpose()?.filter(|m| m.is_finite());
        is_assumed |= elevation.is_none();
        let altitude = elevation.map_or(USUAL_ALTITUDE, |m| Altitude::new(m, AltitudeFrame::Amsl));
        let mut way_point = WayPoint::new(GroundPoint::default(), altitude);
        if let Some(name) = point.child_text("name") {
            let name = Value::from(name).to_string();
            way_point.properties.insert("name".to_owned(), name);
        }
        way_points.push((place, way_point));
    }
    let name = named.child_text("name").map(str::to_owned);
    let places: Vec<LonLat> = way_points.iter().map(|w| w.0).collect();
    let own = named
        .child("extensions")
        .and_then(|extensions| extensions.child_text(OWN));
    if let Some((EmbeddedItem::Route(mut route), false)) =
        own.and_then(|own| embedded::read(own, &places, &[]))
    {
        route.name = name;
        found.routes.push(route);
        return Ok(false);
    }
    if way_points.is_empty() {
        return Ok(false);
    }
    let mut route = ReadRoute {
        name,
        way_points,
        ..ReadRoute::default()
    };
    if let Some(description) = named.child_text("desc") {
        let description = Value::from(description).to_string();
        route.properties.insert("desc".to_owned(), description);
    }
    found.routes.push(route);
    Ok(is_assumed)
}

fn place(source: &NamedText, point: &XmlElement) -> Result<LonLat, ExchangeError> {
    let number = |name: &str| point.attribute(name)?.trim().parse::<f64>().ok();
    match (number("lon"), number("lat")) {
        (Some(longitude), Some(latitude)) if on_globe(longitude, latitude) => {
            Ok((longitude, latitude))
        }
        _ => Err(source.error(
            point.begin,
            format!("{}: it needs lat and lon in degrees", point.name),
        )),
    }
}

/// Routes as routes, landmarks and rally points as way-points.
pub(super) fn write(places: &Places<'_>, frame: &LocalFrame) -> (String, Vec<String>) {
    let Places {
        routes,
        landmarks,
        rally,
        ..
    } = *places;
    let mut text = String::from(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<gpx version=\"1.1\" creator=\"Pilotage\" \
         xmlns=\"http://www.topografix.com/GPX/1/1\" xmlns:pilotage=\"urn:pilotage:1\">\n",
    );
    let point = |p: &GroundPoint| {
        let (longitude, latitude) = globe::lon_lat(frame, p);
        format!(
            "lat=\"{}\" lon=\"{}\"",
            degrees(latitude),
            degrees(longitude)
        )
    };
    for landmark in landmarks {
        let _ = writeln!(
            text,
            "<wpt {}><name>{}</name></wpt>",
            point(&landmark.reference),
            without_markup(&landmark.name)
        );
    }
    for rally in rally.unwrap_or_default() {
        let own = embedded::of_rally_whole(rally, frame);
        let _ = writeln!(
            text,
            "<wpt {}><name>{}</name><type>rally</type>\n  <extensions><pilotage:{OWN}>{}</pilotage:{OWN}>\
             </extensions></wpt>",
            point(&rally.position),
            without_markup(&rally.name),
            without_markup(&own)
        );
    }
    let mut has_hidden = false;
    for route in routes {
        let own = embedded::of_route_whole(route, frame);
        let _ = writeln!(
            text,
            "<rte>\n  <name>{}</name>\n  <extensions><pilotage:{OWN}>{}</pilotage:{OWN}></extensions>",
            without_markup(&route.name),
            without_markup(&own)
        );
        for way_point in &route.way_points {
            let altitude = &way_point.altitude;
            let is_shown = altitude.frame == AltitudeFrame::Amsl && altitude.metres.is_finite();
            has_hidden |= !is_shown;
            let elevation = if is_shown {
                format!("<ele>{}</ele>", altitude.metres)
            } else {
                String::new()
            };
            let _ = writeln!(
                text,
                "  <rtept {}>{elevation}</rtept>",
                point(&way_point.position)
            );
        }
        text.push_str("</rte>\n");
    }
    text.push_str("</gpx>\n");
    let mut notes: Vec<String> = route_actions::unseen(routes).into_iter().collect();
    if has_hidden {
        notes.push(
            "GPX has elevations above mean sea level only: other programs do not see the others"
                .to_owned(),
        );
    }
    if !landmarks.is_empty() {
        notes.push("GPX has points only: the boxes of the landmarks are left out".to_owned());
    }
    (text, notes)
}
