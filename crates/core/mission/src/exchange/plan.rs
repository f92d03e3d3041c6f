//! `QGroundControl`'s plan: JSON with a mission, fences and rally points.
//!
//! <https://docs.qgroundcontrol.com/master/en/qgc-dev-guide/file_formats/plan.html>

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use serde_json::Value;
use serde_json::value::RawValue;

use super::complex;
use super::fence;
use super::found::GeodeticContent;
use super::item::MissionItem;
use super::item_route::{Home, MissionStep, SAME_ALTITUDE, route_of};
use super::plan_firmware::{self, MISSION, PlanFirmware};
use super::route_items::{RouteStep, home_of, members, steps_of_plan};
use super::{ExchangeError, Places, plan_terrain, rally};
use crate::mission::found::on_globe;
use crate::mission::text::{ObjectMembers, Text};
use crate::mission::way_point_file::kept;
use crate::mission::{MissionError, Route, WayPoint, degrees};
use pilotage_base::frames::{Altitude, AltitudeFrame, LocalFrame};

/// Prefix of a route's properties that are members of the plan.
const PLAN: &str = "plan:";

/// Reads a plan as one route.
pub(super) fn read(file: &str, content: &str) -> Result<GeodeticContent, ExchangeError> {
    read_text(file, &Text(content)).map_err(|e| ExchangeError::of_json(file, e))
}

fn read_text(file: &str, text: &Text) -> Result<GeodeticContent, MissionError> {
    let mut plan = text.members(text.0)?;
    let kind: Option<String> = at("fileType", text.take(&mut plan, "fileType"))?;
    if kind.as_deref() != Some("Plan") {
        return Err(text.error(text.0, "fileType: a plan says \"Plan\" here"));
    }
    expect_version(text, &plan, "version", 1)?;
    plan.remove("version");
    let Some(mission) = plan.remove("mission") else {
        return Err(text.error(text.0, "mission: the plan has none"));
    };
    let mut mission = text.members(mission.get())?;
    expect_version(text, &mission, "mission.version", 2)?;
    mission.remove("version");
    let Some(items) = mission.remove("items") else {
        return Err(text.error(text.0, "mission.items: there is no list of commands"));
    };
    let home_piece = mission.get("plannedHomePosition").copied();
    let home: Option<Vec<Option<f64>>> = text.take(&mut mission, "plannedHomePosition")?;
    if let Some(([Some(latitude), Some(longitude), ..], piece)) = home.as_deref().zip(home_piece)
        && !on_globe(*longitude, *latitude)
    {
        let fault = format!(
            "mission.plannedHomePosition: {latitude}, {longitude} is no place on the globe"
        );
        return Err(text.error(piece.get(), fault));
    }
    let home = home.and_then(|h| match h[..] {
        // Where home was never set, QGroundControl writes zeros.
        [Some(latitude), Some(longitude), altitude, ..] if (latitude, longitude) != (0.0, 0.0) => {
            Some([latitude, longitude, altitude.unwrap_or(0.0)])
        }
        _ => None,
    });
    let mut steps = Vec::new();
    for (i, item) in text.elements(items.get())?.into_iter().enumerate() {
        steps.push(step(text, i, item)?);
    }
    let (mut route, mut notes) = route_of(steps, home);
    let stem = file.rsplit(['/', '\\']).next().unwrap_or(file);
    route.name = Some(
        stem.rsplit_once('.')
            .map_or(stem, |(stem, _)| stem)
            .to_owned(),
    );
    let rally = plan.get("rallyPoints");
    let (rally, broken) = rally.map_or_else(Default::default, |piece| rally::of_plan(piece.get()));
    if broken > 0 {
        notes.push(format!(
            "{broken} × rally point that is no place is kept, and not shown"
        ));
    }
    let fences = plan
        .get("geoFence")
        .map(|piece| fence::of_plan(piece.get()));
    let fences = fences.unwrap_or_default();
    notes.extend(fences.notes);
    for (prefix, members) in [(PLAN, plan), (MISSION, mission)] {
        for (name, value) in kept(members) {
            route.properties.insert(format!("{prefix}{name}"), value);
        }
    }
    Ok(GeodeticContent {
        routes: vec![route],
        no_fly: fences.no_fly,
        rally,
        notes,
        ..GeodeticContent::default()
    })
}

