//! Topics in which a role may be found, the best first.

use super::places::FLAT_FIX;
use super::source::sources;
use crate::log::{Log, LogFormat, Topic, first_word, system_of};
use crate::role::{Role, RoleSource, RowReading};

/// Messages of a second receiver that are of a kind of their own, behind those of the first.
const SECOND_RECEIVERS: [(&str, &str); 2] = [("GPS", "GPS2"), ("GPS_RAW_INT", "GPS2_RAW")];

/// Share of the fixes of the best receiver that another has that is taken before it for its place.
const OFTEN: f64 = 0.8;

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
/// chosen one. Of several sensors the first, but a receiver that mostly has a fix before one that has it much more seldom.
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
    if let Some((_, second)) = second {
        same.extend(named(second));
    }
    if same.len() > 1 {
        let fixes = |topic: &Topic| fixes(log, topic, source.topic).unwrap_or(0);
        let most = same.iter().map(|topic| fixes(topic)).max().unwrap_or(0);
        same.sort_by_cached_key(|topic| {
            let is_second = topic.name.name != source.topic;
            let is_seldom = (fixes(topic) as f64) < OFTEN * most as f64;
            (is_seldom, is_second, topic.name.instance)
        });
    }
    if !same.is_empty() || chosen.is_some() {
        return same;
    }
    let (kind, part) = source.topic.split_once('@').unwrap_or((source.topic, ""));
    let others = log.vehicles_by_name();
    let others = others.get(1..).unwrap_or_default();
    let is_it = |topic: &&Topic| {
        if others.contains(&first_word(&topic.name.name)) {
            return false;
        }
        let name = topic.name.name.to_lowercase();
        let is_elsewhere = ELSEWHERE.iter().any(|word| name.contains(word));
        topic.kind() == kind && topic.name.name.contains(part) && !is_elsewhere
    };
    log.topics.iter().filter(is_it).collect()
}

/// Number of rows of a receiver's topic, with the fields of the topic `like`, in which it knows where it is; `None` of topics that
/// tell no fix.
fn fixes(log: &Log, topic: &Topic, like: &str) -> Option<usize> {
    let is_fix = |s: &&RoleSource| s.role == Role::GpsFix && s.topic == like;
    let mut fixes = sources(log.format).filter(is_fix);
    fixes.find_map(|source| match source.reading {
        RowReading::Field(name, _) => {
            let values = topic.values(name)?;
            Some(values.iter().filter(|fix| **fix >= FLAT_FIX).count())
        }
        _ => None,
    })
}
