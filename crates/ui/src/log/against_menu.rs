//! Menu of the quantity that a panel is plotted against: time, or another field, chosen from a list that is
//! searched.

use egui::{Popup, PopupCloseBehavior, RichText, ScrollArea, TextEdit, Ui};

use super::words::series_name;
use super::{LogCommand, OpenLog};
use crate::tokens::Tokens;
use crate::views::parts;
use pilotage_jobs::SeriesName;

/// Most fields listed.
const MOST: usize = 40;

/// The list's own state.
#[derive(Clone, Debug, Default)]
pub(super) struct AgainstMenu {
    search: String,
}

impl AgainstMenu {
    /// Draws the chip of panel `number` that opens the list; what is chosen is added to `asked`.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        tokens: &Tokens,
        log: &OpenLog,
        (number, against): (usize, Option<&SeriesName>),
        asked: &mut Vec<LogCommand>,
    ) {
        let text = match against {
            None => "over time".to_owned(),
            Some(field) => format!("against {}", series_name(field)),
        };
        let name = format!("Plot {}, {text}: change", number + 1);
        let chip = parts::chip(ui, tokens, against.is_some(), &text, &name);
        let mut choose = |against| {
            asked.push(LogCommand::PlotAgainst {
                panel: number,
                against,
            });
        };
        Popup::menu(&chip)
            .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
            .show(|ui| {
                ui.set_width(30.0 * tokens.space);
                let is_over_time = against.is_none();
                if ui.selectable_label(is_over_time, "Over time").clicked() {
                    choose(None);
                    ui.close();
                }
                let edit = TextEdit::singleline(&mut self.search)
                    .align(egui::Align2::LEFT_CENTER)
                    .hint_text("Against a field …")
                    .desired_width(f32::INFINITY);
                ui.add(edit)
                    .accessible_name("Search fields to plot against");
                ScrollArea::vertical().max_height(280.0).show(ui, |ui| {
                    let fields = found(log, &self.search);
                    for field in &fields {
                        let name = series_name(field);
                        let label = ui.selectable_label(against == Some(field), &name);
                        label.widget_info(|| {
                            let name = format!("Against {name}");
                            egui::WidgetInfo::labeled(egui::Role::Button, true, name)
                        });
                        if label.clicked() {
                            choose(Some(field.clone()));
                            ui.close();
                        }
                    }
                    if fields.is_empty() {
                        let text = RichText::new("No field is called so.");
                        ui.label(text.color(tokens.muted));
                    }
                });
            });
    }
}

/// Fields whose name contains `search`: what the log means first, then as it names them.
fn found(log: &OpenLog, search: &str) -> Vec<SeriesName> {
    let wanted = search.trim().to_lowercase();
    let sensors = log.overview.iter().flat_map(|overview| &overview.sensors);
    let roles = sensors.map(|sensor| SeriesName::role(sensor.role));
    let topics = log.outline.iter().flat_map(|outline| &outline.topics);
    let fields = topics.flat_map(|topic| {
        let numbers = topic.fields.iter().filter(|field| field.is_number);
        numbers.map(|field| SeriesName {
            topic: topic.name.clone(),
            field: field.name.clone(),
        })
    });
    let plotted = log
        .series
        .keys()
        .filter(|name| name.is_expression())
        .cloned();
    let all = roles.chain(plotted).chain(fields);
    let fits = |name: &SeriesName| series_name(name).to_lowercase().contains(&wanted);
    all.filter(fits).take(MOST).collect()
}
