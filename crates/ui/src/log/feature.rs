//! The log as a feature: its commands, jobs, panels and layers.

use egui::{Painter, Pos2, Rect, Ui};
use pilotage_core::exchange::FlownValues;
use pilotage_core::frames::LocalFrame;
use pilotage_jobs::{JobEvent, JobId, MapSource, TrackSeries};
use serde_json::Value;

use super::catalog::commands;
use super::coloured_track::ColouredTrack;
use super::work::LogFeature;
use super::{ID, LogCommand, OwnPresets, PRESETS_KEY, series_name};
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::feature::{
    Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace, FlightFiles,
};
use crate::map::{MapLayer, ScreenFromWorld};
use crate::shell::CommandLack;
use crate::tokens::Tokens;

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: ID,
    tab: "Log",
    place: FeaturePlace::FirstTab,
    commands,
};

impl LogFeature {
    /// The field by which the recorded track is coloured, as far as it has come.
    fn coloured(&self) -> Option<ColouredTrack<'_>> {
        let name = self.track_field.as_ref()?;
        let series = self.log.as_ref()?.series.get(name)?;
        Some(ColouredTrack { name, series })
    }
}

impl Feature for LogFeature {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        let command = command.action::<LogCommand>();
        if let Some(command) = command {
            self.carry_out(command.clone(), context);
        }
        command.is_some()
    }

    fn missing(
        &self,
        _command: &FeatureCommand,
        _documents: &Documents,
        _selected: Option<u32>,
    ) -> Option<CommandLack> {
        CommandLack::unless(self.log.is_some(), "No log is open", "Open one first.")
    }

    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, documents: &Documents) {
        self.column(ui, context, documents);
    }

    fn layers(&self) -> Vec<&dyn MapLayer> {
        let tracks = self.log.iter().filter(|log| !log.tracks.0.is_empty());
        let coloured: &dyn MapLayer = self;
        [coloured]
            .into_iter()
            .chain(tracks.map(|log| -> &dyn MapLayer { log }))
            .collect()
    }

    fn on_event(&mut self, job: JobId, event: JobEvent, context: &mut FeatureContext<'_>) -> bool {
        if self.fetches(job) {
            self.series_event(job, &event)
        } else if self.answers.has(job) {
            self.answer_event(job, &event, context)
        } else {
            self.reading_event(job, event, context)
        }
    }

    fn stop(&mut self, context: &mut FeatureContext<'_>) -> bool {
        self.stop_reading(context)
    }

    fn on_flight_changed(&mut self, context: &mut FeatureContext<'_>) {
        if context.documents.flight.log.is_none() {
            self.leave(context);
            self.log = None;
        }
    }

    fn tend(&mut self, context: &mut FeatureContext<'_>) {
        if self.presets != self.stored_presets {
            context.host.store(PRESETS_KEY, &self.presets.encode());
            self.stored_presets = self.presets.clone();
        }
        self.fetch(context);
        self.ask_for_figures(context);
    }

    fn state(&self, documents: &Documents) -> Value {
        self.report(documents)
    }

    fn start(&mut self, context: &mut FeatureContext<'_>) {
        if let Some(bytes) = context.host.recall(PRESETS_KEY) {
            self.presets = OwnPresets::decode(&bytes);
            self.stored_presets = self.presets.clone();
        }
    }

    fn progress(&self) -> Option<(f32, &str)> {
        let reading = self.reading.as_ref();
        let reading = reading.map(|it| (it.progress, it.words.as_str()));
        let table = self.answers.table.as_ref();
        reading.or_else(|| Some((table?.progress, "Writing the table")))
    }

    fn has_tab(&self) -> bool {
        self.log.is_some()
    }

    fn has_plots(&self) -> bool {
        self.log.is_some()
    }

    fn plots(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, _documents: &Documents) {
        self.draw_plots(ui, context);
    }

    fn leaves_room_for_run(&self) -> bool {
        !self.shows_plots
    }

    fn leaves_map_empty(&self, documents: &Documents) -> bool {
        let log = self.log.as_ref();
        let has_no_track = log.is_some_and(|log| log.tracks.0.is_empty());
        let is_read = self.reading.is_none()
            && documents
                .flight
                .log
                .as_ref()
                .is_some_and(|it| it.unnavigable.is_some());
        has_no_track
            && is_read
            && documents.flight.measured.is_none()
            && documents.map.source == MapSource::Nothing
    }

    fn read_flight(&mut self, files: &FlightFiles, context: &mut FeatureContext<'_>) {
        if !files.is_open {
            self.rereads = 0;
        }
        self.read(files.clone(), context);
    }

    fn on_other_flight(&mut self, context: &mut FeatureContext<'_>) {
        self.stop_reading(context);
    }

    fn used_files(&self) -> Vec<&str> {
        let reading = self.reading.iter();
        reading.map(|reading| reading.flight.key.as_str()).collect()
    }

    fn on_log_lost(&mut self) {
        self.lose();
    }

    /// The field that colours the recorded track.
    fn series_along(&self) -> Option<(FlownValues, TrackSeries)> {
        let ColouredTrack { name, series } = self.coloured()?;
        let log = self.log.as_ref()?;
        let what = FlownValues {
            name: series_name(name),
            unit: series.unit.clone(),
        };
        let along = TrackSeries {
            key: log.key.clone(),
            file: log.file.clone(),
            series: name.clone(),
        };
        Some((what, along))
    }
}

impl MapLayer for LogFeature {
    /// Draws the recorded track coloured by a field.
    fn paint(
        &self,
        painter: &Painter,
        view: &ScreenFromWorld,
        context: &ViewContext<'_>,
        _frame: Option<LocalFrame>,
    ) {
        let truth = context.flight.and_then(|flight| flight.truth.as_ref());
        if let Some((coloured, truth)) = self.coloured().zip(truth) {
            coloured.paint(painter, view, truth, context.tokens);
        }
    }

    fn replaces_truth(&self) -> bool {
        self.coloured().is_some()
    }

    fn paint_scale(&self, painter: &Painter, corner: Pos2, tokens: &Tokens) -> Option<Rect> {
        self.coloured()?.paint_scale(painter, corner, tokens)
    }
}
