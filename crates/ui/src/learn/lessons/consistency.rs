//! Consistency: whether the filter knows how wrong it is.

use egui::{Align2, Pos2, Rect, Stroke, vec2};
use pilotage_core::filter::{chi_square_probability, chi_square_quantile, mean_interval};
use pilotage_core::flight::Flight;
use pilotage_core::navigator::{NavigatorSettings, Outcome, Run};

use super::super::candidates::{judged, no_landmark};
use super::super::figure::{Figure, FigureNumbers};
use super::super::lesson::TourStop;
use super::super::moment::TourMoment;
use super::super::trial::TourTrial;
use crate::shell::counted;
use crate::units::Units;
use crate::views::parts::figures;

/// Number of bars of the histogram.
const BINS: usize = 24;

/// The NIS of the whole run beside what an honest filter would have.
#[derive(Default)]
pub(super) struct ConsistencyStop;

impl TourStop for ConsistencyStop {
    fn title(&self) -> &'static str {
        "Does the filter know how wrong it is?"
    }

    fn find(&self, run: &Run, _flight: Option<&Flight>, _units: Units) -> Option<TourMoment> {
        let accepted = accepted_nis(run);
        let (index, _) = *accepted.last()?;
        let mean = accepted.iter().map(|(_, nis)| nis).sum::<f64>() / accepted.len() as f64;
        let mut pictures: Vec<usize> = accepted.iter().map(|(index, _)| *index).collect();
        pictures.dedup();
        let freedom = degrees_of_freedom(run);
        let cut = share_of_mean(gate(run)?, freedom as f64);
        // Landmarks of one picture share the error of the estimate: as many independent ones as pictures.
        let (low, high) = mean_interval(freedom as f64, pictures.len());
        let (low, high) = (cut * low, cut * high);
        let verdict = if mean < low {
            "lower than chance makes it: the filter is more careful than it needs to be"
        } else if mean > high {
            "higher than chance makes it: the filter is surer than it should be"
        } else {
            "as it may be by chance: nothing here speaks against its uncertainties"
        };
        let text = format!(
            "If the filter's uncertainties are honest, the NIS of a landmark follows the chi-square curve; of those that the gate lets in the mean is {}. \
             Over the {} so far the mean is {} (by chance {} to {}), which is {verdict}.",
            figures(cut * freedom as f64),
            counted(accepted.len(), "match", "matches"),
            figures(mean),
            figures(low),
            figures(high),
        );
        Some(TourMoment::new(run, index, text))
    }

    fn missing(&self, run: &Run) -> Option<&'static str> {
        no_landmark(run)
    }

    fn gather(&self, run: &Run) -> FigureNumbers {
        let matches = accepted_nis(run).into_iter();
        FigureNumbers {
            matches: matches.map(|(_, nis)| ([nis, 0.0], true)).collect(),
            ..FigureNumbers::default()
        }
    }

    // The histogram of the NIS, beside the chi-square density with the degrees of freedom of a single
    // landmark.
    fn draw(&self, figure: &Figure<'_>) {
        let Figure {
            painter,
            rect,
            tokens,
            run,
            numbers,
            ..
        } = *figure;
        let freedom = degrees_of_freedom(run) as f64;
        let highest_nis = chi_square_quantile(0.998, freedom);
        let values = &numbers.matches;
        let mut counts = [0_usize; BINS];
        for ([value, _], _) in values {
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

/// Threshold of the gate for a single landmark.
fn gate(run: &Run) -> Option<f64> {
    let mut accepted = judged(run).filter(|(_, c, _)| c.outcome == Outcome::Accepted);
    accepted.next().map(|(_, candidate, _)| candidate.threshold)
}

/// Mean of chi-square numbers below a `gate`, as a share of the mean of all.
///
/// x times the density with k degrees of freedom is k times the density with k + 2, so that the mean below T is
/// k F(T; k + 2) / F(T; k).
fn share_of_mean(gate: f64, freedom: f64) -> f64 {
    chi_square_probability(gate, freedom + 2.0) / chi_square_probability(gate, freedom)
}

/// NIS of every single accepted landmark, with the index of its step.
fn accepted_nis(run: &Run) -> Vec<(usize, f64)> {
    judged(run)
        .filter(|(_, c, _)| c.outcome == Outcome::Accepted)
        .map(|(index, _, nis)| (index, nis))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::views::fixture::Fixture;

    /// Words on the fixture's run with every NIS as given, of its first `pictures` corrections.
    fn told(nis: f64, pictures: usize) -> String {
        let mut run = Fixture::lasting(40.0).run;
        let mut left = pictures;
        for step in &mut run.steps {
            let Some(frame) = &mut step.frame else {
                continue;
            };
            let Some(joint) = frame.joint.as_mut().filter(|_| left > 0) else {
                frame.candidates.clear();
                continue;
            };
            left -= 1;
            joint.degrees_of_freedom = 4;
            frame.candidates.retain(|c| c.outcome == Outcome::Accepted);
            frame.candidates.truncate(1);
            frame.candidates[0].nis = Some(nis);
        }
        let moment = ConsistencyStop.find(&run, None, Units::Metric);
        moment.unwrap().text
    }

    #[test]
    fn one_match_says_nothing_and_many_do() {
        // Chi-square with 4 degrees of freedom lies within 0.484 and 11.143; the gate at 16 takes 1 % off.
        let one = told(1.0, 1);
        assert!(one.contains("1 match so far"), "{one}");
        assert!(one.contains("0.48 to 11.0"), "{one}");
        assert!(one.contains("nothing here speaks against"), "{one}");
        let many = told(1.0, 30);
        assert!(many.contains("more careful"), "{many}");
        let many = told(8.0, 30);
        assert!(many.contains("surer than it should be"), "{many}");
    }

    #[test]
    fn the_mean_below_a_gate_is_that_of_an_integral() {
        // With two degrees of freedom 2 - T e^(-T/2) / (1 - e^(-T/2)): T = 2 ln 5 lets in 80 %.
        let gate = 2.0 * 5.0_f64.ln();
        let mean = 2.0 * share_of_mean(gate, 2.0);
        assert!((mean - (2.0 - gate * 0.2 / 0.8)).abs() < 1e-9, "{mean}");
    }
}
