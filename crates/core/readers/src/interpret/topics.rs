//! Topics in which a role may be found, the best first.

use super::places::FLAT_FIX;
use super::source::sources;
use crate::log::{Log, LogFormat, Topic, first_word, system_of};
use crate::role::{Role, RoleSource, RowReading};

/// Messages of a second receiver that are of a kind of their own, behind those of the first.
const SECOND_RECEIVERS: [(&str, &str); 2] = [("GPS", "GPS2"), ("GPS_RAW_INT", "GPS2_RAW")];

/// Words of topics that say where the vehicle shall go, or are of a camera, whose axes are its own.
const ELSEWHERE: [&str; 8] = [
    "setpoint",
    "target",
    "goal",
    "desired",
    "reference",
    "cmd",
    "camera",
    "gimbal",
];

/// Topics that `source` names: those of that name, or else all of that kind; where several vehicles fly, that of the
/// chosen one. Of several sensors the first, but a receiver with a fix before one that never has any.
pub(super) fn topics<'a>(log: &'a Log, source: &RoleSource) -> Vec<&'a Topic> {
    let chosen = log.chosen_vehicle();
    let named = |name: &str| -> Vec<&'a Topic> {
        let is_own = |topic: &&Topic| {
            topic.name.name == name
                && (chosen.is_none() || topic.name.instance.map(system_of) == chosen)
        };
        let mut own: Vec<&'a Topic> = log.topics.iter().filter(is_own).collect();
        if chosen.is_some() || log.format == LogFormat::Tlog {
            // Those of the autopilot before those of other components.
            own.sort_by_key(|topic| topic.name.instance != chosen);
            own.truncate(1);
        }
        own
    };
    let mut same = named(source.topic);
    let second = SECOND_RECEIVERS
        .iter()
        .find(|(first, _)| *first == source.topic);
    let is_lost = |topic: &&Topic| never_has_fix(log, topic, source.topic);
    if let Some((_, second)) = second.filter(|_| same.iter().all(is_lost)) {
        same.extend(named(second));
    }
    if same.len() > 1 {
        same.sort_by_cached_key(|topic| {
            let is_second = topic.name.name != source.topic;
            (is_lost(topic), is_second, topic.name.instance)
        });
    }
    if !same.is_empty() || chosen.is_some() {
        return same;
    }
    let (kind, part) = source.topic.split_once('@').unwrap_or((source.topic, ""));
    let is_it = |topic: &&Topic| {
        let name = topic.name.name.to_lowercase();
        let is_elsewhere = ELSEWHERE.iter().any(|word| name.contains(word));
        topic.kind() == kind && topic.name.name.contains(part) && !is_elsewhere
    };
    log.topics.iter().filter(is_it).collect()
}

        if others.contains(&first_word(&topic.name.name)) {
            return false;
        }
/// Whether a topic is that of a receiver, with the fields of the topic `like`, that never knows where it is.
fn never_has_fix(log: &Log, topic: &Topic, like: &str) -> bool {
    let is_fix = |s: &&RoleSource| s.role == Role::GpsFix && s.topic == like;
    let mut fixes = sources(log.format).filter(is_fix);
    fixes.any(|source| match source.reading {
        RowReading::Field(name, _) => {
            let values = topic.values(name);
            values.is_some_and(|values| values.iter().all(|fix| *fix < FLAT_FIX))
        }
        _ => false,
    })
}
