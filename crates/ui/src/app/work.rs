//! Jobs asked of the workers, and the times at which they are asked for.

use pilotage_core::mission::Mission;
use pilotage_core::navigator::Run;

use super::App;
use super::pending_jobs::{FlyJob, ShownFlight};
use crate::documents::{Session, Staged};
use crate::host::Host;
use crate::map::TILES_AT_A_TIME;
use pilotage_jobs::{DescribeMapOrder, FlightSource, FlyOrder, Job, MapSource, TileOrder};

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

    pub(super) fn describe_map(&mut self, host: &mut dyn Host) {
        let source = self.documents.map_source.clone();
        self.jobs.describe = Some(host.start(Job::DescribeMap(DescribeMapOrder(source))));
    }

    /// Another map is shown: nothing of the old one is of use.
    pub(super) fn change_map(&mut self, host: &mut dyn Host, map: MapSource) {
        if self.documents.map_source == map && self.documents.map.is_some() {
            return;
        }
        for id in self.jobs.tiles.drain().map(|(id, _)| id) {
            host.cancel(id);
        }
        if let Some((job, ..)) = self.jobs.preparing.take() {
            host.cancel(job);
        }
        self.jobs.prepare_declined = false;
        self.documents.map_source = map;
        self.documents.map = None;
        self.documents.distinctness.clear();
        self.views.map.tiles.clear();
        self.let_go_of_files(host);
        self.describe_map(host);
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
        self.ask_for_heights(host);
        self.ask_for_tiles(host);
        let camera = &self.views.camera;
        let (documents, playback) = (&self.documents, &self.playback);
        self.frame_pictures.ask(host, documents, playback, camera);
        let waiting = self.jobs.fly_again_at.is_some() && flies_now || self.dirty_since.is_some();
        if waiting {
            context.request_repaint_after(std::time::Duration::from_millis(60));
        }
    }

    fn ask_for_tiles(&mut self, host: &mut dyn Host) {
        if self.documents.run.is_none() && self.jobs.fly.is_some() {
            // Where the flight begins is about to be known; anything else would be asked in vain.
            return;
        }
        let wanted = self.views.map.tiles.wanted();
        let stale: Vec<_> = self
            .jobs
            .tiles
            .iter()
            .filter(|(_, key)| !wanted.contains(key))
            .map(|(id, _)| *id)
            .collect();
        for id in stale {
            self.jobs.tiles.remove(&id);
            host.cancel(id);
        }
        let under_way: Vec<_> = self.jobs.tiles.iter().map(|(_, key)| *key).collect();
        let room = TILES_AT_A_TIME.saturating_sub(under_way.len());
        let next: Vec<_> = wanted
            .iter()
            .filter(|key| !under_way.contains(key))
            .take(room)
            .copied()
            .collect();
        for key in next {
            let id = host.start(Job::Tile(TileOrder {
                map: self.documents.map_source.clone(),
                window: key.window(),
            }));
            self.jobs.tiles.insert(id, key);
        }
    }
}
