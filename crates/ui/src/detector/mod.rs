//! Search of a trained detector: windows as stages reject them, features over the patch, score over the
//! ground, edges of the patch.

mod catalog;
mod command;
mod dialog;
mod drawn_feature;
mod evaluation;
mod feature;
mod ground;
mod judgement;
mod patch;
mod stages;
mod surface;
#[cfg(test)]
mod tests;
mod words;

use egui::{RichText, ScrollArea, TextureHandle, TextureOptions, Ui};
use pilotage_core::landmark::CascadeEvidence;
use pilotage_core::navigator::{FrameReport, Run};

use crate::command::Command;
use crate::context::ViewContext;
use crate::views::sights::Sights;
use crate::views::{ExplainedStep, color_map, parts, picking};
use patch::PatchState;
use pilotage_jobs::DetectorSearch;

pub use command::DetectorCommand;
pub use feature::DetectorFeature;

/// Seconds for which each stage is shown while they pass by themselves.
const STAGE_SECONDS: f64 = 0.9;

/// Textures of one search.
struct SearchTextures {
    /// Step, of one run, and landmark of the search.
    of: ExplainedStep,
    ground: TextureHandle,
    score: TextureHandle,
    patches: [Option<TextureHandle>; 2],
    /// Windows by the stage that rejected them, for so many stages passed.
    rejected: Option<(usize, TextureHandle)>,
}

/// Explains what the trained detector of a landmark saw and did: in the frame at the cursor or, where none
/// was looked for in it, in the last one before.
#[derive(Default)]
pub struct DetectorView {
    wanted: Option<(f64, u32)>,
    sights: Sights,
    /// Stages that have rejected their windows; all of them before anybody chose.
    passed: Option<usize>,
    /// Stages of the detector shown last.
    stages: usize,
    /// Since when stages pass by themselves, and how many had then: seconds.
    playing: Option<(f64, usize)>,
    /// To begin to play with the next frame.
    is_to_play: bool,
    patch: PatchState,
    textures: Option<SearchTextures>,
}

impl DetectorView {
    /// Time of the step and landmark whose search the view would show, as drawn last.
    pub fn wanted(&self) -> Option<(f64, u32)> {
        self.wanted
    }

    /// Stages whose windows are shown as rejected, of those there are.
    pub fn passed(&self) -> (usize, usize) {
        let all = self.stages;
        (self.passed.unwrap_or(all).min(all), all)
    }

    /// Does what a command asks of the view.
    pub fn act(&mut self, command: &DetectorCommand) {
        match command {
            DetectorCommand::Stages(count) => {
                self.playing = None;
                self.is_to_play = false;
                let (passed, all) = self.passed();
                let moved = passed as i64 + i64::from(*count);
                self.passed = Some(moved.clamp(0, all as i64) as usize);
            }
            DetectorCommand::Play => self.is_to_play |= self.playing.take().is_none(),
            DetectorCommand::Explain { .. }
            | DetectorCommand::Show
            | DetectorCommand::Evaluate
            | DetectorCommand::StopEvaluating
            | DetectorCommand::SaveEvaluation(_)
            | DetectorCommand::CloseEvaluation => {}
        }
    }

