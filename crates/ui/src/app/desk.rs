//! The jobs under way and what they are for.

use std::collections::HashMap;
use std::sync::Arc;

use super::keeping::Keeping;
use crate::documents::Staged;
use crate::host::OpenedFile;
use crate::jobs::{FlightSource, JobId, MapSource};
use crate::map::TileKey;

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
    /// What arrived before the run began.
    pub staged: Staged,
    /// How far it is, 0 to 1.
    pub progress: f32,
    /// What it is doing.
    pub words: String,
    /// Whether the run has begun.
    pub began: bool,
}

/// Files being looked at.
#[derive(Debug)]
pub struct Opening {
    /// Key under which the workers have them.
    pub key: String,
    /// What people call them.
    pub name: String,
    /// The files themselves, to be kept if they are of use.
    pub files: Vec<OpenedFile>,
}

/// Everything that is being computed.
#[derive(Debug, Default)]
pub struct Desk {
    /// The flight being flown.
    pub fly: Option<FlyJob>,
    /// When to fly again after a change, milliseconds of the host's clock.
    pub fly_again_at: Option<f64>,
    /// Tiles asked for.
    pub tiles: HashMap<JobId, TileKey>,
    /// The question what the map is.
    pub describe: Option<JobId>,
    /// The landmark whose distinctness is being examined.
    pub distinctness: Option<(JobId, u32)>,
    /// When to examine the selected landmark, milliseconds.
    pub examine_at: Option<f64>,
    /// The match being explained: job, time, landmark.
    pub explain: Option<(JobId, f64, u32)>,
    /// The camera picture being decoded: job, frame, encoded picture.
    pub decoding: Option<(JobId, usize, Arc<[u8]>)>,
    /// The landmark that could not be examined, and why.
    pub examined_in_vain: Option<(u32, String)>,
    /// Files being looked at.
    pub opening: HashMap<JobId, Opening>,
    /// Batches of files opened so far.
    pub opened_batches: usize,
    /// Whether the document changed since it was stored last.
    pub document_changed: bool,
    /// Opened files on their way into the storage.
    pub keeping: Keeping,
    /// Whether the map is to be fitted once it is known how far it reaches.
    pub fit_when_known: bool,
    /// Matches that could not be explained; not asked again.
    pub unexplained: Option<(f64, u32)>,
}

impl Desk {
    /// How far the flight is, and in words.
    pub fn progress(&self) -> Option<(f32, &str)> {
        let fly = self.fly.as_ref()?;
        Some((fly.progress, fly.words.as_str()))
    }
}
