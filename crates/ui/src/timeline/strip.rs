//! The strip at the bottom: transport buttons, and time with what happened in it.

use egui::{
    Align2, Color32, Key, Painter, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2,
};

use pilotage_core::navigator::Run;

use super::bins::{Bins, CorrectionCounts};
use super::playback::Playback;
use super::selected::{Span, SpanPointer, TimeOnScreen, paint_span};
use crate::command::Command;
use crate::context::{DrawnTimes, ViewContext};
use crate::shell::icons::Icon;
use crate::shell::{icon_button, icon_toggle};
use crate::still::Still;
use crate::tokens::Tokens;
use crate::units::clock;

/// Data that the strip needs beside what every view is given.
pub struct TimelineExtra<'a> {
    /// State of playback.
    pub playback: &'a Playback,
    /// First and last time of the flight.
    pub span: Option<(f64, f64)>,
    /// Whether the run is complete.
    pub complete: bool,
    /// Generation of the run.
    pub generation: u64,
    /// Bookmarks, seconds.
    pub bookmarks: &'a [f64],
}

/// The strip's own state.
#[derive(Debug, Default)]
pub struct Timeline {
    bins: Bins,
    events: Still<(u64, usize, bool)>,
    track: Option<Rect>,
    span_pointer: SpanPointer,
    drawn: Option<DrawnTimes>,
}

/// A speed as people read it.
pub fn speed_text(speed: f64) -> String {
    if speed >= 1.0 {
        format!("{speed:.0}×")
    } else {
        format!("{speed}×")
    }
}

const CHOICES: [f64; 8] = [0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 20.0];

impl Timeline {
    /// Times that were drawn last.
    pub fn drawn(&self) -> Option<DrawnTimes> {
        self.drawn
    }

    /// Part of the screen on which time was drawn last.
    pub fn track(&self) -> Option<Rect> {
        self.track
    }

    /// Draws the strip.
    pub fn show(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, extra: &TimelineExtra<'_>) {
        let narrow = ui.available_width() < 700.0;
        if narrow {
            ui.vertical(|ui| {
                self.time(ui, context, extra, 40.0);
                ui.horizontal(|ui| transport(ui, context, extra, true));
            });
        } else {
            ui.horizontal_centered(|ui| {
                ui.spacing_mut().item_spacing.x = 0.0;
                transport(ui, context, extra, false);
                ui.add_space(12.0);
                let height = ui.available_height();
                self.time(ui, context, extra, height);
            });
        }
    }

    fn time(
        &mut self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        extra: &TimelineExtra<'_>,
        height: f32,
    ) {
        let size = vec2(ui.available_width(), height);
        let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
        let now = context.time;
        response.widget_info(|| WidgetInfo::slider(true, now, "Time"));
        let tokens = context.tokens;
        let painter = ui.painter_at(rect.expand(2.0));
        let track = rect.shrink2(vec2(8.0, 6.0));
        self.track = Some(track);
        painter.rect_filled(track, tokens.radius, tokens.background);
        let Some(span) = extra.span.filter(|s| s.1 > s.0) else {
            painter.text(
                track.center(),
                Align2::CENTER_CENTER,
                match context.flying {
                    Some(_) => "Computing the flight …",
                    None => "No flight yet. Simulate one, or drop a flight folder here",
                },
                tokens.small(),
                tokens.muted,
            );
            return;
        };
        let scale = TimeScale { span, track };
        if let Some(run) = context.run {
            let width = track.width() as usize;
            self.bins.follow(run, extra.generation, span, width);
            let until = run.span().map_or(span.0, |s| s.1);
            paint_streamed(&painter, &scale, until, extra.complete, tokens);
            let key = (extra.generation, run.steps.len(), tokens.dark);
            let Self { bins, events, .. } = self;
            events.paint(&painter.with_clip_rect(track), key, |shapes| {
                paint_bins(shapes, bins, track, tokens);
            });
        }
        paint_span(&painter, track, &scale, context.selected_span, tokens);
        for mark in extra.bookmarks {
            paint_bookmark(&painter, track, scale.x(*mark), tokens);
        }
        paint_cursor(&painter, track, scale.x(context.time), tokens.accent);
        self.drawn = context.drawn(context.time);
        seek_by_value(ui, response.id, span, context);
        if response.has_focus() {
            crate::shell::paint_focus_ring(&painter, track, tokens);
            keyboard(ui, response.id, context.commands);
        }
        let selected = context.selected_span;
        let selects = (self.span_pointer).follow(ui, context.commands, &response, &scale, selected);
        let pointer = response.interact_pointer_pos().or(response.hover_pos());
        if let Some(pointer) = pointer {
            let time = scale.time(pointer.x);
            if selects {
                let text = span_text(selected, span.0);
                paint_label(&painter, &scale, pointer.x, text, tokens);
            } else if response.dragged() || response.clicked() {
                context.commands.push(Command::SeekTo(time));
            } else {
                paint_hover(&painter, &scale, time, context, tokens);
            }
        }
    }
}

