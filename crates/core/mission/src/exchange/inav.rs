//! Missions of INAV and Multiwii (`.mission`, XML), as commands of `MAVLink` that do the same.
//!
//! <https://github.com/iNavFlight/inav/wiki>: places in degrees, heights in metres above take-off or, where the third
//! parameter says so, above mean sea level.

use std::collections::BTreeMap;

use serde_json::Value;

use super::ExchangeError;
use super::found::GeodeticContent;
use super::item::{
    CHANGE_SPEED, JUMP, LAND, LOITER_TIME, LOITER_UNLIMITED, MissionItem, RETURN_TO_LAUNCH,
    WAY_POINT,
};
use super::item_route::{Home, MissionStep, route_of};
use super::xml::{NamedText, XmlElement};
use crate::mission::found::on_globe;

/// Frames of heights above mean sea level and above take-off.
const ABSOLUTE: u8 = 0;
const RELATIVE: u8 = 3;
const YAW: u16 = 115;
const REGION_OF_INTEREST: u16 = 201;
/// Flags of the last command of a mission, and of a command to where home is.
const LAST: f64 = 165.0;
const AT_HOME: f64 = 72.0;
/// Latitude and longitude of home, as planners of INAV call them.
const HOME: [&str; 2] = ["home-y", "home-x"];

/// Names of the commands, by their numbers from one on.
const ACTIONS: [&str; 8] = [
    "WAYPOINT",
    "POSHOLD_UNLIM",
    "POSHOLD_TIME",
    "RTH",
    "SET_POI",
    "JUMP",
    "SET_HEAD",
    "LAND",
];

/// Commands to fly to a place at a height.
const FLOWN_AT_HEIGHT: [&str; 3] = ["WAYPOINT", "POSHOLD_UNLIM", "POSHOLD_TIME"];

/// Whether a text is such a mission, or begins as one: XML, the lines of INAV's terminal, or JSON of `mwp`.
pub(super) fn is_inav(text: &str) -> bool {
    let head: String = text.chars().take(4096).collect();
    head.to_lowercase().contains("<missionitem")
        || head
            .lines()
            .any(|line| matches!(of_terminal(line), Some(Ok(_))))
        || is_json(&head)
}

/// Whether a text begins as JSON of `mwp`, and not as a plan or a mission of ours.
fn is_json(head: &str) -> bool {
    let has = |member: &str| head.contains(&format!("\"{member}\""));
    let is_other = ["fileType", "FeatureCollection", "groundStation", "items"];
    head.starts_with('{')
        && ["mission", "action", "lat", "lon"].into_iter().all(has)
        && !is_other.into_iter().any(has)
}

/// The command of a line of INAV's terminal: `wp 0 1 543533193 -45179273 3500 0 0 0 0`, which are the number, the command,
/// the place in degrees ten million times, centimetres, three parameters and the flag; `None` of any other line, and of
/// an entry that is not used.
fn of_terminal(line: &str) -> Option<Result<InavItem, String>> {
    let mut words = line.trim().strip_prefix("wp ")?.split_ascii_whitespace();
    let number: i64 = words.next()?.parse().ok()?;
    let rest: Vec<&str> = words.collect();
    if rest.len() == 1 && rest[0].starts_with(char::is_alphabetic) {
        // How many there are, as in `wp 3 valid`.
        return None;
    }
    let mut numbers = Vec::new();
    for word in rest {
        match word.parse::<i64>() {
            Ok(number) => numbers.push(number as f64),
            Err(_) => return Some(Err(format!("`{word}` is no whole number"))),
        }
    }
    let &[
        action,
        latitude,
        longitude,
        altitude,
        first,
        second,
        third,
        flag,
    ] = &numbers[..]
    else {
        return Some(Err(format!(
            "a command in INAV's terminal has 9 numbers, and this line has {}: it is cut short",
            numbers.len() + 1
        )));
    };
    if action == 0.0 {
        return None;
    }
    let known = (action as usize)
        .checked_sub(1)
        .and_then(|index| ACTIONS.get(index));
    let Some(action) = known else {
        return Some(Err(format!("command {action} of INAV is not known")));
    };
    // The terminal counts from zero, its files and programs from one.
    let first = if *action == "JUMP" {
        first + 1.0
    } else {
        first
    };
    Some(Ok(InavItem {
        number: (number + 1).to_string(),
        action: (*action).to_owned(),
        latitude: latitude / 1e7,
        longitude: longitude / 1e7,
        altitude: altitude * 0.01,
        parameters: [first, second, third],
        flag,
    }))
}

