//! Flying and navigating, streamed.

use std::cell::RefCell;
use std::rc::Rc;

use pilotage_core::flight::FrameSource;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{Navigator, StepReport};
use pilotage_core::plan::StatedFrames;

use serde::{Deserialize, Serialize};

use super::bare_mission::BareMission;
use super::flights::OpenFlight;
use super::frame_picture::digest;
use super::order::{Order, Reads, Urgency, WorkerRole, around, keys_of};
use super::running::{SLICE, slice};
use super::{Advance, FlightSource, JobEvent, MapSource, RunningJob, WorkerState};

/// A flight to be flown, or under way.
pub struct Fly {
    flight: FlightSource,
    map: MapSource,
    mission: Option<Mission>,
    stage: FlyStage,
}

enum FlyStage {
    /// Nothing done; the first slice only says so, that the page has something to show.
    Asked,
    /// The next slice opens the map.
    Map,
    /// The next slice opens the flight.
    Flight,
    /// The next slice begins to navigate.
    Navigator,
    /// Under way; with frames of its own where it is stated how landmarks are found.
    Flying(
        Rc<RefCell<OpenFlight>>,
        Box<(Navigator, Option<StatedFrames>)>,
    ),
    /// It cannot be navigated: its pictures are shown all the same, from this one on.
    Looking(Rc<RefCell<OpenFlight>>, usize),
}

impl Fly {
    /// A flight to be flown.
    pub fn new(flight: FlightSource, map: MapSource, mission: Option<Mission>) -> Self {
        Self {
            flight,
            map,
            mission,
            stage: FlyStage::Asked,
        }
    }

    fn open(
        &mut self,
        worker: &mut WorkerState,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<(), String> {
        let map = worker.map(&self.map)?;
        let open = worker.flight(&self.flight)?;
        let (flight, own_mission) = {
            let open = open.borrow();
            (open.flight.clone(), open.mission.clone())
        };
        let is_given = self.mission.is_some();
        let given = self
            .mission
            .take()
            .filter(|_| !self.flight.has_own_mission());
        let (mission, why) = if let Some(mission) = given.or(own_mission) {
            (mission, None)
        } else {
            let BareMission { mission, why } = BareMission::of(&flight, &self.map);
            (mission, Some(why))
        };
        let flown = mission.flown(&flight);
        let settings = &mission.navigator;
        let navigator = (open.borrow().frames).navigator(&flown, &mission, map, settings);
        emit(JobEvent::Flight(Box::new(flown.without_inertial())));
        if !is_given {
            emit(JobEvent::Mission(Box::new(mission)));
        }
        let begun = match navigator {
            Ok(begun) => begun,
            Err(cause) => {
                emit(JobEvent::CannotNavigate(cause));
                self.stage = FlyStage::Looking(open, 0);
                return Ok(());
            }
        };
        emit(JobEvent::RunStarted(Box::new(begun.0.run_head())));
        if let Some(why) = why {
            emit(JobEvent::WithoutMission(why.to_owned()));
        }
        emit(JobEvent::Progress(
            0.0,
            "Taking the first picture".to_owned(),
        ));
        self.stage = FlyStage::Flying(open, Box::new(begun));
        Ok(())
    }
}

/// Steps for about a slice; false once the flight is over.
fn steps(
    open: &mut OpenFlight,
    (navigator, stated): &mut (Navigator, Option<StatedFrames>),
    clock: &dyn Fn() -> f64,
    emit: &mut dyn FnMut(JobEvent),
) -> Result<bool, String> {
    let begun = clock();
    let mut batch: Vec<StepReport> = Vec::new();
    let mut more = true;
    while more && (batch.is_empty() || clock() - begun < SLICE) {
        let index = navigator.next_frame();
        let frames: &mut dyn FrameSource = match stated {
            Some(stated) => stated,
            None => &mut open.frames,
        };
        match navigator.advance(frames, clock) {
            Some(Ok(step)) => batch.push(step),
            Some(Err(cause)) => return Err(cause.to_string()),
            None => more = false,
        }
        if let Some(index) = index {
            tell_picture(open, index, emit);
        }
    }
    if !batch.is_empty() {
        emit(JobEvent::Steps(batch));
    }
    let (done, all) = navigator.progress();
    let fraction = done as f32 / all.max(1) as f32;
    emit(JobEvent::Progress(fraction, "Flying".to_owned()));
    Ok(more)
}

/// Pictures for about a slice, from `index` on; false after the last.
fn pictures(
    open: &mut OpenFlight,
    index: &mut usize,
    clock: &dyn Fn() -> f64,
    emit: &mut dyn FnMut(JobEvent),
) -> bool {
    let count = open.flight.frames.len();
    slice(clock, || {
        if *index < count {
            tell_picture(open, *index, emit);
            *index += 1;
        }
        *index < count
    })
}

/// Tells that a picture was taken, if the flight has any. One that cannot be had is told by the step's report, and to
/// whoever asks for it.
fn tell_picture(open: &OpenFlight, index: usize, emit: &mut dyn FnMut(JobEvent)) {
    if open.frames.statement().is_some() {
        return;
    }
    let digest = open.frames.rendered_before(index).map(digest);
    emit(JobEvent::FrameTaken { index, digest });
}

impl RunningJob for Fly {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let more = match &mut self.stage {
            FlyStage::Asked => {
                emit(JobEvent::Progress(0.0, "Opening the map".to_owned()));
                self.stage = FlyStage::Map;
                true
            }
            FlyStage::Map => {
                worker.map(&self.map)?;
                emit(JobEvent::Progress(0.0, "Preparing the flight".to_owned()));
                self.stage = FlyStage::Flight;
                true
            }
            FlyStage::Flight => {
                worker.flight(&self.flight)?;
                self.stage = FlyStage::Navigator;
                true
            }
            FlyStage::Navigator => {
                self.open(worker, emit)?;
                true
            }
            FlyStage::Flying(open, begun) => steps(&mut open.borrow_mut(), begun, clock, emit)?,
            FlyStage::Looking(open, index) => pictures(&mut open.borrow_mut(), index, clock, emit),
        };
        if more {
            return Ok(Advance::More);
        }
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

/// Flight to be flown and navigated: events `Flight`, `Mission` (if none was given), `RunStarted`, then `Steps` and
/// `FrameTaken`; or `CannotNavigate` in the place of `RunStarted` and `Steps`. `WithoutMission` after `RunStarted` says
/// by what a flight is navigated that came without one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FlyOrder {
    /// The flight.
    pub flight: FlightSource,
    /// The map.
    pub map: MapSource,
    /// The mission; the flight's own if `None`, or else a [`BareMission`].
    pub mission: Option<Mission>,
}

impl Order for FlyOrder {
    const URGENCY: Urgency = Urgency::Flight;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn files(&self) -> Vec<&str> {
        keys_of(Some(&self.flight), Some(&self.map))
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        let landmarks = self.mission.iter().flat_map(|mission| &mission.landmarks);
        let mut areas: Vec<_> = landmarks.map(|landmark| around(&landmark.bounds)).collect();
        if let FlightSource::Rehearsed(flight) = &self.flight {
            areas.extend(flight.path.ground());
        }
        Some((&self.map, Reads::Areas(areas)))
    }

    fn is_small(&self) -> bool {
        self.flight.is_small() && self.map.is_small()
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(Fly::new(self.flight, self.map, self.mission))
    }
}