/// Puts the path of a member before what is wrong with it.
fn at<T>(path: &str, result: Result<T, MissionError>) -> Result<T, MissionError> {
    result.map_err(|error| match error {
        MissionError::Json {
            line,
            column,
            cause,
        } => MissionError::Json {
            line,
            column,
            cause: format!("{path}: {cause}"),
        },
        other => other,
    })
}

fn expect_version(
    text: &Text,
    members: &ObjectMembers,
    path: &str,
    version: u32,
) -> Result<(), MissionError> {
    match members.get("version") {
        Some(piece) if piece.get() == version.to_string() => Ok(()),
        Some(piece) => Err(text.error(
            piece.get(),
            format!("{path}: {} is not known, only {version} is", piece.get()),
        )),
        None => Err(text.error(text.0, format!("{path}: the version is missing"))),
    }
}

fn step<'a>(text: &Text<'a>, i: usize, piece: &'a RawValue) -> Result<MissionStep, MissionError> {
    let path = |name: &str| format!("mission.items[{i}].{name}");
    let mut members = at(&format!("mission.items[{i}]"), text.members(piece.get()))?;
    let kind: Option<String> = at(&path("type"), text.take(&mut members, "type"))?;
    if kind.as_deref() != Some("SimpleItem") {
        let name: Option<String> = text.take(&mut members, "complexItemType").ok().flatten();
        let name = name
            .or(kind)
            .unwrap_or_else(|| "an item without type".to_owned());
        return Ok(several(name, piece.get()));
    }
    let missing = |name: &str| text.error(piece.get(), format!("{}: it is missing", path(name)));
    let command: Option<u16> = at(&path("command"), text.take(&mut members, "command"))?;
    let frame: Option<u8> = at(&path("frame"), text.take(&mut members, "frame"))?;
    let params_place = members.get("params").map_or(piece.get(), |p| p.get());
    let params: Option<Vec<Option<f64>>> = at(&path("params"), text.take(&mut members, "params"))?;
    let mut params = params.ok_or_else(|| missing("params"))?;
    // Older plans state the place apart.
    let place: Option<Vec<Option<f64>>> =
        at(&path("coordinate"), text.take(&mut members, "coordinate"))?;
    params.extend(place.into_iter().flatten());
    let count = params.len();
    let parameters = <[Option<f64>; 7]>::try_from(params).map_err(|_| {
        text.error(
            params_place,
            format!("{}: there are {count} numbers, not 7", path("params")),
        )
    })?;
    let is_continued: Option<bool> = at(
        &path("autoContinue"),
        text.take(&mut members, "autoContinue"),
    )?;
    let item = MissionItem {
        command: command.ok_or_else(|| missing("command"))?,
        frame: frame.ok_or_else(|| missing("frame"))?,
        parameters,
        is_continued: is_continued.unwrap_or(true),
    };
    if let Some((parameter, fault)) = item.place_fault() {
        let fault = format!("{}[{parameter}]: {fault}", path("params"));
        return Err(text.error(params_place, fault));
    }
    let mode: Option<f64> = at(
        &path("AltitudeMode"),
        text.take(&mut members, "AltitudeMode"),
    )?;
    let metres: Option<f64> = at(&path("Altitude"), text.take(&mut members, "Altitude"))?;
    members.remove(plan_terrain::COMPUTED);
    let frame = mode.and_then(|mode| match mode as i64 {
        1 => Some(AltitudeFrame::AboveTakeOff),
        2 => Some(AltitudeFrame::Amsl),
        3 | 4 => Some(AltitudeFrame::AboveGround),
        _ => None,
    });
    let altitude = frame.zip(metres).map(|(frame, m)| Altitude::new(m, frame));
    let mut members = kept(members);
    if let Some(computed) = plan_terrain::kept(&item, mode, altitude.as_ref()) {
        members.insert(plan_terrain::COMPUTED.to_owned(), computed);
    }
    Ok(MissionStep::Command {
        item,
        altitude,
        members,
        text: piece.get().to_owned(),
    })
}

