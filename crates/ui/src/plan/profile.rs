//! The heights of a route over the ground, against distance.

use egui::{
    Align2, Color32, Mesh, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2,
};
use pilotage_core::frames::GroundPoint;
use pilotage_core::mission::{Route, WayPointAction};
use pilotage_core::plan::{AirbornePart, ProfileSample, airborne, lowest, profile};

use super::symbols::{paint_home, paint_triangle};
use super::words::{distance_text, long};
use crate::tokens::Tokens;
use crate::units::Units;
use crate::views::chart::ChartAxes;

const LEFT: f32 = 52.0;
/// Room for the tabs over the chart, points.
const TABS: f32 = 184.0;
const HEADER: f32 = 18.0;
const BOTTOM: f32 = 18.0;

/// Content of the chart.
pub struct ProfileScene<'a> {
    /// The route.
    pub route: &'a Route,
    /// Height of the ground at a place, metres above mean sea level.
    pub ground: &'a dyn Fn(&GroundPoint) -> f64,
    /// Height of the place of take-off, metres above mean sea level.
    pub take_off: f64,
    /// Distance at which the heights of the ground are looked at, metres.
    pub step: f64,
    /// Source of the heights of the ground, in words.
    pub source: &'a str,
    /// Datum of the heights, in words.
    pub frame: &'a str,
    /// The selected way-point.
    pub chosen: Option<usize>,
    /// Whether the last way-point of the route is home, to which it returns.
    pub ends_at_home: bool,
    /// The look.
    pub tokens: &'a Tokens,
    /// The user's units.
    pub units: Units,
}

/// Draws the chart; the distance along the route under the pointer, metres.
pub fn show(ui: &mut Ui, scene: &ProfileScene<'_>) -> Option<f64> {
    let (outer, response) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
    let tokens = scene.tokens;
    let samples = profile(scene.route, scene.ground, scene.take_off, scene.step);
    let air = airborne(scene.route, &samples);
    let (last, low) = (samples.last()?, lowest(air.samples)?);
    let (far, far_unit) = long(scene.units, last.distance);
    let (near, near_unit) = scene.units.length();
    let clearance = format!(
        "lowest {:.0} {near_unit} above ground{}, at {}",
        low.above() * near,
        between_words(&air),
        distance_text(low.distance, scene.units)
    );
    response.widget_info(|| {
        WidgetInfo::labeled(
            Role::Image,
            true,
            format!("Heights along the route: {clearance}"),
        )
    });
    let rect = Rect::from_min_max(
        outer.min + vec2(LEFT, HEADER + 6.0),
        pos2(outer.right() - 8.0, outer.bottom() - BOTTOM),
    );
    if rect.height() < 24.0 || rect.width() < 80.0 {
        return None;
    }
    let heights = || samples.iter().flat_map(|s| [s.flown, s.ground]);
    let (bottom, top) = (
        heights().fold(f64::INFINITY, f64::min),
        heights().fold(f64::NEG_INFINITY, f64::max),
    );
    let margin = 0.12 * (top - bottom).max(20.0);
    let axes = ChartAxes {
        rect,
        x: (0.0, (last.distance * far).max(1e-6)),
        y: ((bottom - margin) * near, (top + 2.5 * margin) * near),
        log: false,
    };
    let painter = ui.painter_at(outer);
    axes.draw_y(&painter, tokens);
    axes.draw_x(&painter, tokens, &format!("along the route, {far_unit}"));
    let at = |s: &ProfileSample, height: f64| axes.at(s.distance * far, height * near);
    let clip = painter.with_clip_rect(rect);
    let ground_color = tokens.truth;
    clip.add(Shape::mesh(earth(
        samples.iter().map(|s| at(s, s.ground)),
        rect.bottom(),
        ground_color,
    )));
    let line = |of: fn(&ProfileSample) -> f64| -> Vec<Pos2> {
        samples.iter().map(|s| at(s, of(s))).collect()
    };
    clip.add(Shape::line(
        line(|s| s.ground),
        Stroke::new(1.5, ground_color),
    ));
    clip.add(Shape::line(
        line(|s| s.flown),
        Stroke::new(2.0, tokens.accent),
    ));
    // The first and the last stand on the edges.
    way_points(
        &painter.with_clip_rect(rect.expand(8.0)),
        scene,
        &samples,
        &at,
    );
    header(&painter, outer, scene, near_unit, &clearance);
    let pointer = response
        .hover_pos()
        .filter(|p| rect.x_range().contains(p.x))?;
    let distance = axes.x_at(pointer.x) / far;
    let away = |s: &ProfileSample| (s.distance - distance).abs();
    let under = samples.iter().min_by(|a, b| away(a).total_cmp(&away(b)))?;
    let x = at(under, under.flown).x;
    clip.vline(x, rect.y_range(), Stroke::new(1.0, tokens.muted));
    let text = format!(
        "{}: {:.0} {near_unit} {}, {:.0} {near_unit} above ground",
        distance_text(under.distance, scene.units),
        under.flown * near,
        scene.frame,
        under.above() * near
    );
    let align = if x > rect.center().x {
        Align2::RIGHT_TOP
    } else {
        Align2::LEFT_TOP
    };
    let place = pos2(
        x + if x > rect.center().x { -6.0 } else { 6.0 },
        rect.top() + 2.0,
    );
    clip.text(place, align, text, tokens.small(), tokens.text);
    Some(under.distance)
}

