//! State of the log, for journeys.

use serde_json::{Value, json};

use super::series_name;
use super::work::LogFeature;
use crate::documents::Documents;

impl LogFeature {
    /// State of the log, for journeys; null if none is open.
    pub(super) fn report(&self, documents: &Documents) -> Value {
        let Some(log) = &self.log else {
            return Value::Null;
        };
        let outline = log.outline.as_ref();
        let panels: Vec<Vec<String>> = (self.plots.panels())
            .map(|fields| fields.iter().map(series_name).collect())
            .collect();
        let noticed = documents.noticed();
        let findings = log.overview.iter().flat_map(|o| &o.findings);
        let findings = findings.chain(&noticed);
        let points: usize = log.series.values().map(|s| s.times.len()).sum();
        let file = documents.flight.log.as_ref();
        json!({
            "file": log.file,
            "read": log.is_read(),
            "format": outline.map(|o| format!("{:?}", o.format)),
            "topics": outline.map(|o| o.topics.len()),
            "messages": outline.map(|o| o.report.messages),
            "skipped": outline.map(|o| o.report.skipped_bytes),
            "parameters": outline.map(|o| o.parameters.len()),
            "modes": outline.map(|o| o.modes.len()),
            "vehicles": outline.map(|o| o.vehicles.clone()),
            "vehicle": outline.and_then(|o| o.chosen_vehicle),
            "tracks": log.tracks.0.iter().map(|t| json!([t.name, t.places.len()])).collect::<Vec<_>>(),
            "unnavigable": file.and_then(|file| file.unnavigable.as_ref()),
            "findings": findings.map(|f| f.title.clone()).collect::<Vec<_>>(),
            "panels": panels,
            "against": self.plots.arrangement().iter().map(|panel| {
                panel.against.as_ref().map(series_name)
            }).collect::<Vec<_>>(),
            "figures": log.figures.fields.len(),
            "presets": self.presets.all().iter().map(|p| &p.name).collect::<Vec<_>>(),
            "fields": log.series.len(),
            "points": points,
            "track_by": self.track_field.as_ref().map(series_name),
        })
    }
}
