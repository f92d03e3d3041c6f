//! Writing a mission of DJI, both files of it.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::super::ExchangeError;
use super::super::item::{MissionItem, RETURN_TO_LAUNCH, command_name, counted};
use super::super::route_items::{RouteStep, steps_of};
use super::heights::heights;
use super::hover::with_hover;
use super::shared::{HEADING, SharedParameters, TURN};
use super::{
    GO_HOME, IN_TEMPLATE, IN_WAYLINES, INDEX, MISSION, NAME_SPACE, OWN_NAME_SPACE, TEMPLATE,
    WAYLINES,
};
use crate::mission::{Route, WayPoint, WayPointAction, degrees, globe};
use pilotage_base::files::{FileSink, ZipSink};
use pilotage_base::frames::{GroundPoint, LocalFrame};
use pilotage_base::text::without_markup;

/// Speed of legs where a route states none, m/s.
const USUAL_SPEED: f64 = 10.0;
/// Fastest that most of DJI's aircraft fly a mission, m/s.
const FASTEST: f64 = 15.0;
/// The route as a zip, and notes on what the file cannot hold.
pub(in super::super) fn write(
    route: &Route,
    frame: &LocalFrame,
) -> Result<(Vec<u8>, Vec<String>), ExchangeError> {
    let heights = heights(route, frame)?;
    let mut notes: Vec<String> = heights.note.map(str::to_owned).into_iter().collect();
    let (speeds, common) = speeds(route, &mut notes);
    let finish = finish(route, frame, &mut notes);
    let mission = text(&route.properties, MISSION).unwrap_or_else(|| {
        notes.push(format!(
            "the file is for a Mavic 3E, which at the end does this: {finish}; choose another aircraft in \
             DJI's program if need be"
        ));
        configuration(finish, common)
    });
    let mission = with_finish(mission, route);
    let numbers = numbers(route);
    let in_folder = text(&route.properties, IN_TEMPLATE);
    let shared = SharedParameters::of(in_folder.as_deref().unwrap_or(""));
    let (mut flown, mut drawn) = (String::new(), String::new());
    for (i, way_point) in route.way_points.iter().enumerate() {
        let seconds = way_point.action.wait_seconds();
        let own = |key| text(&way_point.properties, key).map(|t| renumbered(&t, i, &numbers));
        let template = own(IN_TEMPLATE);
        let rest =
            own(IN_WAYLINES).unwrap_or_else(|| shared.of_both(template.as_deref().unwrap_or("")));
        let rest = with_hover(&shared.complete(rest), i, seconds);
        let place = place(i, &way_point.position, frame);
        let speed = element("waypointSpeed", speeds[i]);
        let height = element("executeHeight", heights.flown[i]);
        // Writing into a string cannot fail.
        let _ = writeln!(flown, "<Placemark>{place}{height}{speed}{rest}</Placemark>");
        let (ellipsoid, height) = (
            element("ellipsoidHeight", heights.flown[i]),
            element("height", heights.drawn[i]),
        );
        let rest = template.unwrap_or_else(|| {
            "<wpml:useGlobalHeadingParam>1</wpml:useGlobalHeadingParam>\
             <wpml:useGlobalTurnParam>1</wpml:useGlobalTurnParam>"
                .to_owned()
        });
        let rest = with_hover(&rest, i, seconds);
        let _ = writeln!(
            drawn,
            "<Placemark>{place}{ellipsoid}{height}<wpml:useGlobalHeight>0</wpml:useGlobalHeight>\
             <wpml:useGlobalSpeed>0</wpml:useGlobalSpeed>{speed}{rest}</Placemark>"
        );
    }
    let common = element("autoFlightSpeed", common);
    let rest = text(&route.properties, IN_WAYLINES).unwrap_or_default();
    let waylines = format!(
        "<Folder><wpml:templateId>0</wpml:templateId><wpml:executeHeightMode>{}</wpml:executeHeightMode>\
         <wpml:waylineId>0</wpml:waylineId>{common}{rest}\n{flown}</Folder>\n",
        heights.flown_mode
    );
    let rest = in_folder.unwrap_or_else(|| {
        format!(
            "<wpml:gimbalPitchMode>manual</wpml:gimbalPitchMode>\
             <wpml:globalWaypointHeadingParam>{HEADING}</wpml:globalWaypointHeadingParam>\
             <wpml:globalWaypointTurnMode>{TURN}</wpml:globalWaypointTurnMode>\
             <wpml:globalUseStraightLine>1</wpml:globalUseStraightLine>{}",
            element(
                "globalHeight",
                heights.drawn.first().copied().unwrap_or(0.0)
            )
        )
    });
    let template = heights.drawn_mode.map_or_else(String::new, |mode| {
        format!(
            "<Folder><wpml:templateType>waypoint</wpml:templateType><wpml:templateId>0</wpml:templateId>\
             <wpml:waylineCoordinateSysParam><wpml:coordinateMode>WGS84</wpml:coordinateMode>\
             <wpml:heightMode>{mode}</wpml:heightMode></wpml:waylineCoordinateSysParam>{common}{rest}\n\
             {drawn}</Folder>\n"
        )
    });
    let name_space = text(&route.properties, OWN_NAME_SPACE);
    let name_space = without_markup(name_space.as_deref().unwrap_or(NAME_SPACE));
    let document = |before: &str, folder: &str| {
        format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml xmlns=\"http://www.opengis.net/kml/2.2\" \
             xmlns:wpml=\"{name_space}\">\n<Document>\n{before}<wpml:missionConfig>{mission}\
             </wpml:missionConfig>\n{folder}</Document>\n</kml>\n"
        )
    };
    let author = "<wpml:author>Pilotage</wpml:author>\n";
    let error = |cause: String| ExchangeError::File {
        file: WAYLINES.to_owned(),
        cause,
    };
    let mut zip = ZipSink::default();
    for (name, text) in [
        (TEMPLATE, document(author, &template)),
        (WAYLINES, document("", &waylines)),
    ] {
        zip.write(name, text.as_bytes()).map_err(error)?;
    }
    Ok((zip.finish().map_err(error)?, notes))
}

