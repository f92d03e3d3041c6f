//! The small picture of each stop, drawn from the run on screen.

use egui::{Align2, Color32, Painter, Pos2, Rect, Sense, Shape, Stroke, Ui, pos2, vec2};
use nalgebra::{DMatrix, Matrix2, Vector2};
use pilotage_core::filter::{chi_square_probability, chi_square_quantile};
use pilotage_core::navigator::{CandidateReport, Outcome, Run, StepReport};
use pilotage_core::sorting::sort;

use super::super::chart::ChartAxes;
use super::super::inspector::sentence::sigma;
use super::super::parts::{self, figures};
use super::super::{ellipse, picking};
use super::find::{accepted_nis, degrees_of_freedom, longest_gap};
use super::moment::TourMoment;
use super::stop::Stop;
use super::unscented;
use crate::context::ViewContext;
use crate::tokens::Tokens;

/// Least and most height of a figure, points.
const HEIGHTS: [f32; 2] = [128.0, 248.0];

/// Draws the figure of `stop` into `room` points of height, more or less; `alpha` is what the
/// slider says.
pub(super) fn draw(
    ui: &mut Ui,
    context: &ViewContext<'_>,
    stop: Stop,
    moment: &TourMoment,
    alpha: f64,
    room: f32,
) {
    let Some(run) = context.run else { return };
    let Some(step) = run.steps.get(moment.index) else {
        return;
    };
    let tokens = context.tokens;
    let height = room.clamp(HEIGHTS[0], HEIGHTS[1]);
    let (rect, response) =
        ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    parts::name(&response, format!("Figure: {}", stop.title()));
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, tokens.radius, tokens.background);
    match stop {
        Stop::FirstLandmark | Stop::Reacquired => found(&painter, rect, tokens, run, step, moment),
        Stop::Shrinking => shrinking(&painter, rect, context, step),
        Stop::Growing => growing(&painter, rect, context, run, moment),
        Stop::Gate => gate(&painter, rect, tokens, run),
        Stop::Refused => scores(&painter, rect, tokens, run, step, moment),
        Stop::Wind => wind(&painter, rect, context, run, moment),
        Stop::DeadReckoning => spread(&painter, rect, context, run),
        Stop::Alpha => bearing(&painter, rect, tokens, alpha),
        Stop::Consistency => histogram(&painter, rect, tokens, run),
        Stop::YourTurn => landmarks(&painter, rect, tokens, run),
    }
}

fn caption(
    painter: &Painter,
    tokens: &Tokens,
    at: Pos2,
    align: Align2,
    text: &str,
    color: Color32,
) {
    painter.text(at, align, text, parts::small(tokens), color);
}

/// Text rows at the left of a figure that explain its marks.
fn key(painter: &Painter, rect: Rect, tokens: &Tokens, rows: &[(&str, Color32)]) {
    for (i, (text, color)) in rows.iter().enumerate() {
        let y = rect.top() + tokens.space + i as f32 * 1.5 * tokens.text_sizes[0];
        let at = pos2(rect.left() + tokens.space, y);
        painter.circle_filled(at + vec2(3.0, 0.5 * tokens.text_sizes[0]), 3.0, *color);
        caption(
            painter,
            tokens,
            at + vec2(11.0, 0.0),
            Align2::LEFT_TOP,
            text,
            tokens.muted,
        );
    }
}

fn closed_ellipse(
    covariance: &Matrix2<f64>,
    squared_radius: f64,
    at: impl Fn(Vector2<f64>) -> Pos2,
) -> Vec<Pos2> {
    ellipse::outline(covariance, squared_radius, 64)
        .into_iter()
        .map(at)
        .collect()
}

