//! The prediction against distance: σ, corridor, limit; below, where which landmark is found.

use std::sync::Arc;

use egui::{
    Align2, Color32, Galley, Painter, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2,
    vec2,
};
use pilotage_core::landmark::Landmark;
use pilotage_core::plan::{PredictionSample, RoutePrediction};

use super::corridor_paint::kept_color;
use super::lanes::{Blip, blips};
use super::rehearsal::FlownErrors;
use super::words::{distance_text, long};
use crate::tokens::Tokens;
use crate::units::Units;
use crate::views::chart::ChartAxes;

const LEFT: f32 = 44.0;
const HEADER: f32 = 18.0;
const BOTTOM: f32 = 18.0;
const LANE: f32 = 15.0;
/// Most lanes of landmarks.
const MOST_LANES: usize = 5;

/// Content of the chart.
pub struct ChartScene<'a> {
    /// The prediction.
    pub prediction: &'a RoutePrediction,
    /// The landmarks of it.
    pub landmarks: &'a [&'a Landmark],
    /// Stretches on which the corridor reaches into no-fly areas, metres along the path.
    pub no_fly: &'a [(f64, f64)],
    /// True errors of rehearsed flights.
    pub flown: FlownErrors<'a>,
    /// The limit, metres.
    pub limit: f64,
    /// Computation under way, or fineness of the prediction, in words.
    pub state: &'a str,
    /// The look.
    pub tokens: &'a Tokens,
    /// The user's units.
    pub units: Units,
}

/// The chart's own state.
#[derive(Debug, Default)]
pub struct Chart {
    rect: Option<Rect>,
}

impl Chart {
    /// Part of the screen on which curves were drawn last.
    pub fn rect(&self) -> Option<Rect> {
        self.rect
    }

    /// Draws the chart; the distance under the pointer, metres.
    pub fn show(&mut self, ui: &mut Ui, scene: &ChartScene<'_>) -> Option<f64> {
        let (outer, response) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
        let tokens = scene.tokens;
        let samples = &scene.prediction.samples;
        let last = samples.last()?;
        let (far, far_unit) = long(scene.units, last.distance);
        let (near, near_unit) = scene.units.length();
        let painter = ui.painter_at(outer);
        let width = outer.width() - LEFT - 8.0;
        let x =
            |metres: f64| outer.left() + LEFT + (metres / last.distance.max(1e-6)) as f32 * width;
        let beside = |blip: &Blip| {
            let landmark = scene.landmarks.get(blip.landmark);
            let name = landmark.map_or("", |l| l.name.as_str());
            BlipWords::of(&painter, blip.best, name, tokens)
        };
        let bar = |blip: &Blip| {
            let [left, right] = blip.samples.map(|sample| x(samples[sample].distance));
            (left, right.max(left + 3.0))
        };
        let (blips, lanes) = blips(samples, |blip| {
            let (bar, words) = (bar(blip), beside(blip));
            let start = words.start(bar, outer.right());
            (start.min(bar.0), bar.1.max(start + words.width()) + 8.0)
        });
        let lanes = lanes.min(MOST_LANES);
        let below = BOTTOM + LANE * lanes as f32 + if lanes > 0 { 4.0 } else { 0.0 };
        let rect = Rect::from_min_max(
            outer.min + vec2(LEFT, HEADER + 6.0),
            pos2(outer.right() - 8.0, outer.bottom() - below),
        );
        if rect.height() < 24.0 || rect.width() < 80.0 {
            return None;
        }
        let top = samples.iter().map(|s| s.corridor.across);
        let least = scene.flown.largest().max(1.4 * scene.limit);
        let top = 1.08 * near * top.fold(least, f64::max);
        let axes = ChartAxes {
            rect,
            x: (0.0, last.distance * far),
            y: (0.0, top),
            log: false,
        };
        self.rect = Some(rect);
        axes.draw_y(&painter, tokens);
        let mut below = axes;
        below.rect.set_bottom(outer.bottom() - BOTTOM);
        below.draw_x(&painter, tokens, &format!("along the route, {far_unit}"));
        let clip = painter.with_clip_rect(rect);
        let at = |distance: f64, metres: f64| axes.at(distance * far, metres * near);
        paint_over(&clip, scene, &at, rect);
        scene.flown.paint_against(&clip, &axes, (far, near), tokens);
        curve(
            &clip,
            samples,
            &at,
            |s| s.corridor.across,
            Stroke::new(1.25, kept_color(tokens)),
        );
        curve(
            &clip,
            samples,
            &at,
            |s| s.corridor.sigma_major,
            Stroke::new(2.0, tokens.text),
        );
        let limit = [at(0.0, scene.limit), at(last.distance, scene.limit)];
        clip.extend(Shape::dashed_line(
            &limit,
            Stroke::new(1.5, tokens.warning),
            6.0,
            4.0,
        ));
        name_stretches(&clip, scene, &at, rect);
        header(&painter, outer, scene, near_unit);
        for blip in blips.iter().filter(|b| b.lane < lanes) {
            let y = rect.bottom() + 6.0 + LANE * (blip.lane as f32 + 0.5);
            paint_blip(&painter, samples, blip, bar(blip), y, &x, tokens);
            beside(blip).paint(&painter, bar(blip), y, tokens);
        }
        let words = format!(
            "Predicted uncertainty along {}: {}",
            distance_text(last.distance, scene.units),
            scene.state
        );
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, words.clone()));
        let pointer = response
            .hover_pos()
            .filter(|p| rect.x_range().contains(p.x))?;
        let distance = axes.x_at(pointer.x) / far;
        let sample = sample_at(samples, distance)?;
        paint_cursor(&painter, scene, sample, at(sample.distance, 0.0).x, rect);
        Some(sample.distance)
    }
}

