//! Sigma points that a correction draws together.

use egui::{Stroke, vec2};
use pilotage_core::flight::Flight;
use pilotage_core::navigator::{NavigatorSettings, Run, StepReport};

use super::super::candidates::{best_accepted, no_landmark};
use super::super::figure::Figure;
use super::super::lesson::TourStop;
use super::super::moment::TourMoment;
use super::super::sigma_points::{reach, sigma_set};
use super::super::trial::TourTrial;
use crate::command::Command;
use crate::units::Units;
use crate::views::inspector::sentence::sigma;
use crate::views::parts::figures;

/// The correction that draws the sigma points together most.
#[derive(Default)]
pub(super) struct ShrinkingStop;

impl TourStop for ShrinkingStop {
    fn title(&self) -> &'static str {
        "The sigma points draw together"
    }

    // The correction by landmarks that shrank σ by the largest factor.
    fn find(&self, run: &Run, _flight: Option<&Flight>, units: Units) -> Option<TourMoment> {
        let ratio = |step: &StepReport| sigma(&step.predicted) / sigma(&step.after).max(1e-9);
        let steps = run.steps.iter().enumerate();
        let (index, step) = steps
            .filter(|(_, step)| best_accepted(step).is_some() && ratio(step) > 1.0)
            .max_by(|a, b| ratio(a.1).total_cmp(&ratio(b.1)))?;
        let (factor, unit) = units.length();
        let text = format!(
            "The sigma points are a handful of guesses that together stand for how unsure the filter is; each is asked where the landmark would appear. \
             The estimate moves toward what the camera saw, and the less spread remains, the surer it is: here the 1σ shrinks from {} to {} {unit} in one step.",
            figures(factor * sigma(&step.predicted)),
            figures(factor * sigma(&step.after))
        );
        Some(TourMoment::new(run, index, text).landmark(best_accepted(step).map(|c| c.landmark)))
    }

    fn missing(&self, run: &Run) -> Option<&'static str> {
        no_landmark(run)
    }

    // Sigma points before and after the correction.
    fn draw(&self, figure: &Figure<'_>) {
        let Figure {
            painter,
            rect,
            tokens,
            flight,
            step,
            ..
        } = *figure;
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
        if let Some(truth) = flight.and_then(|f| f.truth.as_ref()?.position(step.time)) {
            painter.circle_stroke(at(truth.x, truth.y), 5.0, Stroke::new(2.0, tokens.truth));
        }
        let corner = rect.right_bottom() - vec2(tokens.space, tokens.space);
        figure.scale(scale, corner);
        figure.key(&[
            ("before the picture", tokens.dead_reckoning),
            ("after it", tokens.corrected),
            ("truth", tokens.truth),
        ]);
    }

    fn trial(&self, _moment: &TourMoment, _settings: &NavigatorSettings) -> TourTrial {
        TourTrial::look("Step to the next picture", vec![Command::StepFrames(1)])
    }
}
