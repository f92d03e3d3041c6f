//! Results of outages, and what people can do about them.

use pilotage_core::flight::{ChannelName, Flight};
use pilotage_jobs::{OutageReport, StudyReport};

use crate::command::Command;
use crate::feature::FeatureWork;
use crate::feature_command::{FeatureCommand, FeatureId};

/// Identity of the feature.
pub const ID: FeatureId = "outage";

/// Something to do about an outage.
#[derive(Clone, Debug, PartialEq)]
pub enum OutageCommand {
    /// Show it.
    Show,
    /// Cut satellite navigation out of the selected stretch of time.
    Selected,
    /// Cut it out of this stretch, seconds in the flight's time base.
    Of(f64, f64),
    /// Cut it again and again, for so many seconds each.
    Study(f64),
    /// Stop what is being computed.
    Stop,
    /// Let go of the outage.
    Clear,
}

impl From<OutageCommand> for Command {
    fn from(command: OutageCommand) -> Self {
        Self::Feature(FeatureCommand::new(ID, command))
    }
}

/// Results of outages, until another flight is opened.
#[derive(Debug, Default)]
pub struct Outages {
    /// The outage that is shown.
    pub report: Option<OutageReport>,
    /// Outages all along the flight.
    pub study: Option<StudyReport>,
    /// Computation of either.
    pub work: FeatureWork,
}

/// Whether a flight goes on by its airspeed after an outage.
pub(super) fn measures_airspeed(flight: &Flight) -> bool {
    flight.channel(ChannelName::Airspeed).is_some()
}
