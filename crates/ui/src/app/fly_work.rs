//! The flight that is being flown in a worker.

use pilotage_core::mission::Mission;
use pilotage_jobs::{FlightSource, FlyOrder, Job, JobId, MapSource};

use crate::documents::Staged;
use crate::host::Host;
use crate::job_owners::JobOwner;

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
    /// Whether what it flew is the run that is shown, and no repetition of it.
    pub fn has_new_run(&self) -> bool {
        !self.again && self.shown == ShownFlight::Run
    }

    /// Whether it is seen by a camera: of a flight of a study, the plan says how often landmarks are recognised.
    pub fn has_pictures(&self) -> bool {
        !matches!(self.flight, FlightSource::Studied(_))
    }

    /// Whether its run has begun.
    pub fn began(&self) -> bool {
        self.shown != ShownFlight::Nothing
    }
}

/// The flight being flown, and when it is to be flown again.
#[derive(Debug, Default)]
pub struct FlyWork {
    /// The flight, while it is flown.
    pub job: Option<FlyJob>,
    /// When to fly again after a change, milliseconds of the host's clock.
    pub again_at: Option<f64>,
}

impl FlyWork {
    /// Flies a flight in the place of the one under way.
    pub fn begin(
        &mut self,
        (flight, map): (FlightSource, MapSource),
        mission: Option<Mission>,
        staged: Staged,
        again: bool,
        host: &mut dyn Host,
    ) {
        self.stop(host);
        if flight == FlightSource::Nothing {
            return;
        }
        let given = mission.is_some();
        let staged = Staged {
            camera_to_log: mission.as_ref().and_then(|m| m.camera_to_log),
            ..staged
        };
        let order = FlyOrder {
            flight: flight.clone(),
            map: map.clone(),
            mission,
        };
        let id = host.start(JobOwner::Flight, Job::Fly(order));
        self.job = Some(FlyJob {
            id,
            again,
            given,
            flight,
            map,
            staged,
            progress: 0.0,
            words: "Starting …".to_owned(),
            shown: ShownFlight::Nothing,
        });
    }

    /// Stops what is being flown; what has streamed in stays.
    pub fn stop(&mut self, host: &mut dyn Host) {
        self.again_at = None;
        if let Some(fly) = self.job.take() {
            host.leave(fly.id);
        }
    }

    /// Progress of the flight under way, 0 to 1, and its words.
    pub fn progress(&self) -> Option<(f32, &str)> {
        let fly = self.job.as_ref()?;
        Some((fly.progress, fly.words.as_str()))
    }
}
