//! The times at which work is begun, and the map that it is about.

use super::{App, MapParts, MapWork};
use crate::host::Host;
use pilotage_jobs::{FlightSource, MapSource};

impl App {
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

    /// Starts what is due.
    pub(super) fn work(&mut self, context: &egui::Context, host: &mut dyn Host) {
        let now = host.now();
        // While people plan, the flight waits: its time is better spent on the prediction.
        let flies_now = !self.is_flight_hidden();
        if flies_now && self.fly_work.again_at.is_some_and(|at| at <= now) {
            self.fly_again(host);
        }
        self.documents.tend_noticed();
        self.tend_features(context, host);
        self.follow_world(host);
        self.height_work.ask(&mut self.documents, host);
        if self.documents.run.is_some() || self.fly_work.job.is_none() {
            // Else where the flight begins is about to be known; anything else would be asked in vain.
            let (documents, map) = (&self.documents, &self.views.map);
            self.map_work.ask_for_tiles(documents, map, host);
        }
        let camera = &self.views.camera;
        let (documents, playback) = (&self.documents, &self.playback);
        self.frame_pictures.ask(host, documents, playback, camera);
        let waiting = self.fly_work.again_at.is_some() && flies_now || self.dirty_since.is_some();
        if waiting {
            context.request_repaint_after(std::time::Duration::from_millis(60));
        }
    }
}
