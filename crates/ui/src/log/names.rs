//! The names of a log's series, as expressions write them.

use super::OpenLog;
use crate::units::shown_unit;

/// A series by name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct NamedSeries {
    /// Its name: `ATT.Roll`, `Ground speed`.
    pub name: String,
    /// Its unit, or empty.
    pub unit: String,
}

/// Every series of a log: what it means first, then every field of numbers.
pub(super) fn names(log: &OpenLog) -> Vec<NamedSeries> {
    let sensors = log.overview.iter().flat_map(|overview| &overview.sensors);
    let mut names: Vec<NamedSeries> = sensors
        .map(|sensor| NamedSeries {
            name: sensor.role.label().to_owned(),
            unit: shown_unit(sensor.role.unit().0),
        })
        .collect();
    for topic in log.outline.iter().flat_map(|outline| &outline.topics) {
        let numbers = topic.fields.iter().filter(|field| field.is_number);
        names.extend(numbers.map(|field| NamedSeries {
            name: format!("{}.{}", topic.name, field.name),
            unit: shown_unit(&field.unit),
        }));
    }
    names
}
