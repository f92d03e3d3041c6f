//! Learn: a guided tour over the run on screen, with a telling moment at every stop.

mod figures;
mod find;
mod moment;
mod stop;
mod unscented;

use std::cmp::Ordering;

use egui::{Align, Key, Layout, Rect, RichText, Sense, Stroke, Ui, vec2};

use super::parts;
use crate::command::Command;
use crate::context::ViewContext;
use moment::TourMoment;
use stop::Stop;

/// The tour's own state: at which stop it is.
pub struct Tour {
    number: usize,
    /// Whether the cursor has been brought to the moment of this stop.
    arrived: bool,
    /// The moment of this stop, and for how many steps of the run it was looked up.
    found: Option<(usize, Option<TourMoment>)>,
    /// The slider of the stop on α.
    alpha: f64,
    /// Number of changes of the settings made here that can be taken back.
    edited: usize,
    /// Number of the screen's frame in which the tour was drawn last.
    drawn: u64,
}

impl Default for Tour {
    fn default() -> Self {
        Self {
            number: 0,
            arrived: false,
            found: None,
            alpha: 0.3,
            edited: 0,
            drawn: 0,
        }
    }
}

impl Tour {
    /// Number of stops.
    pub const STOPS: usize = Stop::ALL.len();

    /// Begins anew at the first stop.
    pub fn start(&mut self) {
        *self = Self::default();
    }

    /// Number of the stop, from 0.
    pub fn number(&self) -> usize {
        self.number
    }

