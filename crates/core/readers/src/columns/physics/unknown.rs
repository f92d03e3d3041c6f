//! Three columns whose names say nothing: what they measure, told by what they agree with.

use super::Known;
use super::axes::{BODY, EARTH, centred, fits};
use super::board::{FlightColumns, Id};
use super::grid::quantile;
use crate::columns::ColumnRole;
use crate::columns::groups::GroupQuantity;

/// Triples that nobody knows what they are.
fn triples(board: &FlightColumns) -> Vec<[Id; 3]> {
    let mut found = Vec::new();
    for (table, known) in board.evidence.iter().enumerate() {
        for group in known
            .groups
            .iter()
            .filter(|g| g.kind.is_none() && g.columns.len() == 3)
        {
            let ids = [0, 1, 2].map(|part| (table, group.columns[part]));
            let is_free = ids
                .iter()
                .all(|id| board.column(*id).role == ColumnRole::Nothing);
            let has_time = board.find_in(table, ColumnRole::Time).is_some();
            if is_free && has_time {
                found.push(ids);
            }
        }
    }
    found.extend(super::nameless::windows::<3>(board));
    found
}

fn take(board: &mut FlightColumns, ids: [Id; 3], kind: GroupQuantity, unit: &str, why: &str) {
    let roles = kind.roles();
    // Of tables without names each tells what it has; which of them is to be believed is settled between them.
    let table = ids[0].0;
    let is_nameless = !board.maps[table].shape.has_header;
    let find = |role| {
        if is_nameless {
            board.find_in(table, role)
        } else {
            board.find(role)
        }
    };
    let is_there =
        |role: Option<(ColumnRole, f64)>| role.is_some_and(|(role, _)| find(role).is_some());
    let is_taken = |id: &Id| board.column(*id).role != ColumnRole::Nothing;
    if roles.into_iter().any(is_there) || ids.iter().any(is_taken) {
        return;
    }
    let names = board.names(&ids);
    for (id, role) in ids.into_iter().zip(roles) {
        if let Some((role, sign)) = role {
            board.take(id, role, unit, why);
            board.assign(id, role, sign, 0.0);
        }
    }
    board.tell(ids[0].0, format!("{names}: {why}"));
}

/// Velocities and places, by the track.
pub(super) fn place(board: &mut FlightColumns, known: &Known) {
    for ids in triples(board) {
        // Where there is no track, nothing tells.
        if !known.is_of_track || quantile(&known.speed(), 0.9) < 1.0 {
            return;
        }
        let raw = ids.map(|id| known.grid.mean(&board.raw(id)));
        let none = vec![f64::NAN; known.grid.count];
        let reference = [known.velocity[0].clone(), known.velocity[1].clone(), none];
        let best = fits(&EARTH, &reference, &raw).first().map(|fit| fit.score);
        if best.is_some_and(|score| score > 0.9) {
            take(
                board,
                ids,
                GroupQuantity::Velocity,
                "m/s",
                "they go as the velocity of the track does",
            );
        }
    }
}

/// Accelerations by gravity, gyros by attitude.
pub(super) fn inertial(board: &mut FlightColumns, known: &Known) {
    for ids in triples(board) {
        let values = ids.map(|id| board.raw(id).values);
        let sizes: Vec<f64> = values[0]
            .iter()
            .zip(&values[1])
            .zip(&values[2])
            .map(|((x, y), z): ((&f64, &f64), &f64)| (x * x + y * y + z * z).sqrt())
            .collect();
        let middle = quantile(&sizes, 0.5);
        let third = quantile(&values[2], 0.5).abs();
        let gravity = [
            ("m/s2", 9.806_65),
            ("g", 1.0),
            ("mg", 1000.0),
            ("cm/s2", 980.665),
        ];
        let unit = gravity
            .iter()
            .find(|(_, size)| (middle / size - 1.0).abs() < 0.08);
        // A row of a rotation, as poses have them, is one to the last digit.
        let is_one = |size: &f64| (size - 1.0).abs() < 1e-5;
        let is_rotation = sizes.len() > 1 && sizes.iter().all(is_one);
        if let Some((unit, _)) = unit.filter(|_| third > 0.8 * middle && !is_rotation) {
            take(
                board,
                ids,
                GroupQuantity::Acceleration,
                unit,
                "their amount is that of gravity",
            );
            continue;
        }
        let raw = ids.map(|id| centred(&known.grid.mean(&board.raw(id))));
        let mut rates = known.attitude_rates.each_ref().map(|part| centred(part));
        if rates.iter().flatten().all(|rate| !rate.is_finite()) {
            rates[2] = centred(&super::inertial::course_rate(known));
        }
        let best = fits(&BODY, &rates, &raw).first().map(|fit| fit.score);
        if best.is_some_and(|score| score > 0.75) {
            take(
                board,
                ids,
                GroupQuantity::Rate,
                "rad/s",
                "they go as the change of attitude does",
            );
        }
    }
}
