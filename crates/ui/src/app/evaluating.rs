//! Evaluations of trained detectors: asked for, taken, shown, saved.

use egui::{Frame, Id, Modal};

use super::App;
use super::evaluation::Evaluating;
use crate::command::Command;
use crate::detector::{DetectorCommand, EvaluationScene};
use crate::host::Host;
use crate::plan::flown;
use crate::shell::{muted, text_button, title};
use pilotage_jobs::{AssessmentOrder, EvaluationOrder, FlightSource, Job};

/// Photos on which a detector is judged, and days on which they are taken.
const PHOTOS: usize = 200;
const DAYS: usize = 20;

impl App {
    /// Shows how well the detector of a landmark does, after judging it unless that was done.
    pub(super) fn evaluate(&mut self, host: &mut dyn Host) {
        let wanted = self.views.detector.wanted().map(|(_, landmark)| landmark);
        let trained = |id: &u32| {
            let landmark = self.documents.mission.landmark(*id);
            landmark.is_some_and(pilotage_core::landmark::Landmark::is_trained)
        };
        let others = self.documents.mission.landmarks.iter().map(|l| l.id);
        let mut candidates = self.selection.into_iter().chain(wanted).chain(others);
        let Some(id) = candidates.find(trained) else {
            let text = "Train a detector for a landmark first.";
            self.toasts
                .note(host.now(), "No detector to evaluate", text);
            return;
        };
        self.evaluating.is_open = true;
        let documents = &self.documents;
        let Some(landmark) = documents.mission.landmark(id) else {
            return;
        };
        let of = landmark.trained_text().map(str::to_owned);
        let evaluating = &mut self.evaluating;
        let is_known = evaluating.landmark == Some(id) && evaluating.of == of;
        if is_known && (evaluating.job.is_some() || evaluating.state().1) {
            return;
        }
        if let Some((old, ..)) = evaluating.job.take() {
            host.cancel(old);
        }
        let recorded = matches!(documents.flight_source, FlightSource::Files(_));
        let about = AssessmentOrder {
            map: documents.map_source.clone(),
            landmark: landmark.clone(),
            camera: flown::camera(documents),
            height: flown::flown_height(documents),
            navigator: documents.mission.navigator.clone(),
            ground_down: flown::ground_down(documents),
            seed: AssessmentOrder::SEED,
        };
        let flight = recorded.then(|| documents.flight_source.clone());
        let order = EvaluationOrder::usual(about, flight, (PHOTOS, DAYS));
        let job = host.start(Job::Evaluate(Box::new(order)));
        (evaluating.landmark, evaluating.of) = (Some(id), of);
        (evaluating.report, evaluating.trouble) = (None, None);
        evaluating.job = Some((job, 0.0, "Starting …".to_owned()));
    }

    /// Stops the judging; what has been seen stays on screen.
    pub(super) fn stop_evaluating(&mut self, host: &mut dyn Host) {
        if let Some((job, ..)) = self.evaluating.job.take() {
            host.cancel(job);
        }
    }

    /// Saves what was asked for in the dialog.
    pub(super) fn save_evaluation(
        &mut self,
        file: &crate::detector::EvaluationFile,
        host: &mut dyn Host,
    ) {
        host.save_file(&file.name, file.text.as_bytes());
        self.toasts
            .note(host.now(), "Evaluation saved", file.name.clone());
    }

    pub(super) fn close_evaluation(&mut self) {
        self.evaluating.is_open = false;
    }

    /// The dialog with the plots.
    pub(super) fn evaluation_dialog(&mut self, ui: &egui::Ui, commands: &mut Vec<Command>) {
        if !self.evaluating.is_open {
            return;
        }
        let tokens = &self.tokens;
        let context = ui.ctx();
        let room = context.content_rect().size() - egui::vec2(64.0, 64.0);
        let size = room.min(egui::vec2(1120.0, 820.0));
        let Evaluating {
            landmark,
            job,
            report,
            trouble,
            view,
            ..
        } = &mut self.evaluating;
        let name = landmark.and_then(|id| self.documents.mission.landmark(id));
        let name = name.map_or("landmark", |l| l.name.as_str());
        let mut send = |command| commands.push(Command::from(command));
        let response = Modal::new(Id::unique("evaluation"))
            .frame(Frame::window(&context.global_style()).inner_margin(20))
            .show(context, |ui| {
                ui.set_width(size.x - 40.0);
                let close = title(
                    ui,
                    tokens,
                    &format!("Detector of “{name}”: how well it does"),
                );
                if let Some((_, part, words)) = job {
                    ui.horizontal(|ui| {
                        let bar = egui::ProgressBar::new(*part).text(words.as_str());
                        ui.add(bar.desired_width(ui.available_width() - 140.0));
                        if text_button(ui, tokens, None, "Stop", false).clicked() {
                            send(DetectorCommand::StopEvaluating);
                        }
                    });
                } else if let Some(why) = trouble {
                    ui.label(muted(tokens, why.as_str()));
                }
                egui::ScrollArea::vertical()
                    .max_height(size.y - 110.0)
                    .min_scrolled_height(size.y - 110.0)
                    .auto_shrink(false)
                    .show(ui, |ui| {
                        let scene = EvaluationScene {
                            report: report.as_ref(),
                            tokens,
                        };
                        if let Some(file) = view.show(ui, &scene) {
                            send(DetectorCommand::SaveEvaluation(file));
                        }
                    });
                close
            });
        if response.inner || response.should_close() {
            send(DetectorCommand::CloseEvaluation);
        }
    }
}
