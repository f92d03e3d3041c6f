//! Topics in which a role may be found, the best first.

use super::places::FLAT_FIX;
use super::source::sources;
use crate::log::{Log, Topic, TopicSubject, first_word, is_component, subject, system_of};
use crate::role::{Role, RoleSource, RowReading};

/// Messages of a second receiver that are of a kind of their own, behind those of the first.
const SECOND_RECEIVERS: [(&str, &str); 2] = [("GPS", "GPS2"), ("GPS_RAW_INT", "GPS2_RAW")];

/// Share of the time with a fix of the best receiver that another has that is taken before it for its place.
const OFTEN: f64 = 0.8;

/// Longest time for which a fix counts until the next row, seconds.
const LONGEST: f64 = 10.0;

/// Nearness of topics to the vehicle: others count for a role where the nearer ones tell nothing of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Nearness {
    /// Those of the vehicle.
    Own,
    /// Other sets of its instruments.
    OtherInstruments,
    /// A camera's.
    Camera,
}

impl Nearness {
    /// From the nearest on.
    pub const ALL: [Self; 3] = [Self::Own, Self::OtherInstruments, Self::Camera];
}

/// Topics that `source` names: those of that name, or else all of that kind; where several vehicles fly, that of the
/// chosen one. Of several sensors the first, but a receiver that mostly has a fix before one that has it much more seldom.
/// Those of that nearness alone.
pub(super) fn topics<'a>(log: &'a Log, source: &RoleSource, near: Nearness) -> Vec<&'a Topic> {
    let same = if near == Nearness::Own {
        named_topics(log, source)
    } else {
        Vec::new()
    };
    if !same.is_empty() || log.chosen_vehicle().is_some() {
        return same;
    }
    let (kind, part) = source.topic.split_once('@').unwrap_or((source.topic, ""));
    let is_kind = |topic: &&Topic| {
        let is_typed = !topic.schema.is_empty() && topic.name.name.contains(part);
        is_typed && topic.kind() == kind
    };
    let mut found: Vec<&'a Topic> = log.topics.iter().filter(is_kind).collect();
    if found.is_empty() {
        return found;
    }
    let sets = log.sets_by_name().unwrap_or_default();
    found.retain(|topic| {
        let set = first_word(&topic.name.name);
        match subject(&topic.name.name) {
            _ if sets.vehicles.contains(&set) => false,
            TopicSubject::Vehicle if sets.instruments.contains(&set) => {
                near == Nearness::OtherInstruments
            }
            TopicSubject::Vehicle => near == Nearness::Own,
            TopicSubject::Camera => near == Nearness::Camera,
            TopicSubject::Other => false,
        }
    });
    found
}

/// Topics of the very name that `source` says.
fn named_topics<'a>(log: &'a Log, source: &RoleSource) -> Vec<&'a Topic> {
    let chosen = log.chosen_vehicle();
    let named = |name: &str| -> Vec<&'a Topic> {
        let is_own = |topic: &&Topic| {
            topic.name.name == name
                && (chosen.is_none() || topic.name.instance.map(system_of) == chosen)
        };
        let mut own: Vec<&'a Topic> = log.topics.iter().filter(is_own).collect();
        if chosen.is_some() || log.format.meaning().has_systems {
            // Those of the autopilot before those of other components.
            let of_component = |topic: &Topic| topic.name.instance.is_some_and(is_component);
            own.sort_by_key(|topic| (topic.name.instance != chosen, of_component(topic)));
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
        let fixes = |topic: &Topic| fixed_time(log, topic, source.topic);
        let most = same.iter().map(|topic| fixes(topic)).fold(0.0, f64::max);
        same.sort_by_cached_key(|topic| {
            let is_second = topic.name.name != source.topic;
            let is_seldom = fixes(topic) < OFTEN * most;
            (is_seldom, is_second, topic.name.instance)
        });
    }
    same
}

/// Seconds for which a receiver's topic, with the fields of the topic `like`, says that it knows where it is, whatever its rate;
/// 0 of topics that tell no fix.
fn fixed_time(log: &Log, topic: &Topic, like: &str) -> f64 {
    let is_fix = |s: &&RoleSource| s.role == Role::GpsFix && s.topic == like;
    let mut fixes = sources(log.format).filter(is_fix);
    let fixes = fixes.find_map(|source| match source.reading {
        RowReading::Field(name, _) => topic.field(name).filter(|f| f.kind.is_number()),
        _ => None,
    });
    let Some(field) = fixes else {
        return 0.0;
    };
    let mut sum = 0.0;
    for (index, row) in topic.rows.iter().enumerate() {
        if field.value(row).is_some_and(|fix| fix >= FLAT_FIX) {
            // The last row stands for a second.
            let next = topic.times.get(index + 1);
            let step = next.map_or(1.0, |next| next - topic.times[index]);
            sum += step.clamp(0.0, LONGEST);
        }
    }
    sum
}
