//! Marking places on the map by clicks: outlines, points, reference points.

use egui::{Align2, Color32, CursorIcon, Key, Painter, Pos2, Response, Shape, Stroke, Ui, vec2};
use pilotage_core::frames::GroundPoint;

use super::command::PlanCommand;
use super::purpose::{AGAIN, CLOSING, FEWEST, Purpose};
use crate::map::{ScreenFromWorld, paint_halo_text, tool_keys};
use crate::tokens::Tokens;

/// Place of what to do below the figures at the top of the map, from the middle of its upper edge.
pub(super) const BELOW_FIGURES: egui::Vec2 = vec2(0.0, 84.0);

/// Places being marked.
#[derive(Clone, Debug, PartialEq)]
pub struct Marking {
    /// Purpose of the marked places.
    pub purpose: Purpose,
    /// The places so far.
    pub corners: Vec<GroundPoint>,
}

/// Places that were marked when people turned to something else.
#[derive(Debug)]
pub struct PutAway {
    /// The places.
    pub marking: Marking,
    /// Edits of the mission until then: after another one, undo is about that.
    pub edits: u64,
}

impl Marking {
    /// Nothing marked yet.
    pub fn new(purpose: Purpose) -> Self {
        Self {
            purpose,
            corners: Vec::new(),
        }
    }

    /// Takes the pointer and the keyboard while places are marked.
    pub(super) fn interact(
        &self,
        ui: &Ui,
        view: &ScreenFromWorld,
        response: &Response,
        say: &mut impl FnMut(PlanCommand),
    ) {
        ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
        let times = ui.input(|i| i.num_presses(Key::Backspace));
        let keys = [Key::Enter, Key::Escape, Key::Backspace, Key::Delete];
        let [enter, escape, back, delete] = tool_keys(ui, response, keys);
        if escape {
            say(PlanCommand::CancelMarking);
        } else if enter {
            if self.purpose.is_point() {
                // By keyboard: the middle of the map.
                say(PlanCommand::AddCorner(view.inverse(response.rect.center())));
            }
            say(PlanCommand::FinishMarking);
        } else if back || delete {
            for _ in 0..times.max(1) {
                say(PlanCommand::RemoveCorner);
            }
        }
        if response.double_clicked() && !self.purpose.is_point() {
            say(PlanCommand::FinishMarking);
        } else if response.clicked()
            && let Some(at) = response.interact_pointer_pos()
        {
            let last = self.corners.last().map(|corner| view.apply(corner));
            let closes = self.is_closed_at(view, at);
            if !closes && last.is_none_or(|last| last.distance(at) > AGAIN) {
                say(PlanCommand::AddCorner(view.inverse(at)));
            }
            if closes || self.purpose.is_point() {
                say(PlanCommand::FinishMarking);
            }
        }
    }

    /// Whether a click closes the outline: one on its first corner.
    fn is_closed_at(&self, view: &ScreenFromWorld, at: Pos2) -> bool {
        let first = self.corners.first().map(|corner| view.apply(corner));
        let is_near = first.is_some_and(|first| first.distance(at) < CLOSING);
        is_near && !self.purpose.is_point() && self.corners.len() >= FEWEST
    }

    /// Draws the corners so far, and what to do.
    pub(super) fn paint(
        &self,
        painter: &Painter,
        view: &ScreenFromWorld,
        pointer: Option<GroundPoint>,
        tokens: &Tokens,
    ) {
        let mut line: Vec<_> = self.corners.iter().map(|c| view.apply(c)).collect();
        if !self.purpose.is_point() {
            line.extend(pointer.map(|p| view.apply(&p)));
        }
        let color = if self.purpose.is_about_no_fly() {
            tokens.no_fly
        } else {
            tokens.accent
        };
        if line.len() >= 2 {
            let edge = Stroke::new(4.0, tokens.outline());
            painter.add(Shape::closed_line(line.clone(), edge));
            painter.add(Shape::closed_line(line, Stroke::new(2.0, color)));
        }
        for corner in &self.corners {
            let edge = Stroke::new(1.5, tokens.outline());
            painter.circle(view.apply(corner), 4.5, color, edge);
        }
        let at = painter.clip_rect().center_top() + BELOW_FIGURES;
        let words = self.purpose.advice(self.corners.len());
        let (align, font) = (Align2::CENTER_TOP, tokens.normal());
        paint_halo_text(painter, at, align, words, font, Color32::WHITE);
    }
}
