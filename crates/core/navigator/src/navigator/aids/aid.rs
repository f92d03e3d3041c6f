//! Description of an aid for people, and what an aid does.

use pilotage_flight::{ChannelName, Flight};

use super::super::observation::Observation;

/// Description of an aid.
#[derive(Clone, Copy, Debug)]
pub struct AidInfo {
    /// Name in files and on the command line.
    pub key: &'static str,
    /// Name for people.
    pub label: &'static str,
    /// Explanation of what it measures and how far that is to be trusted, in sentences.
    pub description: &'static str,
    /// Channels of which it takes its readings: a reading is there when the first has one.
    pub channels: &'static [ChannelName],
    /// Components of what it measures, each with its SI unit.
    pub components: &'static [(&'static str, &'static str)],
    /// Numbers that people may set.
    pub numbers: &'static [AidNumber],
    /// Makes the aid, with a value for each of the numbers.
    pub(super) begin: fn(&[f64]) -> Box<dyn Aid>,
}

/// Number that people may set for an aid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AidNumber {
    /// Name in files.
    pub key: &'static str,
    /// Name for people.
    pub label: &'static str,
    /// SI unit.
    pub unit: &'static str,
    /// Value where nobody says another.
    pub usual: f64,
}

/// Stretch of a flight in which an aid may have measured something.
pub struct AidMoment<'a> {
    pub flight: &'a Flight,
    /// End of the step before, seconds.
    pub from: f64,
    /// End of this step, seconds.
    pub until: f64,
}

/// A source of corrections.
pub trait Aid: Send {
    /// Its description.
    fn info(&self) -> &'static AidInfo;

    /// Observations that it has made at a moment, true at its end.
    fn observe(&mut self, moment: &AidMoment<'_>) -> Vec<Observation<'static>>;
}