/// A property that is text.
fn text(properties: &BTreeMap<String, String>, key: &str) -> Option<String> {
    serde_json::from_str(properties.get(key)?).ok()
}

fn element(name: &str, value: f64) -> String {
    format!("<wpml:{name}>{value}</wpml:{name}>")
}

fn place(index: usize, position: &GroundPoint, frame: &LocalFrame) -> String {
    let (longitude, latitude) = globe::lon_lat(frame, position);
    format!(
        "<Point><coordinates>{},{}</coordinates></Point><wpml:index>{index}</wpml:index>",
        degrees(longitude),
        degrees(latitude)
    )
}

/// Speeds of the legs that lead away from the way-points, and the commonest of all, m/s.
fn speeds(route: &Route, notes: &mut Vec<String>) -> (Vec<f64>, f64) {
    let legs = route.way_points.iter().skip(1);
    let stated: Vec<f64> = legs.clone().filter_map(|w| w.speed).collect();
    let count = |speed: &f64| stated.iter().filter(|other| *other == speed).count();
    let common = stated
        .iter()
        .copied()
        .max_by_key(count)
        .unwrap_or(USUAL_SPEED);
    let mut speeds: Vec<f64> = legs.clone().map(|w| w.speed.unwrap_or(common)).collect();
    speeds.push(speeds.last().copied().unwrap_or(common));
    if stated.len() < legs.len() {
        notes.push(format!("legs without a speed are flown at {common} m/s"));
    }
    if stated.iter().any(|speed| *speed > FASTEST) {
        notes.push(format!(
            "some legs are faster than the {FASTEST} m/s that most of DJI's aircraft fly a mission at"
        ));
    }
    (speeds, common)
}

