//! The plots as they are shown, as a drawing of their own: the same curves, axes, bands and colours.

use egui::{Color32, Pos2, Rect, Stroke, pos2, vec2};

use super::against::{self, AgainstScene};
use super::arrangement::PanelContent;
use super::cloud::{CloudKey, PixelCloud};
use super::scene::{PanelScene, colour, curve, mode_bands, y_range};
use super::svg::{PlotSvg, PlotTextAnchor};
use super::words::series_name;
use super::{OpenLog, PlottedSeries};
use crate::tokens::Tokens;
use crate::units::clock;
use crate::views::chart::ChartAxes;
use crate::views::{TimeAxis, curve_points};

/// Letters that a name takes of a line, in sizes of the text: as wide as they are on average.
const LETTER: f32 = 0.6;

/// Scene to be drawn.
pub(super) struct PlotScene<'a> {
    pub log: &'a OpenLog,
    pub tokens: &'a Tokens,
    pub panels: Vec<&'a PanelContent>,
    /// The time that is shown.
    pub span: (f64, f64),
    /// Time at which the clock stands at zero, seconds.
    pub clock_zero: f64,
    pub selected: Option<(f64, f64)>,
    /// Width of the plots and height of the curves of each, as they are shown, points.
    pub size: (f32, f32),
}

impl PlotScene<'_> {
    fn header(&self) -> f32 {
        3.0 * self.tokens.space
    }

    /// Width and height of the whole, points.
    pub fn extent(&self) -> (f32, f32) {
        let panels = self.panels.len() as f32 * (self.header() + self.size.1);
        let title = self.header();
        let axis = TimeAxis::height(self.tokens);
        let margin = self.tokens.space;
        (
            self.size.0 + 2.0 * margin,
            title + panels + axis + 2.0 * margin,
        )
    }

    /// The drawing as an SVG file.
    pub fn draw(&self) -> String {
        let (width, height) = self.extent();
        let tokens = self.tokens;
        let mut svg = PlotSvg::new((width, height), tokens.text_sizes[0]);
        let whole = Rect::from_min_size(Pos2::ZERO, vec2(width, height));
        svg.fill(whole, tokens.surface);
        let [from, to] = [self.span.0, self.span.1].map(|time| clock(time, self.clock_zero));
        let title = format!("{}, {from} to {to}", self.log.file);
        let margin = tokens.space;
        let mut top = margin;
        svg.text(
            pos2(margin, top + 0.6 * self.header()),
            PlotTextAnchor::Start,
            &title,
            tokens.text,
        );
        top += self.header();
        for panel in &self.panels {
            let heading = Rect::from_min_size(pos2(margin, top), vec2(self.size.0, self.header()));
            self.legend(&mut svg, panel, heading);
            top += self.header();
            let outer = Rect::from_min_size(pos2(margin, top), vec2(self.size.0, self.size.1));
            if panel.against.is_some() {
                self.against(&mut svg, panel, outer);
            } else {
                self.over_time(&mut svg, panel, outer);
            }
            top += self.size.1;
        }
        let below = Rect::from_min_size(pos2(margin, top), vec2(self.size.0, 0.0));
        if self.panels.iter().any(|panel| panel.against.is_none()) {
            let mut axes = self.time_axes(below);
            axes.x = (axes.x.0 - self.clock_zero, axes.x.1 - self.clock_zero);
            draw_x(&mut svg, tokens, &axes, "time, s");
        }
        svg.finish(&title)
    }

    fn time_axes(&self, outer: Rect) -> ChartAxes {
        ChartAxes {
            rect: TimeAxis::curves_rect(outer, self.tokens),
            x: self.span,
            y: (0.0, 1.0),
            log: false,
        }
    }

    /// A sample of each line, with name and unit.
    fn legend(&self, svg: &mut PlotSvg, panel: &PanelContent, rect: Rect) {
        let text_size = self.tokens.text_sizes[0];
        let mut x = rect.left();
        let y = rect.center().y;
        for (i, field) in panel.fields.iter().enumerate() {
            let unit = self.log.series.get(field).map_or("", |s| s.unit.as_str());
            let name = series_name(field);
            let text = match unit {
                "" => name,
                unit => format!("{name}, {unit}"),
            };
            let colour = colour(self.tokens, i);
            svg.segment(pos2(x, y), pos2(x + 14.0, y), Stroke::new(2.0, colour));
            let at = pos2(x + 18.0, y + 0.35 * text_size);
            svg.text(at, PlotTextAnchor::Start, &text, self.tokens.text);
            x += 18.0 + LETTER * text_size * text.chars().count() as f32 + 2.0 * self.tokens.space;
        }
    }

    fn over_time(&self, svg: &mut PlotSvg, panel: &PanelContent, outer: Rect) {
        let tokens = self.tokens;
        let mut axes = self.time_axes(outer);
        svg.fill(axes.rect, tokens.background);
        let there: Vec<(usize, &PlottedSeries)> = panel
            .fields
            .iter()
            .enumerate()
            .filter_map(|(i, field)| Some((i, self.log.series.get(field)?)))
            .collect();
        self.modes(svg, &axes);
        let Some(range) = y_range(there.iter().map(|(_, series)| *series), &axes) else {
            return;
        };
        axes.y = range;
        draw_y(svg, tokens, &axes);
        svg.clipped(axes.rect, |svg| {
            for (i, series) in there {
                let shifted = ChartAxes {
                    y: (axes.y.0 - series.base, axes.y.1 - series.base),
                    ..axes
                };
                for points in curve_points(&shifted, &curve(series)) {
                    svg.line(&points, Stroke::new(1.25, colour(tokens, i)));
                }
            }
            if let Some((from, to)) = self.selected {
                let across = axes.screen_x(from)..=axes.screen_x(to);
                let band = Rect::from_x_y_ranges(across, axes.rect.y_range());
                svg.fill(band, tokens.accent.gamma_multiply(0.12));
            }
        });
    }

    fn modes(&self, svg: &mut PlotSvg, axes: &ChartAxes) {
        let tokens = self.tokens;
        let whole = self.log.span().unwrap_or(self.span);
        for (i, (from, to, name)) in mode_bands(self.log, whole).into_iter().enumerate() {
            let left = axes.screen_x(from).max(axes.rect.left());
            let right = axes.screen_x(to).min(axes.rect.right());
            if right <= left {
                continue;
            }
            if i % 2 == 1 {
                let band = Rect::from_x_y_ranges(left..=right, axes.rect.y_range());
                svg.fill(band, tokens.raised.gamma_multiply(0.5));
            }
            let text_size = tokens.text_sizes[0];
            if LETTER * text_size * name.chars().count() as f32 + tokens.space < right - left {
                let at = pos2(left + 0.5 * tokens.space, axes.rect.top() + text_size);
                svg.text(at, PlotTextAnchor::Start, &name, tokens.muted);
            }
        }
    }

    fn against(&self, svg: &mut PlotSvg, panel: &PanelContent, outer: Rect) {
        let Some(against) = &panel.against else {
            return;
        };
        let tokens = self.tokens;
        let scene = AgainstScene {
            panel: &PanelScene {
                log: self.log,
                number: 0,
                is_active: false,
                size: (self.header(), self.size.1),
                span: self.span,
                hover: None,
                modes: &[],
            },
            fields: &panel.fields,
            against,
            joined: panel.joined,
        };
        let pairs = scene.pairs().unwrap_or_default();
        let Some(axes) = against::axes(outer, tokens, self.span, &pairs) else {
            return;
        };
        svg.fill(axes.rect, tokens.background);
        draw_y(svg, tokens, &axes);
        draw_x(svg, tokens, &axes, &against::x_name(&scene));
        svg.clipped(axes.rect, |svg| {
            if against::is_cloud(&pairs, self.span) {
                let key = CloudKey {
                    revision: self.log.revision,
                    axes,
                    span: self.span,
                    fields: panel.fields.clone(),
                    joined: panel.joined,
                    is_dark: tokens.dark,
                };
                let only: Vec<_> = pairs.iter().map(|(_, pairs)| *pairs).collect();
                let mut cloud = PixelCloud::default();
                while cloud.follow(&key, &only) {}
                for (number, (i, _)) in pairs.iter().enumerate() {
                    svg.runs(&cloud.runs(number), colour(tokens, *i));
                }
                return;
            }
            for (i, pairs) in &pairs {
                let colour: Color32 = colour(tokens, *i);
                for line in against::lines(pairs, &axes, self.span) {
                    if panel.joined && line.len() > 1 {
                        svg.line(&line, Stroke::new(1.25, colour));
                    } else {
                        svg.dots(&line, 1.5, colour);
                    }
                }
            }
        });
    }
}

