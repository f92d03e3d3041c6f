//! Values of settings, and how they are drawn.

use std::fmt;

use pilotage_core::filter::chi_square_quantile;
use serde::de::Visitor;
use serde::{Deserialize, Deserializer, Serialize};

/// Value of a setting of a study.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum SettingValue {
    /// A number in the unit of the setting.
    Number(f64),
    /// A name.
    Text(String),
}

impl<'d> Deserialize<'d> for SettingValue {
    fn deserialize<D: Deserializer<'d>>(from: D) -> Result<Self, D::Error> {
        struct Value;

        impl Visitor<'_> for Value {
            type Value = SettingValue;

            fn expecting(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
                to.write_str("a number or a name in quotation marks")
            }

            fn visit_f64<E>(self, number: f64) -> Result<SettingValue, E> {
                Ok(SettingValue::Number(number))
            }

            fn visit_i64<E>(self, number: i64) -> Result<SettingValue, E> {
                Ok(SettingValue::Number(number as f64))
            }

            fn visit_u64<E>(self, number: u64) -> Result<SettingValue, E> {
                Ok(SettingValue::Number(number as f64))
            }

            fn visit_str<E>(self, name: &str) -> Result<SettingValue, E> {
                Ok(SettingValue::Text(name.to_owned()))
            }
        }

        from.deserialize_any(Value)
    }
}

impl fmt::Display for SettingValue {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(formatter, "{number}"),
            Self::Text(text) => formatter.write_str(text),
        }
    }
}

/// Distribution from which the value of a setting is drawn, numbers in its unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "WrittenDistribution", into = "WrittenDistribution")]
pub enum SettingDistribution {
    /// Even between two numbers.
    Uniform([f64; 2]),
    /// Of an even logarithm between two positive numbers.
    LogUniform([f64; 2]),
    /// Normal: mean and standard deviation.
    Normal([f64; 2]),
    /// Each of these as often as any other.
    Choice(Vec<SettingValue>),
}

/// A distribution as it is written: one of these.
#[derive(Clone, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
struct WrittenDistribution {
    #[serde(skip_serializing_if = "Option::is_none")]
    uniform: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    log_uniform: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    normal: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    choice: Option<Vec<SettingValue>>,
}

impl TryFrom<WrittenDistribution> for SettingDistribution {
    type Error = &'static str;

    fn try_from(written: WrittenDistribution) -> Result<Self, &'static str> {
        let WrittenDistribution {
            uniform,
            log_uniform,
            normal,
            choice,
        } = written;
        let mut given = [
            uniform.map(Self::Uniform),
            log_uniform.map(Self::LogUniform),
            normal.map(Self::Normal),
            choice.map(Self::Choice),
        ]
        .into_iter()
        .flatten();
        given
            .next()
            .filter(|_| given.next().is_none())
            .ok_or("give one of uniform, log-uniform, normal and choice")
    }
}

impl From<SettingDistribution> for WrittenDistribution {
    fn from(distribution: SettingDistribution) -> Self {
        let mut written = Self::default();
        match distribution {
            SettingDistribution::Uniform(ends) => written.uniform = Some(ends),
            SettingDistribution::LogUniform(ends) => written.log_uniform = Some(ends),
            SettingDistribution::Normal(of) => written.normal = Some(of),
            SettingDistribution::Choice(values) => written.choice = Some(values),
        }
        written
    }
}

impl SettingDistribution {
    /// The value below which the share `unit` (0 to 1, without the ends) of all draws lies.
    ///
    /// ```
    /// use pilotage_study::{SettingDistribution, SettingValue};
    ///
    /// let evenly = SettingDistribution::Uniform([2.0, 4.0]);
    /// assert_eq!(evenly.at(0.25), SettingValue::Number(2.5));
    /// ```
    pub fn at(&self, unit: f64) -> SettingValue {
        match self {
            Self::Uniform([low, high]) => SettingValue::Number(low + unit * (high - low)),
            Self::LogUniform([low, high]) => SettingValue::Number(low * (high / low).powf(unit)),
            Self::Normal([mean, deviation]) => {
                SettingValue::Number(mean + deviation * standard_normal(unit))
            }
            Self::Choice(values) => {
                let index = (unit * values.len() as f64) as usize;
                values[index.min(values.len() - 1)].clone()
            }
        }
    }

    /// Why nothing can be drawn from it, if so.
    pub(crate) fn trouble(&self) -> Option<&'static str> {
        let is_fine = match self {
            Self::Uniform([low, high]) => low.is_finite() && high.is_finite() && low <= high,
            Self::LogUniform([low, high]) => *low > 0.0 && high.is_finite() && low <= high,
            Self::Normal([mean, deviation]) => {
                mean.is_finite() && deviation.is_finite() && *deviation >= 0.0
            }
            Self::Choice(values) => !values.is_empty(),
        };
        (!is_fine).then_some(match self {
            Self::Uniform(_) => "give two numbers, the smaller first",
            Self::LogUniform(_) => "give two positive numbers, the smaller first",
            Self::Normal(_) => "give a mean and a standard deviation that is not negative",
            Self::Choice(_) => "give at least one value",
        })
    }
}

/// Value of a standard normal variable below which the share `unit` lies.
fn standard_normal(unit: f64) -> f64 {
    let off = 2.0 * unit - 1.0;
    chi_square_quantile(off.abs(), 1.0).sqrt().copysign(off)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_values_are_those_of_printed_tables() {
        let table = [
            (0.5, 0.0),
            (0.975, 1.959_964),
            (0.001, -3.090_232),
            (0.9, 1.281_552),
        ];
        for (unit, value) in table {
            assert!((standard_normal(unit) - value).abs() < 1e-5, "{unit}");
        }
        let SettingValue::Number(drawn) = SettingDistribution::Normal([3.0, 2.0]).at(0.975) else {
            panic!("a number");
        };
        assert!((drawn - 6.919_928).abs() < 1e-4);
    }

    #[test]
    fn choices_share_the_draws_and_logarithms_are_even() {
        let two = SettingDistribution::Choice(vec![
            SettingValue::Text("a".to_owned()),
            SettingValue::Number(2.0),
        ]);
        assert_eq!(two.at(0.499), SettingValue::Text("a".to_owned()));
        assert_eq!(two.at(0.999_999), SettingValue::Number(2.0));
        let SettingValue::Number(middle) = SettingDistribution::LogUniform([0.1, 10.0]).at(0.5)
        else {
            panic!("a number");
        };
        assert!((middle - 1.0).abs() < 1e-12);
    }

    #[test]
    fn what_nothing_can_be_drawn_from_is_told() {
        for bad in [
            SettingDistribution::Uniform([2.0, 1.0]),
            SettingDistribution::LogUniform([0.0, 1.0]),
            SettingDistribution::Normal([0.0, -1.0]),
            SettingDistribution::Choice(Vec::new()),
        ] {
            assert!(bad.trouble().is_some(), "{bad:?}");
        }
    }
}
