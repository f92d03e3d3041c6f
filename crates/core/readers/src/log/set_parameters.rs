//! Parameters of an autopilot as they were last set.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::Log;

/// A parameter as it was last set in a log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SetParameter {
    /// Name.
    pub name: String,
    /// Last value.
    pub value: f64,
    /// Value that it has unless somebody sets it, where the log tells that.
    pub default: Option<f64>,
    /// Number of times that it took another value within the log.
    pub changes: usize,
}

impl SetParameter {
    /// Default value, where it is another one.
    pub fn other_default(&self) -> Option<f64> {
        self.default.filter(|default| *default != self.value)
    }
}

impl Log {
    /// Each parameter as it was last set, by name. The default for the kind of airframe outweighs that of the system.
    pub fn set_parameters(&self) -> Vec<SetParameter> {
        let mut defaults: BTreeMap<&str, (f64, bool)> = BTreeMap::new();
        for default in &self.defaults {
            let known = defaults.entry(&default.name);
            let known = known.or_insert((default.value, default.of_airframe));
            if default.of_airframe && !known.1 {
                *known = (default.value, true);
            }
        }
        let mut last: BTreeMap<&str, (f64, usize)> = BTreeMap::new();
        for parameter in &self.parameters {
            let known = last.entry(&parameter.name).or_insert((parameter.value, 0));
            if known.0.to_bits() != parameter.value.to_bits() {
                *known = (parameter.value, known.1 + 1);
            }
        }
        let set = last
            .into_iter()
            .map(|(name, (value, changes))| SetParameter {
                name: name.to_owned(),
                value,
                default: defaults.get(name).map(|(value, _)| *value),
                changes,
            });
        set.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{DefaultValue, LogFormat, Parameter};
    use super::*;

    #[test]
    fn a_parameter_is_told_once_as_it_was_last_set_beside_the_default_of_its_airframe() {
        let mut log = Log::new("a.ulg", LogFormat::Ulog);
        let sets = [("B", 1.0), ("A", 4.0), ("B", 2.0), ("B", 2.0), ("B", 3.0)];
        log.parameters = sets
            .map(|(name, value)| Parameter {
                name: name.to_owned(),
                value,
                time: 0.0,
            })
            .to_vec();
        let default = |value, of_airframe| DefaultValue {
            name: "B".to_owned(),
            value,
            of_airframe,
        };
        log.defaults = vec![default(3.0, false), default(5.0, true)];
        let set = log.set_parameters();
        let told: Vec<_> = set
            .iter()
            .map(|it| (it.name.as_str(), it.value, it.changes, it.other_default()))
            .collect();
        assert_eq!(told, [("A", 4.0, 0, None), ("B", 3.0, 2, Some(5.0))]);
    }
}
