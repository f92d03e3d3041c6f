//! Gyros against the change of attitude, accelerometers against gravity and the change of velocity.

use pilotage_flight::ChannelName;

use super::Known;
use super::axes::{AxesFit, AxisOrder, BODY, centred, compare, fits};
use super::board::{FlightColumns, Id, UnitBasis};
use super::grid::quantile;
use crate::cells::Dimension;
use crate::columns::ColumnRole;

const GRAVITY: f64 = 9.806_65;

/// Axes whose accelerations have the other sign: that which pulls instead of that which carries.
const PULLING: [AxisOrder; 2] = [
    AxisOrder {
        name: "forward, right, down with the sign of gravity",
        order: [0, 1, 2],
        sign: [-1.0, -1.0, -1.0],
    },
    AxisOrder {
        name: "forward, left, up with the sign of gravity",
        order: [0, 1, 2],
        sign: [-1.0, 1.0, 1.0],
    },
];

/// Judges gyros, then accelerometers.
pub(super) fn judge(board: &mut FlightColumns, known: &mut Known) {
    let gyros = [
        ChannelName::RollRate,
        ChannelName::PitchRate,
        ChannelName::YawRate,
    ];
    if let Some(ids) = triple(board, gyros) {
        in_one_unit(board, ids);
    }
    let found = triple(board, gyros).and_then(|ids| rates(board, known, ids));
    if let Some(ids) = triple(board, gyros).filter(|ids| found.is_none() && of_phone(board, *ids)) {
        leave_out(board, ids);
    }
    let accelerations = [
        ChannelName::AccelerationForward,
        ChannelName::AccelerationRight,
        ChannelName::AccelerationDown,
    ];
    if let Some(ids) = triple(board, accelerations) {
        acceleration(board, known, ids, found);
    }
}

/// Reads the axes of one sensor in one unit where none is stated: the smallest, which numbers too great for the others ask for.
fn in_one_unit(board: &mut FlightColumns, ids: [Id; 3]) {
    if ids.iter().any(|id| board.basis(*id) != UnitBasis::Assumed) {
        return;
    }
    let size = |id: &Id| {
        let factor = Dimension::AngularRate.factor(Some(&board.column(*id).unit));
        factor.unwrap_or(f64::INFINITY)
    };
    let smallest = ids.into_iter().min_by(|a, b| size(a).total_cmp(&size(b)));
    let Some(unit) = smallest.map(|id| board.column(id).unit.clone()) else {
        return;
    };
    for id in ids {
        board.maps[id.0].columns[id.1].unit.clone_from(&unit);
    }
}

/// The columns of three channels in one table.
pub(super) fn triple(board: &FlightColumns, names: [ChannelName; 3]) -> Option<[Id; 3]> {
    let first = board.find(ColumnRole::Channel(names[0]))?;
    let [_, second, third] = names.map(|name| board.find_in(first.0, ColumnRole::Channel(name)));
    Some([first, second?, third?])
}

/// Whether gravity in the accelerations says that the third axis points up; `None` where it does not say.
pub(super) fn is_up_positive(board: &FlightColumns) -> Option<bool> {
    let ids = triple(
        board,
        [
            ChannelName::AccelerationForward,
            ChannelName::AccelerationRight,
            ChannelName::AccelerationDown,
        ],
    )?;
    let down = quantile(&board.raw(ids[2]).values, 0.5);
    let size = quantile(&norms(board, ids), 0.5);
    (down.abs() > 0.7 * size).then_some(down > 0.0)
}

fn norms(board: &FlightColumns, ids: [Id; 3]) -> Vec<f64> {
    let [x, y, z] = ids.map(|id| board.raw(id).values);
    let pairs = x.iter().zip(&y).zip(&z);
    pairs
        .map(|((x, y), z)| (x * x + y * y + z * z).sqrt())
        .collect()
}

/// The sign of pitch, `values` per cell, by what the accelerometer along the nose reads: gravity · sin(pitch), and the
/// change of speed. `None` where its own sign is not sure.
pub(super) fn sign_of_pitch(board: &FlightColumns, known: &Known, values: &[f64]) -> Option<f64> {
    // Forward is forward whatever the other axes, unless gravity is counted as positive down: then all is turned.
    if is_up_positive(board)? {
        return None;
    }
    let forward = board.find(ColumnRole::Channel(ChannelName::AccelerationForward))?;
    let felt = known.grid.mean(&board.values(forward));
    let (correlation, ..) = compare(&centred(&felt), &centred(values))?;
    (correlation.abs() > 0.5).then(|| correlation.signum())
}