/// The missions of JSON as `mwp` writes it; an error names the command that has it.
fn of_json(text: &str) -> Option<Result<Vec<InavMission>, String>> {
    let root: Value = serde_json::from_str(text).ok()?;
    let item = |(index, item): (usize, &Value)| {
        let number = |name: &str| match item.get(name) {
            None | Some(Value::Null) => Ok(None),
            Some(Value::String(text)) => number_in(name, text),
            Some(value) => match value.as_f64() {
                None => Err(format!("`{name}` is no number")),
                number => Ok(number),
            },
        };
        let action = item.get("action").and_then(Value::as_str);
        let named = number("no").map(|no| no.unwrap_or(index as f64 + 1.0).to_string());
        let read = named.and_then(|no| {
            let action = action.ok_or("it has no `action`")?;
            InavItem::of_numbers(no, action, ["p1", "p2", "p3"], number)
        });
        read.map_err(|cause| format!("command {} of the mission: {cause}", index + 1))
    };
    let home = |of: &Value| {
        let meta = of.get("meta").or_else(|| of.get("mwp"))?;
        let [latitude, longitude] = HOME.map(|name| meta.get(name).and_then(Value::as_f64));
        stated_home(latitude?, longitude?)
    };
    let mission = |of: &Value| {
        let items = of.get("mission").or_else(|| of.get("missionitems"))?;
        let items: Result<_, String> = items.as_array()?.iter().enumerate().map(item).collect();
        let home = home(of).or_else(|| home(&root));
        Some(items.map(|items| InavMission { home, items }))
    };
    match root.get("missions").and_then(Value::as_array) {
        Some(missions) if !missions.is_empty() => missions.iter().map(mission).collect(),
        _ => Some(mission(&root)?.map(|only| vec![only])),
    }
}

/// The number that a text is, `None` of an empty one.
fn number_in(name: &str, text: &str) -> Result<Option<f64>, String> {
    if text.is_empty() {
        return Ok(None);
    }
    let number = text.replacen(',', ".", 1).parse::<f64>().ok();
    match number.filter(|number| number.is_finite()) {
        None => Err(format!("{name}: `{text}` is no number")),
        number => Ok(number),
    }
}

/// Home at a latitude and longitude, degrees, whose height no file states; 0, 0 is one that was never set.
fn stated_home(latitude: f64, longitude: f64) -> Option<Home> {
    let is_set = (latitude, longitude) != (0.0, 0.0) && on_globe(longitude, latitude);
    is_set.then_some([latitude, longitude, 0.0])
}

/// Reads the missions of a file, each as a route.
pub(super) fn read(file: &str, text: &str) -> Result<GeodeticContent, ExchangeError> {
    let mut found = GeodeticContent::default();
    for InavMission { home, items } in missions(file, text)? {
        // The terminal always writes it, other programs need not.
        let is_open = items.last().is_some_and(|item| item.flag != LAST);
        if is_open && text.lines().any(|line| of_terminal(line).is_some()) {
            found.notes.push(format!(
                "the last command does not say that it is the last ({LAST}): commands behind it may be missing"
            ));
        }
        let mut mission = Vec::new();
        for item in items {
            let is_last = item.flag == LAST;
            mission.push(item);
            if is_last {
                add(std::mem::take(&mut mission), home, &mut found);
            }
        }
        add(mission, home, &mut found);
    }
    let mut notes = vec!["this is a mission of INAV or Multiwii; it is written as a plan".into()];
    if found
        .routes
        .iter()
        .any(|r| r.properties.contains_key("home"))
    {
        notes.push("the file states no height of home: 0 m above sea level is written".into());
    }
    notes.append(&mut found.notes);
    found.notes = notes;
    Ok(found)
}

