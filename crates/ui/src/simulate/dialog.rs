//! The dialog that simulates a flight.

use std::f64::consts::TAU;

use egui::{Frame, Id, Modal, RichText, Ui};
use pilotage_core::simulate::SimulationChoice;

use super::command::SimulateCommand;
use crate::command::Command;
use crate::context::ViewContext;
use crate::feature_command::{FeatureCommand, STUDIES};
use crate::plan::{PlanCommand, RehearseCommand};
use crate::shell::{NumberField, caption, icons::Icon, muted, text_button, title};
use crate::tokens::Tokens;
use crate::units::Units;
use pilotage_jobs::SimulationOptions;

/// Dialog that sets up a simulated flight.
#[derive(Clone, Debug)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a box of its own to tick"
)]
pub struct SimulateDialog {
    /// Whether it is open.
    pub(super) is_open: bool,
    /// Whether the selected route is flown in the place of a scenario.
    of_route: bool,
    choices: Vec<SimulationChoice>,
    scenario: usize,
    seed: u64,
    other_day: bool,
    own_wind: bool,
    wind_from: f64,
    wind_speed: f64,
    own_height: bool,
    height: f64,
}

/// Height and wind of a scenario in the user's units.
fn facts(choice: &SimulationChoice, units: Units) -> String {
    let (factor, unit) = units.length();
    let height = format!("{:.0} {unit} above ground", choice.height * factor);
    let (factor, unit) = units.speed();
    if choice.wind.speed < 0.05 {
        return format!("{height}, calm");
    }
    let from = choice.wind.from.to_degrees().round().rem_euclid(360.0);
    let speed = choice.wind.speed * factor;
    format!("{height}, wind from {from:03.0}° at {speed:.1} {unit}")
}

impl Default for SimulateDialog {
    fn default() -> Self {
        let choices = SimulationChoice::all();
        let demo = SimulationOptions::demo().scenario;
        let scenario = choices.iter().position(|c| c.name == demo);
        let mut dialog = Self {
            is_open: false,
            of_route: false,
            choices,
            scenario: scenario.unwrap_or(0),
            seed: 1,
            other_day: true,
            own_wind: false,
            wind_from: 0.0,
            wind_speed: 0.0,
            own_height: false,
            height: 0.0,
        };
        dialog.adopt();
        dialog
    }
}

impl SimulateDialog {
    /// Takes wind and height of the chosen scenario where the user did not set them.
    fn adopt(&mut self) {
        let choice = &self.choices[self.scenario];
        if !self.own_wind {
            self.wind_from = choice.wind.from;
            self.wind_speed = choice.wind.speed;
        }
        if !self.own_height {
            self.height = choice.height;
        }
    }

    fn options(&self) -> SimulationOptions {
        let choice = &self.choices[self.scenario];
        let is_variable = choice.world.is_variable();
        let wind = (self.wind_from, self.wind_speed);
        SimulationOptions {
            scenario: choice.name.to_owned(),
            seed: self.seed,
            other_day: is_variable && self.other_day,
            wind: (is_variable && self.own_wind).then_some(wind),
            height: (is_variable && self.own_height).then_some(self.height),
        }
    }

    /// Draws the dialog.
    pub(super) fn show(&mut self, ui: &Ui, view: &mut ViewContext<'_>) {
        let (context, tokens, units) = (ui.ctx(), view.tokens, view.units);
        let route = view.selected_route().map(|it| it.name.as_str());
        let commands = &mut *view.commands;
        let screen = context.content_rect();
        let response = Modal::new(Id::unique("simulate"))
            .frame(Frame::window(&context.global_style()).inner_margin(24))
            .show(context, |ui| {
                ui.set_width(520.0_f32.min(screen.width() - 96.0));
                let mut close = title(ui, tokens, "Simulate a flight");
                egui::ScrollArea::vertical()
                    .max_height(screen.height() - 220.0)
                    .min_scrolled_height(screen.height() - 220.0)
                    .show(ui, |ui| self.contents(ui, tokens, units, route));
                ui.add_space(2.0 * tokens.space);
                ui.horizontal(|ui| {
                    if text_button(ui, tokens, Some(Icon::Play), "Fly", true).clicked() {
                        commands.push(if self.of_route && route.is_some() {
                            PlanCommand::Rehearse(RehearseCommand::Watch(Some(self.seed))).into()
                        } else {
                            SimulateCommand(self.options()).into()
                        });
                        close = true;
                    }
                    if text_button(ui, tokens, None, "Cancel", false).clicked() {
                        close = true;
                    }
                    ui.label(muted(tokens, "Replaces the current flight."));
                });
                ui.horizontal(|ui| {
                    if text_button(ui, tokens, None, "A study: many flights…", false).clicked() {
                        commands.push(Command::Feature(FeatureCommand::show(STUDIES)));
                        close = true;
                    }
                    let words = "Flown many times, with one thing changed.";
                    ui.label(muted(tokens, words));
                });
                close
            });
        if response.inner || response.should_close() {
            self.is_open = false;
        }
    }

