//! Small widgets that give the app its own face.

use egui::{
    Align, Align2, Color32, CornerRadius, FontId, FontSelection, Key, Layout, Response, RichText,
    Role, Sense, Stroke, StrokeKind, Ui, UiBuilder, WidgetInfo, vec2,
};

use super::icons::Icon;
use crate::tokens::Tokens;

/// A square button with an icon; `label` is its accessible name and its hint.
pub fn icon_button(ui: &mut Ui, tokens: &Tokens, icon: Icon, label: &str) -> Response {
    icon_face(ui, tokens, icon, label, None)
}

/// A square button with an icon that shows whether something is on.
pub fn icon_toggle(ui: &mut Ui, tokens: &Tokens, icon: Icon, label: &str, on: bool) -> Response {
    icon_face(ui, tokens, icon, label, Some(on))
}

/// A square button; `on` is `None` for one that is pressed but never stays so.
fn icon_face(ui: &mut Ui, tokens: &Tokens, icon: Icon, label: &str, on: Option<bool>) -> Response {
    let side = tokens.target();
    let (rect, response) = ui.allocate_exact_size(vec2(side, side), Sense::click());
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo {
        selected: on,
        ..WidgetInfo::labeled(Role::Button, enabled, label)
    });
    if response.gained_focus() {
        response.scroll_to_me(None);
    }
    let on = on.unwrap_or_default();
    if ui.is_rect_visible(rect) {
        let fill = if on {
            tokens.accent.gamma_multiply(0.22)
        } else if response.hovered() || response.has_focus() {
            tokens.hover()
        } else {
            Color32::TRANSPARENT
        };
        let painter = ui.painter();
        let inner = rect.shrink(2.0);
        painter.rect_filled(inner, tokens.radius, fill);
        if response.has_focus() {
            painter.rect_stroke(
                inner,
                tokens.radius,
                Stroke::new(1.5, tokens.accent),
                StrokeKind::Inside,
            );
        }
        let color = match (enabled, on) {
            (false, _) => tokens.muted.gamma_multiply(0.5),
            (_, true) => tokens.accent,
            _ => tokens.text,
        };
        icon.paint(painter, rect, color);
    }
    response.on_hover_text(label)
}

/// Draws the work under way, and a button that stops it; whether that was pressed.
pub fn at_work(ui: &mut Ui, tokens: &Tokens, words: &str) -> bool {
    let row = ui.horizontal(|ui| {
        ui.add(egui::Spinner::new().size(14.0));
        ui.label(RichText::new(words).color(tokens.accent));
        text_button(ui, tokens, None, "Stop", false).clicked()
    });
    row.inner
}

/// A button with an icon and words; `strong` for the one that matters most.
pub fn text_button(
    ui: &mut Ui,
    tokens: &Tokens,
    icon: Option<Icon>,
    label: &str,
    strong: bool,
) -> Response {
    let font = tokens.normal();
    let ink = if strong {
        if tokens.dark {
            tokens.background
        } else {
            Color32::WHITE
        }
    } else {
        tokens.text
    };
    let galley = ui.painter().layout_no_wrap(label.to_owned(), font, ink);
    let icon_width = if icon.is_some() { 24.0 } else { 0.0 };
    let size = vec2(
        galley.size().x + icon_width + 3.0 * tokens.space,
        tokens.target(),
    );
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, label));
    if ui.is_rect_visible(rect) {
        let inner = rect.shrink2(vec2(0.0, 2.0));
        let fill = match (strong, response.hovered() || response.has_focus()) {
            (true, false) => tokens.accent,
            (true, true) => tokens.accent.gamma_multiply(0.85),
            (false, false) => tokens.raised,
            (false, true) => tokens.hover(),
        };
        let painter = ui.painter();
        painter.rect_filled(inner, tokens.radius, fill);
        let edge = if response.has_focus() {
            Stroke::new(1.5, tokens.accent)
        } else if strong {
            Stroke::NONE
        } else {
            Stroke::new(1.0, tokens.line)
        };
        painter.rect_stroke(inner, tokens.radius, edge, StrokeKind::Inside);
        let mut x = inner.left() + 1.5 * tokens.space;
        if let Some(icon) = icon {
            let middle = egui::pos2(x + 8.0, inner.center().y);
            icon.paint_sized(painter, middle, 16.0, ink);
            x += icon_width;
        }
        let corner = egui::pos2(x, inner.center().y - 0.5 * galley.size().y);
        painter.galley(corner, galley, ink);
    }
    response
}

