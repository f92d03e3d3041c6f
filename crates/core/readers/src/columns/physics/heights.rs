//! Heights against vertical velocities and against each other.

use pilotage_flight::ChannelName;

use super::Known;
use super::axes::{centred, compare};
use super::blackbox;
use super::board::{FlightColumns, Id, UnitBasis, nearest};
use super::grid::quantile;
use super::velocity::sign_by_height;
use crate::cells::Dimension;
use crate::columns::ColumnRole;

const HEIGHTS: [ChannelName; 3] = [
    ChannelName::GpsHeight,
    ChannelName::BarometricHeight,
    ChannelName::HeightAboveGround,
];

/// Judges the vertical velocity's sign and the heights' units; keeps the vertical velocity.
pub(super) fn judge(board: &mut FlightColumns, known: &mut Known) {
    let down = board.find(ColumnRole::Channel(ChannelName::GpsVelocityDown));
    let ids: Vec<Id> = HEIGHTS
        .iter()
        .filter_map(|name| board.find(ColumnRole::Channel(*name)))
        .collect();
    let rate = |board: &FlightColumns, id: Id| known.grid.rate(&board.values(id));
    if let Some(down) = down {
        as_beside(board, known, down, ids.first().copied());
    }
    if let (Some(down), Some(height)) = (down, ids.first()) {
        vertical(board, known, down, *height);
    }
    for id in &ids {
        if blackbox::is_height(board, *id) {
            blackbox::in_decimetres(board, *id);
        } else {
            plausible(board, known, *id);
        }
    }
    let down = down.map(|id| (id, known.grid.mean(&board.values(id))));
    // One that shows a single number all the time is of no sensor, and judges nothing.
    let judging = down.as_ref().filter(|(_, values)| moves(values));
    for id in &ids {
        let by_velocity = judging;
        let climbing = rate(board, *id);
        if let Some((down, down_values)) = by_velocity {
            let up: Vec<f64> = down_values.iter().map(|v| -v).collect();
            let is_sure = board.basis(*down) != UnitBasis::Assumed;
            match compare(&up, &climbing) {
                // Two that agree in the units that they have confirm each other.
                Some((correlation, factor, _)) if correlation > 0.6 && !is_sure => {
                    let is_same = factor.ln().abs() < 0.3;
                    if is_same && board.basis(*id) == UnitBasis::Assumed {
                        board.confirm(*id);
                        board.confirm(*down);
                    }
                    if is_same {
                        continue;
                    }
                }
                Some((correlation, factor, _)) if correlation > 0.6 => {
                    settle(board, *id, factor, "the vertical velocity");
                    continue;
                }
                _ => {}
            }
        }
        let others = ids
            .iter()
            .filter(|other| *other != id && board.basis(**other) != UnitBasis::Assumed);
        let other = others.copied().next();
        if let Some(other) = other {
            let height = |id: Id| centred(&known.grid.mean(&board.values(id)));
            if let Some((correlation, factor, _)) = compare(&height(other), &height(*id))
                && correlation > 0.9
            {
                let name = board.name(other);
                settle(board, *id, factor, &name);
            }
        }
    }
    let height = ids
        .iter()
        .find(|id| board.basis(**id) != UnitBasis::Assumed)
        .or(ids.first());
    let down = match (&down, height) {
        (Some((id, _)), _) => known.grid.mean(&board.values(*id)),
        (None, Some(height)) => rate(board, *height).iter().map(|up| -up).collect(),
        (None, None) => return,
    };
    known.velocity[2] = down;
}

/// Whether values are not all one number.
fn moves(values: &[f64]) -> bool {
    let finite = || values.iter().copied().filter(|v| v.is_finite());
    let (least, most) = (
        finite().fold(f64::INFINITY, f64::min),
        finite().fold(f64::NEG_INFINITY, f64::max),
    );
    most - least > 1e-6 * most.abs().max(least.abs())
}

/// Whether a height and a vertical velocity of no stated units agree as they are, in metres and metres a second.
fn agree_in_metres(board: &FlightColumns, known: &Known, down: Id, height: Id) -> bool {
    let is_plain =
        |id: Id, unit: &str| board.basis(id) == UnitBasis::Assumed && board.column(id).unit == unit;
    if !is_plain(down, "m/s") || !is_plain(height, "m") {
        return false;
    }
    let climbing = known.grid.rate(&board.values(height));
    let velocity = known.grid.mean(&board.values(down));
    compare(&climbing, &velocity).is_some_and(|(correlation, factor, _)| {
        correlation.abs() > 0.6 && factor.abs().ln().abs() < 0.2
    })
}

