//! The series of a role, read from the log.

use super::places::FLAT_FIX;
use super::reader::reader;
use super::rows::is_measured;
use super::source::sources;
use super::topics::{Nearness, topics};
use crate::log::{Log, Topic, TopicName};
use crate::role::{Role, RoleSeries, RoleSource};

/// Height, metres, that no aircraft climbs within a time, seconds: it is a leap.
const HEIGHT_LEAP: f64 = 20.0;
const LEAP_TIME: f64 = 2.0;

/// The series that `source` names in a topic, or `None` if it has no such fields or no row of them.
fn read(log: &Log, topic: &Topic, source: &RoleSource) -> Option<RoleSeries> {
    if topic.is_empty() {
        return None;
    }
    let (value_of, name) = reader(log, source, topic)?;
    let is_this = |(of, field): &(TopicName, String)| *of == topic.name && *field == name;
    if log.not_measured.iter().any(is_this) {
        return None;
    }
    let is_measured = is_measured(log, topic, source, &name);
    let samples = topic.times.iter().zip(topic.rows.iter());
    let samples = samples.filter(|(_, row)| is_measured(row));
    let samples = samples.map(|(time, row)| (*time, value_of(row)));
    let name = format!("{}.{name}", topic.name);
    let mut series = RoleSeries::new(source.role, name, samples);
    if source.role == Role::BarometricHeight {
        leave_out_noughts(&mut series);
    }
    (!series.times.is_empty()).then_some(series)
}

/// Leaves out noughts that a height begins with, where the next one is far from them a moment later: an autopilot writes them
/// until its estimate has an origin.
fn leave_out_noughts(series: &mut RoleSeries) {
    let count = series.values.iter().take_while(|v| **v == 0.0).count();
    let (Some(last), Some(next)) = (count.checked_sub(1), series.values.get(count)) else {
        return;
    };
    let step = series.times[count] - series.times[last];
    if next.abs() > HEIGHT_LEAP && step < LEAP_TIME {
        series.times.drain(..count);
        series.values.drain(..count);
    }
}

/// Whether a series says anything: a sensor that is not there often logs one number for ever.
fn is_alive(series: &RoleSeries) -> bool {
    let first = series.values[0];
    let counts = matches!(series.role, Role::GpsFix | Role::GpsSatellites);
    counts || series.values.iter().any(|v| *v != first)
}

/// The series of a role: as it was given, else from the best place that says anything, else from the best that is
/// there. A place with its height is the autopilot's own where no receiver with a fix is logged.
///
/// ```
/// # use pilotage_readers::bytes::MemoryBytes;
/// use pilotage_readers::interpret::{Role, series};
/// use pilotage_readers::log::read_log;
///
/// let text = "FMT, 1, 13, ATT, Qc, TimeUS,Yaw\nATT, 1000000, 90.0\nATT, 1500000, 180.0\n";
/// let log = read_log(&MemoryBytes::new("flight.log", text.as_bytes()))?.ok_or("no log")?;
/// let heading = series(&log, Role::Heading).ok_or("no heading")?;
/// assert_eq!(heading.source, "ATT.Yaw");
/// assert!((heading.values[0] - std::f64::consts::FRAC_PI_2).abs() < 1e-9);
/// # Ok::<(), String>(())
/// ```
pub fn series(log: &Log, role: Role) -> Option<RoleSeries> {
    if let Some(given) = log.given.iter().find(|given| given.role == role) {
        return Some(given.clone());
    }
    let found = measured(log, role);
    // Where no receiver knows where it is, the autopilot's own place is what there is: of all roles of a place alike.
    let Some(own) = role.autopilots_own() else {
        return found;
    };
    if found.is_some() && !is_lost(log) {
        return found;
    }
    let own = series(log, own).map(|own| RoleSeries { role, ..own });
    own.or(found)
}

/// The series of a role from the best place that says anything, else from the best that is there; from a camera only where nothing
/// else is there.
fn measured(log: &Log, role: Role) -> Option<RoleSeries> {
    let mut dead = None;
    for near in Nearness::ALL {
        if near == Nearness::Camera && dead.is_some() {
            break;
        }
        for source in sources(log.format).filter(|s| s.role == role) {
            let topics = topics(log, source, near).into_iter();
            for found in topics.filter_map(|topic| read(log, topic, source)) {
                if is_alive(&found) {
                    return Some(found);
                }
                dead.get_or_insert(found);
            }
        }
    }
    dead
}

/// Whether the receiver never knows where it is: it never has a fix, or its places are noughts, or none.
fn is_lost(log: &Log) -> bool {
    let fix = series(log, Role::GpsFix);
    if fix.is_some_and(|fix| fix.values.iter().all(|fix| *fix < FLAT_FIX)) {
        return true;
    }
    let tells_nothing = |role| {
        let found = measured(log, role);
        found.is_none_or(|found| found.values.iter().all(|value| *value == 0.0))
    };
    tells_nothing(Role::Latitude) && tells_nothing(Role::Longitude)
}
