//! The numbers of a match, each beside the limit it is held against.

use egui::Ui;
use pilotage_core::landmark::{LEAST_PROBABILITY, TemplateFeatures};
use pilotage_core::navigator::{CandidateReport, Run};

use super::super::parts::{self, NumberReadout, figures};
use super::super::picking;
use super::super::sighted::certainty;
use crate::context::ViewContext;

/// Score, ambiguity and NIS with their limits, then the innovation.
pub(super) fn show(ui: &mut Ui, context: &ViewContext<'_>, run: &Run, candidate: &CandidateReport) {
    let tokens = context.tokens;
    let detector = run.settings.detector;
    ui.add_space(tokens.space);
    let verdict_color = |good: bool| if good { tokens.text } else { tokens.refused };

    match candidate
        .probability
        .filter(|_| detector.features == TemplateFeatures::Orientation)
    {
        Some(probability) => by_probability(ui, context, candidate, probability),
        None => by_scores(ui, context, run, candidate),
    }

    match candidate.nis {
        Some(nis) => {
            let reading = NumberReadout::new(
                format!("NIS (gate {})", figures(candidate.threshold)),
                figures(nis),
                "",
            )
            .color(verdict_color(nis <= candidate.threshold));
            parts::reading(ui, tokens, &reading);
            parts::gauge(ui, tokens, nis, candidate.threshold, true);
        }
        None => {
            parts::reading(
                ui,
                tokens,
                &NumberReadout::new("NIS", "not reached".to_owned(), ""),
            );
        }
    }
    if let Some(innovation) = candidate.innovation {
        let sigma = |axis: usize| {
            figures(
                candidate.innovation_covariance[(axis, axis)]
                    .max(0.0)
                    .sqrt(),
            )
        };
        let right = NumberReadout::new("Innovation right", parts::brief(innovation.x), "px");
        parts::reading(ui, tokens, &right.deviation(sigma(0)));
        let down = NumberReadout::new("Innovation down", parts::brief(innovation.y), "px");
        parts::reading(ui, tokens, &down.deviation(sigma(1)));
    }
    if let Some(noise) = candidate.measurement_covariance {
        let sigma = |i: usize| noise[(i, i)].max(0.0).sqrt();
        if let Some(turn) = candidate.rotation {
            let reading = NumberReadout::new("Turned by", parts::brief(turn.to_degrees()), "°");
            let sigma = figures(sigma(2).to_degrees());
            parts::reading(ui, tokens, &reading.deviation(sigma));
        }
        if let Some(scale) = candidate.log_scale {
            let reading = NumberReadout::new("Scale", parts::brief(100.0 * scale.exp_m1()), "%");
            parts::reading(ui, tokens, &reading.deviation(figures(100.0 * sigma(3))));
        }
        let place = sigma(0).max(sigma(1));
        parts::reading(
            ui,
            tokens,
            &NumberReadout::new("Place known to (1σ)", figures(place), "px"),
        );
    }
}

/// Score and ambiguity with the limits of a detector that judges by them.
fn by_scores(ui: &mut Ui, context: &ViewContext<'_>, run: &Run, candidate: &CandidateReport) {
    let tokens = context.tokens;
    let detector = run.settings.detector;
    let verdict_color = |good: bool| if good { tokens.text } else { tokens.refused };
    let score = NumberReadout::new(
        format!("Score (at least {})", figures(detector.least_score)),
        format!("{:.2}", candidate.score),
        "",
    )
    .color(verdict_color(candidate.score >= detector.least_score));
    parts::reading(ui, tokens, &score);
    parts::gauge(ui, tokens, candidate.score, detector.least_score, false);

    let ambiguity = picking::ambiguity(candidate);
    let second = NumberReadout::new(
        format!(
            "Runner-up / best match (limit {})",
            figures(detector.greatest_ambiguity)
        ),
        parts::brief(ambiguity),
        "",
    )
    .color(verdict_color(ambiguity <= detector.greatest_ambiguity));
    parts::reading(ui, tokens, &second);
    parts::gauge(ui, tokens, ambiguity, detector.greatest_ambiguity, true);
}

/// Probability with its limit, and the scores from which it comes.
fn by_probability(
    ui: &mut Ui,
    context: &ViewContext<'_>,
    candidate: &CandidateReport,
    probability: f64,
) {
    let tokens = context.tokens;
    let is_believed = probability >= LEAST_PROBABILITY;
    let reading = NumberReadout::new(
        format!("Probability (at least {})", figures(LEAST_PROBABILITY)),
        certainty(probability, 3),
        "",
    )
    .color(if is_believed {
        tokens.text
    } else {
        tokens.refused
    });
    parts::reading(ui, tokens, &reading);
    parts::gauge(ui, tokens, probability, LEAST_PROBABILITY, false);
    let scores = format!("{:.2}, {:.2}", candidate.score, candidate.second_score);
    parts::reading(
        ui,
        tokens,
        &NumberReadout::new("Score, second best", scores, ""),
    );
}
