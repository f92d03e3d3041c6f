//! Results of outages, and what people can do about them.

use pilotage_core::flight::{ChannelName, Flight};
use pilotage_jobs::{OutageReport, StudyReport};

use crate::command::Command;
use crate::documents::Documents;
use crate::feature_command::{FeatureCommand, FeatureId};
use crate::feature_work::FeatureWork;

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
    /// Generation of the run whose positions it goes on with, if it goes on with any.
    pub report_of: Option<u64>,
    /// Outages all along the flight.
    pub study: Option<StudyReport>,
    /// The same of them.
    pub study_of: Option<u64>,
    /// The same of what is being computed.
    pub asked_of: Option<u64>,
    /// Whether the outage goes on with positions of a run before.
    pub is_of_before: bool,
    /// Computation of either.
    pub work: FeatureWork,
}

/// Whether the run of a generation, with whose positions a result goes on, has been flown again since.
pub(super) fn is_of_before(of: Option<u64>, documents: &Documents) -> bool {
    of.is_some_and(|generation| documents.run.is_before(generation))
}

/// Whether a flight goes on by its airspeed after an outage.
pub(super) fn measures_airspeed(flight: &Flight) -> bool {
    flight.channel(ChannelName::Airspeed).is_some()
}
