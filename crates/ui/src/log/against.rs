//! Fields of a panel against another field, over the time that is shown.

use egui::{Align2, Color32, Painter, Pos2, Rect, Response, Shape, Stroke};

use super::PlottedSeries;
use super::cloud::{CloudKey, PixelCloud};
use super::pairs::{LastPair, Pairs};
use super::scene::{PanelScene, colour, curve, nothing, wider};
use super::words::series_name;
use crate::command::Command;
use crate::context::ViewContext;
use crate::still::Still;
use crate::tokens::Tokens;
use crate::views::chart::ChartAxes;
use crate::views::{TimeAxis, parts};
use pilotage_jobs::SeriesName;

/// Points that are drawn as lines and dots; more become pixels.
const MOST_DRAWN: usize = 20_000;
/// Points looked at to find the one under the pointer, before its neighbours are.
const LOOKED_AT: usize = 20_000;
/// Largest distance of a pointer from a point that it picks, points of the screen.
const REACH: f32 = 16.0;

/// Drawn points of a plot against a field.
#[derive(Default)]
pub(super) struct AgainstPlot {
    cloud: PixelCloud,
    drawn: Still<CloudKey>,
}

/// Scene of a plot against a field.
pub(super) struct AgainstScene<'a> {
    pub panel: &'a PanelScene<'a>,
    pub fields: &'a [SeriesName],
    pub against: &'a SeriesName,
    pub joined: bool,
}

impl<'a> AgainstScene<'a> {
    /// The fields that have come, with their places among the colours.
    pub fn pairs(&self) -> Option<Vec<(usize, Pairs<'a>)>> {
        let series = |name: &SeriesName| {
            let found = self.panel.log.series.get(name);
            found.filter(|series| series.is_whole() && series.lacks.is_none())
        };
        let x = series(self.against)?;
        let of = |(i, field)| {
            Some((
                i,
                Pairs {
                    x,
                    y: series(field)?,
                },
            ))
        };
        Some(self.fields.iter().enumerate().filter_map(of).collect())
    }
}