/// Expected place, gate, and where the landmark was found, pixels.
fn found(
    painter: &Painter,
    rect: Rect,
    tokens: &Tokens,
    run: &Run,
    step: &StepReport,
    moment: &TourMoment,
) {
    let candidate = step
        .frame
        .iter()
        .flat_map(|f| &f.candidates)
        .find(|c| Some(c.landmark) == moment.landmark);
    let Some(candidate) = candidate else { return };
    let gate = ellipse::outline(&candidate.innovation_covariance, candidate.threshold, 64);
    let reach = gate
        .iter()
        .copied()
        .chain(candidate.innovation)
        .map(|v| v.amax())
        .fold(1.0, f64::max);
    let scale = f64::from(0.45 * rect.height()) / reach;
    let center = rect.center() + vec2(0.18 * rect.width(), 0.0);
    let at = |v: Vector2<f64>| center + vec2((v.x * scale) as f32, (v.y * scale) as f32);
    let outline: Vec<Pos2> = gate.into_iter().map(at).collect();
    painter.add(Shape::convex_polygon(
        outline.clone(),
        parts::ink(tokens).gamma_multiply(0.08),
        Stroke::NONE,
    ));
    painter.line(outline, Stroke::new(1.0, parts::ink(tokens)));
    painter.circle_stroke(center, 6.0, Stroke::new(1.5, parts::ink(tokens)));
    if let Some(innovation) = candidate.innovation {
        let tip = at(innovation);
        painter.line_segment([center, tip], Stroke::new(1.5, tokens.observed));
        painter.circle_filled(tip, 5.0, tokens.observed);
    }
    let name = picking::landmark_name(run, candidate.landmark);
    let size = format!("gate ± {} px", figures(reach));
    key(
        painter,
        rect,
        tokens,
        &[
            ("expected", parts::ink(tokens)),
            (&format!("{name} found"), tokens.observed),
        ],
    );
    caption(
        painter,
        tokens,
        rect.left_bottom() + vec2(tokens.space, -0.75 * tokens.space),
        Align2::LEFT_BOTTOM,
        &size,
        tokens.muted,
    );
}

/// A set of sigma points with its ellipse around `center` (north, east).
fn sigma_set(
    painter: &Painter,
    points: &DMatrix<f64>,
    covariance: &Matrix2<f64>,
    at: &dyn Fn(f64, f64) -> Pos2,
    color: Color32,
) {
    let (north, east) = (points[(0, 0)], points[(1, 0)]);
    let outline = closed_ellipse(covariance, 1.0, |v| at(north + v.x, east + v.y));
    painter.line(outline, Stroke::new(1.5, color));
    for point in points.column_iter() {
        painter.circle_filled(at(point[0], point[1]), 2.5, color);
    }
}

/// Greatest distance of a point of the set from its centre along an axis.
fn reach(points: &DMatrix<f64>) -> f64 {
    let center = points.column(0);
    points
        .column_iter()
        .map(|p| (p[0] - center[0]).abs().max((p[1] - center[1]).abs()))
        .fold(0.0, f64::max)
}

/// Sigma points before and after the correction.
fn shrinking(painter: &Painter, rect: Rect, context: &ViewContext<'_>, step: &StepReport) {
    let tokens = context.tokens;
    let before = step
        .sigma
        .before_correct
        .as_ref()
        .unwrap_or(&step.sigma.after_predict);
    let middle = rect.center() + vec2(0.18 * rect.width(), 0.0);
    let center = step.predicted.position();
    let scale = 0.42 * rect.height() / reach(before).max(0.01) as f32;
    let at = |north: f64, east: f64| {
        middle + vec2((east - center.east) as f32, (center.north - north) as f32) * scale
    };
    sigma_set(
        painter,
        before,
        &step.predicted.position_covariance(),
        &at,
        tokens.dead_reckoning,
    );
    if let Some(after) = &step.sigma.after_correct {
        sigma_set(
            painter,
            after,
            &step.after.position_covariance(),
            &at,
            tokens.corrected,
        );
    }
    if let Some(truth) = context
        .flight
        .and_then(|f| f.truth.as_ref()?.position(step.time))
    {
        painter.circle_stroke(at(truth.x, truth.y), 5.0, Stroke::new(2.0, tokens.truth));
    }
    key(
        painter,
        rect,
        tokens,
        &[
            ("before the picture", tokens.dead_reckoning),
            ("after it", tokens.corrected),
            ("truth", tokens.truth),
        ],
    );
}

