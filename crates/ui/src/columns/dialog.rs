//! The dialog that asks what the columns of tables mean.

use egui::{Button, Frame, Id, Key, Modal, Modifiers, Popup, RichText, ScrollArea, Ui, vec2};
use pilotage_core::flight::columns::{
    ColumnMap, ColumnRole, GuessedTable, tables_lack, tables_lack_to_navigate,
};
use pilotage_core::flight::files::file_of;

use super::ColumnsCommand;
use super::rows::rows;
use crate::command::Command;
use crate::host::OpenedFile;
use crate::shell::{NumberField, caption, icons::Icon, muted, text_button, title};
use crate::tokens::Tokens;
use crate::units::Units;
use pilotage_jobs::JobId;

/// Widest that the dialog grows, points.
const WIDEST: f32 = 1160.0;
/// Width of the list of tables, points.
const LIST: f32 = 216.0;
/// Narrowest window in which that list stands beside the columns, points.
const BESIDE: f32 = 1000.0;

/// A table that is asked about.
#[derive(Clone, Debug)]
pub struct DraftTable {
    /// Meaning of its columns, as corrected so far.
    pub guess: GuessedTable,
    /// Whether the flight is made of it.
    pub is_used: bool,
}

/// The tables of a drop, what their columns mean, and how far making a flight of them is.
#[derive(Clone, Debug)]
pub struct ColumnsDraft {
    /// Key under which the workers have the files.
    pub key: String,
    /// Name of the drop for people.
    pub name: String,
    /// The files themselves.
    pub files: Vec<OpenedFile>,
    /// The tables among them.
    pub tables: Vec<DraftTable>,
    /// The table whose columns are shown.
    shown: usize,
    /// The job that makes the flight.
    pub job: Option<JobId>,
    /// Why that failed, in words.
    pub failed: Option<String>,
}

impl ColumnsDraft {
    /// The guess, with what is proposed ticked; a table alone is.
    pub fn new(
        key: String,
        name: String,
        files: Vec<OpenedFile>,
        tables: Vec<GuessedTable>,
    ) -> Self {
        let is_alone = tables.len() == 1;
        let tables: Vec<DraftTable> = tables
            .into_iter()
            .map(|guess| DraftTable {
                is_used: guess.is_proposed || is_alone,
                guess,
            })
            .collect();
        Self {
            key,
            name,
            files,
            shown: tables.iter().position(|t| t.is_used).unwrap_or(0),
            tables,
            job: None,
            failed: None,
        }
    }

    /// The table's name if it is the only one: the drop may be called by a picture beside it.
    fn heading(&self) -> &str {
        match &self.tables[..] {
            [only] => &only.guess.map.file,
            _ => &self.name,
        }
    }

    /// The maps of the tables that are used.
    pub fn maps(&self) -> Vec<ColumnMap> {
        self.used().cloned().collect()
    }

    fn used(&self) -> impl Iterator<Item = &ColumnMap> {
        let used = self.tables.iter().filter(|table| table.is_used);
        used.map(|table| &table.guess.map)
    }

    /// Why no flight can be made of them yet, in words; `None` if one can.
    pub fn lacks(&self) -> Option<String> {
        tables_lack(&self.used().collect::<Vec<_>>())
    }

    /// Why the flight that can be made of them cannot be navigated, in words; it can be looked at all the same.
    fn lacks_to_navigate(&self) -> Option<&'static str> {
        tables_lack_to_navigate(&self.used().collect::<Vec<_>>())
    }
}

/// The dialog.
#[derive(Debug, Default)]
pub struct ColumnsDialog {
    draft: Option<ColumnsDraft>,
}

impl ColumnsDialog {
    /// Asks about tables.
    pub fn open(&mut self, draft: ColumnsDraft) {
        self.draft = Some(draft);
    }

    /// Closes the dialog; what it was about, if it was open.
    pub fn close(&mut self) -> Option<ColumnsDraft> {
        self.draft.take()
    }

    /// Draft that the dialog is about.
    pub fn draft(&self) -> Option<&ColumnsDraft> {
        self.draft.as_ref()
    }

    /// Draft that the dialog is about, to be changed.
    pub fn draft_mut(&mut self) -> Option<&mut ColumnsDraft> {
        self.draft.as_mut()
    }

    /// Draws the dialog.
    pub fn show(
        &mut self,
        context: &egui::Context,
        tokens: &Tokens,
        units: Units,
        commands: &mut Vec<Command>,
    ) {
        let Some(draft) = &mut self.draft else { return };
        let screen = context.content_rect();
        let response = Modal::new(Id::unique("columns"))
            .frame(Frame::window(&context.global_style()).inner_margin(24))
            .show(context, |ui| {
                ui.set_width(WIDEST.min(screen.width() - 96.0));
                let close = title(ui, tokens, "What do the columns mean?");
                ui.label(muted(
                    tokens,
                    format!(
                        "{}: guessed from names, units and values. Correct what is wrong, then open the flight.",
                        draft.heading()
                    ),
                ));
                ui.add_space(tokens.space);
                let height = (screen.height() - 300.0).max(120.0);
                if draft.tables.len() > 1 && screen.width() >= BESIDE {
                    ui.horizontal_top(|ui| {
                        ui.allocate_ui(vec2(LIST, height), |ui| {
                            ui.vertical(|ui| tables(ui, tokens, draft, height));
                        });
                        ui.add_space(tokens.space);
                        ui.vertical(|ui| columns(ui, tokens, units, draft, height));
                    });
                } else {
                    if draft.tables.len() > 1 {
                        tables(ui, tokens, draft, 0.25 * height);
                        ui.add_space(tokens.space);
                    }
                    columns(ui, tokens, units, draft, 0.7 * height);
                }
                ui.add_space(tokens.space);
                foot(ui, tokens, draft, commands) || close
            });
        // A click beside it is no reason to lose what was corrected.
        let leaves = response.should_close() && !response.backdrop_response.clicked();
        if response.inner || leaves {
            commands.push(Command::from(ColumnsCommand::Cancel));
        } else if takes_enter(context) {
            commands.push(Command::from(ColumnsCommand::OpenFlight));
        }
    }
}