/// A tab: words with a line of the accent colour below when chosen.
pub fn tab(ui: &mut Ui, tokens: &Tokens, label: &str, chosen: bool, height: f32) -> Response {
    tab_in(ui, tokens, (label, tokens.normal()), chosen, height)
}

/// Tabs of a column, which are set smaller where they would take more than a row, and take several where that is not
/// enough; the one that was clicked.
pub fn column_tabs(
    ui: &mut Ui,
    tokens: &Tokens,
    labels: &[&str],
    chosen: Option<usize>,
) -> Option<usize> {
    let width_of = |label: &&str| {
        let galley = ui
            .painter()
            .layout_no_wrap((*label).to_owned(), tokens.normal(), tokens.text);
        galley.size().x + 2.0 * tokens.space
    };
    let fits = labels.iter().map(width_of).sum::<f32>() <= ui.available_width();
    let font = if fits {
        tokens.normal()
    } else {
        tokens.small()
    };
    let row = ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(0.0, 0.0);
        let mut clicked = None;
        for (index, label) in labels.iter().enumerate() {
            let label = (*label, font.clone());
            if tab_in(ui, tokens, label, chosen == Some(index), 32.0).clicked() {
                clicked = Some(index);
            }
        }
        clicked
    });
    row.inner
}

pub(super) fn tab_in(
    ui: &mut Ui,
    tokens: &Tokens,
    (label, font): (&str, FontId),
    chosen: bool,
    height: f32,
) -> Response {
    let is_small = font.size < tokens.text_sizes[1];
    let color = if chosen { tokens.text } else { tokens.muted };
    let galley = ui.painter().layout_no_wrap(label.to_owned(), font, color);
    let padding = if is_small { 1.25 } else { 2.0 } * tokens.space;
    let height = if tokens.touch {
        height.max(tokens.target())
    } else {
        height
    };
    let size = vec2(galley.size().x + padding, height);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::Tab, true, chosen, label));
    if ui.is_rect_visible(rect) {
        let painter = ui.painter();
        if response.hovered() || response.has_focus() {
            let inner = rect.shrink2(vec2(0.0, 0.15 * height));
            painter.rect_filled(inner, tokens.radius, tokens.hover());
        }
        if chosen {
            let mut line = rect.shrink2(vec2(tokens.space, 0.0));
            line.set_top(line.bottom() - 2.0);
            painter.rect_filled(line, CornerRadius::same(1), tokens.accent);
        }
        painter.galley(rect.center() - 0.5 * galley.size(), galley, color);
    }
    response
}

/// A value with its unit in a lighter tone, right-aligned in `width` points.
pub fn reading(ui: &mut Ui, tokens: &Tokens, value: &str, unit: &str, width: f32) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(width, 20.0), Sense::hover());
    let painter = ui.painter();
    let unit_rect = painter.text(
        rect.right_center(),
        Align2::RIGHT_CENTER,
        unit,
        tokens.small(),
        tokens.muted,
    );
    let gap = if unit.is_empty() { 0.0 } else { 4.0 };
    painter.text(
        egui::pos2(unit_rect.left() - gap, rect.center().y),
        Align2::RIGHT_CENTER,
        value,
        tokens.normal(),
        tokens.text,
    );
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("{value} {unit}")));
    response
}

