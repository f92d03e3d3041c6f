//! Choosing A, B and no-fly areas on the map, and drawing them and what was found.

use egui::{Align2, Color32, CursorIcon, Key, Painter, Pos2, Response, Shape, Stroke, Ui, vec2};
use pilotage_core::frames::GroundPoint;
use pilotage_core::mission::Mission;
use pilotage_core::plan::RoutePrediction;
use pilotage_core::sorting::sort;

use super::PlanCommand;
use super::corridor_paint::corridor_band;
use super::find_command::{FindCommand, FindPick};
use super::planner::Planner;
use super::purpose::AGAIN;
use super::tab::PlanTab;
use crate::command::Command;
use crate::context::ViewContext;
use crate::map::{ScreenFromWorld, paint_halo_text};
use crate::tokens::Tokens;

/// A click this near to the first corner closes an area, points.
const CLOSING: f32 = 12.0;

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
        if !ui.ctx().text_edit_focused() {
            let (enter, escape) =
                ui.input(|i| (i.key_pressed(Key::Enter), i.key_pressed(Key::Escape)));
            if escape {
                say(FindCommand::Pick(FindPick::Nothing));
            } else if enter && finder.pick == FindPick::Area {
                say(FindCommand::FinishArea);
            }
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
        let first = finder.corners.first().map(|p| view.apply(p));
        let closes = finder.corners.len() >= 3
            && (response.double_clicked() || first.is_some_and(|f| f.distance(at) < CLOSING));
        let is_area = finder.pick == FindPick::Area;
        let last = finder.corners.last().filter(|_| is_area);
        let last = last.map(|corner| view.apply(corner));
        if is_area && closes {
            say(FindCommand::FinishArea);
        } else if last.is_none_or(|last| last.distance(at) > AGAIN) {
            // Not so the first click of a double one on the last corner.
            say(FindCommand::Click(view.inverse(at)));
        }
        true
    }

    /// Draws no-fly areas, both ends and what was found.
    pub(crate) fn paint_find(
        &self,
        painter: &Painter,
        view: &ScreenFromWorld,
        mission: &Mission,
        pointer: Option<Pos2>,
        tokens: &Tokens,
    ) {
        for zone in &mission.no_fly {
            let corners: Vec<Pos2> = zone.corners.iter().map(|p| view.apply(p)).collect();
            let corners_held = self.tab == PlanTab::Ground;
            paint_area(painter, corners, true, corners_held, tokens);
            if let Some(middle) = middle(&zone.corners) {
                let at = view.apply(&middle);
                let (align, font) = (Align2::CENTER_CENTER, tokens.small());
                paint_halo_text(painter, at, align, &zone.name, font, tokens.sigma);
            }
        }
        let finder = &self.finder;
        if !finder.corners.is_empty() {
            let mut corners: Vec<Pos2> = finder.corners.iter().map(|p| view.apply(p)).collect();
            corners.extend(pointer);
            paint_area(painter, corners, false, true, tokens);
        }
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

fn middle(corners: &[GroundPoint]) -> Option<GroundPoint> {
    let n = corners.len() as f64;
    let sum = |of: fn(&GroundPoint) -> f64| corners.iter().map(of).sum::<f64>() / n;
    (!corners.is_empty()).then(|| GroundPoint::new(sum(|p| p.north), sum(|p| p.east)))
}

fn paint_prediction(
    painter: &Painter,
    view: &ScreenFromWorld,
    prediction: &RoutePrediction,
    color: Color32,
) {
    painter.add(corridor_band(view, prediction, color.gamma_multiply(0.3)));
}

/// An area with its edge and slanting lines, which also work where it is no convex polygon.
/// `held` says whether its corners can be taken.
fn paint_area(
    painter: &Painter,
    mut corners: Vec<Pos2>,
    closed: bool,
    held: bool,
    tokens: &Tokens,
) {
    if closed {
        hatch(painter, &corners, tokens.no_fly.gamma_multiply(0.7));
    }
    for at in &corners {
        painter.circle_filled(*at, if held { 4.0 } else { 2.0 }, tokens.no_fly);
    }
    if closed {
        corners.extend(corners.first().copied());
    }
    let outline = Stroke::new(4.0, tokens.outline());
    painter.add(Shape::line(corners.clone(), outline));
    painter.add(Shape::line(corners, Stroke::new(2.0, tokens.no_fly)));
}

/// Slanting lines inside a polygon.
fn hatch(painter: &Painter, corners: &[Pos2], color: Color32) {
    const APART: f32 = 12.0;
    let along = |p: &Pos2| p.x + p.y;
    let low = corners.iter().map(along).fold(f32::INFINITY, f32::min);
    let high = corners.iter().map(along).fold(f32::NEG_INFINITY, f32::max);
    let clip = painter.clip_rect();
    let low = low.max(clip.left() + clip.top());
    let high = high.min(clip.right() + clip.bottom());
    let mut level = (low / APART).ceil() * APART;
    while level < high {
        // Where the line x + y = level crosses the edges.
        let mut crossings: Vec<Pos2> = (0..corners.len())
            .filter_map(|i| {
                let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
                let (from, to) = (along(&a) - level, along(&b) - level);
                ((from < 0.0) != (to < 0.0)).then(|| a + (b - a) * (from / (from - to)))
            })
            .collect();
        sort(&mut crossings, &|a, b| a.x.total_cmp(&b.x));
        for pair in crossings.chunks_exact(2) {
            painter.line_segment([pair[0], pair[1]], Stroke::new(1.0, color));
        }
        level += APART;
    }
}

/// Words on what to click next; `None` while nothing is chosen.
pub fn hint(pick: FindPick, corners: usize) -> Option<&'static str> {
    match pick {
        FindPick::Nothing => None,
        FindPick::From => Some("Click on the map where the route begins (A)."),
        FindPick::To => Some("Click on the map where it ends (B)."),
        FindPick::Area if corners < 3 => {
            Some("Click the corners of the area that must not be flown over.")
        }
        FindPick::Area => Some("Enter, a double click or a click on the first corner closes it."),
    }
}

/// A line of words at the top of the map while something is chosen.
pub(super) fn paint_hint(
    painter: &Painter,
    rect: egui::Rect,
    pick: FindPick,
    corners: usize,
    tokens: &Tokens,
) {
    if let Some(words) = hint(pick, corners) {
        let at = rect.center_top() + vec2(0.0, 84.0);
        let (align, font) = (Align2::CENTER_TOP, tokens.normal());
        paint_halo_text(painter, at, align, words, font, tokens.sigma);
    }
}
