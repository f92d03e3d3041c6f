//! Every estimator on the flight that is open, in one table.

use egui::{RichText, Ui};
use pilotage_core::study::{ComparisonRow, EstimatorComparison};
use pilotage_jobs::ContestOrder;

use super::command::CompareCommand;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::feature_work::FeatureWork;
use crate::shell::{at_work, counted, of_before_again, text_button};
use crate::views::{parts, table};

/// State of the contest of all estimators.
#[derive(Debug, Default)]
pub struct ContestState {
    /// Flight by all of them, while it is under way.
    pub work: FeatureWork,
    /// Comparison of the estimators.
    pub found: Option<EstimatorComparison>,
    /// Remarks of that which came last, or of that under way, in words.
    pub remarks: Vec<String>,
    /// Order of which that came, or comes.
    pub order: Option<ContestOrder>,
}

impl ContestState {
    /// Whether the mission or the map is another one than that which was judged.
    pub(super) fn is_of_before(&self, documents: &Documents) -> bool {
        self.order.as_ref().is_some_and(|order| {
            let [then, now] = [&order.mission, &*documents.mission].map(|it| &it.navigator);
            let flown = |settings| {
                let first = order.contenders.first();
                first.map(|contender| contender.settings(settings, order.seed))
            };
            // The estimator is the contest's own.
            then.vehicle != now.vehicle
                || flown(then) != flown(now)
                || order.map != documents.map.source
                || documents.is_seen_otherwise(&order.mission)
        })
    }

    /// Draws it: a button, or how far it is, and the table, which may be of the mission as it was before.
    pub(super) fn show(&self, ui: &mut Ui, context: &mut ViewContext<'_>, is_of_before: bool) {
        let tokens = context.tokens;
        let small = |text: &str| {
            let text = RichText::new(text).size(tokens.text_sizes[0]);
            text.color(tokens.muted)
        };
        ui.label(small(
            "The same flight by every estimator, in flight and smoothed afterwards",
        ));
        if let Some(words) = &self.work.words {
            if at_work(ui, tokens, words) {
                context.commands.push(CompareCommand::StopFlights.into());
            }
        } else if text_button(ui, tokens, None, "Fly by all estimators", false).clicked() {
            context.commands.push(CompareCommand::FlyAll.into());
        }
        if let Some(why) = &self.work.trouble {
            ui.label(RichText::new(why).color(tokens.warning));
        }
        for remark in &self.remarks {
            ui.add(egui::Label::new(RichText::new(remark).color(tokens.warning)).wrap());
        }
        let Some(found) = &self.found else { return };
        let words = "Of the mission before: its landmarks, settings or map have changed since.";
        let words = is_of_before.then_some(words);
        let is_under_way = self.work.words.is_some();
        let draw = |ui: &mut Ui| table_of(ui, context, found);
        if of_before_again(ui, tokens, words, is_under_way, draw) {
            context.commands.push(CompareCommand::FlyAll.into());
        }
    }
}

/// Draws the table of a contest.
fn table_of(ui: &mut Ui, context: &ViewContext<'_>, found: &EstimatorComparison) {
    let tokens = context.tokens;
    let small = |text: &str| {
        let text = RichText::new(text).size(tokens.text_sizes[0]);
        text.color(tokens.muted)
    };
    let (factor, unit) = context.units.length();
    let titles = ["RMS", "median", "most", "NEES"].map(str::to_owned);
    table::heads(ui, tokens, &titles, |ui| {
        ui.label(small(&format!("error, {unit}")));
    });
    for row in &found.rows {
        let cells = figures(row, factor);
        table::named_row(ui, tokens, &cells, (&name(row), 0.0), |ui| {
            let label = RichText::new(name(row)).size(tokens.text_sizes[1]);
            let hint = format!(
                "{}: {:.3} ms a step, {} accepted, {} refused",
                name(row),
                row.ms_per_step,
                counted(row.updates_accepted, "landmark", "landmarks"),
                row.updates_refused
            );
            ui.add(egui::Label::new(label).truncate())
                .on_hover_text(hint);
        });
    }
    let honest = found.rows.iter().filter_map(|row| row.nees);
    if let Some(bounds) = honest.into_iter().next() {
        ui.label(small(&format!(
                "The NEES of an honest filter is {:.0} on average; one flight of one may lie between {:.2} and {:.1}.",
                bounds.dof, bounds.lower_95, bounds.upper_95
            )));
    }
}

/// Name of a line: the estimator, and whether it was smoothed.
fn name(row: &ComparisonRow) -> String {
    let smoothed = if row.smoothed { ", smoothed" } else { "" };
    format!("{}{smoothed}", row.contender.estimator.key().to_uppercase())
}

/// The four numbers of a line.
fn figures(row: &ComparisonRow, factor: f64) -> [String; 4] {
    let error = row.position_error_m;
    let length = |value: Option<f64>| {
        value.map_or_else(|| "\u{2013}".to_owned(), |v| parts::figures(factor * v))
    };
    let nees = row.nees.map(|nees| nees.mean);
    [
        length(error.map(|e| e.rms)),
        length(error.map(|e| e.median)),
        length(error.map(|e| e.max)),
        nees.map_or_else(|| "\u{2013}".to_owned(), parts::figures),
    ]
}
