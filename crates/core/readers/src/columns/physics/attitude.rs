//! Attitude: in which unit and sense heading, roll and pitch are.

use pilotage_base::sorting::sort;
use pilotage_flight::ChannelName;

use super::Known;
use super::angles::{self, Convention, agreement, spread};
use super::axes::{centred, compare};
use super::board::{FlightColumns, Id, UnitBasis};
use super::grid::quantile;
use super::ros::AHEAD;
use super::{inertial, lean, quaternion};
use crate::cells::Dimension;
use crate::columns::ColumnRole;
use crate::columns::bodies::is_of_camera;
use crate::columns::groups::quaternion_roles;

/// Speed from which on wings carry, m/s.
const WINGS: f64 = 7.0;
const GRAVITY: f64 = 9.806_65;

/// Judges attitude and keeps it.
pub(super) fn judge(board: &mut FlightColumns, known: &mut Known) {
    quaternion::judge(board, known);
    let channel = |board: &FlightColumns, name| board.find(ColumnRole::Channel(name));
    let told = channel(board, ChannelName::Heading);
    let told = told.map(|id| board.column(id).unit.clone());
    if let Some(id) = channel(board, ChannelName::Heading) {
        heading(board, known, id);
    }
    let heading = channel(board, ChannelName::Heading);
    for name in [ChannelName::Roll, ChannelName::Pitch] {
        if let Some(id) = channel(board, name) {
            same_unit(board, heading, id);
        }
    }
    if let Some(id) = channel(board, ChannelName::Roll) {
        let before = board.column(id).unit.clone();
        roll(board, known, id);
        let unit = board.column(id).unit.clone();
        let pitch = board.find_in(id.0, ColumnRole::Channel(ChannelName::Pitch));
        // Where a table says of all three what two of them are not, as that of a simulator whose radians are called degrees.
        let is_misnamed = told.as_ref() == Some(&before)
            && heading.is_some_and(|heading| board.column(heading).unit == unit);
        let is_so = |board: &FlightColumns, pitch: Id| {
            let is_stated = board.basis(pitch) == UnitBasis::Stated;
            !is_stated || is_misnamed && board.column(pitch).unit == before
        };
        // What the track says of roll goes before the heading's unit for the pitch as well.
        if let Some(pitch) = pitch.filter(|pitch| unit != before && is_so(board, *pitch)) {
            let name = board.name(id);
            if board.basis(pitch) == UnitBasis::Stated {
                let own = board.name(pitch);
                board.tell(
                    pitch.0,
                    format!("{own}: the table says {before}, as of {name}, which is in {unit}; read in {unit}"),
                );
            }
            board.found(pitch, &unit, &format!("in {unit}, as {name} is"));
        }
    }
    if let Some(id) = channel(board, ChannelName::Pitch) {
        pitch(board, known, id);
    }
    if let Some(heading) = heading {
        ask_for_sense(board, known, heading);
    }
    keep(board, known);
}

/// Reads attitude as the maps have it now.
pub(super) fn keep(board: &FlightColumns, known: &mut Known) {
    let names = [ChannelName::Roll, ChannelName::Pitch, ChannelName::Heading];
    let mut series = names.map(|name| {
        let id = board.find(ColumnRole::Channel(name))?;
        Some(board.values(id).unwrapped())
    });
    if series[2].is_none() {
        for is_ros in [false, true] {
            let parts = quaternion_roles(is_ros).map(|role| board.find(role));
            if let [Some(w), Some(x), Some(y), Some(z)] = parts {
                let found = quaternion::angles(board, [w, x, y, z], is_ros);
                series = found.map(Some);
            }
        }
    }
    for (axis, series) in series.iter().enumerate() {
        if let Some(series) = series {
            known.attitude[axis] = known.grid.middle(series);
            known.attitude_rates[axis] = known.grid.rate(series);
        }
    }
}

