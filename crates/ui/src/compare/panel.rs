//! The table of trajectories, how they are compared, and their errors over time.

use egui::{Color32, RichText, Sense, Stroke, Ui, vec2};
use pilotage_core::flight::trajectory::{
    ClockRelation, ComparisonSettings, Delta, NotComparable, TrajectoryAlignment,
    TrajectoryComparison,
};

use super::chart::{DrawnCurves, curves, error_chart};
use super::command::{CompareCommand, TrackId};
use super::results::{CompareScene, ResultRow, Results};
use crate::command::Command;
use crate::context::ViewContext;
use crate::shell::{at_work, text_button};
use crate::views::chart::dashed;
use crate::views::{parts, table};

const CLOCKS: [(&str, ClockRelation); 2] = [
    ("By the clock", ClockRelation::Shared),
    ("From take-off", ClockRelation::TakeOff),
];
const ALIGNMENTS: [(&str, TrajectoryAlignment); 4] = [
    ("As it is", TrajectoryAlignment::None),
    ("At its first place", TrajectoryAlignment::Origin),
    ("Turned to fit", TrajectoryAlignment::Rigid),
    ("Turned and scaled", TrajectoryAlignment::Similarity),
];
const DELTAS: [(&str, Delta); 4] = [
    ("10 s", Delta::Seconds(10.0)),
    ("60 s", Delta::Seconds(60.0)),
    ("100 m", Delta::Metres(100.0)),
    ("1 km", Delta::Metres(1000.0)),
];

/// The view of trajectories beside each other.
pub struct CompareView {
    settings: ComparisonSettings,
    reference: TrackId,
    results: Results,
    drawn: DrawnCurves,
}

impl Default for CompareView {
    fn default() -> Self {
        Self {
            settings: ComparisonSettings::default(),
            reference: TrackId::Truth,
            results: Results::default(),
            drawn: DrawnCurves::default(),
        }
    }
}

/// Chips of which one is on.
fn choice<T: Copy + PartialEq>(
    ui: &mut Ui,
    context: &ViewContext<'_>,
    title: &str,
    all: &[(&str, T)],
    chosen: &mut T,
) {
    let tokens = context.tokens;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(0.5 * tokens.space, 0.5 * tokens.space);
        let text = RichText::new(title).size(tokens.text_sizes[0]);
        ui.label(text.color(tokens.muted));
        for (text, value) in all {
            let name = format!("{title}: {text}");
            if parts::chip(ui, tokens, chosen == value, text, &name).clicked() {
                *chosen = *value;
            }
        }
    });
}

impl CompareView {
    /// Results of the comparison, for reports: name, root mean square and greatest error (metres) of each.
    pub fn found(&self) -> impl Iterator<Item = (&str, Option<(f64, f64)>)> {
        self.results.rows.iter().map(|row| {
            let found = row.comparison.as_ref().and_then(|c| c.as_ref().ok());
            let errors =
                found.map(|c| (c.absolute_statistics.rmse, c.absolute_statistics.greatest));
            (row.name.as_str(), errors)
        })
    }

    /// Draws the view.
    pub fn show(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, scene: &CompareScene<'_>) {
        let tokens = context.tokens;
        ui.spacing_mut().item_spacing.y = 0.5 * tokens.space;
        self.results
            .update(context, scene, self.settings, self.reference);
        self.buttons(ui, context, scene);
        if self.results.rows.is_empty() {
            let hint =
                "Fly, or open a flight; keep its run and open another to see them side by side.";
            parts::empty(ui, tokens, "Nothing to compare", hint);
            return;
        }
        ui.add_space(0.5 * tokens.space);
        self.table(ui, context, scene);
        let troubles = self
            .results
            .rows
            .iter()
            .filter_map(|row| match &row.comparison {
                Some(Err(why)) => Some(why.to_string()),
                _ => None,
            });
        for why in troubles {
            ui.label(RichText::new(format!("{why}.")).color(tokens.warning));
        }
        ui.add_space(tokens.space);
        if context.run.is_some() {
            scene.contest.show(ui, context, scene.is_contest_of_before);
            ui.add_space(tokens.space);
        }
        choice(ui, context, "Times", &CLOCKS, &mut self.settings.clock);
        choice(
            ui,
            context,
            "Places",
            &ALIGNMENTS,
            &mut self.settings.alignment,
        );
        choice(ui, context, "Drift over", &DELTAS, &mut self.settings.delta);
        ui.add_space(tokens.space);
        let look = |row: &ResultRow| look(row, context, scene);
        let curves = curves(&self.results.rows, look);
        // Where the reference is part of what is open, its times are those of the cursor.
        let is_open = |row: &ResultRow| !matches!(row.id, TrackId::Kept(_));
        let is_open = self.results.reference().is_some_and(is_open);
        let clock = is_open.then_some((context.time, context.clock_zero));
        let title = RichText::new("Distance from the reference, over its time");
        ui.label(title.size(tokens.text_sizes[0]).color(tokens.muted));
        let drawn = (&mut self.drawn, self.results.made);
        let clicked = error_chart(ui, tokens, &curves, drawn, context.units.length(), clock);
        if let Some(time) = clicked.filter(|_| is_open) {
            context.commands.push(Command::SeekTo(time));
        }
    }

