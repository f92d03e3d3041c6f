//! The jobs under way and what they are for.

use super::storage::Keeping;
use crate::documents::Staged;
use crate::feature::OpenedSet;
use crate::short_map::ShortMap;
use pilotage_jobs::{FlightSource, JobId, MapSource};

/// A flight being flown and navigated.
#[derive(Debug)]
pub struct FlyJob {
    /// The job.
    pub id: JobId,
    /// Whether it flies the same flight again, so that the old run becomes the ghost.
    pub again: bool,
    /// Whether the mission was given, not the flight's own.
    pub given: bool,
    /// The flight.
    pub flight: FlightSource,
    /// The map.
    pub map: MapSource,
    /// Flight and mission that arrived before the run began.
    pub staged: Staged,
    /// Progress of the job, 0 to 1.
    pub progress: f32,
    /// Present activity of the job, in words.
    pub words: String,
    /// The part of it that is shown.
    pub shown: ShownFlight,
}

/// The part of a flight under way that is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShownFlight {
    /// Nothing: its run has not begun.
    Nothing,
    /// Its run and its pictures.
    Run,
    /// Its pictures alone, beneath a run out of a file.
    Pictures,
}

impl FlyJob {
    /// Whether its run has begun.
    pub fn began(&self) -> bool {
        self.shown != ShownFlight::Nothing
    }
}

/// Files being looked at.
#[derive(Debug)]
pub struct Opening {
    /// The files, to be kept if they are of use.
    pub set: OpenedSet,
    /// Present activity, in words.
    pub words: String,
}

/// Everything that is being computed.
#[derive(Debug, Default)]
pub struct PendingJobs {
    /// The flight being flown.
    pub fly: Option<FlyJob>,
    /// When to fly again after a change, milliseconds of the host's clock.
    pub fly_again_at: Option<f64>,
    /// Files being looked at.
    pub opening: ShortMap<JobId, Opening>,
    /// Batches of files opened so far.
    pub opened_batches: usize,
    /// Whether the document changed since it was stored last.
    pub document_changed: bool,
    /// Opened files on their way into the storage.
    pub keeping: Keeping,
}

impl PendingJobs {
    /// Counts on behind a set of opened files that an earlier visit kept.
    pub fn count_batches(&mut self, set: &str) {
        let number = set.rsplit('-').next().and_then(|n| n.parse().ok());
        self.opened_batches = self.opened_batches.max(number.unwrap_or(0));
    }

    /// Progress of the computation under way, 0 to 1, and its words; `of_features` is that of the features.
    pub fn progress<'a>(&'a self, of_features: Option<(f32, &'a str)>) -> Option<(f32, &'a str)> {
        let fly = self.fly.as_ref().map(|f| (f.progress, f.words.as_str()));
        let opening = || {
            let (_, opening) = self.opening.iter().next()?;
            Some((0.0, opening.words.as_str()))
        };
        fly.or(of_features).or_else(opening)
    }
}