/// The missions of a text of any of the three forms.
fn missions(file: &str, text: &str) -> Result<Vec<InavMission>, ExchangeError> {
    if let Some(missions) = of_json(text) {
        return missions.map_err(|cause| ExchangeError::File {
            file: file.to_owned(),
            cause,
        });
    }
    if !text.trim_start().starts_with('<') {
        let mut items = Vec::new();
        for (index, line) in text.lines().enumerate() {
            let Some(item) = of_terminal(line) else {
                continue;
            };
            let item = item.and_then(InavItem::on_globe);
            items.push(item.map_err(|cause| ExchangeError::Place {
                file: file.to_owned(),
                line: index + 1,
                column: 1,
                cause,
            })?);
        }
        return Ok(vec![InavMission { home: None, items }]);
    }
    let source = NamedText { file, text };
    let root = source.root()?;
    let mut missions = vec![InavMission::default()];
    gather(&source, &root, &mut missions)?;
    Ok(missions)
}

/// Adds the commands within an element to the last mission; one that states home begins another.
fn gather(
    source: &NamedText,
    element: &XmlElement,
    missions: &mut Vec<InavMission>,
) -> Result<(), ExchangeError> {
    for child in &element.children {
        if child.name.eq_ignore_ascii_case("missionitem") {
            let item = InavItem::of(source, child)?;
            if let Some(mission) = missions.last_mut() {
                mission.items.push(item);
            }
            continue;
        }
        let number = |name: &str| attribute(child, name).parse::<f64>().ok();
        if let [Some(latitude), Some(longitude)] = HOME.map(number) {
            missions.push(InavMission {
                home: stated_home(latitude, longitude),
                items: Vec::new(),
            });
        }
        gather(source, child, missions)?;
    }
    Ok(())
}

/// The value of an attribute, its name in letters of either case; empty without it.
fn attribute<'a>(element: &'a XmlElement, name: &str) -> &'a str {
    let mut all = element.attributes.iter();
    let found = all.find(|(own, _)| own.eq_ignore_ascii_case(name));
    found.map_or("", |(_, value)| value.trim())
}

/// Mission of a file: its home, where the file states it, and its commands.
#[derive(Default)]
struct InavMission {
    home: Option<Home>,
    items: Vec<InavItem>,
}

/// A command as the file states it.
struct InavItem {
    number: String,
    action: String,
    latitude: f64,
    longitude: f64,
    altitude: f64,
    parameters: [f64; 3],
    flag: f64,
}

impl InavItem {
    fn of(source: &NamedText, element: &XmlElement) -> Result<Self, ExchangeError> {
        let value = |name: &str| attribute(element, name);
        let read = Self::of_numbers(
            value("no").to_owned(),
            value("action"),
            ["parameter1", "parameter2", "parameter3"],
            |name| number_in(name, value(name)),
        );
        read.map_err(|cause| source.error(element.begin, format!("missionitem: {cause}")))
    }

    /// The command whose numbers are found by their names; those of a place have to be there where it is flown to.
    fn of_numbers(
        number: String,
        action: &str,
        parameters: [&str; 3],
        found: impl Fn(&str) -> Result<Option<f64>, String>,
    ) -> Result<Self, String> {
        let action = action.to_uppercase();
        let any = |name: &str| found(name).map(|number| number.unwrap_or(0.0));
        let flag = any("flag")?;
        let needed = |name: &str, is_needed: bool| match found(name)? {
            None if is_needed => Err(format!("{action} without `{name}`")),
            number => Ok(number.unwrap_or(0.0)),
        };
        let is_flown = FLOWN_AT_HEIGHT.contains(&action.as_str());
        let is_placed = is_flown || matches!(action.as_str(), "LAND" | "SET_POI");
        let [first, second, third] = parameters;
        Self {
            latitude: needed("lat", is_placed && flag != AT_HOME)?,
            longitude: needed("lon", is_placed && flag != AT_HOME)?,
            altitude: needed("alt", is_flown)?,
            parameters: [any(first)?, any(second)?, any(third)?],
            number,
            flag,
            action,
        }
        .on_globe()
    }

