//! From tokens to egui's own style.

use egui::emath::format_with_decimals_in_range;
use egui::epaint::Shadow;
use egui::style::{HandleShape, NumberFormatter, ScrollStyle, WidgetVisuals};
use egui::{Color32, CornerRadius, Margin, Stroke, TextStyle, Theme, vec2};

use crate::tokens::Tokens;
use crate::units::with_minus;

/// Gives every widget of the context the look of `tokens`.
pub fn apply_theme(context: &egui::Context, tokens: &Tokens) {
    let theme = if tokens.dark {
        Theme::Dark
    } else {
        Theme::Light
    };
    context.set_theme(theme);
    context.set_style_of(theme, style(tokens));
}

fn style(tokens: &Tokens) -> egui::Style {
    let mut style = egui::Style {
        text_styles: [
            (TextStyle::Small, tokens.small()),
            (TextStyle::Body, tokens.normal()),
            (TextStyle::Button, tokens.normal()),
            (TextStyle::Heading, tokens.large()),
            (TextStyle::Monospace, tokens.small()),
        ]
        .into(),
        number_formatter: NumberFormatter::new(|number, decimals| {
            with_minus(&format_with_decimals_in_range(number, decimals))
        }),
        animation_time: 0.12,
        explanation_tooltips: false,
        ..egui::Style::default()
    };
    let space = tokens.space;
    style.spacing.item_spacing = vec2(space, space * 0.75);
    style.spacing.button_padding = vec2(space * 1.25, space * 0.625);
    style.spacing.interact_size = if tokens.touch {
        vec2(tokens.target(), tokens.target())
    } else {
        vec2(32.0, 24.0)
    };
    style.spacing.window_margin = Margin::same(16);
    style.spacing.menu_margin = Margin::same(8);
    style.spacing.slider_width = 168.0;
    style.spacing.slider_rail_height = 4.0;
    style.spacing.icon_width = 16.0;
    style.spacing.icon_width_inner = 8.0;
    style.spacing.tooltip_width = 320.0;
    style.spacing.scroll = ScrollStyle::thin();
    style.interaction.tooltip_delay = 0.35;
    style.interaction.selectable_labels = false;
    style.visuals = visuals(tokens);
    style
}

fn visuals(tokens: &Tokens) -> egui::Visuals {
    let mut visuals = if tokens.dark {
        egui::Visuals::dark()
    } else {
        egui::Visuals::light()
    };
    let radius = CornerRadius::same(tokens.radius as u8);
    visuals.panel_fill = tokens.surface;
    visuals.window_fill = tokens.surface;
    visuals.window_stroke = Stroke::new(1.0, tokens.line);
    visuals.window_corner_radius = CornerRadius::same(tokens.radius as u8 + 4);
    visuals.menu_corner_radius = radius;
    visuals.window_shadow = Shadow {
        offset: [0, 12],
        blur: 32,
        spread: 0,
        color: Color32::from_black_alpha(if tokens.dark { 120 } else { 50 }),
    };
    visuals.popup_shadow = Shadow {
        offset: [0, 4],
        blur: 16,
        spread: 0,
        color: Color32::from_black_alpha(if tokens.dark { 110 } else { 40 }),
    };
    visuals.extreme_bg_color = tokens.background;
    visuals.faint_bg_color = tokens.raised;
    visuals.code_bg_color = tokens.raised;
    visuals.weak_text_color = Some(tokens.muted);
    visuals.hyperlink_color = tokens.accent;
    visuals.warn_fg_color = tokens.warning;
    visuals.error_fg_color = tokens.warning;
    visuals.selection.bg_fill = tokens
        .accent
        .gamma_multiply(if tokens.dark { 0.32 } else { 0.24 });
    visuals.selection.stroke = Stroke::new(1.5, tokens.accent);
    visuals.slider_trailing_fill = true;
    visuals.handle_shape = HandleShape::Circle;
    visuals.indent_has_left_vline = false;
    visuals.collapsing_header_frame = false;
    let widget = |fill: Color32, stroke: Color32, text: Color32| WidgetVisuals {
        bg_fill: fill,
        weak_bg_fill: fill,
        bg_stroke: Stroke::new(1.0, stroke),
        corner_radius: radius,
        fg_stroke: Stroke::new(1.25, text),
        expansion: 0.0,
    };
    visuals.widgets.noninteractive = widget(tokens.surface, tokens.line, tokens.text);
    visuals.widgets.inactive = widget(tokens.raised, tokens.line, tokens.text);
    visuals.widgets.hovered = widget(tokens.hover(), tokens.muted, tokens.text);
    visuals.widgets.active = widget(tokens.line, tokens.accent, tokens.text);
    visuals.widgets.open = widget(tokens.hover(), tokens.line, tokens.text);
    visuals
}