/// Words on the part of a route in which its lowest place is, where that is not all of it.
fn between_words(part: &AirbornePart<'_>) -> &'static str {
    match (part.takes_off, part.lands) {
        (false, false) => "",
        (true, false) => " after the take-off",
        (false, true) => " before the landing",
        (true, true) => " between take-off and landing",
    }
}

/// Mesh of the area below a line, down to `bottom`.
fn earth(line: impl Iterator<Item = Pos2>, bottom: f32, color: Color32) -> Mesh {
    let mut mesh = Mesh::default();
    for (first, top) in line.enumerate() {
        mesh.colored_vertex(top, color.gamma_multiply(0.35));
        mesh.colored_vertex(pos2(top.x, bottom), color.gamma_multiply(0.12));
        if let Some(before) = (2 * first as u32).checked_sub(2) {
            mesh.add_triangle(before, before + 1, before + 2);
            mesh.add_triangle(before + 1, before + 2, before + 3);
        }
    }
    mesh
}

fn way_points(
    painter: &egui::Painter,
    scene: &ProfileScene<'_>,
    samples: &[ProfileSample],
    at: &impl Fn(&ProfileSample, f64) -> Pos2,
) {
    let tokens = scene.tokens;
    let mut distance = 0.0;
    for (index, way_point) in scene.route.way_points.iter().enumerate() {
        if let Some(before) = index.checked_sub(1).map(|i| &scene.route.way_points[i]) {
            distance += before.position.distance(&way_point.position);
        }
        let away = |s: &ProfileSample| (s.distance - distance).abs();
        let Some(sample) = samples.iter().min_by(|a, b| away(a).total_cmp(&away(b))) else {
            continue;
        };
        let place = at(sample, sample.flown);
        let chosen = scene.chosen == Some(index);
        let is_home = scene.ends_at_home && index + 1 == scene.route.way_points.len();
        match way_point.action {
            _ if is_home => paint_home(painter, place, tokens.surface, tokens),
            WayPointAction::TakeOff => paint_triangle(painter, place, true, tokens.surface, tokens),
            WayPointAction::Land => paint_triangle(painter, place, false, tokens.surface, tokens),
            action => {
                let edge = Stroke::new(1.5, tokens.accent);
                if action != WayPointAction::FlyBy {
                    painter.circle_stroke(place, 7.0, edge);
                }
                let radius = if chosen { 5.0 } else { 3.5 };
                painter.circle(place, radius, tokens.surface, edge);
            }
        }
        if is_home {
            continue;
        }
        let (text, font) = ((index + 1).to_string(), tokens.small());
        let color = if chosen { tokens.text } else { tokens.muted };
        painter.text(
            place - vec2(0.0, 8.0),
            Align2::CENTER_BOTTOM,
            text,
            font,
            color,
        );
    }
}

fn header(
    painter: &egui::Painter,
    outer: Rect,
    scene: &ProfileScene<'_>,
    unit: &str,
    clearance: &str,
) {
    let tokens = scene.tokens;
    let y = outer.top() + 0.5 * HEADER;
    let text = |x: f32, align, words: &str, color| {
        painter
            .text(pos2(x, y), align, words, tokens.small(), color)
            .right()
    };
    let left = outer.left() + LEFT;
    text(
        left - 4.0,
        Align2::RIGHT_CENTER,
        // Another frame is named with the source of the heights.
        &unit_of(unit, scene.frame),
        tokens.muted,
    );
    let mut x = left + 12.0;
    let ground = format!("ground: {}", scene.source);
    let entries: [(&str, Color32); 2] = [("route", tokens.accent), (&ground, tokens.truth)];
    for (words, color) in entries {
        painter.line_segment([pos2(x, y), pos2(x + 18.0, y)], Stroke::new(2.0, color));
        x = text(x + 24.0, Align2::LEFT_CENTER, words, tokens.muted) + 20.0;
    }
    text(
        outer.right() - TABS,
        Align2::RIGHT_CENTER,
        clearance,
        tokens.muted,
    );
}

fn unit_of(unit: &str, frame: &str) -> String {
    match frame {
        "AMSL" => format!("{unit} {frame}"),
        _ => unit.to_owned(),
    }
}