/// Sigma points at four times of the gap, side by side at one scale.
fn growing(
    painter: &Painter,
    rect: Rect,
    context: &ViewContext<'_>,
    run: &Run,
    moment: &TourMoment,
) {
    let tokens = context.tokens;
    let Some(first) = run.index_at(moment.from) else {
        return;
    };
    let span = moment.index.saturating_sub(first);
    let width = 0.25 * rect.width();
    let widest = reach(&run.steps[moment.index].sigma.after_predict).max(0.01);
    let scale = 0.42 * width.min(rect.height() - 3.0 * tokens.text_sizes[0]) / widest as f32;
    for i in 0..4 {
        let step = &run.steps[first + span * i / 3];
        let middle = pos2(
            rect.left() + width * (i as f32 + 0.5),
            rect.center().y - tokens.text_sizes[0],
        );
        let points = match (&step.sigma.after_correct, i) {
            (Some(points), 0) => points,
            _ => &step.sigma.after_predict,
        };
        let (north, east) = (points[(0, 0)], points[(1, 0)]);
        let at = |n: f64, e: f64| middle + vec2((e - east) as f32, (north - n) as f32) * scale;
        let color = if i == 0 {
            tokens.corrected
        } else {
            tokens.dead_reckoning
        };
        sigma_set(
            painter,
            points,
            &step.after.position_covariance(),
            &at,
            color,
        );
        caption(
            painter,
            tokens,
            pos2(middle.x, rect.bottom() - 0.5 * tokens.space),
            Align2::CENTER_BOTTOM,
            &format!("+{:.0} s", step.time - moment.from),
            tokens.muted,
        );
    }
}

/// Every innovation of the run in units of its own σ, inside and outside the gate's circle.
fn gate(painter: &Painter, rect: Rect, tokens: &Tokens, run: &Run) {
    let all: Vec<(&CandidateReport, Vector2<f64>)> = run
        .steps
        .iter()
        .flat_map(|s| s.frame.iter().flat_map(|f| &f.candidates))
        .filter_map(|c| {
            // As far out as the NIS says, in the direction of the pixels' part of it.
            let root = c.innovation_covariance.cholesky()?.l();
            let direction = root.solve_lower_triangular(&c.innovation?)?;
            Some((c, direction * (c.nis?.sqrt() / direction.norm().max(1e-9))))
        })
        .collect();
    let radius = all.first().map_or(3.0, |(c, _)| c.threshold.sqrt());
    let scale = 0.40 * rect.height() / radius as f32;
    let center = rect.center() + vec2(0.18 * rect.width(), 0.0);
    painter.circle(
        center,
        radius as f32 * scale,
        parts::ink(tokens).gamma_multiply(0.06),
        Stroke::new(1.5, parts::ink(tokens)),
    );
    for (candidate, v) in &all {
        let most = f64::from(0.49 * rect.height() / scale);
        let v = if v.norm() > most {
            v * (most / v.norm())
        } else {
            *v
        };
        let at = center + vec2(v.x as f32, v.y as f32) * scale;
        let color = if candidate.outcome == Outcome::Accepted {
            tokens.observed
        } else {
            tokens.refused
        };
        painter.circle_filled(at, 1.75, color.gamma_multiply(0.8));
    }
    key(
        painter,
        rect,
        tokens,
        &[("used", tokens.observed), ("refused", tokens.refused)],
    );
    caption(
        painter,
        tokens,
        rect.left_bottom() + vec2(tokens.space, -0.75 * tokens.space),
        Align2::LEFT_BOTTOM,
        &format!("circle: the gate, {} σ", figures(radius)),
        tokens.muted,
    );
}

