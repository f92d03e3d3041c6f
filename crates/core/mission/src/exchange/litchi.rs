//! Litchi's table of way-points: 46 columns, of which those that we do not know are written as they were
//! read, or say nothing.

use super::air_altitudes::altitudes_in_the_air;
use super::csv_rows::{of_routes_left_out, quoted};
use super::file_look::Claim;
use super::format_info::{FormatInfo, HeldBeside, HeldTogether};
use super::format_work::{FormatWork, Read};
use super::item_route::GROUND_SPEED;
use super::litchi_actions::{ACTIONS, actions, in_feet, kept, legs_of_speeds};
use super::written::WrittenFile;
use super::{ExchangeError, csv_read, fence, rally};
use crate::mission::{Route, WayPoint, WayPointAction, degrees, globe};
use pilotage_base::frames::{AltitudeFrame, LocalFrame};

/// The format.
pub(super) const INFO: FormatInfo = FormatInfo {
    name: "Litchi CSV",
    as_words: "a Litchi table (CSV)",
    extensions: &["csv"],
    anybodys: &[],
    maker: Some("litchi"),
    together: HeldTogether::Mission,
    holds_tracks: false,
    beside: HeldBeside::Nothing,
};

/// Its reader and writers.
pub(super) const WORK: FormatWork = FormatWork {
    // It is a table as others are, and is read as that.
    claims: |_| Claim::None,
    read: Read::Text(csv_read::read),
    write: |places, frame| {
        let (text, mut notes) = write(&places.routes[0], frame)?;
        notes.extend(fence::left_out(&[], places.no_fly, frame));
        notes.extend(rally::left_out(places));
        Ok(WrittenFile::of_text((text, notes)))
    },
    track: None,
};

/// Columns before the actions and after them, each with what it says where nothing is known; without
/// that it is written from the way-point.
const BEFORE: [(&str, Option<&str>); 8] = [
    ("latitude", None),
    ("longitude", None),
    ("altitude(m)", None),
    ("heading(deg)", Some("0")),
    ("curvesize(m)", Some("0")),
    ("rotationdir", Some("0")),
    ("gimbalmode", Some("0")),
    ("gimbalpitchangle", Some("0")),
];
const AFTER: [(&str, Option<&str>); 8] = [
    ("altitudemode", None),
    ("speed(m/s)", None),
    ("poi_latitude", Some("0")),
    ("poi_longitude", Some("0")),
    ("poi_altitude(m)", Some("0")),
    ("poi_altitudemode", Some("0")),
    ("photo_timeinterval", Some("-1")),
    ("photo_distinterval", Some("-1")),
];

/// The route as a table, and notes on what it cannot hold.
pub(super) fn write(
    route: &Route,
    frame: &LocalFrame,
) -> Result<(String, Vec<String>), ExchangeError> {
    let altitudes = altitudes_in_the_air(route);
    if altitudes.iter().any(|a| a.frame == AltitudeFrame::Amsl) {
        return Err(ExchangeError::CannotHold {
            format: INFO.name,
            what: "altitudes above mean sea level".to_owned(),
            advice: "let the altitudes count from take-off or from the ground",
        });
    }
    let named = |i: usize| [format!("actiontype{i}"), format!("actionparam{i}")];
    let of_actions: Vec<String> = (1..=ACTIONS).flat_map(named).collect();
    let names: Vec<&str> = (BEFORE.iter().map(|(name, _)| *name))
        .chain(of_actions.iter().map(String::as_str))
        .chain(AFTER.iter().map(|(name, _)| *name))
        .collect();
    let mut text = names.join(",") + "\n";
    let mut without_room = 0;
    for (way_point, altitude) in route.way_points.iter().zip(&altitudes) {
        let (longitude, latitude) = globe::lon_lat(frame, &way_point.position);
        let cell = |(name, usual): &(&str, Option<&str>)| match (*name, usual) {
            (name, Some(usual)) => {
                kept(&way_point.properties, name).unwrap_or_else(|| (*usual).to_owned())
            }
            ("latitude", _) => degrees(latitude),
            ("longitude", _) => degrees(longitude),
            ("altitude(m)", _) => altitude.metres.to_string(),
            ("altitudemode", _) => {
                u8::from(altitude.frame == AltitudeFrame::AboveGround).to_string()
            }
            // 0 is the cruise speed.
            _ => way_point.speed.unwrap_or(0.0).to_string(),
        };
        let seconds = way_point.action.wait_seconds();
        let (actions, has_room) = actions(&way_point.properties, seconds);
        without_room += usize::from(!has_room);
        let actions = actions.into_iter().flat_map(|(kind, of)| [kind, of]);
        let row: Vec<String> = (BEFORE.iter().map(&cell))
            .chain(actions)
            .chain(AFTER.iter().map(&cell))
            .map(|cell| quoted(&cell))
            .collect();
        text += &(row.join(",") + "\n");
    }
    let mut notes = Vec::new();
    let is_more = |w: &&WayPoint| {
        let plain = [WayPointAction::FlyBy, WayPointAction::Land];
        !plain.contains(&w.action) && w.action.wait_seconds().is_none()
    };
    let more = route.way_points.iter().filter(is_more).count();
    if more > 0 {
        notes.push(format!(
            "{more} × take-off or circle is written as a way-point: Litchi has none of them"
        ));
    }
    let both = route.way_points.iter().zip(&altitudes);
    for (_, altitude) in both.filter(|(w, _)| w.action == WayPointAction::Land) {
        notes.push(format!("the landing is left out: it stays at {altitude}"));
    }
    if without_room > 0 {
        notes.push(format!(
            "{without_room} × wait is left out: the way-point has {ACTIONS} other actions"
        ));
    }
    if route.returns {
        notes.push("the return at the end is left out: choose it in Litchi".to_owned());
    }
    notes.extend(of_routes_left_out(std::slice::from_ref(route)));
    let speeds: Vec<Option<f64>> = route.way_points.iter().map(|w| w.speed).collect();
    notes.extend(legs_of_speeds(&speeds));
    let is_it = |own: &str, name: &str| own.eq_ignore_ascii_case(name);
    let is_column = |name: &str| {
        let is_own = |own: &&str| is_it(own, name) || in_feet(own).is_some_and(|f| is_it(&f, name));
        // The table says of no speed what it counts over: all are over ground.
        name == GROUND_SPEED || names.iter().any(is_own)
    };
    let others = |w: &WayPoint| w.properties.keys().any(|name| !is_column(name));
    if route.way_points.iter().any(others) {
        notes.push("properties that are none of Litchi's columns are left out".to_owned());
    }
    Ok((text, notes))
}
