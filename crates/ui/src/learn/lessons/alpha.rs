//! The spread α of the sigma points, under the hand.

use egui::{Stroke, Ui, pos2, vec2};
use nalgebra::Vector2;
use pilotage_core::flight::Flight;
use pilotage_core::navigator::{NavigatorSettings, Run, StepReport};

use super::super::ellipse_outline::closed_ellipse;
use super::super::figure::Figure;
use super::super::lesson::TourStop;
use super::super::moment::TourMoment;
use super::super::trial::TourTrial;
use super::super::unscented;
use crate::units::Units;
use crate::views::parts;

/// Lesson on α, with what its slider says.
pub(super) struct AlphaStop {
    alpha: f64,
}

impl Default for AlphaStop {
    fn default() -> Self {
        Self { alpha: 0.3 }
    }
}

impl TourStop for AlphaStop {
    fn title(&self) -> &'static str {
        "What α does"
    }

    fn find(&self, run: &Run, _flight: Option<&Flight>, _units: Units) -> Option<TourMoment> {
        let index = run.steps.iter().position(StepReport::is_placed)?;
        let text = format!(
            "α sets how far the sigma points stand from the middle; this run uses {}. \
             Drag it below: the points move, but the mean and ellipse that they give hardly change as long as the curve they go through is gentle.",
            run.settings.alpha
        );
        Some(TourMoment::new(run, index, text))
    }

    fn control_height(&self) -> f32 {
        4.5
    }

    fn control(&mut self, ui: &mut Ui) {
        let slider = egui::Slider::new(&mut self.alpha, 0.05..=1.0)
            .logarithmic(true)
            .fixed_decimals(2)
            .text("α");
        ui.add(slider);
    }

    // The unscented transform of a bearing and a range, with the spread of the slider.
    fn draw(&self, figure: &Figure<'_>) {
        let Figure {
            painter,
            rect,
            tokens,
            ..
        } = *figure;
        let transformed = unscented::transform(self.alpha);
        let scale = 0.92 * rect.height();
        let base = pos2(
            rect.center().x + 0.2 * rect.width(),
            rect.bottom() + 0.12 * rect.height(),
        );
        let at = |v: Vector2<f64>| base + vec2(v.x as f32, -v.y as f32) * scale;
        for place in unscented::cloud() {
            painter.circle_filled(at(place), 1.0, tokens.muted.gamma_multiply(0.6));
        }
        let outline = closed_ellipse(&transformed.covariance, 1.0, |v| at(transformed.mean + v));
        painter.line(outline, Stroke::new(1.5, tokens.corrected));
        for point in &transformed.points {
            painter.circle(
                at(*point),
                4.0,
                parts::ink(tokens),
                Stroke::new(1.0, tokens.background),
            );
        }
        let truth = at(unscented::true_mean());
        painter.circle_stroke(truth, 6.0, Stroke::new(2.0, tokens.truth));
        painter.circle_filled(at(transformed.mean), 3.5, tokens.corrected);
        figure.key(&[
            ("what may be", tokens.muted),
            ("sigma points", parts::ink(tokens)),
            ("their mean, 1σ", tokens.corrected),
            ("true mean", tokens.truth),
        ]);
    }

    fn trial(&self, _moment: &TourMoment, settings: &NavigatorSettings) -> TourTrial {
        TourTrial::change(
            settings,
            &format!("Fly again with α = {:.2}", self.alpha),
            &|s| {
                s.alpha = self.alpha;
            },
        )
    }
}
