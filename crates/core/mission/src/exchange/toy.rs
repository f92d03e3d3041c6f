//! A toy format: a route as lines of latitude and longitude, and all of it that only we know in a last line.

use std::fmt::Write as _;

use super::embedded::{self, EmbeddedItem};
use super::format_info::{FormatInfo, HeldBeside};
use super::format_work::{FormatWork, Read};
use super::found::GeodeticContent;
use super::written::WrittenFile;
use super::{ExchangeError, fence, rally};
use crate::mission::found::{LonLat, ReadRoute, on_globe};
use crate::mission::{Route, USUAL_ALTITUDE, WayPoint, degrees, globe};
use pilotage_base::frames::{GroundPoint, LocalFrame};

/// First line of each file.
const HEAD: &str = "TOY ROUTE";
/// Mark before the last line.
const OWN: &str = "# ";

/// The format.
pub(super) const INFO: FormatInfo = FormatInfo {
    name: "Toy",
    as_words: "a toy route",
    extensions: &["toyroute"],
    is_told_by_extension: true,
    begins: Some(HEAD),
    is_mission: true,
    holds_tracks: false,
    beside: HeldBeside::Nothing,
};

/// Its reader and writers.
pub(super) const WORK: FormatWork = FormatWork {
    read: Read::Text(read),
    write: |places, frame| {
        let areas = fence::left_out(&[], places.no_fly, frame);
        let notes = areas.into_iter().chain(rally::left_out(places)).collect();
        Ok(WrittenFile::of_text((
            write(&places.routes[0], frame),
            notes,
        )))
    },
    track: None,
};

fn write(route: &Route, frame: &LocalFrame) -> String {
    let mut text = format!("{HEAD}\n");
    for way_point in &route.way_points {
        let (longitude, latitude) = globe::lon_lat(frame, &way_point.position);
        let _ = writeln!(text, "{} {}", degrees(latitude), degrees(longitude));
    }
    let _ = writeln!(text, "{OWN}{}", embedded::of_route_whole(route, frame));
    text
}

fn read(file: &str, text: &str) -> Result<GeodeticContent, ExchangeError> {
    let mut places = Vec::new();
    let mut own = None;
    for (index, line) in text.lines().enumerate().skip(1) {
        if let Some(stated) = line.strip_prefix(OWN) {
            own = Some(stated);
            continue;
        }
        let place = place(line).ok_or_else(|| ExchangeError::Place {
            file: file.to_owned(),
            line: index + 1,
            column: 1,
            cause: "it needs a latitude and a longitude in degrees".to_owned(),
        });
        places.push(place?);
    }
    let known = own.and_then(|own| embedded::read(own, &places, &[]));
    let route = match known {
        Some((EmbeddedItem::Route(route), false)) => route,
        _ => ReadRoute {
            way_points: places.into_iter().map(at_usual_altitude).collect(),
            ..ReadRoute::default()
        },
    };
    Ok(GeodeticContent {
        routes: vec![route],
        ..GeodeticContent::default()
    })
}

fn place(line: &str) -> Option<LonLat> {
    let (latitude, longitude) = line.split_once(' ')?;
    let (longitude, latitude) = (longitude.parse().ok()?, latitude.parse().ok()?);
    on_globe(longitude, latitude).then_some((longitude, latitude))
}

fn at_usual_altitude(place: LonLat) -> (LonLat, WayPoint) {
    (place, WayPoint::new(GroundPoint::default(), USUAL_ALTITUDE))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bad_line_is_named() {
        let cause = read("a.toyroute", "TOY ROUTE\n45 -30\n45 north\n").err();
        let cause = cause.unwrap().to_string();
        assert!(cause.starts_with("a.toyroute, line 3"), "{cause}");
    }
}
