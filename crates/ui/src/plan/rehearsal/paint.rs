//! True errors of rehearsed flights over the predicted corridor, in the chart and on the map.

use egui::{Color32, Painter, Pos2, Shape, Stroke};
use pilotage_core::frames::GroundPoint;
use pilotage_core::plan::{PlanComparison, PredictionSample};

use super::drawn::{DrawnFlights, FlightsKey};
use super::flights::{RehearsedRoute, RouteRehearsal};
use crate::map::ScreenFromWorld;
use crate::tokens::Tokens;
use crate::views::chart::ChartAxes;

/// Shortest way between two points of a line on the map, points of the screen.
const NEAREST: f32 = 1.5;

/// True errors of flights across the course, as they are drawn.
#[derive(Clone, Copy)]
pub struct FlownErrors<'a> {
    flown: &'a [RehearsedRoute],
    key: FlightsKey,
    drawn: &'a DrawnFlights,
}

impl<'a> FlownErrors<'a> {
    /// Those of a rehearsal of the plan that is shown; none if it is of another one.
    pub fn of(rehearsal: &'a RouteRehearsal) -> Self {
        let (key, drawn) = rehearsal.drawn();
        let flown = if rehearsal.is_of_now() {
            rehearsal.flown()
        } else {
            &[]
        };
        Self { flown, key, drawn }
    }

    /// Number of flights.
    pub fn count(&self) -> usize {
        self.flown.len()
    }

    /// Colour of the lines.
    pub fn color(&self, tokens: &Tokens) -> Color32 {
        // Many lines over each other add up.
        let strength = 0.9 / (self.count() as f32).sqrt().max(1.0);
        tokens.truth.gamma_multiply(strength.max(0.4))
    }

    /// Largest of them, metres.
    pub fn largest(&self) -> f64 {
        let largest = self.flown.iter().map(|it| it.farthest);
        largest.fold(0.0, f64::max)
    }

    /// Draws their sizes against distance; `units` are the factors from metres of both axes.
    pub fn paint_against(
        &self,
        painter: &Painter,
        axes: &ChartAxes,
        units: (f64, f64),
        tokens: &Tokens,
    ) {
        if self.flown.is_empty() {
            return;
        }
        let color = self.color(tokens);
        let mut still = self.drawn.chart.borrow_mut();
        still.paint(painter, (self.key, *axes, color), |shapes| {
            let at = |frame: &PlanComparison| {
                axes.at(frame.distance * units.0, frame.across.abs() * units.1)
            };
            for flight in self.flown {
                let line = highest(flight.frames.iter().map(at));
                shapes.push(Shape::line(line, Stroke::new(1.0, color)));
            }
        });
    }

    /// Draws where the aircraft believed to be instead of on the path, as far as it is beside it.
    pub fn paint_on_map(
        &self,
        painter: &Painter,
        view: &ScreenFromWorld,
        samples: &[PredictionSample],
        tokens: &Tokens,
    ) {
        if self.flown.is_empty() || samples.is_empty() {
            return;
        }
        let color = self.color(tokens);
        let mut still = self.drawn.map.borrow_mut();
        still.paint(painter, (self.key, *view, color), |shapes| {
            let lines = self.drawn.placed(self.key, || self.placed(samples));
            for line in lines.iter() {
                let line = apart(line.iter().map(|place| view.apply(place)));
                shapes.push(Shape::line(line, Stroke::new(1.0, color)));
            }
        });
    }

    /// Lines on the ground, beside the path by the errors.
    fn placed(&self, samples: &[PredictionSample]) -> Vec<Vec<GroundPoint>> {
        let place = |frame: &PlanComparison| {
            let at = samples.partition_point(|s| s.distance < frame.distance);
            let sample = &samples[at.min(samples.len() - 1)];
            let (sin, cos) = sample.course.sin_cos();
            let p = sample.position;
            GroundPoint::new(p.north - frame.across * sin, p.east + frame.across * cos)
        };
        let flights = self.flown.iter();
        let line = |flight: &RehearsedRoute| flight.frames.iter().map(place).collect();
        flights.map(line).collect()
    }
}

