//! Velocities along the body's axes, told by what the attitude makes of the track's velocity.

use nalgebra::{Rotation3, Vector3};
use pilotage_flight::ChannelName;

use super::Known;
use super::axes::{AxesFit, BODY, fits};
use super::board::{FlightColumns, Id};
use super::known::TurnedVelocities;
use super::velocity::{TOLERANCE, along_earth};
use crate::columns::{BodyAxis, ColumnRole};

/// Mean correlation along the axes from which on they are the body's.
const ALIKE: f64 = 0.8;
/// Least lead of the mean correlation along the body's axes over that along north and east.
const BETTER: f64 = 0.1;
/// Channels that the columns were taken for by their names.
const NAMES: [ChannelName; 3] = [
    ChannelName::GpsVelocityNorth,
    ChannelName::GpsVelocityEast,
    ChannelName::GpsVelocityDown,
];

/// Reads a velocity that is that of the track, but not along north and east, along the body's axes, if it is.
pub(super) fn judge(board: &mut FlightColumns, known: &Known) {
    let Some(TurnedVelocities { ids, earth }) = &known.turned else {
        return;
    };
    let first = ids[0];
    let names = board.names(ids);
    let none = vec![f64::NAN; known.grid.count];
    let of = |index: usize| {
        let id = ids.get(index);
        id.map_or_else(|| none.clone(), |id| known.grid.mean(&board.raw(*id)))
    };
    let raw = [of(0), of(1), of(2)];
    let reference = along_body(known);
    let best = fits(&BODY, &reference, &raw).first().copied();
    let is_better = |best: &AxesFit| best.score > ALIKE && best.score > earth.score + BETTER;
    let Some(best) = best.filter(is_better) else {
        if earth.score >= 0.5 {
            for (id, name) in ids.iter().zip(NAMES) {
                let why = "their amount is that of the track's velocity";
                board.take(*id, ColumnRole::Channel(name), "m/s", why);
                board.assign(*id, ColumnRole::Channel(name), 1.0, 0.0);
            }
            along_earth(board, ids, *earth);
            return;
        }
        let why = "their amount is that of the track's velocity, but neither north and east nor the attitude's axes are \
                   theirs";
        board.tell(first.0, format!("{names}: {why}; not used"));
        return;
    };
    let mut found: Vec<Id> = Vec::new();
    for (axis, role) in BodyAxis::ALL.into_iter().enumerate() {
        if let Some(id) = ids.get(best.axes.order[axis]) {
            let why = "the attitude turns the track's velocity to it";
            board.take(*id, ColumnRole::BodyVelocity(role), "m/s", why);
            board.assign(
                *id,
                ColumnRole::BodyVelocity(role),
                best.axes.sign[axis],
                0.0,
            );
            found.push(*id);
        }
    }
    board.tell(
        first.0,
        format!(
            "{names}: they are along the body's axes ({}); the attitude turns them to north and east",
            best.axes.name
        ),
    );
    board.settle_unit(&found, best.factor, TOLERANCE, "the steps of the position");
}

/// The track's velocity along forward, right and down per cell, m/s; NaN where the attitude is not known. Where nothing
/// tells roll and pitch the aircraft counts as level, and where nothing tells the climb as climbing nowhere.
fn along_body(known: &Known) -> [Vec<f64>; 3] {
    let or_zero = |value: f64| if value.is_finite() { value } else { 0.0 };
    let cell = |index: usize| {
        let [north, east, down] = [0, 1, 2].map(|axis| known.velocity[axis][index]);
        let [roll, pitch, heading] = [0, 1, 2].map(|axis| known.attitude[axis][index]);
        let world_from_body = Rotation3::from_euler_angles(or_zero(roll), or_zero(pitch), heading);
        let along = world_from_body.inverse() * Vector3::new(north, east, or_zero(down));
        [along.x, along.y, along.z]
    };
    let cells: Vec<[f64; 3]> = (0..known.grid.count).map(cell).collect();
    [0, 1, 2].map(|axis| cells.iter().map(|cell| cell[axis]).collect())
}
