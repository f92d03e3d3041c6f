//! Routes on the map, and the place that is pointed at in the chart.

use egui::{Align2, Color32, Painter, Pos2, Shape, Stroke, vec2};
use pilotage_core::mission::turn::Turn;
use pilotage_core::mission::{Mission, Route};
use pilotage_core::plan::PredictionSample;

use super::aircraft::{radius_at, tight_legs};
use super::chart::sample_at;
use super::corridor_paint::paint_corridor;
use super::hit::{Hit, PlanPointer};
use super::marks::{paint_action, paint_rally, paint_way_back};
use super::planner::Planner;
use super::pointer::middles;
use super::rehearsal::FlownErrors;
use crate::context::route_of;
use crate::map::{ScreenFromWorld, ellipse};
use crate::tokens::Tokens;

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
        let samples = &shown.prediction.samples;
        FlownErrors::of(&self.rehearsal).paint_on_map(painter, view, samples, tokens);
        let hovered = self.hovered;
        let sample = hovered.and_then(|d| sample_at(samples, d));
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
        selected: Option<u32>,
        tool: &PlanPointer,
        tokens: &Tokens,
    ) {
        paint_routes(painter, view, mission, selected, self, tool, tokens);
        let rally = match tool.hovered {
            Some(Hit::Rally(index)) => Some(index),
            _ => None,
        };
        paint_rally(painter, view, mission, rally, tokens);
        if let Some(marking) = &self.marking {
            marking.paint(painter, view, tool.pointer, tokens);
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
    selected: Option<u32>,
    planner: &Planner,
    tool: &PlanPointer,
    tokens: &Tokens,
) {
    for route in mission.routes.iter().filter(|r| Some(r.id) != selected) {
        let line = screen_line(route, view);
        let strong = tool.hovered == Some(Hit::Route(route.id));
        let color = if strong { tokens.text } else { tokens.ghost };
        painter.add(Shape::line(
            line.clone(),
            Stroke::new(4.0, tokens.outline()),
        ));
        painter.add(Shape::line(line, Stroke::new(2.0, color)));
    }
    if let Some(route) = selected.and_then(|id| route_of(mission, id)) {
        paint_way_back(painter, view, route, mission, tokens);
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
    tool: &PlanPointer,
    tokens: &Tokens,
) {
    let line = screen_line(route, view);
    let pointer = tool.pointer.filter(|_| planner.drawing);
    if let (Some(last), Some(pointer)) = (line.last(), pointer) {
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
    let bank = planner.preferences.bank;
    for index in 0..line.len() {
        paint_action(painter, view, (route, index), bank, tokens);
    }
    for (index, at) in line.iter().enumerate() {
        let selected = planner.way_point == Some(index);
        let hovered = tool.hovered == Some(Hit::WayPoint(index));
        paint_way_point(painter, *at, index + 1, selected, hovered, tokens);
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
