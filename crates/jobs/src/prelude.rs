//! The first seconds of a visit: what the first jobs tell, computed beforehand by the very same program and shipped
//! with the page, so that nobody waits for what is the same at every first visit.
//!
//! The workers compute all of it nevertheless. What they say is compared with what was stored: what is equal has
//! been shown already, what is not replaces it and is counted.

use std::collections::BTreeMap;

use pilotage_core::flight::Flight;
use pilotage_core::frames::GroundRect;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{Run, StepReport, StepTiming};
use serde::{Deserialize, Serialize};

use super::frame_picture::{PictureForm, digest};
use super::{
    DescribeMapOrder, EncodedPicture, FlightSource, FlyOrder, FramePictureOrder, Job, JobEvent,
    JobId, KeptMeasurement, MapInfo, MapSource,
};

/// The map of the first seconds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FirstMap {
    /// Its source.
    pub source: MapSource,
    /// Its description.
    pub info: MapInfo,
    /// The ground that the picture beside it shows, which stands in for tiles of the map.
    pub ground: GroundRect,
}

impl FirstMap {
    /// From a file of the page, without the rest of it; `None` if another version of the program made it.
    pub fn decode(bytes: &[u8]) -> Option<Self> {
        let (map, _) = postcard::take_from_bytes(bytes).ok()?;
        Some(map)
    }
}

/// The stored first seconds: of the first jobs of a visit, which describe a map and fly over it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FirstSeconds {
    /// The map, first in the file: the view needs no more of it.
    pub map: FirstMap,
    /// Source of the flight.
    pub source: FlightSource,
    /// The flight.
    pub flight: Box<Flight>,
    /// The mission that comes with it.
    pub mission: Box<Mission>,
    /// The head of its run.
    pub run: Box<Run>,
    /// The first steps, without the time that they took.
    pub steps: Vec<StepReport>,
    /// Some of the first pictures, by their index.
    pub pictures: BTreeMap<usize, EncodedPicture>,
    /// Landmarks of the mission as they were measured, which the workers do not compute again.
    pub measured: Vec<KeptMeasurement>,
}

impl FirstSeconds {
    /// Key under which the page remembers it.
    pub const KEY: &str = "first seconds";
    /// Key of the pixels of the ground: red, green, blue and opacity, row by row, of a square picture.
    pub const GROUND_KEY: &str = "first ground";
    /// Key of the landmarks as they were measured.
    pub const MEASURED_KEY: &str = "first measured landmarks";

    /// From a file of the page; `None` if another version of the program made it.
    pub fn decode(bytes: &[u8]) -> Option<Self> {
        postcard::from_bytes(bytes).ok()
    }

    /// As a file of the page.
    pub fn encode(&self) -> Vec<u8> {
        postcard::to_stdvec(self).unwrap_or_default()
    }

    /// Events that begin the run.
    fn heads(&self) -> [JobEvent; 3] {
        [
            JobEvent::Flight(self.flight.clone()),
            JobEvent::Mission(self.mission.clone()),
            JobEvent::RunStarted(self.run.clone()),
        ]
    }
}

/// Tells what is stored when a job begins, and of what the worker says only what is new.
#[derive(Default)]
pub struct Prelude {
    stored: Option<FirstSeconds>,
    /// The job that describes the map, and the one that flies, as long as they agree with what is stored.
    describing: Option<JobId>,
    flying: Option<JobId>,
    /// Steps of the flight that the worker has said.
    steps: usize,
    /// Whether it has said steps that are not stored.
    is_beyond: bool,
    /// Stored pictures that the worker took otherwise, by their index.
    outdated: Vec<usize>,
    compared: usize,
    different: usize,
}

impl Prelude {
    /// With what is stored.
    pub fn new(stored: Option<FirstSeconds>) -> Self {
        Self {
            stored,
            ..Self::default()
        }
    }

    /// Events that are told at once of a job that begins.
    pub fn begin(&mut self, id: JobId, job: &Job) -> Vec<JobEvent> {
        let Some(stored) = &self.stored else {
            return Vec::new();
        };
        match job {
            Job::DescribeMap(DescribeMapOrder(map)) if *map == stored.map.source => {
                self.describing = Some(id);
                vec![JobEvent::MapInfo(stored.map.info.clone())]
            }
            Job::Fly(FlyOrder {
                flight,
                map,
                mission: None,
            }) if *flight == stored.source && *map == stored.map.source => {
                self.flying = Some(id);
                self.steps = 0;
                self.is_beyond = false;
                let pictures = stored.pictures.iter();
                let pictures = pictures.map(|(index, picture)| JobEvent::FrameTaken {
                    index: *index,
                    digest: Some(digest(&picture.0)),
                });
                let steps = JobEvent::Steps(stored.steps.clone());
                let heads = stored.heads().into_iter();
                heads.chain(pictures).chain([steps]).collect()
            }
            _ => Vec::new(),
        }
    }

