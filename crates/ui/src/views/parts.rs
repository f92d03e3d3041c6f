//! Small parts that every view draws alike: headings, aligned readings, empty states.

use egui::{Align2, Color32, FontId, Rect, Response, RichText, Sense, Ui, Vec2, vec2};

use crate::context::ViewContext;
use crate::tokens::Tokens;

/// Number for people: its name, value and unit.
pub(crate) struct NumberReadout {
    /// Name of the quantity.
    pub label: String,
    /// Value as text.
    pub value: String,
    /// Standard deviation, in the same unit, if there is one.
    pub deviation: Option<String>,
    /// The unit; empty for pure numbers.
    pub unit: String,
    /// Colour of the value, if it means something.
    pub color: Option<Color32>,
}

impl NumberReadout {
    /// A plain number.
    pub fn new(label: impl Into<String>, value: String, unit: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            value,
            deviation: None,
            unit: unit.into(),
            color: None,
        }
    }

    /// The same with a standard deviation.
    pub fn deviation(mut self, deviation: String) -> Self {
        self.deviation = Some(deviation);
        self
    }

    /// The same in a colour that means something.
    pub fn color(mut self, color: Color32) -> Self {
        self.color = Some(color);
        self
    }
}

/// Small text.
pub(crate) fn small(tokens: &Tokens) -> FontId {
    tokens.small()
}

/// Normal text.
pub(crate) fn normal(tokens: &Tokens) -> FontId {
    tokens.normal()
}

/// Width kept free for units at the right of a column of numbers, points.
fn unit_width(tokens: &Tokens) -> f32 {
    tokens.text_sizes[0] * 2.6
}

/// A row: label at the left, value right-aligned, unit behind it in a lighter tone.
pub(crate) fn reading(ui: &mut Ui, tokens: &Tokens, reading: &NumberReadout) -> Response {
    let height = tokens.text_sizes[1] + 0.75 * tokens.space;
    let (rect, response) =
        ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    let painter = ui.painter();
    let middle = rect.center().y;
    painter.text(
        egui::pos2(rect.left(), middle),
        Align2::LEFT_CENTER,
        &reading.label,
        normal(tokens),
        tokens.muted,
    );
    let unit_left = rect.right() - unit_width(tokens);
    painter.text(
        egui::pos2(unit_left + 0.5 * tokens.space, middle),
        Align2::LEFT_CENTER,
        &reading.unit,
        small(tokens),
        tokens.muted,
    );
    let mut right = unit_left;
    if let Some(deviation) = &reading.deviation {
        let drawn = painter.text(
            egui::pos2(right, middle),
            Align2::RIGHT_CENTER,
            format!("± {deviation}"),
            normal(tokens),
            tokens.muted,
        );
        // One of many digits does not run into the value.
        right -= (tokens.text_sizes[1] * 4.2).max(drawn.width() + 0.5 * tokens.space);
    }
    painter.text(
        egui::pos2(right, middle),
        Align2::RIGHT_CENTER,
        &reading.value,
        normal(tokens),
        reading.color.unwrap_or(tokens.text),
    );
    response.widget_info(|| {
        egui::WidgetInfo::labeled(
            egui::Role::Label,
            true,
            format!("{} {} {}", reading.label, reading.value, reading.unit),
        )
    });
    response
}

/// A sentence in muted colour where there is nothing to draw yet.
pub(crate) fn empty(ui: &mut Ui, tokens: &Tokens, title: &str, hint: &str) {
    ui.vertical_centered(|ui| {
        ui.add_space(ui.available_height().min(160.0) * 0.3);
        ui.label(
            RichText::new(title)
                .size(tokens.text_sizes[1])
                .color(tokens.text),
        );
        ui.add_space(0.5 * tokens.space);
        ui.label(
            RichText::new(hint)
                .size(tokens.text_sizes[0])
                .color(tokens.muted),
        );
    });
}

