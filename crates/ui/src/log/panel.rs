//! One panel: fields over time or against another field, their values at the cursor, the modes behind them.

use egui::{Align2, Color32, Painter, Rect, Response, Sense, Shape, Stroke, Ui, vec2};

use super::against::{AgainstPlot, AgainstScene};
use super::against_menu::AgainstMenu;
use super::arrangement::PanelContent;
use super::words::series_name;
use super::{LogCommand, OpenLog, PlottedSeries};
use crate::context::ViewContext;
use crate::jobs::SeriesName;
use crate::still::Still;
use crate::timeline::paint_span;
use crate::tokens::Tokens;
use crate::views::chart::Axes;
use crate::views::{Curve, TimeAxis, curve_line, parts};

/// Share of its height that a panel leaves free above and below its curves.
pub(super) const MARGIN: f64 = 0.06;

/// What the curves of a panel depend on.
#[derive(Clone, Debug, PartialEq)]
struct CurvesKey {
    revision: u64,
    axes: Axes,
    fields: Vec<SeriesName>,
    dark: bool,
}

/// A panel and the fields that it shows.
pub(super) struct LogPanel {
    pub content: PanelContent,
    curves: Still<CurvesKey>,
    against: AgainstPlot,
    menu: AgainstMenu,
}

/// What a pointer over a panel does.
pub(super) struct PanelResponse {
    /// Of the area with the curves.
    pub response: Response,
    /// Time of the point under the pointer, in a panel against a field.
    pub hover: Option<f64>,
}

/// What a panel is drawn from.
pub(super) struct PanelScene<'a> {
    pub log: &'a OpenLog,
    pub number: usize,
    pub is_active: bool,
    /// Height of the heading and of the curves, points.
    pub size: (f32, f32),
    pub span: (f64, f64),
    pub hover: Option<f64>,
    pub modes: &'a [(f64, f64, String)],
}

/// The stretches of time in which a mode lasted, with its name.
pub(super) fn mode_bands(log: &OpenLog, whole: (f64, f64)) -> Vec<(f64, f64, String)> {
    let modes = log.outline.as_ref().map_or(&[][..], |o| &o.modes);
    let ends = modes.iter().skip(1).map(|m| m.time).chain([whole.1]);
    let bands = modes.iter().zip(ends);
    bands
        .map(|(mode, end)| (mode.time, end, mode.mode.clone()))
        .collect()
}

/// Colours of the fields of a panel, in order, over and over.
pub(crate) fn colour(tokens: &Tokens, index: usize) -> Color32 {
    let colours = [
        tokens.dead_reckoning,
        tokens.accent,
        tokens.truth,
        tokens.corrected,
        tokens.unaided,
        tokens.observed,
    ];
    colours[index % colours.len()]
}

/// Where curves lie in a panel, and their times; the values are not known yet.
pub(super) fn axes(response: &Response, tokens: &Tokens, span: (f64, f64)) -> Axes {
    Axes {
        rect: TimeAxis::curves_rect(response.rect, tokens),
        x: span,
        y: (0.0, 1.0),
        log: false,
    }
}

pub(super) fn curve(series: &PlottedSeries) -> Curve<'_> {
    Curve {
        times: &series.times,
        values: series.values(),
        factor: 1.0,
    }
}

/// Least and greatest value that are to be seen over `axes`' time, with room above and below; `None` if there is
/// none.
pub(super) fn y_range<'a>(
    series: impl Iterator<Item = &'a PlottedSeries>,
    axes: &Axes,
) -> Option<(f64, f64)> {
    let extents = series.filter_map(|series| {
        let (low, high) = curve(series).extent(axes)?;
        Some((low + series.base, high + series.base))
    });
    let (low, high) = extents.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))?;
    Some(wider(low, high))
}

/// A range of values with room around it.
pub(super) fn wider(low: f64, high: f64) -> (f64, f64) {
    let margin = (MARGIN * (high - low)).max(1e-9 * high.abs()).max(1e-12);
    (low - margin, high + margin)
}

impl LogPanel {
    pub fn of(content: PanelContent) -> Self {
        Self {
            content,
            curves: Still::default(),
            against: AgainstPlot::default(),
            menu: AgainstMenu::default(),
        }
    }