/// The sample nearest to a distance.
pub fn sample_at(samples: &[PredictionSample], distance: f64) -> Option<&PredictionSample> {
    let away = |s: &PredictionSample| (s.distance - distance).abs();
    samples.iter().min_by(|a, b| away(a).total_cmp(&away(b)))
}

fn curve(
    painter: &Painter,
    samples: &[PredictionSample],
    at: &impl Fn(f64, f64) -> Pos2,
    of: impl Fn(&PredictionSample) -> f64,
    stroke: Stroke,
) {
    let line = samples.iter().map(|s| at(s.distance, of(s))).collect();
    painter.add(Shape::line(line, stroke));
}

/// Shades the stretches over the limit.
fn paint_over(
    painter: &Painter,
    scene: &ChartScene<'_>,
    at: &impl Fn(f64, f64) -> Pos2,
    rect: Rect,
) {
    for (begin, end) in scene.no_fly {
        let (left, right) = (at(*begin, 0.0).x, at(*end, 0.0).x);
        let shade = Rect::from_x_y_ranges(left..=right.max(left + 2.0), rect.y_range());
        painter.rect_filled(shade, 0.0, scene.tokens.no_fly.gamma_multiply(0.22));
    }
    for stretch in &scene.prediction.over_limit {
        let (left, right) = (at(stretch.begin, 0.0).x, at(stretch.end, 0.0).x);
        let shade = Rect::from_x_y_ranges(left..=right.max(left + 2.0), rect.y_range());
        painter.rect_filled(shade, 0.0, scene.tokens.warning.gamma_multiply(0.14));
    }
}

/// Distance by which words are moved to the right so that they stand within a stretch, or beside it where it is narrower
/// than they are: behind it, or before it where the chart ends.
fn beside((left, right): (f32, f32), words: egui::Rangef, chart: egui::Rangef) -> f32 {
    if words.span() < right - left {
        return 0.0;
    }
    let behind = right + 6.0 - words.min;
    if words.max + behind <= chart.max {
        behind
    } else {
        left - 6.0 - words.max
    }
}

