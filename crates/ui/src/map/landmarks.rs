//! Landmarks on the map: possible ones white, observed ones coloured, refused ones crossed; accepted matches are joined
//! to the aircraft by a line.

use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, vec2};
use pilotage_core::frames::GroundPoint;
use pilotage_core::landmark::Landmark;
use pilotage_core::navigator::{CandidateReport, Outcome, StepReport};

use super::labels::{LandmarkLabel, POSSIBLE, PlacedLabels};
use super::symbols::paint_lifted_line;
use super::transform::{ScreenFromWorld, topmost};
use crate::tokens::Tokens;

/// Least side of a box on the screen with handles, points: eight of them would hide a smaller one.
const LEAST_WITH_HANDLES: f32 = 28.0;

/// State of a landmark in the frame at the time cursor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LandmarkState {
    /// Not looked for.
    Possible,
    /// It corrected the estimate.
    Accepted,
    /// It was looked for and not used.
    Refused,
    /// It is switched off.
    Off,
}

/// State of `landmark` in the frame of `step`, and its score.
pub fn seen(landmark: &Landmark, step: Option<&StepReport>) -> (LandmarkState, Option<f64>) {
    if !landmark.enabled {
        return (LandmarkState::Off, None);
    }
    let report: Option<&CandidateReport> = step
        .and_then(|s| s.frame.as_ref())
        .and_then(|f| f.candidates.iter().find(|c| c.landmark == landmark.id));
    match report {
        None => (LandmarkState::Possible, None),
        Some(c) if c.outcome == Outcome::Accepted => (LandmarkState::Accepted, Some(c.score)),
        Some(c) => (LandmarkState::Refused, Some(c.score)),
    }
}

/// Scene of the landmarks to be drawn.
pub struct LandmarkScene<'a> {
    /// All landmarks of the mission.
    pub landmarks: &'a [Landmark],
    /// The step whose frame is shown.
    pub step: Option<&'a StepReport>,
    /// The selected one.
    pub selection: Option<u32>,
    /// The one under the pointer.
    pub hovered: Option<u32>,
    /// Whether names are drawn.
    pub names: bool,
    /// Parts of the screen that names must not cover, and in which they would not be seen.
    pub covered: &'a [Rect],
    /// Lines on the screen that names must not cross, by their ends.
    pub lines: &'a [[Pos2; 2]],
    /// Start of the lines on the screen; `None` if no lines are drawn.
    pub lines_from: Option<Pos2>,
    /// Part of the lines that is drawn, 0 to 1.
    pub lines_drawn: f32,
}

/// Draws all landmarks, and names of theirs and of other things (`labels`) where they were `placed` or have a place now.
pub fn paint_landmarks(
    painter: &Painter,
    view: &ScreenFromWorld,
    screen: Rect,
    scene: &LandmarkScene<'_>,
    (mut labels, placed): (Vec<LandmarkLabel>, &mut PlacedLabels),
    tokens: &Tokens,
) {
    let room = screen.expand(32.0);
    for landmark in scene.landmarks {
        let corners = view.corners(&landmark.bounds);
        let around = Rect::from_points(&corners);
        if !room.intersects(around) {
            continue;
        }
        let (state, score) = seen(landmark, scene.step);
        let selected = scene.selection == Some(landmark.id);
        let color = color_of(state, tokens);
        if let (LandmarkState::Accepted, Some(from)) = (state, scene.lines_from) {
            let to = from.lerp(view.apply(&landmark.reference), scene.lines_drawn);
            paint_lifted_line(painter, [from, to], 1.5, color, tokens);
        }
        let outline = landmark.outline();
        let outline = outline.map(|o| o.iter().map(|p| view.apply(p)).collect());
        paint_box(painter, &corners, outline, state, selected, color, tokens);
        if landmark.is_point() || selected {
            paint_reference(painter, view, landmark, selected, color, tokens);
        }
        if scene.names || selected || scene.hovered == Some(landmark.id) {
            let text = match score {
                Some(score) if around.width() > 12.0 => {
                    format!("{}, score {score:.2}", landmark.name)
                }
                _ => landmark.name.clone(),
            };
            let rank = match state {
                _ if selected => 0,
                LandmarkState::Accepted => 1,
                LandmarkState::Refused => 2,
                _ => POSSIBLE,
            };
            labels.push(LandmarkLabel {
                rank,
                around,
                top: topmost(&corners),
                text,
                color,
            });
        }
    }
    let busy = (scene.covered, scene.lines);
    placed.paint(painter, screen, labels, busy, tokens);
}