/// A small rounded label on a fill.
pub fn chip(ui: &mut Ui, tokens: &Tokens, text: &str, color: Color32) -> Response {
    let galley = ui
        .painter()
        .layout_no_wrap(text.to_owned(), tokens.small(), color);
    let size = galley.size() + vec2(2.0 * tokens.space, 6.0);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let painter = ui.painter();
    painter.rect_filled(rect, 0.5 * size.y, color.gamma_multiply(0.16));
    painter.galley(rect.center() - 0.5 * galley.size(), galley, color);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, text));
    response
}

/// Whether Enter was pressed in a field of one line, be it in the very frame in which that got the keyboard.
pub fn is_entered(field: &Response) -> bool {
    let has_keyboard = field.lost_focus() || field.has_focus();
    has_keyboard && field.ctx.input(|i| i.key_pressed(Key::Enter))
}

/// Words in the small size and the lighter tone.
pub fn muted(tokens: &Tokens, text: impl Into<String>) -> RichText {
    RichText::new(text).font(tokens.small()).color(tokens.muted)
}

/// A caption above something: small capitals' part.
pub fn caption(ui: &mut Ui, tokens: &Tokens, text: &str) {
    let text = muted(tokens, text.to_uppercase()).font(tokens.caption());
    ui.label(text.extra_letter_spacing(0.6));
}

/// A heading inside a panel.
pub fn heading(ui: &mut Ui, tokens: &Tokens, text: &str) {
    ui.label(
        RichText::new(text)
            .font(tokens.heading())
            .color(tokens.text),
    );
}

/// Draws what stands at the right end of a row, and what is `before` it in the room that is left, both from the left to
/// the right: that is the order in which Tab goes through them, too.
pub fn at_right(ui: &mut Ui, before: impl FnOnce(&mut Ui), add: impl FnOnce(&mut Ui)) {
    let id = ui.unique_id().with("at right");
    let room = ui.available_rect_before_wrap();
    let width: f32 = ui.data(|data| data.get_temp(id)).unwrap_or(room.width());
    let [mut left, mut right] = [room; 2];
    right.min.x = room.right() - width;
    left.max.x = right.left().max(room.left());
    let row = Layout::left_to_right(Align::Center);
    // What does not fit yet must not widen the panel that it is in.
    before(&mut ui.new_child(UiBuilder::new().max_rect(left).layout(row)));
    let mut at_right = ui.new_child(UiBuilder::new().max_rect(right).layout(row));
    add(&mut at_right);
    let shown = at_right.min_rect();
    ui.allocate_rect(shown.intersect(room), Sense::hover());
    let shown = shown.width();
    if (shown - width).abs() > 0.5 {
        ui.data_mut(|data| data.insert_temp(id, shown));
        ui.ctx()
            .request_discard("the width of what stands at the right");
    }
}

/// The title of a dialog, with a button that closes it; true when that was pressed.
pub fn title(ui: &mut Ui, tokens: &Tokens, text: &str) -> bool {
    ui.horizontal(|ui| {
        let text =
            RichText::new(text).font(FontSelection::from(tokens.large()).resolve(ui.style()));
        ui.label(text.color(tokens.text));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            icon_button(ui, tokens, Icon::Close, "Close").clicked()
        })
        .inner
    })
    .inner
}

/// Background of a row of a list that can be selected: nothing unless it is, or the pointer is over it.
pub fn paint_row(
    painter: &egui::Painter,
    rect: egui::Rect,
    tokens: &Tokens,
    is_selected: bool,
    is_hovered: bool,
) {
    let fill = match (is_selected, is_hovered) {
        (true, _) => tokens.accent.gamma_multiply(0.16),
        (false, true) => tokens.hover(),
        (false, false) => return,
    };
    painter.rect_filled(rect.shrink2(egui::vec2(0.0, 1.0)), tokens.radius, fill);
}

/// An outline that shows where the keyboard is.
pub fn paint_focus_ring(painter: &egui::Painter, rect: egui::Rect, tokens: &Tokens) {
    let stroke = Stroke::new(1.5, tokens.accent);
    painter.rect_stroke(rect, tokens.radius, stroke, StrokeKind::Inside);
}
