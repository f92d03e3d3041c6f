//! Another flight is open: nothing that was computed, asked or looked at of the one before is of use.

use super::App;
use crate::host::Host;
use crate::photos::PhotosState;

impl App {
    /// Leaves what is being done about the flight that was open, once another one is. To be called after whatever can
    /// change the flight, before anything else is done: an answer about the old one would be taken for the new one's.
    pub(super) fn follow_flight(&mut self, egui: &egui::Context, host: &mut dyn Host) {
        let generation = self.documents.flight_generation;
        if self.followed.0 == generation {
            return;
        }
        let source = self.documents.flight_source.clone();
        let (_, old) = std::mem::replace(&mut self.followed, (generation, source));
        self.tell_features_of_flight(egui, host);
        self.leave_strange_photos(host);
        if old != self.documents.flight_source {
            self.playback.selected_span = None;
        }
        self.frame_pictures.leave(host);
        self.views.camera.clear();
        let mission = &self.documents.mission;
        self.selection = self.selection.filter(|id| mission.landmark(*id).is_some());
    }

    /// Leaves photos that were laid in another world: their places mean nothing in this one.
    fn leave_strange_photos(&mut self, host: &mut dyn Host) {
        let documents = &self.documents;
        let is_strange = documents.photos.sought.as_ref().is_some_and(|sought| {
            let is_flown = documents.flight_source.key() == Some(&sought.key);
            !is_flown && sought.origin != documents.world_origin()
        });
        if is_strange {
            self.stop_laying(host);
            if let Some((id, _)) = self.jobs.draping.take() {
                host.cancel(id);
            }
            let mut photos = PhotosState::default();
            photos.search = self.documents.photos.search;
            self.documents.photos = photos;
        }
    }
}
