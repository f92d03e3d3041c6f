//! Flights of a study grouped by what they have in common: a setting that is compared, or one that is drawn.

use pilotage_core::filter::quantile;
use pilotage_study::{SettingValue, StudySetting};

use super::under_way::StudyUnderWay;
use crate::views::parts;

/// Groups of a drawn number, with as many flights each.
const BINS: usize = 5;
/// Most values of a setting that are each a group.
const MOST_VALUES: usize = 8;

/// Setting by which flights are grouped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StudyBy {
    /// The settings that are compared.
    #[default]
    Compared,
    /// A setting that is drawn for each flight, by its number among those.
    Drawn(usize),
}

impl StudyBy {
    /// All groupings of a study, each with its name.
    pub fn all(study: &StudyUnderWay) -> Vec<(Self, String)> {
        let plan = study.plan();
        let compared: Vec<&str> = plan.cross.keys().map(String::as_str).collect();
        let compared = if compared.is_empty() {
            "nothing: all flights together".to_owned()
        } else {
            compared.join(" and ")
        };
        let drawn = plan.draw.keys().enumerate();
        let drawn = drawn.map(|(index, key)| (Self::Drawn(index), key.clone()));
        [(Self::Compared, compared)]
            .into_iter()
            .chain(drawn)
            .collect()
    }
}

/// Groups of flights.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FlightGroups {
    /// Group by group, in words.
    pub labels: Vec<String>,
    /// Number of the group of each flight that was flown, in the order of their runs.
    pub of: Vec<usize>,
}

impl FlightGroups {
    /// Flights of a study so far, grouped.
    pub fn of(study: &StudyUnderWay, by: StudyBy) -> Self {
        let plan = study.plan();
        let runs = study.rows().map(|(run, _)| run);
        let StudyBy::Drawn(index) = by else {
            let cells = plan.cells();
            return Self {
                labels: (0..cells).map(|cell| compared(study, cell)).collect(),
                of: runs.map(|run| (run % cells) as usize).collect(),
            };
        };
        let place = plan.cross.len() + index;
        let key = plan.draw.keys().nth(index).map_or("", String::as_str);
        let values =
            runs.filter_map(|run| study.design().run(run).ok()?.values.get(place).cloned());
        let values: Vec<SettingValue> = values.collect();
        by_value(key, &values).unwrap_or_else(|| by_size(key, &values))
    }
}

/// A group for each value; `None` if there are too many.
fn by_value(key: &str, values: &[SettingValue]) -> Option<FlightGroups> {
    let mut groups: Vec<&SettingValue> = Vec::new();
    let mut of = Vec::new();
    for value in values {
        let found = groups.iter().position(|own| *own == value);
        of.push(found.unwrap_or(groups.len()));
        if found.is_none() {
            groups.push(value);
        }
        if groups.len() > MOST_VALUES {
            return None;
        }
    }
    let labels = groups.iter().map(|value| in_words(key, &value.to_string()));
    Some(FlightGroups {
        labels: labels.collect(),
        of,
    })
}

/// Groups of as many flights each, the smallest numbers first.
fn by_size(key: &str, values: &[SettingValue]) -> FlightGroups {
    let number = |value: &SettingValue| match value {
        SettingValue::Number(number) => *number,
        SettingValue::Text(_) => 0.0,
    };
    let numbers: Vec<f64> = values.iter().map(number).collect();
    let mut ascending = numbers.clone();
    ascending.sort_by(f64::total_cmp);
    let ends: Vec<f64> = (0..=BINS)
        .filter_map(|end| quantile(&ascending, end as f64 / BINS as f64))
        .collect();
    let label = |pair: &[f64]| {
        let [low, high] = [pair[0], pair[1]].map(parts::figures);
        in_words(key, &format!("{low} to {high}"))
    };
    let group = |value: &f64| {
        let inner = ends.get(1..BINS).unwrap_or_default();
        inner.partition_point(|end| end <= value)
    };
    FlightGroups {
        labels: ends.windows(2).map(label).collect(),
        of: numbers.iter().map(group).collect(),
    }
}

/// A value of a setting with its unit, a number that has none with its name.
fn in_words(key: &str, value: &str) -> String {
    let told = StudySetting::with_unit(key, value);
    let is_number = value.starts_with(|c: char| c.is_ascii_digit() || "-−".contains(c));
    if is_number && told == value {
        return format!("{key} {value}");
    }
    told
}

/// Values that are compared, of cell number `cell`, in words.
pub fn compared(study: &StudyUnderWay, cell: u64) -> String {
    let keys = study.plan().cross.keys();
    let values = keys.zip(study.design().cell_values(cell));
    let words: Vec<String> = values
        .map(|(key, value)| in_words(key, &value.to_string()))
        .collect();
    if words.is_empty() {
        "all flights".to_owned()
    } else {
        words.join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drawn_numbers_are_grouped_into_fifths_and_few_values_by_themselves() {
        let numbers = (0..100)
            .rev()
            .map(|number| SettingValue::Number(f64::from(number)));
        let numbers: Vec<SettingValue> = numbers.collect();
        assert_eq!(by_value("wind-speed", &numbers), None);
        let groups = by_size("wind-speed", &numbers);
        assert_eq!(groups.labels.len(), BINS);
        assert_eq!(groups.labels[0], "0 to 19.8 m/s");
        for group in 0..BINS {
            assert_eq!(groups.of.iter().filter(|of| **of == group).count(), 20);
        }
        assert_eq!((groups.of[0], groups.of[99]), (4, 0));
        assert_eq!(in_words("recognised", "0.8"), "recognised 0.8");
        let names = ["b", "a", "b"].map(|name| SettingValue::Text(name.to_owned()));
        let groups = by_value("vehicle", &names).unwrap();
        assert_eq!(
            (groups.labels, groups.of),
            (vec!["b".to_owned(), "a".to_owned()], vec![0, 1, 0])
        );
        assert_eq!(by_size("alpha", &[]).labels, Vec::<String>::new());
    }
}
