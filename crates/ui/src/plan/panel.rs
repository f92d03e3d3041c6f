//! The column at the right while planning, and the strip below the map.

use egui::{Stroke, Ui};

use super::PlanCommand;
use super::chart::ChartScene;
use super::ground_tab::ground_tab;
use super::landmarks_tab::landmarks_tab;
use super::planner::{PlanTab, Planner};
use super::route_tab::route_tab;
use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::shell::{Examined, LandmarkList, icon_button, icons::Icon, muted, tab, text_button};

impl Planner {
    /// Draws the column.
    pub fn panel(
        &mut self,
        ui: &mut Ui,
        documents: &Documents,
        context: &mut ViewContext<'_>,
        list: &mut LandmarkList,
        examined: Examined<'_>,
    ) {
        let tokens = context.tokens;
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 0.0;
            for (choice, label) in [
                (PlanTab::Route, "Route"),
                (PlanTab::Landmarks, "Landmarks"),
                (PlanTab::Ground, "Ground"),
            ] {
                if tab(ui, tokens, label, choice == self.tab, 32.0).clicked() {
                    self.tab = choice;
                }
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let (past, future) = documents.history.depth();
                for (icon, label, command, enabled) in [
                    (Icon::Redo, "Redo", Command::Redo, future > 0),
                    (Icon::Undo, "Undo", Command::Undo, past > 0),
                ] {
                    ui.add_enabled_ui(enabled, |ui| {
                        if icon_button(ui, tokens, icon, label).clicked() {
                            context.commands.push(command);
                        }
                    });
                }
            });
        });
        let line = ui.max_rect().x_range();
        let y = ui.cursor().top() - 4.0;
        ui.painter().hline(line, y, Stroke::new(1.0, tokens.line));
        egui::ScrollArea::vertical()
            .id_salt(("plan", self.tab as u8))
            .auto_shrink(false)
            .show(ui, |ui| match self.tab {
                PlanTab::Route => route_tab(ui, self, documents, context),
                PlanTab::Ground => ground_tab(ui, self, context),
                PlanTab::Landmarks => landmarks_tab(ui, self, documents, context, list, examined),
            });
    }

    /// Draws the strip below the map: the prediction against distance.
    pub fn strip(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        let limit = self.preferences.limit;
        let state = if let Some(shown) = self.forecast.shown() {
            let count = shown.order.worlds;
            let rough = if self.forecast.is_fine() {
                ""
            } else {
                ", refining …"
            };
            Some((
                shown,
                format!("{count} ways in which detections may turn out{rough}"),
            ))
        } else {
            None
        };
        let Some((shown, state)) = state else {
            self.hovered = None;
            self.nothing_yet(ui, context);
            return;
        };
        let landmarks: Vec<_> = shown.order.landmarks.iter().map(|(l, _)| l).collect();
        let scene = ChartScene {
            prediction: &shown.prediction,
            landmarks: &landmarks,
            limit,
            state: &state,
            tokens,
            units: context.units,
        };
        self.hovered = self.chart.show(ui, &scene);
    }

    fn nothing_yet(&self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        let words = match self.forecast.trouble() {
            Some(why) => format!("This route cannot be predicted: {why}."),
            None if self.selected(context.mission).is_none() => {
                "Here you will see how well the aircraft knows its place along a route.".to_owned()
            }
            None => "Predicting …".to_owned(),
        };
        ui.centered_and_justified(|ui| ui.label(muted(tokens, words)));
    }
}

/// A button that sends a command.
pub fn button(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    icon: Option<Icon>,
    label: &str,
    strong: bool,
    command: PlanCommand,
) {
    if text_button(ui, context.tokens, icon, label, strong).clicked() {
        context.commands.push(Command::Plan(command));
    }
}
