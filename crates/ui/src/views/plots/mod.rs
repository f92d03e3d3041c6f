//! Plots over time with one time axis and the global cursor.

pub(crate) mod draw;
mod panel;
pub(crate) mod pyramid;
mod series;

use egui::{Align, Layout, Rect, ScrollArea, Sense, Shape, Stroke, Ui, pos2, vec2};

use super::chart::ChartAxes;
use super::parts;
use super::time_axis::{LEAST_SPAN, TimeAxis};
use crate::context::{DrawnTimes, ViewContext};
use crate::still::Still;
use crate::timeline::paint_span;
use crate::tokens::Tokens;
use panel::{PanelKind, PlotLayer};
use series::RunSeries;
pub(crate) use series::{DEAD_RECKONING_AFTER, placed_lately};

/// Least height of an open panel's curves, points.
const LEAST_HEIGHT: f32 = 64.0;
/// Least width of a panel at which another stands beside it, points.
const LEAST_WIDTH: f32 = 300.0;
/// The same where there is no room for another row.
const NARROW_WIDTH: f32 = 230.0;
/// State of a panel.
#[derive(Clone, Copy, Debug)]
struct PanelState {
    kind: PanelKind,
    /// Whether it is shown, if people said so.
    shown: Option<bool>,
    /// Whether the pointer or the keyboard was at its choices last.
    is_at_choices: bool,
    folded: bool,
    choice: usize,
}

/// Key of the curves of a panel: everything that they depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct CurvesKey {
    revisions: [u64; 2],
    axes: ChartAxes,
    choice: usize,
    factor: f64,
    dark: bool,
}

/// Shows errors, wind, NIS and innovations of the run over time.
pub struct PlotsView {
    panels: Vec<PanelState>,
    time_axis: TimeAxis,
    series: RunSeries,
    ghost: RunSeries,
    /// Drawn curves of each panel.
    curves: Vec<Still<CurvesKey>>,
    drawn: Option<DrawnTimes>,
}

impl Default for PlotsView {
    fn default() -> Self {
        Self {
            panels: PanelKind::ALL
                .map(|kind| PanelState {
                    kind,
                    shown: None,
                    is_at_choices: false,
                    folded: false,
                    choice: kind.first_choice(),
                })
                .to_vec(),
            time_axis: TimeAxis::default(),
            series: RunSeries::default(),
            ghost: RunSeries::default(),
            curves: vec![Still::default(); PanelKind::ALL.len()],
            drawn: None,
        }
    }
}

/// Whether a panel is shown: as people said, or else two that say most of the flight.
fn is_shown(panel: &PanelState, context: &ViewContext<'_>) -> bool {
    let has_truth = context.flight.is_some_and(|flight| flight.truth.is_some());
    let is_of_truth = matches!(panel.kind, PanelKind::PositionError | PanelKind::Distance);
    let is_usual = panel.kind != PanelKind::Innovations && is_of_truth == has_truth;
    panel.shown.unwrap_or(is_usual) && has_data(panel.kind, context)
}

/// Whether a panel has anything to show: a vehicle model without wind has none to plot.
fn has_data(kind: PanelKind, context: &ViewContext<'_>) -> bool {
    let wind = pilotage_core::vehicle::StateComponent::WindNorth;
    let windless = |run: &pilotage_core::navigator::Run| run.state_index(wind).is_none();
    kind != PanelKind::Wind || !context.run.is_some_and(windless)
}

impl PlotsView {
    /// Times that were drawn last.
    pub fn drawn(&self) -> Option<DrawnTimes> {
        self.drawn
    }

    /// Shows all of the time again: the stretch that was chosen is of another flight.
    pub fn show_all_time(&mut self) {
        self.time_axis = TimeAxis::default();
    }

