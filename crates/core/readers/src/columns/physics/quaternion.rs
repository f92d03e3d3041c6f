//! Quaternions: which part is which, and between which axes they turn.

use super::Known;
use super::angles::agreement;
use super::board::{FlightColumns, Id};
use super::grid::TimedNumbers;
use super::ros::{AHEAD, is_of_ros};
use super::{inertial, lean};
use crate::columns::attitude::attitude;
use crate::columns::groups::quaternion_roles;
use pilotage_base::sorting::sort;

/// Roll, pitch and heading of a quaternion, without jumps.
pub(super) fn angles(board: &FlightColumns, parts: [Id; 4], is_ros: bool) -> [TimedNumbers; 3] {
    let [w, x, y, z] = parts.map(|id| {
        let column = board.column(id);
        let (scale, offset) = (column.scale, column.offset);
        board.raw(id).map(|value| value * scale + offset)
    });
    let mut times = Vec::new();
    let mut angles = [Vec::new(), Vec::new(), Vec::new()];
    for (time, w) in w.times.iter().zip(&w.values) {
        if let Some(found) = attitude([*w, x.at(*time), y.at(*time), z.at(*time)], is_ros) {
            times.push(*time);
            for (values, angle) in angles.iter_mut().zip([found.roll, found.pitch, found.yaw]) {
                values.push(angle);
            }
        }
    }
    angles.map(|values| TimedNumbers::new(&times, values).unwrapped())
}

/// Finds which of four columns is the real part, and between which axes they turn.
pub(super) fn judge(board: &mut FlightColumns, known: &mut Known) {
    let parts = quaternion_roles(false).map(|role| board.find(role));
    let [Some(a), Some(b), Some(c), Some(d)] = parts else {
        return;
    };
    let table = a.0;
    let group = board.evidence[table].groups.iter();
    let is_told = group
        .filter(|g| g.is_told)
        .any(|g| g.columns.first() == Some(&a.1));
    let orders = [[a, b, c, d], [d, a, b, c]];
    let orders = &orders[..if is_told { 1 } else { 2 }];
    let Some(ways) = ways(board, known, orders) else {
        for id in [a, b, c, d] {
            board.drop(
                id,
                "their squares do not add up to one: they are no quaternion",
            );
        }
        return;
    };
    let (order, mut is_ros) = (ways[0].order, ways[0].is_ros);
    let names = board.names(&order);
    let other = ways
        .iter()
        .find(|way| way.order == order && way.is_ros != is_ros);
    let is_sure = other.is_none_or(|other| ways[0].score > other.score + 0.25);
    let place = if order[0] == a { "first" } else { "last" };
    let by_gravity = inertial::is_up_positive(board);
    let is_called = is_of_ros(&names);
    let why = if is_sure {
        "as the track says"
    } else if is_called {
        is_ros = true;
        "as columns of ROS are called"
    } else {
        is_ros = by_gravity.unwrap_or(false);
        "as gravity in the accelerations would have it"
    };
    board.tell(
        table,
        format!(
            "{names}: a quaternion, its real part {place}, {}, {why}",
            axes_in_words(is_ros)
        ),
    );
    if !is_sure && !is_called {
        super::questions::add(
            board,
            table,
            format!(
                "Does the quaternion {names} turn forward, right, down into north, east, down, or forward, left, up into east, north, up (ROS)? Taken: {}",
                axes_in_words(is_ros)
            ),
        );
    }
    known.is_ros = Some(is_ros);
    for (id, role) in order.into_iter().zip(quaternion_roles(is_ros)) {
        board.assign(id, role, 1.0, 0.0);
    }
}

/// A way to read four columns as a quaternion.
struct QuaternionReading {
    order: [Id; 4],
    is_ros: bool,
    /// Sum of the level attitude, the agreement of heading and course, and the lean in turns, each up to 1.
    score: f64,
}

/// Every way to read four columns as a quaternion, the best first; `None` if they are none.
fn ways(
    board: &FlightColumns,
    known: &Known,
    orders: &[[Id; 4]],
) -> Option<Vec<QuaternionReading>> {
    let course = known.course();
    let mut ways = Vec::new();
    for order in orders {
        for is_ros in [false, true] {
            let cells = angles(board, *order, is_ros).map(|s| known.grid.middle(&s));
            let [roll, pitch, yaw] = &cells;
            let level = roll.iter().zip(pitch).map(|(r, p)| r.cos() * p.cos());
            let level: Vec<f64> = level.filter(|v| v.is_finite()).collect();
            if level.len() < 8 {
                continue;
            }
            let level = level.iter().sum::<f64>() / level.len() as f64;
            let ahead = agreement(&course, yaw).map_or(0.0, |(cosine, _)| cosine);
            // Who flies elsewhere than it looks tells nothing by that.
            let ahead = if ahead > AHEAD { ahead } else { 0.0 };
            let leans = lean::agreement(known, [roll, pitch, yaw]).map_or(0.0, |(leans, _)| leans);
            ways.push(QuaternionReading {
                order: *order,
                is_ros,
                score: level + ahead + leans,
            });
        }
    }
    sort(&mut ways, &|a, b| b.score.total_cmp(&a.score));
    (!ways.is_empty()).then_some(ways)
}

fn axes_in_words(is_ros: bool) -> &'static str {
    if is_ros {
        "from axes forward, left, up to east, north, up"
    } else {
        "from axes forward, right, down to north, east, down"
    }
}
