//! Plan files as `QGroundControl` documents them, as checks of what we write.
//!
//! <https://docs.qgroundcontrol.com/master/en/qgc-dev-guide/file_formats/plan.html>

use serde_json::Value;

/// Type that a member has to have.
#[derive(Clone, Copy, Debug)]
enum MemberKind {
    Number,
    NumberOrNull,
    Bool,
    Is(&'static str),
    Version(u64),
    Array,
    Object,
}

const PLAN: [(&str, MemberKind); 6] = [
    ("fileType", MemberKind::Is("Plan")),
    ("version", MemberKind::Version(1)),
    ("groundStation", MemberKind::Is("Pilotage")),
    ("mission", MemberKind::Object),
    ("geoFence", MemberKind::Object),
    ("rallyPoints", MemberKind::Object),
];
const MISSION: [(&str, MemberKind); 8] = [
    ("version", MemberKind::Version(2)),
    ("firmwareType", MemberKind::Number),
    ("globalPlanAltitudeMode", MemberKind::Number),
    ("vehicleType", MemberKind::Number),
    ("cruiseSpeed", MemberKind::Number),
    ("hoverSpeed", MemberKind::Number),
    ("items", MemberKind::Array),
    ("plannedHomePosition", MemberKind::Array),
];
const SIMPLE_ITEM: [(&str, MemberKind); 6] = [
    ("type", MemberKind::Is("SimpleItem")),
    ("autoContinue", MemberKind::Bool),
    ("command", MemberKind::Number),
    ("doJumpId", MemberKind::Number),
    ("frame", MemberKind::Number),
    ("params", MemberKind::Array),
];
/// Either all of these or none: an item that leads to a place has them.
const ALTITUDE: [(&str, MemberKind); 3] = [
    ("AMSLAltAboveTerrain", MemberKind::NumberOrNull),
    ("Altitude", MemberKind::NumberOrNull),
    ("AltitudeMode", MemberKind::Number),
];
const FENCE: [(&str, MemberKind); 3] = [
    ("version", MemberKind::Version(2)),
    ("circles", MemberKind::Array),
    ("polygons", MemberKind::Array),
];
const RALLY: [(&str, MemberKind); 2] = [
    ("version", MemberKind::Version(2)),
    ("points", MemberKind::Array),
];

fn has(value: &Value, path: &str, members: &[(&str, MemberKind)]) -> Result<(), String> {
    for (name, kind) in members {
        let member = value
            .get(name)
            .ok_or_else(|| format!("{path}.{name} is missing"))?;
        let is_right = match kind {
            MemberKind::Number => member.is_number(),
            MemberKind::NumberOrNull => member.is_number() || member.is_null(),
            MemberKind::Bool => member.is_boolean(),
            MemberKind::Is(text) => member == text,
            MemberKind::Version(version) => member.as_u64() == Some(*version),
            MemberKind::Array => member.is_array(),
            MemberKind::Object => member.is_object(),
        };
        if !is_right {
            return Err(format!("{path}.{name} is {member}, not {kind:?}"));
        }
    }
    Ok(())
}

fn is_position(value: &Value) -> bool {
    let numbers: Option<Vec<f64>> = value
        .as_array()
        .and_then(|list| list.iter().map(Value::as_f64).collect());
    matches!(numbers.as_deref(), Some([latitude, longitude, _])
        if latitude.abs() <= 90.0 && longitude.abs() <= 540.0)
}

/// Checks that `text` is a plan as the documentation has it; the error says what is not.
pub(super) fn check(text: &str) -> Result<(), String> {
    let plan: Value = serde_json::from_str(text).map_err(|e| e.to_string())?;
    has(&plan, "plan", &PLAN)?;
    has(&plan["geoFence"], "geoFence", &FENCE)?;
    has(&plan["rallyPoints"], "rallyPoints", &RALLY)?;
    let mission = &plan["mission"];
    has(mission, "mission", &MISSION)?;
    if !is_position(&mission["plannedHomePosition"]) {
        return Err("plannedHomePosition is no position".to_owned());
    }
    let items = mission["items"].as_array().ok_or("no items")?;
    if items.is_empty() {
        return Err("a plan has one item at least".to_owned());
    }
    let mut ids = Vec::new();
    for (i, item) in items.iter().enumerate() {
        if item["type"] == "ComplexItem" {
            continue;
        }
        let path = format!("items[{i}]");
        has(item, &path, &SIMPLE_ITEM)?;
        if ALTITUDE.iter().any(|(name, _)| item.get(name).is_some()) {
            has(item, &path, &ALTITUDE)?;
        }
        let params = item["params"].as_array().ok_or("no params")?;
        if params.len() != 7 || !params.iter().all(|p| p.is_number() || p.is_null()) {
            return Err(format!("{path}.params are not seven numbers or nulls"));
        }
        ids.push(item["doJumpId"].as_u64());
    }
    ids.sort_unstable();
    if ids.windows(2).any(|pair| pair[0] == pair[1]) {
        return Err("two items have the same doJumpId".to_owned());
    }
    Ok(())
}
