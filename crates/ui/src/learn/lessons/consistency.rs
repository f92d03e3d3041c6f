//! Consistency: whether the filter knows how wrong it is.

use egui::{Align2, Pos2, Rect, Stroke, vec2};
use pilotage_core::filter::{chi_square_probability, chi_square_quantile};
use pilotage_core::flight::Flight;
use pilotage_core::navigator::{NavigatorSettings, Outcome, Run, StepReport};

use super::super::candidates::judged;
use super::super::figure::Figure;
use super::super::lesson::Lesson;
use super::super::moment::TourMoment;
use super::super::trial::TourTrial;
use crate::units::Units;
use crate::views::parts::figures;

/// Number of bars of the histogram.
const BINS: usize = 24;

/// The NIS of the whole run beside what an honest filter would have.
#[derive(Default)]
pub(super) struct Consistency;

impl Lesson for Consistency {
    fn title(&self) -> &'static str {
        "Does the filter know how wrong it is?"
    }

    fn find(&self, run: &Run, _flight: Option<&Flight>, _units: Units) -> Option<TourMoment> {
        let values = accepted_nis(run);
        let index = run.steps.iter().rposition(StepReport::corrected)?;
        let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
        let expected = degrees_of_freedom(run);
        let verdict = if mean < 0.6 * expected as f64 {
            "lower: it is more careful than it needs to be"
        } else if mean > 1.4 * expected as f64 {
            "higher: it is surer than it should be"
        } else {
            "close: it knows how wrong it is"
        };
        let text = format!(
            "If the filter's uncertainties are honest, the NIS of a landmark follows the chi-square curve with a mean of {expected}. \
             Over the {} matches so far the mean is {}, which is {verdict}.",
            values.len(),
            figures(mean)
        );
        Some(TourMoment::new(run, index, text))
    }

    // The histogram of the NIS, beside the chi-square density with the degrees of freedom of a single
    // landmark.
    fn draw(&self, figure: &Figure<'_>) {
        let Figure {
            painter,
            rect,
            tokens,
            run,
            ..
        } = *figure;
        let freedom = degrees_of_freedom(run) as f64;
        let highest_nis = chi_square_quantile(0.998, freedom);
        let values = accepted_nis(run);
        let mut counts = [0_usize; BINS];
        for value in &values {
            let bin = (value / highest_nis * BINS as f64) as usize;
            counts[bin.min(BINS - 1)] += 1;
        }
        let width = highest_nis / BINS as f64;
        let density = |count: usize| count as f64 / (values.len().max(1) as f64 * width);
        let highest = counts
            .iter()
            .map(|c| density(*c))
            .fold(1.0 / freedom, f64::max);
        let axes = figure.axes((0.0, highest_nis), (0.0, 1.1 * highest));
        axes.draw_x(painter, tokens, "NIS");
        for (i, count) in counts.into_iter().enumerate() {
            let bar = Rect::from_two_pos(
                axes.at(i as f64 * width, 0.0),
                axes.at((i + 1) as f64 * width, density(count)),
            );
            painter.rect_filled(
                bar.shrink2(vec2(0.5, 0.0)),
                0.0,
                tokens.observed.gamma_multiply(0.6),
            );
        }
        // The density is the slope of the probability.
        let step = highest_nis / 60.0;
        let curve: Vec<Pos2> = (0..60)
            .map(|i| {
                let x = f64::from(i) * step;
                let inside =
                    chi_square_probability(x + step, freedom) - chi_square_probability(x, freedom);
                axes.at(x + 0.5 * step, inside / step)
            })
            .collect();
        painter.line(curve, Stroke::new(2.0, tokens.truth));
        let at = rect.right_top() + vec2(-tokens.space, 0.5 * tokens.space);
        let text = "blue: this run; green: an honest filter";
        figure.caption(at, Align2::RIGHT_TOP, text, tokens.muted);
    }

    fn trial(&self, _moment: &TourMoment, settings: &NavigatorSettings) -> TourTrial {
        TourTrial::change(
            settings,
            "Fly again with a measurement noise nine times too large",
            &|s| {
                s.measurement_scale *= 9.0;
            },
        )
    }
}

/// Numbers measured per landmark: the degrees of freedom of a single one's NIS.
fn degrees_of_freedom(run: &Run) -> usize {
    run.steps
        .iter()
        .find_map(|step| {
            let frame = step.frame.as_ref()?;
            let joint = frame.joint.as_ref()?;
            joint
                .degrees_of_freedom
                .checked_div(frame.accepted().count())
        })
        .unwrap_or(2)
}

/// NIS of every single accepted landmark.
fn accepted_nis(run: &Run) -> Vec<f64> {
    judged(run)
        .filter(|(_, c, _)| c.outcome == Outcome::Accepted)
        .map(|(_, _, nis)| nis)
        .collect()
}
