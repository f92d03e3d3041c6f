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
    /// Whether something went wrong (it then stays until dismissed).
    pub trouble: bool,
    born: f64,
}

/// The notices on screen, the oldest first.
#[derive(Clone, Debug, Default)]
pub struct Toasts {
    list: Vec<Toast>,
}

const LIFETIME: f64 = 9_000.0;
const MOST: usize = 4;

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
        self.list.push(Toast {
            title,
            text,
            trouble,
            born,
        });
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
                for (index, toast) in self.list.iter().enumerate() {
                    if toast_ui(ui, tokens, toast) {
                        dismissed = Some(index);
                    }
                }
            });
        if let Some(index) = dismissed {
            self.list.remove(index);
        }
        if self.list.iter().any(|t| !t.trouble) {
            ui.ctx()
                .request_repaint_after(std::time::Duration::from_millis(500));
        }
    }
}

fn toast_ui(ui: &mut Ui, tokens: &Tokens, toast: &Toast) -> bool {
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
                    Icon::Help
                };
                icon.paint(ui.painter(), rect, tone);
                ui.vertical(|ui| {
                    ui.set_width(320.0_f32.min(ui.ctx().content_rect().width() - 120.0));
                    ui.spacing_mut().item_spacing.y = 4.0;
                    ui.label(RichText::new(&toast.title).strong().color(tokens.text));
                    ui.label(RichText::new(&toast.text).color(tokens.muted));
                });
                icon_button(ui, tokens, Icon::Close, "Dismiss notice").clicked()
            })
            .inner
        })
        .inner
}