    fn contents(&mut self, ui: &mut Ui, tokens: &Tokens, units: Units, route: Option<&str>) {
        if let Some(route) = route {
            caption(ui, tokens, "Your route");
            ui.radio_value(&mut self.of_route, true, route);
            if self.of_route {
                let words = "Flown over the map that is open, on another day than the map's, in a wind near the one \
                             that is planned with.";
                ui.indent("route", |ui| ui.label(muted(tokens, words)));
                ui.add_space(tokens.space);
                self.seed(ui, tokens);
            }
            ui.add_space(tokens.space);
        }
        let of_route = self.of_route && route.is_some();
        caption(ui, tokens, "Scenario");
        for (index, choice) in self.choices.iter().enumerate() {
            let is_chosen = !of_route && self.scenario == index;
            if ui.radio(is_chosen, choice.title).clicked() {
                (self.scenario, self.of_route) = (index, false);
            }
            if is_chosen {
                ui.indent(index, |ui| {
                    ui.label(muted(tokens, facts(choice, units)));
                    ui.label(muted(
                        tokens,
                        format!("{} ({})", choice.description, choice.name),
                    ));
                });
            }
        }
        self.adopt();
        ui.add_space(tokens.space);
        if of_route {
            return;
        }
        if self.choices[self.scenario].world.is_variable() {
            self.variable(ui, tokens, units);
        }
        self.seed(ui, tokens);
    }

    fn variable(&mut self, ui: &mut Ui, tokens: &Tokens, units: Units) {
        caption(ui, tokens, "Day");
        ui.horizontal(|ui| {
            ui.radio_value(&mut self.other_day, true, "Another day than the map");
            ui.radio_value(&mut self.other_day, false, "The same day");
        });
        ui.label(muted(
            tokens,
            "On another day sun, haze, season and parked cars differ from the map: an honest test.",
        ));
        ui.add_space(tokens.space);
        self.wind(ui, tokens, units);
        ui.add_space(tokens.space);
        self.height(ui, tokens, units);
        ui.add_space(tokens.space);
    }

    fn wind(&mut self, ui: &mut Ui, tokens: &Tokens, units: Units) {
        caption(ui, tokens, "Wind");
        ui.checkbox(&mut self.own_wind, "Override wind");
        ui.add_enabled_ui(self.own_wind, |ui| {
            ui.horizontal(|ui| {
                let label = ui.label("From");
                let from = NumberField::new(0.0..=TAU).degrees();
                from.show(ui, &mut self.wind_from).labelled_by(label.id);
                let label = ui.label("at");
                let speed = NumberField::new(0.0..=12.0).unit(units.speed());
                let speed = speed.speed(0.1).decimals(1);
                let speed = speed.show(ui, &mut self.wind_speed);
                speed.labelled_by(label.id).on_hover_text("Wind speed");
            });
        });
    }

    fn height(&mut self, ui: &mut Ui, tokens: &Tokens, units: Units) {
        caption(ui, tokens, "Height above ground");
        ui.checkbox(&mut self.own_height, "Another height than the scenario’s");
        ui.add_enabled_ui(self.own_height, |ui| {
            let field = NumberField::new(60.0..=600.0).unit(units.length());
            let field = field.show(ui, &mut self.height);
            field.accessible_name("Height above ground");
        });
    }

    fn seed(&mut self, ui: &mut Ui, tokens: &Tokens) {
        caption(ui, tokens, "Random seed");
        ui.horizontal(|ui| {
            let field = NumberField::new(0.0..=999_999.0).speed(0.25);
            field.show(ui, &mut self.seed).accessible_name("Seed");
            ui.label(
                RichText::new("The same seed gives the same flight, gust for gust.")
                    .font(tokens.small())
                    .color(tokens.muted),
            );
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn height_and_wind_of_a_scenario_are_in_the_units_of_whoever_reads_them() {
        let wind = SimulationChoice::named("distinct-400ft-wind").unwrap();
        let metric = "122 m above ground, wind from 307° at 5.1 m/s";
        assert_eq!(facts(&wind, Units::Metric), metric);
        let aviation = "400 ft above ground, wind from 307° at 10.0 kt";
        assert_eq!(facts(&wind, Units::Aviation), aviation);
        let calm = SimulationChoice::named("distinct-1000ft-extended").unwrap();
        assert_eq!(facts(&calm, Units::Metric), "305 m above ground, calm");
    }
}
