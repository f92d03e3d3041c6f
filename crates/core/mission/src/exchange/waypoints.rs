//! `QGC WPL 110`: a line of twelve fields for every command.
//!
//! <https://mavlink.io/en/file_formats/>. Line 0 is home where it is an absolute place, as Mission Planner,
//! `MAVProxy` and `QGroundControl` have it; `QGC WPL 120` is the same.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::fence::{self, is_fence};
use super::file_look::{Claim, FileForm, FileLook};
use super::format_info::{FormatInfo, HeldBeside, HeldTogether};
use super::format_work::{FormatWork, Read};
use super::found::GeodeticContent;
use super::item::{JUMP, MissionItem, WAY_POINT, counted, may_leave_heading};
use super::item_route::{Home, MissionStep, WPL, route_of};
use super::rally::{self, RALLY_POINT};
use super::route_items::{RouteStep, home_of, steps_of};
use super::written::WrittenFile;
use super::{ExchangeError, Places, plan_firmware};
use crate::mission::found::FoundRally;
use crate::mission::{Route, degrees};
use pilotage_base::frames::{Geodetic, LocalFrame};

/// The format.
pub(super) const INFO: FormatInfo = FormatInfo {
    name: "QGC WPL 110",
    as_words: "way-points (QGC WPL)",
    extensions: &["waypoints", "wpl", "txt"],
    anybodys: &["txt"],
    maker: None,
    together: HeldTogether::Mission,
    holds_tracks: false,
    beside: HeldBeside::RallyAlone,
};

/// Text that begins so, and any other of that name that is no table.
fn claims(look: &FileLook<'_>) -> Claim {
    match look.form {
        FileForm::Zip => Claim::None,
        _ if look.head.starts_with(HEADER) => Claim::Special,
        _ if look.is_table() => Claim::None,
        _ => look.named_text(&INFO),
    }
}

/// Its reader and writers.
pub(super) const WORK: FormatWork = FormatWork {
    claims,
    read: Read::Text(read),
    write: |places, frame| {
        let text = match places.routes.first() {
            Some(route) => write(route, places, frame),
            None => write_rally(places, frame),
        };
        Ok(WrittenFile::of_text(text))
    },
    track: None,
};

const HEADER: &str = "QGC WPL";
const VERSION: &str = "110";
/// Versions that are read; they differ in nothing but their number.
const VERSIONS: [&str; 2] = [VERSION, "120"];

/// A line of the file.
struct WaypointLine {
    sequence: usize,
    is_current: bool,
    item: MissionItem,
}

/// Contents of a file beside its commands.
#[derive(Serialize, Deserialize)]
struct WaypointFile {
    version: String,
    /// Line 0, if it is home.
    home: Option<LineAsRead>,
    /// The line that is marked as current.
    current: Option<usize>,
    /// Its command, by which it is found again in a route that was edited.
    #[serde(default)]
    current_command: Option<LineAsRead>,
}

/// Line as it was read, of home and of the current command: command, frame, parameters and continuation.
#[derive(Serialize, Deserialize)]
struct LineAsRead(u16, u8, [Option<f64>; 7], bool);

