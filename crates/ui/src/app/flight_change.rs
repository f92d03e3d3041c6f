//! Another flight is open: nothing that was computed, asked or looked at of the one before is of use.

use super::App;
use crate::host::Host;

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
        if old != self.documents.flight_source {
            self.playback.selected_span = None;
        }
        self.frame_pictures.leave(host);
        self.views.camera.clear();
        let mission = &self.documents.mission;
        self.selection = self.selection.filter(|id| mission.landmark(*id).is_some());
    }
}