/// Accepted above, refused below, the position's standard deviation as a line behind both.
fn paint_bins(shapes: &mut Vec<Shape>, bins: &Bins, track: Rect, tokens: &Tokens) {
    let (top, bottom) = (track.top() + 3.0, track.bottom() - 3.0);
    let largest = bins.largest().max(1e-3);
    let mut line = Vec::new();
    for (index, bin) in bins.bins().iter().enumerate() {
        if bin.deviation > 0.0 {
            let x = track.left() + index as f32;
            let height = (bottom - top - 14.0) * (bin.deviation / largest).sqrt();
            line.push(pos2(x, bottom - 1.0 - height));
        }
    }
    if line.len() > 1 {
        let color = tokens.muted.gamma_multiply(0.9);
        shapes.push(Shape::line(line, Stroke::new(1.25, color)));
    }
    for (index, bin) in bins.bins().iter().enumerate() {
        let x = track.left() + index as f32 + 0.5;
        if bin.corrections.accepted > 0 {
            let stroke = Stroke::new(1.0, tokens.observed.gamma_multiply(0.85));
            shapes.push(Shape::vline(x, top..=top + 7.0, stroke));
        }
        if bin.corrections.refused > 0 {
            let color = tokens.refused.gamma_multiply(0.85);
            shapes.push(Shape::circle_filled(pos2(x, top + 11.0), 1.2, color));
        }
    }
}

/// The keys of the timeline while it has the keyboard.
fn keyboard(ui: &Ui, widget: egui::Id, commands: &mut Vec<Command>) {
    let filter = egui::EventFilter {
        horizontal_arrows: true,
        ..Default::default()
    };
    ui.memory_mut(|m| m.set_focus_lock_filter(widget, filter));
    ui.input(|i| {
        for (key, sign) in [(Key::ArrowLeft, -1), (Key::ArrowRight, 1)] {
            for _ in 0..i.num_presses(key) {
                commands.push(if i.modifiers.shift {
                    Command::Jump(5.0 * f64::from(sign))
                } else {
                    Command::StepFrames(sign)
                });
            }
        }
        if i.key_pressed(Key::Home) {
            commands.push(Command::GoToStart);
        }
        if i.key_pressed(Key::End) {
            commands.push(Command::GoToEnd);
        }
    });
}

struct TimeScale {
    span: (f64, f64),
    track: Rect,
}

impl TimeScale {
    fn x(&self, time: f64) -> f32 {
        let fraction = (time - self.span.0) / (self.span.1 - self.span.0);
        self.track.left() + self.track.width() * fraction.clamp(0.0, 1.0) as f32
    }

    fn time(&self, x: f32) -> f64 {
        let fraction = f64::from((x - self.track.left()) / self.track.width()).clamp(0.0, 1.0);
        self.span.0 + fraction * (self.span.1 - self.span.0)
    }
}

impl TimeOnScreen for TimeScale {
    fn x_of(&self, time: f64) -> f32 {
        self.x(time)
    }
    fn time_of(&self, x: f32) -> f64 {
        self.time(x)
    }
}

fn paint_streamed(
    painter: &Painter,
    scale: &TimeScale,
    until: f64,
    complete: bool,
    tokens: &Tokens,
) {
    let mut done = scale.track;
    done.set_right(scale.x(until));
    painter.rect_filled(done, tokens.radius, tokens.raised);
    if !complete {
        painter.vline(done.right(), done.y_range(), Stroke::new(1.0, tokens.muted));
    }
}

fn paint_bookmark(painter: &Painter, track: Rect, x: f32, tokens: &Tokens) {
    let flag = vec![
        pos2(x, track.top() - 4.0),
        pos2(x + 8.0, track.top() - 4.0),
        pos2(x + 5.0, track.top()),
        pos2(x + 8.0, track.top() + 4.0),
        pos2(x, track.top() + 4.0),
    ];
    painter.add(Shape::line(flag, Stroke::new(1.25, tokens.accent)));
    let color = tokens.accent.gamma_multiply(0.6);
    painter.vline(x, track.y_range(), Stroke::new(1.0, color));
}

