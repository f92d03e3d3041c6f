//! Jobs asked of the workers, and the times at which they are asked for.

use pilotage_core::mission::Mission;
use pilotage_core::navigator::Run;

use super::pending_jobs::{FlyJob, ShownFlight};
use super::{App, MapParts, MapWork};
use crate::documents::{Session, Staged};
use crate::host::Host;
use pilotage_jobs::{FlightSource, FlyOrder, Job, MapSource};

/// Delay after the last of several changes before the run is computed again, milliseconds.
const FLY_AGAIN_AFTER: f64 = 350.0;

impl App {
    /// Flies another flight; what is open stays until it begins.
    pub(super) fn fly_new(
        &mut self,
        egui: &egui::Context,
        host: &mut dyn Host,
        flight: FlightSource,
        map: MapSource,
        mission: Option<Mission>,
    ) {
        self.tell_of_other_flight(egui, host);
        let staged = Staged {
            flight: None,
            mission: mission.clone(),
            ..Staged::default()
        };
        self.begin(host, flight, map, mission, staged, false);
    }

    /// Flies what a session names with the mission that is open, which stays: it may be edited before
    /// the run begins.
    pub(super) fn fly_open(&mut self, host: &mut dyn Host, session: Session) {
        let Session {
            flight,
            map,
            mission,
            ..
        } = session;
        let staged = Staged {
            keeps_edits: true,
            ..Staged::default()
        };
        self.begin(host, flight, map, mission, staged, false);
    }

    /// Flies the same flight again with the mission as it is now.
    pub(super) fn fly_again(&mut self, host: &mut dyn Host) {
        // What is edited meanwhile is added to the flight's own mission, which is yet to come.
        let awaited = |fly: &FlyJob| !fly.given && !fly.began();
        if self.jobs.fly.as_ref().is_some_and(awaited) {
            self.jobs.fly_again_at = Some(host.now() + FLY_AGAIN_AFTER);
            return;
        }
        self.jobs.fly_again_at = None;
        let again = self.documents.run.is_some();
        let mission = Some(self.documents.mission.clone());
        let flight = self.documents.flight_source.clone();
        let map = self.documents.map_source.clone();
        self.begin(host, flight, map, mission, Staged::default(), again);
    }

    fn begin(
        &mut self,
        host: &mut dyn Host,
        flight: FlightSource,
        map: MapSource,
        mission: Option<Mission>,
        staged: Staged,
        again: bool,
    ) {
        self.stop_flying(host);
        if flight == FlightSource::Nothing {
            return;
        }
        let given = mission.is_some();
        let staged = Staged {
            camera_to_log: mission.as_ref().and_then(|m| m.camera_to_log),
            ..staged
        };
        let id = host.start(Job::Fly(FlyOrder {
            flight: flight.clone(),
            map: map.clone(),
            mission,
        }));
        self.jobs.fly = Some(FlyJob {
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

    /// Shows a run out of a file. The flight that is under way beneath it goes on for its pictures.
    pub(super) fn show_opened_run(&mut self, host: &mut dyn Host, run: Run) {
        match self.jobs.fly.as_mut().filter(|fly| fly.began()) {
            Some(fly) => {
                fly.shown = ShownFlight::Pictures;
                self.jobs.fly_again_at = None;
            }
            None => self.stop_flying(host),
        }
        self.documents.begin_run_again(run, Staged::default());
        self.documents.run_complete = true;
    }

    /// Stops what is being flown; what has streamed in stays.
    pub(super) fn stop_flying(&mut self, host: &mut dyn Host) {
        self.jobs.fly_again_at = None;
        if let Some(fly) = self.jobs.fly.take() {
            host.cancel(fly.id);
        }
    }

    /// Work on the map, and what is lent to it.
    pub(super) fn map_parts<'a>(
        &'a mut self,
        host: &'a mut dyn Host,
    ) -> (&'a mut MapWork, MapParts<'a>) {
        let parts = MapParts {
            documents: &mut self.documents,
            view: &mut self.views.map,
            toasts: &mut self.toasts,
            host,
        };
        (&mut self.map_work, parts)
    }

    /// Shows another map.
    pub(super) fn change_map(&mut self, host: &mut dyn Host, map: MapSource) {
        let (work, mut parts) = self.map_parts(host);
        if work.leave_for(map, &mut parts) {
            self.let_go_of_files(host);
            self.map_work.describe(&self.documents, host);
        }
    }

    /// Keeps the map to the mission's world where nothing is flown: after an undo, or a mission that was
    /// opened, that may be another one.
    fn follow_world(&mut self, host: &mut dyn Host) {
        let documents = &self.documents;
        let Some(origin) = documents.map_source.origin() else {
            return;
        };
        let world = documents.mission.origin;
        if documents.flight_source == FlightSource::Nothing && world != origin {
            let moved = documents.map_source.moved(world);
            self.change_map(host, moved);
        }
    }

    /// The mission changed in a way that changes the run.
    pub(super) fn run_is_stale(&mut self, now: f64) {
        self.jobs.fly_again_at = Some(now + FLY_AGAIN_AFTER);
        self.jobs.document_changed = true;
    }

    /// Starts what is due.
    pub(super) fn work(&mut self, context: &egui::Context, host: &mut dyn Host) {
        let now = host.now();
        // While people plan, the flight waits: its time is better spent on the prediction.
        let flies_now = !self.is_flight_hidden();
        if flies_now && self.jobs.fly_again_at.is_some_and(|at| at <= now) {
            self.fly_again(host);
        }
        self.documents.tend_noticed();
        self.tend_features(context, host);
        self.follow_world(host);
        self.height_work.ask(&mut self.documents, host);
        if self.documents.run.is_some() || self.jobs.fly.is_none() {
            // Else where the flight begins is about to be known; anything else would be asked in vain.
            let (documents, map) = (&self.documents, &self.views.map);
            self.map_work.ask_for_tiles(documents, map, host);
        }
        let camera = &self.views.camera;
        let (documents, playback) = (&self.documents, &self.playback);
        self.frame_pictures.ask(host, documents, playback, camera);
        let waiting = self.jobs.fly_again_at.is_some() && flies_now || self.dirty_since.is_some();
        if waiting {
            context.request_repaint_after(std::time::Duration::from_millis(60));
        }
    }
}
