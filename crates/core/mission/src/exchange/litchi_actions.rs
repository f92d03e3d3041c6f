//! Actions at the way-points of Litchi's tables: types and parameters in columns of their own.

use std::collections::BTreeMap;

use serde_json::Value;

use super::csv_columns::Unit;

/// Actions that a way-point may have.
pub(super) const ACTIONS: usize = 15;
/// Types of actions: none, and staying for a time in milliseconds.
const NONE: &str = "-1";
const STAY: &str = "0";

/// Name of the column in feet in which a table of imperial units has what another has in metres.
pub(super) fn in_feet(name: &str) -> Option<String> {
    Some(name.strip_suffix("(m)")?.to_owned() + "(ft)")
}

/// Value that a table had in the column of that name, in metres where its name says so.
pub(super) fn kept(properties: &BTreeMap<String, String>, name: &str) -> Option<String> {
    let of = |name: &str| {
        let mut own = properties.iter();
        let (_, text) = own.find(|(own, _)| own.eq_ignore_ascii_case(name))?;
        match serde_json::from_str(text) {
            Ok(Value::String(text)) => Some(with_point(text)),
            Ok(Value::Number(number)) => Some(number.to_string()),
            _ => None,
        }
    };
    of(name).or_else(|| {
        let metres = Unit::Foot.factor() * of(&in_feet(name)?)?.parse::<f64>().ok()?;
        // Below a micrometre the product has digits that nobody wrote.
        Some(((metres * 1e6).round() / 1e6).to_string())
    })
}

/// A number with a decimal point, which tables of other countries write with a comma.
fn with_point(text: String) -> String {
    let plain = text.replacen(',', ".", 1);
    if plain.parse::<f64>().is_ok() {
        plain
    } else {
        text
    }
}

/// Whether a column of that name stands in no table but Litchi's.
pub(super) fn is_litchis(name: &str) -> bool {
    ["actiontype1", "gimbalmode", "poi_latitude"]
        .iter()
        .any(|own| own.eq_ignore_ascii_case(name))
}

/// That it is not known to which leg a speed of Litchi's table belongs, where that matters: where the speeds differ.
pub(super) fn legs_of_speeds(speeds: &[Option<f64>]) -> Option<String> {
    (speeds.windows(2).any(|two| two[0] != two[1])).then(|| {
        "a speed in Litchi's table is taken for that of the leg that leads to its row; DJI's own way-points have that of the leg \
         behind them, and Litchi may fly so: check it there"
            .to_owned()
    })
}

/// Actions of a way-point, type and parameter of each, as its table had them.
fn kept_actions(properties: &BTreeMap<String, String>) -> Vec<(String, String)> {
    let of = |i: usize| {
        let kind = kept(properties, &format!("actiontype{i}"));
        let parameter = kept(properties, &format!("actionparam{i}"));
        let (none, zero) = (|| NONE.to_owned(), || "0".to_owned());
        (kind.unwrap_or_else(none), parameter.unwrap_or_else(zero))
    };
    (1..=ACTIONS).map(of).collect()
}

/// Seconds for which it stays by its table; `None` if it does not.
pub(super) fn litchi_stay(properties: &BTreeMap<String, String>) -> Option<f64> {
    let stays = |(kind, parameter): (String, String)| {
        let milliseconds = parameter.parse::<f64>().ok();
        milliseconds.filter(|time| kind == STAY && *time > 0.0)
    };
    let sum: f64 = kept_actions(properties).into_iter().filter_map(stays).sum();
    (sum > 0.0).then_some(sum / 1000.0)
}

/// Actions to be written of a way-point that stays for so many seconds: those that its table had, with another stay where
/// that is not so long. False if there is no room for it.
pub(super) fn actions(
    properties: &BTreeMap<String, String>,
    seconds: Option<f64>,
) -> (Vec<(String, String)>, bool) {
    let mut actions = kept_actions(properties);
    if litchi_stay(properties) == seconds {
        return (actions, true);
    }
    let nothing = || (NONE.to_owned(), "0".to_owned());
    actions.retain(|(kind, _)| kind != STAY && kind != NONE);
    let has_room = actions.len() < ACTIONS || seconds.is_none();
    if let Some(seconds) = seconds.filter(|_| has_room) {
        let milliseconds = (1000.0 * seconds).round().to_string();
        actions.insert(0, (STAY.to_owned(), milliseconds));
    }
    actions.resize_with(ACTIONS, nothing);
    (actions, has_room)
}