    /// Draws the view; `search` is what was asked for last, with what it is of.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        search: Option<(ExplainedStep, &DetectorSearch)>,
    ) {
        let tokens = context.tokens;
        self.wanted = None;
        let Some((run, index)) = context
            .run
            .and_then(|run| Some((run, run.index_at(context.time)?)))
        else {
            let hint = "Fly to see how trained detectors find landmarks.";
            parts::no_run(ui, context, hint);
            return;
        };
        let step = self.sights.last(run, index).map(|i| &run.steps[i]);
        let Some((step, frame)) = step.and_then(|s| Some((s, s.frame.as_ref()?))) else {
            let hint = "Searches appear with the first landmark that comes into view.";
            parts::empty(ui, tokens, "No landmark looked for yet", hint);
            return;
        };
        let Some(landmark) = chosen(context, frame) else {
            return;
        };
        ScrollArea::vertical()
            .id_salt("detector")
            .auto_shrink(false)
            .show(ui, |ui| {
                selector(ui, context, run, frame, landmark);
                if !is_trained(context, landmark) {
                    let name = picking::landmark_name(run, landmark);
                    let title = format!("No detector was trained for “{name}”");
                    parts::empty(ui, tokens, &title, UNTRAINED);
                    return;
                }
                self.wanted = Some((step.time, landmark));
                let ask = DetectorCommand::Explain {
                    time: step.time,
                    landmark,
                };
                context.commands.push(Command::from(ask));
                match search.filter(|(of, _)| of.is(step.time, landmark)) {
                    None => {
                        let hint = "The picture is searched again in the background.";
                        parts::empty(ui, tokens, "Looking …", hint);
                    }
                    Some((of, search)) => match &search.found {
                        Err(why) => parts::empty(ui, tokens, "Nothing to show", why),
                        Ok(evidence) => self.explain(ui, context, of, evidence),
                    },
                }
            });
    }

    /// All that is told of one search.
    fn explain(
        &mut self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        of: ExplainedStep,
        evidence: &CascadeEvidence,
    ) {
        let tokens = context.tokens;
        self.stages = evidence.stages.len();
        self.play(ui);
        self.textures(ui, of, evidence);
        let (passed, _) = self.passed();
        ui.add_space(0.5 * tokens.space);
        ui.label(
            RichText::new(words::lesson(evidence))
                .size(tokens.text_sizes[1])
                .color(tokens.text),
        );
        let words = "Evaluate on days it has not seen";
        if parts::chip(ui, tokens, false, words, words).clicked() {
            context
                .commands
                .push(Command::from(DetectorCommand::Evaluate));
        }
        parts::section(ui, tokens, "Windows that each stage rejects", true, |ui| {
            let texture = self.rejected(ui, tokens, evidence, passed);
            if let Some(textures) = &self.textures {
                let pictures = [textures.ground.id(), texture];
                let units = context.units;
                if let Some(chosen) = stages::show(ui, tokens, evidence, passed, pictures, units) {
                    self.passed = Some(chosen);
                    self.playing = None;
                }
            }
            let is_playing = self.playing.is_some();
            stages::controls(ui, context, evidence, (passed, is_playing));
        });
        let stage = passed.max(1) - 1;
        let title = "Features of the stage, and the edges of the patch";
        parts::section(ui, tokens, title, true, |ui| {
            if let Some(textures) = &self.textures {
                let ids = textures
                    .patches
                    .each_ref()
                    .map(|t| t.as_ref().map(TextureHandle::id));
                self.patch
                    .show(ui, tokens, evidence, stage, ids, context.units);
            }
        });
        parts::section(ui, tokens, "Score over the searched ground", true, |ui| {
            if let Some(textures) = &self.textures {
                surface::show(ui, tokens, evidence, textures.score.id(), context.units);
            }
        });
    }

    /// Lets time pass where stages pass by themselves.
    fn play(&mut self, ui: &Ui) {
        let now = ui.input(|i| i.time);
        if std::mem::take(&mut self.is_to_play) {
            let (passed, all) = self.passed();
            let from = if passed >= all { 0 } else { passed };
            self.passed = Some(from);
            self.playing = Some((now, from));
        }
        let Some((since, from)) = self.playing else {
            return;
        };
        let passed = from + ((now - since) / STAGE_SECONDS) as usize;
        self.passed = Some(passed.min(self.stages));
        if passed >= self.stages {
            self.playing = None;
        } else {
            let wait = STAGE_SECONDS * (passed + 1 - from) as f64 - (now - since);
            let wait = std::time::Duration::from_secs_f64(wait.clamp(0.01, 1.0));
            ui.ctx().request_repaint_after(wait);
        }
    }

    /// Makes the textures of a search that is shown for the first time.
    fn textures(&mut self, ui: &Ui, of: ExplainedStep, evidence: &CascadeEvidence) {
        if self.textures.as_ref().is_some_and(|t| t.of == of) {
            return;
        }
        let load = |name: &str, image: egui::ColorImage, options: TextureOptions| {
            ui.ctx()
                .load_texture(format!("detector {name}"), image, options)
        };
        let bytes = |raster: &pilotage_core::raster::Raster<u8>| {
            color_map::picture(&raster.map(f32::from), (0.0, 255.0), color_map::gray)
        };
        let score = color_map::picture(
            &evidence.scores,
            surface::range(evidence),
            color_map::viridis,
        );
        let patches = [&evidence.in_picture, &evidence.on_map];
        let patches = patches.map(|patch| {
            let image = bytes(&patch.as_ref()?.pixels);
            Some(load("patch", image, TextureOptions::NEAREST))
        });
        self.textures = Some(SearchTextures {
            of,
            ground: load("ground", bytes(&evidence.ground), TextureOptions::LINEAR),
            score: load("score", score, TextureOptions::NEAREST),
            patches,
            rejected: None,
        });
    }

    /// The windows that are rejected after so many stages.
    fn rejected(
        &mut self,
        ui: &Ui,
        tokens: &crate::tokens::Tokens,
        evidence: &CascadeEvidence,
        passed: usize,
    ) -> egui::TextureId {
        let Some(textures) = &mut self.textures else {
            return egui::TextureId::default();
        };
        match &textures.rejected {
            Some((of, texture)) if *of == passed => texture.id(),
            _ => {
                let image = stages::windows(tokens, evidence, passed);
                let context = ui.ctx();
                let options = TextureOptions::NEAREST;
                let texture = context.load_texture("detector windows", image, options);
                let id = texture.id();
                textures.rejected = Some((passed, texture));
                id
            }
        }
    }
}

/// Advice on a landmark that has no detector.
const UNTRAINED: &str = "Train one: in Plan, select the landmark and train a detector for it, or open a \
     mission that “pilotage train” wrote. Then fly again.";

/// The landmark that is selected, or the one that the match would be explained of; if that has no
/// detector and nothing is selected, another one of the frame that has.
fn chosen(context: &ViewContext<'_>, frame: &FrameReport) -> Option<u32> {
    let explained = picking::candidate_to_explain(frame, context.selection)?.landmark;
    if context.selection == Some(explained) || is_trained(context, explained) {
        return Some(explained);
    }
    let mut others = frame.candidates.iter().map(|c| c.landmark);
    others
        .find(|id| is_trained(context, *id))
        .or(Some(explained))
}

fn is_trained(context: &ViewContext<'_>, landmark: u32) -> bool {
    let landmark = context.mission.landmark(landmark);
    landmark.is_some_and(pilotage_core::landmark::Landmark::is_trained)
}

/// Draws a chip for each landmark of the frame.
fn selector(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    run: &Run,
    frame: &FrameReport,
    chosen: u32,
) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = egui::Vec2::splat(0.5 * context.tokens.space);
        for candidate in &frame.candidates {
            let id = candidate.landmark;
            let name = picking::landmark_name(run, id);
            let hint = if is_trained(context, id) {
                format!("Show what the detector of {name} saw")
            } else {
                format!("{name}, which has no trained detector")
            };
            if parts::chip(ui, context.tokens, id == chosen, &name, &hint).clicked() {
                context.commands.push(Command::SelectLandmark(Some(id)));
            }
        }
    });
}
