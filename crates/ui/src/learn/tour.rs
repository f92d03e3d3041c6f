//! The guided tour over the run on screen, with a telling moment at every stop.

use std::cmp::Ordering;
use std::rc::Rc;

use egui::{Align, Key, Layout, Rect, RichText, Sense, Stroke, Ui, vec2};

use super::command::LearnCommand;
use super::figure::FigureNumbers;
use super::lesson::TourStop;
use super::moment::TourMoment;
use super::{figure, lessons};
use crate::command::Command;
use crate::context::ViewContext;
use crate::tokens::Tokens;
use crate::units::Units;
use crate::views::parts;

/// Page of the lessons, beside that of the app.
pub(super) const LESSONS: &str = "./learn.html";

/// Words in the place of a moment that the run does not have.
const NOT_YET: &str = "The run on screen has no such moment, or has not come to it yet. Let it go on, or see the next stop.";

/// The tour's own state: at which stop it is.
pub(super) struct Tour {
    /// The stops.
    lessons: Vec<Box<dyn TourStop>>,
    number: usize,
    /// Whether the cursor has been brought to the moment of this stop.
    arrived: bool,
    /// Findings of this stop in the run, once it was looked up.
    found: Option<FoundStop>,
    /// Number of times that a run was looked through.
    #[cfg(test)]
    pub(super) looked_up: usize,
    /// Number of changes of the settings made here that can be taken back.
    edited: usize,
    /// Number of the screen's frame in which the tour was drawn last.
    drawn: u64,
}

/// Part of a run that a stop finds: another run, or one that has grown, has another.
#[derive(Clone, Debug, PartialEq)]
struct RunPart {
    steps: usize,
    /// Estimate at its end, metres north and east.
    end: Option<[f64; 2]>,
    /// Units of the words.
    units: Units,
}

impl RunPart {
    fn of(context: &ViewContext<'_>) -> Self {
        let steps = context.run.map_or(&[][..], |run| &run.steps);
        let end = steps.last().map(|step| step.after.position());
        Self {
            steps: steps.len(),
            end: end.map(|end| [end.north, end.east]),
            units: context.units,
        }
    }
}

/// Findings of a stop in a run.
#[derive(Clone)]
struct FoundStop {
    of: RunPart,
    /// The moment, or words on why there is none.
    moment: Result<TourMoment, &'static str>,
    numbers: Rc<FigureNumbers>,
}

impl Default for Tour {
    fn default() -> Self {
        Self {
            lessons: lessons::all(),
            number: 0,
            arrived: false,
            found: None,
            #[cfg(test)]
            looked_up: 0,
            edited: 0,
            drawn: 0,
        }
    }
}

impl Tour {
    /// Number of stops.
    pub fn stops(&self) -> usize {
        self.lessons.len()
    }

    /// Number of the stop, from 0.
    pub fn number(&self) -> usize {
        self.number
    }

