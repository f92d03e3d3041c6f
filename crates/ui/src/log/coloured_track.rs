//! The recorded track coloured by a field of its log, and the scale of the colours.

use egui::{Align2, Color32, Painter, Rect, Shape, Stroke, pos2, vec2};
use pilotage_core::flight::Truth;
use pilotage_core::frames::GroundPoint;

use super::words::figure;
use super::{PlottedSeries, series_name};
use crate::map::ScreenFromWorld;
use crate::tokens::Tokens;
use crate::views::color_map::viridis;
use crate::views::parts;
use pilotage_jobs::SeriesName;

/// Pieces that a track is drawn in at most.
const MOST_PIECES: usize = 3000;
/// Size of the scale, points.
const SCALE: egui::Vec2 = vec2(160.0, 10.0);

/// The field by which the track is coloured.
pub(super) struct ColouredTrack<'a> {
    /// Name of the field.
    pub name: &'a SeriesName,
    /// Its values.
    pub series: &'a PlottedSeries,
}

impl ColouredTrack<'_> {
    /// Least and greatest value over the whole log.
    fn range(&self) -> Option<(f64, f64)> {
        let values = self.series.values();
        let extent = values.extent(0, values.len())?;
        let base = self.series.base;
        Some((base + f64::from(extent.low), base + f64::from(extent.high)))
    }

    /// Colour of a value.
    fn colour(&self, (low, high): (f64, f64), time: f64, tokens: &Tokens) -> Color32 {
        let share = |value: f64| ((value - low) / (high - low).max(1e-12)) as f32;
        self.series
            .at(time)
            .map_or(tokens.muted, |v| viridis(share(v)))
    }

    /// Draws the track.
    pub fn paint(&self, painter: &Painter, view: &ScreenFromWorld, truth: &Truth, tokens: &Tokens) {
        let Some(range) = self.range() else { return };
        let step = truth.states.len().div_ceil(MOST_PIECES).max(1);
        let place = |i: usize| {
            let p = truth.states[i].position;
            view.apply(&GroundPoint::new(p.x, p.y))
        };
        let mut shapes = Vec::new();
        for from in (0..truth.states.len()).step_by(step) {
            let to = (from + step).min(truth.states.len() - 1);
            let colour = self.colour(range, truth.states[from].time, tokens);
            shapes.push(Shape::line_segment(
                [place(from), place(to)],
                Stroke::new(3.0, colour),
            ));
        }
        painter.extend(shapes);
    }

    /// Draws the scale with its left top corner at `corner`; what it covers.
    pub fn paint_scale(
        &self,
        painter: &Painter,
        corner: egui::Pos2,
        tokens: &Tokens,
    ) -> Option<Rect> {
        let (low, high) = self.range()?;
        let text = tokens.text_sizes[0];
        let size = vec2(SCALE.x + 24.0, SCALE.y + 2.0 * text + 22.0);
        let card = Rect::from_min_size(corner, size);
        painter.rect_filled(card, tokens.radius, tokens.over_map());
        let title = series_name(self.name);
        let unit = &self.series.unit;
        let title = if unit.is_empty() {
            title
        } else {
            format!("{title}, {unit}")
        };
        let at = corner + vec2(12.0, 6.0);
        painter.text(
            at,
            Align2::LEFT_TOP,
            title,
            parts::small(tokens),
            tokens.text,
        );
        let bar = Rect::from_min_size(at + vec2(0.0, text + 6.0), SCALE);
        let steps = 32;
        let width = bar.width() / steps as f32;
        for i in 0..steps {
            let left = pos2(bar.left() + i as f32 * width, bar.top());
            let piece = Rect::from_min_size(left, vec2(width + 0.5, bar.height()));
            painter.rect_filled(piece, 0.0, viridis(i as f32 / (steps - 1) as f32));
        }
        let below = bar.bottom() + 3.0;
        for (x, anchor, value) in [
            (bar.left(), Align2::LEFT_TOP, low),
            (bar.right(), Align2::RIGHT_TOP, high),
        ] {
            let text = figure(value);
            painter.text(
                pos2(x, below),
                anchor,
                text,
                parts::small(tokens),
                tokens.muted,
            );
        }
        Some(card)
    }
}