/// Words in the place of a run that is not there: that it is on its way, or else what it would show.
pub(crate) fn no_run(ui: &mut Ui, context: &ViewContext<'_>, hint: &str) {
    match context.flying {
        Some(words) => empty(ui, context.tokens, "Computing the flight …", words),
        None => empty(ui, context.tokens, "No run yet", hint),
    }
}

/// A heading with a line below, which folds what follows.
pub(crate) fn section<R>(
    ui: &mut Ui,
    tokens: &Tokens,
    title: &str,
    open: bool,
    content: impl FnOnce(&mut Ui) -> R,
) -> Option<R> {
    ui.add_space(0.5 * tokens.space);
    egui::CollapsingHeader::new(
        RichText::new(title)
            .font(tokens.caption())
            .color(tokens.muted),
    )
    .id_salt(title)
    .default_open(open)
    .show_unindented(ui, content)
    .body_returned
}

/// A small button that is on or off.
pub(crate) fn chip(ui: &mut Ui, tokens: &Tokens, on: bool, text: &str, name: &str) -> Response {
    let color = if on { tokens.text } else { tokens.muted };
    let button = egui::Button::new(RichText::new(text).size(tokens.text_sizes[0]).color(color))
        .fill(if on { tokens.raised } else { tokens.surface })
        .stroke(egui::Stroke::new(1.0, tokens.line))
        .corner_radius(tokens.radius)
        .wrap_mode(egui::TextWrapMode::Extend)
        .small()
        .min_size(if tokens.touch {
            egui::Vec2::splat(tokens.target())
        } else {
            egui::Vec2::ZERO
        });
    // Not in a scope of its own: that would not go on to the next row where the row is full.
    let before = ui.spacing().clone();
    let spacing = ui.spacing_mut();
    spacing.button_padding = vec2(0.75 * tokens.space, 0.25 * tokens.space);
    spacing.interact_size.y = if tokens.touch {
        tokens.target()
    } else {
        2.0 * tokens.space
    };
    let response = ui.add(button);
    *ui.spacing_mut() = before;
    response.widget_info(|| {
        egui::WidgetInfo::selected(egui::Role::CheckBox, true, on, name.to_owned())
    });
    response
}

/// A horizontal bar that compares `value` with `limit`: full at twice the limit, a tick at it.
pub(crate) fn gauge(ui: &mut Ui, tokens: &Tokens, value: f64, limit: f64, good_below: bool) {
    let (rect, _) =
        ui.allocate_exact_size(vec2(ui.available_width(), tokens.space), Sense::hover());
    let bar = Rect::from_center_size(rect.center(), vec2(rect.width(), 0.5 * tokens.space));
    let painter = ui.painter();
    painter.rect_filled(bar, 0.25 * tokens.space, tokens.line);
    if limit > 0.0 && value.is_finite() {
        let full = (2.0 * limit).max(if good_below { 0.0 } else { 1.0 });
        let fraction = (value / full).clamp(0.0, 1.0) as f32;
        let good = (value <= limit) == good_below;
        let fill = Rect::from_min_size(bar.min, vec2(bar.width() * fraction, bar.height()));
        painter.rect_filled(
            fill,
            0.25 * tokens.space,
            if good { tokens.truth } else { tokens.refused },
        );
        let tick = bar.left() + bar.width() * (limit / full) as f32;
        painter.vline(tick, rect.y_range(), (1.5, tokens.text));
    }
}

