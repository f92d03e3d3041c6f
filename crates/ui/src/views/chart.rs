//! Axes of a chart: from values to points and back, ticks, grid and labels.

use egui::{Align2, Painter, Pos2, Rect, Shape, Stroke, pos2};

use super::parts;
use crate::tokens::Tokens;

/// Lengths of the dashes of a line and of the gaps between them, points; a line without is drawn through.
pub(crate) type Dash = Option<(f32, f32)>;

/// Shapes of a line with its dash.
pub(crate) fn dashed(line: Vec<Pos2>, stroke: Stroke, dash: Dash) -> Vec<Shape> {
    match dash {
        Some((dash, gap)) => Shape::dashed_line(&line, stroke, dash, gap),
        None => vec![Shape::line(line, stroke)],
    }
}

/// A chart's area and the values at its edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ChartAxes {
    /// Part of the screen on which curves are drawn.
    pub rect: Rect,
    /// Values at the left and right edge.
    pub x: (f64, f64),
    /// Values at the bottom and top edge.
    pub y: (f64, f64),
    /// Whether y is drawn by its logarithm.
    pub log: bool,
}

impl ChartAxes {
    /// Screen x of a value.
    pub fn screen_x(&self, x: f64) -> f32 {
        let fraction = (x - self.x.0) / (self.x.1 - self.x.0);
        self.rect.left() + fraction as f32 * self.rect.width()
    }

    /// Screen y of a value.
    pub fn screen_y(&self, y: f64) -> f32 {
        let (low, high, y) = if self.log {
            (self.y.0.ln(), self.y.1.ln(), y.max(1e-12).ln())
        } else {
            (self.y.0, self.y.1, y)
        };
        self.rect.bottom() - ((y - low) / (high - low)) as f32 * self.rect.height()
    }

    /// Screen place of a pair of values.
    pub fn at(&self, x: f64, y: f64) -> Pos2 {
        pos2(self.screen_x(x), self.screen_y(y))
    }

    /// Value at a screen x.
    pub fn x_at(&self, screen_x: f32) -> f64 {
        let fraction = f64::from((screen_x - self.rect.left()) / self.rect.width());
        self.x.0 + fraction * (self.x.1 - self.x.0)
    }

    /// Values with a grid line across, and their labels.
    pub fn y_ticks(&self, tokens: &Tokens) -> Vec<(f64, String)> {
        let most = ((self.rect.height() / (3.2 * tokens.text_sizes[0])) as usize).clamp(2, 6);
        let ticks = if self.log {
            decades(self.y.0, self.y.1)
        } else {
            few_or_ends(ticks(self.y.0, self.y.1, most), self.y)
        };
        let texts = if self.log {
            ticks.iter().map(|t| decade_label(*t)).collect()
        } else {
            labels(&ticks)
        };
        ticks.into_iter().zip(texts).collect()
    }

    /// Values with a mark below, and their labels.
    pub fn x_ticks(&self, tokens: &Tokens) -> Vec<(f64, String)> {
        let most = ((self.rect.width() / (6.0 * tokens.text_sizes[0])) as usize).clamp(2, 10);
        let ticks = ticks(self.x.0, self.x.1, most);
        let texts = labels(&ticks);
        ticks.into_iter().zip(texts).collect()
    }

    /// Grid lines and tick labels of the y axis, at the left, outside the area.
    pub fn draw_y(&self, painter: &Painter, tokens: &Tokens) {
        for (tick, text) in self.y_ticks(tokens) {
            let y = self.screen_y(tick);
            let width = if tick == 0.0 { 1.0 } else { 0.5 };
            painter.hline(self.rect.x_range(), y, Stroke::new(width, tokens.line));
            let y = y.clamp(
                self.rect.top() + 0.4 * tokens.text_sizes[0],
                self.rect.bottom() - 0.4 * tokens.text_sizes[0],
            );
            let galley = painter.layout_no_wrap(text, parts::small(tokens), tokens.muted);
            // A long one reaches into the area rather than being cut.
            let left = self.rect.left() - 0.5 * tokens.space - galley.size().x;
            let place = pos2(
                left.max(painter.clip_rect().left()),
                y - 0.5 * galley.size().y,
            );
            painter.galley(place, galley, tokens.muted);
        }
    }

    /// Tick labels of an x axis that is time, in seconds since `zero`.
    pub fn draw_time(&self, painter: &Painter, tokens: &Tokens, zero: f64) {
        let since = Self {
            x: (self.x.0 - zero, self.x.1 - zero),
            ..*self
        };
        since.draw_x(painter, tokens, "time, s");
    }

