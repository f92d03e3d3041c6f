//! Routes and the predicted corridor on the map.

use egui::epaint::{Mesh, Vertex, WHITE_UV};
use egui::{Align2, Color32, Painter, Pos2, Shape, Stroke, vec2};
use pilotage_core::frames::GroundPoint;
use pilotage_core::mission::turn::Turn;
use pilotage_core::mission::{Mission, Route, WayPointAction};
use pilotage_core::plan::{Prediction, PredictionSample};

use super::aircraft::{radius_at, tight_legs};
use super::chart::sample_at;
use super::planner::Planner;
use super::tool::{Hit, PlanTool, middles};
use crate::map::{ScreenFromWorld, ellipse, paint_halo_text};
use crate::tokens::Tokens;

/// Distance between ellipses along the path, points.
const ELLIPSE_SPACING: f32 = 96.0;

/// The corridor's colour where the limit is kept.
pub fn kept_color(tokens: &Tokens) -> Color32 {
    tokens.observed
}

/// The two edges of the corridor at a sample.
fn edges(sample: &PredictionSample) -> [GroundPoint; 2] {
    let (sin, cos) = sample.course.sin_cos();
    let half = sample.corridor.across;
    let p = sample.position;
    [-half, half].map(|half| GroundPoint::new(p.north - half * sin, p.east + half * cos))
}

impl Planner {
    /// Draws the predicted corridor, and the place that the pointer is at in the chart.
    pub(crate) fn paint_corridor(
        &self,
        painter: &Painter,
        view: &ScreenFromWorld,
        tokens: &Tokens,
    ) {
        let Some(shown) = self.forecast.shown() else {
            return;
        };
        paint_corridor(
            painter,
            view,
            &shown.prediction,
            self.preferences.limit,
            tokens,
        );
        let hovered = self.hovered;
        let sample = hovered.and_then(|d| sample_at(&shown.prediction.samples, d));
        if let Some(sample) = sample {
            paint_hovered(painter, view, sample, tokens);
        }
    }

    /// Draws the routes.
    pub(crate) fn paint_routes(
        &self,
        painter: &Painter,
        view: &ScreenFromWorld,
        mission: &Mission,
        tool: &PlanTool,
        tokens: &Tokens,
    ) {
        paint_routes(painter, view, mission, self, tool, tokens);
        if let Some(marking) = &self.marking {
            marking.paint(painter, view, tool.pointer, tokens);
        }
    }
}

/// A band along the flown path, as wide as the 95 % corridor.
pub(super) fn corridor_band(
    view: &ScreenFromWorld,
    prediction: &Prediction,
    color: Color32,
) -> Shape {
    let mut mesh = Mesh::default();
    for pair in prediction.samples.windows(2) {
        let [a, b] = [&pair[0], &pair[1]].map(|s| edges(s).map(|p| view.apply(&p)));
        let first = mesh.vertices.len() as u32;
        for pos in [a[0], a[1], b[1], b[0]] {
            let uv = WHITE_UV;
            mesh.vertices.push(Vertex { pos, uv, color });
        }
        mesh.add_triangle(first, first + 1, first + 2);
        mesh.add_triangle(first, first + 2, first + 3);
    }
    Shape::mesh(mesh)
}

