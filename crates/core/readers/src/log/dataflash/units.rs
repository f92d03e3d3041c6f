//! Units and multipliers: UNIT and MULT say what their letters mean, FMTU which letters a message has.

use std::collections::BTreeMap;

use super::super::ValueScale;
use super::letters::Letter;

/// The letter that marks the field by which instances are told apart.
pub const INSTANCE: u8 = b'#';

/// The tables of the log.
#[derive(Clone, Debug, Default)]
pub struct UnitTables {
    units: BTreeMap<u8, String>,
    multipliers: BTreeMap<u8, f64>,
}

/// The letters of one kind of message.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Labels {
    /// A letter for the unit of each field.
    pub units: Vec<u8>,
    /// A letter for the multiplier of each field.
    pub multipliers: Vec<u8>,
}

impl UnitTables {
    /// Says what a letter for units means; whether that is news.
    pub fn unit(&mut self, letter: u8, unit: String) -> bool {
        let old = self.units.insert(letter, unit);
        old.as_ref() != self.units.get(&letter)
    }

    /// Says what a letter for multipliers means; whether that is news.
    ///
    /// Logs have numbers of single precision stretched to double, so that seven digits count.
    pub fn multiplier(&mut self, letter: u8, factor: f64) -> bool {
        let rounded = format!("{factor:.6e}").parse().unwrap_or(factor);
        self.multipliers.insert(letter, rounded) != Some(rounded)
    }

    /// Unit and scale of field `index`.
    ///
    /// A letter of the format that implies a scale has the last word. So it is without a unit: then there
    /// is nothing that a multiplier would be of. Zero stands for none.
    pub fn of(&self, labels: &Labels, index: usize, letter: &Letter) -> (String, ValueScale) {
        let unit = labels.units.get(index).and_then(|id| self.units.get(id));
        let unit = unit.cloned().unwrap_or_default();
        let is_open =
            letter.scale == ValueScale::One && letter.kind.is_number() && !unit.is_empty();
        let multiplier = labels.multipliers.get(index);
        let factor = multiplier.and_then(|id| self.multipliers.get(id));
        let scale = match factor {
            Some(factor) if is_open && *factor != 0.0 && factor.is_finite() => {
                ValueScale::by(*factor)
            }
            _ => letter.scale,
        };
        (unit, scale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tables() -> UnitTables {
        let mut units = UnitTables::default();
        for (letter, unit) in [(b'-', ""), (b'd', "deg"), (b's', "s")] {
            assert!(units.unit(letter, unit.to_owned()));
        }
        for (letter, factor) in [(b'-', 0.0), (b'B', f64::from(0.01_f32)), (b'F', 1e-6)] {
            assert!(units.multiplier(letter, factor));
        }
        units
    }

    fn labels() -> Labels {
        Labels {
            units: b"sdd-d?".to_vec(),
            multipliers: b"FB-BB".to_vec(),
        }
    }

    #[test]
    fn multipliers_count_unless_the_letter_has_one_itself() {
        let of = |index, letter| {
            let letter = Letter::of(letter).unwrap();
            tables().of(&labels(), index, &letter)
        };
        assert_eq!(of(0, b'Q'), ("s".to_owned(), ValueScale::Over(1e6)));
        assert_eq!(of(1, b'h'), ("deg".to_owned(), ValueScale::Over(100.0)));
        assert_eq!(of(1, b'L'), ("deg".to_owned(), ValueScale::Over(1e7)));
        assert_eq!(of(2, b'f'), ("deg".to_owned(), ValueScale::One));
        assert_eq!(of(3, b'h'), (String::new(), ValueScale::One));
        assert_eq!(of(4, b'c'), ("deg".to_owned(), ValueScale::Over(100.0)));
        assert_eq!(of(5, b'h'), (String::new(), ValueScale::One));
        assert_eq!(of(9, b'e'), (String::new(), ValueScale::Over(100.0)));
    }

    #[test]
    fn what_was_said_before_is_no_news() {
        let mut units = tables();
        assert!(!units.unit(b'd', "deg".to_owned()));
        assert!(units.unit(b'd', "rad".to_owned()));
        assert!(!units.multiplier(b'B', 0.01));
        assert!(units.multiplier(b'B', 0.1));
    }
}