/// Action of the aircraft at the end, in the file's word; notes on steps that have no place in the file.
fn finish(route: &Route, frame: &LocalFrame, notes: &mut Vec<String>) -> &'static str {
    let mut left_out = Vec::new();
    let mut returns = route.returns;
    for step in steps_of(route, frame) {
        if let RouteStep::Kept(piece) = step {
            match MissionItem::of_json(piece.get()) {
                Ok(item) if item.command == RETURN_TO_LAUNCH => returns = true,
                Ok(item) => left_out.push(command_name(item.command)),
                Err(name) => left_out.push(name),
            }
        }
    }
    let last = route.way_points.len().saturating_sub(1);
    for (i, way_point) in route.way_points.iter().enumerate() {
        let name = match way_point.action {
            WayPointAction::Land if i < last => "landing before the end",
            WayPointAction::Loiter { .. } => "circles at a way-point",
            WayPointAction::Wait { seconds: None, .. } => "waiting without an end",
            _ => continue,
        };
        left_out.push(name.to_owned());
    }
    if !left_out.is_empty() {
        notes.push(format!(
            "DJI's file has no place for this, which is left out: {}",
            counted(&left_out)
        ));
    }
    if route.lands() && !returns {
        "autoLand"
    } else {
        "goHome"
    }
}

/// The configuration of a mission with what the route says of its end: whether it returns. All else is as it was.
fn with_finish(mission: String, route: &Route) -> String {
    let said = |word: &str| format!("<wpml:finishAction>{word}</wpml:finishAction>");
    let is_known = text(&route.properties, MISSION).is_some();
    if route.returns && !mission.contains(&said(GO_HOME)) {
        let before = ["autoLand", "noAction", "gotoFirstWaypoint"].map(said);
        let old = before.iter().find(|old| mission.contains(*old));
        return match old {
            Some(old) => mission.replace(old, &said(GO_HOME)),
            None => said(GO_HOME) + &mission,
        };
    }
    if !route.returns && is_known {
        let word = if route.lands() {
            "autoLand"
        } else {
            "noAction"
        };
        return mission.replace(&said(GO_HOME), &said(word));
    }
    mission
}

/// The configuration of a mission that comes from no file of DJI.
fn configuration(finish: &str, speed: f64) -> String {
    format!(
        "<wpml:flyToWaylineMode>safely</wpml:flyToWaylineMode>\
         <wpml:finishAction>{finish}</wpml:finishAction>\
         <wpml:exitOnRCLost>executeLostAction</wpml:exitOnRCLost>\
         <wpml:executeRCLostAction>goBack</wpml:executeRCLostAction>\
         <wpml:takeOffSecurityHeight>20</wpml:takeOffSecurityHeight>\
         <wpml:globalTransitionalSpeed>{speed}</wpml:globalTransitionalSpeed>\
         <wpml:droneInfo><wpml:droneEnumValue>77</wpml:droneEnumValue>\
         <wpml:droneSubEnumValue>0</wpml:droneSubEnumValue></wpml:droneInfo>\
         <wpml:payloadInfo><wpml:payloadEnumValue>66</wpml:payloadEnumValue>\
         <wpml:payloadSubEnumValue>0</wpml:payloadSubEnumValue>\
         <wpml:payloadPositionIndex>0</wpml:payloadPositionIndex></wpml:payloadInfo>"
    )
}

/// New numbers of the way-points by those that the file gave them.
fn numbers(route: &Route) -> BTreeMap<usize, usize> {
    let old = |w: &WayPoint| w.properties.get(INDEX)?.parse().ok();
    let way_points = route.way_points.iter().enumerate();
    way_points
        .filter_map(|(new, w)| Some((old(w)?, new)))
        .collect()
}

/// Groups of actions at way-point `own`, which name the way-points of their first and last action.
fn renumbered(text: &str, own: usize, numbers: &BTreeMap<usize, usize>) -> String {
    let mut text = text.to_owned();
    for name in ["actionGroupStartIndex", "actionGroupEndIndex"] {
        let (begin, end) = (format!("<wpml:{name}>"), format!("</wpml:{name}>"));
        let mut parts = text.split(&begin);
        let mut new = parts.next().unwrap_or("").to_owned();
        for part in parts {
            let (number, after) = part.split_once(&end).unwrap_or((part, ""));
            let number = number.trim().parse().ok();
            // The last way-point of a group may be gone.
            let number = number.and_then(|n: usize| numbers.get(&n)).unwrap_or(&own);
            let _ = write!(new, "{begin}{}{end}{after}", number.max(&own));
        }
        text = new;
    }
    text
}