/// Draws the 95 % corridor along the flown path: a band, its edges, and ellipses at intervals.
fn paint_corridor(
    painter: &Painter,
    view: &ScreenFromWorld,
    prediction: &Prediction,
    limit: f64,
    tokens: &Tokens,
) {
    let over = |s: &PredictionSample| s.corridor.sigma_major > limit;
    let color = |over: bool| {
        if over {
            tokens.warning
        } else {
            kept_color(tokens)
        }
    };
    let samples = &prediction.samples;
    let sides: Vec<[Pos2; 2]> = samples
        .iter()
        .map(|s| edges(s).map(|p| view.apply(&p)))
        .collect();
    let mut mesh = Mesh::default();
    for (pair, of) in sides.windows(2).zip(samples.windows(2)) {
        let fill = color(over(&of[1])).gamma_multiply(0.26);
        let first = mesh.vertices.len() as u32;
        for pos in [pair[0][0], pair[0][1], pair[1][1], pair[1][0]] {
            mesh.vertices.push(Vertex {
                pos,
                uv: WHITE_UV,
                color: fill,
            });
        }
        mesh.add_triangle(first, first + 1, first + 2);
        mesh.add_triangle(first, first + 2, first + 3);
    }
    painter.add(Shape::mesh(mesh));
    let mut begin = 0;
    for run in samples.chunk_by(|a, b| over(a) == over(b)) {
        let end = (begin + run.len() + 1).min(samples.len());
        let bad = over(&run[0]);
        for side in 0..2 {
            let line: Vec<Pos2> = sides[begin..end].iter().map(|s| s[side]).collect();
            if bad {
                let stroke = Stroke::new(2.0, color(bad));
                painter.extend(Shape::dashed_line(&line, stroke, 6.0, 4.0));
            } else {
                painter.add(Shape::line(line, Stroke::new(1.25, color(bad))));
            }
        }
        begin += run.len();
    }
    let mut last: Option<Pos2> = None;
    for sample in samples {
        let at = view.apply(&sample.position);
        if last.is_some_and(|last| last.distance(at) < ELLIPSE_SPACING) {
            continue;
        }
        last = Some(at);
        let c = &sample.corridor;
        if let Some(points) = ellipse(view, &sample.position, &c.covariance, c.scale) {
            let stroke = Stroke::new(1.0, color(over(sample)).gamma_multiply(0.8));
            painter.add(Shape::closed_line(points, stroke));
        }
    }
}

/// Marks the place on the map that the pointer is at in the chart.
fn paint_hovered(
    painter: &Painter,
    view: &ScreenFromWorld,
    sample: &PredictionSample,
    tokens: &Tokens,
) {
    let at = view.apply(&sample.position);
    let c = &sample.corridor;
    if let Some(points) = ellipse(view, &sample.position, &c.covariance, c.scale) {
        painter.add(Shape::closed_line(
            points.clone(),
            Stroke::new(4.0, tokens.outline()),
        ));
        painter.add(Shape::closed_line(points, Stroke::new(2.0, tokens.sigma)));
    }
    painter.circle(at, 5.0, tokens.sigma, Stroke::new(1.5, tokens.outline()));
}

/// Draws all routes; the selected one with its way-points.
fn paint_routes(
    painter: &Painter,
    view: &ScreenFromWorld,
    mission: &Mission,
    planner: &Planner,
    tool: &PlanTool,
    tokens: &Tokens,
) {
    for route in mission
        .routes
        .iter()
        .filter(|r| Some(r.id) != planner.route)
    {
        let line = screen_line(route, view);
        let strong = tool.hovered == Some(Hit::Route(route.id));
        let color = if strong { tokens.text } else { tokens.ghost };
        painter.add(Shape::line(
            line.clone(),
            Stroke::new(4.0, tokens.outline()),
        ));
        painter.add(Shape::line(line.clone(), Stroke::new(2.0, color)));
        if let Some(first) = line.first() {
            let at = *first + vec2(0.0, -8.0);
            let font = tokens.small();
            paint_halo_text(painter, at, Align2::CENTER_BOTTOM, &route.name, font, color);
        }
    }
    if let Some(route) = planner.selected(mission) {
        paint_selected(painter, view, route, planner, tool, tokens);
    }
}

fn screen_line(route: &Route, view: &ScreenFromWorld) -> Vec<Pos2> {
    let places = route.way_points.iter();
    places.map(|w| view.apply(&w.position)).collect()
}