/// Reads the lines as one route.
pub(super) fn read(file: &str, content: &str) -> Result<GeodeticContent, ExchangeError> {
    let mut lines = Vec::new();
    let mut version = VERSION;
    let has_decimal_commas = content.split_whitespace().any(is_decimal_comma);
    for (i, text) in content.lines().enumerate() {
        let place = |column: usize, cause: String| ExchangeError::Place {
            file: file.to_owned(),
            line: i + 1,
            column,
            cause,
        };
        if i == 0 {
            version = version_of(text).map_err(|cause| place(1, cause))?;
        } else if !text.trim().is_empty() && !text.starts_with('#') {
            lines.push(
                line(text, has_decimal_commas).map_err(|(column, cause)| place(column, cause))?,
            );
        }
    }
    // Lines whose numbers do not rise are counted, as autopilots count them.
    if lines.windows(2).any(|w| w[0].sequence >= w[1].sequence) {
        for (i, line) in lines.iter_mut().enumerate() {
            line.sequence = i;
        }
    }
    let mut notes = Vec::new();
    let home_line = home(&lines);
    let own = WaypointFile {
        version: version.to_owned(),
        current: lines.iter().find(|l| l.is_current).map(|l| l.sequence),
        current_command: lines
            .iter()
            .find(|l| l.is_current)
            .map(|l| line_as_read(&l.item)),
        home: home_line.map(line_as_read),
    };
    let has_home_line = own.home.is_some();
    let home = home_line.and_then(stated_place);
    let is_line_0_flown = lines.len() > 1
        && !has_home_line
        && lines
            .first()
            .is_some_and(|l| l.sequence == 0 && !is_fence(l.item.command));
    match (has_home_line, home) {
        (true, Some(_)) => notes.push("line 0 is home, and no way-point".to_owned()),
        (true, None) => notes.push("line 0 says that home was not set: the file has none".to_owned()),
        (false, _) if is_line_0_flown => notes.push(
            "line 0 is no absolute place, and is taken for a command: the file has no home; Mission \
             Planner would take it for home"
                .to_owned(),
        ),
        (false, _) => {}
    }
    let items: Vec<&MissionItem> = lines.iter().map(|l| &l.item).collect();
    let fences = fence::of_items(&items);
    notes.extend(fences.notes);
    let rally: Vec<FoundRally> = items
        .iter()
        .filter_map(|item| rally::of_item(item))
        .collect();
    if !rally.is_empty() && rally.len() + usize::from(has_home_line) == lines.len() {
        return Ok(GeodeticContent {
            rally,
            notes,
            ..GeodeticContent::default()
        });
    }
    let steps = lines
        .into_iter()
        .skip(usize::from(has_home_line))
        .map(|line| MissionStep::Command {
            text: line.item.json(line.sequence),
            altitude: None,
            members: BTreeMap::from([("doJumpId".to_owned(), line.sequence.to_string())]),
            item: line.item,
        })
        .collect();
    let (mut route, more) = route_of(steps, home);
    if route.way_points.is_empty() && has_home_line {
        notes.push("the file has no way-point beside home".to_owned());
    }
    let stem = file.rsplit(['/', '\\']).next().unwrap_or(file);
    route.name = Some(
        stem.rsplit_once('.')
            .map_or(stem, |(stem, _)| stem)
            .to_owned(),
    );
    // Numbers and texts always have a JSON form.
    if let Ok(own) = serde_json::to_string(&own) {
        route.properties.insert(WPL.to_owned(), own);
    }
    notes.extend(more);
    let no_way_point = route.way_points.is_empty();
    Ok(GeodeticContent {
        routes: vec![route],
        no_fly: fences.no_fly,
        rally,
        notes,
        origin: home
            .filter(|_| no_way_point)
            .map(|[latitude, longitude, _]| Geodetic::from_degrees(latitude, longitude, 0.0)),
        ..GeodeticContent::default()
    })
}

/// The version that the first line states.
fn version_of(line: &str) -> Result<&'static str, String> {
    let stated = line.trim_start_matches('\u{feff}').trim();
    let stated = stated.strip_prefix(HEADER).unwrap_or("").trim();
    let known = VERSIONS.into_iter().find(|version| *version == stated);
    known.ok_or_else(|| match stated {
        "100" => format!(
            "this is version 100 of 2010, whose columns are others: open it in Mission Planner and save it, or write \
             `{HEADER} {VERSION}`"
        ),
        _ if !line.contains("QGC") => format!(
            "it is no list of way-points (the first line has to be `{HEADER} {VERSION}`), and no table with names over columns \
             of latitude and longitude"
        ),
        _ => format!("the first line has to be `{HEADER} {VERSION}`"),
    })
}

/// Whether three digits behind the comma of a number may be thousands.
fn may_be_thousands(field: &str) -> bool {
    let digits = field.trim_start_matches(['-', '+']);
    digits.split_once(',').is_some_and(|(whole, rest)| {
        (1..=3).contains(&whole.len()) && !whole.starts_with('0') && rest.len() == 3
    })
}

/// Whether a field is a number whose comma can be nothing but that of decimals.
fn is_decimal_comma(field: &str) -> bool {
    field.contains(',')
        && !may_be_thousands(field)
        && field.replacen(',', ".", 1).parse::<f64>().is_ok()
}