    /// The command, unless its place is none.
    fn on_globe(self) -> Result<Self, String> {
        let (latitude, longitude) = (self.latitude, self.longitude);
        if on_globe(longitude, latitude) {
            Ok(self)
        } else {
            Err(format!("{latitude}, {longitude} is no place on the globe"))
        }
    }

    /// The command with these first four parameters, at its place.
    fn placed(&self, command: u16, first: [Option<f64>; 4]) -> MissionItem {
        let is_absolute = self.parameters[2] as i64 & 1 == 1;
        let [a, b, c, d] = first;
        MissionItem {
            command,
            frame: if is_absolute { ABSOLUTE } else { RELATIVE },
            parameters: [
                a,
                b,
                c,
                d,
                Some(self.latitude),
                Some(self.longitude),
                Some(self.altitude),
            ],
            is_continued: true,
        }
    }
}

/// A command without a place.
fn placeless(command: u16, first: [f64; 4]) -> MissionItem {
    let [a, b, c, d] = first.map(Some);
    MissionItem {
        command,
        frame: 2,
        parameters: [a, b, c, d, Some(0.0), Some(0.0), Some(0.0)],
        is_continued: true,
    }
}

/// Adds the route of a mission.
fn add(mission: Vec<InavItem>, home: Option<Home>, found: &mut GeodeticContent) {
    let mut steps = Vec::new();
    let mut speed = 0.0;
    let mut unknown = Vec::new();
    for mut item in mission {
        if item.flag == AT_HOME
            && let Some([latitude, longitude, _]) = home
        {
            (item.latitude, item.longitude) = (latitude, longitude);
        }
        let none = [Some(0.0), Some(0.0), Some(0.0), None];
        let [first, second, _] = item.parameters;
        // Centimetres a second over ground; 0 is the usual speed.
        let (command, own_speed) = match item.action.as_str() {
            "WAYPOINT" => (item.placed(WAY_POINT, none), Some(first / 100.0)),
            "POSHOLD_UNLIM" => (item.placed(LOITER_UNLIMITED, none), Some(second / 100.0)),
            "POSHOLD_TIME" => {
                let stay = [Some(first), Some(0.0), Some(0.0), None];
                (item.placed(LOITER_TIME, stay), Some(second / 100.0))
            }
            "LAND" => (item.placed(LAND, none), Some(first / 100.0)),
            "RTH" => (placeless(RETURN_TO_LAUNCH, [0.0; 4]), None),
            "JUMP" => (placeless(JUMP, [first, second, 0.0, 0.0]), None),
            "SET_HEAD" if first >= 0.0 => (placeless(YAW, [first, 0.0, 0.0, 0.0]), None),
            "SET_POI" => (item.placed(REGION_OF_INTEREST, none), None),
            _ => {
                unknown.push(item.action);
                continue;
            }
        };
        let mut push = |item: MissionItem, number: &str| {
            steps.push(MissionStep::Command {
                text: item.json(number.parse().unwrap_or(0)),
                altitude: None,
                members: BTreeMap::from([("doJumpId".to_owned(), number.to_owned())]),
                item,
            });
        };
        if let Some(own) = own_speed.filter(|own| *own != speed && *own >= 0.0) {
            let value = if own > 0.0 { own } else { -2.0 };
            push(placeless(CHANGE_SPEED, [1.0, value, -1.0, 0.0]), "0");
            speed = own;
        }
        push(command, &item.number);
    }
    if !unknown.is_empty() {
        found.notes.push(format!(
            "commands that are not known are left out: {}",
            unknown.join(", ")
        ));
    }
    if !steps.is_empty() {
        let (route, notes) = route_of(steps, home);
        found.notes.extend(notes);
        found.routes.push(route);
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Format, read_any, write_route};
    use crate::mission::WayPointAction;
    use pilotage_base::frames::AltitudeFrame;

    const MISSION: &str = r#"<?xml version="1.0" encoding="utf-8"?>
<mission>
  <version value="2.3-pre8"></version>
  <mwp cx="18.42" cy="-33.85" home-x="0" home-y="0" zoom="16"></mwp>
  <missionitem no="1" action="WAYPOINT" lat="-33.8501" lon="18.4201" alt="50" parameter1="1250" parameter2="0" parameter3="0" flag="0"></missionitem>
  <missionitem no="2" action="POSHOLD_TIME" lat="-33.8511" lon="18.4211" alt="60" parameter1="45" parameter2="0" parameter3="1" flag="0"></missionitem>
  <missionitem no="3" action="LAND" lat="-33.8521" lon="18.4221" alt="0" parameter1="0" parameter2="0" parameter3="0" flag="165"></missionitem>
</mission>"#;

    #[test]
    fn a_mission_of_inav_is_a_route_with_its_heights_speeds_and_stays() {
        for text in [
            MISSION.to_owned(),
            MISSION.replace("missionitem", "MISSIONITEM"),
        ] {
            let bytes = text.as_bytes();
            assert_eq!(Format::of("a.mission", bytes), Some(Format::Plan));
            let read = read_any("a.mission", bytes, None).unwrap();
            let way_points = &read.routes[0].way_points;
            let place = |i: usize| {
                let place = read.frame.geodetic_from_ground(&way_points[i].position);
                (place.latitude.to_degrees(), place.longitude.to_degrees())
            };
            assert_eq!(way_points.len(), 3, "{:?}", read.notes);
            assert!((place(1).0 + 33.8511).hypot(place(1).1 - 18.4211) < 1e-9);
            let altitudes: Vec<_> = way_points.iter().map(|w| w.altitude).collect();
            assert_eq!((altitudes[0].metres, altitudes[1].metres), (50.0, 60.0));
            assert_eq!(altitudes[0].frame, AltitudeFrame::AboveTakeOff);
            assert_eq!(altitudes[1].frame, AltitudeFrame::Amsl);
            assert_eq!(way_points[0].speed, Some(12.5));
            assert_eq!(way_points[1].speed, None);
            assert!(
                way_points[1].action.wait_seconds() == Some(45.0),
                "{:?}",
                way_points[1].action
            );
            assert_eq!(way_points[2].action, WayPointAction::Land);
        }
    }

    #[test]
    fn lines_of_its_terminal_and_json_of_mwp_are_the_same_mission() {
        let lines = "# wp load\n\n# wp\n# wp 3 valid\nwp 0 1 -338501000 184201000 5000 1250 0 0 0\n\
                     wp 1 3 -338511000 184211000 6000 45 0 1 0\nwp 2 8 -338521000 184221000 0 0 0 0 165\nwp 3 0 0 0 0 0 0 0 0\n";
        let json = r#"{"meta":{"zoom":14},"mission":[
            {"no":1,"action":"WAYPOINT","lat":-33.8501,"lon":18.4201,"alt":50,"p1":1250,"p2":0,"p3":0},
            {"no":2,"action":"POSHOLD_TIME","lat":-33.8511,"lon":18.4211,"alt":60,"p1":45,"p2":0,"p3":1},
            {"no":3,"action":"LAND","lat":-33.8521,"lon":18.4221,"alt":0,"p1":0,"p2":0,"p3":0,"flag":165}]}"#;
        let right = read_any("a.mission", MISSION.as_bytes(), None).unwrap();
        for (name, text) in [("a.txt", lines), ("a.json", json)] {
            let read = read_any(name, text.as_bytes(), None).unwrap();
            let of = |read: &super::super::Imported| {
                let places = read.routes[0].way_points.iter();
                places
                    .map(|w| (w.altitude, w.speed, w.action))
                    .collect::<Vec<_>>()
            };
            assert_eq!(of(&read), of(&right), "{name}");
            let off = read.routes[0].way_points[2]
                .position
                .distance(&right.routes[0].way_points[2].position);
            assert!(off < 1e-6, "{name}: {off}");
        }
    }

    #[test]
    fn commands_that_are_cut_short_or_lack_their_place_are_refused_by_their_line() {
        let cause = |name: &str, text: &str| {
            let read = read_any(name, text.as_bytes(), None);
            read.map(|_| ()).unwrap_err().to_string()
        };
        let first = "# wp\nwp 2 valid\nwp 0 1 -338501000 184201000 5000 0 0 0 0\n";
        for (last, told) in [
            (
                "wp 1 1 -338511000 184211000 60",
                "line 4, column 1: a command in INAV's terminal has 9 numbers, and this line has 5",
            ),
            (
                "wp 1",
                "line 4, column 1: a command in INAV's terminal has 9 numbers, and this line has 1",
            ),
            (
                "wp 1 1 -338511000 1842x1000 6000 0 0 0 165",
                "`1842x1000` is no whole number",
            ),
            ("wp 1 9 0 0 0 0 0 0 165", "command 9 of INAV is not known"),
        ] {
            let cause = cause("a.txt", &format!("{first}{last}\n"));
            assert!(cause.contains(told), "{last}: {cause}");
        }
        let whole = read_any("a.txt", first.as_bytes(), None).unwrap();
        assert!(
            whole
                .notes
                .iter()
                .any(|note| note.contains("may be missing")),
            "{:?}",
            whole.notes
        );
        let json = |second: &str| {
            format!(
                r#"{{"mission":[{{"no":1,"action":"WAYPOINT","lat":-33.8501,"lon":18.4201,"alt":50}},{second}]}}"#
            )
        };
        for (second, told) in [
            (
                r#"{"no":2,"action":"WAYPOINT","lon":18.4211,"alt":50}"#,
                "command 2 of the mission: WAYPOINT without `lat`",
            ),
            (
                r#"{"no":2,"action":"LAND","lat":-33.8,"lon":null,"alt":50}"#,
                "LAND without `lon`",
            ),
            (
                r#"{"no":2,"action":"POSHOLD_TIME","lat":-33.8,"lon":18.4}"#,
                "POSHOLD_TIME without `alt`",
            ),
            (
                r#"{"no":2,"action":"WAYPOINT","lat":[1],"lon":18.4,"alt":50}"#,
                "`lat` is no number",
            ),
            (
                r#"{"no":2,"lat":-33.8,"lon":18.4,"alt":50}"#,
                "it has no `action`",
            ),
        ] {
            let cause = cause("a.json", &json(second));
            assert!(cause.contains(told), "{second}: {cause}");
        }
        let xml = MISSION.replace(" lat=\"-33.8511\"", "");
        let cause = cause("a.mission", &xml);
        assert!(
            cause.contains("line 6") && cause.contains("without `lat`"),
            "{cause}"
        );
        // Numbers as texts are numbers, and home needs no place.
        for second in [
            r#"{"no":2,"action":"WAYPOINT","lat":"-33.8511","lon":"18.4211","alt":"60"}"#,
            r#"{"no":2,"action":"RTH"}"#,
        ] {
            assert!(
                read_any("a.json", json(second).as_bytes(), None).is_ok(),
                "{second}"
            );
        }
        let text =
            json(r#"{"no":2,"action":"WAYPOINT","lat":"-33.8511","lon":"18.4211","alt":"60"}"#);
        let read = read_any("a.json", text.as_bytes(), None).unwrap();
        let last = &read.routes[0].way_points[1];
        let place = read.frame.geodetic_from_ground(&last.position);
        assert!((place.latitude.to_degrees() + 33.8511).abs() < 1e-8);
        assert_eq!(last.altitude.metres, 60.0);
    }

    #[test]
    fn a_jump_leads_to_the_same_command_in_all_forms() {
        let xml = r#"<mission>
            <missionitem no="1" action="WAYPOINT" lat="-33.8501" lon="18.4201" alt="50" parameter1="0" parameter2="0" parameter3="0" flag="0"/>
            <missionitem no="2" action="WAYPOINT" lat="-33.8511" lon="18.4211" alt="50" parameter1="0" parameter2="0" parameter3="0" flag="0"/>
            <missionitem no="3" action="JUMP" lat="0" lon="0" alt="0" parameter1="1" parameter2="3" parameter3="0" flag="165"/></mission>"#;
        let lines = "wp 3 valid\nwp 0 1 -338501000 184201000 5000 0 0 0 0\n\
                     wp 1 1 -338511000 184211000 5000 0 0 0 0\nwp 2 6 0 0 0 0 3 0 165\n";
        let json = r#"{"mission":[{"no":1,"action":"WAYPOINT","lat":-33.8501,"lon":18.4201,"alt":50},
            {"no":2,"action":"WAYPOINT","lat":-33.8511,"lon":18.4211,"alt":50},
            {"no":3,"action":"JUMP","lat":0,"lon":0,"p1":1,"p2":3,"flag":165}]}"#;
        let written = |name: &str, text: &str| {
            let read = read_any(name, text.as_bytes(), None).unwrap();
            let written = write_route(Format::Waypoints, &read.routes[0], &read.frame).unwrap();
            String::from_utf8(written.bytes).unwrap()
        };
        let right = written("a.mission", xml);
        // Line 1 is the first way-point, behind home.
        let jump: Vec<&str> = right.lines().last().unwrap().split('\t').collect();
        assert_eq!(jump[3..6], ["177", "1", "3"], "{right}");
        assert_eq!(written("a.txt", lines), right);
        assert_eq!(written("a.json", json), right);
    }

    #[test]
    fn home_is_that_of_the_file_unless_it_was_never_set() {
        let of = |text: &str| read_any("a.mission", text.as_bytes(), None).unwrap();
        let plain = of(MISSION);
        assert!(!plain.routes[0].properties.contains_key("home"));
        let at_home = MISSION.replace(
            "home-x=\"0\" home-y=\"0\"",
            "home-x=\"18.5\" home-y=\"-33.9\"",
        );
        let json = r#"{"meta":{"home-x":18.5,"home-y":-33.9},"mission":[
            {"no":1,"action":"WAYPOINT","lat":-33.8501,"lon":18.4201,"alt":50},
            {"no":2,"action":"WAYPOINT","lat":0,"lon":0,"alt":50,"flag":72},
            {"no":3,"action":"LAND","lat":-33.8521,"lon":18.4221,"alt":0,"flag":165}]}"#;
        for text in [at_home.as_str(), json] {
            let read = of(text);
            assert_eq!(read.routes[0].properties["home"], "[-33.9,18.5,0.0]");
            assert!(
                read.notes
                    .iter()
                    .any(|note| note.contains("no height of home"))
            );
            let plan = write_route(Format::Plan, &read.routes[0], &read.frame).unwrap();
            let plan: serde_json::Value = serde_json::from_slice(&plan.bytes).unwrap();
            let home = &plan["mission"]["plannedHomePosition"];
            assert_eq!(
                (home[0].as_f64(), home[1].as_f64()),
                (Some(-33.9), Some(18.5))
            );
        }
        // A command to home flies there.
        let read = of(json);
        let place = read
            .frame
            .geodetic_from_ground(&read.routes[0].way_points[1].position);
        assert!((place.latitude.to_degrees() + 33.9).abs() < 1e-8);
        assert!((place.longitude.to_degrees() - 18.5).abs() < 1e-8);
    }

    #[test]
    fn each_mission_of_a_file_has_its_own_home() {
        let mission = |north: f64| {
            let inside = MISSION.split_once("</version>").unwrap().1;
            let inside = inside.trim_end().trim_end_matches("</mission>");
            inside.replace(
                "home-x=\"0\" home-y=\"0\"",
                &format!("home-x=\"18.5\" home-y=\"{north}\""),
            )
        };
        let text = format!("<mission>{}{}</mission>", mission(-33.9), mission(-33.8));
        let read = read_any("a.mission", text.as_bytes(), None).unwrap();
        let homes: Vec<&str> = read.routes.iter().map(|r| &*r.properties["home"]).collect();
        assert_eq!(homes, ["[-33.9,18.5,0.0]", "[-33.8,18.5,0.0]"]);
    }

    #[test]
    fn each_mission_of_a_file_is_a_route() {
        let item = MISSION.lines().find(|line| line.contains("LAND")).unwrap();
        let text = format!("<mission>{item}{item}</mission>");
        let read = read_any("a.mission", text.as_bytes(), None).unwrap();
        assert_eq!(read.routes.len(), 2);
    }
}