/// The highest point of each column of the screen: no error is hidden.
fn highest(line: impl Iterator<Item = Pos2>) -> Vec<Pos2> {
    let mut kept: Vec<Pos2> = Vec::new();
    let mut column = f32::NAN;
    for at in line {
        let own = at.x.floor();
        match kept.last_mut() {
            Some(last) if own == column => last.y = last.y.min(at.y),
            _ => kept.push(at),
        }
        column = own;
    }
    kept
}

/// Points of a line that are apart on the screen, and its end.
fn apart(line: impl Iterator<Item = Pos2>) -> Vec<Pos2> {
    let mut kept: Vec<Pos2> = Vec::new();
    let mut left_out = None;
    for at in line {
        let is_near = kept.last().is_some_and(|last| last.distance(at) < NEAREST);
        left_out = is_near.then_some(at);
        if !is_near {
            kept.push(at);
        }
    }
    kept.extend(left_out);
    kept
}

#[cfg(test)]
mod tests {
    use egui::{Rect, pos2};

    use super::*;

    fn frame(distance: f64, across: f64) -> PlanComparison {
        PlanComparison {
            distance,
            inside_ellipse: true,
            inside_corridor: true,
            across,
            squared: across * across,
            predicted: 1.0,
            believed: 1.0,
            nees: 1.0,
        }
    }

    fn flights(across: f64) -> Vec<RehearsedRoute> {
        let frames: Vec<_> = (0..1000)
            .map(|i| frame(f64::from(i), across * f64::from(i % 7)))
            .collect();
        vec![RehearsedRoute {
            seed: 1,
            worst: (0.0, 0.0),
            farthest: 6.0 * across.abs(),
            frames,
        }]
    }

    #[test]
    fn flights_are_gone_through_once_and_not_in_every_frame() {
        let context = egui::Context::default();
        let (few, other) = (flights(1.0), flights(3.0));
        let drawn = DrawnFlights::default();
        let axes = ChartAxes {
            rect: Rect::from_min_max(pos2(0.0, 0.0), pos2(300.0, 100.0)),
            x: (0.0, 1000.0),
            y: (0.0, 20.0),
            log: false,
        };
        let painted = |flown: &[RehearsedRoute], version: u64| {
            let mut output = context.run_ui(egui::RawInput::default(), |ui| {
                let key = (version, 1);
                let drawn = &drawn;
                let flown = FlownErrors { flown, key, drawn };
                flown.paint_against(ui.painter(), &axes, (1.0, 1.0), &Tokens::dark());
            });
            output.textures_delta.clear();
            let cut = context.tessellate(output.shapes, 1.0).into_iter();
            let of_one = |it: egui::ClippedPrimitive| match it.primitive {
                egui::epaint::Primitive::Mesh(mesh) => mesh.vertices,
                egui::epaint::Primitive::Callback(_) => Vec::new(),
            };
            cut.flat_map(of_one).map(|it| it.pos).collect::<Vec<_>>()
        };
        let first = painted(&few, 1);
        assert!(!first.is_empty() && first.len() < 4 * 1000);
        // The flights are those of before: nobody looks at their frames.
        assert_eq!(painted(&other, 1), first);
        assert_ne!(painted(&other, 2), first);
    }

    #[test]
    fn thinned_lines_hide_no_error_and_keep_their_end() {
        let line = || (0..90).map(|i| pos2(0.1 * i as f32, if i == 33 { 0.0 } else { 9.0 }));
        assert!(highest(line()).iter().any(|at| at.y == 0.0));
        assert_eq!(highest(line()).len(), 9);
        let kept = apart(line());
        assert!(kept.len() < 20 && kept.last() == line().next_back().as_ref());
    }
}
