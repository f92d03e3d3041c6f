//! Aids beside pictures that people switch on.

use serde::{Deserialize, Serialize};

/// An aid that is switched on.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ChosenAid {
    /// Name of the aid in files.
    pub key: String,
    /// Names and values of its numbers that are not the usual ones, SI.
    #[serde(default)]
    pub numbers: Vec<(String, f64)>,
}

impl ChosenAid {
    /// The aid of that name with its usual numbers.
    pub fn usual(key: &str) -> Self {
        Self {
            key: key.to_owned(),
            numbers: Vec::new(),
        }
    }

    /// The same with one of its numbers set, SI.
    #[must_use]
    pub fn with(mut self, number: &str, value: f64) -> Self {
        self.numbers.retain(|(name, _)| name != number);
        self.numbers.push((number.to_owned(), value));
        self
    }
}

/// A number of an aid that the filter has to know as well.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilterAidNumber {
    /// Name of the aid in files.
    pub aid: &'static str,
    /// Name of the number in files.
    pub number: &'static str,
    /// Value where nobody says another, SI.
    pub usual: f64,
}

/// Error of the road map per axis, metres: a state of the filter, so that many looks at one road make nobody surer than
/// the map. Roads of `OpenStreetMap` lie metres off.
pub const ROAD_MAP: FilterAidNumber = FilterAidNumber {
    aid: "roads",
    number: "map",
    usual: 2.0,
};

/// Error per axis that all landmarks that nobody picked share throughout a flight, metres: 0.43 m by which shadows of
/// another day move all of them (`pilotage classes places --countries 8 --pictures 6`), and 0.80 m by a bias of 0.15° of
/// roll or pitch from 1000 ft. It is taken for an error of the map.
pub const GENERIC_LANDMARKS: FilterAidNumber = FilterAidNumber {
    aid: "generic-landmarks",
    number: "map-deviation",
    usual: 1.0,
};

/// Error per axis of the map whose straight edges are looked for, metres: where it lies on the ground, the same for all looks.
pub const MAP_EDGES: FilterAidNumber = FilterAidNumber {
    aid: "map-edges",
    number: "map",
    usual: 1.0,
};

/// The errors of maps that aids look at.
pub const MAP_ERRORS: [FilterAidNumber; 3] = [ROAD_MAP, GENERIC_LANDMARKS, MAP_EDGES];

impl FilterAidNumber {
    /// Its value if its aid is among `chosen`.
    pub fn of(&self, chosen: &[ChosenAid]) -> Option<f64> {
        let aid = chosen.iter().find(|aid| aid.key == self.aid)?;
        let stated = aid.numbers.iter().find(|(name, _)| name == self.number);
        Some(stated.map_or(self.usual, |(_, value)| *value))
    }
}
