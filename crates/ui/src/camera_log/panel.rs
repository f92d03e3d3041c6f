//! The sheet: what is missing, the estimate, the numbers under the hand, and what they would do.

use egui::{Color32, RichText, ScrollArea, Ui, vec2};
use pilotage_core::calibration::{CameraAdjustment, ResidualSummary};

use super::CameraLogCommand as Do;
use super::chart::{ShownComponent, colours, height_percent, mark, residual_chart};
use super::numbers;
use super::work::{CameraLog, Missing, ResidualPreview};
use crate::command::Command;
use crate::context::ViewContext;
use crate::feature_work::FeatureWork;
use crate::shell::{NumberField, at_work, caption, muted, text_button, title};
use crate::views::{parts, table};

/// Scene of the sheet.
pub struct CameraLogScene<'a> {
    /// Camera beside its log.
    pub work: &'a CameraLog,
    /// Estimate under way.
    pub job: &'a FeatureWork,
    /// Whether there is a map.
    pub has_map: bool,
    /// Progress of the flight that is being flown, in words.
    pub flying: Option<&'a str>,
}

/// The sheet's own state.
#[derive(Debug, Default)]
pub struct CameraLogView {
    shown: ShownComponent,
}

fn send(context: &mut ViewContext<'_>, what: Do) {
    context.commands.push(Command::from(what));
}

/// A sentence that may take several lines.
fn wrapped(ui: &mut Ui, colour: Color32, text: &str) {
    ui.add(egui::Label::new(RichText::new(text).color(colour)).wrap());
}

impl CameraLogView {
    /// Draws the sheet.
    pub fn show(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, scene: &CameraLogScene<'_>) {
        let tokens = context.tokens;
        if title(ui, tokens, "Camera to log") {
            send(context, Do::Close);
        }
        ScrollArea::vertical()
            .id_salt("camera to log")
            .auto_shrink(false)
            .show(ui, |ui| {
                ui.spacing_mut().item_spacing.y = 0.75 * tokens.space;
                let words = "When and where the camera looked by the flight log: each picture is laid on the map \
                             and compared with GPS, heading and height.";
                ui.add(egui::Label::new(muted(tokens, words)).wrap());
                if let Some(words) = &scene.job.words
                    && at_work(ui, tokens, words)
                {
                    send(context, Do::Stop);
                }
                if let Some(trouble) = &scene.job.trouble {
                    wrapped(ui, tokens.warning, trouble);
                }
                let (flight, run) = (context.flight, context.run);
                match scene.work.missing(flight, run, scene.has_map) {
                    Some(missing) => lacking(ui, context, scene, &missing),
                    None => self.tell(ui, context, scene.work),
                }
            });
    }

    fn tell(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, work: &CameraLog) {
        let tokens = context.tokens;
        let applied = context.mission.camera_to_log;
        let change = work.change(applied.as_ref());
        ui.horizontal(|ui| {
            let is_first = work.found.is_none();
            if text_button(ui, tokens, None, "Estimate", is_first).clicked() {
                send(context, Do::Estimate);
            }
            let mut clock = work.clock;
            let label = ui.label(muted(tokens, "camera clock known to, σ"));
            let value = NumberField::new(0.1..=20.0).speed(0.02).decimals(1);
            let value = value.suffix(" s").show(ui, &mut clock);
            if value.labelled_by(label.id).changed() {
                send(context, Do::Believe(clock));
            }
        });
        if let Some(found) = &work.found {
            ui.scope(|ui| numbers::estimate(ui, tokens, found, context.units));
        }
        ui.add_space(0.5 * tokens.space);
        caption(ui, tokens, "By hand");
        let most = (3.0 * work.clock).max(1.5 * change.offset.abs());
        let moved = ui.scope(|ui| {
            ui.spacing_mut().item_spacing.y = 0.5 * tokens.space;
            numbers::by_hand(ui, tokens, &change, most)
        });
        if let Some(moved) = moved.inner {
            send(context, Do::Adjust(Box::new(moved)));
        }
        buttons(ui, context, work, &change);
        if let Some(preview) = work.preview() {
            self.preview(ui, context, preview);
        }
    }

    /// Draws the preview of the numbers: residuals of pictures minus log.
    fn preview(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, preview: &ResidualPreview) {
        let tokens = context.tokens;
        caption(ui, tokens, "Pictures minus log");
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = vec2(0.5 * tokens.space, 0.5 * tokens.space);
            for shown in ShownComponent::ALL {
                let on = self.shown == shown;
                let name = format!("Residuals: {}", shown.label());
                if parts::chip(ui, tokens, on, shown.label(), &name).clicked() {
                    self.shown = shown;
                }
            }
        });
        residual_chart(ui, context, preview, self.shown);
        let (_, length) = context.units.length();
        ui.horizontal_wrapped(|ui| {
            for (curve, name) in self.shown.curves().iter().enumerate() {
                let (rect, _) = ui.allocate_exact_size(vec2(10.0, 12.0), egui::Sense::hover());
                mark(ui.painter(), rect.center(), curve, colours(tokens)[curve]);
                ui.label(muted(tokens, *name));
            }
            ui.label(muted(tokens, format!("in {}", self.shown.unit(length))));
        });
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            summaries(ui, context, preview);
        });
        let words = "On the map, the dashed outline is what the picture at the cursor would show by the log alone.";
        ui.add(egui::Label::new(muted(tokens, words)).wrap());
    }
}