    /// Draws the view into the space that `ui` has left.
    pub fn show(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        ui.spacing_mut().item_spacing.y = 0.5 * context.tokens.space;
        let more = self.series.update(context.run, context.flight);
        let more_ghost = self.ghost.update(context.ghost, context.flight);
        if more || more_ghost {
            ui.ctx().request_repaint();
        }
        let Some(whole) = whole_span(context) else {
            parts::no_run(ui, context, "Fly to see errors and wind over time.");
            return;
        };
        let span = self.time_axis.span(whole);
        self.chooser(ui, context, whole);
        let shown: Vec<usize> = (0..self.panels.len())
            .filter(|i| is_shown(&self.panels[*i], context))
            .collect();
        let columns = columns(ui.available_size(), shown.len(), context.tokens);
        self.time_axis.hover = if columns == 1 {
            self.stack(ui, context, &shown, span)
        } else {
            self.grid(ui, context, &shown, columns, span)
        };
        self.drawn = context.drawn(context.time);
    }

    /// Panels below each other over one time axis; returns the hovered time.
    fn stack(
        &mut self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        shown: &[usize],
        span: (f64, f64),
    ) -> Option<f64> {
        let tokens = context.tokens;
        let gap = 0.5 * tokens.space;
        let axis = TimeAxis::height(tokens);
        let header = header_height(tokens);
        let open = shown.iter().filter(|i| !self.panels[**i].folded).count();
        let free = ui.available_height() - axis - gap - (header + gap) * shown.len() as f32;
        let height = (free / open.max(1) as f32).max(LEAST_HEIGHT);
        let mut hover = None;
        ScrollArea::vertical()
            .id_salt("plots")
            .max_height((ui.available_height() - axis - gap).max(LEAST_HEIGHT))
            .auto_shrink(false)
            .show(ui, |ui| {
                ui.spacing_mut().item_spacing.y = 0.0;
                for index in shown {
                    let found = self.panel(ui, context, *index, (header, height), span, true);
                    hover = hover.or(found);
                    ui.add_space(gap);
                }
            });
        TimeAxis::draw(ui, context, span);
        hover
    }

    /// Panels side by side in rows of `columns`, each column over its own time axis.
    fn grid(
        &mut self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        shown: &[usize],
        columns: usize,
        span: (f64, f64),
    ) -> Option<f64> {
        let tokens = context.tokens;
        let axis = TimeAxis::height(tokens);
        let header = header_height(tokens);
        let rows = shown.len().div_ceil(columns);
        let free = (ui.available_height() - axis) / rows as f32 - header;
        let height = free.max(LEAST_HEIGHT);
        let width = (ui.available_width() - (columns - 1) as f32 * tokens.space) / columns as f32;
        let mut hover = None;
        ScrollArea::vertical()
            .id_salt("plots")
            .auto_shrink(false)
            .show(ui, |ui| {
                let origin = ui.max_rect().left_top();
                let size = vec2(ui.available_width(), rows as f32 * (header + height) + axis);
                ui.allocate_space(size);
                for (i, index) in shown.iter().enumerate() {
                    let (row, column) = (i / columns, i % columns);
                    let corner = origin
                        + vec2(
                            column as f32 * (width + tokens.space),
                            row as f32 * (header + height),
                        );
                    let below = i + columns >= shown.len();
                    let cell = vec2(width, header + height + if below { axis } else { 0.0 });
                    let builder = egui::UiBuilder::new()
                        .max_rect(Rect::from_min_size(corner, cell))
                        .id_salt(index);
                    ui.scope_builder(builder, |ui| {
                        ui.spacing_mut().item_spacing.y = 0.0;
                        let found = self.panel(ui, context, *index, (header, height), span, false);
                        hover = hover.or(found);
                        if below {
                            TimeAxis::draw(ui, context, span);
                        }
                    });
                }
            });
        hover
    }

