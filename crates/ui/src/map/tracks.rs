//! Tracks, thinned to what the map's scale can show and kept until the run or the scale changes.

use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke};
use pilotage_core::flight::Truth;
use pilotage_core::frames::GroundPoint;
use pilotage_core::navigator::Run;

use super::transform::ScreenFromWorld;
use crate::tokens::Tokens;

/// A point of a thinned track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackPoint {
    /// Seconds in the flight's time base.
    pub time: f64,
    /// Where.
    pub place: GroundPoint,
    /// Whether a landmark corrected the estimate in the latest camera frame.
    pub corrected: bool,
}

/// A thinned track that grows with its source.
#[derive(Clone, Debug, Default)]
pub struct ThinTrack {
    generation: u64,
    level: i32,
    used: usize,
    corrected: bool,
    points: Vec<TrackPoint>,
    last: Option<TrackPoint>,
}

/// Ground distance below which two points are one at this scale, as a power of two.
fn level_of(metres_per_point: f64) -> i32 {
    (metres_per_point * 1.5).log2().floor() as i32
}

impl ThinTrack {
    fn reset(&mut self, generation: u64, level: i32, length: usize) {
        if self.generation != generation || self.level != level || self.used > length {
            *self = Self {
                generation,
                level,
                ..Self::default()
            };
        }
    }

    fn push(&mut self, point: TrackPoint) {
        let tolerance = 2.0_f64.powi(self.level);
        let keep = self.points.last().is_none_or(|p| {
            p.place.distance(&point.place) >= tolerance || p.corrected != point.corrected
        });
        if keep {
            self.points.push(point);
        }
        self.last = Some(point);
    }

    /// Follows a run; `place` picks the track.
    pub fn follow_run(
        &mut self,
        run: &Run,
        generation: u64,
        metres_per_point: f64,
        place: impl Fn(&pilotage_core::navigator::StepReport) -> GroundPoint,
    ) {
        self.reset(generation, level_of(metres_per_point), run.steps.len());
        for step in &run.steps[self.used..] {
            if let Some(frame) = &step.frame {
                self.corrected = frame.joint.is_some();
            }
            self.push(TrackPoint {
                time: step.time,
                place: place(step),
                corrected: self.corrected,
            });
        }
        self.used = run.steps.len();
    }

    /// Follows the truth of a flight.
    pub fn follow_truth(&mut self, truth: &Truth, generation: u64, metres_per_point: f64) {
        self.reset(generation, level_of(metres_per_point), truth.states.len());
        for state in &truth.states[self.used..] {
            self.push(TrackPoint {
                time: state.time,
                place: GroundPoint::new(state.position.x, state.position.y),
                corrected: true,
            });
        }
        self.used = truth.states.len();
    }

    /// The thinned points and the latest one.
    pub fn points(&self) -> impl Iterator<Item = &TrackPoint> {
        self.points.iter().chain(&self.last)
    }
}

/// How a track is drawn.
#[derive(Clone, Copy, Debug)]
pub struct TrackStyle {
    /// Colour where corrected.
    pub corrected: Color32,
    /// Colour elsewhere.
    pub other: Color32,
    /// Width, points.
    pub width: f32,
    /// Dash and gap where corrected, points.
    pub dash: Option<(f32, f32)>,
    /// Dash and gap elsewhere, points.
    pub other_dash: Option<(f32, f32)>,
    /// A dark line below, to lift it off the ground.
    pub outlined: bool,
}

/// Draws a track: what lies before `now` in full, what lies after it fainter.
pub fn paint_track(
    painter: &Painter,
    view: &ScreenFromWorld,
    screen: Rect,
    track: &ThinTrack,
    now: f64,
    style: &TrackStyle,
    tokens: &Tokens,
) {
    let room = screen.expand(64.0);
    let mut piece: Vec<Pos2> = Vec::new();
    let mut kind = (true, true);
    let flush = |piece: &mut Vec<Pos2>, (corrected, past): (bool, bool)| {
        if piece.len() > 1 {
            let color = if corrected {
                style.corrected
            } else {
                style.other
            };
            let color = if past {
                color
            } else {
                color.gamma_multiply(0.42)
            };
            let dash = if corrected {
                style.dash
            } else {
                style.other_dash
            };
            let points = std::mem::take(piece);
            if style.outlined && past && dash.is_none() {
                let below = Stroke::new(style.width + 2.0, tokens.outline().gamma_multiply(0.5));
                painter.add(Shape::line(points.clone(), below));
            }
            let stroke = Stroke::new(style.width, color);
            match dash {
                Some((dash, gap)) => painter.extend(Shape::dashed_line(&points, stroke, dash, gap)),
                None => {
                    painter.add(Shape::line(points, stroke));
                }
            }
        }
        piece.clear();
    };
    let mut previous: Option<(Pos2, TrackPoint)> = None;
    for point in track.points() {
        let at = view.apply(&point.place);
        let here = (point.corrected, point.time <= now);
        if let Some((before, _)) = previous {
            let visible = room.intersects(Rect::from_two_pos(before, at));
            if !visible || here != kind {
                flush(&mut piece, kind);
                kind = here;
            }
            if visible {
                if piece.is_empty() {
                    piece.push(before);
                }
                piece.push(at);
            }
        } else {
            kind = here;
        }
        previous = Some((at, *point));
    }
    flush(&mut piece, kind);
}
