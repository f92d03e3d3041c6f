//! The column at the right while planning, and the strip below the map.

use egui::{Stroke, Ui};
use pilotage_core::exchange::Format;

use super::PlanCommand;
use super::chart::ChartScene;
use super::flown::home_of;
use super::ground_tab::ground_tab;
use super::landmarks_tab::landmarks_tab;
use super::planner::{Planner, by_name};
use super::profile::{self, ProfileScene};
use super::rehearsal::FlownErrors;
use super::route_tab::route_tab;
use super::tab::PlanTab;
use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::export_command::ExportCommand;
use crate::shell::{caption, icon_button, icons::Icon, muted, tab};

impl Planner {
    /// Draws the column.
    pub fn column(&mut self, ui: &mut Ui, documents: &Documents, context: &mut ViewContext<'_>) {
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
                let (past, future) = documents.mission.history.depth();
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
                export_menu(ui, context);
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
                PlanTab::Ground => ground_tab(ui, self, documents, context),
                PlanTab::Landmarks => landmarks_tab(ui, self, documents, context),
            });
    }

    /// Draws the strip below the map: the prediction against distance.
    pub fn strip(&mut self, ui: &mut Ui, documents: &Documents, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        self.strip_tabs(ui, context);
        if self.preferences.profile {
            self.heights(ui, documents, context);
            return;
        }
        let limit = self.preferences.limit;
        let state = if let Some(shown) = self.forecast.shown() {
            let count = shown.order.worlds;
            let rough = if self.forecast.is_fine() {
                ""
            } else {
                ", refining …"
            };
            Some((shown, format!("{count} simulated flights{rough}")))
        } else {
            None
        };
        let Some((shown, state)) = state else {
            self.hovered = None;
            self.nothing_yet(ui, context);
            return;
        };
        let landmarks = by_name(&shown.order, &documents.mission);
        let no_fly: Vec<_> = (self.incursions.reached.iter())
            .map(|it| it.between)
            .collect();
        let scene = ChartScene {
            prediction: &shown.prediction,
            no_fly: &no_fly,
            flown: FlownErrors::of(&self.rehearsal),
            landmarks: &landmarks,
            limit,
            state: &state,
            tokens,
            units: context.units,
        };
        self.hovered = self.chart.show(ui, &scene);
    }

    /// Draws the choice between the two charts, at the right above them.
    fn strip_tabs(&self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        let area = ui.available_rect_before_wrap();
        let at = egui::Rect::from_min_max(
            egui::pos2(area.right() - 168.0, area.top() - 4.0),
            egui::pos2(area.right(), area.top() + 20.0),
        );
        let mut ui = ui.new_child(egui::UiBuilder::new().max_rect(at).id_salt("charts"));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ui.spacing_mut().item_spacing.x = 0.0;
            let profile = self.preferences.profile;
            for (label, on) in [("Heights", profile), ("Uncertainty", !profile)] {
                if tab(ui, tokens, label, on, 24.0).clicked() && !on {
                    let command = PlanCommand::ToggleProfile;
                    context.commands.push(Command::from(command));
                }
            }
        });
    }

    /// Draws the heights of the route over the ground.
    fn heights(&self, ui: &mut Ui, documents: &Documents, context: &ViewContext<'_>) {
        let Some(route) = context.selected_route().filter(|r| r.length() > 1.0) else {
            let words = "Here you will see how high a route lies over the ground.";
            ui.centered_and_justified(|ui| ui.label(muted(context.tokens, words)));
            return;
        };
        let relief = documents.relief();
        let source = relief.words(route, context.units);
        let take_off = relief.take_off(route);
        let home = home_of(route, documents);
        let ends_at_home = home.is_some();
        let mut route = route.clone();
        route.way_points.extend(home);
        let scene = ProfileScene {
            route: &route,
            ends_at_home,
            ground: &|place| relief.at(place),
            take_off,
            step: relief.spacing(),
            source: &source,
            frame: relief.frame(),
            chosen: self.way_point,
            tokens: context.tokens,
            units: context.units,
        };
        profile::show(ui, &scene);
    }

    fn nothing_yet(&self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        let words = match self.forecast.trouble() {
            Some(why) => format!("This route cannot be predicted: {why}."),
            None if context.selected_route().is_none() => {
                "Here you will see how well the aircraft knows its place along a route.".to_owned()
            }
            None => "Predicting …".to_owned(),
        };
        ui.centered_and_justified(|ui| ui.label(muted(tokens, words)));
    }
}

/// Name of a format as it stands in a menu: with a capital letter, and no article before it.
fn in_menu(words: &str) -> String {
    let words = words.strip_prefix("a ").unwrap_or(words);
    let mut letters = words.chars();
    let first = letters.next().map(char::to_uppercase);
    first.into_iter().flatten().chain(letters).collect()
}

/// Draws the menu of the formats in which the route and the landmarks can be saved for other programs.
fn export_menu(ui: &mut Ui, context: &mut ViewContext<'_>) {
    let button = icon_button(ui, context.tokens, Icon::Export, "Export");
    egui::Popup::menu(&button).show(|ui| {
        ui.set_min_width(250.0);
        let tokens = context.tokens;
        if ui.button("Print the mission brief…").clicked() {
            context
                .commands
                .push(Command::from(PlanCommand::PrintBrief));
            ui.close();
        }
        let of_rally = Format::of_rally_alone().filter(|_| !context.mission.rally.is_empty());
        if let Some(format) = of_rally {
            caption(ui, tokens, "Rally points");
            let words = format.as_words();
            let name = format!("Export the rally points as {words}");
            if ui.button(in_menu(words)).accessible_name(name).clicked() {
                context.commands.push(ExportCommand::Rally.into());
                ui.close();
            }
        }
        for (title, part) in [("Route", "route"), ("Landmarks", "landmarks")] {
            caption(ui, tokens, title);
            for format in Format::all() {
                let command = match part {
                    "route" => ExportCommand::Route(format),
                    _ if format.holds_landmarks() => ExportCommand::Landmarks(format),
                    _ => continue,
                };
                let words = format.as_words();
                let name = format!("Export the {part} as {words}");
                if ui.button(in_menu(words)).accessible_name(name).clicked() {
                    context.commands.push(command.into());
                    ui.close();
                }
            }
        }
    });
}