/// A line, or the column of what is wrong with it and what that is.
fn line(text: &str, has_decimal_commas: bool) -> Result<WaypointLine, (usize, String)> {
    let fields: Vec<&str> = text.split_whitespace().collect();
    if fields.len() != 12 {
        return Err((1, format!("there are {} fields, not 12", fields.len())));
    }
    let column = |i: usize| fields[i].as_ptr() as usize - text.as_ptr() as usize + 1;
    let number = |i: usize| -> Result<f64, (usize, String)> {
        if may_be_thousands(fields[i]) && !has_decimal_commas {
            let cause = format!(
                "`{}` may be thousands or decimals: write it without a comma",
                fields[i]
            );
            return Err((column(i), cause));
        }
        // Some programs write numbers as their country does.
        fields[i]
            .parse()
            .or_else(|_| fields[i].replacen(',', ".", 1).parse())
            .map_err(|_| (column(i), format!("`{}` is no number", fields[i])))
    };
    let whole = |i: usize, most: f64| -> Result<f64, (usize, String)> {
        let value = number(i)?;
        if value.fract() == 0.0 && (0.0..=most).contains(&value) {
            return Ok(value);
        }
        Err((
            column(i),
            format!("`{}` is no whole number from 0 to {most}", fields[i]),
        ))
    };
    let mut parameters = [None; 7];
    for (i, parameter) in parameters.iter_mut().enumerate() {
        *parameter = Some(number(4 + i)?).filter(|v| v.is_finite());
    }
    let command = whole(3, 65535.0)? as u16;
    // The file has no word for a heading that is left to the aircraft; people write 0. Of all other commands a 0 is one, and
    // ArduPilot refuses them without a number there.
    if may_leave_heading(command) {
        parameters[3] = parameters[3].filter(|heading| *heading != 0.0);
    }
    let item = MissionItem {
        frame: whole(2, 255.0)? as u8,
        command,
        parameters,
        is_continued: whole(11, 1.0)? == 1.0,
    };
    if let Some((parameter, fault)) = item.place_fault() {
        return Err((column(4 + parameter), fault));
    }
    Ok(WaypointLine {
        sequence: whole(0, 65535.0)? as usize,
        is_current: whole(1, 1.0)? == 1.0,
        item,
    })
}

/// The first line, if it is home: an absolute place, or one at no height above take-off, where
/// nobody flies, whatever its current flag.
fn home(lines: &[WaypointLine]) -> Option<&MissionItem> {
    let first = lines.first().filter(|first| first.sequence == 0)?;
    let item = &first.item;
    // Frames 0 and 5 (with whole numbers) count from mean sea level.
    let is_absolute = [0, 5].contains(&item.frame) || item.parameters[6].unwrap_or(0.0) == 0.0;
    (is_absolute && [0, WAY_POINT].contains(&item.command)).then_some(item)
}

/// Latitude, longitude and height of a line; `None` for the zeros of a home that was never set.
fn stated_place(item: &MissionItem) -> Option<Home> {
    let [.., latitude, longitude, altitude] = item.parameters;
    let (latitude, longitude, altitude) = (latitude?, longitude?, altitude.unwrap_or(0.0));
    ((latitude, longitude) != (0.0, 0.0)).then_some([latitude, longitude, altitude])
}

/// Line 0 as it was read, at the home that the route has now; `None` if the file had none, and the
/// first way-point for a route that comes from no such file.
fn home_item(route: &Route, own: Option<&WaypointFile>, frame: &LocalFrame) -> Option<MissionItem> {
    let mut item = match own {
        Some(WaypointFile {
            home: Some(LineAsRead(command, item_frame, parameters, is_continued)),
            ..
        }) => MissionItem {
            command: *command,
            frame: *item_frame,
            parameters: *parameters,
            is_continued: *is_continued,
        },
        Some(_) => return None,
        None => MissionItem {
            command: WAY_POINT,
            frame: 0,
            parameters: [Some(0.0); 7],
            is_continued: true,
        },
    };
    let home = match own {
        Some(_) => route.stated_home(),
        None => home_of(route, frame),
    };
    for (parameter, value) in item.parameters[4..]
        .iter_mut()
        .zip(home.into_iter().flatten())
    {
        *parameter = Some(value);
    }
    Some(item)
}