/// Draws what is missing, and buttons for what can be done about it.
fn lacking(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    scene: &CameraLogScene<'_>,
    missing: &Missing,
) {
    let tokens = context.tokens;
    let flying = scene.flying.filter(|_| *missing == Missing::Run);
    if let Some(words) = flying
        && at_work(ui, tokens, words)
    {
        context.commands.push(Command::CancelJob);
    }
    let found = match missing {
        Missing::Laid { found } => *found,
        _ => 0,
    };
    let words = match missing {
        Missing::Flight => "Nothing is open: open a flight with pictures and its log.".to_owned(),
        Missing::Frames => {
            "This flight has no pictures: open its log together with them.".to_owned()
        }
        Missing::Fixes => {
            "The log has no satellite navigation (GPS) to hold the pictures against.".to_owned()
        }
        Missing::Map => {
            "There is no map to lay the pictures on: open an orthophoto of the ground.".to_owned()
        }
        Missing::Run if flying.is_some() => "The numbers come once the flight is over.".to_owned(),
        Missing::Run => "This flight has not been flown.".to_owned(),
        Missing::FrameRegistration => {
            "This run looked for landmarks alone. Whole pictures have to be laid on the map: the \
                                 filter settings are changed so, which can be undone."
                .to_owned()
        }
        Missing::Laid { found } => format!(
            "{found} pictures of this run lie on the map during the log; at least 6 are needed. Does the map show \
             this ground, and are height and heading about right?"
        ),
    };
    let colour = if found > 0 {
        tokens.warning
    } else {
        tokens.text
    };
    wrapped(ui, colour, &words);
    let can_fly = matches!(
        missing,
        Missing::Run | Missing::FrameRegistration | Missing::Laid { .. }
    );
    if can_fly && flying.is_none() {
        let words = "Lay whole pictures and estimate";
        if text_button(ui, tokens, None, words, true).clicked() {
            send(context, Do::FlyAndEstimate);
        }
    }
    if context.mission.camera_to_log.is_some()
        && text_button(ui, tokens, None, "Reset", false).clicked()
    {
        send(context, Do::Reset);
    }
}

fn buttons(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    work: &CameraLog,
    change: &CameraAdjustment,
) {
    let tokens = context.tokens;
    let applied = context.mission.camera_to_log;
    let is_new = applied.unwrap_or_else(|| CameraAdjustment::none(change.middle)) != *change;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 0.5 * tokens.space;
        ui.add_enabled_ui(is_new, |ui| {
            if text_button(ui, tokens, None, "Apply", is_new && work.found.is_some()).clicked() {
                send(context, Do::Apply);
            }
        });
        let moved = work.found.is_some_and(|found| found.change != *change);
        ui.add_enabled_ui(moved, |ui| {
            if text_button(ui, tokens, None, "Use the estimate", false).clicked() {
                send(context, Do::UseEstimate);
            }
        });
        let is_changed = applied.is_some() || !change.is_none();
        ui.add_enabled_ui(is_changed, |ui| {
            if text_button(ui, tokens, None, "Reset", false).clicked() {
                send(context, Do::Reset);
            }
        });
    });
    let words = match (applied.is_some(), is_new) {
        (_, true) => "Apply changes the pictures' times and the camera and flies again.",
        (true, false) => "The flight is flown with these numbers.",
        (false, false) => "The flight is flown as it was opened.",
    };
    ui.add(egui::Label::new(muted(tokens, words)).wrap());
}

/// Root mean squares: as opened, with the estimate, as the hand has it.
fn summaries(ui: &mut Ui, context: &ViewContext<'_>, preview: &ResidualPreview) {
    let tokens = context.tokens;
    let (factor, length) = context.units.length();
    let titles = ["opened", "est.", "hand"].map(str::to_owned);
    table::heads(ui, tokens, &titles, |ui| {
        ui.label(muted(tokens, "RMS"));
    });
    let mut row = |name: String, of: &dyn Fn(&ResidualSummary) -> Option<f64>| {
        let value = |summary: &Option<ResidualSummary>| {
            let value = summary.as_ref().and_then(of);
            value.map_or_else(|| "–".to_owned(), parts::figures)
        };
        let cells: Vec<String> = preview.summaries.iter().map(value).collect();
        table::row(ui, tokens, &cells, tokens.text, |ui| {
            ui.label(RichText::new(name).color(tokens.text));
        });
    };
    row(format!("Position, {length}"), &|s| Some(factor * s.place));
    row(format!("Position (median), {length}"), &|s| {
        Some(factor * s.median_place)
    });
    row("Heading, °".to_owned(), &|s| {
        s.heading.map(f64::to_degrees)
    });
    row("Height, %".to_owned(), &|s| {
        s.log_height.map(height_percent)
    });
}