/// Score, ambiguity and NIS of the refused match as bars with their limits.
fn scores(
    painter: &Painter,
    rect: Rect,
    tokens: &Tokens,
    run: &Run,
    step: &StepReport,
    moment: &TourMoment,
) {
    let candidate = step
        .frame
        .iter()
        .flat_map(|f| &f.candidates)
        .find(|c| Some(c.landmark) == moment.landmark);
    let Some(candidate) = candidate else { return };
    let detector = run.settings.detector;
    let rows = [
        ("score", Some(candidate.score), detector.least_score, false),
        (
            "second place",
            Some(picking::ambiguity(candidate)),
            detector.greatest_ambiguity,
            true,
        ),
        ("NIS", candidate.nis, candidate.threshold, true),
    ];
    let row_height = (rect.height() - 2.0 * tokens.space) / 3.0;
    let left = rect.left() + 8.0 * tokens.text_sizes[0];
    let right = rect.right() - 4.5 * tokens.text_sizes[0];
    for (i, (name, value, limit, below)) in rows.into_iter().enumerate() {
        let y = rect.top() + tokens.space + (i as f32 + 0.5) * row_height;
        let at = pos2(rect.left() + tokens.space, y);
        caption(painter, tokens, at, Align2::LEFT_CENTER, name, tokens.muted);
        let bar = Rect::from_min_max(pos2(left, y - 3.0), pos2(right, y + 3.0));
        painter.rect_filled(bar, 3.0, tokens.line);
        let full = 2.0 * limit.max(1e-9);
        let value_at = pos2(rect.right() - tokens.space, y);
        let Some(value) = value else {
            caption(
                painter,
                tokens,
                value_at,
                Align2::RIGHT_CENTER,
                "–",
                tokens.muted,
            );
            continue;
        };
        let good = (value <= limit) == below;
        let color = if good { tokens.truth } else { tokens.refused };
        let width = bar.width() * (value / full).clamp(0.0, 1.0) as f32;
        painter.rect_filled(Rect::from_min_size(bar.min, vec2(width, 6.0)), 3.0, color);
        let limit_x = bar.left() + 0.5 * bar.width();
        painter.vline(limit_x, y - 8.0..=y + 8.0, Stroke::new(1.5, tokens.text));
        caption(
            painter,
            tokens,
            value_at,
            Align2::RIGHT_CENTER,
            &figures(value),
            color,
        );
    }
}

/// Axes over a stretch of time inside a figure.
fn time_axes(rect: Rect, tokens: &Tokens, x: (f64, f64), y: (f64, f64)) -> ChartAxes {
    let text = tokens.text_sizes[0];
    ChartAxes {
        rect: Rect::from_min_max(
            rect.min + vec2(3.2 * text, 1.8 * text),
            rect.max - vec2(tokens.space, 1.9 * text),
        ),
        x: (x.0, x.1.max(x.0 + 0.1)),
        y: (y.0, if y.1 > y.0 { y.1 } else { y.0 + 1.0 }),
        log: false,
    }
}

/// At most this many points of a curve in a figure.
const MOST_POINTS: usize = 400;

/// Every n-th step, so that a figure stays small.
fn thinned(run: &Run) -> impl Iterator<Item = &StepReport> {
    run.steps
        .iter()
        .step_by((run.steps.len() / MOST_POINTS).max(1))
}

/// Both wind components beside the truth.
fn wind(painter: &Painter, rect: Rect, context: &ViewContext<'_>, run: &Run, moment: &TourMoment) {
    let tokens = context.tokens;
    let Some((north, east)) = run
        .state_index("wind north")
        .zip(run.state_index("wind east"))
    else {
        return;
    };
    let (factor, unit) = context.units.speed();
    let truth = context.flight.and_then(|f| f.truth.as_ref());
    let values = |s: &StepReport| [factor * s.after.mean[north], factor * s.after.mean[east]];
    let extent = thinned(run)
        .flat_map(values)
        .fold((0.0_f64, 0.0_f64), |(a, b), v| (a.min(v), b.max(v)));
    let Some(span) = run.span() else { return };
    let axes = time_axes(rect, tokens, span, (extent.0 - 0.5, extent.1 + 0.5));
    axes.draw_y(painter, tokens);
    axes.draw_x(painter, tokens, "s");
    let curve = |f: &dyn Fn(&StepReport) -> Option<f64>| -> Vec<Pos2> {
        thinned(run)
            .filter_map(|s| Some(axes.at(s.time, factor * f(s)?)))
            .collect()
    };
    for (index, width) in [(north, 2.0), (east, 1.0)] {
        let estimate = curve(&|s| Some(s.after.mean[index]));
        painter.line(estimate, Stroke::new(width, tokens.corrected));
        let real = curve(&|s| {
            let wind = truth?.wind(s.time)?;
            Some(if index == north { wind.x } else { wind.y })
        });
        painter.line(real, Stroke::new(width, tokens.truth));
    }
    let stroke = Stroke::new(1.0, tokens.accent);
    painter.vline(axes.screen_x(moment.time), axes.rect.y_range(), stroke);
    let text = format!("wind, {unit}: thick north, thin east; red estimate, green truth");
    let at = rect.left_top() + vec2(tokens.space, 0.5 * tokens.space);
    caption(painter, tokens, at, Align2::LEFT_TOP, &text, tokens.muted);
}

