//! Remedies of the worst stretch of a route, in sentences and on the map.

use egui::{Painter, Rect, Stroke, Ui, Vec2};

use super::command::PlanCommand;
use super::find_command::FindCommand;
use super::planner::Planner;
use crate::command::Command;
use crate::context::ViewContext;
use crate::map::{LandmarkLabel, ScreenFromWorld};
use crate::shell::text_button;
use crate::tokens::Tokens;

/// Radius of the mark where a landmark would help, points: around a way-point, whose number stays to be read.
const RING: f32 = 17.0;
/// Rank of its name.
const ADVICE_RANK: u8 = 1;

impl Planner {
    /// Draws what mends the worst stretch, with a button that looks for another line.
    pub(super) fn remedies_card(&self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        for sentence in self.remedies.sentences(context.units) {
            ui.label(egui::RichText::new(sentence).color(tokens.text));
        }
        let Some(worst) = self.remedies.worst else {
            return;
        };
        if text_button(ui, tokens, None, "Reroute around the worst stretch", false).clicked() {
            for command in [
                FindCommand::Begin,
                FindCommand::Click(worst.begin),
                FindCommand::Click(worst.end),
                FindCommand::Start,
            ] {
                let command = Command::from(PlanCommand::Find(command));
                context.commands.push(command);
            }
        }
    }

    /// Marks on the map where a landmark would mend the worst stretch.
    pub(crate) fn paint_remedy(&self, painter: &Painter, view: &ScreenFromWorld, tokens: &Tokens) {
        let helps = self.remedies.landmark_helps();
        let Some(worst) = self.remedies.worst.filter(|_| helps) else {
            return;
        };
        let at = view.apply(&worst.begin);
        for stroke in [
            Stroke::new(5.0, tokens.outline()),
            Stroke::new(2.0, tokens.advice),
        ] {
            painter.circle_stroke(at, RING, stroke);
        }
    }

    /// Name of the mark where a landmark would mend the worst stretch.
    pub(super) fn remedy_label(
        &self,
        view: &ScreenFromWorld,
        tokens: &Tokens,
    ) -> Option<LandmarkLabel> {
        let worst = self
            .remedies
            .worst
            .filter(|_| self.remedies.landmark_helps())?;
        let ring = Rect::from_center_size(view.apply(&worst.begin), Vec2::splat(2.0 * RING));
        Some(LandmarkLabel {
            rank: ADVICE_RANK,
            around: ring,
            top: ring.center_top(),
            text: "a landmark here would help".to_owned(),
            color: tokens.advice,
        })
    }
}
