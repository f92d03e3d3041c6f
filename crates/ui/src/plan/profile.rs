//! The heights of a route over the ground, against distance.

use egui::{
    Align2, Color32, Mesh, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2,
};
use pilotage_core::frames::{AltitudeFrame, AltitudeReference, GroundPoint};
use pilotage_core::mission::Route;

use super::words::{distance_text, long};
use crate::tokens::Tokens;
use crate::units::Units;
use crate::views::chart::Axes;

const LEFT: f32 = 52.0;
/// Room for the tabs over the chart, points.
const TABS: f32 = 184.0;
const HEADER: f32 = 18.0;
const BOTTOM: f32 = 18.0;
/// Distances at which the heights of a route are looked at.
const SAMPLES: usize = 240;

/// Heights at one place of a route.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Distance along the route, metres.
    pub distance: f64,
    /// Height of the route above mean sea level, metres.
    pub flown: f64,
    /// Height of the ground above mean sea level, metres.
    pub ground: f64,
}

/// What the chart shows.
pub struct ProfileScene<'a> {
    /// The route.
    pub route: &'a Route,
    /// Height of the ground at a place, metres above mean sea level.
    pub ground: &'a dyn Fn(&GroundPoint) -> f64,
    /// Height of the place of take-off, metres above mean sea level.
    pub take_off: f64,
    /// Where the heights of the ground come from, in words.
    pub source: &'a str,
    /// The selected way-point.
    pub chosen: Option<usize>,
    /// The look.
    pub tokens: &'a Tokens,
    /// The user's units.
    pub units: Units,
}

/// Heights along `route`: between way-points above ground the height above ground changes evenly,
/// elsewhere that above mean sea level.
pub fn profile(route: &Route, ground: &dyn Fn(&GroundPoint) -> f64, take_off: f64) -> Vec<Sample> {
    let length = route.length();
    let mut samples = Vec::new();
    let mut before = 0.0;
    for pair in route.way_points.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        let leg = a.position.distance(&b.position);
        let follows = [a, b]
            .iter()
            .all(|w| w.altitude.frame == AltitudeFrame::AboveGround);
        let amsl = |w: &pilotage_core::mission::WayPoint| {
            let reference = AltitudeReference {
                take_off,
                ground: ground(&w.position),
            };
            w.altitude.amsl(&reference)
        };
        let (from, to) = (amsl(a), amsl(b));
        let parts = ((leg / length.max(1.0)) * SAMPLES as f64).ceil().max(1.0) as usize;
        let first = usize::from(!samples.is_empty());
        for part in first..=parts {
            let share = part as f64 / parts as f64;
            let place = GroundPoint::new(
                a.position.north + share * (b.position.north - a.position.north),
                a.position.east + share * (b.position.east - a.position.east),
            );
            let below = ground(&place);
            let flown = if follows {
                below + a.altitude.metres + share * (b.altitude.metres - a.altitude.metres)
            } else {
                from + share * (to - from)
            };
            samples.push(Sample {
                distance: before + share * leg,
                flown,
                ground: below,
            });
        }
        before += leg;
    }
    samples
}

/// The sample that is nearest to the ground.
pub fn lowest(samples: &[Sample]) -> Option<&Sample> {
    let above = |s: &Sample| s.flown - s.ground;
    samples.iter().min_by(|a, b| above(a).total_cmp(&above(b)))
}

