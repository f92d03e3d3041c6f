//! Evaluation of a detector where it was not trained: curves, circumstances, probabilities.

mod plot;
#[cfg(test)]
mod tests;

use crate::shell::{chip, muted, text_button};
use crate::tokens::Tokens;
use crate::views::parts;
use egui::Ui;
use pilotage_core::text::plain_name;
use pilotage_jobs::EvaluationReport;

/// Least width of a plot, points.
const LEAST_WIDTH: f32 = 300.0;
/// Least and greatest height of a plot, points.
const HEIGHTS: [f32; 2] = [190.0, 300.0];

/// A file that was asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EvaluationFile {
    /// Its name.
    pub name: String,
    /// Its content.
    pub text: String,
}

/// Content of the view.
pub struct EvaluationScene<'a> {
    /// Report on the evaluation; `None` before.
    pub report: Option<&'a EvaluationReport>,
    /// The look.
    pub tokens: &'a Tokens,
}

/// The view's own state: which plot stands in each of the places that hold several.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct EvaluationView {
    chosen: [usize; 4],
}

/// Plots that share a place: what the place is called and the keys of its plots with their short names.
type PlotPlace = (&'static str, &'static [(&'static str, &'static str)]);

const PLACES: [PlotPlace; 4] = [
    ("False alarms", &[("false_alarms", "ROC and FROC")]),
    ("Precision", &[("precision_recall", "Precision")]),
    (
        "Found by",
        &[
            ("height_m", "Height"),
            ("tilt_deg", "Tilt"),
            ("heading_error_deg", "Heading error"),
            ("day", "Day"),
            ("real_frame", "Source"),
        ],
    ),
    (
        "Probability",
        &[("reliability", "Reliability"), ("score", "Score")],
    ),
];

impl EvaluationView {
    /// Draws the view; the file that was asked for, if any.
    pub fn show(&mut self, ui: &mut Ui, scene: &EvaluationScene<'_>) -> Option<EvaluationFile> {
        let tokens = scene.tokens;
        let Some(report) = scene.report else {
            parts::empty(
                ui,
                tokens,
                "Not evaluated yet",
                "Evaluate the detector on days that it was not trained on.",
            );
            return None;
        };
        let mut file = None;
        ui.horizontal_wrapped(|ui| {
            for words in &report.figures {
                chip(ui, tokens, words, tokens.text);
            }
            if text_button(ui, tokens, None, "Save CSV", false).clicked() {
                file = Some(EvaluationFile {
                    name: format!("{}.evaluation.csv", plain_name(&report.name)),
                    text: report.csv.clone(),
                });
            }
        });
        ui.label(muted(tokens, report.basis.as_str()));
        let columns = if ui.available_width() >= 2.0 * LEAST_WIDTH {
            2
        } else {
            1
        };
        let rows = PLACES.len().div_ceil(columns) as f32;
        let gap = tokens.space;
        let height = (ui.available_height() / rows - gap).clamp(HEIGHTS[0], HEIGHTS[1]);
        let width = (ui.available_width() - gap * (columns - 1) as f32) / columns as f32;
        for places in (0..PLACES.len()).collect::<Vec<_>>().chunks(columns) {
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = gap;
                for &place in places {
                    ui.allocate_ui(egui::vec2(width, height), |ui| {
                        ui.set_min_size(egui::vec2(width, height));
                        ui.vertical(|ui| {
                            if let Some(asked) = self.place(ui, place, report, tokens) {
                                file = Some(asked);
                            }
                        });
                    });
                }
            });
        }
        file
    }

    /// Draws a place of the grid: the choice of its plot and the plot.
    fn place(
        &mut self,
        ui: &mut Ui,
        place: usize,
        report: &EvaluationReport,
        tokens: &Tokens,
    ) -> Option<EvaluationFile> {
        let (name, choices) = PLACES[place];
        let found = |key: &str| report.plots.iter().find(|(plot, _)| plot.key == key);
        let there: Vec<_> = (choices.iter())
            .filter_map(|(key, short)| Some((found(key)?, *short)))
            .collect();
        let chosen = self.chosen[place].min(there.len().saturating_sub(1));
        let Some(((plot, svg), _)) = there.get(chosen) else {
            ui.label(muted(tokens, format!("{name}: {}", absent(place))));
            return None;
        };
        let mut asked = None;
        ui.horizontal(|ui| {
            if there.len() > 1 {
                for (index, (_, short)) in there.iter().enumerate() {
                    if ui.selectable_label(index == chosen, *short).clicked() {
                        self.chosen[place] = index;
                    }
                }
            } else {
                ui.label(muted(tokens, plot.title.as_str()));
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let save = ui.small_button("SVG");
                let hint = format!("Save \"{}\" as SVG", plot.title);
                save.widget_info(|| {
                    egui::WidgetInfo::labeled(egui::Role::Button, true, hint.clone())
                });
                if save.on_hover_text(&hint).clicked() {
                    asked = Some(EvaluationFile {
                        name: format!("{}.{}.svg", plain_name(&report.name), plot.key),
                        text: svg.clone(),
                    });
                }
            });
        });
        plot::paint(ui, plot, tokens);
        asked
    }
}

/// Why a place is empty.
fn absent(place: usize) -> &'static str {
    if place == 2 {
        "every picture was taken under the same circumstances"
    } else {
        "there are no right or no wrong marks to learn from"
    }
}
