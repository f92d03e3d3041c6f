//! Questions to people about all that nothing in the tables tells: one for all units that had to be assumed.

use pilotage_flight::{ChannelName, Quantity};

use super::board::{FlightColumns, UnitBasis};
use crate::columns::ColumnRole;
use crate::columns::header::parts;

/// Adds a question about a table.
pub(super) fn add(board: &mut FlightColumns, table: usize, question: String) {
    let questions = &mut board.maps[table].questions;
    if !questions.contains(&question) {
        questions.push(question);
    }
}

/// Asks for the units that nothing tells.
pub(super) fn ask(board: &mut FlightColumns) {
    same_units(board);
    high_heights(board);
    let mut assumed: Vec<(usize, String)> = Vec::new();
    for table in 0..board.maps.len() {
        for index in 0..board.maps[table].columns.len() {
            let column = board.column((table, index));
            let matters = matches!(
                column.role.quantity(),
                Some(Quantity::Speed | Quantity::Length | Quantity::Angle | Quantity::AngularRate)
            );
            // Places on the globe tell their unit by their range.
            let is_place = matches!(
                column.role,
                ColumnRole::Latitude | ColumnRole::Longitude | ColumnRole::Place
            );
            let is_used = column.role != ColumnRole::Nothing && matters && !is_place;
            if is_used && board.basis((table, index)) == UnitBasis::Assumed {
                assumed.push((
                    table,
                    format!(
                        "{} ({}) in {}",
                        column.role.label(),
                        column.name,
                        column.unit
                    ),
                ));
            }
        }
    }
    let Some((table, _)) = assumed.first().cloned() else {
        return;
    };
    let words: Vec<String> = assumed.into_iter().map(|(_, words)| words).collect();
    let question = format!(
        "No unit is stated, and nothing else tells it; taken: {}. Is that right?",
        words.join(", ")
    );
    add(board, table, question);
}

/// A height that is called by that word alone, has no other beside it and is never low may be one above the sea.
fn high_heights(board: &mut FlightColumns) {
    const LOW: f64 = 150.0;
    let heights = [
        ChannelName::HeightAboveGround,
        ChannelName::GpsHeight,
        ChannelName::BarometricHeight,
    ];
    let is_height = |role| {
        heights
            .iter()
            .any(|name| role == ColumnRole::Channel(*name))
    };
    for table in 0..board.maps.len() {
        let columns = &board.maps[table].columns;
        let mut found = (0..columns.len()).filter(|index| is_height(columns[*index].role));
        let (Some(index), None) = (found.next(), found.next()) else {
            continue;
        };
        let id = (table, index);
        let is_bare = parts(&board.column(id).name, "").plain_words() == ["height"];
        let lowest = board
            .values(id)
            .values
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        if is_bare && board.column(id).role == ColumnRole::Channel(heights[0]) && lowest > LOW {
            let name = board.name(id);
            let question = format!(
                "{name} is taken for the height above ground, and is never below {lowest:.0} m: is it above the sea?"
            );
            add(board, table, question);
        }
    }
}

/// A group keeps its units: what is assumed takes the unit of what was found of the same quantity in its table.
fn same_units(board: &mut FlightColumns) {
    for table in 0..board.maps.len() {
        let count = board.maps[table].columns.len();
        for index in 0..count {
            let id = (table, index);
            let Some(quantity) = board.column(id).role.quantity() else {
                continue;
            };
            if board.basis(id) != UnitBasis::Assumed
                || quantity == Quantity::Length
                || matches!(
                    board.column(id).role,
                    ColumnRole::WindSpeed
                        | ColumnRole::Channel(ChannelName::WindNorth | ChannelName::WindEast)
                )
            {
                continue;
            }
            let is_like = |other: &usize| {
                let other = (table, *other);
                let column = board.column(other);
                let is_place = matches!(column.role, ColumnRole::Latitude | ColumnRole::Longitude);
                column.role.quantity() == Some(quantity)
                    && board.basis(other) == UnitBasis::Found
                    && !is_place
            };
            let Some(other) = (0..count).find(is_like) else {
                continue;
            };
            let unit = board.column((table, other)).unit.clone();
            let name = board.name((table, other));
            let factor = board.column(id).role.factor(&unit).unwrap_or(1.0);
            let raw = |id| super::grid::quantile(&board.raw(id).map(f64::abs).values, 1.0);
            let reach = raw(id) * factor;
            // Nothing climbs faster than it flies: pilots beside knots count feet a minute.
            if board.column(id).role == ColumnRole::Channel(ChannelName::GpsVelocityDown)
                && ["kt", "mph"].contains(&unit.as_str())
                && raw(id) > raw((table, other))
            {
                board.found(id, "ft/min", &format!("in ft/min, as {name} is in {unit}"));
                continue;
            }
            let most = match quantity {
                Quantity::Angle => 7.0,
                Quantity::Speed => 400.0,
                Quantity::AngularRate => 40.0,
                _ => f64::INFINITY,
            };
            if reach <= most {
                board.found(id, &unit, &format!("in {unit}, as {name} is"));
            }
        }
    }
}
