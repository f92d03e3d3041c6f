//! The topics and fields of a log, to be searched and plotted.

use egui::{Align, Layout, RichText, Ui};
use pilotage_core::flight::log::{LogOutline, TopicOutline};

use super::expression_field::{ExpressionField, TypedExpression};
use super::presets::OwnPresets;
use super::{LogCommand, OpenLog};
use crate::command::Command;
use crate::context::ViewContext;
use crate::units::shown_unit;
use crate::views::parts;
use pilotage_jobs::SeriesName;

/// Most fields listed of a search.
const MOST_FOUND: usize = 200;
/// Most expressions that are remembered.
const MOST_EXPRESSIONS: usize = 30;
/// Part of a log over which a topic has to be spread for its rate to mean something.
const LEAST_SHARE: f64 = 0.05;
/// Letters of a name that are shown before it is cut off.
const MOST_LETTERS: usize = 34;

/// The list's own state.
#[derive(Clone, Debug, Default)]
pub struct FieldList {
    search: String,
    expression: ExpressionField,
}

impl FieldList {
    /// Draws the search and what it finds; `plotted` says what is in a plot.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        log: &OpenLog,
        own: &mut OwnPresets,
        plotted: &dyn Fn(&SeriesName) -> bool,
    ) {
        let Some(outline) = &log.outline else { return };
        if log.is_read() {
            self.write(ui, context, log, own);
        }
        let hint = format!("Search {} fields", count(outline));
        let edit = egui::TextEdit::singleline(&mut self.search)
            .align(egui::Align2::LEFT_CENTER)
            .hint_text(hint)
            .desired_width(f32::INFINITY);
        ui.add(edit).accessible_name("Search fields of the log");
        ui.add_space(0.5 * context.tokens.space);
        let width = ui.available_width();
        egui::ScrollArea::vertical()
            .id_salt("fields")
            .auto_shrink(false)
            .show(ui, |ui| {
                ui.set_max_width(width);
                if self.search.trim().is_empty() {
                    own_expressions(ui, context, own, plotted);
                }
                self.list(ui, context, log, outline, plotted);
            });
    }

    /// The field for expressions; what is entered there is plotted and remembered.
    fn write(
        &mut self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        log: &OpenLog,
        own: &mut OwnPresets,
    ) {
        let written = self.expression.show(ui, context.tokens, log);
        ui.add_space(0.5 * context.tokens.space);
        let (text, command): (_, fn(SeriesName) -> LogCommand) = match written {
            Some(TypedExpression::Alone(text)) => (text, LogCommand::PlotAlone),
            Some(TypedExpression::Beside(text)) => (text, LogCommand::Plot),
            None => return,
        };
        let series = SeriesName::expression(&text);
        own.remember_expression(&series, MOST_EXPRESSIONS);
        context.commands.push(Command::from(command(series)));
    }

    fn list(
        &self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        log: &OpenLog,
        outline: &LogOutline,
        plotted: &dyn Fn(&SeriesName) -> bool,
    ) {
        let wanted = self.search.trim().to_lowercase();
        if wanted.is_empty() {
            roles(ui, context, log, plotted);
            let whole = outline.span.map_or(0.0, |(from, to)| to - from);
            for topic in &outline.topics {
                topic_section(ui, context, topic, whole, plotted);
            }
            return;
        }
        let mut found = 0;
        for topic in &outline.topics {
            for field in topic.fields.iter().filter(|f| f.is_number) {
                let name = SeriesName {
                    topic: topic.name.clone(),
                    field: field.name.clone(),
                };
                let full = super::words::series_name(&name);
                if !full.to_lowercase().contains(&wanted) {
                    continue;
                }
                found += 1;
                if found <= MOST_FOUND {
                    row(ui, context, &full, &field.unit, name, plotted);
                }
            }
        }
        if found == 0 {
            let hint = "Names are written as in the log: ATT.Roll, vehicle_attitude.q[0].";
            parts::empty(ui, context.tokens, "No field is called so", hint);
        } else if found > MOST_FOUND {
            let more = format!("and {} more: write more of the name", found - MOST_FOUND);
            ui.label(RichText::new(more).color(context.tokens.muted));
        }
    }
}

/// Expressions that were plotted.
fn own_expressions(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    own: &mut OwnPresets,
    plotted: &dyn Fn(&SeriesName) -> bool,
) {
    if own.expressions.is_empty() {
        return;
    }
    let title = RichText::new("Expressions").size(context.tokens.text_sizes[1]);
    let header = egui::CollapsingHeader::new(title).default_open(true);
    header.show(ui, |ui| {
        let mut forgotten = None;
        for (index, text) in own.expressions.iter().enumerate() {
            let series = SeriesName::expression(text);
            let tokens = context.tokens;
            ui.horizontal(|ui| {
                let name = format!("Forget {text}");
                if parts::chip(ui, tokens, false, "×", &name).clicked() {
                    forgotten = Some(index);
                }
                row(ui, context, text, "", series, plotted);
            });
        }
        if let Some(index) = forgotten {
            own.expressions.remove(index);
        }
    });
}