fn paint_cursor(painter: &Painter, track: Rect, x: f32, color: Color32) {
    painter.vline(x, track.y_range().expand(3.0), Stroke::new(1.5, color));
    let head = vec![
        pos2(x - 5.0, track.top() - 5.0),
        pos2(x + 5.0, track.top() - 5.0),
        pos2(x, track.top() + 2.0),
    ];
    painter.add(Shape::convex_polygon(head, color, Stroke::NONE));
}

fn paint_hover(
    painter: &Painter,
    scale: &TimeScale,
    time: f64,
    context: &ViewContext<'_>,
    tokens: &Tokens,
) {
    let x = scale.x(time);
    let faint = Stroke::new(1.0, tokens.muted.gamma_multiply(0.6));
    painter.vline(x, scale.track.y_range(), faint);
    let mut text = clock(time, scale.span.0);
    let step = context.run.and_then(|r| r.step_at(time));
    let flown = context.run.and_then(Run::span);
    if context.flying.is_some() && flown.is_some_and(|span| time > span.1) {
        text = format!("{text}   not flown yet");
    } else if let Some(step) = step.filter(|s| (s.time - time).abs() < 2.0) {
        let radius = context.units.short(step.radius_held());
        text = format!("{text}   within {radius} (95 %)");
        let counts = context.run.and_then(|run| CorrectionCounts::at(run, time));
        if let Some(CorrectionCounts { accepted, refused }) = counts {
            text = format!("{text}   {accepted} accepted, {refused} refused");
        }
    }
    paint_label(painter, scale, x, text, tokens);
}

/// When the selected span begins and ends, and how long it is.
fn span_text(selected: Option<Span>, first: f64) -> String {
    let Some((from, to)) = selected else {
        return "Drag to select a span of time".to_owned();
    };
    let [begin, end] = [from, to].map(|time| clock(time, first));
    format!("{begin} – {end}   {:.1} s", to - from)
}

fn paint_label(painter: &Painter, scale: &TimeScale, x: f32, text: String, tokens: &Tokens) {
    let galley = painter.layout_no_wrap(text, tokens.small(), tokens.text);
    let half = 0.5 * galley.size().x + 6.0;
    let middle = x.clamp(
        scale.track.left() + half,
        (scale.track.right() - half).max(scale.track.left() + half),
    );
    let at = pos2(middle, scale.track.bottom() - 8.0);
    let rect = Rect::from_center_size(at, galley.size() + vec2(12.0, 4.0));
    painter.rect_filled(rect, tokens.radius, tokens.over_map());
    painter.galley(rect.center() - 0.5 * galley.size(), galley, tokens.text);
}

/// Tells screen readers how far the time cursor goes, and goes where they set it.
fn seek_by_value(ui: &Ui, id: egui::Id, span: (f64, f64), context: &mut ViewContext<'_>) {
    use egui::accesskit::Action;
    let since = |time: f64| clock(time, span.0);
    ui.ctx().accesskit_node_builder(id, |node| {
        node.set_min_numeric_value(span.0);
        node.set_max_numeric_value(span.1);
        node.set_value(format!("{} of {}", since(context.time), since(span.1)));
        for action in [Action::SetValue, Action::Increment, Action::Decrement] {
            node.add_action(action);
        }
    });
    ui.input(|input| context.commands.extend(asked(&input.events, id)));
}

/// Moves of the time cursor that a screen reader asked of the widget `id`, in the order in which it did: on a busy machine
/// several come in one frame.
fn asked(events: &[egui::Event], id: egui::Id) -> impl Iterator<Item = Command> + '_ {
    use egui::accesskit::{Action, ActionData};
    events.iter().filter_map(move |event| {
        let egui::Event::AccessKitActionRequest(request) = event else {
            return None;
        };
        let is_own = request.target_node == id.accesskit_id();
        match (request.action, &request.data) {
            _ if !is_own => None,
            (Action::Increment, _) => Some(Command::StepFrames(1)),
            (Action::Decrement, _) => Some(Command::StepFrames(-1)),
            (Action::SetValue, Some(ActionData::NumericValue(time))) => {
                Some(Command::SeekTo(*time))
            }
            _ => None,
        }
    })
}

