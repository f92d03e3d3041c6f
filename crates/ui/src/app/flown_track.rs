//! The estimated track as a file of another program.

use pilotage_core::exchange::{FlownTrack, FlownValues, Format};
use pilotage_core::frames::LocalFrame;

use super::App;
use super::pending_jobs::Exporting;
use crate::host::Host;
use crate::log::series_name;
use pilotage_jobs::{ExportOrder, Job};

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
        self.jobs.exporting.push(Exporting {
            id: host.start(Job::Export(Box::new(order))),
            what: "Flown track",
            format: format.name(),
            name,
        });
    }

    fn flown_track(&self) -> Option<FlownTrack> {
        let documents = &self.documents;
        let run = documents.run.as_ref().filter(|run| !run.steps.is_empty())?;
        let flight = documents.flight.as_ref()?;
        let log = documents.log.as_ref();
        let field = self.views.map.track_field();
        let coloured = field.and_then(|name| Some((name, log?.series.get(name)?)));
        let values = coloured.map(|(name, series)| FlownValues {
            name: series_name(name),
            unit: series.unit.clone(),
        });
        let frame = flight.frame_on_globe;
        let frame = frame.unwrap_or_else(|| LocalFrame::new(documents.mission.origin));
        let mut track = run.estimated_track(&flight.name, &frame);
        track.utc_at_zero = log.and_then(|log| log.outline.as_ref()?.utc_at_zero);
        track.values = values;
        for point in &mut track.points {
            point.value = coloured.and_then(|(_, series)| series.at(point.time));
        }
        Some(track)
    }
}
