//! Pointer on routes of the map.

use egui::{CursorIcon, Key, Pos2, Response, Ui};
use pilotage_core::frames::GroundPoint;
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::{Mission, Route};

use super::PlanCommand;
use super::command::{AreaChange, RallyChange};
use super::hit::{AreaCorner, Hit, PlanPointer};
use super::planner::Planner;
use super::tab::PlanTab;
use crate::context::ViewContext;
use crate::documents::landmarks::LandmarkChange;
use crate::map::{ScreenFromWorld, drag_origin, tool_keys};

/// Distance from a way-point that still counts as on it, points.
const HIT_RADIUS: f32 = 14.0;
/// Shortest leg on screen that has a handle in its middle, points.
const SHORTEST_WITH_HANDLE: f32 = 56.0;

/// The point in the middle of a leg.
pub fn middle(a: GroundPoint, b: GroundPoint) -> GroundPoint {
    GroundPoint::new(0.5 * (a.north + b.north), 0.5 * (a.east + b.east))
}

/// The middles of the legs that are long enough on screen to be taken there, with the way-point
/// before each.
pub fn middles(route: &Route, view: &ScreenFromWorld) -> Vec<(usize, Pos2)> {
    route
        .way_points
        .windows(2)
        .enumerate()
        .filter_map(|(index, pair)| {
            let (a, b) = (pair[0].position, pair[1].position);
            let long = view.points(a.distance(&b)) >= SHORTEST_WITH_HANDLE;
            long.then(|| (index, view.apply(&middle(a, b))))
        })
        .collect()
}

fn nearest<T>(places: impl Iterator<Item = (T, Pos2)>, at: Pos2) -> Option<T> {
    places
        .map(|(what, place)| (what, place.distance(at)))
        .filter(|(_, distance)| *distance <= HIT_RADIUS)
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(what, _)| what)
}

fn distance_to_line(a: Pos2, b: Pos2, at: Pos2) -> f32 {
    let way = b - a;
    let share = (at - a).dot(way) / way.length_sq().max(1e-6);
    (a + share.clamp(0.0, 1.0) * way).distance(at)
}

/// Corners of all no-fly areas and of their holes.
fn area_corners(mission: &Mission) -> impl Iterator<Item = (AreaCorner, GroundPoint)> + '_ {
    let areas = mission.no_fly.iter().enumerate();
    let rings = areas.flat_map(|(area, of)| of.rings().enumerate().map(move |it| (area, it)));
    rings.flat_map(|(area, (ring, corners))| {
        let corners = corners.iter().enumerate();
        corners.map(move |(corner, at)| (AreaCorner { area, ring, corner }, *at))
    })
}

fn hit(
    mission: &Mission,
    selected: Option<&Route>,
    planner: &Planner,
    landmark: Option<&Landmark>,
    view: &ScreenFromWorld,
    at: Pos2,
) -> Option<Hit> {
    if let Some(corners) = landmark.and_then(Landmark::outline) {
        let places = corners.iter().map(|c| view.apply(c)).enumerate();
        if let Some(index) = nearest(places, at) {
            return Some(Hit::Corner(index));
        }
    }
    if let Some(route) = selected {
        let places = route.way_points.iter().enumerate();
        let places = places.map(|(index, w)| (index, view.apply(&w.position)));
        if let Some(index) = nearest(places, at) {
            return Some(Hit::WayPoint(index));
        }
        if let Some(index) = nearest(middles(route, view).into_iter(), at) {
            return Some(Hit::Middle(index));
        }
    }
    let rally = mission.rally.iter().enumerate();
    let rally = rally.map(|(index, point)| (index, view.apply(&point.position)));
    if let Some(index) = nearest(rally, at) {
        return Some(Hit::Rally(index));
    }
    if planner.tab == PlanTab::Ground {
        let places = area_corners(mission).map(|(which, at)| (which, view.apply(&at)));
        if let Some(corner) = nearest(places, at) {
            return Some(Hit::Area(corner));
        }
    }
    let others = mission
        .routes
        .iter()
        .filter(|r| Some(r.id) != selected.map(|s| s.id));
    let near = |route: &&Route| {
        route.way_points.windows(2).any(|pair| {
            let ends = [&pair[0], &pair[1]].map(|w| view.apply(&w.position));
            distance_to_line(ends[0], ends[1], at) < 0.6 * HIT_RADIUS
        })
    };
    others.into_iter().find(near).map(|r| Hit::Route(r.id))
}

