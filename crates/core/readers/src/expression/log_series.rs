//! The series of a log by name, for expressions.

use super::{SeriesSource, TimedSamples};
use crate::interpret::{Role, series};
use crate::log::{FieldLayout, Log, Topic, TopicName};

/// The topic and the field that a name means, where its dots could part it in several ways.
fn field<'a>(log: &'a Log, name: &str) -> Option<(&'a Topic, &'a FieldLayout)> {
    name.match_indices('.').find_map(|(dot, _)| {
        let topic = topic(log, &name[..dot])?;
        let field = topic.field(&name[dot + 1..])?;
        field.kind.is_number().then_some((topic, field))
    })
}

/// The topic called `name`: `GPS`, `GPS[1]`.
fn topic<'a>(log: &'a Log, name: &str) -> Option<&'a Topic> {
    let whole = log.topic(&TopicName::single(name));
    whole.or_else(|| {
        let (name, rest) = name.rsplit_once('[')?;
        let instance = rest.strip_suffix(']')?.parse().ok()?;
        log.topic(&TopicName {
            name: name.to_owned(),
            instance: Some(instance),
        })
    })
}

impl SeriesSource for Log {
    fn samples(&self, name: &str) -> Option<TimedSamples> {
        if let Some(role) = Role::from_label(name) {
            let found = series(self, role)?;
            let (unit, factor) = role.unit();
            let values = found.values.iter().map(|value| factor * value);
            return Some(TimedSamples::new(
                found.times.iter().copied().zip(values),
                unit,
            ));
        }
        let (topic, field) = field(self, name)?;
        let value = |row| field.value(row).unwrap_or(f64::NAN);
        let values = topic.rows.iter().map(value);
        let samples = topic.times.iter().copied().zip(values);
        Some(TimedSamples::new(samples, field.unit.clone()))
    }

    fn names(&self) -> Vec<String> {
        let roles = Role::ALL
            .into_iter()
            .filter(|role| series(self, *role).is_some());
        let mut names: Vec<String> = roles.map(|role| role.label().to_owned()).collect();
        for topic in self.topics.iter().filter(|topic| !topic.is_empty()) {
            let numbers = topic.fields.iter().filter(|field| field.kind.is_number());
            names.extend(numbers.map(|field| format!("{}.{}", topic.name, field.name)));
        }
        names
    }
}