/// Rates of turn about the body's axes per cell, by attitude, rad/s; NaN where that is not known.
fn body_rates(known: &Known) -> [Vec<f64>; 3] {
    let [roll, pitch, _] = &known.attitude;
    let [roll_rate, pitch_rate, heading_rate] = &known.attitude_rates;
    let has_tilt = roll.iter().any(|v| v.is_finite());
    let rates = |index: usize| {
        let (p, t) = (roll[index], pitch[index]);
        let (dp, dt, dh) = (roll_rate[index], pitch_rate[index], heading_rate[index]);
        if has_tilt {
            [
                dp - dh * t.sin(),
                dt * p.cos() + dh * t.cos() * p.sin(),
                -dt * p.sin() + dh * t.cos() * p.cos(),
            ]
        } else {
            [f64::NAN, f64::NAN, dh]
        }
    };
    let cells: Vec<[f64; 3]> = (0..known.grid.count).map(rates).collect();
    [0, 1, 2].map(|axis| cells.iter().map(|cell| cell[axis]).collect())
}

/// Rates of turn of the course, where there is no heading.
pub(super) fn course_rate(known: &Known) -> Vec<f64> {
    let course = known.course();
    let mut rates = vec![f64::NAN; course.len()];
    for index in 1..course.len().saturating_sub(1) {
        let change = pilotage_base::frames::wrap_pi(course[index + 1] - course[index - 1]);
        rates[index] = change / (2.0 * known.grid.step);
    }
    rates
}

fn rates(board: &mut FlightColumns, known: &Known, ids: [Id; 3]) -> Option<AxesFit> {
    let mut reference = body_rates(known);
    if reference[2].iter().all(|v| !v.is_finite()) {
        reference[2] = course_rate(known);
    }
    let reference = reference.map(|part| centred(&part));
    let raw = ids.map(|id| centred(&known.grid.mean(&board.raw(id))));
    let fits = fits(&BODY, &reference, &raw);
    let best = *fits.first()?;
    let names = board.names(&ids);
    if best.score < 0.5 {
        return None;
    }
    place(
        board,
        ids,
        best.axes,
        [
            ChannelName::RollRate,
            ChannelName::PitchRate,
            ChannelName::YawRate,
        ],
    );
    if best.axes != BODY[0] {
        board.tell(
            ids[0].0,
            format!(
                "{names}: their axes are {}, as the change of attitude says",
                best.axes.name
            ),
        );
    }
    // Noise makes gyros look larger than attitude; units differ by ten at least.
    board.settle_unit(&ids, best.factor, 0.9, "the change of attitude");
    Some(best)
}

/// Has three columns mean what their axes say.
fn place(board: &mut FlightColumns, ids: [Id; 3], axes: AxisOrder, names: [ChannelName; 3]) {
    for (axis, name) in names.into_iter().enumerate() {
        let id = ids[axes.order[axis]];
        board.assign(id, ColumnRole::Channel(name), axes.sign[axis], 0.0);
    }
}

fn acceleration(
    board: &mut FlightColumns,
    known: &mut Known,
    ids: [Id; 3],
    gyros: Option<AxesFit>,
) {
    let names = board.names(&ids);
    let size = quantile(&norms(board, ids), 0.5);
    if size.is_nan() || size <= 0.0 {
        return;
    }
    let near = super::board::nearest(Dimension::Acceleration, GRAVITY / size);
    if near.is_none_or(|(_, off)| off.abs() > 0.3) {
        for id in ids {
            board.drop(id, "gravity is not in it in any unit");
        }
        board.tell(
            ids[0].0,
            format!("{names}: gravity is not in them in any unit (their amount is {size:.3} in the middle); they are not used"),
        );
        return;
    }
    board.settle_unit(&ids, GRAVITY / size, 0.3, "gravity");
    let is_up = is_up_positive(board);
    let all: Vec<AxisOrder> = BODY.into_iter().chain(PULLING).collect();
    let allowed: Vec<AxisOrder> = all
        .into_iter()
        .filter(|axes| is_up.is_none_or(|up| up == (axes.sign[2] < 0.0)))
        .collect();
    let raw = ids.map(|id| centred(&known.grid.mean(&board.raw(id))));
    let fits = fits(&allowed, &felt(known).map(|part| centred(&part)), &raw);
    let by_motion = fits.first().copied().filter(|best| {
        let rival = fits
            .iter()
            .find(|fit| fit.axes.sign[0] != best.axes.sign[0] || fit.axes.order != best.axes.order);
        best.score > 0.4 && rival.is_none_or(|rival| best.score > rival.score + 0.2)
    });
    if by_motion.is_none() && of_phone(board, ids) {
        leave_out(board, ids);
        return;
    }
    let is_named_ros = super::ros::is_of_ros(&names);
    let beside = gyros.filter(|_| {
        let gyro = board.find(ColumnRole::Channel(ChannelName::RollRate));
        gyro.is_some_and(|gyro| gyro.0 == ids[0].0)
    });
    let chosen = match (by_motion, is_up) {
        (Some(fit), _) => Some((fit.axes, "as the change of velocity says")),
        (None, Some(false)) => Some((BODY[0], "as gravity says")),
        (None, Some(true)) => match beside {
            Some(gyros) if gyros.axes.sign[2] > 0.0 && gyros.axes.order == BODY[0].order => {
                Some((PULLING[0], "as gravity and gyros say"))
            }
            Some(gyros) => Some((gyros.axes, "as gravity and gyros say")),
            None if is_named_ros || known.is_ros == Some(true) => {
                Some((BODY[1], "as gravity and ROS say"))
            }
            None => None,
        },
        (None, None) => None,
    };
    let roles = [
        ChannelName::AccelerationForward,
        ChannelName::AccelerationRight,
        ChannelName::AccelerationDown,
    ];
    match chosen {
        Some((axes, why)) => {
            place(board, ids, axes, roles);
            if axes != BODY[0] {
                board.tell(
                    ids[0].0,
                    format!("{names}: their axes are {}, {why}", axes.name),
                );
            }
        }
        None if is_up == Some(true) => {
            place(board, ids, BODY[1], roles);
            super::questions::add(
                board,
                ids[0].0,
                format!(
                    "{names}: the third is positive at rest. Are the axes forward, left, up, or forward, right, down with the other sign? The first was taken"
                ),
            );
        }
        None => {}
    }
    if let Some(is_up) = is_up.filter(|_| gyros.is_none()) {
        gyros_beside(board, ids, is_up);
    }
}

