//! A match that is refused, and why.

use egui::{Align2, Rect, Stroke, pos2, vec2};
use pilotage_core::flight::Flight;
use pilotage_core::navigator::{CandidateReport, NavigatorSettings, Outcome, Refusal, Run};

use super::super::candidates::no_landmark;
use super::super::figure::Figure;
use super::super::lesson::TourStop;
use super::super::moment::TourMoment;
use super::super::trial::TourTrial;
use crate::command::Command;
use crate::feature_command::FeatureCommand;
use crate::units::Units;
use crate::views::parts::figures;
use crate::views::{MATCH, picking};

/// The most telling refusal.
#[derive(Default)]
pub(super) struct RefusedStop;

impl TourStop for RefusedStop {
    fn title(&self) -> &'static str {
        "A match is refused"
    }

    // The most telling refusal: by the gate, then by contradiction, then the most ambiguous one.
    // Without any, the closest call.
    fn find(&self, run: &Run, _flight: Option<&Flight>, _units: Units) -> Option<TourMoment> {
        let candidates = || {
            run.steps.iter().enumerate().flat_map(|(i, step)| {
                step.frame
                    .iter()
                    .flat_map(|f| &f.candidates)
                    .map(move |c| (i, c))
            })
        };
        let refusal = candidates()
            .filter_map(|(i, c)| match c.outcome {
                Outcome::Refused(refusal) => Some((i, c, refusal)),
                Outcome::Accepted => None,
            })
            .max_by(|a, b| {
                let limit = run.settings.detector.greatest_ambiguity;
                let rank = |(_, c, r): &(usize, &CandidateReport, Refusal)| match r {
                    Refusal::OutsideGate => 4,
                    Refusal::Contradicted => 3,
                    Refusal::Ambiguous if picking::ambiguity(c) > limit => 2,
                    Refusal::Ambiguous => 1,
                    _ => 0,
                };
                rank(a).cmp(&rank(b)).then(a.1.score.total_cmp(&b.1.score))
            });
        if let Some((index, candidate, refusal)) = refusal {
            let name = picking::landmark_name(run, candidate.landmark);
            let numbers = candidate.nis.map_or_else(
                || {
                    if candidate.second_score > 0.0 {
                        format!(
                            "score {:.2}, runner-up {:.2}",
                            candidate.score, candidate.second_score
                        )
                    } else {
                        format!("score {:.2}", candidate.score)
                    }
                },
                |nis| format!("score {:.2}, NIS {}", candidate.score, figures(nis)),
            );
            let text = format!(
                "“{name}” was looked for and something was found, but {} ({numbers}). \
                 One false landmark does more harm than ten missing ones, so the filter rather goes without.",
                picking::reason(run, candidate, refusal)
            );
            return Some(TourMoment::new(run, index, text).landmark(Some(candidate.landmark)));
        }
        let (index, candidate) = candidates()
            .max_by(|a, b| picking::ambiguity(a.1).total_cmp(&picking::ambiguity(b.1)))?;
        let name = picking::landmark_name(run, candidate.landmark);
        let text = format!(
            "In this run nothing was refused so far. The closest call was “{name}”: a second place scored {:.0} % of the best, and from {:.0} % on it would have been refused as ambiguous.",
            100.0 * picking::ambiguity(candidate),
            100.0 * run.settings.detector.greatest_ambiguity
        );
        Some(TourMoment::new(run, index, text).landmark(Some(candidate.landmark)))
    }

    fn missing(&self, run: &Run) -> Option<&'static str> {
        no_landmark(run)
    }

    // Score, ambiguity and NIS of the refused match as bars with their limits.
    fn draw(&self, figure: &Figure<'_>) {
        let Figure {
            painter,
            rect,
            tokens,
            run,
            step,
            moment,
            ..
        } = *figure;
        let candidate = step
            .frame
            .iter()
            .flat_map(|f| &f.candidates)
            .find(|c| Some(c.landmark) == moment.landmark);
        let Some(candidate) = candidate else { return };
        let detector = run.settings.detector;
        let rows = [
            ("score", Some(candidate.score), detector.least_score, false),
            (
                "runner-up / best",
                Some(picking::ambiguity(candidate)),
                detector.greatest_ambiguity,
                true,
            ),
            ("surprise (NIS)", candidate.nis, candidate.threshold, true),
        ];
        let row_height = (rect.height() - 2.0 * tokens.space) / 3.0;
        let left = rect.left() + 9.0 * tokens.text_sizes[0];
        let right = rect.right() - 4.5 * tokens.text_sizes[0];
        for (i, (name, value, limit, below)) in rows.into_iter().enumerate() {
            let y = rect.top() + tokens.space + (i as f32 + 0.5) * row_height;
            let at = pos2(rect.left() + tokens.space, y);
            let bound = if below { "at most" } else { "at least" };
            let bound = format!("{bound} {}", figures(limit));
            figure.caption(at, Align2::LEFT_BOTTOM, name, tokens.text);
            figure.caption(at, Align2::LEFT_TOP, &bound, tokens.muted);
            let bar = Rect::from_min_max(pos2(left, y - 3.0), pos2(right, y + 3.0));
            let full = 2.0 * limit.max(1e-9);
            let value_at = pos2(rect.right() - tokens.space, y);
            let Some(value) = value else {
                let words = "not asked: refused before";
                figure.caption(value_at, Align2::RIGHT_CENTER, words, tokens.muted);
                continue;
            };
            painter.rect_filled(bar, 3.0, tokens.line);
            let good = (value <= limit) == below;
            let color = if good { tokens.truth } else { tokens.refused };
            let width = bar.width() * (value / full).clamp(0.0, 1.0) as f32;
            painter.rect_filled(Rect::from_min_size(bar.min, vec2(width, 6.0)), 3.0, color);
            let limit_x = bar.left() + 0.5 * bar.width();
            painter.vline(limit_x, y - 8.0..=y + 8.0, Stroke::new(1.5, tokens.text));
            figure.caption(value_at, Align2::RIGHT_CENTER, &figures(value), color);
        }
    }

    fn trial(&self, moment: &TourMoment, _settings: &NavigatorSettings) -> TourTrial {
        let commands = vec![
            Command::SelectLandmark(moment.landmark),
            Command::Feature(FeatureCommand::show(MATCH)),
        ];
        TourTrial::look("Open in match view", commands)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::views::fixture::Fixture;

    #[test]
    fn a_run_without_refusals_says_so_and_shows_the_closest_call() {
        let mut fixture = Fixture::lasting(20.0);
        for step in &mut fixture.run.steps {
            if let Some(frame) = &mut step.frame {
                frame.candidates.retain(|c| c.outcome == Outcome::Accepted);
            }
        }
        let moment = RefusedStop
            .find(&fixture.run, Some(&fixture.flight), Units::Metric)
            .unwrap();
        assert!(
            moment.text.contains("nothing was refused"),
            "{}",
            moment.text
        );
        assert!(moment.landmark.is_some());
    }
}
