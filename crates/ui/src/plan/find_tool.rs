//! Choosing A and B on the map, and drawing them and what was found.

use egui::{Align2, Color32, CursorIcon, Key, Painter, Pos2, Response, Shape, Stroke, Ui};
use pilotage_core::frames::GroundPoint;
use pilotage_core::plan::RoutePrediction;

use super::PlanCommand;
use super::corridor_paint::corridor_band;
use super::find_command::{FindCommand, FindPick};
use super::marking::BELOW_FIGURES;
use super::planner::Planner;
use crate::command::Command;
use crate::context::ViewContext;
use crate::map::{ScreenFromWorld, paint_halo_text, tool_keys};
use crate::tokens::Tokens;

impl Planner {
    /// Takes the pointer while something is chosen for the search; true if it did.
    pub(crate) fn choose_on_map(
        &self,
        ui: &Ui,
        view: &ScreenFromWorld,
        response: &Response,
        context: &mut ViewContext<'_>,
    ) -> bool {
        let finder = &self.finder;
        if finder.pick == FindPick::Nothing {
            return false;
        }
        let mut say = |command| {
            context
                .commands
                .push(Command::from(PlanCommand::Find(command)));
        };
        let [enter, escape] = tool_keys(ui, response, [Key::Enter, Key::Escape]);
        if escape {
            say(FindCommand::Pick(FindPick::Nothing));
        } else if enter {
            // By keyboard: the middle of the map.
            say(FindCommand::Click(view.inverse(response.rect.center())));
        }
        if response.hovered() {
            ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
        }
        let Some(at) = response
            .interact_pointer_pos()
            .filter(|_| response.clicked())
        else {
            return false;
        };
        say(FindCommand::Click(view.inverse(at)));
        true
    }

    /// Draws both ends and what was found.
    pub(crate) fn paint_find(&self, painter: &Painter, view: &ScreenFromWorld, tokens: &Tokens) {
        let finder = &self.finder;
        if let Some(found) = &finder.found {
            paint_prediction(painter, view, &found.shortest.prediction, tokens.ghost);
            paint_prediction(painter, view, &found.surest.prediction, tokens.truth);
            let line = |places: &[GroundPoint]| -> Vec<Pos2> {
                places.iter().map(|p| view.apply(p)).collect()
            };
            let outline = Stroke::new(4.5, tokens.outline());
            let straight = line(&found.shortest.route.way_points);
            painter.add(Shape::line(straight.clone(), outline));
            let stroke = Stroke::new(2.0, tokens.sigma);
            painter.extend(Shape::dashed_line(&straight, stroke, 8.0, 5.0));
            let surest = line(&found.surest.route.way_points);
            painter.add(Shape::line(surest.clone(), outline));
            painter.add(Shape::line(surest.clone(), Stroke::new(2.5, tokens.truth)));
            for at in surest.iter().skip(1).rev().skip(1) {
                painter.circle(*at, 4.5, tokens.surface, Stroke::new(2.0, tokens.truth));
            }
        } else if let (Some(from), Some(to)) = (finder.from, finder.to) {
            let line = [view.apply(&from), view.apply(&to)];
            let stroke = Stroke::new(1.5, tokens.sigma);
            painter.extend(Shape::dashed_line(&line, stroke, 8.0, 5.0));
        }
        for (end, name) in [(finder.from, "A"), (finder.to, "B")] {
            if let Some(end) = end {
                let at = view.apply(&end);
                painter.circle_filled(at, 13.0, tokens.outline());
                let edge = Stroke::new(2.0, tokens.sigma);
                painter.circle(at, 11.0, tokens.surface, edge);
                let font = tokens.normal();
                painter.text(at, Align2::CENTER_CENTER, name, font, tokens.text);
            }
        }
    }
}

fn paint_prediction(
    painter: &Painter,
    view: &ScreenFromWorld,
    prediction: &RoutePrediction,
    color: Color32,
) {
    painter.add(corridor_band(view, prediction, color.gamma_multiply(0.3)));
}

/// Words on what to click next; `None` while nothing is chosen.
pub fn hint(pick: FindPick, tokens: &Tokens) -> Option<&'static str> {
    let words = match pick {
        FindPick::Nothing => return None,
        FindPick::From => tokens.advice(
            "Click on the map where the route begins (A); Enter takes its middle.",
            "Tap on the map where the route begins (A).",
        ),
        FindPick::To => tokens.advice(
            "Click on the map where it ends (B); Enter takes its middle.",
            "Tap on the map where it ends (B).",
        ),
    };
    Some(words)
}

/// A line of words at the top of the map while something is chosen.
pub(super) fn paint_hint(painter: &Painter, rect: egui::Rect, pick: FindPick, tokens: &Tokens) {
    if let Some(words) = hint(pick, tokens) {
        let at = rect.center_top() + BELOW_FIGURES;
        let (align, font) = (Align2::CENTER_TOP, tokens.normal());
        paint_halo_text(painter, at, align, words, font, tokens.sigma);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fingers_are_told_of_no_keys() {
        let mut tokens = Tokens::dark();
        for (touch, has_keys) in [(false, true), (true, false)] {
            tokens.touch = touch;
            for pick in [FindPick::From, FindPick::To] {
                let words = hint(pick, &tokens).expect("words");
                assert_eq!(words.contains("Enter"), has_keys, "{words}");
            }
        }
        assert_eq!(hint(FindPick::Nothing, &tokens), None);
    }
}
