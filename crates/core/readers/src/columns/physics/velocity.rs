//! Velocities, speed and course over ground against the steps of the position.

use pilotage_flight::ChannelName;

use super::angles::{self, Convention};
use super::axes::{AxesFit, EARTH, compare, fits};
use super::board::{FlightColumns, Id, UnitBasis};
use super::grid::{TimedNumbers, quantile};
use super::known::{Known, TurnedVelocities};
use crate::cells::Dimension;
use crate::columns::ColumnRole;

/// Speed that the track has to reach for speeds to be told from it, m/s.
const MOVING: f64 = 1.0;
/// Mean correlation along north and east from which on a velocity is along them whatever the attitude says.
const SURE: f64 = 0.9;
/// Units of speed lie this far apart, as a logarithm, or further, halved.
pub(super) const TOLERANCE: f64 = 0.2;

/// Judges velocities, then speed and course.
pub(super) fn judge(board: &mut FlightColumns, known: &mut Known) {
    let north = board.find(ColumnRole::Channel(ChannelName::GpsVelocityNorth));
    let east =
        north.and_then(|id| board.find_in(id.0, ColumnRole::Channel(ChannelName::GpsVelocityEast)));
    if let Some((north, east)) = north.zip(east) {
        vector(board, known, north, east);
    }
    if let Some(id) = board.find(ColumnRole::SpeedOverGround) {
        speed(board, known, id);
    }
    if let Some(id) = board.find(ColumnRole::Course) {
        course(board, known, id);
    }
    if !known.is_of_track {
        without_track(board, known);
    }
}

/// The reference over the values, where there is motion, and how much that scatters, as a logarithm.
pub(super) fn ratio(reference: &[f64], values: &[f64]) -> Option<(f64, f64)> {
    let least = 0.4 * quantile(reference, 0.9);
    let pairs = reference.iter().zip(values);
    let logarithms: Vec<f64> = pairs
        .filter(|(a, b)| **a > least && **b > 0.0)
        .map(|(a, b)| (a / b).ln())
        .filter(|ratio| ratio.is_finite())
        .collect();
    if logarithms.len() < 8 {
        return None;
    }
    let middle = quantile(&logarithms, 0.5);
    let scatter = quantile(&logarithms, 0.75) - quantile(&logarithms, 0.25);
    Some((middle.exp(), scatter))
}

fn is_moving(known: &Known) -> bool {
    known.is_of_track && quantile(&known.speed(), 0.9) > MOVING
}

/// The velocity's columns, down last, if it is there.
fn vector(board: &mut FlightColumns, known: &mut Known, north: Id, east: Id) {
    let down = board.find_in(north.0, ColumnRole::Channel(ChannelName::GpsVelocityDown));
    let ids: Vec<Id> = [Some(north), Some(east), down]
        .into_iter()
        .flatten()
        .collect();
    if !is_moving(known) {
        return;
    }
    let of = |id: Id| known.grid.mean(&board.raw(id));
    let none = vec![f64::NAN; known.grid.count];
    let raw = [of(north), of(east), down.map_or(none.clone(), of)];
    let reference = [known.velocity[0].clone(), known.velocity[1].clone(), none];
    let fits = fits(&EARTH, &reference, &raw);
    let Some(best) = fits.first().copied() else {
        return;
    };
    // What names say is left where it agrees nearly as well.
    let is_named = !board.is_axis(north);
    let present = fits.iter().find(|fit| fit.axes == EARTH[0]).copied();
    let best = present
        .filter(|p| is_named && p.score > 0.8)
        .unwrap_or(best);
    let (n, e) = (&raw[0], &raw[1]);
    let size: Vec<f64> = n.iter().zip(e).map(|(n, e)| n.hypot(*e)).collect();
    let is_of_track = ratio(&known.speed(), &size).is_some_and(|(_, scatter)| scatter < 0.15);
    if is_of_track && best.score < if is_named { 0.5 } else { SURE } {
        // The attitude, which is not known yet, may turn it.
        for id in &ids {
            let why =
                "their amount is that of the track's velocity, but hardly along north and east";
            board.drop(*id, why);
        }
        known.turned = Some(TurnedVelocities { ids, earth: best });
        return;
    }
    along_earth(board, &ids, best);
}