    /// Title of the stop.
    pub fn title(&self) -> &'static str {
        self.current().title()
    }

    /// Goes to the next stop; stays at the last.
    pub fn next(&mut self) {
        self.go_to(self.number + 1);
    }

    /// Goes to the previous stop.
    pub fn previous(&mut self) {
        self.go_to(self.number.saturating_sub(1));
    }

    /// Goes to a stop by its number, from 0.
    pub fn go_to(&mut self, number: usize) {
        self.number = number.min(Self::STOPS - 1);
        self.arrived = false;
        self.found = None;
    }

    fn current(&self) -> Stop {
        Stop::ALL[self.number]
    }

    /// Draws the stop into the space that `ui` has left, and brings the cursor to its moment when
    /// the stop is entered or the tour comes back into view.
    pub fn show(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let drawn = ui.ctx().cumulative_frame_nr();
        if drawn > self.drawn + 1 {
            self.arrived = false;
        }
        self.drawn = drawn;
        self.look_up(context);
        self.arrive(context);
        let tokens = context.tokens;
        ui.spacing_mut().item_spacing = vec2(tokens.space, 0.75 * tokens.space);
        let below = 8.5 * tokens.space;
        let room = (ui.available_height() - below).max(80.0);
        egui::ScrollArea::vertical()
            .id_salt(("tour", self.number))
            .max_height(room)
            .auto_shrink([false, false])
            .show(ui, |ui| self.content(ui, context, room));
        self.navigation(ui, context);
    }

    /// Looks the moment up anew while the run grows.
    fn look_up(&mut self, context: &ViewContext<'_>) {
        let steps = context.run.map_or(0, |run| run.steps.len());
        if self.found.as_ref().is_some_and(|(seen, _)| *seen == steps) {
            return;
        }
        let moment = context
            .run
            .and_then(|run| find::find(self.current(), run, context.flight, context.units));
        self.found = Some((steps, moment));
    }

    /// Brings the cursor to the moment and pauses, once per stop.
    fn arrive(&mut self, context: &mut ViewContext<'_>) {
        let Some((_, Some(moment))) = &self.found else {
            return;
        };
        if self.arrived {
            return;
        }
        self.arrived = true;
        context.commands.push(Command::SeekTo(moment.time));
        if context.playing {
            context.commands.push(Command::TogglePlay);
        }
        if moment.landmark.is_some() && moment.landmark != context.selection {
            context
                .commands
                .push(Command::SelectLandmark(moment.landmark));
        }
    }

    fn content(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, room: f32) {
        let tokens = context.tokens;
        let top = ui.cursor().top();
        let stop = self.current();
        ui.label(
            RichText::new(format!("LEARN  {} / {}", self.number + 1, Self::STOPS))
                .size(tokens.text_sizes[0])
                .color(tokens.muted),
        );
        ui.label(
            RichText::new(stop.title())
                .size(tokens.text_sizes[2])
                .color(tokens.text),
        );
        let moment = self.found.as_ref().and_then(|(_, moment)| moment.clone());
        let Some(moment) = moment else {
            let text = match (stop, context.run) {
                (_, None) => "There is no run yet. Open the demo to take the tour over it.",
                (Stop::Wind, Some(run)) if run.state_index("wind north").is_none() => {
                    "This vehicle model does not estimate the wind. Choose “Airplane + wind” in the filter settings to see it learned."
                }
                _ => {
                    "The run on screen has no such moment, or has not come to it yet. Let it go on, or see the next stop."
                }
            };
            ui.label(
                RichText::new(text)
                    .size(tokens.text_sizes[1])
                    .color(tokens.muted),
            );
            self.take_back(ui, context);
            return;
        };
        ui.label(
            RichText::new(&moment.text)
                .size(tokens.text_sizes[1])
                .color(tokens.text),
        );
        let controls = if stop == Stop::Alpha { 11.0 } else { 6.5 };
        let left = room - (ui.cursor().top() - top) - controls * tokens.space;
        figures::draw(ui, context, stop, &moment, self.alpha, left);
        if stop == Stop::Alpha {
            let slider = egui::Slider::new(&mut self.alpha, 0.05..=1.0)
                .logarithmic(true)
                .fixed_decimals(2)
                .text("α");
            ui.add(slider);
        }
        let settings = &context.mission.navigator;
        let trial = stop.trial(Some(&moment), settings, context.playing, self.alpha);
        ui.horizontal_wrapped(|ui| {
            let text = RichText::new(format!("Try: {}", trial.text))
                .size(tokens.text_sizes[1])
                .color(tokens.accent);
            let button = egui::Button::new(text)
                .fill(tokens.raised)
                .stroke(Stroke::new(1.0, tokens.line))
                .corner_radius(tokens.radius)
                .wrap();
            if ui.add(button).clicked() {
                context.commands.extend(trial.commands);
                self.edited += usize::from(trial.edits);
            }
            self.take_back(ui, context);
        });
    }

    /// Takes back what was tried here, if anything.
    fn take_back(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let text = "Take it back";
        if self.edited > 0 && parts::chip(ui, context.tokens, false, text, text).clicked() {
            self.edited -= 1;
            context.commands.push(Command::Undo);
        }
    }

    /// Dots, previous, next, leave.
    fn navigation(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        let mut go_to = None;
        let mut next = false;
        if !ui.ctx().text_edit_focused() {
            ui.input_mut(|input| {
                let none = egui::Modifiers::NONE;
                next |= input.consume_key(none, Key::PageDown);
                if input.consume_key(none, Key::PageUp) {
                    go_to = Some(self.number.saturating_sub(1));
                }
            });
        }
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 0.0;
            for (i, stop) in Stop::ALL.into_iter().enumerate() {
                if dot(ui, context, i, stop, self.number).clicked() {
                    go_to = Some(i);
                }
            }
        });
        ui.horizontal(|ui| {
            let back = ui.add_enabled(self.number > 0, egui::Button::new("Back"));
            let last = self.number + 1 == Self::STOPS;
            let text = RichText::new(if last { "Finish" } else { "Next" }).color(tokens.background);
            let forward = ui.add(egui::Button::new(text).fill(tokens.accent));
            if back.clicked() {
                go_to = Some(self.number.saturating_sub(1));
            }
            next |= forward.clicked();
            ui.label(
                RichText::new("or Page Down")
                    .size(tokens.text_sizes[0])
                    .color(tokens.muted),
            );
            for response in [&back, &forward] {
                if response.has_focus() {
                    let filter = egui::EventFilter {
                        horizontal_arrows: true,
                        ..egui::EventFilter::default()
                    };
                    ui.memory_mut(|m| m.set_focus_lock_filter(response.id, filter));
                    ui.input_mut(|input| {
                        let none = egui::Modifiers::NONE;
                        next |= input.consume_key(none, Key::ArrowRight);
                        if input.consume_key(none, Key::ArrowLeft) {
                            go_to = Some(self.number.saturating_sub(1));
                        }
                    });
                }
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let text = RichText::new("Leave the tour")
                    .size(tokens.text_sizes[0])
                    .color(tokens.muted);
                if ui.add(egui::Button::new(text).frame(false)).clicked() {
                    context.commands.push(Command::ToggleTour);
                }
            });
        });
        if let Some(number) = go_to {
            self.go_to(number);
        }
        if next {
            if self.number + 1 == Self::STOPS {
                self.go_to(0);
                context.commands.push(Command::ToggleTour);
            } else {
                self.next();
            }
        }
    }
}

/// A progress dot that leads to its stop.
fn dot(
    ui: &mut Ui,
    context: &ViewContext<'_>,
    index: usize,
    stop: Stop,
    current: usize,
) -> egui::Response {
    let tokens = context.tokens;
    let size = vec2(2.0 * tokens.space, 2.0 * tokens.space);
    let (rect, response): (Rect, _) = ui.allocate_exact_size(size, Sense::click());
    response.widget_info(|| {
        egui::WidgetInfo::selected(
            egui::Role::RadioButton,
            true,
            index == current,
            format!(
                "Stop {} of {}: {}",
                index + 1,
                Stop::ALL.len(),
                stop.title()
            ),
        )
    });
    let color = match index.cmp(&current) {
        Ordering::Less => tokens.text,
        Ordering::Equal => tokens.accent,
        Ordering::Greater => tokens.line,
    };
    let radius = if response.hovered() || response.has_focus() {
        5.0
    } else {
        4.0
    };
    ui.painter().circle_filled(rect.center(), radius, color);
    response.on_hover_text(stop.title())
}

#[cfg(test)]
mod tests;