impl PlanPointer {
    /// Takes the pointer; true if it is busy with the plan, so that nobody else shall use it.
    pub fn interact(
        &mut self,
        ui: &Ui,
        view: &ScreenFromWorld,
        response: &Response,
        planner: &Planner,
        context: &mut ViewContext<'_>,
    ) -> bool {
        let mission = context.mission;
        let selected = context.selected_route();
        let mut say = |command: PlanCommand| {
            let command = match selected.filter(|_| command.is_of_way_point()) {
                Some(route) => command.of(route.id),
                None => command,
            };
            context.commands.push(command.into());
        };
        let landmark = context.selection.and_then(|id| mission.landmark(id));
        let under = |at: Pos2| hit(mission, selected, planner, landmark, view, at);
        let at = response.interact_pointer_pos();
        self.hovered = response.hover_pos().and_then(under);
        let draws = planner.drawing || planner.marking.is_some();
        let over = response.hover_pos().filter(|_| draws);
        self.pointer = over.map(|p| view.inverse(p));
        if let Some(marking) = &planner.marking {
            self.hovered = None;
            marking.interact(ui, view, response, &mut say);
            // A drag still moves the map.
            return response.clicked() || response.double_clicked();
        }
        if self.dragged.is_none() {
            keyboard(ui, response, planner, context.selection, &mut say);
        }
        if let Some(origin) = drag_origin(ui, response) {
            match under(origin) {
                Some(Hit::WayPoint(index)) => {
                    self.dragged = Some(index);
                    say(PlanCommand::SelectWayPoint(Some(index)));
                }
                Some(Hit::Middle(behind)) => {
                    self.dragged = Some(behind + 1);
                    let at = view.inverse(origin);
                    say(PlanCommand::InsertWayPoint {
                        behind,
                        at,
                        finished: false,
                    });
                }
                Some(Hit::Corner(index)) => self.corner = landmark.map(|l| (l.id, index)),
                Some(Hit::Area(corner)) => self.area = Some(corner),
                Some(Hit::Rally(index)) => self.rally = Some(index),
                _ => {}
            }
        }
        if let Some((id, index)) = self.corner {
            let over = response.drag_stopped() || !response.dragged();
            let corners = mission.landmark(id).and_then(Landmark::outline);
            if let (Some(mut corners), Some(at)) = (corners, at) {
                if let Some(corner) = corners.get_mut(index) {
                    *corner = view.inverse(at);
                }
                say(PlanCommand::EditLandmarks {
                    ids: vec![id],
                    change: LandmarkChange::Outline(corners),
                    finished: over,
                });
            }
            if over {
                self.corner = None;
            }
            ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
            return true;
        }
        if self.area.is_some() || self.rally.is_some() {
            self.drag_place(view, response).into_iter().for_each(say);
            ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
            return true;
        }
        if let Some(index) = self.dragged {
            let over = response.drag_stopped() || !response.dragged();
            if let Some(at) = at {
                say(PlanCommand::MoveWayPoint {
                    index,
                    to: view.inverse(at),
                    finished: over,
                });
            }
            if over {
                self.dragged = None;
            }
            ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
            return true;
        }
        if response.clicked()
            && let Some(at) = at
        {
            return clicked(response, under(at), view.inverse(at), planner, &mut say);
        }
        if planner.drawing && self.hovered.is_none() {
            ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
        } else if self.hovered.is_some() {
            ui.ctx().set_cursor_icon(CursorIcon::Grab);
        }
        false
    }
}

impl PlanPointer {
    /// Drags the corner of a no-fly area or the rally point that is held.
    fn drag_place(&mut self, view: &ScreenFromWorld, response: &Response) -> Option<PlanCommand> {
        let finished = response.drag_stopped() || !response.dragged();
        let to = response.interact_pointer_pos().map(|at| view.inverse(at));
        let (area, rally) = (self.area, self.rally);
        if finished {
            (self.area, self.rally) = (None, None);
        }
        let to = to?;
        match (area, rally) {
            (Some(AreaCorner { area, ring, corner }), _) => Some(PlanCommand::EditArea {
                index: area,
                change: AreaChange::Corner { ring, corner, to },
                finished,
            }),
            (None, Some(index)) => Some(PlanCommand::EditRally {
                index,
                change: RallyChange::Place(to),
                finished,
            }),
            (None, None) => None,
        }
    }
}

/// A click: true if it was for the plan.
fn clicked(
    response: &Response,
    hit: Option<Hit>,
    ground: GroundPoint,
    planner: &Planner,
    say: &mut impl FnMut(PlanCommand),
) -> bool {
    if planner.drawing {
        if response.double_clicked() {
            say(PlanCommand::FinishDraw);
        } else {
            say(PlanCommand::AddWayPoint(Some(ground)));
        }
        return true;
    }
    match hit {
        Some(Hit::WayPoint(index)) => say(PlanCommand::SelectWayPoint(Some(index))),
        Some(Hit::Middle(behind)) => say(PlanCommand::InsertWayPoint {
            behind,
            at: ground,
            finished: true,
        }),
        Some(Hit::Route(id)) => say(PlanCommand::SelectRoute(id)),
        Some(Hit::Corner(_) | Hit::Area(_) | Hit::Rally(_)) => {}
        None => {
            if planner.way_point.is_some() {
                say(PlanCommand::SelectWayPoint(None));
            }
            return false;
        }
    }
    true
}

fn keyboard(
    ui: &Ui,
    response: &Response,
    planner: &Planner,
    landmark: Option<u32>,
    say: &mut impl FnMut(PlanCommand),
) {
    if planner.drawing {
        let ends = tool_keys(ui, response, [Key::Enter, Key::Escape]);
        if ends.contains(&true) {
            say(PlanCommand::FinishDraw);
        }
    }
    if planner.way_point.is_none() {
        return;
    }
    if tool_keys(ui, response, [Key::Escape])[0] {
        say(PlanCommand::SelectWayPoint(None));
    }
    if landmark.is_none() {
        let deletes = tool_keys(ui, response, [Key::Delete, Key::Backspace]);
        if deletes.contains(&true) {
            say(PlanCommand::DeleteWayPoint(None));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    #[test]
    fn beside_the_end_of_a_line_the_distance_is_that_to_the_end() {
        let (a, b) = (pos2(0.0, 0.0), pos2(10.0, 0.0));
        assert_eq!(distance_to_line(a, b, pos2(5.0, 3.0)), 3.0);
        assert_eq!(distance_to_line(a, b, pos2(14.0, 3.0)), 5.0);
    }
}
