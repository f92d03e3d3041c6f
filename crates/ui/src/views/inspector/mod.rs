//! The filter inspector: everything one step concluded, in numbers and in words.

mod aids;
mod candidates;
mod laid;
mod matrix;
pub(crate) mod sentence;
mod sigma;

use egui::{RichText, ScrollArea, Ui};
use pilotage_core::navigator::{FrameReport, JointReport, Run, StepReport};

use super::parts::{self, NumberReadout, figures};
use super::picking;
use super::sights::LastStep;
use crate::context::{DrawnTimes, ViewContext};
use crate::units::clock;

/// Explains the filter's step at the cursor.
#[derive(Default)]
pub struct InspectorView {
    stages: sigma::Stages,
    /// Show the step at the cursor itself rather than the last one with a picture.
    this_step: bool,
    drawn: Option<DrawnTimes>,
    pictures: LastStep,
    corrections: LastStep,
}

impl InspectorView {
    /// Times that were drawn last.
    pub fn drawn(&self) -> Option<DrawnTimes> {
        self.drawn
    }

    /// Draws the view into the space that `ui` has left.
    pub fn show(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        let Some((run, index)) = context
            .run
            .and_then(|run| Some((run, run.index_at(context.time)?)))
        else {
            parts::empty(
                ui,
                tokens,
                "No step yet",
                "Fly to see what the filter concludes.",
            );
            return;
        };
        let last_frame = self.pictures.at(run, index, |s| s.frame.is_some());
        ScrollArea::vertical()
            .id_salt("inspector")
            .auto_shrink(false)
            .show(ui, |ui| {
                ui.spacing_mut().item_spacing.y = 0.25 * tokens.space;
                let shown = self.choose(ui, context, run, index, last_frame);
                let step = &run.steps[shown];
                self.step(ui, context, run, shown, step);
                if let Some(frame) = last_frame.and_then(|i| run.steps[i].frame.as_ref()) {
                    let age = context.time - run.steps[last_frame.unwrap_or(index)].time;
                    self::frame(ui, context, run, frame, age);
                }
                aids::show(ui, context, run, index);
            });
    }

    /// Draws the choice between two steps: that with the last picture, or that at the cursor itself; returns
    /// the index of the chosen one.
    fn choose(
        &mut self,
        ui: &mut Ui,
        context: &ViewContext<'_>,
        run: &Run,
        index: usize,
        last_frame: Option<usize>,
    ) -> usize {
        let tokens = context.tokens;
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = egui::Vec2::splat(0.5 * tokens.space);
            for (this, text) in [(false, "Last picture"), (true, "This very step")] {
                if parts::chip(ui, tokens, self.this_step == this, text, text).clicked() {
                    self.this_step = this;
                }
            }
            let shown = match last_frame {
                Some(frame) if !self.this_step => frame,
                _ => index,
            };
            let step = &run.steps[shown];
            ui.label(
                RichText::new(format!(
                    "at {}, step {} of {}",
                    clock(step.time, context.clock_zero),
                    shown + 1,
                    run.steps.len()
                ))
                .size(tokens.text_sizes[0])
                .color(tokens.muted),
            );
            shown
        })
        .inner
    }

    fn step(
        &mut self,
        ui: &mut Ui,
        context: &ViewContext<'_>,
        run: &Run,
        index: usize,
        step: &StepReport,
    ) {
        let tokens = context.tokens;
        self.drawn = context.drawn(step.time);
        ui.add_space(0.5 * tokens.space);
        let last = self.corrections.at(run, index, StepReport::is_placed);
        let text = sentence::sentence(run, (index, last), context.flight, context.units);
        ui.label(
            RichText::new(text)
                .size(tokens.text_sizes[1])
                .color(tokens.text),
        );
        parts::section(ui, tokens, "STATE, ± 1σ", true, |ui| {
            for (i, (name, unit)) in run.state_names.iter().enumerate() {
                if i >= step.after.mean.len() {
                    break;
                }
                let (factor, unit) = context.units.of_si(unit);
                let sigma = step.after.covariance[(i, i)].max(0.0).sqrt() * factor;
                let value = NumberReadout::new(
                    name.clone(),
                    parts::brief(step.after.mean[i] * factor),
                    unit,
                )
                .deviation(figures(sigma));
                parts::reading(ui, tokens, &value);
            }
            let (factor, unit) = context.units.length();
            if let Some(truth) = context
                .flight
                .and_then(|f| f.truth.as_ref()?.position(step.time))
            {
                let mean = &step.after.mean;
                let error = (mean[0] - truth.x).hypot(mean[1] - truth.y) * factor;
                let name = format!("distance from the {}", context.known_track());
                let reading = NumberReadout::new(name, figures(error), unit).color(tokens.truth);
                parts::reading(ui, tokens, &reading);
            }
        });
        parts::section(ui, tokens, "SIGMA POINTS", true, |ui| {
            self.stages.show(ui, tokens, step, context.units);
        });
        parts::section(ui, tokens, "COVARIANCE", true, |ui| {
            let names: Vec<String> = run.state_names.iter().map(|(n, _)| n.clone()).collect();
            let size = step.after.covariance.nrows().min(names.len());
            let all = matrix::covariance(ui, tokens, &step.after.covariance, &names[..size]);
            let what = if all {
                "Covariance, SI units"
            } else {
                "Correlation"
            };
            ui.label(
                RichText::new(format!(
                    "{what}; red where two components err together, blue where they err oppositely"
                ))
                .size(tokens.text_sizes[0])
                .color(tokens.muted),
            );
        });
        parts::section(ui, tokens, "TIME SPENT", false, |ui| {
            for (name, value) in [
                ("predict", step.timing.predict),
                ("see", step.timing.see),
                ("update", step.timing.update),
            ] {
                parts::reading(ui, tokens, &NumberReadout::new(name, figures(value), "ms"));
            }
        });
    }
}

