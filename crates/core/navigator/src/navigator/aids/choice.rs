//! The aids that the settings switch on.

use super::aid::{Aid, AidInfo};
use pilotage_flight::Flight;
use pilotage_mission::settings::ChosenAid;

/// Why an aid cannot be switched on.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum AidError {
    /// Nothing has that name.
    #[error("there is no aid \"{key}\"; there are {}", keys())]
    Unknown {
        /// The name.
        key: String,
    },
    /// The aid has no such number.
    #[error("the aid \"{key}\" has no number \"{number}\"; leave it out")]
    UnknownNumber {
        /// Name of the aid.
        key: String,
        /// Name of the number.
        number: String,
    },
    /// A number that is none, or below zero.
    #[error("the aid \"{key}\" cannot have {number} = {value}; say a number above zero")]
    Unsound {
        /// Name of the aid.
        key: String,
        /// Name of the number.
        number: String,
        /// The value.
        value: String,
    },
    /// The flight measured nothing of the kind.
    #[error("the flight has no channel {channel} for the aid \"{key}\"; switch that off")]
    NoChannel {
        /// Name of the aid.
        key: String,
        /// Key of the channel.
        channel: String,
    },
}

fn keys() -> String {
    let keys: Vec<&str> = AidInfo::ALL.iter().map(|info| info.key).collect();
    keys.join(", ")
}

impl AidInfo {
    /// The aid of that name.
    ///
    /// # Errors
    /// There is none.
    pub fn named(key: &str) -> Result<&'static Self, AidError> {
        let found = Self::ALL.iter().find(|info| info.key == key);
        found.copied().ok_or_else(|| AidError::Unknown {
            key: key.to_owned(),
        })
    }

    /// Values of its numbers as `chosen` says, or the usual ones.
    ///
    /// # Errors
    /// A number of another name, or one that is not above zero.
    pub fn values(&self, chosen: &ChosenAid) -> Result<Vec<f64>, AidError> {
        let mut values: Vec<f64> = self.numbers.iter().map(|number| number.usual).collect();
        for (name, value) in &chosen.numbers {
            let (key, number) = (self.key.to_owned(), name.clone());
            let Some(index) = self.numbers.iter().position(|n| n.key == name) else {
                return Err(AidError::UnknownNumber { key, number });
            };
            if !(value.is_finite() && *value > 0.0) {
                let value = value.to_string();
                return Err(AidError::Unsound { key, number, value });
            }
            values[index] = *value;
        }
        Ok(values)
    }
}

/// The aids that are switched on for `flight`.
pub fn chosen(choices: &[ChosenAid], flight: &Flight) -> Result<Vec<Box<dyn Aid>>, AidError> {
    let begun = |choice: &ChosenAid| {
        let info = AidInfo::named(&choice.key)?;
        let values = info.values(choice)?;
        let is_missing = |name: &_| flight.channel(*name).is_none_or(|c| c.times.is_empty());
        if let Some(name) = info.channels.iter().copied().find(|name| is_missing(name)) {
            return Err(AidError::NoChannel {
                key: choice.key.clone(),
                channel: name.key().to_owned(),
            });
        }
        Ok((info.begin)(&values))
    };
    choices.iter().map(begun).collect()
}