/// Says at the shaded stretches why they are shaded, over the curves; the longest are named first, and no two words meet.
fn name_stretches(
    painter: &Painter,
    scene: &ChartScene<'_>,
    at: &impl Fn(f64, f64) -> Pos2,
    rect: Rect,
) {
    let tokens = scene.tokens;
    let mut taken = Vec::new();
    let mut write = |[begin, end]: [f64; 2], text: String, color: Color32, align: Align2| {
        let [left, right] = [begin, end].map(|it| at(it, 0.0).x);
        let galley = painter.layout_no_wrap(text, tokens.small(), color);
        let y = align.pos_in_rect(&rect.shrink(4.0)).y;
        let words = align.anchor_size(pos2(0.5 * (left + right), y), galley.size());
        let words = words.translate(vec2(
            beside((left, right), words.x_range(), rect.x_range()),
            0.0,
        ));
        if taken.iter().any(|other: &Rect| other.intersects(words)) {
            return;
        }
        painter.rect_filled(
            words.expand(2.0),
            tokens.radius,
            tokens.surface.gamma_multiply(0.7),
        );
        painter.galley(words.min, galley, color);
        taken.push(words.expand(4.0));
    };
    for &(begin, end) in scene.no_fly {
        let text = "no-fly area".to_owned();
        write([begin, end], text, tokens.no_fly, Align2::CENTER_BOTTOM);
    }
    let mut over: Vec<_> = scene.prediction.over_limit.iter().collect();
    over.sort_by(|a, b| (b.end - b.begin).total_cmp(&(a.end - a.begin)));
    for stretch in over {
        let length = distance_text(stretch.end - stretch.begin, scene.units);
        let text = format!("over the limit for {length}");
        let ends = [stretch.begin, stretch.end];
        write(ends, text, tokens.warning, Align2::CENTER_TOP);
    }
}

/// The limit in words, with the digits that sentences beside the chart have.
fn limit_words(metres: f64, units: Units) -> String {
    format!("limit {}", units.short(metres))
}

fn header(painter: &Painter, outer: Rect, scene: &ChartScene<'_>, unit: &str) {
    let tokens = scene.tokens;
    let y = outer.top() + 0.5 * HEADER;
    let name = format!("error, {unit}");
    let at = pos2(outer.left() + 4.0, y);
    let (align, font) = (Align2::LEFT_CENTER, tokens.small());
    let name = painter.text(at, align, name, font, tokens.muted);
    let mut x = name.right() + 20.0;
    let limit = limit_words(scene.limit, scene.units);
    let mut entries: Vec<(&str, Color32, f32, bool)> = vec![
        ("1σ, longer axis", tokens.text, 2.0, false),
        ("95 % corridor, half width", kept_color(tokens), 1.25, false),
        (&limit, tokens.warning, 1.5, true),
    ];
    if scene.flown.count() > 0 {
        entries.push(("true errors beside the path", tokens.truth, 1.0, false));
    }
    // Beside the choice of charts.
    let end = outer.right() - 180.0;
    let laid = |text: &str| {
        let text = text.to_owned();
        painter.layout_no_wrap(text, tokens.small(), tokens.muted)
    };
    for (text, color, width, dashed) in entries {
        let galley = laid(text);
        if x + 24.0 + galley.size().x > end {
            return;
        }
        let ends = [pos2(x, y), pos2(x + 18.0, y)];
        let stroke = Stroke::new(width, color);
        if dashed {
            painter.extend(Shape::dashed_line(&ends, stroke, 5.0, 3.0));
        } else {
            painter.line_segment(ends, stroke);
        }
        let place = pos2(x + 24.0, y);
        let drawn = Align2::LEFT_CENTER.anchor_size(place, galley.size());
        painter.galley(drawn.min, galley, tokens.muted);
        x = drawn.right() + 20.0;
    }
    let galley = laid(scene.state);
    let place = Align2::RIGHT_CENTER.anchor_size(pos2(end, y), galley.size());
    if place.left() > x {
        painter.galley(place.min, galley, tokens.muted);
    }
}

/// A bar as high as the probability in each frame.
fn paint_blip(
    painter: &Painter,
    samples: &[PredictionSample],
    blip: &Blip,
    (left, right): (f32, f32),
    y: f32,
    x: &impl Fn(f64) -> f32,
    tokens: &Tokens,
) {
    let [first, last] = blip.samples;
    let base = y + 0.4 * LANE;
    let mut mesh = egui::epaint::Mesh::default();
    let color = tokens.observed;
    for pair in samples[first..=last].windows(2) {
        let corner = |s: &PredictionSample| {
            let height = 0.8 * LANE * s.detection[blip.landmark] as f32;
            [
                pos2(x(s.distance), base),
                pos2(x(s.distance), base - height.max(1.0)),
            ]
        };
        let ([a, b], [d, c]) = (corner(&pair[0]), corner(&pair[1]));
        let begin = mesh.vertices.len() as u32;
        for p in [a, b, c, d] {
            mesh.colored_vertex(p, color);
        }
        mesh.add_triangle(begin, begin + 1, begin + 2);
        mesh.add_triangle(begin, begin + 2, begin + 3);
    }
    painter.add(Shape::mesh(mesh));
    painter.hline(left..=right, base, Stroke::new(1.0, color));
}