fn heading(board: &mut FlightColumns, known: &mut Known, id: Id) {
    let course = known.course();
    let conventions = [
        Convention::Compass,
        Convention::FromEast,
        Convention::FromNorthLeft,
    ];
    let readings = angles::readings(board, &known.grid, id, &course, &conventions);
    let speed = known.fast();
    let turns = spread(&course) > 0.1;
    let best = readings
        .first()
        .filter(|best| best.score > AHEAD && speed > 3.0);
    let rival = best.and_then(|best| {
        let differs = |other: &&angles::DirectionReading| {
            agreement(&best.cells, &other.cells).is_none_or(|(cosine, _)| cosine < 0.9)
        };
        readings.iter().find(differs).map(|other| other.score)
    });
    if let Some(best) = best.filter(|best| turns && rival.is_none_or(|r| best.score > r + 0.1)) {
        let is_stated = board.basis(id) == UnitBasis::Stated;
        let before = board.column(id).unit.clone();
        best.apply(board, id, "the course over ground");
        let stated = (is_stated && before != best.unit).then(|| {
            format!(
                "the table says {before}, but it is the track's direction in {} only",
                best.unit
            )
        });
        best.tell(board, id, stated);
        known.is_ros = Some(best.convention == Convention::FromEast);
        known.is_heading_sure = true;
        return;
    }
    by_reach(board, id);
    if !by_lean(board, known, id) {
        by_gyro(board, known, id);
    }
}

/// Settles heading and the sign of pitch by the lean in turns, for an aircraft that does not fly where it looks.
/// Returns whether that tells.
fn by_lean(board: &mut FlightColumns, known: &mut Known, id: Id) -> bool {
    let channel = |board: &FlightColumns, name| board.find_in(id.0, ColumnRole::Channel(name));
    let tilt = channel(board, ChannelName::Roll).zip(channel(board, ChannelName::Pitch));
    let Some((roll, pitch)) = tilt else {
        return false;
    };
    let ids = [roll, pitch, id];
    let mut ways = Vec::new();
    for unit in lean_units(board, ids) {
        let factor = Dimension::Angle.factor(Some(unit)).unwrap_or(1.0);
        let read = |id| {
            known
                .grid
                .middle(&board.raw(id).map(|v| v * factor).unwrapped())
        };
        let [rolls, pitches, headings] = ids.map(read);
        for convention in [
            Convention::Compass,
            Convention::FromEast,
            Convention::FromNorthLeft,
        ] {
            let (sign, offset) = convention.terms();
            let headings: Vec<f64> = headings.iter().map(|h| sign * h + offset).collect();
            for sign in [1.0, -1.0] {
                let pitches: Vec<f64> = pitches.iter().map(|p| sign * p).collect();
                let found = lean::agreement(known, [&rolls, &pitches, &headings]);
                if let Some((score, tilt)) = found.filter(|found| found.1.ln().abs() < 0.9) {
                    ways.push((score - 0.1 * tilt.ln().abs(), convention, sign, unit));
                }
            }
        }
    }
    sort(&mut ways, &|a, b| b.0.total_cmp(&a.0));
    let Some((best, convention, sign, unit)) = ways.first().copied() else {
        return false;
    };
    if best < 0.5 || ways.get(1).is_some_and(|second| best < second.0 + 0.12) {
        return false;
    }
    for id in ids {
        board.found(id, unit, &format!("in {unit} it leans as the track turns"));
    }
    if unit != "deg" && unit != "rad" {
        let names = board.names(&ids);
        board.tell(id.0, format!("{names}: read in {unit}, as the track says"));
    }
    let factor = Dimension::Angle.factor(Some(unit)).unwrap_or(1.0);
    let (turned, offset) = convention.terms();
    let role = board.column(id).role;
    board.assign(id, role, turned, angles::tidy(offset / factor));
    known.is_ros = Some(sign < 0.0);
    known.is_heading_sure = true;
    if convention != Convention::Compass {
        let name = board.name(id);
        board.tell(
            id.0,
            format!("{name}: {}, as the track says", convention.words()),
        );
    }
    true
}

/// Units that roll, pitch and heading together may be in: as stated or found, else all in which none is beyond a turn.
fn lean_units(board: &FlightColumns, ids: [Id; 3]) -> Vec<&'static str> {
    let sure = ids
        .iter()
        .find(|id| board.basis(**id) != UnitBasis::Assumed);
    let sure = sure.map(|id| board.column(*id).unit.clone());
    let reach = ids.map(|id| quantile(&board.raw(id).map(f64::abs).values, 1.0));
    let fits = |unit: &&'static str| {
        let factor = Dimension::Angle.factor(Some(unit)).unwrap_or(1.0);
        let is_turn = reach[0].max(reach[1]) * factor < 3.3 && reach[2] * factor < 13.0;
        is_turn && reach[2] * factor > 0.02 && sure.as_ref().is_none_or(|sure| sure == unit)
    };
    ["deg", "rad", "ddeg", "cdeg"]
        .into_iter()
        .filter(fits)
        .collect()
}

