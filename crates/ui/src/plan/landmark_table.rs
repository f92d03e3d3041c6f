//! The table of landmarks: name, size, how often each is found; sorted as the user likes.

use std::cmp::Ordering;

use egui::{Align2, Response, Role, Sense, Ui, WidgetInfo, pos2, vec2};
use pilotage_core::landmark::Landmark;

use super::assessments::{Assessments, assumed};
use crate::command::Command;
use crate::context::ViewContext;
use crate::shell::{icon_button, icons::Icon, landmark_keyboard, paint_focus_ring};
use crate::tokens::Tokens;

/// What the table is sorted by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Column {
    #[default]
    Order,
    Name,
    Size,
    Found,
}

/// How the table is sorted.
#[derive(Debug, Default)]
pub struct LandmarkTable {
    by: Column,
    descending: bool,
}

/// Right edges of the numbers, from the right.
const SIZE: f32 = 76.0;
const FOUND: f32 = 8.0;

impl LandmarkTable {
    /// Draws the table.
    pub fn show(&mut self, ui: &mut Ui, assessments: &Assessments, context: &mut ViewContext<'_>) {
        self.header(ui, context.tokens);
        ui.spacing_mut().item_spacing.y = 0.0;
        let mission = context.mission;
        let mut rows: Vec<&Landmark> = mission.landmarks.iter().collect();
        rows.sort_by(|a, b| self.order(a, b, assessments));
        for landmark in rows {
            row(ui, landmark, assessments, context);
        }
    }

    fn order(&self, a: &Landmark, b: &Landmark, assessments: &Assessments) -> Ordering {
        let area = |l: &Landmark| l.bounds.width() * l.bounds.height();
        let found = |l: &Landmark| assessments.of(l).map(|m| m.last.expected.probability());
        let order = match self.by {
            Column::Order => Ordering::Equal,
            Column::Name => a.name.to_lowercase().cmp(&b.name.to_lowercase()),
            Column::Size => area(a).total_cmp(&area(b)),
            Column::Found => {
                let of = |l| found(l).unwrap_or_else(|| assumed().probability());
                of(a).total_cmp(&of(b))
            }
        };
        if self.descending {
            order.reverse()
        } else {
            order
        }
    }

    fn header(&mut self, ui: &mut Ui, tokens: &Tokens) {
        let width = ui.available_width();
        let (rect, _) = ui.allocate_exact_size(vec2(width, 24.0), Sense::hover());
        let columns = [
            (Column::Name, "Landmark", rect.left()..=rect.left() + 120.0),
            (
                Column::Size,
                "Size",
                rect.right() - 150.0..=rect.right() - SIZE + 8.0,
            ),
            (
                Column::Found,
                "Found",
                rect.right() - SIZE + 8.0..=rect.right(),
            ),
        ];
        for (column, label, x) in columns {
            let cell = egui::Rect::from_x_y_ranges(x, rect.y_range());
            let id = ui.scope_id().with(label);
            let response = ui.interact(cell, id, Sense::click());
            self.title(ui, &response, column, label, tokens);
            if response.clicked() {
                (self.by, self.descending) = match (self.by == column, self.descending) {
                    (false, _) => (column, false),
                    (true, false) => (column, true),
                    (true, true) => (Column::Order, false),
                };
            }
        }
    }

    fn title(&self, ui: &Ui, response: &Response, column: Column, label: &str, tokens: &Tokens) {
        let sorted = self.by == column;
        response.widget_info(|| {
            let name = format!("Sort by {}", label.to_lowercase());
            WidgetInfo::selected(Role::Button, true, sorted, name)
        });
        let text = match (sorted, self.descending) {
            (true, false) => format!("{label} ▲"),
            (true, true) => format!("{label} ▼"),
            _ => label.to_owned(),
        };
        let color = if sorted || response.hovered() || response.has_focus() {
            tokens.text
        } else {
            tokens.muted
        };
        let (at, align) = if column == Column::Name {
            (
                response.rect.left_center() + vec2(8.0, 0.0),
                Align2::LEFT_CENTER,
            )
        } else {
            (
                response.rect.right_center() - vec2(8.0, 0.0),
                Align2::RIGHT_CENTER,
            )
        };
        ui.painter().text(at, align, text, tokens.small(), color);
    }
}

fn row(ui: &mut Ui, landmark: &Landmark, assessments: &Assessments, context: &mut ViewContext<'_>) {
    let tokens = context.tokens;
    let id = landmark.id;
    let selected = context.selection == Some(id);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        let (icon, label) = if landmark.enabled {
            (Icon::Eye, format!("Switch {} off", landmark.name))
        } else {
            (Icon::EyeOff, format!("Switch {} on", landmark.name))
        };
        if icon_button(ui, tokens, icon, &label).clicked() {
            context.commands.push(Command::EnableLandmark {
                id,
                enabled: !landmark.enabled,
            });
        }
        let size = vec2(ui.available_width(), 4.0 * tokens.space);
        let (_, rect) = ui.allocate_space(size);
        let response = ui.interact(rect, egui::Id::unique(("landmark row", id)), Sense::click());
        response.widget_info(|| {
            WidgetInfo::selected(Role::Button, true, selected, landmark.name.as_str())
        });
        let painter = ui.painter();
        if selected || response.hovered() {
            let fill = if selected {
                tokens.accent.gamma_multiply(0.16)
            } else {
                tokens.hover()
            };
            painter.rect_filled(rect.shrink2(vec2(0.0, 1.0)), tokens.radius, fill);
        }
        let color = if landmark.enabled {
            tokens.text
        } else {
            tokens.muted
        };
        let left = rect.left_center() + vec2(8.0, 0.0);
        let room = egui::Rect::from_min_max(rect.min, pos2(rect.right() - 140.0, rect.bottom()));
        let clipped = painter.with_clip_rect(room.intersect(painter.clip_rect()));
        clipped.text(
            left,
            Align2::LEFT_CENTER,
            &landmark.name,
            tokens.normal(),
            color,
        );
        let (factor, unit) = context.units.length();
        let [width, height] = [landmark.bounds.width(), landmark.bounds.height()];
        let text = format!("{:.0} × {:.0} {unit}", width * factor, height * factor);
        let at = pos2(rect.right() - SIZE, rect.center().y);
        painter.text(at, Align2::RIGHT_CENTER, text, tokens.small(), tokens.muted);
        let measured = assessments.of(landmark);
        let under_way = assessments.under_way().filter(|(of, ..)| *of == id);
        let (text, color) = match (under_way, measured) {
            (Some((_, fraction, _)), _) => (format!("{:.0} % …", 100.0 * fraction), tokens.accent),
            (None, Some(m)) => {
                let p = m.last.expected.probability();
                (format!("{:.0} %", 100.0 * p), color)
            }
            (None, None) => {
                let p = assumed().probability();
                (format!("assumed {:.0} %", 100.0 * p), tokens.muted)
            }
        };
        let font = if measured.is_some() {
            tokens.normal()
        } else {
            tokens.small()
        };
        let at = pos2(rect.right() - FOUND, rect.center().y);
        painter.text(at, Align2::RIGHT_CENTER, text, font, color);
        if response.clicked() {
            let which = (!selected).then_some(id);
            context.commands.push(Command::SelectLandmark(which));
        }
        if response.has_focus() {
            paint_focus_ring(painter, rect, tokens);
            landmark_keyboard(ui, response.id, landmark, context.commands);
        }
    });
}