fn paint_selected(
    painter: &Painter,
    view: &ScreenFromWorld,
    route: &Route,
    planner: &Planner,
    tool: &PlanTool,
    tokens: &Tokens,
) {
    let line = screen_line(route, view);
    if let (Some(last), Some(pointer)) = (line.last(), tool.pointer) {
        let next = [*last, view.apply(&pointer)];
        let stroke = Stroke::new(2.0, tokens.accent);
        painter.extend(Shape::dashed_line(&next, stroke, 6.0, 5.0));
    }
    painter.add(Shape::line(
        line.clone(),
        Stroke::new(5.0, tokens.outline()),
    ));
    painter.add(Shape::line(line.clone(), Stroke::new(2.5, tokens.accent)));
    for pair in line.windows(2) {
        paint_arrow(painter, pair[0], pair[1], tokens);
    }
    if !planner.drawing {
        for (index, at) in middles(route, view) {
            let hovered = tool.hovered == Some(Hit::Middle(index));
            let radius = if hovered { 7.0 } else { 4.0 };
            let edge = Stroke::new(1.5, tokens.accent);
            painter.circle(at, radius, tokens.background, edge);
            if hovered {
                let plus = Stroke::new(1.5, tokens.accent);
                painter.line_segment([at - vec2(3.5, 0.0), at + vec2(3.5, 0.0)], plus);
                painter.line_segment([at - vec2(0.0, 3.5), at + vec2(0.0, 3.5)], plus);
            }
        }
    }
    paint_turns(painter, view, route, planner, tokens);
    for (index, (way_point, at)) in route.way_points.iter().zip(&line).enumerate() {
        let selected = planner.way_point == Some(index);
        let hovered = tool.hovered == Some(Hit::WayPoint(index));
        paint_way_point(painter, *at, index + 1, selected, hovered, tokens);
        if let WayPointAction::Loiter { radius, .. } = way_point.action {
            let stroke = Stroke::new(1.5, tokens.accent);
            painter.circle_stroke(*at, view.points(radius.abs()), stroke);
        }
    }
}

/// Draws the arcs of the turns, and the legs that are too short for theirs.
fn paint_turns(
    painter: &Painter,
    view: &ScreenFromWorld,
    route: &Route,
    planner: &Planner,
    tokens: &Tokens,
) {
    let bank = planner.preferences.bank;
    let place = |i: usize| route.way_points[i].position;
    for i in 1..route.way_points.len().saturating_sub(1) {
        let radius = radius_at(route, i, bank);
        let turn = Turn::at(&place(i - 1), &place(i), &place(i + 1), radius);
        let Some(turn) = turn.filter(|t| view.points(t.lead) > 6.0) else {
            continue;
        };
        let arc: Vec<Pos2> = turn.places().iter().map(|p| view.apply(p)).collect();
        painter.add(Shape::line(arc.clone(), Stroke::new(3.5, tokens.outline())));
        painter.add(Shape::line(arc, Stroke::new(1.5, tokens.accent)));
    }
    for index in tight_legs(route, bank) {
        let ends = [view.apply(&place(index - 1)), view.apply(&place(index))];
        painter.extend(Shape::dashed_line(
            &ends,
            Stroke::new(2.5, tokens.warning),
            6.0,
            6.0,
        ));
    }
}

fn paint_way_point(
    painter: &Painter,
    at: Pos2,
    number: usize,
    selected: bool,
    hovered: bool,
    tokens: &Tokens,
) {
    let (fill, ink) = if selected {
        (tokens.accent, Color32::BLACK)
    } else {
        (tokens.surface, tokens.text)
    };
    let radius = if hovered || selected { 11.0 } else { 9.5 };
    painter.circle_filled(at, radius + 1.5, tokens.outline());
    painter.circle(at, radius, fill, Stroke::new(2.0, tokens.accent));
    let text = number.to_string();
    painter.text(at, Align2::CENTER_CENTER, text, tokens.small(), ink);
}

/// A small arrow head a third of the way along a leg, where the leg has room for it.
fn paint_arrow(painter: &Painter, from: Pos2, to: Pos2, tokens: &Tokens) {
    let way = to - from;
    if way.length() < 72.0 {
        return;
    }
    let ahead = way.normalized();
    let side = ahead.rot90();
    let tip = from + way * 0.34;
    let points = vec![
        tip + 7.0 * ahead,
        tip - 4.0 * ahead + 5.0 * side,
        tip - 4.0 * ahead - 5.0 * side,
    ];
    let edge = Stroke::new(1.0, tokens.outline());
    painter.add(Shape::convex_polygon(points, tokens.accent, edge));
}