    fn buttons(&self, ui: &mut Ui, context: &mut ViewContext<'_>, scene: &CompareScene<'_>) {
        let tokens = context.tokens;
        ui.horizontal_wrapped(|ui| {
            let can_keep = |id| self.results.rows.iter().any(|row| row.id == id);
            let truth = format!("Keep the {}", context.known_track());
            for (id, text) in [(TrackId::Run, "Keep this run"), (TrackId::Truth, &truth)] {
                if can_keep(id) && text_button(ui, tokens, None, text, false).clicked() {
                    let keep = CompareCommand::Keep(id);
                    context.commands.push(keep.into());
                }
            }
            let is_there = scene.is_complete && can_keep(TrackId::Run) && scene.smoothing.is_none();
            if is_there && text_button(ui, tokens, None, "Keep it smoothed", false).clicked() {
                let keep = CompareCommand::KeepSmoothed;
                context.commands.push(keep.into());
            }
        });
        if let Some(words) = scene.smoothing
            && at_work(ui, tokens, words)
        {
            context.commands.push(CompareCommand::StopSmoothing.into());
        }
    }

    fn table(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, scene: &CompareScene<'_>) {
        let tokens = context.tokens;
        let (factor, unit) = context.units.length();
        let small = |text: &str| {
            RichText::new(text)
                .size(tokens.text_sizes[0])
                .color(tokens.muted)
        };
        let mut reference = self.reference;
        let titles = ["RMS", "median", "largest", "drift"].map(str::to_owned);
        let title = |ui: &mut Ui| {
            ui.label(small(&format!("error, {unit}")));
        };
        table::heads(ui, tokens, &titles, title);
        for row in &self.results.rows {
            let is_reference = row.comparison.is_none();
            let cells = figures(row.comparison.as_ref(), factor);
            // The line of its colour, and the sign by which it is let go of.
            let signs = match row.id {
                TrackId::Kept(_) => 60.0,
                _ => 28.0,
            };
            table::named_row(ui, tokens, &cells, (&row.name, signs), |ui| {
                swatch(ui, row, context, scene);
                if let TrackId::Kept(number) = row.id {
                    let name = format!("Let go of {}", row.name);
                    if parts::chip(ui, tokens, false, "×", &name).clicked() {
                        let discard = CompareCommand::Discard(number);
                        context.commands.push(discard.into());
                    }
                }
                let label = RichText::new(&row.name).size(tokens.text_sizes[1]);
                let face = egui::Button::selectable(is_reference, label).truncate();
                // A row is cut off at its height, which fingers have more of.
                let response = ui.add(if tokens.touch { face } else { face.small() });
                let name = format!("Compare with {}", row.name);
                response.widget_info(|| {
                    let role = egui::Role::Button;
                    egui::WidgetInfo::selected(role, true, is_reference, name.clone())
                });
                let hint = format!("{}: click to compare all with it", row.name);
                if response.on_hover_text(hint).clicked() {
                    reference = row.id;
                }
            });
        }
        self.reference = reference;
    }
}

/// The four numbers of a row.
fn figures(
    comparison: Option<&Result<TrajectoryComparison, NotComparable>>,
    factor: f64,
) -> [String; 4] {
    let values: [Option<f64>; 4] = match comparison {
        Some(Ok(found)) => {
            let absolute = &found.absolute_statistics;
            let drift = found.relative_statistics.as_ref().map(|r| r.rmse);
            [
                Some(absolute.rmse),
                Some(absolute.median),
                Some(absolute.greatest),
                drift,
            ]
        }
        Some(Err(_)) => [None; 4],
        None => return ["", "", "", "reference"].map(str::to_owned),
    };
    values.map(|value| value.map_or_else(|| "–".to_owned(), |v| parts::figures(factor * v)))
}

/// Colour and dash of a trajectory, as on the map.
fn look(
    row: &ResultRow,
    context: &ViewContext<'_>,
    scene: &CompareScene<'_>,
) -> (Color32, Option<(f32, f32)>) {
    let tokens = context.tokens;
    match row.id {
        TrackId::Truth => (tokens.truth, None),
        TrackId::Run => (tokens.corrected, None),
        TrackId::Unaided => (tokens.unaided, Some((8.0, 5.0))),
        TrackId::Ghost => (tokens.ghost, Some((2.0, 4.0))),
        TrackId::Kept(number) => {
            let kept = scene.shelf.get(number);
            kept.map_or((tokens.muted, None), |k| k.look(tokens))
        }
    }
}

/// The line of a trajectory; of one that was kept, a switch that shows it on the map.
fn swatch(ui: &mut Ui, row: &ResultRow, context: &mut ViewContext<'_>, scene: &CompareScene<'_>) {
    let (colour, dash) = look(row, context, scene);
    let kept = match row.id {
        TrackId::Kept(number) => scene.shelf.get(number),
        _ => None,
    };
    let is_shown = kept.is_none_or(|k| k.is_shown);
    let sense = if kept.is_some() {
        Sense::click()
    } else {
        Sense::hover()
    };
    let (rect, response) = ui.allocate_exact_size(vec2(24.0, 20.0), sense);
    let strength = if is_shown { 1.0 } else { 0.25 };
    let stroke = Stroke::new(2.5, colour.gamma_multiply(strength));
    let ends = [rect.left_center(), rect.right_center()];
    ui.painter().extend(dashed(ends.to_vec(), stroke, dash));
    let Some(kept) = kept else { return };
    let name = format!("{} on the map", row.name);
    response.widget_info(|| {
        egui::WidgetInfo::selected(egui::Role::CheckBox, true, is_shown, name.clone())
    });
    if response
        .on_hover_text("Show it on the map, or not")
        .clicked()
    {
        let toggle = CompareCommand::ToggleShown(kept.number);
        context.commands.push(toggle.into());
    }
}