    /// Tick labels of the x axis below the area, with the axis' `name`, if any, at the right end.
    pub fn draw_x(&self, painter: &Painter, tokens: &Tokens, name: &str) {
        let top = self.rect.bottom() + 0.25 * tokens.space;
        let name_rect = painter.text(
            pos2(self.rect.right(), top),
            Align2::RIGHT_TOP,
            name,
            parts::small(tokens),
            tokens.muted,
        );
        // Without a name the last number may stand at the very end.
        let end = if name.is_empty() {
            painter.clip_rect().right()
        } else {
            name_rect.left() - 0.5 * tokens.space
        };
        for (tick, text) in self.x_ticks(tokens) {
            let x = self.screen_x(tick);
            painter.vline(
                x,
                self.rect.bottom()..=self.rect.bottom() + 0.25 * tokens.space,
                Stroke::new(1.0, tokens.line),
            );
            let galley = painter.layout_no_wrap(text, parts::small(tokens), tokens.muted);
            let middle = x - 0.5 * galley.size().x;
            let left = if name.is_empty() {
                middle.min(end - galley.size().x)
            } else {
                middle
            };
            if left + galley.size().x <= end {
                painter.galley(pos2(left, top), galley, tokens.muted);
            }
        }
    }
}

/// Round values (1, 2 or 5 times a power of ten) in [low, high], about `most` of them.
pub(crate) fn ticks(low: f64, high: f64, most: usize) -> Vec<f64> {
    let raw = (high - low) / most.max(1) as f64;
    if !(raw.is_finite() && raw > 0.0) {
        return Vec::new();
    }
    let power = 10_f64.powf(raw.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .map(|m| m * power)
        .into_iter()
        .find(|s| *s >= 0.7 * raw)
        .unwrap_or(10.0 * power);
    let first = (low / step).ceil() as i64;
    let last = (high / step).floor() as i64;
    (first..=last).map(|i| i as f64 * step).collect()
}

/// The ticks, or where they are too few to read a scale from, both ends and zero.
fn few_or_ends(ticks: Vec<f64>, (low, high): (f64, f64)) -> Vec<f64> {
    if ticks.len() >= 3 {
        return ticks;
    }
    let mut ends = vec![low, high];
    if low < 0.0 && high > 0.0 {
        ends.insert(1, 0.0);
    }
    ends
}

/// Texts of ticks, all with as many decimals as their distance needs.
fn labels(ticks: &[f64]) -> Vec<String> {
    let step = ticks
        .windows(2)
        .map(|pair| pair[1] - pair[0])
        .fold(f64::INFINITY, f64::min);
    let decimals = if step.is_finite() {
        (-(step * 1.000_001).log10().floor()).max(0.0) as usize
    } else {
        usize::from(ticks.iter().any(|t| t.fract() != 0.0))
    };
    ticks
        .iter()
        .map(|t| format!("{t:.decimals$}").replace('-', "−"))
        .collect()
}

/// Powers of ten in [low, high].
fn decades(low: f64, high: f64) -> Vec<f64> {
    let first = low.log10().ceil() as i32;
    let last = high.log10().floor() as i32;
    (first..=last).map(|e| 10_f64.powi(e)).collect()
}

/// Text of a power of ten.
fn decade_label(value: f64) -> String {
    if (0.001..10_000.0).contains(&value) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_of_an_axis_takes_the_place_of_the_last_numbers_and_no_name_leaves_them_all() {
        let written = |name: &'static str| {
            let axes = ChartAxes {
                rect: Rect::from_min_max(pos2(40.0, 10.0), pos2(280.0, 60.0)),
                x: (40.0, 100.0),
                y: (0.0, 1.0),
                log: false,
            };
            let harness = egui_kittest::Harness::builder()
                .with_size(egui::vec2(300.0, 100.0))
                .build_ui(move |ui| axes.draw_x(ui.painter(), &Tokens::dark(), name));
            let shapes = harness.output().shapes.iter();
            let texts = shapes.filter_map(|clipped| match &clipped.shape {
                egui::Shape::Text(text) => Some(text.galley.text().to_owned()),
                _ => None,
            });
            texts.filter(|text| !text.is_empty()).collect::<Vec<_>>()
        };
        assert_eq!(written(""), ["40", "60", "80", "100"]);
        assert_eq!(
            written("flights inside, %"),
            ["flights inside, %", "40", "60"]
        );
    }

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(ticks(-7.0, 8.0, 4), vec![-5.0, 0.0, 5.0]);
        assert_eq!(ticks(0.0, 1.0, 5).len(), 6);
        assert!(ticks(3.0, 3.0, 5).is_empty());
    }

    #[test]
    fn the_value_under_a_place_is_the_value_drawn_there() {
        let axes = ChartAxes {
            rect: Rect::from_min_max(pos2(40.0, 10.0), pos2(440.0, 110.0)),
            x: (12.0, 90.0),
            y: (0.0, 1.0),
            log: false,
        };
        assert!((axes.x_at(axes.screen_x(33.0)) - 33.0).abs() < 1e-4);
    }

    #[test]
    fn labels_of_small_steps_keep_their_decimals() {
        assert_eq!(labels(&[0.0, 0.05, 0.1]), vec!["0.00", "0.05", "0.10"]);
        assert_eq!(labels(&[-10.0, 0.0]), vec!["−10", "0"]);
    }
}