    /// A job that asks for a picture which is stored, with that picture.
    pub fn complete(&self, job: Job) -> Job {
        match (job, &self.stored) {
            (Job::FramePicture(order), Some(stored)) if order.flight == stored.source => {
                let is_known = !self.outdated.contains(&order.index);
                let encoded = stored.pictures.get(&order.index).filter(|_| is_known);
                let form = match (&order.form, encoded) {
                    (PictureForm::Pixels, Some(it)) => PictureForm::PixelsOf(it.clone()),
                    _ => order.form,
                };
                Job::FramePicture(FramePictureOrder { form, ..order })
            }
            (job, _) => job,
        }
    }

    /// Pieces of what was stored that the workers computed so far, and how many of them came out otherwise.
    pub fn checked(&self) -> (usize, usize) {
        (self.compared, self.different)
    }

    /// Takes an event that a worker sent; returns the events to be passed on.
    pub fn hear(&mut self, id: JobId, event: JobEvent) -> Vec<JobEvent> {
        let Some(stored) = &self.stored else {
            return vec![event];
        };
        if self.describing == Some(id) {
            if event.is_last() {
                self.describing = None;
            }
            return match &event {
                JobEvent::MapInfo(info) => {
                    self.compared += 1;
                    if *info == stored.map.info {
                        return Vec::new();
                    }
                    self.different += 1;
                    vec![event]
                }
                _ => vec![event],
            };
        }
        if self.flying != Some(id) {
            return vec![event];
        }
        let (rank, is_same) = match &event {
            JobEvent::Flight(flight) => (0, *flight == stored.flight),
            JobEvent::Mission(mission) => (1, *mission == stored.mission),
            // Once more, after a worker died: what it said beyond what is stored would be told twice.
            JobEvent::RunStarted(_) if self.is_beyond => {
                self.flying = None;
                let heads = stored.heads().into_iter().take(2);
                return heads.chain([event]).collect();
            }
            JobEvent::RunStarted(run) => {
                self.steps = 0;
                (2, *run == stored.run)
            }
            JobEvent::Steps(_) => return self.hear_steps(event),
            JobEvent::FrameTaken { index, digest: new } => {
                let Some(twin) = stored.pictures.get(index) else {
                    return vec![event];
                };
                self.compared += 1;
                if *new == Some(digest(&twin.0)) {
                    return Vec::new();
                }
                self.different += 1;
                self.outdated.push(*index);
                return vec![event];
            }
            _ => {
                if event.is_last() {
                    self.flying = None;
                }
                return vec![event];
            }
        };
        self.compared += 1;
        if is_same {
            return Vec::new();
        }
        self.different += 1;
        self.flying = None;
        let agreed = stored.heads().into_iter().take(rank);
        agreed.chain([event]).collect()
    }

    fn hear_steps(&mut self, event: JobEvent) -> Vec<JobEvent> {
        let (Some(stored), JobEvent::Steps(steps)) = (&self.stored, event) else {
            return Vec::new();
        };
        let mut new: Vec<StepReport> = Vec::new();
        let mut events = Vec::new();
        for step in steps {
            let twin = stored.steps.get(self.steps);
            let Some(twin) = twin.filter(|_| self.flying.is_some()) else {
                self.is_beyond = true;
                new.push(step);
                continue;
            };
            self.compared += 1;
            let timeless = StepReport {
                timing: StepTiming::default(),
                ..step.clone()
            };
            if timeless == *twin {
                self.steps += 1;
                continue;
            }
            // From here on the run is another one: it is told anew as far as it agreed.
            self.different += 1;
            self.flying = None;
            events.extend(stored.heads());
            new.extend_from_slice(&stored.steps[..self.steps]);
            new.push(step);
        }
        if !new.is_empty() {
            events.push(JobEvent::Steps(new));
        }
        events
    }
}

#[cfg(test)]
#[path = "prelude_tests.rs"]
mod tests;