/// Words beside the bar of a landmark that is in view: its name and the greatest probability, said as what it is, a share
/// of the simulated flights. In tests of the landmark another share may be found: those look at it from other places.
struct BlipWords {
    name: Arc<Galley>,
    best: Arc<Galley>,
}

impl BlipWords {
    /// Points between the bar, the name and what is said of it.
    const GAP: f32 = 5.0;

    /// Of a landmark called `name` that is found in `best` of flights at the most.
    fn of(painter: &Painter, best: f64, name: &str, tokens: &Tokens) -> Self {
        let lay = |text: String, color| painter.layout_no_wrap(text, tokens.small(), color);
        let best = format!("up to {:.0} % of flights", 100.0 * best);
        Self {
            name: lay(name.to_owned(), tokens.text),
            best: lay(best, tokens.muted),
        }
    }

    fn width(&self) -> f32 {
        self.name.size().x + Self::GAP + self.best.size().x
    }

    /// Left end of the words: behind the bar, or before it where there is no room up to `end`.
    fn start(&self, (left, right): (f32, f32), end: f32) -> f32 {
        let behind = right + Self::GAP;
        if behind + self.width() <= end {
            behind
        } else {
            left - Self::GAP - self.width()
        }
    }

    fn paint(self, painter: &Painter, bar: (f32, f32), y: f32, tokens: &Tokens) {
        let start = self.start(bar, painter.clip_rect().right());
        let top = y - 0.5 * self.name.size().y;
        let then = pos2(start + self.name.size().x + Self::GAP, top);
        painter.galley(pos2(start, top), self.name, tokens.text);
        painter.galley(then, self.best, tokens.muted);
    }
}

fn paint_cursor(
    painter: &Painter,
    scene: &ChartScene<'_>,
    sample: &PredictionSample,
    x: f32,
    rect: Rect,
) {
    let tokens = scene.tokens;
    painter.vline(x, rect.y_range(), Stroke::new(1.0, tokens.text));
    let text = format!(
        "{}   error {} (1σ)   corridor ±{}   {:.0} s since a likely fix",
        distance_text(sample.distance, scene.units),
        scene.units.short(sample.corridor.sigma_major),
        scene.units.short(sample.corridor.across),
        sample.dead_reckoning
    );
    let galley = painter.layout_no_wrap(text, tokens.small(), tokens.text);
    let size = galley.size() + vec2(12.0, 6.0);
    let left = (x + 8.0).min(rect.right() - size.x);
    let card = Rect::from_min_size(pos2(left, rect.top() + 2.0), size);
    painter.rect_filled(card, tokens.radius, tokens.raised);
    painter.galley(card.min + vec2(6.0, 3.0), galley, tokens.text);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limit_has_a_decimal_as_in_the_sentences_beside() {
        assert_eq!(limit_words(7.3, Units::Metric), "limit 7.3 m");
        assert_eq!(limit_words(25.0, Units::Metric), "limit 25 m");
        assert_eq!(limit_words(7.62, Units::Aviation), "limit 25 ft");
    }

    #[test]
    fn words_of_a_narrow_stretch_stand_behind_it_or_before_it_where_the_chart_ends() {
        let chart = egui::Rangef::new(40.0, 640.0);
        let middle = |left: f32, right: f32| {
            let center = 0.5 * (left + right);
            egui::Rangef::new(center - 50.0, center + 50.0)
        };
        let placed = |left: f32, right: f32| {
            let words = middle(left, right);
            words.min + beside((left, right), words, chart)
        };
        assert_eq!(placed(100.0, 300.0), 150.0, "within");
        assert_eq!(placed(60.0, 90.0), 96.0, "behind");
        assert_eq!(placed(600.0, 630.0), 494.0, "before");
    }
}
