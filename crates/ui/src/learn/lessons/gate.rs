//! The gate: how far off its expected place a landmark may be found.

use egui::{Align2, Stroke, vec2};
use nalgebra::Vector2;
use pilotage_core::flight::Flight;
use pilotage_core::navigator::{CandidateReport, NavigatorSettings, Outcome, Run};

use super::super::candidates::{judged, no_landmark};
use super::super::figure::{Figure, FigureNumbers};
use super::super::lesson::TourStop;
use super::super::moment::TourMoment;
use super::super::trial::TourTrial;
use crate::units::Units;
use crate::views::parts::{self, figures};
use crate::views::picking;

/// The gate, by the accepted match that came closest to it.
#[derive(Default)]
pub(super) struct GateStop;

impl TourStop for GateStop {
    fn title(&self) -> &'static str {
        "The gate: how far off is too far"
    }

    // The accepted match that came closest to the gate.
    fn find(&self, run: &Run, _flight: Option<&Flight>, _units: Units) -> Option<TourMoment> {
        let (index, candidate, nis) = judged(run)
            .filter(|(_, c, _)| c.outcome == Outcome::Accepted)
            .max_by(|a, b| a.2.total_cmp(&b.2))?;
        let name = picking::landmark_name(run, candidate.landmark);
        let text = format!(
            "The filter knows how far a landmark may lie from its expected place; the squared distance in those units is the NIS, and above {} the gate shuts. \
             “{name}” here came closest to it of all that were let in, with a NIS of {}.",
            figures(candidate.threshold),
            figures(nis)
        );
        Some(TourMoment::new(run, index, text).landmark(Some(candidate.landmark)))
    }

    fn missing(&self, run: &Run) -> Option<&'static str> {
        no_landmark(run)
    }

    fn gather(&self, run: &Run) -> FigureNumbers {
        let frames = run.steps.iter().filter_map(|step| step.frame.as_ref());
        let all = frames.flat_map(|frame| &frame.candidates);
        let placed = all.filter_map(|c| {
            // As far out as the NIS says, in the direction of the pixels' part of it.
            let root = c.innovation_covariance.cholesky()?.l();
            let direction = root.solve_lower_triangular(&c.innovation?)?;
            let v = direction * (c.nis?.sqrt() / direction.norm().max(1e-9));
            Some((c, v))
        });
        let placed: Vec<(&CandidateReport, Vector2<f64>)> = placed.collect();
        let is_used = |c: &CandidateReport| c.outcome == Outcome::Accepted;
        FigureNumbers {
            threshold: placed.first().map(|(c, _)| c.threshold),
            matches: placed
                .iter()
                .map(|(c, v)| ([v.x, v.y], is_used(c)))
                .collect(),
            ..FigureNumbers::default()
        }
    }

    // Every innovation of the run in units of its own σ, inside and outside the gate's circle.
    fn draw(&self, figure: &Figure<'_>) {
        let Figure {
            painter,
            rect,
            tokens,
            numbers,
            ..
        } = *figure;
        let radius = numbers.threshold.map_or(3.0, f64::sqrt);
        let scale = 0.40 * rect.height() / radius as f32;
        let center = rect.center() + vec2(0.18 * rect.width(), 0.0);
        painter.circle(
            center,
            radius as f32 * scale,
            parts::ink(tokens).gamma_multiply(0.06),
            Stroke::new(1.5, parts::ink(tokens)),
        );
        for ([x, y], is_used) in &numbers.matches {
            let most = f64::from(0.49 * rect.height() / scale);
            let v = Vector2::new(*x, *y);
            let v = if v.norm() > most {
                v * (most / v.norm())
            } else {
                v
            };
            let at = center + vec2(v.x as f32, v.y as f32) * scale;
            let color = if *is_used {
                tokens.observed
            } else {
                tokens.refused
            };
            painter.circle_filled(at, 1.75, color.gamma_multiply(0.8));
        }
        figure.key(&[("used", tokens.observed), ("refused", tokens.refused)]);
        figure.caption(
            rect.left_bottom() + vec2(tokens.space, -0.75 * tokens.space),
            Align2::LEFT_BOTTOM,
            &format!("circle: the gate, {} σ", figures(radius)),
            tokens.muted,
        );
    }

    fn trial(&self, _moment: &TourMoment, settings: &NavigatorSettings) -> TourTrial {
        TourTrial::change(settings, "Fly again with a gate of 80 %", &|s| {
            s.gate_confidence = 0.80;
        })
    }
}
