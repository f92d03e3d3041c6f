//! Rows whose values were measured: with a fix, and beside fields that say so.

use super::places::FLAT_FIX;
use super::reader::{FULL_FIX, RowValue, reader};
use super::source::{conditions, sources};
use crate::log::{Log, Topic};
use crate::role::{Role, RoleSource, RowCondition};

/// Kind of fix that a role of a receiver needs; `None` of other roles.
fn needed_fix(role: Role) -> Option<f64> {
    match role {
        Role::Latitude
        | Role::Longitude
        | Role::GpsVelocityNorth
        | Role::GpsVelocityEast
        | Role::GroundSpeed => Some(FLAT_FIX),
        Role::GpsHeight | Role::GpsVelocityDown => Some(FULL_FIX),
        _ => None,
    }
}

/// Functions from a row of a topic to its latitude and longitude, for values of a receiver or of the autopilot's own place.
fn place_of<'a>(log: &Log, topic: &'a Topic, source: &RoleSource) -> Option<[RowValue<'a>; 2]> {
    let roles = match source.role {
        Role::AutopilotLatitude | Role::AutopilotLongitude | Role::AutopilotHeight => {
            [Role::AutopilotLatitude, Role::AutopilotLongitude]
        }
        role => needed_fix(role).map(|_| [Role::Latitude, Role::Longitude])?,
    };
    let part = |role| {
        let is_it = |s: &&RoleSource| s.role == role && s.topic == source.topic;
        let mut found = sources(log.format).filter(is_it);
        found
            .find_map(|source| reader(log, source, topic))
            .map(|(value, _)| value)
    };
    Some([part(roles[0])?, part(roles[1])?])
}

/// Numbers of the field of a condition that count in this log.
fn range(log: &Log, condition: &RowCondition) -> [f64; 2] {
    let [least, most] = condition.range;
    let is_own =
        |topic: &&Topic| topic.name.name == condition.topic || topic.kind() == condition.topic;
    let has_any = || {
        let mut values = log
            .topics
            .iter()
            .filter(is_own)
            .filter_map(|topic| topic.values(condition.field));
        values.any(|values| values.iter().any(|value| (least..=most).contains(value)))
    };
    match condition.stand_in {
        Some(stand_in) if !has_any() => [stand_in; 2],
        _ => [least, most],
    }
}

/// Function that tells of rows of a topic whether the values that `source` names there, in fields called `name`, were measured:
/// a receiver without a fix writes noughts, and range sensors may look elsewhere than down.
pub(super) fn is_measured<'a>(
    log: &'a Log,
    topic: &'a Topic,
    source: &RoleSource,
    name: &str,
) -> impl Fn(&[u8]) -> bool + use<'a> {
    let fix = needed_fix(source.role).and_then(|needed| {
        let is_fix = |s: &&RoleSource| s.role == Role::GpsFix && s.topic == source.topic;
        let mut fixes = sources(log.format).filter(is_fix);
        let (fix_of, _) = fixes.find_map(|fix| reader(log, fix, topic))?;
        // Old ones have no number above that of a fix.
        let says_full = || {
            let mut rows = topic.rows.iter();
            rows.any(|row| fix_of(row).is_some_and(|fix| fix >= FULL_FIX))
        };
        let needed = if needed > FLAT_FIX && !says_full() {
            FLAT_FIX
        } else {
            needed
        };
        Some((fix_of, needed))
    });
    let place = place_of(log, topic, source);
    let is_own = |topic_of: &str| topic_of == topic.name.name || topic_of == topic.kind();
    let conditions = conditions(log.format)
        .iter()
        .filter(|condition| is_own(condition.topic) && name.starts_with(condition.values));
    let fields: Vec<_> = conditions
        .filter_map(|condition| Some((topic.field(condition.field)?, range(log, condition))))
        .collect();
    move |row| {
        let is_fixed =
            |(fix_of, needed): &(RowValue<'a>, f64)| fix_of(row).is_none_or(|fix| fix >= *needed);
        let is_within = |(field, [least, most]): &(&crate::log::FieldLayout, [f64; 2])| {
            let value = field.value(row);
            value.is_none_or(|value| (*least..=*most).contains(&value))
        };
        // At 0° north, 0° east nobody has a receiver; who does not know, writes it.
        let is_nowhere =
            |place: &[RowValue<'a>; 2]| place.iter().all(|part| part(row) == Some(0.0));
        !place.as_ref().is_some_and(is_nowhere)
            && fix.as_ref().is_none_or(is_fixed)
            && fields.iter().all(is_within)
    }
}
