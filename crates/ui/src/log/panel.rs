//! Panel of a plot: fields over time or against another field, their values at the cursor, the modes behind
//! them.

use egui::{Align2, Painter, Rect, Response, Sense, Shape, Stroke, Ui, vec2};

use super::against::{AgainstPlot, AgainstScene};
use super::against_menu::AgainstMenu;
use super::arrangement::PanelContent;
use super::scene::{PanelScene, axes, colour, curve, nothing, y_range};
use super::words::{figure, series_name};
use super::{LogCommand, PlottedSeries};
use crate::context::ViewContext;
use crate::still::Still;
use crate::timeline::paint_span;
use crate::tokens::Tokens;
use crate::views::chart::ChartAxes;
use crate::views::{curve_line, parts};
use pilotage_jobs::SeriesName;

/// Key of the curves of a panel: everything that they depend on.
#[derive(Clone, Debug, PartialEq)]
struct LogCurvesKey {
    revision: u64,
    axes: ChartAxes,
    fields: Vec<SeriesName>,
    dark: bool,
}

/// A panel and the fields that it shows.
pub(super) struct LogPanel {
    pub content: PanelContent,
    curves: Still<LogCurvesKey>,
    against: AgainstPlot,
    menu: AgainstMenu,
}

/// Response of a panel to the pointer over it.
pub(super) struct PanelResponse {
    /// Of the area with the curves.
    pub response: Response,
    /// Time of the point under the pointer, in a panel against a field.
    pub hover: Option<f64>,
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
            let key = LogCurvesKey {
                revision: scene.log.revision,
                axes,
                fields: self.content.fields.clone(),
                dark: tokens.dark,
            };
            self.curves.paint(&inside, key, |shapes: &mut Vec<Shape>| {
                for (i, series) in &there {
                    let shifted = ChartAxes {
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
                    let unit = series.map_or("", |s| &s.unit);
                    let name = series_name(field);
                    // A dash for a value that there is not would read as the sign of one.
                    let words = match value.map(figure) {
                        Some(value) => format!("{name}  {value} {unit}"),
                        None if unit.is_empty() => name.clone(),
                        None => format!("{name}, {unit}"),
                    };
                    let text = egui::RichText::new(words)
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

/// Shades every other mode and writes its name where there is room.
fn paint_modes(
    painter: &egui::Painter,
    modes: &[(f64, f64, String)],
    axes: &ChartAxes,
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