    /// Title of the stop.
    pub fn title(&self) -> &'static str {
        self.current().title()
    }

    /// Goes to a stop by its number, from 0; at most to the last.
    pub fn go_to(&mut self, number: usize) {
        self.number = number.min(self.stops() - 1);
        self.arrived = false;
        self.found = None;
    }

    fn current(&self) -> &dyn TourStop {
        self.lessons[self.number].as_ref()
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
        // Dots and buttons.
        let below = if tokens.touch {
            2.0 * (tokens.target() + tokens.space)
        } else {
            8.5 * tokens.space
        };
        let room = (ui.available_height() - below).max(80.0);
        egui::ScrollArea::vertical()
            .id_salt(("tour", self.number))
            .max_height(room)
            .auto_shrink([false, false])
            .show(ui, |ui| self.content(ui, context, room));
        self.navigation(ui, context);
    }

    /// Looks the moment up anew where the run is another, or has grown, or is told in other units.
    fn look_up(&mut self, context: &ViewContext<'_>) {
        let of = RunPart::of(context);
        if self.found.as_ref().is_some_and(|found| found.of == of) {
            return;
        }
        #[cfg(test)]
        {
            self.looked_up += 1;
        }
        let lesson = self.current();
        let moment = context
            .run
            .ok_or("There is no run yet. Open the demo to take the tour over it.")
            .and_then(|run| {
                let moment = lesson.find(run, context.flight, context.units);
                moment.ok_or_else(|| lesson.missing(run).unwrap_or(NOT_YET))
            });
        let numbers = context.run.map(|run| lesson.gather(run));
        self.found = Some(FoundStop {
            of,
            moment,
            numbers: Rc::new(numbers.unwrap_or_default()),
        });
    }

    /// Brings the cursor to the moment and pauses, once per stop.
    fn arrive(&mut self, context: &mut ViewContext<'_>) {
        let Some(FoundStop {
            moment: Ok(moment), ..
        }) = &self.found
        else {
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
        let stops = self.stops();
        let lesson = &mut self.lessons[self.number];
        ui.label(
            RichText::new(format!("LEARN  {} / {stops}", self.number + 1))
                .size(tokens.text_sizes[0])
                .color(tokens.muted),
        );
        ui.label(
            RichText::new(lesson.title())
                .font(tokens.large())
                .color(tokens.text),
        );
        let numbers = self.found.as_ref().map(|found| found.numbers.clone());
        let numbers = numbers.unwrap_or_default();
        let found = self.found.as_ref();
        let moment = match found.map_or(Err(NOT_YET), |found| found.moment.clone()) {
            Ok(moment) => moment,
            Err(text) => {
                ui.label(
                    RichText::new(text)
                        .size(tokens.text_sizes[1])
                        .color(tokens.muted),
                );
                self.take_back(ui, context);
                return;
            }
        };
        ui.label(
            RichText::new(&moment.text)
                .size(tokens.text_sizes[1])
                .color(tokens.text),
        );
        let controls = 9.5 + lesson.control_height();
        // The button below the figure is as high as a finger.
        let higher = tokens.target() - 4.0 * tokens.space;
        let left = room - (ui.cursor().top() - top) - controls * tokens.space - higher;
        figure::place(
            ui,
            context,
            lesson.title(),
            (&moment, &numbers),
            left,
            &|figure| {
                lesson.draw(figure);
            },
        );
        lesson.control(ui);
        let (_, more) = lessons::LINKS[self.number];
        let link = egui::Hyperlink::from_label_and_url(
            "Read the lesson behind this",
            format!("{LESSONS}#{more}"),
        );
        ui.add(link.open_in_new_tab(true));
        let trial = lesson.trial(&moment, &context.mission.navigator);
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
                if trial.plays && !context.playing {
                    context.commands.push(Command::TogglePlay);
                }
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
            for (i, lesson) in self.lessons.iter().enumerate() {
                let name = format!("Stop {} of {}: {}", i + 1, self.stops(), lesson.title());
                let title = lesson.title();
                if dot(ui, context.tokens, &name, title, i.cmp(&self.number)).clicked() {
                    go_to = Some(i);
                }
            }
        });
        ui.horizontal(|ui| {
            let back = ui.add_enabled(self.number > 0, egui::Button::new("Back"));
            let last = self.number + 1 == self.stops();
            let text = RichText::new(if last { "Finish" } else { "Next" }).color(tokens.background);
            let forward = ui.add(egui::Button::new(text).fill(tokens.accent));
            if back.clicked() {
                go_to = Some(self.number.saturating_sub(1));
            }
            next |= forward.clicked();
            if !tokens.touch {
                ui.label(
                    RichText::new("or Page Down")
                        .size(tokens.text_sizes[0])
                        .color(tokens.muted),
                );
            }
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
                    context.commands.push(LearnCommand::Toggle.into());
                }
            });
        });
        if let Some(number) = go_to {
            self.go_to(number);
        }
        if next {
            if self.number + 1 == self.stops() {
                self.go_to(0);
                context.commands.push(LearnCommand::Toggle.into());
            } else {
                self.go_to(self.number + 1);
            }
        }
    }
}

/// Progress dot that leads to a stop, called `name` for those who cannot see it; `order` is where that stop lies beside
/// the one that is shown.
fn dot(ui: &mut Ui, tokens: &Tokens, name: &str, title: &str, order: Ordering) -> egui::Response {
    let size = vec2(2.0 * tokens.space, 2.0 * tokens.space);
    let (rect, response): (Rect, _) = ui.allocate_exact_size(size, Sense::click());
    response.widget_info(|| {
        let is_current = order == Ordering::Equal;
        egui::WidgetInfo::selected(egui::Role::RadioButton, true, is_current, name)
    });
    let color = match order {
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
    response.on_hover_text(title)
}