/// The position's σ over time: a sawtooth, with the gap shaded.
fn spread(painter: &Painter, rect: Rect, context: &ViewContext<'_>, run: &Run) {
    let tokens = context.tokens;
    let (factor, unit) = context.units.length();
    let Some(span) = run.span() else { return };
    let highest = thinned(run).map(|s| sigma(&s.after)).fold(0.0, f64::max);
    let axes = time_axes(rect, tokens, span, (0.0, 1.1 * factor * highest));
    if let Some((from, to)) = longest_gap(run) {
        let x = axes.screen_x(run.steps[from].time)..=axes.screen_x(run.steps[to].time);
        let shade = Rect::from_x_y_ranges(x, axes.rect.y_range());
        painter.rect_filled(shade, 0.0, tokens.dead_reckoning.gamma_multiply(0.18));
    }
    axes.draw_y(painter, tokens);
    axes.draw_x(painter, tokens, "s");
    let curve: Vec<Pos2> = thinned(run)
        .map(|s| axes.at(s.time, factor * sigma(&s.after)))
        .collect();
    painter.line(curve, Stroke::new(1.5, tokens.text));
    let stroke = Stroke::new(1.0, tokens.accent);
    painter.vline(axes.screen_x(context.time), axes.rect.y_range(), stroke);
    let at = rect.left_top() + vec2(tokens.space, 0.5 * tokens.space);
    let text = format!("1σ of the position, {unit}; blue: no landmark");
    caption(painter, tokens, at, Align2::LEFT_TOP, &text, tokens.muted);
}

/// The unscented transform of a bearing and a range, with the spread of the slider.
fn bearing(painter: &Painter, rect: Rect, tokens: &Tokens, alpha: f64) {
    let transformed = unscented::transform(alpha);
    let scale = 0.92 * rect.height();
    let base = pos2(
        rect.center().x + 0.2 * rect.width(),
        rect.bottom() + 0.12 * rect.height(),
    );
    let at = |v: Vector2<f64>| base + vec2(v.x as f32, -v.y as f32) * scale;
    for place in unscented::cloud() {
        painter.circle_filled(at(place), 1.0, tokens.muted.gamma_multiply(0.6));
    }
    let outline = closed_ellipse(&transformed.covariance, 1.0, |v| at(transformed.mean + v));
    painter.line(outline, Stroke::new(1.5, tokens.corrected));
    for point in &transformed.points {
        painter.circle(
            at(*point),
            4.0,
            parts::ink(tokens),
            Stroke::new(1.0, tokens.background),
        );
    }
    let truth = at(unscented::true_mean());
    painter.circle_stroke(truth, 6.0, Stroke::new(2.0, tokens.truth));
    painter.circle_filled(at(transformed.mean), 3.5, tokens.corrected);
    key(
        painter,
        rect,
        tokens,
        &[
            ("what may be", tokens.muted),
            ("sigma points", parts::ink(tokens)),
            ("their mean, 1σ", tokens.corrected),
            ("true mean", tokens.truth),
        ],
    );
}