/// A heading that goes all around, from 0 to a turn or from half a turn to the other, says its unit by its reach.
fn by_reach(board: &mut FlightColumns, id: Id) {
    if board.basis(id) != UnitBasis::Assumed {
        return;
    }
    let raw = board.raw(id).values;
    let (low, high) = (quantile(&raw, 0.0), quantile(&raw, 1.0));
    let turn = std::f64::consts::TAU;
    let units = Dimension::Angle.names();
    let found = units.into_iter().find(|unit| {
        let factor = Dimension::Angle.factor(Some(unit)).unwrap_or(1.0);
        let (low, high) = (low * factor, high * factor);
        let is_round = |reach: f64, whole: f64| (0.93 * whole..1.003 * whole).contains(&reach);
        low >= 0.0 && is_round(high, turn) && low < 0.1 * turn
            || is_round(high, 0.5 * turn) && is_round(-low, 0.5 * turn)
    });
    if let Some(unit) = found {
        board.found(id, unit, &format!("in {unit} it goes once around"));
        if unit != "deg" && unit != "rad" {
            let name = board.name(id);
            board.tell(
                id.0,
                format!("{name}: read in {unit}, in which it goes once around"),
            );
        }
    }
}

/// Settles the sense of the heading by gyros, and theirs by gravity, for an aircraft that does not fly where
/// it looks.
fn by_gyro(board: &mut FlightColumns, known: &mut Known, id: Id) {
    let Some(gyro) = board.find(ColumnRole::Channel(ChannelName::YawRate)) else {
        return;
    };
    let Some(is_up) = inertial::is_up_positive(board) else {
        return;
    };
    let turning = known.grid.rate(&board.values(id).unwrapped());
    let rate = centred(&known.grid.mean(&board.values(gyro)));
    let Some((correlation, ..)) = compare(&turning, &rate).filter(|c| c.0.abs() > 0.6) else {
        return;
    };
    let is_against_clock = (correlation > 0.0) == is_up;
    if !is_against_clock {
        return;
    }
    let name = board.name(id);
    if is_of_compass(board, id) {
        return;
    }
    let factor = board
        .column(id)
        .role
        .factor(&board.column(id).unit)
        .unwrap_or(1.0);
    let (sign, offset) = Convention::FromEast.terms();
    let role = board.column(id).role;
    board.assign(id, role, sign, angles::tidy(offset / factor));
    board.tell(
        id.0,
        format!(
            "{name}: {}, as gyros and gravity say",
            Convention::FromEast.words()
        ),
    );
    known.is_ros = Some(true);
}

/// A group keeps its unit: roll and pitch are in that of the heading beside them, unless they are beyond a turn then.
fn same_unit(board: &mut FlightColumns, heading: Option<Id>, id: Id) {
    let Some(heading) = heading.filter(|h| h.0 == id.0 && board.basis(*h) != UnitBasis::Assumed)
    else {
        return;
    };
    if board.basis(id) != UnitBasis::Assumed {
        return;
    }
    let unit = board.column(heading).unit.clone();
    // Another table keeps its own unit; that both are in the same is enough.
    if heading.0 != id.0 {
        if board.column(id).unit == unit {
            board.confirm(id);
        }
        return;
    }
    let factor = Dimension::Angle.factor(Some(&unit)).unwrap_or(1.0);
    let reach = quantile(&board.raw(id).map(f64::abs).values, 1.0);
    if reach * factor < 3.3 && board.column(id).unit != unit || board.column(id).unit == unit {
        board.found(
            id,
            &unit,
            &format!("in {unit}, as {} is", board.name(heading)),
        );
    }
}

/// Whether a heading is that of a compass by its name, or as it counts from 0 to a turn.
fn is_of_compass(board: &FlightColumns, id: Id) -> bool {
    let words = board.name(id).to_lowercase();
    let called = ["head", "hdg", "compass", "azimuth", "course"];
    let is_called = called.iter().any(|word| words.contains(word));
    is_called || quantile(&board.raw(id).values, 0.0) >= 0.0
}

