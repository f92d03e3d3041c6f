//! Tables of a flight as a feature: asked about, made a flight in a worker, and flown.

use egui::Ui;
use pilotage_core::flight::columns::GuessedTable;
use pilotage_jobs::{
    COLUMNS_FILE, Job, JobEvent, JobId, MadeFlight, MakeFlightOrder, OpenedFiles, write_columns,
};
use serde_json::Value;

use super::dialog::{ColumnsDialog, ColumnsDraft};
use super::{ColumnsCommand, ID};
use crate::context::ViewContext;
use crate::documents::kept::{provide, put_beside};
use crate::documents::{Documents, with_origin};
use crate::feature::{
    Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace, FlightFiles, OpenedSet,
};
use crate::shell::whole_sentences;
use crate::state_json::object;

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: ID,
    tab: "Columns",
    place: FeaturePlace::Dialog,
    commands: Vec::new,
};

/// Tables that are asked about, while the dialog is open.
#[derive(Default)]
pub struct ColumnsFeature {
    dialog: ColumnsDialog,
}

impl ColumnsFeature {
    /// Asks what the columns of tables mean; what was asked about before is left.
    fn ask(
        &mut self,
        set: &OpenedSet,
        tables: Vec<GuessedTable>,
        context: &mut FeatureContext<'_>,
    ) {
        self.leave(context);
        let mut files = set.files.clone();
        files.retain(|file| file.path != COLUMNS_FILE);
        let draft = ColumnsDraft::new(set.key.clone(), set.name.clone(), files, tables);
        self.dialog.open(draft);
        context.playback.playing = false;
    }

    /// Asks no more, and has no flight made of what was answered.
    fn leave(&mut self, context: &mut FeatureContext<'_>) {
        if let Some(job) = self.dialog.close().and_then(|draft| draft.job) {
            context.cancel(job);
        }
    }

    /// Gives the workers the maps beside the tables, and has the flight made.
    fn make_flight(&mut self, context: &mut FeatureContext<'_>) {
        let Some(draft) = self.dialog.draft_mut() else {
            return;
        };
        if draft.job.is_some() || draft.lacks().is_some() {
            return;
        }
        let maps = write_columns(&draft.maps());
        put_beside(&mut draft.files, COLUMNS_FILE, maps);
        let key = draft.key.clone();
        provide(context.host, &key, &draft.files);
        draft.failed = None;
        draft.job = Some(context.start(Job::MakeFlight(MakeFlightOrder { key })));
    }

    fn take_flight(&mut self, made: &MadeFlight, context: &mut FeatureContext<'_>) {
        let Some(draft) = self.dialog.close() else {
            return;
        };
        let frame = made.flight.frame_on_globe;
        let map = with_origin(context.documents.map_under(frame), frame);
        let title = format!("Opened a flight from {}", draft.name);
        context.note(&title, whole_sentences(&made.notes));
        let (key, name) = (draft.key.clone(), made.flight.name.clone());
        context.read(FlightFiles::opened(key, name, Some(map), None));
        context.keep(OpenedSet {
            key: draft.key,
            name: draft.name,
            files: draft.files,
        });
    }
}

impl Feature for ColumnsFeature {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        match command.action::<ColumnsCommand>() {
            Some(ColumnsCommand::Cancel) => self.leave(context),
            Some(ColumnsCommand::OpenFlight) => self.make_flight(context),
            None => return false,
        }
        true
    }

    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, _documents: &Documents) {
        let (tokens, units) = (context.tokens, context.units);
        self.dialog.show(ui.ctx(), tokens, units, context.commands);
    }

    fn on_event(&mut self, job: JobId, event: JobEvent, context: &mut FeatureContext<'_>) -> bool {
        let is_awaited = |draft: &&mut ColumnsDraft| draft.job == Some(job);
        let Some(draft) = self.dialog.draft_mut().filter(is_awaited) else {
            return false;
        };
        match event {
            JobEvent::FlightMade(made) => {
                context.wait_no_more(job);
                self.take_flight(&made, context);
            }
            JobEvent::Failed(why) => {
                draft.job = None;
                draft.failed = Some(why);
            }
            JobEvent::Finished | JobEvent::Cancelled => draft.job = None,
            JobEvent::Progress(..) => {}
            _ => return false,
        }
        true
    }

    fn take_first(
        &mut self,
        set: &OpenedSet,
        opened: &mut OpenedFiles,
        context: &mut FeatureContext<'_>,
    ) -> bool {
        let tables = std::mem::take(&mut opened.tables);
        if !tables.is_empty() {
            self.ask(set, tables, context);
        } else if opened.flight.is_some() || opened.log.is_some() || opened.run.is_some() {
            // What is asked about was to be the flight that is shown, and is so no more.
            self.leave(context);
        }
        false
    }

    fn used_files(&self) -> Vec<&str> {
        let draft = self.dialog.draft().into_iter();
        draft.map(|draft| draft.key.as_str()).collect()
    }

    fn is_open_over(&self) -> bool {
        self.dialog.draft().is_some()
    }

    fn takes_letters(&self) -> bool {
        self.is_open_over()
    }

    fn state(&self, _documents: &Documents) -> Value {
        let Some(draft) = self.dialog.draft() else {
            return Value::Null;
        };
        let tables = draft.tables.iter().map(|table| {
            let columns = table.guess.map.columns.iter().map(|column| {
                object!({"name": column.name, "role": column.role.label(), "unit": column.unit})
            });
            object!({
                "file": table.guess.map.file,
                "used": table.is_used,
                "columns": columns.collect::<Vec<_>>(),
            })
        });
        object!({
            "tables": tables.collect::<Vec<_>>(),
            "lacks": draft.lacks(),
            "failed": draft.failed,
            "making": draft.job.is_some(),
        })
    }
}
