//! Figures and tables of the log that is open, from its worker; arrangements and pictures of its plots.

use super::exchange::stem;
use super::log_work::{Asked, Table};
use super::{App, SideTab};
use crate::command::Workspace;
use crate::host::Host;
use crate::log::{LogTab, PanelContent, SpanFigures, series_name};
use pilotage_jobs::{Job, JobEvent, JobId, LogAnswer, LogOrder, LogQuestion, SeriesName};

/// Pixels of a saved picture per point of the screen.
const PIXELS_PER_POINT: f32 = 2.0;

/// Name of a file about a span of time of a log.
fn file_name(log: &str, (from, to): (f64, f64), ending: &str) -> String {
    let name = stem(log.rsplit_once('.').map_or(log, |(stem, _)| stem));
    format!("{name}-{from:.0}s-{to:.0}s.{ending}")
}

impl App {
    /// Asks for figures of the plotted fields over the span that is selected or shown, while they are looked at.
    pub(super) fn ask_for_figures(&mut self, host: &mut dyn Host) {
        let is_shown = self.side_tab == SideTab::Log
            && self.views.log_tab == LogTab::Statistics
            && self.view.side_open
            && self.view.workspace == Workspace::Replay;
        if !is_shown || self.jobs.logs.answers.figures.is_some() {
            return;
        }
        let Some((asked, order)) = self.order(LogQuestion::Statistics) else {
            return;
        };
        let answers = &mut self.jobs.logs.answers;
        if answers.asked.as_ref() == Some(&asked) {
            return;
        }
        let figures = SpanFigures {
            span: asked.span,
            ..SpanFigures::default()
        };
        answers.asked = Some(asked);
        answers.figures = Some((host.start(Job::AskLog(Box::new(order))), figures));
    }

    /// A question about the plotted fields over the span that is selected or shown, once the log is read.
    fn order(&self, question: LogQuestion) -> Option<(Asked, LogOrder)> {
        let log = self.documents.log.as_ref().filter(|log| log.is_read())?;
        let plots = &self.views.log_plots;
        let span = plots.span_of_interest(log, self.playback.selected_span)?;
        let fields = plots.fields_in_order();
        let named = |field: &SeriesName| (field.clone(), series_name(field));
        let order = LogOrder {
            key: log.key.clone(),
            file: log.file.clone(),
            series: fields.iter().map(named).collect(),
            span,
            question,
        };
        Some((Asked { fields, span }, order))
    }

    /// Has a table of the plotted fields written.
    pub(super) fn save_table(&mut self, host: &mut dyn Host) {
        let order = self.order(LogQuestion::Table);
        let Some((asked, order)) = order.filter(|(asked, _)| !asked.fields.is_empty()) else {
            let text = "Open a log and plot some of its fields first.";
            self.toasts.note(host.now(), "No fields to save", text);
            return;
        };
        if let Some(table) = self.jobs.logs.answers.table.take() {
            host.cancel(table.id);
        }
        let (from, to) = asked.span;
        let name = stem(
            order
                .file
                .rsplit_once('.')
                .map_or(&*order.file, |(stem, _)| stem),
        );
        let id = host.start(Job::AskLog(Box::new(order)));
        self.jobs.logs.answers.table = Some(Table {
            id,
            name: format!("{name}-{from:.0}s-{to:.0}s.csv"),
            progress: 0.0,
        });
    }

    /// Shows these panels in place of what is plotted; nothing happens without any.
    pub(super) fn arrange_plots(&mut self, panels: Vec<PanelContent>) {
        if panels.is_empty() {
            return;
        }
        self.views.shows_log_plots = true;
        self.view.plots_open = Some(true);
        self.views.log_plots.arrange(panels);
    }

    /// Offers the plots as they are shown, as a drawing or as a picture.
    pub(super) fn save_plots(&mut self, host: &mut dyn Host, as_pixels: bool) {
        let log = self.documents.log.as_ref();
        let picture = log.and_then(|log| {
            let selected = self.playback.selected_span;
            let plots = &self.views.log_plots;
            let drawn = plots.picture(log, &self.tokens, selected)?;
            Some((drawn, &log.file, plots.span_of_interest(log, None)?))
        });
        let Some(((svg, size), file, span)) = picture else {
            let text = "Open a log and plot some of its fields first.";
            self.toasts.note(host.now(), "No plots to save", text);
            return;
        };
        let name = file_name(file, span, if as_pixels { "png" } else { "svg" });
        if as_pixels {
            let size = [size.0, size.1].map(|side| (PIXELS_PER_POINT * side).round() as u32);
            host.save_picture(&name, &svg, size);
        } else {
            host.save_file(&name, svg.as_bytes());
        }
        self.toasts.note(host.now(), "Plots saved", name);
    }

    pub(super) fn answer_event(&mut self, host: &mut dyn Host, id: JobId, event: JobEvent) {
        let answers = &mut self.jobs.logs.answers;
        let is_table = answers.table.as_ref().is_some_and(|table| table.id == id);
        match event {
            JobEvent::Progress(progress, _) => {
                if let Some(table) = answers.table.as_mut().filter(|_| is_table) {
                    table.progress = progress;
                }
            }
            JobEvent::LogAnswer(answer) => match *answer {
                LogAnswer::Statistics(field, found) => {
                    if let Some((_, figures)) = &mut answers.figures {
                        figures.fields.insert(field, found);
                    }
                }
                LogAnswer::Table { text, lacks } => self.offer_table(host, &text, &lacks),
            },
            JobEvent::Finished if is_table => answers.table = None,
            JobEvent::Finished => {
                let figures = answers.figures.take();
                if let (Some(log), Some((_, figures))) = (&mut self.documents.log, figures) {
                    log.figures = figures;
                }
            }
            JobEvent::Cancelled | JobEvent::Failed(_) => {
                let is_lost = matches!(event, JobEvent::Failed(_));
                if is_table {
                    answers.table = None;
                } else {
                    // Asked again once the log was read again, or anything else is wanted.
                    answers.figures = None;
                }
                if is_lost {
                    self.log_is_lost();
                }
                if let JobEvent::Failed(why) = event
                    && is_table
                {
                    let title = "The table was not written";
                    self.toasts.trouble(host.now(), title, why);
                }
            }
            _ => {}
        }
    }

    fn offer_table(&mut self, host: &mut dyn Host, text: &[u8], lacks: &[String]) {
        let Some(table) = &self.jobs.logs.answers.table else {
            return;
        };
        host.save_file(&table.name, text);
        let mut words = table.name.clone();
        if !lacks.is_empty() {
            words = format!("{words}. Without {}.", lacks.join("; "));
        }
        self.toasts.note(host.now(), "Table saved", words);
    }
}