    /// Draws the choices of the panels that are shown, and of the span of time.
    fn chooser(&mut self, ui: &mut Ui, context: &ViewContext<'_>, whole: (f64, f64)) {
        let tokens = context.tokens;
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = vec2(0.5 * tokens.space, 0.5 * tokens.space);
            ui.spacing_mut().interact_size.y = 2.0 * tokens.space;
            for panel in &mut self.panels {
                if !has_data(panel.kind, context) {
                    continue;
                }
                let title = panel.kind.title(context.is_recorded);
                let name = format!("Show {title}");
                let is_on = is_shown(panel, context);
                if parts::chip(ui, tokens, is_on, title, &name).clicked() {
                    panel.shown = Some(!is_on);
                }
            }
            ui.add_space(tokens.space);
            self.time_axis.chips(ui, context, whole);
        });
    }

    /// Draws a panel; returns the time under the pointer.
    fn panel(
        &mut self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        index: usize,
        (header, height): (f32, f32),
        span: (f64, f64),
        foldable: bool,
    ) -> Option<f64> {
        let tokens = context.tokens;
        let PanelState {
            kind,
            folded,
            choice,
            ..
        } = self.panels[index];
        let (factor, unit) = kind.unit(context.units);
        let header_rect = self.header(ui, context, index, header, unit, foldable);
        if folded && foldable {
            return None;
        }
        let (outer, response) =
            ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::click_and_drag());
        let title = kind.title(context.is_recorded);
        parts::name(&response, format!("{title} plot"));
        let logarithmic = kind.logarithmic(choice);
        let mut axes = ChartAxes {
            rect: TimeAxis::curves_rect(outer, tokens),
            x: span,
            y: (0.0, 1.0),
            log: logarithmic,
        };
        let layers = kind.layers(choice, &self.series, &self.ghost, tokens, factor);
        axes.y = kind.y_range(&layers, &axes, logarithmic);
        let painter = ui.painter_at(outer);
        painter.rect_filled(axes.rect, 2.0, tokens.background);
        axes.draw_y(&painter, tokens);
        let inside = painter.with_clip_rect(axes.rect);
        let key = CurvesKey {
            revisions: [self.series.revision, self.ghost.revision],
            axes,
            choice,
            factor,
            dark: tokens.dark,
        };
        let gaps = &self.series.gaps;
        self.curves[index].paint(&inside, key, |shapes| {
            paint_gaps(shapes, gaps, &axes, tokens);
            for layer in &layers {
                layer.draw(shapes, &axes);
            }
        });
        if !layers.iter().any(|l| l.is_visible(&axes)) {
            painter.text(
                axes.rect.center(),
                egui::Align2::CENTER_CENTER,
                nothing(kind, context),
                parts::small(tokens),
                tokens.muted,
            );
        }
        paint_span(&inside, axes.rect, &axes, context.selected_span, tokens);
        let cursor = axes.screen_x(context.time);
        inside.vline(cursor, axes.rect.y_range(), Stroke::new(1.0, tokens.accent));
        if let Some(time) = self.time_axis.hover {
            let stroke = Stroke::new(1.0, tokens.muted.gamma_multiply(0.6));
            inside.vline(axes.screen_x(time), axes.rect.y_range(), stroke);
        }
        let time = self.time_axis.hover.unwrap_or(context.time);
        if !legend(ui, tokens, &layers, &axes, header_rect, time) {
            names_inside(&inside, tokens, &layers, &axes);
        }
        let whole = whole_span(context)?;
        self.time_axis
            .interact(ui, context, &response, &axes, whole)
    }

    /// Heading, choices; returns what is left for the legend.
    fn header(
        &mut self,
        ui: &mut Ui,
        context: &ViewContext<'_>,
        index: usize,
        height: f32,
        unit: &str,
        foldable: bool,
    ) -> Rect {
        let tokens = context.tokens;
        let panel = &mut self.panels[index];
        let title = panel.kind.title(context.is_recorded);
        ui.allocate_ui_with_layout(
            vec2(ui.available_width(), height),
            Layout::left_to_right(Align::Center),
            |ui| {
                ui.spacing_mut().item_spacing.x = 0.5 * tokens.space;
                ui.spacing_mut().interact_size.y = 2.0 * tokens.space;
                ui.spacing_mut().button_padding = vec2(0.0, 0.0);
                if foldable {
                    fold(ui, tokens, title, &mut panel.folded);
                } else {
                    ui.label(
                        egui::RichText::new(title)
                            .size(tokens.text_sizes[0])
                            .color(tokens.text),
                    );
                }
                if !unit.is_empty() {
                    ui.label(
                        egui::RichText::new(unit)
                            .size(tokens.text_sizes[0])
                            .color(tokens.muted),
                    );
                }
                if !(panel.folded && foldable) {
                    choices(ui, tokens, panel, title);
                }
                ui.available_rect_before_wrap()
            },
        )
        .inner
    }
}

