//! Series of a log: by their names in it, by what they mean, or computed from others; and those asked for last.

use std::collections::VecDeque;
use std::rc::Rc;

use pilotage_core::flight::expression::{Expression, SeriesSource as _, TimedSamples};
use pilotage_core::flight::log::Log;

use super::SeriesName;

/// Samples that are kept at most, for those who ask for the same series again.
const MOST_KEPT: usize = 1 << 24;
/// Times count as one that differ by less, seconds.
const SAME_TIME: f64 = 1e-9;

/// A series of a log in order of time.
///
/// # Errors
/// Why the log has no such series, in words.
pub fn samples(log: &Log, name: &SeriesName) -> Result<TimedSamples, String> {
    let lacks = |what: &str| format!("{}: there is no {what}", log.name);
    if name.is_expression() {
        let values = Expression::parse(&name.field).and_then(|it| it.evaluate(log));
        return values.map_err(|error| format!("{}: {error}", name.field));
    }
    if name.topic == SeriesName::role_topic() {
        let found = log.samples(&name.field);
        return found.ok_or_else(|| lacks(&name.field.to_lowercase()));
    }
    let full = format!("{}.{}", name.topic, name.field);
    let topic = log.topic(&name.topic).ok_or_else(|| lacks(&full))?;
    let field = topic.field(&name.field).filter(|f| f.kind.is_number());
    let field = field.ok_or_else(|| lacks(&full))?;
    let values = topic.rows.iter().map(|row| field.value(row));
    let samples = topic.times.iter().copied();
    let samples = samples.zip(values.map(|value| value.unwrap_or(f64::NAN)));
    Ok(TimedSamples::in_order(samples, field.unit.clone()))
}

/// The last value of a series at or before each of `times` (seconds, in the log's time base), where there is one; samples
/// without a value are passed over.
///
/// ```
/// use pilotage_core::flight::expression::TimedSamples;
/// use pilotage_jobs::values_along;
///
/// let samples = [(1.0, 5.0), (2.0, f64::NAN), (3.0, 7.0)];
/// let samples = TimedSamples::in_order(samples.into_iter(), "m");
/// assert_eq!(values_along(&samples, &[0.5, 2.5, 3.0]), [None, Some(5.0), Some(7.0)]);
/// ```
pub fn values_along(samples: &TimedSamples, times: &[f64]) -> Vec<Option<f64>> {
    let all = samples.times.iter().zip(&samples.values);
    let told: Vec<(f64, f64)> = all
        .filter(|(_, value)| !value.is_nan())
        .map(|(time, value)| (*time, *value))
        .collect();
    let at = |time: &f64| {
        let after = told.partition_point(|(t, _)| *t <= time + SAME_TIME);
        Some(told[..after].last()?.1)
    };
    times.iter().map(at).collect()
}

/// Series that were asked for last.
#[derive(Default)]
pub struct KeptSamples {
    /// The one asked for last at the end.
    kept: VecDeque<(SeriesName, Rc<TimedSamples>)>,
}

impl KeptSamples {
    /// Keeps nothing any more.
    pub fn clear(&mut self) {
        self.kept.clear();
    }

    /// The series as it was kept, else as `make` makes it.
    pub fn get(
        &mut self,
        name: &SeriesName,
        make: impl FnOnce() -> Result<TimedSamples, String>,
    ) -> Result<Rc<TimedSamples>, String> {
        let place = self.kept.iter().position(|(kept, _)| kept == name);
        if let Some(found) = place.and_then(|place| self.kept.remove(place)) {
            let samples = found.1.clone();
            self.kept.push_back(found);
            return Ok(samples);
        }
        let samples = Rc::new(make()?);
        self.kept.push_back((name.clone(), samples.clone()));
        let count = |kept: &VecDeque<(_, Rc<TimedSamples>)>| -> usize {
            kept.iter().map(|(_, samples)| samples.times.len()).sum()
        };
        while count(&self.kept) > MOST_KEPT {
            self.kept.pop_front();
        }
        Ok(samples)
    }
}