/// Asks how a heading is counted where nothing tells.
fn ask_for_sense(board: &mut FlightColumns, known: &Known, id: Id) {
    if known.is_heading_sure || is_of_compass(board, id) {
        return;
    }
    let name = board.name(id);
    let is_ros = board.column(id).scale < 0.0;
    let taken = if is_ros {
        "against the clock from east (ROS)"
    } else {
        "clockwise from north"
    };
    super::questions::add(
        board,
        id.0,
        format!(
            "Is {name} counted clockwise from north, with pitch positive nose up, or against the clock from east (ROS)? Nothing else tells; taken: {taken}"
        ),
    );
}

fn has_wings(known: &Known) -> bool {
    let ahead = agreement(&known.course(), &known.attitude[2]);
    quantile(&known.speed(), 0.7) > WINGS && ahead.is_none_or(|(cosine, _)| cosine > 0.6)
}

/// Roll by the turn that it makes: tan(roll) = speed · rate of turn / gravity.
fn roll(board: &mut FlightColumns, known: &mut Known, id: Id) {
    keep(board, known);
    if !has_wings(known) {
        return;
    }
    let speed = known.speed();
    let heading = known.attitude_rates[2].iter().zip(&speed);
    let turned: Vec<f64> = heading
        .map(|(rate, speed)| (rate * speed / GRAVITY).atan())
        .collect();
    let values = known.grid.mean(&board.raw(id));
    let Some((correlation, factor, _)) = compare(&turned, &values) else {
        return;
    };
    if correlation.abs() < 0.6 {
        return;
    }
    if correlation < 0.0 {
        let role = board.column(id).role;
        board.assign(id, role, -1.0, 0.0);
        let name = board.name(id);
        board.tell(
            id.0,
            format!("{name}: positive with the left wing down, as turns say; its sign is turned"),
        );
    }
    let unit = board.column(id).unit.clone();
    let present = Dimension::Angle.factor(Some(&unit)).unwrap_or(1.0);
    if (factor / present).ln().abs() < 0.8 {
        board.confirm(id);
    } else {
        board.settle_unit(&[id], factor, 0.8, "the turns of the track");
    }
}

/// Pitch by the climb that it makes, or by the axes of the heading beside it.
fn pitch(board: &mut FlightColumns, known: &mut Known, id: Id) {
    keep(board, known);
    let roll = board.find_in(id.0, ColumnRole::Channel(ChannelName::Roll));
    if let Some(roll) = roll
        .filter(|r| board.basis(id) == UnitBasis::Assumed && board.basis(*r) == UnitBasis::Found)
    {
        let unit = board.column(roll).unit.clone();
        board.found(id, &unit, &format!("in {unit}, as {} is", board.name(roll)));
    }
    let speed = known.speed();
    let vertical = known.velocity[2].iter().zip(&speed);
    let climb: Vec<f64> = vertical
        .map(|(down, speed)| (-down).atan2(*speed))
        .collect();
    let values = known.grid.mean(&board.raw(id));
    // A gimbal holds its camera, whatever the aircraft does.
    let is_fixed = !is_of_camera(board.column(id));
    let by_climb = compare(&centred(&climb), &centred(&values))
        .filter(|c| is_fixed && c.0.abs() > 0.45 && has_wings(known))
        .map(|c| c.0.signum());
    let by_axes = known.is_ros.map(|is_ros| if is_ros { -1.0 } else { 1.0 });
    let by_gravity = inertial::sign_of_pitch(board, known, &values).filter(|_| is_fixed);
    let sign = by_climb.or(by_gravity).or(by_axes).unwrap_or(1.0);
    if sign < 0.0 {
        let role = board.column(id).role;
        board.assign(id, role, -1.0, 0.0);
        let name = board.name(id);
        let why = if by_climb.is_some() {
            "as climbs say"
        } else if by_gravity.is_some() {
            "as gravity says"
        } else {
            "as the axes of its heading say"
        };
        board.tell(
            id.0,
            format!("{name}: positive with the nose down, {why}; its sign is turned"),
        );
    }
}