fn transport(ui: &mut Ui, context: &mut ViewContext<'_>, extra: &TimelineExtra<'_>, narrow: bool) {
    let tokens = context.tokens;
    ui.spacing_mut().item_spacing.x = 0.0;
    if icon_button(ui, tokens, Icon::StepBack, "Previous frame").clicked() {
        context.commands.push(Command::StepFrames(-1));
    }
    let (icon, label) = if extra.playback.playing {
        (Icon::Pause, "Pause")
    } else {
        (Icon::Play, "Play")
    };
    if icon_button(ui, tokens, icon, label).clicked() {
        context.commands.push(Command::TogglePlay);
    }
    if icon_button(ui, tokens, Icon::StepForward, "Next frame").clicked() {
        context.commands.push(Command::StepFrames(1));
    }
    if icon_toggle(
        ui,
        tokens,
        Icon::Loop,
        "Repeat at the end",
        extra.playback.looping,
    )
    .clicked()
    {
        context.commands.push(Command::ToggleLoop);
    }
    let marked = extra
        .bookmarks
        .iter()
        .any(|b| (b - context.time).abs() < 0.05);
    if icon_toggle(ui, tokens, Icon::Bookmark, "Bookmark this time", marked).clicked() {
        context.commands.push(Command::ToggleBookmark);
    }
    speed_menu(ui, context, extra);
    ui.add_space(8.0);
    let first = extra.span.map_or(0.0, |s| s.0);
    let last = extra.span.map_or(0.0, |s| s.1);
    let width = if narrow { 96.0 } else { 132.0 };
    let (rect, response) = ui.allocate_exact_size(vec2(width, 28.0), Sense::hover());
    // Without a flight the cursor may still stand where it stood in the one before.
    let now = extra.span.map_or(first, |_| context.time);
    let (now, total) = (clock(now, first), clock(last, first));
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("{now} of {total}")));
    let end = ui.painter().text(
        rect.right_center(),
        Align2::RIGHT_CENTER,
        format!(" / {total}"),
        tokens.small(),
        tokens.muted,
    );
    ui.painter().text(
        end.left_center(),
        Align2::RIGHT_CENTER,
        now,
        tokens.heading(),
        tokens.text,
    );
}

fn speed_menu(ui: &mut Ui, context: &mut ViewContext<'_>, extra: &TimelineExtra<'_>) {
    let tokens = context.tokens;
    let (rect, response) = ui.allocate_exact_size(vec2(48.0, tokens.target()), Sense::click());
    let text = speed_text(extra.playback.speed);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("Speed {text}")));
    if response.hovered() || response.has_focus() {
        ui.painter()
            .rect_filled(rect.shrink(2.0), tokens.radius, tokens.hover());
    }
    ui.painter().text(
        rect.center(),
        Align2::CENTER_CENTER,
        &text,
        tokens.normal(),
        tokens.text,
    );
    egui::Popup::menu(&response).show(|ui| {
        ui.set_min_width(72.0);
        for speed in CHOICES {
            let chosen = (speed - extra.playback.speed).abs() < 1e-9;
            if ui.selectable_label(chosen, speed_text(speed)).clicked() {
                context.commands.push(Command::SetSpeed(speed));
                ui.close();
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_screen_reader_asks_in_one_frame_is_done_in_its_order() {
        use egui::accesskit::{Action, ActionData, ActionRequest, TreeId};
        let (own, other) = (egui::Id::unique("time"), egui::Id::unique("other"));
        let request = |id: egui::Id, action, data| {
            egui::Event::AccessKitActionRequest(ActionRequest {
                action,
                target_tree: TreeId::ROOT,
                target_node: id.accesskit_id(),
                data,
            })
        };
        let events = [
            request(own, Action::SetValue, Some(ActionData::NumericValue(3.0))),
            request(other, Action::Increment, None),
            request(own, Action::Increment, None),
            request(own, Action::Decrement, None),
            request(own, Action::Focus, None),
        ];
        let commands: Vec<Command> = asked(&events, own).collect();
        assert_eq!(
            commands,
            [
                Command::SeekTo(3.0),
                Command::StepFrames(1),
                Command::StepFrames(-1)
            ]
        );
    }

    #[test]
    fn speeds_are_short() {
        assert_eq!(speed_text(0.25), "0.25×");
        assert_eq!(speed_text(20.0), "20×");
    }
}
