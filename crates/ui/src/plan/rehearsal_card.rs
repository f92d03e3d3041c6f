//! The rehearsal in the column, and its commands carried out.

use egui::{RichText, Ui};
use pilotage_core::plan::PredictionAgreement;
use pilotage_jobs::{FlightSource, RehearsedFlight};
use serde_json::Value;

use super::PlanCommand;
use super::button::button;
use super::planner::Planner;
use super::rehearsal::{MOST_FLIGHTS, RehearseCommand, RouteRehearsal};
use super::tab::PlanTab;
use crate::command::{Command, Workspace};
use crate::context::ViewContext;
use crate::feature::FeatureContext;
use crate::shell::{NumberField, icon_button, icons::Icon, muted};
use crate::state_json::object;

impl Planner {
    /// Carries a command about the rehearsal out.
    pub(super) fn rehearse(&mut self, command: &RehearseCommand, context: &mut FeatureContext<'_>) {
        match command {
            RehearseCommand::Start => {
                self.tab = PlanTab::Route;
                let route = context.documents.mission.route;
                let can = self.order(context.documents).is_some();
                if let Some(route) = route.filter(|_| can) {
                    self.rehearsal.want(route);
                } else {
                    let text = "Draw a route of two way-points or more, or select one.";
                    context.note("There is no route to rehearse", text);
                }
            }
            RehearseCommand::Stop => self.rehearsal.stop(context),
            RehearseCommand::Dismiss => self.rehearsal.forget(context),
            RehearseCommand::Flights(count) => {
                self.preferences.rehearsal.flights = (*count).clamp(1, MOST_FLIGHTS);
            }
            RehearseCommand::Pictures(on) => self.preferences.rehearsal.pictures = *on,
            RehearseCommand::Watch(seed) => self.watch(*seed, context),
        }
    }

    /// Flies the route in Replay.
    pub(super) fn watch(&mut self, seed: Option<u64>, context: &mut FeatureContext<'_>) {
        let documents = &*context.documents;
        let route = documents
            .mission
            .selected_route()
            .map(|route| route.name.clone());
        let (Some(name), Some(plan)) = (route, self.order(documents)) else {
            let text = "Draw a route of two way-points or more, or select one.";
            context.note("There is no route to fly", text);
            return;
        };
        let worst = self
            .rehearsal
            .worst()
            .filter(|_| self.rehearsal.is_of_now());
        let seed = seed.or_else(|| Some(worst?.seed)).unwrap_or(1);
        let map = documents.map.source.clone();
        let of = (name, documents.mission.origin);
        let flight = RehearsedFlight::of_plan(plan, of, map.clone(), seed);
        context.fly_over(FlightSource::Rehearsed(Box::new(flight)), map);
        context.ask(Command::ShowWorkspace(Workspace::Replay));
    }

    /// Draws the rehearsal of the selected route.
    pub(super) fn rehearsal_card(&self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        let say = |command| PlanCommand::Rehearse(command);
        if let Some(share) = self.rehearsal.progress() {
            ui.horizontal(|ui| {
                if icon_button(ui, tokens, Icon::Close, "Stop the rehearsal").clicked() {
                    context
                        .commands
                        .push(Command::from(say(RehearseCommand::Stop)));
                }
                ui.vertical(|ui| {
                    let bar = egui::ProgressBar::new(share).desired_height(4.0);
                    ui.add(bar).accessible_name("How far the rehearsal is");
                    let all = self
                        .rehearsal
                        .preferences()
                        .unwrap_or(&self.preferences.rehearsal);
                    let flown = self.rehearsal.flown().len();
                    let words = format!("{flown} of {} flights flown", all.flights);
                    ui.label(muted(tokens, words));
                });
            });
        } else {
            ui.horizontal(|ui| {
                let label = "Rehearse this route";
                let start = say(RehearseCommand::Start);
                button(ui, context, Some(Icon::Play), label, false, start);
                let watch = say(RehearseCommand::Watch(Some(1)));
                button(ui, context, None, "Watch a flight", false, watch);
                let more = icon_button(ui, tokens, Icon::More, "Settings of the rehearsal");
                egui::Popup::menu(&more)
                    .close_behavior(egui::PopupCloseBehavior::CloseOnClickOutside)
                    .show(|ui| self.rehearsal_settings(ui, context));
            });
        }
        self.rehearsal_result(ui, context);
    }

    fn rehearsal_settings(&self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let preferences = &self.preferences.rehearsal;
        let mut say = |command| {
            let command = PlanCommand::Rehearse(command);
            context.commands.push(Command::from(command));
        };
        ui.horizontal(|ui| {
            let mut count = preferences.flights;
            let field = NumberField::whole(1..=MOST_FLIGHTS).speed(0.1);
            let field = field.show(ui, &mut count);
            if field.accessible_name("Flights of a rehearsal").changed() {
                say(RehearseCommand::Flights(count));
            }
            ui.label(muted(context.tokens, "flights"));
            let mut on = preferences.pictures;
            let hint = "With pictures, landmarks are looked for on other days of the map. Without, they are found as \
                        often and as well as is predicted, which is faster.";
            if ui.checkbox(&mut on, "with pictures").on_hover_text(hint).changed() {
                say(RehearseCommand::Pictures(on));
            }
        });
    }

    fn rehearsal_result(&self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let (tokens, rehearsal) = (context.tokens, &self.rehearsal);
        if let Some(why) = rehearsal.trouble() {
            let text = format!("A flight failed: {why}.");
            ui.label(RichText::new(text).color(tokens.warning));
        }
        let sentences = rehearsal.sentences(context.units);
        if sentences.is_empty() {
            return;
        }
        if !rehearsal.is_of_now() {
            let words = "The plan has changed since it was rehearsed: rehearse it again.";
            ui.label(RichText::new(words).color(tokens.warning));
        }
        let is_bad = rehearsal.agreement() == PredictionAgreement::TooGood && rehearsal.is_of_now();
        let last = sentences.len() - 1;
        for (index, sentence) in sentences.into_iter().enumerate() {
            let color = match (rehearsal.is_of_now(), index == last && is_bad) {
                (false, _) => tokens.muted,
                (true, true) => tokens.warning,
                (true, false) => tokens.text,
            };
            ui.label(RichText::new(sentence).color(color));
        }
        if let Some(worst) = rehearsal.worst().filter(|_| rehearsal.is_of_now()) {
            let label = format!("Watch the worst: flight {}", worst.seed);
            let watch = PlanCommand::Rehearse(RehearseCommand::Watch(Some(worst.seed)));
            button(ui, context, Some(Icon::Play), &label, false, watch);
        }
    }
}

impl RouteRehearsal {
    /// The rehearsal for journeys.
    pub(super) fn json(&self) -> Value {
        let all = self.summary();
        object!({
            "flown": self.flown().len(),
            "progress": self.progress(),
            "inside_corridor": all.inside_corridor,
            "uncertainty": all.corridor_uncertainty,
            "rms": all.rms_m,
            "predicted_rms": all.predicted_rms_m,
            "worst": self.worst().map(|it| object!({"seed": it.seed, "error": it.worst.0})),
            "current": self.is_of_now(),
            "trouble": self.trouble(),
        })
    }
}