    /// Draws the panel; what was asked of it is added to `asked`.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        scene: &PanelScene<'_>,
        asked: &mut Vec<LogCommand>,
    ) -> PanelResponse {
        let tokens = context.tokens;
        self.heading(ui, context, scene, asked);
        let size = vec2(ui.available_width(), scene.size.1);
        let (outer, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
        let names: Vec<String> = self.content.fields.iter().map(series_name).collect();
        let against = self.content.against.as_ref().map(series_name);
        let against = against.map_or(String::new(), |name| format!(" against {name}"));
        parts::name(&response, format!("Plot of {}{against}", names.join(", ")));
        let painter = ui.painter_at(outer);
        let hover = if let Some(against) = &self.content.against {
            let against = AgainstScene {
                panel: scene,
                fields: &self.content.fields,
                against,
                joined: self.content.joined,
            };
            self.against.show(&painter, context, &against, &response)
        } else {
            self.over_time(&painter, context, scene, &response);
            None
        };
        if scene.is_active {
            painter.vline(
                outer.left() + 1.0,
                outer.y_range(),
                Stroke::new(2.0, tokens.accent),
            );
        }
        PanelResponse { response, hover }
    }

    /// The curves over time, with the modes, the selected span and the cursor.
    fn over_time(
        &mut self,
        painter: &Painter,
        context: &ViewContext<'_>,
        scene: &PanelScene<'_>,
        response: &Response,
    ) {
        let tokens = context.tokens;
        let mut axes = axes(response, tokens, scene.span);
        let there: Vec<(usize, &PlottedSeries)> = self
            .content
            .fields
            .iter()
            .enumerate()
            .filter_map(|(i, field)| Some((i, scene.log.series.get(field)?)))
            .collect();
        painter.rect_filled(axes.rect, 2.0, tokens.background);
        let inside = painter.with_clip_rect(axes.rect);
        paint_modes(&inside, scene.modes, &axes, tokens);
        if let Some(range) = y_range(there.iter().map(|(_, series)| *series), &axes) {
            axes.y = range;
            axes.draw_y(painter, tokens);
            let key = CurvesKey {
                revision: scene.log.revision,
                axes,
                fields: self.content.fields.clone(),
                dark: tokens.dark,
            };
            self.curves.paint(&inside, key, |shapes: &mut Vec<Shape>| {
                for (i, series) in &there {
                    let shifted = Axes {
                        y: (axes.y.0 - series.base, axes.y.1 - series.base),
                        ..axes
                    };
                    let stroke = Stroke::new(1.25, colour(tokens, *i));
                    curve_line(shapes, &shifted, &curve(series), stroke);
                }
            });
        } else {
            painter.text(
                axes.rect.center(),
                Align2::CENTER_CENTER,
                nothing(scene.log, self.content.fields.iter()),
                parts::small(tokens),
                tokens.muted,
            );
        }
        paint_span(&inside, axes.rect, &axes, context.selected_span, tokens);
        let cursor = axes.screen_x(context.time);
        inside.vline(cursor, axes.rect.y_range(), Stroke::new(1.0, tokens.accent));
        if let Some(time) = scene.hover {
            let stroke = Stroke::new(1.0, tokens.muted.gamma_multiply(0.6));
            inside.vline(axes.screen_x(time), axes.rect.y_range(), stroke);
        }
    }

    /// Names, values at the cursor or under the pointer, and what takes them away.
    fn heading(
        &mut self,
        ui: &mut Ui,
        context: &ViewContext<'_>,
        scene: &PanelScene<'_>,
        asked: &mut Vec<LogCommand>,
    ) {
        let tokens = context.tokens;
        let time = scene.hover.unwrap_or(context.time);
        let size = vec2(ui.available_width(), scene.size.0);
        ui.allocate_ui(size, |ui| {
            ui.horizontal_centered(|ui| {
                ui.spacing_mut().item_spacing.x = tokens.space;
                for (i, field) in self.content.fields.iter().enumerate() {
                    let series = scene.log.series.get(field);
                    let value = series.and_then(|s| s.at(time));
                    let value = value.map_or_else(|| "–".to_owned(), parts::brief);
                    let unit = series.map_or("", |s| &s.unit);
                    let name = series_name(field);
                    let text = egui::RichText::new(format!("{name}  {value} {unit}"))
                        .size(tokens.text_sizes[0])
                        .color(colour(tokens, i));
                    let button = egui::Button::new(text).frame(false);
                    let response = ui.add(button).on_hover_text("Click to take it away");
                    response.widget_info(|| {
                        let role = egui::Role::Button;
                        egui::WidgetInfo::labeled(role, true, format!("Take {name} away"))
                    });
                    if response.clicked() {
                        asked.push(LogCommand::Remove {
                            panel: scene.number,
                            series: field.clone(),
                        });
                    }
                }
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    let name = format!("Close plot {}", scene.number + 1);
                    if parts::chip(ui, tokens, false, "×", &name).clicked() {
                        asked.push(LogCommand::ClosePanel(scene.number));
                    }
                    let PanelContent {
                        against, joined, ..
                    } = &self.content;
                    let panel = scene.number;
                    if against.is_some() {
                        let name = format!("Join the points of plot {}", panel + 1);
                        if parts::chip(ui, tokens, *joined, "line", &name).clicked() {
                            let joined = !joined;
                            asked.push(LogCommand::JoinPoints { panel, joined });
                        }
                    }
                    let of = (panel, against.as_ref());
                    self.menu.show(ui, tokens, scene.log, of, asked);
                });
            });
        });
    }
}

/// Why there is nothing to see of fields.
pub(super) fn nothing<'a>(
    log: &'a OpenLog,
    fields: impl Iterator<Item = &'a SeriesName>,
) -> &'a str {
    for found in fields.map(|field| log.series.get(field)) {
        match found {
            // What is read by and by may have it yet.
            Some(series) if log.is_read() && series.lacks.is_some() => {
                return series.lacks.as_deref().unwrap_or_default();
            }
            Some(series) if series.is_whole() && series.lacks.is_none() => {}
            _ => return "Fetching …",
        }
    }
    "Nothing in this stretch of time."
}

/// Shades every other mode and writes its name where there is room.
fn paint_modes(
    painter: &egui::Painter,
    modes: &[(f64, f64, String)],
    axes: &Axes,
    tokens: &Tokens,
) {
    for (i, (from, to, name)) in modes.iter().enumerate() {
        let left = axes.screen_x(*from).max(axes.rect.left());
        let right = axes.screen_x(*to).min(axes.rect.right());
        if right <= left {
            continue;
        }
        let rect = Rect::from_x_y_ranges(left..=right, axes.rect.y_range());
        if i % 2 == 1 {
            painter.rect_filled(rect, 0.0, tokens.raised.gamma_multiply(0.5));
        }
        let galley = painter.layout_no_wrap(name.clone(), parts::small(tokens), tokens.muted);
        if galley.size().x + tokens.space < rect.width() {
            let at = rect.left_top() + vec2(0.5 * tokens.space, 1.0);
            painter.galley(at, galley, tokens.muted);
        }
    }
}
