//! The aids that the settings switch on.

use super::super::known_ground::KnownGround;
use super::aid::{Aid, AidInfo};
use super::error::AidError;
use pilotage_flight::Flight;
use pilotage_mission::settings::ChosenAid;

fn keys() -> String {
    let keys: Vec<&str> = AidInfo::ALL.iter().map(|info| info.key).collect();
    keys.join(", ")
}

/// Place of the aid of that name in the list of all.
fn place(key: &str) -> Result<usize, AidError> {
    let found = AidInfo::ALL.iter().position(|info| info.key == key);
    found.ok_or_else(|| AidError::Unknown {
        key: key.to_owned(),
        known: keys(),
    })
}

impl AidInfo {
    /// The aid of that name.
    ///
    /// # Errors
    /// There is none.
    pub fn named(key: &str) -> Result<&'static Self, AidError> {
        place(key).map(|place| Self::ALL[place])
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
                let known: Vec<&str> = self.numbers.iter().map(|number| number.key).collect();
                let known = match &known[..] {
                    [] => "none".to_owned(),
                    known => known.join(", "),
                };
                return Err(AidError::UnknownNumber { key, number, known });
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

/// The aids that are switched on for `flight`, over `ground` as far as it is known.
pub fn chosen(
    choices: &[ChosenAid],
    flight: &Flight,
    ground: Option<&KnownGround>,
) -> Result<Vec<Box<dyn Aid>>, AidError> {
    let begun = |choice: &ChosenAid| {
        let place = place(&choice.key)?;
        let info = AidInfo::ALL[place];
        let values = info.values(choice)?;
        let is_missing = |name: &_| flight.channel(*name).is_none_or(|c| c.times.is_empty());
        if let Some(name) = info.channels.iter().copied().find(|name| is_missing(name)) {
            return Err(AidError::NoChannel {
                key: choice.key.clone(),
                channel: name.key().to_owned(),
            });
        }
        AidInfo::MAKERS[place](&values, ground)
    };
    choices.iter().map(begun).collect()
}