/// Whether Enter was pressed and is for nothing else.
fn takes_enter(context: &egui::Context) -> bool {
    let is_free = !Popup::is_any_open(context) && context.memory(|m| m.focused().is_none());
    is_free && context.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Enter))
}

/// The list of tables, with a box to tick for each.
fn tables(ui: &mut Ui, tokens: &Tokens, draft: &mut ColumnsDraft, height: f32) {
    caption(ui, tokens, "Tables to use");
    ScrollArea::vertical()
        .id_salt("tables")
        .max_height(height - 24.0)
        .auto_shrink([false, true])
        .show(ui, |ui| {
            for (index, table) in draft.tables.iter_mut().enumerate() {
                let file = table.guess.map.file.clone();
                ui.horizontal(|ui| {
                    ui.checkbox(&mut table.is_used, "")
                        .accessible_name(format!("Use {}", file_of(&file)));
                    let name = Button::selectable(draft.shown == index, file_of(&file)).truncate();
                    let shown = ui.add(name).on_hover_text(&file);
                    if shown
                        .accessible_name(format!("Columns of {}", file_of(&file)))
                        .clicked()
                    {
                        draft.shown = index;
                    }
                });
                ui.horizontal(|ui| {
                    ui.add_space(3.0 * tokens.space);
                    ui.label(muted(tokens, about(table)));
                });
            }
        });
}

/// A table in a few words.
fn about(table: &DraftTable) -> String {
    let columns = &table.guess.map.columns;
    let known = columns.iter().filter(|c| c.role != ColumnRole::Nothing);
    format!(
        "{} of {} columns, {:.0} rows",
        known.count(),
        columns.len(),
        table.guess.rows
    )
}

/// The columns of the table that is shown.
fn columns(ui: &mut Ui, tokens: &Tokens, units: Units, draft: &mut ColumnsDraft, height: f32) {
    let shown = draft.shown;
    let Some(table) = draft.tables.get_mut(shown) else {
        return;
    };
    let before = table.guess.map.clone();
    let is_timeless = table.guess.map.column(ColumnRole::Time).is_none();
    if is_timeless {
        ui.horizontal(|ui| {
            let label = ui.label("No column is the time. Rows a second:");
            let map = &mut table.guess.map;
            let mut rate = map.rows_per_second.unwrap_or(0.0);
            let field = NumberField::new(0.0..=10_000.0).speed(0.1).decimals(3);
            let field = field.words(|rate| {
                if rate > 0.0 {
                    format!("{rate} Hz")
                } else {
                    "unknown".to_owned()
                }
            });
            let field = field.show(ui, &mut rate);
            if field.labelled_by(label.id).changed() {
                map.rows_per_second = (rate > 0.0).then_some(rate);
            }
        });
    }
    let width = ui.available_width();
    ScrollArea::both()
        .id_salt(("columns", shown))
        .max_height(height - if is_timeless { 32.0 } else { 0.0 })
        .auto_shrink([false, true])
        .show(ui, |ui| rows(ui, tokens, units, width, &mut table.guess));
    if table.guess.map != before {
        table.is_used = true;
        draft.failed = None;
    }
}

/// Draws what is lacking, and the buttons; whether the dialog is to be left.
fn foot(ui: &mut Ui, tokens: &Tokens, draft: &ColumnsDraft, commands: &mut Vec<Command>) -> bool {
    let lacks = draft.lacks();
    let is_making = draft.job.is_some();
    let words = match (&draft.failed, &lacks) {
        (Some(why), _) => Some(format!("No flight could be made of them: {why}")),
        (None, Some(why)) => Some(format!("Not yet: {why}.")),
        (None, None) if is_making => None,
        (None, None) => (draft.lacks_to_navigate())
            .map(|why| format!("It can be looked at, but not navigated: {why}.")),
    };
    match words {
        Some(words) => {
            let words = RichText::new(words).font(tokens.normal());
            ui.label(words.color(tokens.warning));
        }
        None if is_making => {
            ui.label(muted(tokens, "Making the flight …"));
        }
        None => {
            let used = draft.used().count();
            let tables = if used == 1 { "table" } else { "tables" };
            ui.label(muted(tokens, format!("A flight of {used} {tables}.")));
        }
    }
    ui.horizontal(|ui| {
        let can = lacks.is_none() && !is_making;
        ui.add_enabled_ui(can, |ui| {
            if text_button(ui, tokens, Some(Icon::Play), "Open flight", can).clicked() {
                commands.push(Command::from(ColumnsCommand::OpenFlight));
            }
        });
        let cancelled = text_button(ui, tokens, None, "Cancel", false).clicked();
        ui.label(muted(tokens, "Replaces the current flight."));
        cancelled
    })
    .inner
}
