//! `QGC WPL 110`: a line of twelve fields for every command.
//!
//! <https://mavlink.io/en/file_formats/>. Mission Planner and `MAVProxy` write home as the first line.

use std::collections::BTreeMap;

use super::ExchangeError;
use super::found::Found;
use super::item::{Item, WAY_POINT, counted};
use super::item_route::{Home, Step, Written, home_of, route_of, steps_of};
use crate::mission::{Route, degrees};
use pilotage_base::frames::LocalFrame;

const HEADER: &str = "QGC WPL 110";

/// A line of the file.
struct Line {
    sequence: usize,
    is_current: bool,
    item: Item,
}

/// Reads the lines as one route.
pub(super) fn read(file: &str, content: &str) -> Result<Found, ExchangeError> {
    let mut lines = Vec::new();
    for (i, text) in content.lines().enumerate() {
        let place = |column: usize, cause: String| ExchangeError::Place {
            file: file.to_owned(),
            line: i + 1,
            column,
            cause,
        };
        if i == 0 {
            if text.trim_start_matches('\u{feff}').trim() != HEADER {
                return Err(place(1, format!("the first line has to be `{HEADER}`")));
            }
        } else if !text.trim().is_empty() && !text.starts_with('#') {
            lines.push(line(text).map_err(|(column, cause)| place(column, cause))?);
        }
    }
    let mut notes = Vec::new();
    let home = home(&lines);
    if home.is_some() {
        notes.push("the first line is taken for home, as Mission Planner writes it".to_owned());
    }
    let steps = lines
        .into_iter()
        .skip(usize::from(home.is_some()))
        .map(|line| Step::Command {
            text: line.item.json(line.sequence),
            altitude: None,
            members: BTreeMap::from([("doJumpId".to_owned(), line.sequence.to_string())]),
            item: line.item,
        })
        .collect();
    let (mut route, more) = route_of(steps, home);
    let stem = file.rsplit(['/', '\\']).next().unwrap_or(file);
    route.name = Some(
        stem.rsplit_once('.')
            .map_or(stem, |(stem, _)| stem)
            .to_owned(),
    );
    notes.extend(more);
    Ok(Found {
        routes: vec![route],
        notes,
        ..Found::default()
    })
}

/// A line, or the column of what is wrong with it and what that is.
fn line(text: &str) -> Result<Line, (usize, String)> {
    let fields: Vec<&str> = text.split_whitespace().collect();
    if fields.len() != 12 {
        return Err((1, format!("there are {} fields, not 12", fields.len())));
    }
    let column = |i: usize| fields[i].as_ptr() as usize - text.as_ptr() as usize + 1;
    let number = |i: usize| -> Result<f64, (usize, String)> {
        fields[i]
            .parse()
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
    // The file has no word for a heading that is left to the aircraft; people write 0.
    parameters[3] = parameters[3].filter(|heading| *heading != 0.0);
    Ok(Line {
        sequence: whole(0, 65535.0)? as usize,
        is_current: whole(1, 1.0)? == 1.0,
        item: Item {
            frame: whole(2, 255.0)? as u8,
            command: whole(3, 65535.0)? as u16,
            parameters,
            is_continued: whole(11, 1.0)? == 1.0,
        },
    })
}

/// The first line as home: a way-point in absolute altitude that is current and has no parameters.
fn home(lines: &[Line]) -> Option<Home> {
    let [first, _, ..] = lines else {
        return None;
    };
    let item = &first.item;
    let [own @ .., latitude, longitude, altitude] = &item.parameters;
    let is_home = first.sequence == 0
        && first.is_current
        && item.frame == 0
        && [0, WAY_POINT].contains(&item.command)
        && own.iter().all(|p| p.unwrap_or(0.0) == 0.0);
    is_home.then(|| [latitude, longitude, altitude].map(|p| p.unwrap_or(0.0)))
}

/// The route as lines, and notes on what they cannot hold.
pub(super) fn write(route: &Route, frame: &LocalFrame) -> (String, Vec<String>) {
    let mut text = format!("{HEADER}\n");
    let mut sequence = 0;
    let mut add = |item: &Item| {
        let [own @ .., latitude, longitude, altitude] = &item.parameters;
        let mut fields = vec![
            sequence.to_string(),
            u8::from(sequence == 0).to_string(),
            item.frame.to_string(),
            item.command.to_string(),
        ];
        fields.extend(own.iter().map(|p| p.unwrap_or(0.0).to_string()));
        fields.extend([latitude, longitude].map(|p| degrees(p.unwrap_or(0.0))));
        fields.push(altitude.unwrap_or(0.0).to_string());
        fields.push(u8::from(item.is_continued).to_string());
        text.push_str(&fields.join("\t"));
        text.push('\n');
        sequence += 1;
    };
    if let Some(home) = home_of(route, frame) {
        let mut parameters = [Some(0.0); 7];
        for (parameter, value) in parameters[4..].iter_mut().zip(home) {
            *parameter = Some(value);
        }
        add(&Item {
            command: WAY_POINT,
            frame: 0,
            parameters,
            is_continued: true,
        });
    }
    let mut left_out = Vec::new();
    for step in steps_of(route, frame) {
        match step {
            Written::WayPoint(item, _) | Written::Speed(item) => add(&item),
            Written::Kept(piece) => match Item::of_json(piece.get()) {
                Ok(item) => add(&item),
                Err(name) => left_out.push(name),
            },
        }
    }
    let mut notes =
        vec!["home is written as the first line, as Mission Planner reads it".to_owned()];
    if !left_out.is_empty() {
        notes.push(format!(
            "WPL has no line for this, which is left out: {}",
            counted(&left_out)
        ));
    }
    let kept_aside = ["plan:geoFence", "plan:rallyPoints"];
    if kept_aside.iter().any(|p| route.properties.contains_key(*p)) {
        notes.push("fences and rally points of the plan are left out: WPL has none".to_owned());
    }
    (text, notes)
}
