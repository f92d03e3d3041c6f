//! True errors of rehearsed flights over the predicted corridor, in the chart and on the map.

use egui::{Color32, Painter, Pos2, Shape, Stroke};
use pilotage_core::frames::GroundPoint;
use pilotage_core::plan::{PlanComparison, PredictionSample};

use super::flights::{RehearsedRoute, RouteRehearsal};
use crate::map::ScreenFromWorld;
use crate::tokens::Tokens;

/// True errors of flights across the course, as they are drawn.
#[derive(Clone, Copy)]
pub struct FlownErrors<'a>(&'a [RehearsedRoute]);

impl<'a> FlownErrors<'a> {
    /// Those of a rehearsal of the plan that is shown; none if it is of another one.
    pub fn of(rehearsal: &'a RouteRehearsal) -> Self {
        Self(if rehearsal.is_of_now() {
            rehearsal.flown()
        } else {
            &[]
        })
    }

    /// Number of flights.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Colour of the lines.
    pub fn color(&self, tokens: &Tokens) -> Color32 {
        // Many lines over each other add up.
        let strength = 0.9 / (self.count() as f32).sqrt().max(1.0);
        tokens.truth.gamma_multiply(strength.max(0.4))
    }

    /// Largest of them, metres.
    pub fn largest(&self) -> f64 {
        let frames = self.0.iter().flat_map(|it| &it.frames);
        frames.map(|it| it.across.abs()).fold(0.0, f64::max)
    }

    /// Draws their sizes against distance.
    pub fn paint_against(&self, painter: &Painter, at: &dyn Fn(f64, f64) -> Pos2, tokens: &Tokens) {
        let place = |frame: &PlanComparison| at(frame.distance, frame.across.abs());
        self.paint(painter, &place, tokens);
    }

    /// Draws where the aircraft believed to be instead of on the path, as far as it is beside it.
    pub fn paint_on_map(
        &self,
        painter: &Painter,
        view: &ScreenFromWorld,
        samples: &[PredictionSample],
        tokens: &Tokens,
    ) {
        let place = |frame: &PlanComparison| {
            let at = samples.partition_point(|s| s.distance < frame.distance);
            let sample = &samples[at.min(samples.len() - 1)];
            let (sin, cos) = sample.course.sin_cos();
            let p = sample.position;
            view.apply(&GroundPoint::new(
                p.north - frame.across * sin,
                p.east + frame.across * cos,
            ))
        };
        if !samples.is_empty() {
            self.paint(painter, &place, tokens);
        }
    }

    fn paint(&self, painter: &Painter, place: &dyn Fn(&PlanComparison) -> Pos2, tokens: &Tokens) {
        let stroke = Stroke::new(1.0, self.color(tokens));
        for flight in self.0 {
            let line = flight.frames.iter().map(place).collect();
            painter.add(Shape::line(line, stroke));
        }
    }
}
