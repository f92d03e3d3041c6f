//! Notices: what happened, to which file, why, and what to do.

use egui::{Align2, Area, Frame, Id, Order, RichText, Stroke, Ui, vec2};

use super::icons::Icon;
use super::widgets::icon_button;
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
    /// Whether all of its text was asked for.
    is_open: bool,
}

impl Toast {
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

/// The notices on screen, the oldest first.
#[derive(Clone, Debug, Default)]
pub struct Toasts {
    list: Vec<Toast>,
    said: Vec<Toast>,
}

const LIFETIME: f64 = 9_000.0;
const MOST: usize = 4;
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
        self.list.retain(|t| t.title != title || t.text != text);
        if self.list.len() >= MOST {
            self.list.remove(0);
        }
        let toast = Toast {
            title,
            text,
            trouble,
            born,
            is_open: false,
        };
        if self.said.len() >= MOST_SAID {
            self.said.remove(0);
        }
        self.said.push(toast.clone());
        self.list.push(toast);
    }

    /// Notices that were said since the page was opened, the last first.
    pub fn said(&self) -> impl ExactSizeIterator<Item = &Toast> {
        self.said.iter().rev()
    }

    /// Notices on screen.
    pub fn list(&self) -> &[Toast] {
        &self.list
    }

    /// Draws the notices above everything, at the bottom right over `bottom` points.
    pub fn show(&mut self, ui: &mut Ui, tokens: &Tokens, now: f64, bottom: f32) {
        self.list.retain(|t| t.trouble || now - t.born < LIFETIME);
        if self.list.is_empty() {
            return;
        }
        let mut dismissed = None;
        Area::new(Id::unique("toasts"))
            .order(Order::Foreground)
            .anchor(Align2::RIGHT_BOTTOM, vec2(-16.0, -bottom))
            .show(ui.ctx(), |ui| {
                ui.spacing_mut().item_spacing.y = tokens.space;
                for (index, toast) in self.list.iter_mut().enumerate() {
                    if toast_ui(ui, tokens, toast, now) {
                        dismissed = Some(index);
                    }
                }
            });
        if let Some(index) = dismissed {
            self.list.remove(index);
        }
        if self.list.iter().any(|t| now - t.born < LIFETIME) {
            ui.ctx()
                .request_repaint_after(std::time::Duration::from_millis(500));
        }
    }
}

fn toast_ui(ui: &mut Ui, tokens: &Tokens, toast: &mut Toast, now: f64) -> bool {
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
                    ui.set_width(320.0_f32.min(ui.ctx().content_rect().width() - 120.0));
                    ui.spacing_mut().item_spacing.y = 4.0;
                    let title = RichText::new(&toast.title).font(tokens.heading());
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
        assert_eq!(toasts.list().len(), MOST);
        let said: Vec<_> = toasts.said().collect();
        assert_eq!(said.len(), MOST_SAID);
        assert_eq!(said[0].title, format!("Note {}", MOST_SAID + 4));
    }
}