/// Choices of a panel, which are seen while the pointer or the keyboard is at its heading; else what is chosen is, calmly.
fn choices(ui: &mut Ui, tokens: &Tokens, panel: &mut PanelState, title: &str) {
    let is_near = panel.is_at_choices || ui.rect_contains_pointer(ui.max_rect());
    panel.is_at_choices = false;
    for (i, (short, long)) in panel.kind.choices().into_iter().enumerate() {
        let is_chosen = panel.choice == i;
        let name = format!("{title}, {long}");
        let opacity = match (is_near || tokens.touch, is_chosen) {
            (true, _) => 1.0,
            (false, true) => 0.7,
            (false, false) => 0.0,
        };
        let response = ui.scope(|ui| {
            ui.multiply_opacity(opacity);
            parts::chip(ui, tokens, is_chosen, short, &name)
        });
        let response = response.inner;
        panel.is_at_choices |= response.hovered() || response.has_focus();
        if response.clicked() {
            panel.choice = i;
        }
    }
}

/// Shades the stretches of dead reckoning.
fn paint_gaps(shapes: &mut Vec<Shape>, gaps: &[(f64, f64)], axes: &ChartAxes, tokens: &Tokens) {
    let color = tokens.dead_reckoning.gamma_multiply(0.08);
    for gap in gaps {
        let across = axes.screen_x(gap.0)..=axes.screen_x(gap.1);
        let rect = Rect::from_x_y_ranges(across, axes.rect.y_range());
        shapes.push(Shape::rect_filled(rect, 0.0, color));
    }
}

/// The heading of a panel, which folds it.
fn fold(ui: &mut Ui, tokens: &Tokens, title: &str, folded: &mut bool) {
    let text = egui::RichText::new(format!("      {title}"))
        .size(tokens.text_sizes[0])
        .color(tokens.text);
    let response = ui.add(egui::Button::new(text).frame(false));
    response.widget_info(|| {
        egui::WidgetInfo::selected(egui::Role::Button, true, !*folded, format!("Fold {title}"))
    });
    let at = response.rect.left_center() + vec2(0.75 * tokens.space, 0.0);
    parts::arrow(ui.painter(), at, *folded, tokens.muted);
    if response.clicked() {
        *folded = !*folded;
    }
}

/// Number of panels side by side: as many as are comfortably wide, or where the height is too small for the
/// rows that this gives, as many as are wide enough at all.
fn columns(size: egui::Vec2, panels: usize, tokens: &Tokens) -> usize {
    let most = panels.max(1);
    let comfortable = ((size.x / LEAST_WIDTH) as usize).clamp(1, most);
    let row = header_height(tokens) + LEAST_HEIGHT;
    let needed = panels.div_ceil(comfortable) as f32 * row + TimeAxis::height(tokens);
    if comfortable > 1 && needed > size.y {
        ((size.x / NARROW_WIDTH) as usize).clamp(1, most)
    } else {
        comfortable
    }
}

/// Height of a panel's heading, points.
fn header_height(tokens: &Tokens) -> f32 {
    if tokens.touch {
        tokens.target()
    } else {
        3.0 * tokens.space
    }
}

