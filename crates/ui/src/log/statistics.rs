//! Figures of the plotted fields over the selected span of time, from every sample.

use egui::{Align, Align2, Color32, Layout, RichText, ScrollArea, Sense, Ui, pos2, vec2};
use pilotage_core::flight::SpanStatistics;

use super::figures::FieldFigures;
use super::scene::colour as field_colour;
use super::words::{figure, series_name};
use super::{LogCommand, LogPlots, OpenLog};
use crate::command::Command;
use crate::context::ViewContext;
use crate::tokens::Tokens;
use crate::units::clock;
use crate::views::parts;
use pilotage_jobs::SeriesName;

/// Fields that stand side by side at most.
const MOST_COLUMNS: usize = 3;

/// A row of the table: its name, and what it says of a field.
struct StatisticRow {
    name: &'static str,
    of: fn(&SpanStatistics) -> Option<f64>,
    /// Suffix behind the unit of the field.
    unit: &'static str,
}

const ROWS: [StatisticRow; 8] = [
    StatisticRow {
        name: "Least",
        of: |it| Some(it.least),
        unit: "",
    },
    StatisticRow {
        name: "Greatest",
        of: |it| Some(it.greatest),
        unit: "",
    },
    StatisticRow {
        name: "Mean",
        of: |it| Some(it.mean),
        unit: "",
    },
    StatisticRow {
        name: "Std deviation",
        of: |it| it.deviation,
        unit: "",
    },
    StatisticRow {
        name: "Median",
        of: |it| Some(it.median),
        unit: "",
    },
    StatisticRow {
        name: "Change",
        of: |it| Some(it.change()),
        unit: "",
    },
    StatisticRow {
        name: "Rate",
        of: SpanStatistics::rate,
        unit: "/s",
    },
    StatisticRow {
        name: "Samples",
        of: |it| Some(it.count as f64),
        unit: "-",
    },
];

/// Draws the figures of every plotted field, panel by panel.
pub fn statistics_panel(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    log: &OpenLog,
    plots: &LogPlots,
) {
    let tokens = context.tokens;
    let Some(span) = plots.span_of_interest(log, context.selected_span) else {
        return;
    };
    heading(ui, context, span);
    if plots.is_empty() {
        let hint = "Tick fields in the list to plot them.";
        parts::empty(ui, tokens, "No field is plotted", hint);
        return;
    }
    let width = ui.available_width();
    ScrollArea::vertical()
        .id_salt("statistics")
        .auto_shrink(false)
        .show(ui, |ui| {
            ui.set_max_width(width);
            for fields in plots.panels() {
                let coloured: Vec<(Color32, &SeriesName)> = fields
                    .iter()
                    .enumerate()
                    .map(|(i, field)| (field_colour(tokens, i), field))
                    .collect();
                for some in coloured.chunks(MOST_COLUMNS) {
                    table(ui, tokens, log, some, span);
                }
            }
        });
}

/// Draws which span it is, and what can be done with it.
fn heading(ui: &mut Ui, context: &mut ViewContext<'_>, span: (f64, f64)) {
    let tokens = context.tokens;
    let first = context.clock_zero;
    let what = if context.selected_span.is_some() {
        "Selected"
    } else {
        "Shown"
    };
    let [from, to] = [span.0, span.1].map(|time| clock(time, first));
    let length = span.1 - span.0;
    let text = format!("{what}: {from} to {to}, {length:.1} s");
    ui.label(RichText::new(text).color(tokens.text));
    if context.selected_span.is_none() {
        let hint = "Drag over a plot with Shift to select a span of time.";
        let hint = RichText::new(hint).size(tokens.text_sizes[0]);
        ui.label(hint.color(tokens.muted));
    }
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.5 * tokens.space;
        let name = "Save the plotted fields of this span as CSV";
        if parts::chip(ui, tokens, false, "Save as CSV", name).clicked() {
            context.commands.push(Command::from(LogCommand::SaveTable));
        }
        let is_selected = context.selected_span.is_some();
        if is_selected
            && parts::chip(ui, tokens, false, "Select nothing", "Select no span").clicked()
        {
            context.commands.push(Command::SelectSpan(None));
        }
    });
    ui.add_space(0.5 * tokens.space);
}

/// Fields side by side, a row for every figure.
fn table(
    ui: &mut Ui,
    tokens: &Tokens,
    log: &OpenLog,
    fields: &[(Color32, &SeriesName)],
    span: (f64, f64),
) {
    let is_current = log.figures.span == span;
    let first = 0.27 * ui.available_width();
    let column = (ui.available_width() - first) / MOST_COLUMNS as f32;
    ui.spacing_mut().item_spacing.y = 0.0;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        ui.add_space(first);
        for (colour, field) in fields {
            title(ui, tokens, log, field, (*colour, column));
        }
    });
    let known = |field: &SeriesName| log.figures.fields.get(field);
    for (index, row) in ROWS.iter().enumerate() {
        let height = 2.5 * tokens.space;
        let size = vec2(ui.available_width(), height);
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        let painter = ui.painter_at(rect);
        if index % 2 == 0 {
            painter.rect_filled(rect, 2.0, tokens.raised.gamma_multiply(0.5));
        }
        let middle = rect.center().y;
        let at = pos2(rect.left() + 0.5 * tokens.space, middle);
        painter.text(
            at,
            Align2::LEFT_CENTER,
            row.name,
            tokens.small(),
            tokens.muted,
        );
        let mut said = row.name.to_owned();
        for (i, (_, field)) in fields.iter().enumerate() {
            let value = cell(row, known(field));
            let right = rect.left() + first + (i + 1) as f32 * column - 0.5 * tokens.space;
            let colour = if is_current {
                tokens.text
            } else {
                tokens.muted
            };
            painter.text(
                pos2(right, middle),
                Align2::RIGHT_CENTER,
                &value,
                tokens.small(),
                colour,
            );
            said = format!("{said}, {}: {value}", series_name(field));
        }
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &said));
    }
    for why in fields
        .iter()
        .filter_map(|(_, field)| known(field)?.as_ref().err())
    {
        ui.label(
            RichText::new(why)
                .size(tokens.text_sizes[0])
                .color(tokens.warning),
        );
    }
    ui.add_space(tokens.space);
}

/// Name and unit of a field, right-aligned over its column.
fn title(
    ui: &mut Ui,
    tokens: &Tokens,
    log: &OpenLog,
    field: &SeriesName,
    (colour, width): (Color32, f32),
) {
    let unit = log.series.get(field).map_or("", |series| &series.unit);
    let name = series_name(field);
    let size = vec2(width, 4.5 * tokens.space);
    ui.allocate_ui_with_layout(size, Layout::top_down(Align::Max), |ui| {
        ui.spacing_mut().item_spacing.y = 0.0;
        ui.set_width(width - 0.5 * tokens.space);
        let text = RichText::new(&name)
            .size(tokens.text_sizes[0])
            .color(colour);
        let label = egui::Label::new(text).truncate();
        ui.add(label).on_hover_text(&name);
        let unit = RichText::new(unit).size(tokens.text_sizes[0]);
        ui.label(unit.color(tokens.muted));
    });
}

/// A figure of a field as people read it.
fn cell(row: &StatisticRow, known: Option<&FieldFigures>) -> String {
    match known {
        None => "…".to_owned(),
        Some(Err(_) | Ok(None)) => "–".to_owned(),
        Some(Ok(Some(found))) => match (row.of)(found) {
            None => "–".to_owned(),
            Some(count) if row.unit == "-" => format!("{count:.0}"),
            Some(value) => format!("{}{}", figure(value), row.unit),
        },
    }
}
