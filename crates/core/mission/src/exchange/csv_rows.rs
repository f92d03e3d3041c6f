//! Rows of tables as they are written, in whatever columns: their cells, and what routes say that has no room in them.

use serde_json::Value;

use super::complex::COMPLEX;
use super::item_route::{FIRST, RETURN, WPL};
use crate::mission::{HOME, Route};
use pilotage_base::text::in_quotes;

/// That rows of way-points have no room for what routes say beside them, if they do.
pub(super) fn of_routes_left_out(routes: &[Route]) -> Vec<String> {
    let first = |route: &Route| -> usize {
        let list = route.properties.get(FIRST);
        let list: Option<Vec<Value>> = list.and_then(|text| serde_json::from_str(text).ok());
        list.map_or(0, |list| list.len())
    };
    let commands: usize = routes.iter().map(first).sum();
    let has = |name: &str| routes.iter().any(|r| r.properties.contains_key(name));
    let told = [FIRST, HOME, COMPLEX, RETURN, WPL];
    let is_more = |name: &String| !told.contains(&name.as_str());
    let has_more = routes.iter().any(|r| r.properties.keys().any(is_more));
    let mut notes = Vec::new();
    let mut tell = |is_there: bool, what: String| {
        notes.extend(is_there.then(|| format!("{what} left out: rows are way-points")));
    };
    tell(has(HOME), "the home position is".to_owned());
    let before = format!("{commands} × command before the first way-point is");
    tell(commands > 0, before);
    tell(
        has(COMPLEX),
        "the item of a survey or the like is".to_owned(),
    );
    tell(has_more, "other properties of the route are".to_owned());
    notes
}

/// A cell, in quotes where it needs them.
pub(super) fn quoted(cell: &str) -> String {
    if cell.contains([',', ';', '\t', '"', '\n', '\r']) || cell.trim() != cell {
        in_quotes(cell)
    } else {
        cell.to_owned()
    }
}