/// A name with its end cut off where it is long.
fn shortened(text: &str) -> String {
    if text.chars().count() <= MOST_LETTERS {
        return text.to_owned();
    }
    let head: String = text.chars().take(MOST_LETTERS - 1).collect();
    format!("{}…", head.trim_end())
}

fn count(outline: &LogOutline) -> usize {
    let of = |topic: &TopicOutline| topic.fields.iter().filter(|f| f.is_number).count();
    outline.topics.iter().map(of).sum()
}

/// Draws the measured quantities, whatever the log calls them.
fn roles(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    log: &OpenLog,
    plotted: &dyn Fn(&SeriesName) -> bool,
) {
    let Some(overview) = &log.overview else {
        return;
    };
    let title = RichText::new("This flight").size(context.tokens.text_sizes[1]);
    egui::CollapsingHeader::new(title)
        .default_open(true)
        .show(ui, |ui| {
            for sensor in &overview.sensors {
                let (unit, _) = sensor.role.unit();
                let series = SeriesName::role(sensor.role);
                row(ui, context, sensor.role.label(), unit, series, plotted);
            }
        });
}

/// Rate of a topic in a log of `whole` seconds, in words: of what was written in one go, such as parameters, the number
/// of rows.
fn often(topic: &TopicOutline, whole: f64) -> String {
    let lasts = topic.span.map_or(0.0, |(from, to)| to - from);
    let rate = topic.rate();
    match rate {
        _ if topic.rows == 1 => "once".to_owned(),
        _ if lasts < LEAST_SHARE * whole => format!("{} rows", topic.rows),
        rate if rate >= 10.0 => format!("{rate:.0} Hz"),
        rate if rate >= 0.1 => format!("{rate:.1} Hz"),
        _ => format!("{} rows", topic.rows),
    }
}

/// A topic that unfolds to its fields.
fn topic_section(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    topic: &TopicOutline,
    whole: f64,
    plotted: &dyn Fn(&SeriesName) -> bool,
) {
    let tokens = context.tokens;
    let name = topic.name.to_string();
    let often = often(topic, whole);
    let title = RichText::new(format!("{name}   {often}")).size(tokens.text_sizes[1]);
    egui::CollapsingHeader::new(title)
        .id_salt(("topic", &name))
        .show(ui, |ui| {
            for field in topic.fields.iter().filter(|f| f.is_number) {
                let series = SeriesName {
                    topic: topic.name.clone(),
                    field: field.name.clone(),
                };
                row(ui, context, &field.name, &field.unit, series, plotted);
            }
        });
}

/// Draws the row of a field: a click plots it or takes it away, a button beside it gives it a panel of its
/// own.
fn row(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    text: &str,
    unit: &str,
    series: SeriesName,
    plotted: &dyn Fn(&SeriesName) -> bool,
) {
    let tokens = context.tokens;
    let full = super::words::series_name(&series);
    ui.horizontal(|ui| {
        let mut on = plotted(&series);
        let label = RichText::new(shortened(text)).size(tokens.text_sizes[1]);
        let response = ui.checkbox(&mut on, label);
        response.widget_info(|| {
            let role = egui::Role::CheckBox;
            egui::WidgetInfo::selected(role, true, on, format!("Plot {full}"))
        });
        if response.clicked() {
            let command = LogCommand::Toggle(series.clone());
            context.commands.push(Command::from(command));
        }
        ui.label(
            RichText::new(shown_unit(unit))
                .size(tokens.text_sizes[0])
                .color(tokens.muted),
        );
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let alone = parts::chip(ui, tokens, false, "+", &format!("{full} in a new plot"));
            if alone.on_hover_text("In a new plot").clicked() {
                let command = LogCommand::PlotAlone(series.clone());
                context.commands.push(Command::from(command));
            }
            let track = parts::chip(
                ui,
                tokens,
                false,
                "map",
                &format!("Colour the track by {full}"),
            );
            if track.on_hover_text("Colour the track by it").clicked() {
                let command = LogCommand::ColourTrack(Some(series));
                context.commands.push(Command::from(command));
            }
        });
    });
}

#[cfg(test)]
mod tests {
    use pilotage_core::flight::log::TopicName;

    use super::*;

    #[test]
    fn topics_written_in_one_go_have_rows_and_no_rate() {
        let topic = |rows, from, to| TopicOutline {
            name: TopicName::single("PARM"),
            rows,
            span: Some((from, to)),
            fields: Vec::new(),
        };
        // All parameters of a vehicle within a quarter of a second of a flight of ten minutes.
        assert_eq!(often(&topic(700, 0.0, 0.25), 600.0), "700 rows");
        assert_eq!(often(&topic(15_001, 0.0, 600.0), 600.0), "25 Hz");
        // A sensor that was lost in the middle of the flight.
        assert_eq!(often(&topic(7_501, 0.0, 300.0), 600.0), "25 Hz");
        assert_eq!(often(&topic(1, 3.0, 3.0), 600.0), "once");
    }
}