/// Takes columns for the velocity over ground as far as they agree with it.
pub(super) fn along_earth(board: &mut FlightColumns, ids: &[Id], best: AxesFit) {
    let names = board.names(ids);
    let first = ids[0];
    if (0.5..0.8).contains(&best.score) {
        // The places are too uncertain to say; names that are letters of axes do not say it either.
        if board.is_axis(first) {
            board.tell(
                first.0,
                format!(
                    "{names}: the steps of the position agree with them in part only, along whatever axes; they are taken \
                     for those along {}",
                    EARTH[0].name
                ),
            );
        }
        return;
    }
    if best.score < 0.5 {
        let why = "they contradict the steps of the position";
        for id in ids {
            board.drop(*id, why);
        }
        board.tell(first.0, format!("{names}: {why}; not used"));
        return;
    }
    let roles = [
        ChannelName::GpsVelocityNorth,
        ChannelName::GpsVelocityEast,
        ChannelName::GpsVelocityDown,
    ];
    if best.axes != EARTH[0] {
        board.tell(
            first.0,
            format!(
                "{names}: their axes are {}, as the steps of the position say",
                best.axes.name
            ),
        );
    }
    for (axis, name) in roles.into_iter().enumerate() {
        if let Some(id) = ids.get(best.axes.order[axis]).copied() {
            let turned = best.axes.sign[axis]
                * if axis == 2 && best.axes == EARTH[0] {
                    board.column(id).scale
                } else {
                    1.0
                };
            board.assign(id, ColumnRole::Channel(name), turned, 0.0);
        }
    }
    board.settle_unit(ids, best.factor, TOLERANCE, "the steps of the position");
}

fn speed(board: &mut FlightColumns, known: &mut Known, id: Id) {
    if !is_moving(known) {
        return;
    }
    let raw = known.grid.mean(&board.raw(id));
    let Some((ratio, scatter)) = ratio(&known.speed(), &raw) else {
        return;
    };
    if scatter > 0.5 {
        // What is called so may be another speed, or the track too coarse to say.
        return;
    }
    board.settle_unit(&[id], ratio, TOLERANCE, "the steps of the position");
}

fn course(board: &mut FlightColumns, known: &mut Known, id: Id) {
    if !known.is_of_track || known.fast() < MOVING {
        return;
    }
    let reference = known.course();
    let spread = angles::spread(&reference);
    let conventions = [
        Convention::Compass,
        Convention::FromEast,
        Convention::Reverse,
    ];
    let readings = angles::readings(board, &known.grid, id, &reference, &conventions);
    let Some(best) = readings.first() else { return };
    let name = board.name(id);
    if best.score > 0.75 && (spread > 0.3 || best.off.abs() < 0.4) {
        let is_stated = board.basis(id) == UnitBasis::Stated;
        let before = board.column(id).unit.clone();
        best.apply(board, id, "the track's own direction");
        let stated = (is_stated && before != best.unit).then(|| {
            let dimension = Dimension::Angle;
            let factors =
                [before.as_str(), best.unit].map(|u| dimension.factor(Some(u)).unwrap_or(1.0));
            let times = factors[0] / factors[1];
            format!(
                "course and track differ by a factor of {:.0}; the table says {before}, it is read in {}",
                times.max(1.0 / times),
                best.unit
            )
        });
        best.tell(board, id, stated);
    } else if best.score < 0.4 && quantile(&known.speed(), 0.9) > 3.0 {
        board.drop(id, "it contradicts the track's own direction");
        board.tell(
            id.0,
            format!("{name}: course and track point in different directions, in whatever unit; it is not used"),
        );
    }
}

/// Takes the velocity that columns tell as the reference for all else, where there is no position.
fn without_track(board: &FlightColumns, known: &mut Known) {
    let values = |role| -> Option<TimedNumbers> { board.find(role).map(|id| board.values(id)) };
    let channel = |name| values(ColumnRole::Channel(name));
    let pair = channel(ChannelName::GpsVelocityNorth).zip(channel(ChannelName::GpsVelocityEast));
    if let Some((north, east)) = pair {
        known.velocity[0] = known.grid.mean(&north);
        known.velocity[1] = known.grid.mean(&east);
        return;
    }
    let speed = values(ColumnRole::SpeedOverGround).zip(values(ColumnRole::Course));
    if let Some((speed, course)) = speed {
        let speed = known.grid.mean(&speed);
        let course = known.grid.middle(&course.unwrapped());
        let along = |part: fn(f64) -> f64| {
            let pairs = speed.iter().zip(&course);
            pairs.map(|(speed, course)| speed * part(*course)).collect()
        };
        known.velocity[0] = along(f64::cos);
        known.velocity[1] = along(f64::sin);
    }
}

/// Sense of a velocity along an axis called z, by a height: 1 down, -1 up.
pub(super) fn sign_by_height(rate_of_height: &[f64], vertical: &[f64]) -> Option<f64> {
    let (correlation, ..) = compare(rate_of_height, vertical)?;
    (correlation.abs() > 0.5).then(|| -correlation.signum())
}
