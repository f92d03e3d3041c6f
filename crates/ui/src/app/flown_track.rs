//! The estimated track as a file of another program.

use pilotage_core::exchange::{FlownTrack, Format};
use pilotage_core::frames::LocalFrame;

use super::App;
use crate::exports::ExportedFile;
use crate::host::Host;
use pilotage_jobs::ExportOrder;

impl App {
    /// Has where the filter thought the aircraft was made into a file, with the field beside it that colours the
    /// recorded track.
    pub(super) fn export_track(&mut self, format: Format, host: &mut dyn Host) {
        let now = host.now();
        let Some(track) = self.flown_track() else {
            let text = "Open a flight or simulate one, and let it be navigated.";
            self.toasts.note(now, "No flown track to save", text);
            return;
        };
        let name = format!("{}-track.{}", self.file_stem(), format.extensions()[0]);
        let order = ExportOrder::Track { format, track };
        let file = ExportedFile {
            what: "Flown track",
            format: format.name(),
            name,
        };
        self.exports.make(file, order, host);
    }

    fn flown_track(&self) -> Option<FlownTrack> {
        let documents = &self.documents;
        let run = documents.run.as_ref().filter(|run| !run.steps.is_empty())?;
        let flight = documents.flight.as_ref()?;
        let frame = flight.frame_on_globe;
        let frame = frame.unwrap_or_else(|| LocalFrame::new(documents.mission.origin));
        let mut track = run.estimated_track(&flight.name, &frame);
        track.utc_at_zero = documents.log.as_ref().and_then(|log| log.utc_at_zero);
        let times: Vec<f64> = track.points.iter().map(|point| point.time).collect();
        let mut features = self.views.features.iter();
        if let Some((what, values)) = features.find_map(|it| it.values_along(&times)) {
            track.values = Some(what);
            for (point, value) in track.points.iter_mut().zip(values) {
                point.value = value;
            }
        }
        Some(track)
    }
}
