//! Why a landmark was believed or not: patch, rectified picture, score surface, and the numbers.

mod command;
mod numbers;
mod pictures;

use egui::{RichText, ScrollArea, Ui};
use pilotage_core::navigator::{CandidateReport, Outcome, Refusal, Run, StepReport};

use super::sights::{LastStep, Sights};
use super::{ExplainedStep, parts, picking, sighted};
use crate::command::Command;
use crate::context::{DrawnTimes, ViewContext};
use crate::units::clock;
pub use command::{MATCH, MatchCommand};
use pictures::{MatchTextures, ShownMatch};
use pilotage_jobs::MatchPictures;

/// Explains the match of one landmark: in the frame at the cursor or, where none was looked for in
/// it, in the last one before.
#[derive(Default)]
pub struct MatchView {
    wanted: Option<(f64, u32)>,
    textures: MatchTextures,
    sights: Sights,
    frames: LastStep,
    drawn: Option<DrawnTimes>,
}

impl MatchView {
    /// Time of the step and landmark whose pictures the view would show, as drawn last.
    pub fn wanted(&self) -> Option<(f64, u32)> {
        self.wanted
    }

    /// Times that were drawn last.
    pub fn drawn(&self) -> Option<DrawnTimes> {
        self.drawn
    }

    /// Draws the view: numbers at once, pictures when they have arrived; `pictures` are those that arrived last, with what
    /// they are of, or why there are none.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        pictures: Option<(ExplainedStep, &Result<MatchPictures, String>)>,
    ) {
        let tokens = context.tokens;
        self.wanted = None;
        let Some((run, index)) = context
            .run
            .and_then(|run| Some((run, run.index_at(context.time)?)))
        else {
            let hint = "Fly to see how landmarks are matched.";
            parts::no_run(ui, context, hint);
            return;
        };
        self.drawn = context.drawn(run.steps[index].time);
        let next = Sights::next(run, index).map(|i| &run.steps[i]);
        let Some(step) = self.sights.last(run, index).map(|i| &run.steps[i]) else {
            waiting(ui, context, next);
            return;
        };
        let Some((frame, candidate)) = step
            .frame
            .as_ref()
            .and_then(|f| Some((f, picking::candidate_to_explain(f, context.selection)?)))
        else {
            return;
        };
        let newest = self.frames.at(run, index, |s| s.frame.is_some());
        self.drawn = context.drawn(step.time);
        self.wanted = Some((step.time, candidate.landmark));
        let ask = MatchCommand {
            time: step.time,
            landmark: candidate.landmark,
        };
        context.commands.push(ask.into());
        let chosen = pictures.filter(|(of, _)| of.is(step.time, candidate.landmark));
        let name = picking::landmark_name(run, candidate.landmark);
        ScrollArea::vertical()
            .id_salt("match")
            .auto_shrink(false)
            .show(ui, |ui| {
                if newest.is_some_and(|newest| run.steps[newest].time > step.time) {
                    past(ui, context, step, next);
                }
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
                verdict(ui, context, run, &name, candidate);
                let shown = match (chosen, nothing_to_show(candidate)) {
                    (Some((of, Ok(pictures))), _) => ShownMatch::Pictures(of, pictures),
                    (_, Some(never)) => ShownMatch::None(never),
                    (Some((_, Err(why))), None) => ShownMatch::None(why),
                    (None, None) => ShownMatch::OnTheirWay,
                };
                self.textures.show(ui, tokens, &shown, context.units);
                numbers::show(ui, context, run, candidate);
            });
    }
}

/// Says that the match shown lies in the past, how far, and when the next one comes.
fn past(ui: &mut Ui, context: &mut ViewContext<'_>, step: &StepReport, next: Option<&StepReport>) {
    let tokens = context.tokens;
    egui::Frame::new()
        .fill(tokens.raised)
        .corner_radius(tokens.radius)
        .inner_margin(egui::Margin::symmetric(8, 4))
        .show(ui, |ui| {
            ui.set_width(ui.available_width());
            let text = format!(
                "No landmark in sight now. Below: the last one looked for, {:.1} s ago at {}.",
                context.time - step.time,
                clock(step.time, context.clock_zero)
            );
            ui.label(
                RichText::new(text)
                    .size(tokens.text_sizes[0])
                    .color(tokens.text),
            );
            upcoming(ui, context, next);
        });
    ui.add_space(0.25 * tokens.space);
}

/// Before the first landmark: nothing to explain yet, but something to wait for, or a reason why none will come.
fn waiting(ui: &mut Ui, context: &mut ViewContext<'_>, next: Option<&StepReport>) {
    let has_pictures = context.flight.is_none_or(|f| !f.frames.is_empty());
    let lays_pictures = (context.run).is_some_and(|run| run.settings.whole_frames.is_some());
    let knows_none = (context.run).is_some_and(|run| run.landmarks.is_empty());
    let (title, hint) = if !has_pictures {
        (
            "No pictures",
            "Without a camera there is nothing to look for; GPS outage shows how it goes on without GPS.",
        )
    } else if lays_pictures {
        (
            "Whole pictures are laid on the map",
            "Where each one lies, and how surely, stands under Filter.",
        )
    } else if knows_none {
        (
            "This flight knows no landmark",
            "Draw one in Plan, or have whole pictures laid on the map: Filter, at the top.",
        )
    } else {
        (
            "No landmark looked for yet",
            "Matches appear with the first landmark that comes into view.",
        )
    };
    let sightings = (context.run).map_or(&[][..], |run| sighted::last(run, context.time));
    if sightings.is_empty() {
        parts::empty(ui, context.tokens, title, hint);
    } else {
        sighted::show_all(ui, context, sightings);
    }
    ui.add_space(context.tokens.space);
    ui.vertical_centered(|ui| upcoming(ui, context, next));
}

/// When the next landmark is looked for, and a way to go there.
fn upcoming(ui: &mut Ui, context: &mut ViewContext<'_>, next: Option<&StepReport>) {
    let Some(next) = next else { return };
    let text = coming(next.time - context.time);
    let name = "Go to the next landmark looked for";
    if parts::chip(ui, context.tokens, false, &text, name).clicked() {
        context.commands.push(Command::SeekTo(next.time));
    }
}

/// Words for the next landmark that is looked for in so many seconds.
fn coming(seconds: f64) -> String {
    if seconds < 0.05 {
        return "The next comes now: go there".to_owned();
    }
    format!("The next comes in {seconds:.1} s: go there")
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

/// Draws a chip per landmark of the frame.
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
fn verdict(
    ui: &mut Ui,
    context: &ViewContext<'_>,
    run: &Run,
    name: &str,
    candidate: &CandidateReport,
) {
    let tokens = context.tokens;
    let (text, color) = match candidate.outcome {
        Outcome::Accepted => (
            format!("Recognised: “{name}” corrected the estimate."),
            tokens.truth,
        ),
        Outcome::Refused(refusal) => (
            format!(
                "“{name}” refused: {}.",
                picking::reason(run, candidate, refusal)
            ),
            tokens.refused,
        ),
    };
    ui.add_space(0.5 * tokens.space);
    ui.label(RichText::new(text).size(tokens.text_sizes[1]).color(color));
}

#[cfg(test)]
mod tests;