/// Text with a dark pill behind it, so that it reads on a picture. It stands at `position` or, where
/// other text is, as near above, below or to the left of it as there is room; without any room it is
/// left out.
pub(crate) fn tag(
    painter: &egui::Painter,
    tokens: &Tokens,
    position: egui::Pos2,
    text: &str,
    color: Color32,
    taken: &mut Vec<Rect>,
) {
    let galley = painter.layout(
        text.to_owned(),
        small(tokens),
        color,
        22.0 * tokens.text_sizes[0],
    );
    let pad = vec2(0.5 * tokens.space, 0.125 * tokens.space);
    let wanted = Rect::from_min_size(position, galley.size() + 2.0 * pad);
    let clip = painter.clip_rect().shrink(2.0);
    let step = wanted.height() + 1.0;
    let inside = |rect: Rect| {
        let left = (clip.right() - rect.right()).min(0.0);
        let right = (clip.left() - rect.left()).max(0.0);
        rect.translate(vec2(left + right, 0.0))
    };
    let beside = [0.0, -wanted.width() - 2.0 * tokens.space];
    let places = (0..8).flat_map(|n| {
        let rows = 0.5 * n as f32 * step;
        beside.map(|x| [vec2(x, rows), vec2(x, -rows)])
    });
    let free = places
        .flatten()
        .map(|offset| inside(wanted.translate(offset)));
    let Some(rect) = free
        .into_iter()
        .find(|rect| clip.contains_rect(*rect) && taken.iter().all(|t| !t.intersects(*rect)))
    else {
        return;
    };
    painter.rect_filled(rect, 0.5 * tokens.radius, shade(tokens));
    painter.galley(rect.min + pad, galley, color);
    taken.push(rect);
}

/// Colour behind text on a picture.
pub(crate) fn shade(tokens: &Tokens) -> Color32 {
    tokens.background.gamma_multiply(0.8)
}

/// Names a painted area for those who do not see it.
pub(crate) fn name(response: &Response, text: impl Into<String>) {
    let text = text.into();
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, text.clone()));
}

/// The largest rectangle of the shape `size` centred in `outer`.
pub(crate) fn fitted(outer: Rect, size: Vec2) -> Rect {
    let scale = (outer.width() / size.x.max(1e-6)).min(outer.height() / size.y.max(1e-6));
    Rect::from_center_size(outer.center(), size * scale)
}

/// A number with as many decimals as its size deserves (three figures).
pub(crate) fn figures(value: f64) -> String {
    let size = value.abs();
    if !value.is_finite() {
        "–".to_owned()
    } else if size >= 100.0 {
        format!("{value:.0}")
    } else if size >= 10.0 {
        format!("{value:.1}")
    } else if size >= 0.1 {
        format!("{value:.2}")
    } else if size >= 5e-5 {
        format!("{value:.4}")
    } else {
        "0".to_owned()
    }
    .replace('-', "−")
}

/// A diagonal cross, `half` its half-width in points.
pub(crate) fn cross(painter: &egui::Painter, at: egui::Pos2, half: f32, stroke: egui::Stroke) {
    painter.line_segment([at + vec2(-half, -half), at + vec2(half, half)], stroke);
    painter.line_segment([at + vec2(-half, half), at + vec2(half, -half)], stroke);
}

/// A small triangle: to the right where something is folded, down where it is open.
pub(crate) fn arrow(painter: &egui::Painter, at: egui::Pos2, folded: bool, color: Color32) {
    let corners = if folded {
        [vec2(-2.0, -4.0), vec2(3.0, 0.0), vec2(-2.0, 4.0)]
    } else {
        [vec2(-4.0, -2.0), vec2(4.0, -2.0), vec2(0.0, 3.0)]
    };
    let corners = corners.map(|c| at + c).to_vec();
    painter.add(egui::Shape::convex_polygon(
        corners,
        color,
        egui::Stroke::NONE,
    ));
}

/// Colour around light marks on a picture, dark in either theme.
pub(crate) fn rim(tokens: &Tokens) -> Color32 {
    let dark = if tokens.dark {
        tokens.background
    } else {
        tokens.text
    };
    dark.gamma_multiply(0.65)
}

/// Sigma points and expected places on a plain ground: white on dark, dark on light.
pub(crate) fn ink(tokens: &Tokens) -> Color32 {
    if tokens.dark {
        tokens.sigma
    } else {
        tokens.text
    }
}

/// A number for a narrow column: three figures, at most two decimals.
pub(crate) fn brief(value: f64) -> String {
    if value.abs() < 0.1 {
        format!("{value:.2}")
            .replace("-0.00", "0.00")
            .replace('-', "−")
    } else {
        figures(value)
    }
}
