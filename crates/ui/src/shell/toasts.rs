//! Notices: what happened, to which file, why, and what to do.

use egui::{Align2, Area, Frame, Id, Order, Rect, RichText, Stroke, Ui, Vec2, vec2};

use super::icons::Icon;
use super::widgets::{icon_button, text_button};
use crate::tokens::Tokens;

/// A notice.
#[derive(Clone, Debug, PartialEq)]
pub struct Toast {
    /// Event in a few words.
    pub title: String,
    /// Place and cause of the event, and what to do.
    pub text: String,
    /// Whether something went wrong (its title then stays until dismissed).
    pub trouble: bool,
    /// When it was said, milliseconds of the host's clock.
    pub born: f64,
    /// Times it was said.
    pub times: usize,
    /// Whether all of its text was asked for.
    is_open: bool,
}

impl Toast {
    /// Its title, with the number of times it was said where it was more than once.
    pub fn heading(&self) -> String {
        match self.times {
            1 => self.title.clone(),
            times => format!("{} ({times} times)", self.title),
        }
    }

    fn is_same(&self, other: &Self) -> bool {
        self.title == other.title && self.text == other.text
    }

    /// The part of its text that is shown at `now`: of a long one the first sentence, of trouble that has been read
    /// for a while nothing.
    fn shown_text(&self, now: f64) -> &str {
        if self.is_open {
            return &self.text;
        }
        if self.trouble && now - self.born > LIFETIME {
            return "";
        }
        match self.text.find(". ") {
            Some(end) if self.text.len() > LONGEST => &self.text[..=end],
            _ => &self.text,
        }
    }
}

/// The notices that were neither dismissed nor are over, the oldest first; the newest of them are on screen.
#[derive(Clone, Debug, Default)]
pub struct Toasts {
    list: Vec<Toast>,
    said: Vec<Toast>,
}

const LIFETIME: f64 = 9_000.0;
/// Notices on screen at a time, where there is room.
const MOST: usize = 3;
/// Height that a notice is given of the room, points.
const ROOM_OF_ONE: f32 = 130.0;
/// Distance from the lower edge of the room, points.
const MARGIN: Vec2 = vec2(0.0, 16.0);
/// Length of a text that is shown whole at once, bytes.
const LONGEST: usize = 220;
/// Notices that can be read again.
const MOST_SAID: usize = 60;

impl Toasts {
    /// Says that something went wrong. The same notice twice stands once.
    pub fn trouble(&mut self, now: f64, title: impl Into<String>, text: impl Into<String>) {
        self.push(now, title.into(), text.into(), true);
    }

    /// Says that something was done.
    pub fn note(&mut self, now: f64, title: impl Into<String>, text: impl Into<String>) {
        self.push(now, title.into(), text.into(), false);
    }

    fn push(&mut self, born: f64, title: String, text: String, trouble: bool) {
        let mut toast = Toast {
            title,
            text,
            trouble,
            born,
            times: 1,
            is_open: false,
        };
        if let Some(place) = self.said.iter().position(|said| said.is_same(&toast)) {
            toast.times += self.said.remove(place).times;
        }
        self.list.retain(|said| !said.is_same(&toast));
        for list in [&mut self.list, &mut self.said] {
            if list.len() >= MOST_SAID {
                list.remove(0);
            }
            list.push(toast.clone());
        }
    }

    /// Takes trouble off the screen, as something else was opened; it can still be read again.
    pub fn withdraw_trouble(&mut self) {
        self.list.retain(|said| !said.trouble);
    }

    /// Takes what was told of earlier files off the screen, as others were opened; it can still be read again.
    pub fn withdraw_notes(&mut self) {
        self.list.retain(|said| said.trouble);
    }

    /// Notices that were said since the page was opened, the last first.
    pub fn said(&self) -> impl ExactSizeIterator<Item = &Toast> {
        self.said.iter().rev()
    }

    /// Notices that were neither dismissed nor are over, the oldest first.
    pub fn list(&self) -> &[Toast] {
        &self.list
    }

    /// Draws the newest notices at the middle of the lower edge of `room`, between what a map has in its corners, the
    /// newest first, and the number of the rest; true when those are asked for.
    #[must_use]
    pub fn show(&mut self, ui: &mut Ui, tokens: &Tokens, now: f64, room: Rect) -> bool {
        self.list.retain(|t| t.trouble || now - t.born < LIFETIME);
        if self.list.is_empty() {
            return false;
        }
        let mut dismissed = None;
        let mut is_rest_asked_for = false;
        let most = ((room.height() / ROOM_OF_ONE) as usize).clamp(1, MOST);
        let rest = self.list.len().saturating_sub(most);
        let width = (room.width() - 120.0).clamp(160.0, 320.0);
        Area::new(Id::unique("toasts"))
            .order(Order::Foreground)
            .pivot(Align2::CENTER_BOTTOM)
            .fixed_pos(room.center_bottom() - MARGIN)
            .show(ui.ctx(), |ui| {
                ui.spacing_mut().item_spacing.y = tokens.space;
                for (index, toast) in self.list.iter_mut().enumerate().skip(rest).rev() {
                    if toast_ui(ui, tokens, toast, (now, width)) {
                        dismissed = Some(index);
                    }
                }
                if rest > 0 {
                    let words = format!("and {rest} more");
                    let frame = Frame::new()
                        .fill(tokens.raised)
                        .corner_radius(tokens.radius);
                    let draw = |ui: &mut Ui| text_button(ui, tokens, None, &words, false).clicked();
                    is_rest_asked_for = frame.show(ui, draw).inner;
                }
            });
        if let Some(index) = dismissed {
            self.list.remove(index);
        }
        // Whoever reads the list has the rest there.
        if is_rest_asked_for {
            self.list.drain(..rest);
        }
        if self.list.iter().any(|t| now - t.born < LIFETIME) {
            ui.ctx()
                .request_repaint_after(std::time::Duration::from_millis(500));
        }
        is_rest_asked_for
    }
}