/// Axes of the points: above the labels of the axis below.
pub(super) fn axes(
    outer: Rect,
    tokens: &Tokens,
    span: (f64, f64),
    pairs: &[(usize, Pairs<'_>)],
) -> Option<ChartAxes> {
    let mut rect = TimeAxis::curves_rect(outer, tokens);
    rect.set_bottom(rect.bottom() - TimeAxis::height(tokens));
    let over_time = ChartAxes {
        rect,
        x: span,
        y: (0.0, 1.0),
        log: false,
    };
    let extent = |series: &PlottedSeries| {
        let (low, high) = curve(series).extent(&over_time)?;
        Some((low + series.base, high + series.base))
    };
    let join = |a: (f64, f64), b: (f64, f64)| (a.0.min(b.0), a.1.max(b.1));
    let x = pairs.first().and_then(|(_, pairs)| extent(pairs.x))?;
    let y = pairs.iter().filter_map(|(_, pairs)| extent(pairs.y));
    let y = y.reduce(join)?;
    Some(ChartAxes {
        x: wider(x.0, x.1),
        y: wider(y.0, y.1),
        ..over_time
    })
}

impl AgainstPlot {
    /// Draws the fields into `response`; the time of the point under the pointer, if any.
    pub fn show(
        &mut self,
        painter: &Painter,
        context: &mut ViewContext<'_>,
        scene: &AgainstScene<'_>,
        response: &Response,
    ) -> Option<f64> {
        let tokens = context.tokens;
        let pairs = scene.pairs().unwrap_or_default();
        let span = scene.panel.span;
        let Some(axes) = axes(response.rect, tokens, span, &pairs) else {
            let fields = scene.fields.iter().chain([scene.against]);
            let words = nothing(scene.panel.log, fields);
            let middle = response.rect.center();
            let font = parts::small(tokens);
            painter.text(middle, Align2::CENTER_CENTER, words, font, tokens.muted);
            return None;
        };
        painter.rect_filled(axes.rect, 2.0, tokens.background);
        axes.draw_y(painter, tokens);
        axes.draw_x(painter, tokens, &x_name(scene));
        let inside = painter.with_clip_rect(axes.rect);
        self.points(&inside, scene, &pairs, axes, tokens);
        let over = nearest(&pairs, &axes, span, response.hover_pos());
        if let Some(time) = over {
            if response.clicked() || response.dragged() {
                context.commands.push(Command::SeekTo(time));
            }
            marks(&inside, &pairs, &axes, time, tokens.muted);
        } else if let Some(time) = scene.panel.hover {
            marks(&inside, &pairs, &axes, time, tokens.muted);
        }
        marks(&inside, &pairs, &axes, context.time, tokens.accent);
        over
    }

    /// The points: few are drawn, many become pixels.
    fn points(
        &mut self,
        painter: &Painter,
        scene: &AgainstScene<'_>,
        pairs: &[(usize, Pairs<'_>)],
        axes: ChartAxes,
        tokens: &Tokens,
    ) {
        let span = scene.panel.span;
        let mut fields = scene.fields.to_vec();
        fields.push(scene.against.clone());
        let key = CloudKey {
            revision: scene.panel.log.revision,
            axes,
            span,
            fields,
            joined: scene.joined,
            is_dark: tokens.dark,
        };
        let count: usize = pairs
            .iter()
            .map(|(_, pairs)| pairs.within(span).len())
            .sum();
        if count <= MOST_DRAWN {
            self.drawn.paint(painter, key, |shapes| {
                for (i, pairs) in pairs {
                    draw(shapes, pairs, &axes, span, scene.joined, colour(tokens, *i));
                }
            });
            return;
        }
        let only: Vec<Pairs<'_>> = pairs.iter().map(|(_, pairs)| *pairs).collect();
        if self.cloud.follow(&key, &only) {
            painter.ctx().request_repaint();
        }
        let colours: Vec<Color32> = pairs.iter().map(|(i, _)| colour(tokens, *i)).collect();
        self.cloud.paint(painter, &colours);
    }
}

/// Whether so many points are pixels, not shapes.
pub(super) fn is_cloud(pairs: &[(usize, Pairs<'_>)], span: (f64, f64)) -> bool {
    let count: usize = pairs
        .iter()
        .map(|(_, pairs)| pairs.within(span).len())
        .sum();
    count > MOST_DRAWN
}

/// Name and unit of the axis below.
pub(super) fn x_name(scene: &AgainstScene<'_>) -> String {
    let unit = scene.panel.log.series.get(scene.against);
    let unit = unit.map_or("", |series| series.unit.as_str());
    let name = series_name(scene.against);
    if unit.is_empty() {
        name
    } else {
        format!("{name}, {unit}")
    }
}

/// The unbroken parts of a plot, on screen.
pub(super) fn lines(pairs: &Pairs<'_>, axes: &ChartAxes, span: (f64, f64)) -> Vec<Vec<Pos2>> {
    let mut lines = vec![Vec::new()];
    let mut place = LastPair::default();
    for index in pairs.within(span) {
        match (pairs.at(index, &mut place), lines.last_mut()) {
            (Some((x, y)), Some(line)) => line.push(axes.at(x, y)),
            (None, Some(line)) if !line.is_empty() => lines.push(Vec::new()),
            _ => {}
        }
    }
    lines.retain(|line| !line.is_empty());
    lines
}

fn draw(
    shapes: &mut Vec<Shape>,
    pairs: &Pairs<'_>,
    axes: &ChartAxes,
    span: (f64, f64),
    joined: bool,
    colour: Color32,
) {
    for line in lines(pairs, axes, span) {
        if joined && line.len() > 1 {
            shapes.push(Shape::line(line, Stroke::new(1.25, colour)));
            continue;
        }
        let dot = |at: Pos2| Shape::circle_filled(at, 1.5, colour);
        shapes.extend(line.into_iter().map(dot));
    }
}

/// A ring where each field is at a time.
fn marks(
    painter: &Painter,
    pairs: &[(usize, Pairs<'_>)],
    axes: &ChartAxes,
    time: f64,
    colour: Color32,
) {
    for (_, pairs) in pairs {
        if let Some((x, y)) = pairs.before(time) {
            let at = axes.at(x, y);
            painter.circle_filled(at, 3.5, colour);
            painter.circle_stroke(at, 5.5, Stroke::new(1.0, colour));
        }
    }
}

/// Time of the point under the pointer.
fn nearest(
    pairs: &[(usize, Pairs<'_>)],
    axes: &ChartAxes,
    span: (f64, f64),
    pointer: Option<Pos2>,
) -> Option<f64> {
    let pointer = pointer.filter(|at| axes.rect.contains(*at))?;
    let mut best: Option<(f32, f64)> = None;
    for (_, pairs) in pairs {
        let within = pairs.within(span);
        let stride = within.len().div_ceil(LOOKED_AT).max(1);
        let mut place = LastPair::default();
        let mut distance = |index: usize| {
            let (x, y) = pairs.at(index, &mut place)?;
            Some(axes.at(x, y).distance(pointer))
        };
        let mut nearest: Option<(f32, usize)> = None;
        let mut look = |index: usize| {
            if let Some(distance) = distance(index)
                && nearest.is_none_or(|(least, _)| distance < least)
            {
                nearest = Some((distance, index));
            }
            nearest
        };
        let rough = within
            .clone()
            .step_by(stride)
            .fold(None, |_, index| look(index));
        let Some((_, index)) = rough else { continue };
        let around =
            index.saturating_sub(stride).max(within.start)..(index + stride).min(within.end);
        let fine = around.fold(rough, |_, index| look(index));
        if let Some((distance, index)) = fine
            && best.is_none_or(|(least, _)| distance < least)
        {
            best = Some((distance, pairs.y.times[index]));
        }
    }
    best.filter(|(distance, _)| *distance <= REACH)
        .map(|(_, time)| time)
}

#[cfg(test)]
mod tests {
    use super::super::pairs::tests::field;
    use super::*;
    use egui::pos2;

    #[test]
    fn the_point_under_the_pointer_is_found_among_millions() {
        let count = 1_000_000;
        let turn = |i: i32| f64::from(i) / f64::from(count) * std::f64::consts::TAU;
        let x = field((0..count).map(|i| (f64::from(i), turn(i).cos())));
        let y = field((0..count).map(|i| (f64::from(i), turn(i).sin())));
        let pairs = [(0, Pairs { x: &x, y: &y })];
        let axes = ChartAxes {
            rect: Rect::from_min_max(pos2(0.0, 0.0), pos2(200.0, 200.0)),
            x: (-1.0, 1.0),
            y: (-1.0, 1.0),
            log: false,
        };
        let span = (0.0, 1e9);
        let top = nearest(&pairs, &axes, span, Some(pos2(100.0, 3.0)));
        let quarter = f64::from(count) / 4.0;
        assert!((top.unwrap() - quarter).abs() < 0.01 * quarter, "{top:?}");
        assert_eq!(nearest(&pairs, &axes, span, Some(pos2(100.0, 100.0))), None);
    }
}