/// Grid lines and labels at the left.
fn draw_y(svg: &mut PlotSvg, tokens: &Tokens, axes: &ChartAxes) {
    for (value, text) in axes.y_ticks(tokens) {
        let y = axes.screen_y(value);
        let width = if value == 0.0 { 1.0 } else { 0.5 };
        let (left, right) = (axes.rect.left(), axes.rect.right());
        svg.segment(
            pos2(left, y),
            pos2(right, y),
            Stroke::new(width, tokens.line),
        );
        let half = 0.4 * tokens.text_sizes[0];
        let y = y.clamp(axes.rect.top() + half, axes.rect.bottom() - half);
        let at = pos2(left - 0.5 * tokens.space, y + 0.35 * tokens.text_sizes[0]);
        svg.text(at, PlotTextAnchor::End, &text, tokens.muted);
    }
}

/// Labels below, with the name at the right end.
fn draw_x(svg: &mut PlotSvg, tokens: &Tokens, axes: &ChartAxes, name: &str) {
    let text_size = tokens.text_sizes[0];
    let bottom = axes.rect.bottom();
    let baseline = bottom + 0.25 * tokens.space + text_size;
    svg.text(
        pos2(axes.rect.right(), baseline),
        PlotTextAnchor::End,
        name,
        tokens.muted,
    );
    let width = |text: &str| LETTER * text_size * text.chars().count() as f32;
    let end = axes.rect.right() - width(name) - tokens.space;
    for (value, text) in axes.x_ticks(tokens) {
        let x = axes.screen_x(value);
        let tick = 0.25 * tokens.space;
        svg.segment(
            pos2(x, bottom),
            pos2(x, bottom + tick),
            Stroke::new(1.0, tokens.line),
        );
        if x + 0.5 * width(&text) < end {
            svg.text(
                pos2(x, baseline),
                PlotTextAnchor::Middle,
                &text,
                tokens.muted,
            );
        }
    }
}
