//! The estimated track as a file of another program.

use pilotage_core::exchange::{FlownPoint, FlownTrack, FlownValues, Format};
use pilotage_core::frames::LocalFrame;
use pilotage_core::navigator::Run;

use super::App;
use super::desk::Exporting;
use crate::host::Host;
use crate::jobs::{ExportOrder, Job};
use crate::log::series_name;

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
        self.desk.exporting.push(Exporting {
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
        Some(FlownTrack {
            name: format!("{}, estimate", flight.name),
            utc_at_zero: log.and_then(|log| log.outline.as_ref()?.utc_at_zero),
            has_height: false,
            values,
            points: points(run, &frame, |time| coloured.and_then(|(_, s)| s.at(time))),
        })
    }
}

fn points(run: &Run, frame: &LocalFrame, value: impl Fn(f64) -> Option<f64>) -> Vec<FlownPoint> {
    let of_step = |(time, place)| FlownPoint {
        time,
        place: frame.geodetic_from_ground(&place),
        value: value(time),
    };
    let steps = run.steps.iter();
    steps
        .map(|step| of_step((step.time, step.after.position())))
        .collect()
}