/// The camera frame: landmarks looked for, and the correction by those accepted.
fn frame(ui: &mut Ui, context: &mut ViewContext<'_>, run: &Run, frame: &FrameReport, age: f64) {
    let tokens = context.tokens;
    if let Some(laid) = &frame.laid {
        parts::section(ui, tokens, "WHOLE PICTURE ON THE MAP", true, |ui| {
            laid::show(ui, context, laid);
        });
    }
    let title = format!("LANDMARKS IN PICTURE {}", frame.index + 1);
    parts::section(ui, tokens, "LANDMARKS IN THE PICTURE", true, |ui| {
        ui.label(
            RichText::new(format!("{}, {age:.2} s ago", title.to_lowercase()))
                .size(tokens.text_sizes[0])
                .color(tokens.muted),
        );
        candidates::show(ui, context, run, frame);
    });
    if let Some(joint) = &frame.joint {
        parts::section(ui, tokens, "CORRECTION", true, |ui| {
            correction(ui, context, run, frame, joint);
        });
    }
}

/// NIS, gate, innovations with σ, and the gain.
fn correction(
    ui: &mut Ui,
    context: &ViewContext<'_>,
    run: &Run,
    frame: &FrameReport,
    joint: &JointReport,
) {
    let tokens = context.tokens;
    let inside = joint.nis <= joint.threshold;
    let color = if inside { tokens.text } else { tokens.refused };
    let nis = NumberReadout::new(
        format!(
            "NIS of all ({} numbers, gate {})",
            joint.degrees_of_freedom,
            figures(joint.threshold)
        ),
        figures(joint.nis),
        "",
    );
    parts::reading(ui, tokens, &nis.color(color));
    parts::gauge(ui, tokens, joint.nis, joint.threshold, true);
    let landmarks: Vec<String> = frame
        .accepted()
        .map(|c| picking::landmark_name(run, c.landmark))
        .collect();
    let each = joint.innovation.len() / landmarks.len().max(1);
    let number = |i: usize| {
        MEASURED
            .get(i % each.max(1))
            .copied()
            .unwrap_or(("", "", 1.0))
    };
    for i in 0..joint.innovation.len() {
        let Some(name) = landmarks.get(i / each.max(1)) else {
            break;
        };
        let (what, unit, factor) = number(i);
        let sigma = joint.innovation_covariance[(i, i)].max(0.0).sqrt();
        let value = parts::brief(factor * joint.innovation[i]);
        let reading = NumberReadout::new(format!("{name}, {what}"), value, unit);
        parts::reading(ui, tokens, &reading.deviation(figures(factor * sigma)));
    }
    if landmarks.is_empty() {
        return laid::correction(ui, context, run, joint);
    }
    ui.add_space(0.5 * tokens.space);
    ui.label(
        RichText::new("Kalman gain: what one pixel or radian moves each component by, SI")
            .size(tokens.text_sizes[0])
            .color(tokens.muted),
    );
    let rows: Vec<String> = run.state_names.iter().map(|(n, _)| n.clone()).collect();
    let rows = &rows[..joint.gain.nrows().min(rows.len())];
    // One block of columns per landmark: more do not fit side by side.
    for (block, name) in landmarks.iter().enumerate() {
        if each == 0 || (block + 1) * each > joint.gain.ncols() {
            break;
        }
        ui.label(
            RichText::new(name)
                .size(tokens.text_sizes[0])
                .color(tokens.text),
        );
        let columns: Vec<String> = (0..each).map(|i| number(i).0.to_owned()).collect();
        let part = joint.gain.columns(block * each, each).into_owned();
        matrix::gain(ui, tokens, &part, rows, &columns, name);
    }
}

/// Measured quantities of a landmark, in order: name, unit on screen, factor from SI.
const MEASURED: [(&str, &str, f64); 4] = [
    ("right", "px", 1.0),
    ("down", "px", 1.0),
    ("turn", "°", 180.0 / std::f64::consts::PI),
    ("scale", "%", 100.0),
];

#[cfg(test)]
mod tests;