/// The route as lines, and notes on what they cannot hold.
pub(super) fn write(
    route: &Route,
    places: &Places<'_>,
    frame: &LocalFrame,
) -> (String, Vec<String>) {
    let own: Option<WaypointFile> = route
        .properties
        .get(WPL)
        .and_then(|text| serde_json::from_str(text).ok());
    let mut notes = Vec::new();
    let mut left_out = Vec::new();
    let mut items: Vec<(MissionItem, Option<usize>)> = Vec::new();
    if let Some(home) = home_item(route, own.as_ref(), frame) {
        if own.is_none() {
            notes.push("home is written as the first line, as Mission Planner reads it".to_owned());
        }
        items.push((home, Some(0)));
    } else if own.is_some() && !route.way_points.is_empty() {
        notes.push("the file has no line for home, as it had none when it was read".to_owned());
    }
    for step in steps_of(route, frame) {
        let id = step.jump_id();
        match step {
            RouteStep::WayPoint(item, _) | RouteStep::Speed(item, _) | RouteStep::Return(item) => {
                items.push((item, id));
            }
            RouteStep::Kept(piece) => match MissionItem::of_json(piece.get()) {
                // A rally point that the mission has no more.
                Ok(item)
                    if item.command == RALLY_POINT
                        && (places.rally)
                            .is_some_and(|points| !rally::is_among(&item, points, frame)) => {}
                Ok(item) => items.push((item, id)),
                Err(name) => left_out.push(name),
            },
        }
    }
    let lost = aim_jumps(&mut items);
    let written: Vec<&MissionItem> = items.iter().map(|(item, _)| item).collect();
    notes.extend(plan_firmware::refused_note(route, written.iter().copied()));
    let fences = fence::of_items(&written).no_fly;
    notes.extend(fence::left_out(&fences, places.no_fly, frame));
    let known = written.iter().filter(|item| item.command == RALLY_POINT);
    let more = places
        .rally
        .map_or(0, <[_]>::len)
        .saturating_sub(known.count());
    if more > 0 {
        notes.push(format!(
            "{more} × rally point is left out: autopilots take them from a file of their own"
        ));
    }
    let current = own.as_ref().map_or(Some(0), |own| {
        // Commands have numbers only where something jumps to them; else the current one is known by what it says.
        let place = |id| items.iter().position(|item| item.1 == Some(id));
        own.current.and_then(|id| {
            let is_it = |item: &MissionItem| {
                let own = own.current_command.as_ref();
                own.is_some_and(|own| is_same(own, item))
            };
            let alike = (0..items.len()).filter(|at| is_it(&items[*at].0));
            place(id).or_else(|| alike.min_by_key(|at| at.abs_diff(id)))
        })
    });
    let version = own.as_ref().map_or(VERSION, |own| &own.version);
    let mut text = format!("{HEADER} {version}\n");
    for (sequence, (item, _)) in items.iter().enumerate() {
        text.push_str(&line_of(item, sequence, current == Some(sequence)));
    }
    if lost > 0 {
        notes.push(format!(
            "{lost} of the jumps lead to commands that are gone: their numbers stand as they were"
        ));
    }
    if !left_out.is_empty() {
        notes.push(format!(
            "WPL has no line for this, which is left out: {}",
            counted(&left_out)
        ));
    }
    if route.properties.contains_key("plan:geoFence") {
        notes.push("fences of the plan are left out: WPL has none".to_owned());
    }
    (text, notes)
}

fn line_as_read(item: &MissionItem) -> LineAsRead {
    LineAsRead(item.command, item.frame, item.parameters, item.is_continued)
}

/// Whether a line is the same command at the same place, as finely as files state it.
fn is_same(line: &LineAsRead, item: &MissionItem) -> bool {
    let LineAsRead(command, _, parameters, _) = line;
    let mut both = parameters.iter().zip(&item.parameters);
    *command == item.command
        && both.all(|(a, b)| (a.unwrap_or(0.0) - b.unwrap_or(0.0)).abs() < 1e-7)
}

/// Rally points as lines of a file of their own, which has no home.
fn write_rally(places: &Places<'_>, frame: &LocalFrame) -> (String, Vec<String>) {
    let mut text = format!("{HEADER} {VERSION}\n");
    for (sequence, point) in places.rally.unwrap_or_default().iter().enumerate() {
        text.push_str(&line_of(&rally::item_of(point, frame), sequence, false));
    }
    (text, Vec::new())
}

/// Lets jumps lead to the lines of the commands that they named; how many of these are gone.
fn aim_jumps(items: &mut [(MissionItem, Option<usize>)]) -> usize {
    let ids: Vec<Option<usize>> = items.iter().map(|item| item.1).collect();
    let mut lost = 0;
    for (item, _) in items.iter_mut().filter(|(item, _)| item.command == JUMP) {
        let Some(target) = item.parameters[0] else {
            continue;
        };
        match ids
            .iter()
            .position(|id| id.is_some_and(|id| id as f64 == target))
        {
            Some(sequence) => item.parameters[0] = Some(sequence as f64),
            None => lost += 1,
        }
    }
    lost
}

fn line_of(item: &MissionItem, sequence: usize, is_current: bool) -> String {
    let [own @ .., latitude, longitude, altitude] = &item.parameters;
    let mut fields = vec![
        sequence.to_string(),
        u8::from(is_current).to_string(),
        item.frame.to_string(),
        item.command.to_string(),
    ];
    fields.extend(own.iter().map(|p| p.unwrap_or(0.0).to_string()));
    // Of a place a number that was missing stays so: a zero would lead elsewhere.
    let leads = item.action().is_some();
    let missing = |is_place: bool| if leads && is_place { f64::NAN } else { 0.0 };
    let of_degrees = missing(latitude.is_some() || longitude.is_some());
    fields.extend([latitude, longitude].map(|p| degrees(p.unwrap_or(of_degrees))));
    let of_metres = missing(item.altitude().is_none());
    fields.push(altitude.unwrap_or(of_metres).to_string());
    fields.push(u8::from(item.is_continued).to_string());
    fields.join("\t") + "\n"
}
