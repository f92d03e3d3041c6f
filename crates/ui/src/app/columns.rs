//! Tables of a flight: asked about, made a flight in a worker, and flown.

use pilotage_core::flight::columns::GuessedTable;
use pilotage_core::text::capitalised;
use serde_json::{Value, json};

use super::App;
use crate::dialogs::{ColumnsCommand, ColumnsDraft};
use crate::documents::kept::{provide, put_beside};
use crate::documents::with_origin;
use crate::feature::FlightFiles;
use crate::feature::OpenedSet;
use crate::host::Host;
use pilotage_jobs::{COLUMNS_FILE, Job, JobEvent, MadeFlight, MakeFlightOrder, write_columns};

impl App {
    /// Asks what the columns of tables mean.
    pub(super) fn ask_for_columns(&mut self, opening: &OpenedSet, tables: Vec<GuessedTable>) {
        let mut files = opening.files.clone();
        files.retain(|file| file.path != COLUMNS_FILE);
        let draft = ColumnsDraft::new(opening.key.clone(), opening.name.clone(), files, tables);
        self.dialogs.columns.open(draft);
        self.playback.playing = false;
    }

    /// Does what was asked in the dialog.
    pub(super) fn columns(&mut self, command: ColumnsCommand, host: &mut dyn Host) {
        match command {
            ColumnsCommand::Cancel => {
                if let Some(job) = self.dialogs.columns.close().and_then(|draft| draft.job) {
                    host.cancel(job);
                }
            }
            ColumnsCommand::OpenFlight => self.make_flight_of_tables(host),
        }
    }

    /// Gives the workers the maps beside the tables, and has the flight made.
    fn make_flight_of_tables(&mut self, host: &mut dyn Host) {
        let Some(draft) = self.dialogs.columns.draft_mut() else {
            return;
        };
        if draft.job.is_some() || draft.lacks().is_some() {
            return;
        }
        let maps = write_columns(&draft.maps());
        put_beside(&mut draft.files, COLUMNS_FILE, maps);
        let key = draft.key.clone();
        provide(host, &key, &draft.files);
        draft.failed = None;
        draft.job = Some(host.start(Job::MakeFlight(MakeFlightOrder { key })));
    }

    pub(super) fn columns_event(
        &mut self,
        egui: &egui::Context,
        host: &mut dyn Host,
        event: JobEvent,
    ) {
        match event {
            JobEvent::FlightMade(made) => self.take_flight_of_tables(egui, host, &made),
            JobEvent::Failed(why) => {
                if let Some(draft) = self.dialogs.columns.draft_mut() {
                    draft.job = None;
                    draft.failed = Some(why);
                }
            }
            JobEvent::Finished | JobEvent::Cancelled => {
                if let Some(draft) = self.dialogs.columns.draft_mut() {
                    draft.job = None;
                }
            }
            _ => {}
        }
    }

    fn take_flight_of_tables(
        &mut self,
        egui: &egui::Context,
        host: &mut dyn Host,
        made: &MadeFlight,
    ) {
        let Some(draft) = self.dialogs.columns.close() else {
            return;
        };
        self.keep_files(host, &draft.key, &draft.name, &draft.files);
        let frame = made.flight.frame_on_globe;
        let map = with_origin(self.documents.map_under(frame), frame);
        let title = format!("Opened a flight from {}", draft.name);
        self.toasts.note(host.now(), title, sentences(&made.notes));
        let name = made.flight.name.clone();
        let files = FlightFiles::opened(draft.key, name, Some(map), None);
        self.read_flight(&files, egui, host);
    }

    /// The tables that are asked about.
    pub(super) fn columns_json(&self) -> Value {
        let Some(draft) = self.dialogs.columns.draft() else {
            return Value::Null;
        };
        let tables = draft.tables.iter().map(|table| {
            let columns = table.guess.map.columns.iter().map(|column| {
                json!({"name": column.name, "role": column.role.label(), "unit": column.unit})
            });
            json!({
                "file": table.guess.map.file,
                "used": table.is_used,
                "columns": columns.collect::<Vec<_>>(),
            })
        });
        json!({
            "tables": tables.collect::<Vec<_>>(),
            "lacks": draft.lacks(),
            "failed": draft.failed,
            "making": draft.job.is_some(),
        })
    }
}

/// Notes as one text: each a sentence, whether it was written as one or not.
pub(super) fn sentences(notes: &[String]) -> String {
    let sentence = |note: &String| {
        let end = if note.ends_with(['.', '!', '?']) {
            ""
        } else {
            "."
        };
        format!("{}{end}", capitalised(note))
    };
    notes.iter().map(sentence).collect::<Vec<_>>().join(" ")
}
