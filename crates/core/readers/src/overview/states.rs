//! Flying and landed, as the autopilot itself says.

use super::super::interpret::RoleSeries;
use super::{Finding, Severity};
use crate::log::{Log, Topic};
use pilotage_flight::moment;

/// Shortest stretch that counts, seconds.
const LEAST: f64 = 3.0;
/// Pause on the ground from which on two flights are two, seconds.
const PAUSE: f64 = 5.0;

/// Events of `ArduPilot` that say so, by their numbers: not landed; landed, disarmed.
const TAKE_OFF: f64 = 28.0;
const DOWN: [f64; 2] = [18.0, 11.0];

/// Function from a value to whether it says flying, if it says anything.
type Says = fn(f64) -> Option<bool>;

/// Fields in which logs say whether they fly: topic, field, and the meaning of a value there.
const STATES: [(&str, &str, Says); 4] = [
    ("EV", "Id", by_event),
    ("vehicle_land_detected", "landed", |landed| {
        Some(landed == 0.0)
    }),
    // On the ground 1; in the air, taking off, landing 2 to 4; nobody knows 0.
    ("EXTENDED_SYS_STATE", "landed_state", |state| {
        (state > 0.0).then_some(state > 1.0)
    }),
    ("STAT", "isFlying", |flying| Some(flying != 0.0)),
];

fn by_event(id: f64) -> Option<bool> {
    if id == TAKE_OFF {
        Some(true)
    } else {
        DOWN.contains(&id).then_some(false)
    }
}

/// Stretches in the air as the autopilot says, seconds in the log's time base; `None` if it does not, or never says that
/// it flew.
pub fn airborne(log: &Log) -> Option<Vec<(f64, f64)>> {
    let (_, end) = log.span()?;
    STATES.into_iter().find_map(|(topic, field, says)| {
        let stretches = stretches(log.first(topic)?, field, says, end);
        (!stretches.is_empty()).then_some(stretches)
    })
}

fn stretches(topic: &Topic, field: &str, says: Says, end: f64) -> Vec<(f64, f64)> {
    let Some(layout) = topic.field(field) else {
        return Vec::new();
    };
    let states = topic.times.iter().enumerate();
    let states =
        states.filter_map(|(index, time)| Some((*time, says(topic.value(layout, index)?)?)));
    let mut found = Vec::new();
    let mut since = None;
    for (time, is_flying) in states {
        match (since, is_flying) {
            (None, true) => since = Some(time),
            (Some(from), false) => {
                found.push((from, time));
                since = None;
            }
            _ => {}
        }
    }
    found.extend(since.map(|from| (from, end)));
    found.retain(|(from, to)| to - from >= LEAST);
    found
}

/// Whether rows were close together for most of a time, seconds: what nobody looked at, such as the minutes between two
/// photos, need not have been spent on the ground.
pub fn is_watched(found: &[RoleSeries], (from, to): (f64, f64)) -> bool {
    let watched = |series: &RoleSeries| {
        let steps = series.times.windows(2);
        let close = steps.filter(|step| step[1] - step[0] <= PAUSE);
        close
            .map(|step| (step[1].min(to) - step[0].max(from)).max(0.0))
            .sum::<f64>()
    };
    found
        .iter()
        .any(|series| watched(series) > 0.5 * (to - from))
}

/// That a log holds several flights, with their times and modes; `is_known` tells of a time between two whether it is
/// known that it was not flown in.
pub fn several(
    log: &Log,
    airborne: &[(f64, f64)],
    is_known: impl Fn((f64, f64)) -> bool,
) -> Option<Finding> {
    let mut flights: Vec<(f64, f64)> = Vec::new();
    for (from, to) in airborne {
        match flights.last_mut() {
            Some(last) if from - last.1 < PAUSE || !is_known((last.1, *from)) => last.1 = *to,
            _ => flights.push((*from, *to)),
        }
    }
    if flights.len() < 2 {
        return None;
    }
    let each = flights.iter().map(|(from, to)| {
        let modes = modes(log, *from, *to);
        let modes = if modes.is_empty() {
            String::new()
        } else {
            format!(" ({})", modes.join(", "))
        };
        format!("from {} to {}{modes}", moment(*from), moment(*to))
    });
    Some(Finding {
        severity: Severity::Note,
        title: format!("{} flights in one log", flights.len()),
        text: format!("It was in the air {}.", each.collect::<Vec<_>>().join(", ")),
        span: flights.first().copied(),
    })
}

/// The modes that were flown between two times, in their order, each once.
pub fn modes(log: &Log, from: f64, to: f64) -> Vec<&str> {
    let mut modes: Vec<&str> = Vec::new();
    let before = log.modes.iter().rev().find(|change| change.time <= from);
    let within = log
        .modes
        .iter()
        .filter(|change| change.time > from && change.time <= to);
    for change in before.into_iter().chain(within) {
        if !modes.contains(&change.mode.as_str()) {
            modes.push(&change.mode);
        }
    }
    modes
}
