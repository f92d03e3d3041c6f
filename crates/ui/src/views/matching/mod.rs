//! Why a landmark was believed or not: patch, rectified picture, score surface, and the numbers.

mod numbers;
mod pictures;

use egui::{RichText, ScrollArea, Ui};
use pilotage_core::navigator::{CandidateReport, Outcome, Refusal};

use super::{parts, picking};
use crate::command::Command;
use crate::context::ViewContext;
use crate::jobs::MatchPictures;
use pictures::MatchTextures;

/// Explains the match of one landmark in the frame at the cursor.
#[derive(Default)]
pub struct MatchView {
    wanted: Option<(f64, u32)>,
    textures: MatchTextures,
}

impl MatchView {
    /// Time of the step and landmark whose pictures the view would show, as drawn last.
    pub fn wanted(&self) -> Option<(f64, u32)> {
        self.wanted
    }

    /// Draws the view: numbers at once, pictures when they have arrived.
    pub fn show(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        self.wanted = None;
        let Some(run) = context.run else {
            parts::empty(
                ui,
                tokens,
                "No run yet",
                "Fly to see how landmarks are matched.",
            );
            return;
        };
        let Some((step, frame)) = picking::frame_at(run, context.time) else {
            parts::empty(
                ui,
                tokens,
                "No picture yet",
                "Matches appear with the first picture.",
            );
            return;
        };
        let Some(candidate) = picking::candidate_to_explain(frame, context.selection) else {
            parts::empty(
                ui,
                tokens,
                "No landmark near enough",
                "In this picture none was looked for. Step on, or pick one on the map.",
            );
            return;
        };
        self.wanted = Some((step.time, candidate.landmark));
        context.commands.push(Command::ExplainMatch {
            time: step.time,
            landmark: candidate.landmark,
        });
        let chosen = context
            .match_pictures
            .filter(|m| is_of(m, step.time, candidate.landmark));
        let name = picking::landmark_name(run, candidate.landmark);
        ScrollArea::vertical()
            .id_salt("match")
            .auto_shrink(false)
            .show(ui, |ui| {
                selector(ui, context, run, frame.candidates.as_slice(), candidate);
                if context.selection.is_some_and(|s| s != candidate.landmark) {
                    let selected = context.selection.map(|s| picking::landmark_name(run, s));
                    ui.label(
                        RichText::new(format!(
                            "{} was not looked for in this picture; this is {name}.",
                            selected.unwrap_or_default()
                        ))
                        .size(tokens.text_sizes[0])
                        .color(tokens.muted),
                    );
                }
                verdict(ui, context, &name, candidate);
                self.textures
                    .show(ui, tokens, chosen, nothing_to_show(candidate));
                numbers::show(ui, context, run, candidate);
            });
    }
}

/// Whether pictures belong to this step and landmark.
fn is_of(pictures: &MatchPictures, time: f64, landmark: u32) -> bool {
    pictures.landmark == landmark && (pictures.time - time).abs() < 1e-6
}

/// Why a match has no pictures, if it will never have any.
fn nothing_to_show(candidate: &CandidateReport) -> Option<&'static str> {
    match candidate.outcome {
        Outcome::Refused(refusal @ (Refusal::Flat | Refusal::OutOfPicture)) => {
            Some(refusal.reason())
        }
        _ => None,
    }
}

/// One chip per landmark of the frame.
fn selector(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    run: &pilotage_core::navigator::Run,
    candidates: &[CandidateReport],
    chosen: &CandidateReport,
) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = egui::Vec2::splat(0.5 * context.tokens.space);
        for candidate in candidates {
            let name = picking::landmark_name(run, candidate.landmark);
            let mark = if candidate.outcome == Outcome::Accepted {
                "•"
            } else {
                "×"
            };
            let on = candidate.landmark == chosen.landmark;
            let text = format!("{mark} {name}");
            if parts::chip(ui, context.tokens, on, &text, &format!("Explain {name}")).clicked() {
                context
                    .commands
                    .push(Command::SelectLandmark(Some(candidate.landmark)));
            }
        }
    });
}

/// The verdict as a sentence.
fn verdict(ui: &mut Ui, context: &ViewContext<'_>, name: &str, candidate: &CandidateReport) {
    let tokens = context.tokens;
    let (text, color) = match candidate.outcome {
        Outcome::Accepted => (
            format!("Recognised: “{name}” corrected the estimate."),
            tokens.truth,
        ),
        Outcome::Refused(refusal) => (
            format!("“{name}” refused: {}.", refusal.reason()),
            tokens.refused,
        ),
    };
    ui.add_space(0.5 * tokens.space);
    ui.label(RichText::new(text).size(tokens.text_sizes[1]).color(color));
}

#[cfg(test)]
mod tests;
