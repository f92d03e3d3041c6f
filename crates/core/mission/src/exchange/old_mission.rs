//! Missions of `QGroundControl` before there were plans (`.mission`, versions 1 and 2), as the plans that
//! say the same.

use serde_json::{Map, Value, json};

use super::file_look::{Claim, FileForm, FileLook};
use super::format_info::{FormatInfo, HeldBeside, HeldTogether};
use super::format_work::{FormatWork, Read};
use super::found::GeodeticContent;
use super::written::WrittenFile;
use super::{ExchangeError, inav, plan};

/// Plans, and what stood in their place before.
pub(super) const INFO: FormatInfo = FormatInfo {
    name: "QGroundControl plan",
    as_words: "a QGroundControl plan",
    extensions: &["plan", "mission"],
    anybodys: &[],
    maker: None,
    together: HeldTogether::Mission,
    holds_tracks: false,
    beside: HeldBeside::AreasAndRally,
};

fn claims(look: &FileLook<'_>) -> Claim {
    let is_inav = || inav::is_inav(look.head);
    match look.form {
        FileForm::Xml if is_inav() => Claim::Likely,
        FileForm::Json if look.is_named(&INFO) || is_inav() || is_plan(look) => Claim::Sure,
        FileForm::Text if is_inav() => Claim::Sure,
        _ => look.named_text(&INFO),
    }
}

/// Whether JSON is a plan, or a mission of `QGroundControl` before there were plans.
fn is_plan(look: &FileLook<'_>) -> bool {
    let text = String::from_utf8_lossy(look.bytes);
    let has = |member: &str| text.contains(member);
    if (has("\"fileType\"") || has("\"MAV_AUTOPILOT\"")) && !has("\"FeatureCollection\"") {
        return true;
    }
    // Large files are parsed only where they may be one.
    has("\"items\"")
        && serde_json::from_str::<Map<String, Value>>(&text)
            .is_ok_and(|members| is_mission(&members))
}

/// Its reader and writers.
pub(super) const WORK: FormatWork = FormatWork {
    claims,
    read: Read::Text(|file, content| match as_plan(content) {
        Some(plan) => read(file, &plan),
        None if inav::is_inav(content) => inav::read(file, content),
        None => plan::read(file, content),
    }),
    write: |places, frame| {
        let text = plan::write(&places.routes[0], places, frame);
        Ok(WrittenFile::of_text(text))
    },
    track: None,
};

/// The plan that says what an old mission says; `None` if the text is none.
fn as_plan(content: &str) -> Option<String> {
    let mut old: Map<String, Value> = serde_json::from_str(content).ok()?;
    let is_named = old.contains_key("fileType");
    let is_second =
        old.get("fileType").is_some_and(|kind| kind == "Mission") || !is_named && is_mission(&old);
    let is_first = !is_named && !is_second && old.contains_key("MAV_AUTOPILOT");
    if !old.contains_key("items") || !(is_first || is_second) {
        return None;
    }
    old.remove("fileType");
    let ground_station = old.remove("groundStation");
    if is_first {
        renew(&mut old);
    }
    old.insert("version".to_owned(), json!(2));
    let mut plan = json!({ "fileType": "Plan", "version": 1, "mission": old });
    if let (Some(ground_station), Some(plan)) = (ground_station, plan.as_object_mut()) {
        plan.insert("groundStation".to_owned(), ground_station);
    }
    Some(plan.to_string())
}

/// Whether members are those of a mission of version 2, whatever kind of file they say: a list of commands that have
/// their numbers.
pub(super) fn is_mission(members: &Map<String, Value>) -> bool {
    let items = members.get("items").and_then(Value::as_array);
    let has_parameters = |item: &Value| item.get("params").is_some_and(Value::is_array);
    let is_command =
        |item: &Value| item.get("command").is_some_and(Value::is_number) && has_parameters(item);
    let is_survey = |item: &Value| item.get("type").is_some_and(|kind| kind == "ComplexItem");
    items.is_some_and(|items| {
        items.iter().any(is_command) && items.iter().all(|item| is_command(item) || is_survey(item))
    })
}

/// Reads a plan that was made of an old mission.
fn read(file: &str, plan: &str) -> Result<GeodeticContent, ExchangeError> {
    let mut found = plan::read(file, plan).map_err(|error| match error {
        // Lines are those of the plan.
        ExchangeError::Place { file, cause, .. } => ExchangeError::File { file, cause },
        other => other,
    })?;
    found.notes.push(
        "this is a mission of QGroundControl before there were plans; it is written as a plan"
            .to_owned(),
    );
    Ok(found)
}

/// Members of version 1 as version 2 has them.
fn renew(old: &mut Map<String, Value>) {
    let simple = |item: Value| {
        let Value::Object(mut item) = item else {
            return item;
        };
        let mut parameters: Vec<Value> = (1..=4)
            .map(|i| item.remove(&format!("param{i}")).unwrap_or_default())
            .collect();
        let place = item.remove("coordinate").unwrap_or_default();
        parameters.extend(place.as_array().cloned().unwrap_or_default());
        item.insert("params".to_owned(), Value::from(parameters));
        item.insert("type".to_owned(), json!("SimpleItem"));
        if let Some(id) = item.remove("id") {
            item.insert("doJumpId".to_owned(), id);
        }
        Value::Object(item)
    };
    let taken = |old: &mut Map<String, Value>, name: &str| match old.remove(name) {
        Some(Value::Array(list)) => list,
        _ => Vec::new(),
    };
    let mut items: Vec<Value> = taken(old, "items").into_iter().map(simple).collect();
    // Surveys stand apart, with the number at which they are flown.
    for mut complex in taken(old, "complexItems") {
        let number = |item: &Value, name: &str| item.get(name).and_then(Value::as_f64);
        let own = number(&complex, "id");
        let behind = |item: &Value| {
            number(item, "doJumpId")
                .zip(own)
                .is_some_and(|(a, b)| a > b)
        };
        let at = items.iter().position(behind).unwrap_or(items.len());
        if let Some(members) = complex.as_object_mut() {
            members.insert("type".to_owned(), json!("ComplexItem"));
        }
        items.insert(at, complex);
    }
    old.insert("items".to_owned(), Value::from(items));
    let firmware = old.remove("MAV_AUTOPILOT").unwrap_or_else(|| json!(12));
    old.insert("firmwareType".to_owned(), firmware);
    // Home was an item.
    if let Some(home) = old
        .get("plannedHomePosition")
        .and_then(|home| home.get("coordinate"))
    {
        let home = home.clone();
        old.insert("plannedHomePosition".to_owned(), home);
    }
}
