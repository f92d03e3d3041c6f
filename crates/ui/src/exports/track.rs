//! The estimated track as a file of another program.

use pilotage_core::exchange::{FlownTrack, Format};
use pilotage_core::frames::LocalFrame;
use pilotage_jobs::{ExportOrder, TrackSeries};

use crate::export_command::ExportedFile;
use crate::feature::{Feature, FeatureContext};
use crate::host::stem;

/// File of where the filter thought the aircraft was, with the field beside it that colours the recorded track, and how
/// it is made; none without a run.
pub(super) fn track_file(
    format: Format,
    context: &FeatureContext<'_>,
) -> Option<(ExportedFile, ExportOrder)> {
    let (track, beside) = flown_track(context)?;
    let name = stem(&context.documents.mission.name);
    let part = context.documents.part_flown();
    let part = part.map_or_else(String::new, |part| format!(" ({part})"));
    let file = ExportedFile {
        what: format!("Flown track{part}"),
        format: format.name(),
        name: format!("{name}-track.{}", format.extensions()[0]),
    };
    let order = ExportOrder::Track {
        format,
        track,
        beside,
    };
    Some((file, order))
}

/// The track, and the series whose values stand beside it.
fn flown_track(context: &FeatureContext<'_>) -> Option<(FlownTrack, Option<TrackSeries>)> {
    let documents = &*context.documents;
    let run = documents.run.navigated.as_ref()?;
    let flight = documents.flight.measured.as_ref()?;
    let frame = flight.frame_on_globe;
    let frame = frame.unwrap_or_else(|| LocalFrame::new(documents.mission.origin));
    let log = documents.flight.log.as_ref();
    let utc_at_zero = log.and_then(|log| log.utc_at_zero);
    let mut track = run.estimated_track(&flight.name, &frame, utc_at_zero);
    let mut others = context.others();
    let beside = others.find_map(Feature::series_along);
    let beside = beside.map(|(what, along)| {
        track.values = Some(what);
        along
    });
    Some((track, beside))
}