fn toast_ui(ui: &mut Ui, tokens: &Tokens, toast: &mut Toast, (now, width): (f64, f32)) -> bool {
    let tone = if toast.trouble {
        tokens.warning
    } else {
        tokens.truth
    };
    Frame::new()
        .fill(tokens.raised)
        .stroke(Stroke::new(1.0, tone.gamma_multiply(0.6)))
        .corner_radius(tokens.radius)
        .inner_margin(12)
        .shadow(ui.visuals().popup_shadow)
        .show(ui, |ui| {
            ui.horizontal_top(|ui| {
                let (rect, _) = ui.allocate_exact_size(vec2(16.0, 20.0), egui::Sense::hover());
                let icon = if toast.trouble {
                    Icon::Warning
                } else {
                    Icon::Info
                };
                icon.paint(ui.painter(), rect, tone);
                ui.vertical(|ui| {
                    ui.set_width(width);
                    ui.spacing_mut().item_spacing.y = 4.0;
                    let title = RichText::new(toast.heading()).font(tokens.heading());
                    ui.label(title.color(tokens.text));
                    let shown = toast.shown_text(now);
                    if !shown.is_empty() {
                        ui.label(RichText::new(shown).color(tokens.muted));
                    }
                    if shown.len() < toast.text.len() && ui.link("Details").clicked() {
                        toast.is_open = true;
                    }
                });
                icon_button(ui, tokens, Icon::Close, "Dismiss notice").clicked()
            })
            .inner
        })
        .inner
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui_kittest::kittest::Queryable;

    #[test]
    fn long_texts_are_shown_by_their_first_sentence_and_old_trouble_by_its_title() {
        let mut toasts = Toasts::default();
        let text = format!("It is no log. Read are: {}", "logs, ".repeat(60));
        toasts.trouble(0.0, "a.xyz was not opened", text.clone());
        let toast = &mut toasts.list[0];
        assert_eq!(toast.shown_text(100.0), "It is no log.");
        assert_eq!(toast.shown_text(LIFETIME + 1.0), "");
        toast.is_open = true;
        assert_eq!(toast.shown_text(LIFETIME + 1.0), text);
    }

    #[test]
    fn what_was_said_can_be_read_again_up_to_a_bound() {
        let mut toasts = Toasts::default();
        for i in 0..MOST_SAID + 5 {
            toasts.note(i as f64, format!("Note {i}"), "");
        }
        let said: Vec<_> = toasts.said().collect();
        assert_eq!(said.len(), MOST_SAID);
        assert_eq!(said[0].title, format!("Note {}", MOST_SAID + 4));
    }

    #[test]
    fn trouble_that_is_withdrawn_can_be_read_again_and_notes_stay() {
        let mut toasts = Toasts::default();
        toasts.note(0.0, "A note", "");
        toasts.trouble(0.0, "There is no map", "Open one.");
        let titles = |toasts: &Toasts| -> Vec<String> {
            toasts
                .list()
                .iter()
                .map(|said| said.title.clone())
                .collect()
        };
        let mut without_notes = toasts.clone();
        without_notes.withdraw_notes();
        assert_eq!(titles(&without_notes), ["There is no map"]);
        assert_eq!(without_notes.said().len(), 2);
        toasts.withdraw_trouble();
        assert_eq!(titles(&toasts), ["A note"]);
        assert_eq!(toasts.said().len(), 2);
    }

    #[test]
    fn a_notice_said_again_stands_once_with_a_count() {
        let mut toasts = Toasts::default();
        for now in 0..3 {
            toasts.trouble(f64::from(now), "a.csv was not opened", "It is empty.");
            toasts.note(f64::from(now), format!("Note {now}"), "");
        }
        toasts.trouble(3.0, "a.csv was not opened", "It is no log.");
        let headings = |list: &[Toast]| list.iter().map(Toast::heading).collect::<Vec<_>>();
        let all = [
            "Note 0",
            "Note 1",
            "a.csv was not opened (3 times)",
            "Note 2",
            "a.csv was not opened",
        ];
        assert_eq!(headings(toasts.list()), all);
        assert_eq!(headings(&toasts.said), all);
    }

    #[test]
    fn the_newest_three_are_on_screen_above_the_number_of_the_rest_which_opens_their_list() {
        let asked = std::rc::Rc::new(std::cell::Cell::new(false));
        let is_asked = asked.clone();
        let mut toasts = Toasts::default();
        for i in 0..7 {
            toasts.trouble(f64::from(i), format!("Trouble {i}"), "");
        }
        let mut harness = egui_kittest::Harness::new_ui(move |ui| {
            if toasts.show(ui, &Tokens::dark(), 10.0, ui.max_rect()) {
                is_asked.set(true);
            }
        });
        harness.run_steps(3);
        let top = |name: &str| harness.query_by_label(name).map(|node| node.rect().top());
        assert!(top("Trouble 6") < top("Trouble 5") && top("Trouble 5") < top("Trouble 4"));
        assert!(top("Trouble 6").is_some() && top("Trouble 3").is_none());
        harness.get_by_label("and 4 more").click();
        harness.run_steps(3);
        assert!(asked.get());
        assert!(harness.query_by_label("and 4 more").is_none());
    }
}
