//! Dialog that shows how well a detector does.

use egui::{Frame, Id, Modal, Ui};

use super::DetectorCommand;
use super::evaluation::EvaluationScene;
use super::judgement::Judgement;
use crate::command::Command;
use crate::context::ViewContext;
use crate::shell::{muted, text_button, title};

impl Judgement {
    /// Draws the dialog with the plots, while it is open.
    pub fn dialog(&mut self, ui: &Ui, context: &mut ViewContext<'_>) {
        if !self.is_open {
            return;
        }
        let tokens = context.tokens;
        let egui = ui.ctx();
        let room = egui.content_rect().size() - egui::vec2(64.0, 64.0);
        let size = room.min(egui::vec2(1120.0, 820.0));
        let landmark = self.landmark.and_then(|id| context.mission.landmark(id));
        let name = landmark.map_or("landmark", |l| l.name.as_str());
        let mut send = |command| context.commands.push(Command::from(command));
        let response = Modal::new(Id::unique("evaluation"))
            .frame(Frame::window(&egui.global_style()).inner_margin(20))
            .show(egui, |ui| {
                ui.set_width(size.x - 40.0);
                let close = title(
                    ui,
                    tokens,
                    &format!("Detector of “{name}”: how well it does"),
                );
                if let Some((_, part, words)) = &self.job {
                    ui.horizontal(|ui| {
                        let bar = egui::ProgressBar::new(*part).text(words.as_str());
                        ui.add(bar.desired_width(ui.available_width() - 140.0));
                        if text_button(ui, tokens, None, "Stop", false).clicked() {
                            send(DetectorCommand::StopEvaluating);
                        }
                    });
                } else if let Some(why) = &self.trouble {
                    ui.label(muted(tokens, why.as_str()));
                }
                egui::ScrollArea::vertical()
                    .max_height(size.y - 110.0)
                    .min_scrolled_height(size.y - 110.0)
                    .auto_shrink(false)
                    .show(ui, |ui| {
                        let scene = EvaluationScene {
                            report: self.report.as_ref(),
                            tokens,
                        };
                        if let Some(file) = self.view.show(ui, &scene) {
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
