//! Marks of take-off, landing, circles, home and rally points on the map, and their names.

use egui::{Align2, Color32, Painter, Pos2, Rect, Shape, Stroke, vec2};
use pilotage_core::frames::LocalFrame;
use pilotage_core::mission::{Mission, Route, WayPoint, WayPointAction};

use super::actions::action_words;
use super::symbols::{paint_home, paint_triangle};
use crate::context::route_of;
use crate::map::{LandmarkLabel, ScreenFromWorld};
use crate::tokens::Tokens;
use pilotage_core::plan::circles_at;

/// Radius of the mark of a rally point, points.
const RALLY: f32 = 10.0;
/// Part of the screen that a mark takes, points across.
const AROUND: f32 = 26.0;
/// Ranks of names: those of what somebody may have to find in a hurry come first.
const RALLY_RANK: u8 = 1;
const ACTION_RANK: u8 = 2;
const ROUTE_RANK: u8 = 3;
/// Part of the screen that the beginning of a route that is not selected takes, points across.
const ROUTE: f32 = 12.0;

/// Names of rally points and of actions along the selected route.
pub fn mark_labels(
    view: &ScreenFromWorld,
    mission: &Mission,
    route: Option<u32>,
    tokens: &Tokens,
) -> Vec<LandmarkLabel> {
    let label = |at: Pos2, rank: u8, text: String, color: Color32| {
        let around = Rect::from_center_size(at, vec2(AROUND, AROUND));
        LandmarkLabel {
            rank,
            around,
            top: around.center_top(),
            text,
            color,
        }
    };
    let rally = mission.rally.iter().map(|point| {
        let at = view.apply(&point.position);
        label(at, RALLY_RANK, point.name.clone(), tokens.truth)
    });
    let mut labels: Vec<LandmarkLabel> = rally.collect();
    let Some(route) = route.and_then(|id| route_of(mission, id)) else {
        return labels;
    };
    for way_point in &route.way_points {
        if let Some(words) = action_words(&way_point.action) {
            let at = view.apply(&way_point.position);
            labels.push(label(at, ACTION_RANK, words, tokens.text));
        }
    }
    if let Some([_, home]) = route.way_back(&LocalFrame::new(mission.origin)) {
        let at = view.apply(&home);
        labels.push(label(at, ACTION_RANK, "home".to_owned(), tokens.text));
    }
    labels
}

/// Names of the routes that are not selected, where they begin.
pub fn other_route_labels(
    view: &ScreenFromWorld,
    mission: &Mission,
    selected: Option<u32>,
    tokens: &Tokens,
) -> Vec<LandmarkLabel> {
    let others = mission.routes.iter().filter(|it| Some(it.id) != selected);
    let label = |route: &Route| {
        let at = view.apply(&route.way_points.first()?.position);
        let around = Rect::from_center_size(at, vec2(ROUTE, ROUTE));
        Some(LandmarkLabel {
            rank: ROUTE_RANK,
            around,
            top: around.center_top(),
            text: route.name.clone(),
            color: tokens.ghost,
        })
    };
    others.filter_map(label).collect()
}

/// Draws the way back of a route and its home, below the marks of its way-points.
pub fn paint_way_back(
    painter: &Painter,
    view: &ScreenFromWorld,
    route: &Route,
    mission: &Mission,
    tokens: &Tokens,
) {
    let frame = LocalFrame::new(mission.origin);
    if let Some(ends) = route.way_back(&frame) {
        let [from, home] = ends.map(|p| view.apply(&p));
        let dashes = |width: f32, color| {
            Shape::dashed_line(&[from, home], Stroke::new(width, color), 9.0, 6.0)
        };
        painter.extend(dashes(4.5, tokens.outline()));
        painter.extend(dashes(2.0, tokens.accent));
        paint_home(painter, home, tokens.outline(), tokens);
    }
}

/// Draws the mark of an action at a way-point of a route: triangles beside its number, circles as they are flown.
pub fn paint_action(
    painter: &Painter,
    view: &ScreenFromWorld,
    (route, index): (&Route, usize),
    bank: f64,
    tokens: &Tokens,
) {
    let way_point = &route.way_points[index];
    let at = view.apply(&way_point.position);
    let is_take_off = way_point.action == WayPointAction::TakeOff;
    if is_take_off || way_point.action == WayPointAction::Land {
        let beside = at + vec2(17.0, 0.0);
        paint_triangle(painter, beside, is_take_off, tokens.outline(), tokens);
    }
    if let Some(radius) = radius_around(way_point, bank) {
        let radius = view.points(radius);
        painter.circle_stroke(at, radius, Stroke::new(3.5, tokens.outline()));
        painter.circle_stroke(at, radius, Stroke::new(1.5, tokens.accent));
    }
}

/// Radius of the circle that is drawn around a way-point, metres: as it is flown with a bank, radians, or as it is stated for
/// waiting without an end.
pub fn radius_around(way_point: &WayPoint, bank: f64) -> Option<f64> {
    let stated = match way_point.action {
        WayPointAction::Wait { radius, .. } => Some(radius),
        _ => None,
    };
    let flown = circles_at(way_point, bank).map(|(radius, _)| radius);
    flown.or(stated).map(f64::abs).filter(|r| *r > 0.0)
}

/// Draws the rally points.
pub fn paint_rally(
    painter: &Painter,
    view: &ScreenFromWorld,
    mission: &Mission,
    hovered: Option<usize>,
    tokens: &Tokens,
) {
    for (index, point) in mission.rally.iter().enumerate() {
        let at = view.apply(&point.position);
        let size = RALLY + if hovered == Some(index) { 2.0 } else { 0.0 };
        let diamond = |size: f32| {
            let corners = [(0.0, -size), (size, 0.0), (0.0, size), (-size, 0.0)];
            corners.map(|(x, y)| at + vec2(x, y)).to_vec()
        };
        let edge = Stroke::new(2.0, tokens.truth);
        let below = Shape::convex_polygon(diamond(size + 3.0), tokens.outline(), Stroke::NONE);
        painter.add(below);
        let mark = Shape::convex_polygon(diamond(size), tokens.surface, edge);
        painter.add(mark);
        let (align, font) = (Align2::CENTER_CENTER, tokens.small());
        painter.text(at, align, "R", font, tokens.text);
    }
}