/// Draws the histogram of the NIS, beside the chi-square density with the degrees of freedom of a single
/// landmark.
fn histogram(painter: &Painter, rect: Rect, tokens: &Tokens, run: &Run) {
    const BINS: usize = 24;
    let freedom = degrees_of_freedom(run) as f64;
    let highest_nis = chi_square_quantile(0.998, freedom);
    let values = accepted_nis(run);
    let mut counts = [0_usize; BINS];
    for value in &values {
        let bin = (value / highest_nis * BINS as f64) as usize;
        counts[bin.min(BINS - 1)] += 1;
    }
    let width = highest_nis / BINS as f64;
    let density = |count: usize| count as f64 / (values.len().max(1) as f64 * width);
    let highest = counts
        .iter()
        .map(|c| density(*c))
        .fold(1.0 / freedom, f64::max);
    let axes = time_axes(rect, tokens, (0.0, highest_nis), (0.0, 1.1 * highest));
    axes.draw_x(painter, tokens, "NIS");
    for (i, count) in counts.into_iter().enumerate() {
        let bar = Rect::from_two_pos(
            axes.at(i as f64 * width, 0.0),
            axes.at((i + 1) as f64 * width, density(count)),
        );
        painter.rect_filled(
            bar.shrink2(vec2(0.5, 0.0)),
            0.0,
            tokens.observed.gamma_multiply(0.6),
        );
    }
    // The density is the slope of the probability.
    let step = highest_nis / 60.0;
    let curve: Vec<Pos2> = (0..60)
        .map(|i| {
            let x = f64::from(i) * step;
            let inside =
                chi_square_probability(x + step, freedom) - chi_square_probability(x, freedom);
            axes.at(x + 0.5 * step, inside / step)
        })
        .collect();
    painter.line(curve, Stroke::new(2.0, tokens.truth));
    let at = rect.right_top() + vec2(-tokens.space, 0.5 * tokens.space);
    let text = "blue: this run; green: an honest filter";
    caption(painter, tokens, at, Align2::RIGHT_TOP, text, tokens.muted);
}

/// Draws the numbers of uses and refusals of each landmark.
fn landmarks(painter: &Painter, rect: Rect, tokens: &Tokens, run: &Run) {
    let mut rows: Vec<(u32, usize, usize)> = Vec::new();
    for candidate in run
        .steps
        .iter()
        .flat_map(|s| s.frame.iter().flat_map(|f| &f.candidates))
    {
        let place = rows.iter().position(|r| r.0 == candidate.landmark);
        let place = place.unwrap_or_else(|| {
            rows.push((candidate.landmark, 0, 0));
            rows.len() - 1
        });
        if candidate.outcome == Outcome::Accepted {
            rows[place].1 += 1;
        } else {
            rows[place].2 += 1;
        }
    }
    sort(&mut rows, &|a, b| b.1.cmp(&a.1));
    rows.truncate(6);
    let most = rows.iter().map(|r| r.1 + r.2).max().unwrap_or(1).max(1) as f32;
    let height = (rect.height() - 2.0 * tokens.space) / rows.len().max(1) as f32;
    let left = rect.left() + 10.5 * tokens.text_sizes[0];
    let width = rect.right() - 6.0 * tokens.text_sizes[0] - left;
    for (i, (id, used, refused)) in rows.iter().enumerate() {
        let y = rect.top() + tokens.space + (i as f32 + 0.5) * height;
        let name = picking::landmark_name(run, *id);
        let at = pos2(rect.left() + tokens.space, y);
        let clip = Rect::from_min_max(rect.min, pos2(left - 4.0, rect.bottom()));
        caption(
            &painter.with_clip_rect(clip),
            tokens,
            at,
            Align2::LEFT_CENTER,
            &name,
            tokens.text,
        );
        let used_width = width * *used as f32 / most;
        let bar = Rect::from_min_size(pos2(left, y - 3.0), vec2(used_width, 6.0));
        painter.rect_filled(bar, 2.0, tokens.observed);
        let refused_width = width * *refused as f32 / most;
        let rest = Rect::from_min_size(bar.right_top(), vec2(refused_width, 6.0));
        painter.rect_filled(rest, 2.0, tokens.refused);
        let at = pos2(rect.right() - tokens.space, y);
        let text = format!("{used} / {refused}");
        caption(
            painter,
            tokens,
            at,
            Align2::RIGHT_CENTER,
            &text,
            tokens.muted,
        );
    }
}