fn color_of(state: LandmarkState, tokens: &Tokens) -> Color32 {
    match state {
        LandmarkState::Possible => tokens.sigma,
        LandmarkState::Accepted => tokens.observed,
        LandmarkState::Refused => tokens.refused,
        LandmarkState::Off => tokens.ghost,
    }
}

fn paint_box(
    painter: &Painter,
    corners: &[Pos2; 4],
    drawn: Option<Vec<Pos2>>,
    state: LandmarkState,
    selected: bool,
    color: Color32,
    tokens: &Tokens,
) {
    let is_box = drawn.is_none();
    if !is_box && selected {
        // The box around it is what is looked for.
        let mut around = corners.to_vec();
        around.push(corners[0]);
        let thin = Stroke::new(1.0, color.gamma_multiply(0.7));
        painter.extend(Shape::dashed_line(&around, thin, 3.0, 3.0));
    }
    let outline = drawn.unwrap_or_else(|| corners.to_vec());
    let below = Stroke::new(
        if selected { 5.0 } else { 3.5 },
        tokens.outline().gamma_multiply(0.6),
    );
    painter.add(Shape::closed_line(outline.clone(), below));
    if state == LandmarkState::Accepted && is_box {
        painter.add(Shape::convex_polygon(
            outline.clone(),
            color.gamma_multiply(0.22),
            Stroke::NONE,
        ));
    }
    let stroke = Stroke::new(if selected { 2.5 } else { 1.5 }, color);
    if state == LandmarkState::Off {
        let mut closed = outline.clone();
        closed.extend(outline.first().copied());
        painter.extend(Shape::dashed_line(&closed, stroke, 4.0, 4.0));
    } else {
        painter.add(Shape::closed_line(outline.clone(), stroke));
    }
    if state == LandmarkState::Refused {
        painter.line_segment([corners[0], corners[2]], stroke);
        painter.line_segment([corners[1], corners[3]], stroke);
    }
    if selected && !is_box {
        for corner in outline {
            let edge = Stroke::new(1.5, tokens.outline());
            painter.circle(corner, 4.5, tokens.sigma, edge);
        }
    } else if selected && has_handles(corners) {
        for handle in handles(corners) {
            painter.circle(
                handle,
                4.5,
                tokens.sigma,
                Stroke::new(1.5, tokens.outline()),
            );
        }
    }
}

/// The point that is measured, and the direction in which the landmark lies.
fn paint_reference(
    painter: &Painter,
    view: &ScreenFromWorld,
    landmark: &Landmark,
    selected: bool,
    color: Color32,
    tokens: &Tokens,
) {
    let at = view.apply(&landmark.reference);
    let strokes = [Stroke::new(4.0, tokens.outline()), Stroke::new(1.5, color)];
    for stroke in strokes {
        painter.line_segment([at - vec2(6.0, 0.0), at + vec2(6.0, 0.0)], stroke);
        painter.line_segment([at - vec2(0.0, 6.0), at + vec2(0.0, 6.0)], stroke);
    }
    if let Some(angle) = landmark.orientation().filter(|_| selected) {
        let away = 0.5 * landmark.bounds.height().hypot(landmark.bounds.width());
        let (sin, cos) = angle.sin_cos();
        let r = landmark.reference;
        let tip = GroundPoint::new(r.north + away * cos, r.east + away * sin);
        let way = view.apply(&tip) - at;
        let way = way.normalized() * way.length().max(24.0);
        for stroke in strokes {
            painter.arrow(at, way, stroke);
        }
    }
}

/// Whether a box is large enough on the screen for handles that leave it to be seen.
pub fn has_handles(corners: &[Pos2; 4]) -> bool {
    Rect::from_points(corners).size().min_elem() >= LEAST_WITH_HANDLES
}

/// The eight handles of a box: corners and middles of edges, from the north-west clockwise.
pub fn handles(corners: &[Pos2; 4]) -> [Pos2; 8] {
    let middle = |a: usize, b: usize| corners[a] + 0.5 * (corners[b] - corners[a]);
    [
        corners[0],
        middle(0, 1),
        corners[1],
        middle(1, 2),
        corners[2],
        middle(2, 3),
        corners[3],
        middle(3, 0),
    ]
}