/// A group keeps its units: a vertical velocity is in that of the speed over ground beside it, unless it agrees with the
/// height as it is: in kilometres an hour it would be nearly that of feet.
fn as_beside(board: &mut FlightColumns, known: &Known, down: Id, height: Option<Id>) {
    if height.is_some_and(|height| agree_in_metres(board, known, down, height)) {
        return;
    }
    let speed = board.find_in(down.0, ColumnRole::SpeedOverGround);
    let sure = speed.filter(|id| board.basis(*id) == UnitBasis::Found);
    if let Some(speed) = sure.filter(|_| board.basis(down) == UnitBasis::Assumed) {
        let unit = board.column(speed).unit.clone();
        let name = board.name(speed);
        board.found(down, &unit, &format!("in {unit}, as {name} is"));
    }
}

/// A height of no stated unit that changes much faster than the aircraft flies is in the next smaller unit in which it
/// does not.
fn plausible(board: &mut FlightColumns, known: &Known, id: Id) {
    if board.basis(id) != UnitBasis::Assumed {
        return;
    }
    let speed = quantile(&known.speed(), 0.9);
    let raw = known.grid.rate(&board.raw(id));
    let raw: Vec<f64> = raw.iter().map(|rate| rate.abs()).collect();
    let climb = quantile(&raw, 0.9);
    let is_slow = |unit: &&str| {
        let factor = Dimension::Length.factor(Some(unit)).unwrap_or(1.0);
        climb.is_nan() || climb * factor <= 1.2 * speed + 5.0
    };
    let unit = board.column(id).unit.clone();
    if known.is_of_track && !is_slow(&unit.as_str()) {
        let found = ["m", "ft", "cm", "mm"]
            .into_iter()
            .find(|unit| is_slow(unit));
        if let Some(found) = found {
            let role = board.column(id).role;
            let why = format!("in {unit} it would climb faster than the aircraft flies");
            board.take(id, role, found, &why);
        }
    }
}

/// Whether decimetres would come nearest: nobody writes heights so, and a nose lies off the path by more than feet do.
fn is_of_decimetres(board: &FlightColumns, id: Id, factor: f64) -> bool {
    let present = board.column(id).role.factor(&board.column(id).unit);
    let found = nearest(Dimension::Length, factor * present.unwrap_or(1.0));
    found.is_some_and(|(unit, _)| unit == "dm")
}

fn settle(board: &mut FlightColumns, id: Id, factor: f64, what: &str) {
    let present = board.column(id).role.factor(&board.column(id).unit);
    let factor = factor * present.unwrap_or(1.0);
    // Pressure and receivers differ; units by three at least.
    if nearest(Dimension::Length, factor).is_some_and(|(_, off)| off.abs() < 0.45) {
        board.settle_unit(&[id], factor, 0.45, what);
    }
}

/// Up or down, where the name does not say: by what the height does.
fn vertical(board: &mut FlightColumns, known: &Known, down: Id, height: Id) {
    let climbing = known.grid.rate(&board.values(height));
    let velocity = known.grid.mean(&board.raw(down));
    let sign = sign_by_height(&climbing, &velocity);
    if let Some(sign) = sign.filter(|sign| *sign != board.column(down).scale.signum()) {
        let name = board.name(down);
        let role = board.column(down).role;
        board.assign(down, role, sign, 0.0);
        let way = if sign > 0.0 { "down" } else { "up" };
        board.tell(
            down.0,
            format!("{name}: it is positive {way}, as the height says"),
        );
    }
    // The receiver's vertical velocity in a unit of its own, if it is none of three.
    if board.basis(down) == UnitBasis::Assumed && board.basis(height) != UnitBasis::Assumed {
        let up: Vec<f64> = climbing.iter().map(|v| -v).collect();
        let values = known.grid.mean(&board.raw(down));
        let sign = board.column(down).scale;
        let values: Vec<f64> = values.iter().map(|v| v * sign).collect();
        if let Some((correlation, factor, _)) = compare(&up, &values)
            && correlation > 0.6
        {
            board.settle_unit(&[down], factor, 0.35, "the change of the height");
        }
    }
}

/// Heights that nothing else tells: by the climb that an airplane's pitch makes.
pub(super) fn by_pitch(board: &mut FlightColumns, known: &Known) {
    let speed = known.speed();
    let pitch = centred(&known.attitude[1]);
    let climb: Vec<f64> = pitch.iter().zip(&speed).map(|(p, v)| p * v).collect();
    let is_fast = quantile(&speed, 0.5) > 7.0;
    for name in HEIGHTS {
        let id = board.find(ColumnRole::Channel(name));
        // The third of a position along axes is in the unit of the others.
        let is_along = |id: &Id| {
            let north = board.find_in(id.0, ColumnRole::Channel(ChannelName::GpsNorth));
            name == ChannelName::GpsHeight && north.is_some()
        };
        let is_open = |id: &Id| is_fast && board.basis(*id) == UnitBasis::Assumed;
        let Some(id) = id.filter(|id| is_open(id) && !is_along(id)) else {
            continue;
        };
        let climbing = centred(&known.grid.rate(&board.values(id)));
        if let Some((correlation, factor, _)) = compare(&climb, &climbing)
            && correlation > 0.7
            && !is_of_decimetres(board, id, factor)
        {
            settle(board, id, factor, "pitch and speed");
        }
    }
}