/// An item that is no command: with those that it stands for, if they are stored and lead to a place.
fn several(name: String, text: &str) -> MissionStep {
    let commands = complex::commands(text);
    let read = |command: &String| {
        let text = Text(command);
        let piece = serde_json::from_str::<&RawValue>(command).ok()?;
        match step(&text, 0, piece).ok()? {
            MissionStep::Command {
                item,
                altitude,
                members,
                text,
            } => Some(MissionStep::Command {
                item,
                altitude,
                members,
                text,
            }),
            _ => None,
        }
    };
    // What cannot be read is kept as it stands.
    let steps: Option<Vec<MissionStep>> = commands.iter().map(read).collect();
    let leads = |step: &MissionStep| matches!(step, MissionStep::Command { item, .. } if item.action().is_some());
    match steps.filter(|steps| steps.iter().any(leads)) {
        Some(steps) => MissionStep::Complex(name, text.to_owned(), steps),
        None => MissionStep::Other(name, text.to_owned()),
    }
}

/// The route as a plan, and notes on what was assumed.
pub(super) fn write(
    route: &Route,
    places: &Places<'_>,
    frame: &LocalFrame,
) -> (String, Vec<String>) {
    let mut notes = Vec::new();
    let own = |prefix: &'static str| {
        route
            .properties
            .iter()
            .filter_map(move |(name, value)| Some((name.strip_prefix(prefix)?, value.clone())))
            .collect::<BTreeMap<&str, String>>()
    };
    let mut mission = own(MISSION);
    let steps = steps_of_plan(route, frame);
    let firmware = PlanFirmware::of(mission.get(plan_firmware::MEMBER), &steps, route, frame);
    notes.extend(firmware.notes);
    mission.insert(plan_firmware::MEMBER, firmware.number);
    let home = home_of(route, frame);
    if let Some(home) = home {
        if !route.properties.contains_key("home") {
            notes.push("the first way-point is written as home, at a height of 0 m".to_owned());
        }
        mission.insert("plannedHomePosition", position(home));
    }
    let defaults = [
        ("cruiseSpeed", "15"),
        ("hoverSpeed", "5"),
        ("plannedHomePosition", "[0, 0, 0]"),
        ("vehicleType", "1"),
    ];
    for (name, value) in defaults {
        mission.entry(name).or_insert_with(|| value.to_owned());
    }
    mission.insert(
        "globalPlanAltitudeMode",
        plan_mode(route, frame, firmware.is_px4).to_string(),
    );
    mission.insert("items", items(route, steps, frame, firmware.is_px4));
    mission.insert("version", "2".to_owned());
    let mut plan = own(PLAN);
    let defaults = [
        (
            "geoFence",
            "{ \"circles\": [], \"polygons\": [], \"version\": 2 }",
        ),
        ("groundStation", "\"Pilotage\""),
        ("rallyPoints", "{ \"points\": [], \"version\": 2 }"),
    ];
    for (name, value) in defaults {
        plan.entry(name).or_insert_with(|| value.to_owned());
    }
    if let Some(fences) = plan.get_mut("geoFence") {
        let (text, note) = fence::with_areas(fences, places.no_fly, frame);
        *fences = text;
        notes.extend(note);
    }
    if let (Some(points), Some(kept)) = (places.rally, plan.get_mut("rallyPoints")) {
        let height = route.stated_home().map(|[.., height]| height);
        let (text, note) = rally::in_plan(kept, points, height, frame);
        *kept = text;
        notes.extend(note);
    }
    plan.insert("fileType", "\"Plan\"".to_owned());
    plan.insert("version", "1".to_owned());
    plan.insert("mission", object(&mission, "    "));
    (object(&plan, "") + "\n", notes)
}

fn object(members: &BTreeMap<&str, String>, indent: &str) -> String {
    let lines: Vec<String> = members
        .iter()
        .map(|(name, value)| format!("{indent}    {}: {value}", Value::from(*name)))
        .collect();
    format!("{{\n{}\n{indent}}}", lines.join(",\n"))
}