/// Parts of the names of columns, in small letters, that phones have, and a whole name without its unit. One part alone others
/// have as well.
const PROXIMITY: &str = "proximity";
const OF_PHONES: [&str; 10] = [
    "gravity x",
    "gravity y",
    "motiongravityx",
    "motiongravityy",
    "motionuseracceleration",
    PROXIMITY,
    "sound level",
    "light (lux",
    "decibel",
    "locationtimestamp",
];

/// Whether the table of these columns is a phone's, which lies or hangs in the aircraft anyhow.
fn of_phone(board: &FlightColumns, ids: [Id; 3]) -> bool {
    let columns = board.maps[ids[0].0].columns.iter();
    let names: Vec<String> = columns.map(|column| column.name.to_lowercase()).collect();
    let is_near = |name: &String| {
        let mut parts = name.split(['(', '[']);
        parts.next().is_some_and(|word| word.trim() == PROXIMITY)
    };
    let has = |part: &&&str| names.iter().any(|name| name.contains(**part));
    names.iter().any(is_near) || OF_PHONES.iter().filter(has).count() > 1
}

/// Takes their meaning from sensors of a phone whose axes are not those of the aircraft.
fn leave_out(board: &mut FlightColumns, ids: [Id; 3]) {
    let names = board.names(&ids);
    for id in ids {
        board.drop(id, "a phone measured it, along axes of its own");
    }
    board.tell(
        ids[0].0,
        format!(
            "{names}: a phone measured them, and they do not go as the aircraft's motion does along any axes: they are not used"
        ),
    );
}

/// Gyros that nothing else tells of keep the axes of the accelerometers in their table.
fn gyros_beside(board: &mut FlightColumns, ids: [Id; 3], is_up: bool) {
    let names = [
        ChannelName::RollRate,
        ChannelName::PitchRate,
        ChannelName::YawRate,
    ];
    let Some(gyros) = triple(board, names).filter(|g| g[0].0 == ids[0].0 && is_up) else {
        return;
    };
    let forward = board.column(ids[0]).scale;
    if forward > 0.0 && board.is_axis(gyros[0]) {
        place(board, gyros, BODY[1], names);
        let words = board.names(&gyros);
        board.tell(
            gyros[0].0,
            format!("{words}: taken for the axes of the accelerometers beside them"),
        );
    }
}

/// Readings of accelerometers along forward, right and down, per cell, as attitude and change of velocity give them,
/// m/s².
fn felt(known: &Known) -> [Vec<f64>; 3] {
    let count = known.grid.count;
    let change = |values: &[f64], index: usize| {
        if index == 0 || index + 1 >= count {
            return f64::NAN;
        }
        (values[index + 1] - values[index - 1]) / (2.0 * known.grid.step)
    };
    let cell = |index: usize| {
        let [north, east, down] = [0, 1, 2].map(|axis| change(&known.velocity[axis], index));
        let down = if down.is_finite() { down } else { 0.0 };
        let [roll, pitch, heading] = [0, 1, 2].map(|axis| known.attitude[axis][index]);
        let turn = nalgebra::Rotation3::from_euler_angles(roll, pitch, heading);
        let force = turn.inverse() * nalgebra::Vector3::new(north, east, down - GRAVITY);
        [force.x, force.y, force.z]
    };
    let cells: Vec<[f64; 3]> = (0..count).map(cell).collect();
    [0, 1, 2].map(|axis| cells.iter().map(|cell| cell[axis]).collect())
}
