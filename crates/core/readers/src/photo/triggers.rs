//! Times at which a log says that its camera took a photo.

use crate::log::{Log, Topic, system_of};

/// Photos that a log tells of.
#[derive(Clone, Debug, PartialEq)]
pub struct Triggers {
    /// Name of the topic that tells them.
    pub source: String,
    /// Seconds in the log's time base, growing.
    pub times: Vec<f64>,
}

/// True in rows of `camera_trigger` in which the camera itself says so; where it never does, every row counts.
const FEEDBACK: &str = "feedback";

/// The photos that a log tells of; `None` if it tells of none.
pub fn triggers(log: &Log) -> Option<Triggers> {
    let chosen = log.chosen_vehicle();
    log.format
        .meaning()
        .triggers
        .iter()
        .find_map(|(name, taken)| {
            let is_own = |topic: &&Topic| {
                let system = topic.name.instance.map(system_of);
                topic.name.name == *name && chosen.is_none_or(|chosen| system == Some(chosen))
            };
            let topic = log.topics.iter().find(is_own)?;
            let field = topic.field(taken);
            let is_taken = |row: usize| {
                let taken = field.and_then(|field| topic.value(field, row));
                taken.is_none_or(|taken| taken != 0.0)
            };
            let all_count = *taken == FEEDBACK && !(0..topic.len()).any(is_taken);
            let rows = topic.times.iter().enumerate();
            let rows = rows.filter(|(row, _)| all_count || is_taken(*row));
            let mut times: Vec<f64> = rows.map(|(_, t)| *t).filter(|t| t.is_finite()).collect();
            times.sort_by(f64::total_cmp);
            // A message that was sent twice tells of one photo.
            times.dedup();
            (!times.is_empty()).then(|| Triggers {
                source: topic.name.to_string(),
                times,
            })
        })
}
