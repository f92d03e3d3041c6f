//! Figures and tables of the log that is open, from its worker.

use pilotage_jobs::{Job, JobEvent, JobId, LogAnswer, LogOrder, LogQuestion, SeriesName};

use super::work::{AskedFigures, LogFeature, TableExport};
use super::{LogTab, SpanFigures, series_name};
use crate::feature::FeatureContext;
use crate::host::stem;

/// Name of a file about a span of time of a log.
pub(super) fn file_name(log: &str, (from, to): (f64, f64), ending: &str) -> String {
    let name = stem(log.rsplit_once('.').map_or(log, |(stem, _)| stem));
    format!("{name}-{from:.0}s-{to:.0}s.{ending}")
}

impl LogFeature {
    /// Asks for figures of the plotted fields over the span that is selected or shown, while they are looked at.
    pub(super) fn ask_for_figures(&mut self, context: &mut FeatureContext<'_>) {
        let is_shown = context.is_shown
            && context.view.side_open != Some(false)
            && self.tab == LogTab::Statistics;
        if !is_shown || self.answers.figures.is_some() {
            return;
        }
        let Some((asked, order)) = self.order(LogQuestion::Statistics, context) else {
            return;
        };
        if self.answers.asked.as_ref() == Some(&asked) {
            return;
        }
        let figures = SpanFigures {
            span: asked.span,
            ..SpanFigures::default()
        };
        self.answers.asked = Some(asked);
        let job = context.start(Job::AskLog(Box::new(order)));
        self.answers.figures = Some((job, figures));
    }

    /// A question about the plotted fields over the span that is selected or shown, once the log is read.
    fn order(
        &self,
        question: LogQuestion,
        context: &FeatureContext<'_>,
    ) -> Option<(AskedFigures, LogOrder)> {
        let log = self.log.as_ref().filter(|log| log.is_read())?;
        let selected = context.playback.selected_span;
        let span = self.plots.span_of_interest(log, selected)?;
        let fields = self.plots.fields_in_order();
        let named = |field: &SeriesName| (field.clone(), series_name(field));
        let order = LogOrder {
            key: log.key.clone(),
            file: log.file.clone(),
            series: fields.iter().map(named).collect(),
            span,
            question,
        };
        Some((AskedFigures { fields, span }, order))
    }

    /// Has a table of the plotted fields written.
    pub(super) fn save_table(&mut self, context: &mut FeatureContext<'_>) {
        let order = self.order(LogQuestion::Table, context);
        let Some((asked, order)) = order.filter(|(asked, _)| !asked.fields.is_empty()) else {
            let text = "Open a log and plot some of its fields first.";
            return context.note("No fields to save", text);
        };
        if let Some(table) = self.answers.table.take() {
            context.cancel(table.job);
        }
        let name = file_name(&order.file, asked.span, "csv");
        self.answers.table = Some(TableExport {
            job: context.start(Job::AskLog(Box::new(order))),
            name,
            progress: 0.0,
        });
    }

    /// Takes what is said of a question about the log; whether that is awaited.
    pub(super) fn answer_event(
        &mut self,
        id: JobId,
        event: &JobEvent,
        context: &mut FeatureContext<'_>,
    ) -> bool {
        let answers = &mut self.answers;
        let is_table = answers.table.as_ref().is_some_and(|table| table.job == id);
        match event {
            JobEvent::Progress(progress, _) => {
                if let Some(table) = answers.table.as_mut().filter(|_| is_table) {
                    table.progress = *progress;
                }
            }
            JobEvent::LogAnswer(answer) => match &**answer {
                LogAnswer::Statistics(field, found) => {
                    if let Some((_, figures)) = &mut answers.figures {
                        figures.fields.insert(field.clone(), found.clone());
                    }
                }
                LogAnswer::Table { text, lacks } => self.offer_table(text, lacks, context),
            },
            JobEvent::Failed(why) => {
                answers.leave(is_table);
                self.lose();
                if is_table {
                    context.trouble("The table was not written", why);
                }
            }
            JobEvent::Cancelled => answers.leave(is_table),
            JobEvent::Finished if is_table => answers.table = None,
            JobEvent::Finished => {
                let figures = answers.figures.take();
                if let (Some(log), Some((_, figures))) = (&mut self.log, figures) {
                    log.figures = figures;
                }
            }
            _ => return false,
        }
        true
    }

    fn offer_table(&self, text: &[u8], lacks: &[String], context: &mut FeatureContext<'_>) {
        let Some(table) = &self.answers.table else {
            return;
        };
        context.host.save_file(&table.name, text);
        let mut words = table.name.clone();
        if !lacks.is_empty() {
            words = format!("{words}. Without {}.", lacks.join("; "));
        }
        context.note("Table saved", words);
    }
}