fn position([latitude, longitude, altitude]: Home) -> String {
    format!(
        "[{}, {}, {}]",
        degrees(latitude),
        degrees(longitude),
        Value::from(altitude)
    )
}

/// The mode of all way-points, or 0 where they differ.
fn plan_mode(route: &Route, frame: &LocalFrame, is_px4: bool) -> u8 {
    let modes: BTreeSet<u8> = route
        .way_points
        .iter()
        .map(|w| plan_terrain::height(w, frame, is_px4).mode)
        .collect();
    match modes.len() {
        0 => 1,
        1 => modes.into_iter().sum(),
        _ => 0,
    }
}

fn items(route: &Route, steps: Vec<RouteStep<'_>>, frame: &LocalFrame, is_px4: bool) -> String {
    // Where commands jump to others by number, those with a number keep it.
    let own_ids: Vec<Option<usize>> = steps.iter().map(RouteStep::jump_id).collect();
    let is_numbered_anew = !route
        .way_points
        .iter()
        .any(|w| members(w).any(|(name, _)| name == "doJumpId"));
    let mut next = if is_numbered_anew {
        1
    } else {
        own_ids.iter().flatten().max().map_or(1, |id| id + 1)
    };
    let mut lines = Vec::new();
    for (step, own) in steps.into_iter().zip(own_ids) {
        let id = own.filter(|_| !is_numbered_anew).unwrap_or_else(|| {
            next += 1;
            next - 1
        });
        lines.push(match step {
            RouteStep::Kept(piece) => with_jump_id(piece.get(), id),
            RouteStep::Speed(item, _) | RouteStep::Return(item) => item.json(id),
            RouteStep::WayPoint(mut item, way_point) => {
                let height = plan_terrain::height(way_point, frame, is_px4);
                height.state(&mut item);
                let keeps_altitude = keeps_altitude(route, way_point);
                if keeps_altitude {
                    item.parameters[6] = None;
                }
                let mut text = item.json(id);
                text.truncate(text.len() - " }".len());
                // Writing into a string cannot fail.
                let _ = write!(
                    text,
                    ", \"AMSLAltAboveTerrain\": {}, \"Altitude\": {}, \"AltitudeMode\": {}",
                    Value::from(height.above_sea),
                    Value::from((!keeps_altitude).then_some(way_point.altitude.metres)),
                    height.mode
                );
                let own = ["doJumpId", plan_terrain::COMPUTED];
                for (name, value) in members(way_point).filter(|(name, _)| !own.contains(name)) {
                    let _ = write!(text, ", {}: {value}", Value::from(name));
                }
                text + " }"
            }
        });
    }
    if lines.is_empty() {
        return "[]".to_owned();
    }
    let indent = "\n            ";
    format!("[{indent}{}\n        ]", lines.join(&format!(",{indent}")))
}

/// Whether a way-point stated no altitude in its file, and has that of the way-point before still.
fn keeps_altitude(route: &Route, way_point: &WayPoint) -> bool {
    let is_it = |pair: &&[WayPoint]| std::ptr::eq(&raw const pair[1], way_point);
    way_point.properties.contains_key(SAME_ALTITUDE)
        && (route.way_points.windows(2).find(is_it))
            .is_some_and(|pair| pair[0].altitude == pair[1].altitude)
}

/// A kept command with its number replaced; what has none stays as it is.
fn with_jump_id(text: &str, id: usize) -> String {
    let members: Option<ObjectMembers> = serde_json::from_str(text).ok();
    let Some(old) = members.as_ref().and_then(|m| m.get("doJumpId")) else {
        return text.to_owned();
    };
    // The piece is borrowed from the text.
    let begin = (old.get().as_ptr() as usize).wrapping_sub(text.as_ptr() as usize);
    let (Some(before), Some(after)) = (text.get(..begin), text.get(begin + old.get().len()..))
    else {
        return text.to_owned();
    };
    format!("{before}{id}{after}")
}
