//! A lesson: what it computes of what its reader set, and the figure of that.

use crate::figure::Svg;
use crate::setting::{LessonControl, Setting};
use crate::words::Words;

/// Lesson of one question. Its words are those of its text, in the language that is read.
#[derive(Clone, Copy)]
pub struct Lesson {
    /// Name in addresses and of its files.
    pub name: &'static str,
    /// Text in English: see `texts/README.md`.
    pub text: &'static str,
    /// Controls that its reader has.
    pub controls: &'static [LessonControl],
    /// Computes what is shown at a setting; the same for the same setting. Takes less than 16 ms.
    pub compute: fn(&Setting, &Words) -> LessonOutcome,
}

/// Figure and numbers that a lesson shows at one setting.
pub struct LessonOutcome {
    /// The figure.
    pub figure: Svg,
    /// Numbers that the text names.
    pub values: Vec<Value>,
    /// Checks that judge the reader's own setting.
    pub checks: Vec<Check>,
}

impl LessonOutcome {
    /// Number of that name.
    pub fn value(&self, name: &str) -> Option<&Value> {
        self.values.iter().find(|value| value.name == name)
    }
}

/// Number of a lesson with its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// Name in the text.
    pub name: &'static str,
    /// The number, in its unit.
    pub number: f64,
    /// Unit as people read it: `m`, `°`, `%`, or nothing.
    pub unit: &'static str,
}

impl Value {
    /// Number in a unit.
    pub const fn new(name: &'static str, number: f64, unit: &'static str) -> Self {
        Self { name, number, unit }
    }
}

/// Bounds that a number has to keep for the reader's setting to pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Check {
    /// Name of the number among the values.
    pub value: &'static str,
    /// Least of it, in its unit.
    pub low: f64,
    /// Most of it, in its unit.
    pub high: f64,
}

impl Check {
    /// A number that has to lie between two others.
    pub const fn between(value: &'static str, low: f64, high: f64) -> Self {
        Self { value, low, high }
    }

    /// A number that must not be more.
    pub const fn at_most(value: &'static str, high: f64) -> Self {
        Self::between(value, f64::NEG_INFINITY, high)
    }

    /// A number that must not be less.
    pub const fn at_least(value: &'static str, low: f64) -> Self {
        Self::between(value, low, f64::INFINITY)
    }

    /// Whether what was computed passes.
    pub fn passes(&self, outcome: &LessonOutcome) -> bool {
        outcome
            .value(self.value)
            .is_some_and(|value| (self.low..=self.high).contains(&value.number))
    }
}