/// Draws the chart; the distance along the route under the pointer, metres.
pub fn show(ui: &mut Ui, scene: &ProfileScene<'_>) -> Option<f64> {
    let (outer, response) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
    let tokens = scene.tokens;
    let samples = profile(scene.route, scene.ground, scene.take_off);
    let (last, low) = (samples.last()?, lowest(&samples)?);
    let (far, far_unit) = long(scene.units, last.distance);
    let (near, near_unit) = scene.units.length();
    let clearance = format!(
        "lowest {:.0} {near_unit} above ground, at {}",
        (low.flown - low.ground) * near,
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
    let axes = Axes {
        rect,
        x: (0.0, (last.distance * far).max(1e-6)),
        y: ((bottom - margin) * near, (top + 2.5 * margin) * near),
        log: false,
    };
    let painter = ui.painter_at(outer);
    axes.draw_y(&painter, tokens);
    axes.draw_x(&painter, tokens, far_unit);
    let at = |s: &Sample, height: f64| axes.at(s.distance * far, height * near);
    let clip = painter.with_clip_rect(rect);
    let ground_color = tokens.truth;
    let mut mesh = Mesh::default();
    for pair in samples.windows(2) {
        let first = mesh.vertices.len() as u32;
        for sample in pair {
            let top = at(sample, sample.ground);
            mesh.colored_vertex(top, ground_color.gamma_multiply(0.35));
            mesh.colored_vertex(
                pos2(top.x, rect.bottom()),
                ground_color.gamma_multiply(0.12),
            );
        }
        mesh.add_triangle(first, first + 1, first + 2);
        mesh.add_triangle(first + 1, first + 2, first + 3);
    }
    clip.add(Shape::mesh(mesh));
    let line =
        |of: fn(&Sample) -> f64| -> Vec<Pos2> { samples.iter().map(|s| at(s, of(s))).collect() };
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
    let away = |s: &Sample| (s.distance - distance).abs();
    let under = samples.iter().min_by(|a, b| away(a).total_cmp(&away(b)))?;
    let x = at(under, under.flown).x;
    clip.vline(x, rect.y_range(), Stroke::new(1.0, tokens.muted));
    let text = format!(
        "{}: {:.0} {near_unit} AMSL, {:.0} {near_unit} above ground",
        distance_text(under.distance, scene.units),
        under.flown * near,
        (under.flown - under.ground) * near
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

fn way_points(
    painter: &egui::Painter,
    scene: &ProfileScene<'_>,
    samples: &[Sample],
    at: &impl Fn(&Sample, f64) -> Pos2,
) {
    let tokens = scene.tokens;
    let mut distance = 0.0;
    for (index, way_point) in scene.route.way_points.iter().enumerate() {
        if let Some(before) = index.checked_sub(1).map(|i| &scene.route.way_points[i]) {
            distance += before.position.distance(&way_point.position);
        }
        let away = |s: &Sample| (s.distance - distance).abs();
        let Some(sample) = samples.iter().min_by(|a, b| away(a).total_cmp(&away(b))) else {
            continue;
        };
        let place = at(sample, sample.flown);
        let chosen = scene.chosen == Some(index);
        let radius = if chosen { 5.0 } else { 3.5 };
        painter.circle(
            place,
            radius,
            tokens.surface,
            Stroke::new(1.5, tokens.accent),
        );
        let (text, font) = ((index + 1).to_string(), tokens.small());
        let color = if chosen { tokens.text } else { tokens.muted };
        painter.text(
            place - vec2(0.0, 7.0),
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
        &format!("{unit} AMSL"),
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

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_core::frames::Altitude;
    use pilotage_core::mission::WayPoint;

    fn route(frame: AltitudeFrame) -> Route {
        let at = |e| WayPoint::new(GroundPoint::new(0.0, e), Altitude::new(100.0, frame));
        Route {
            way_points: vec![at(0.0), at(1000.0)],
            ..Route::default()
        }
    }

    /// A hill of 60 m in the middle, on ground at 400 m.
    fn hill(p: &GroundPoint) -> f64 {
        400.0 + 60.0 * (1.0 - ((p.east - 500.0) / 500.0).abs()).max(0.0)
    }

    #[test]
    fn above_ground_the_route_follows_the_hill_and_above_take_off_it_does_not() {
        let followed = profile(&route(AltitudeFrame::AboveGround), &hill, 400.0);
        let least = lowest(&followed).unwrap();
        assert!((least.flown - least.ground - 100.0).abs() < 1e-9);
        let level = profile(&route(AltitudeFrame::AboveTakeOff), &hill, 400.0);
        let least = lowest(&level).unwrap();
        assert!(
            (least.flown - least.ground - 40.0).abs() < 1e-9,
            "{least:?}"
        );
        assert!((least.distance - 500.0).abs() < 5.0);
        assert_eq!(level.last().unwrap().distance, 1000.0);
    }
}