/// All the time there is: the flight's, so that the axis stands still while a run streams in.
fn whole_span(context: &ViewContext<'_>) -> Option<(f64, f64)> {
    let run = context.run?.span()?;
    let flight = context
        .flight
        .map_or(run, pilotage_core::flight::Flight::span);
    let (low, high) = (run.0.min(flight.0), run.1.max(flight.1));
    Some((low, high.max(low + LEAST_SPAN)))
}

/// Why a panel is empty.
fn nothing(kind: PanelKind, context: &ViewContext<'_>) -> &'static str {
    let truth = context.flight.is_some_and(|f| f.truth.is_some());
    match kind {
        PanelKind::PositionError | PanelKind::Distance if !truth => {
            "This flight does not know the truth."
        }
        PanelKind::Wind => "This vehicle model does not estimate wind.",
        _ => "Nothing in this stretch of time.",
    }
}

/// Samples and names in the upper right corner of the curves.
fn names_inside(
    painter: &egui::Painter,
    tokens: &Tokens,
    layers: &[PlotLayer<'_>],
    axes: &ChartAxes,
) {
    let (sample, gap) = (10.0, tokens.space);
    let middle = axes.rect.top() + 0.5 * tokens.text_sizes[0] + 2.0;
    let mut right = axes.rect.right() - 0.5 * gap;
    for layer in layers.iter().rev().filter(|l| l.is_visible(axes)) {
        let name = layer.name.clone();
        let galley = painter.layout_no_wrap(name, parts::small(tokens), tokens.muted);
        let rect = egui::Align2::RIGHT_CENTER.anchor_size(pos2(right, middle), galley.size());
        if rect.left() - sample < axes.rect.left() {
            break;
        }
        let behind = Rect::from_min_max(rect.min - vec2(sample + gap, 0.0), rect.max);
        painter.rect_filled(behind, 2.0, tokens.background.gamma_multiply(0.8));
        painter.galley(rect.min, galley, tokens.muted);
        let at = pos2(rect.left() - 0.5 * (sample + gap), middle);
        layer.draw_sample(painter, at, sample);
        right = behind.left() - 0.5 * gap;
    }
}

/// Samples, names and values at `time`, from the right; names go first where room is short. Whether they are there.
fn legend(
    ui: &Ui,
    tokens: &Tokens,
    layers: &[PlotLayer<'_>],
    axes: &ChartAxes,
    rect: Rect,
    time: f64,
) -> bool {
    let painter = ui.painter_at(rect);
    let entries: Vec<(&PlotLayer<'_>, String)> = layers
        .iter()
        .rev()
        .filter(|l| l.is_visible(axes))
        .map(|l| {
            (
                l,
                l.value_at(time)
                    .map_or_else(|| "–".to_owned(), parts::brief),
            )
        })
        .collect();
    let value_width = 2.9 * tokens.text_sizes[0];
    let sample = 10.0;
    let gap = tokens.space;
    let names: f32 = entries
        .iter()
        .map(|(l, _)| {
            painter
                .layout_no_wrap(l.name.clone(), parts::small(tokens), tokens.muted)
                .size()
                .x
                + 0.5 * gap
        })
        .sum();
    let bare = entries.len() as f32 * (value_width + sample + gap);
    let with_names = bare + names <= rect.width();
    let mut right = rect.right() - tokens.space;
    for (layer, value) in entries {
        let middle = rect.center().y;
        if right - value_width - sample < rect.left() {
            break;
        }
        painter.text(
            pos2(right, middle),
            egui::Align2::RIGHT_CENTER,
            value,
            parts::small(tokens),
            tokens.text,
        );
        right -= value_width;
        if with_names {
            let text = painter.text(
                pos2(right, middle),
                egui::Align2::RIGHT_CENTER,
                &layer.name,
                parts::small(tokens),
                tokens.muted,
            );
            right = text.left() - 0.5 * gap;
        }
        layer.draw_sample(&painter, pos2(right - 0.5 * sample, middle), sample);
        right -= sample + gap;
    }
    with_names
}

#[cfg(test)]
mod tests;
