//! Roads as a tool of the map.

use egui::{CursorIcon, Pos2, Response, Shape, Stroke, Ui};
use pilotage_core::frames::GroundPoint;

use super::Roads;
use super::command::{RoadChange, RoadCommand, change};
use super::drawing::RoadDrawing;
use super::geometry::{HIT, alike, point_at, road_at, snapped};
use crate::context::ViewContext;
use crate::map::{MapCanvas, MapStage, MapTool, ScreenFromWorld, drag_origin, paint_lifted_line};

/// Shortest piece on the screen that has a handle in its middle, points.
const SHORTEST_WITH_HANDLE: f32 = 48.0;

/// Middles of the pieces that are long enough on the screen to be taken there; their indices.
fn middles(view: &ScreenFromWorld, course: &[GroundPoint]) -> Vec<(usize, GroundPoint)> {
    let pieces = course.windows(2).enumerate();
    let long = pieces.filter(|(_, ends)| {
        view.apply(&ends[0]).distance(view.apply(&ends[1])) >= SHORTEST_WITH_HANDLE
    });
    let middle = |[a, b]: [GroundPoint; 2]| {
        GroundPoint::new(0.5 * (a.north + b.north), 0.5 * (a.east + b.east))
    };
    long.map(|(index, ends)| (index, middle([ends[0], ends[1]])))
        .collect()
}

impl Roads {
    /// Course of the selected road.
    fn course<'a>(&self, roads: &'a [pilotage_core::roads::RoadLine]) -> &'a [GroundPoint] {
        let road = self.selected.and_then(|index| roads.get(index));
        road.map_or(&[][..], |road| &road.course)
    }

    /// Takes hold of a point of the selected road, or makes one of the middle of a piece.
    fn grasp(&mut self, view: &ScreenFromWorld, at: Pos2, context: &mut ViewContext<'_>) {
        let roads = &context.mission.roads;
        let course = self.course(roads);
        let (place, reach) = (view.inverse(at), HIT * view.metres_per_point);
        let Some(road) = self.selected else {
            return;
        };
        self.dragged.clear();
        if let Some(point) = point_at(course, place, reach) {
            self.dragged = alike(roads, road, point);
        } else {
            let middles = middles(view, course);
            let places: Vec<GroundPoint> = middles.iter().map(|it| it.1).collect();
            if let Some(handle) = point_at(&places, place, reach) {
                let index = middles[handle].0 + 1;
                let insert = RoadChange::Insert(index, place);
                context.commands.push(change(insert, false).into());
                self.dragged = vec![(road, index)];
            }
        }
        if let Some((_, point)) = self.dragged.first() {
            self.point = Some(*point);
        }
    }

    /// Does what a click asks for; of a road that is drawn `is_straight` says that the next leg is.
    fn click(
        &mut self,
        view: &ScreenFromWorld,
        (at, is_straight): (Pos2, bool),
        context: &mut ViewContext<'_>,
    ) {
        let roads = &context.mission.roads;
        let (place, reach) = (view.inverse(at), HIT * view.metres_per_point);
        if let Some(drawing) = self.drawing.as_ref().filter(|it| !it.is_ending) {
            let command = if drawing.ends_at(place, reach) {
                // So the second click of two that are one ends the road.
                (drawing.len() > 1).then_some(RoadCommand::Draw)
            } else {
                let place = snapped(roads, &[], place, reach).unwrap_or(place);
                Some(if is_straight {
                    RoadCommand::AddStraight(place)
                } else {
                    RoadCommand::Add(Some(place))
                })
            };
            context.commands.extend(command.map(Into::into));
            return;
        }
        let road = road_at(roads, place, reach).map(|it| it.road);
        let command = match road {
            Some(other) if self.is_joining && Some(other) != self.selected => {
                RoadCommand::JoinWith(other)
            }
            _ => {
                let point = point_at(self.course(roads), place, reach);
                let road = if point.is_some() { self.selected } else { road };
                RoadCommand::Select(road, point)
            }
        };
        context.commands.push(command.into());
    }
}

impl MapTool for Roads {
    fn interact(
        &mut self,
        ui: &Ui,
        view: &ScreenFromWorld,
        response: &Response,
        context: &mut ViewContext<'_>,
    ) -> bool {
        self.keyboard(ui, response, context);
        let at = response.interact_pointer_pos();
        let origin = drag_origin(ui, response).filter(|_| self.drawing.is_none());
        if let Some(origin) = origin {
            self.grasp(view, origin, context);
        }
        if let Some((_, point)) = self.dragged.first().copied() {
            let is_over = !response.dragged();
            let roads = &context.mission.roads;
            let reach = HIT * view.metres_per_point;
            let place = at.map(|at| {
                let place = view.inverse(at);
                let own: Vec<usize> = self.dragged.iter().map(|it| it.0).collect();
                snapped(roads, &own, place, reach).unwrap_or(place)
            });
            let place = place.or_else(|| self.course(roads).get(point).copied());
            if let Some(to) = place {
                let command = RoadCommand::Move {
                    points: self.dragged.clone(),
                    to,
                    finished: is_over,
                };
                context.commands.push(command.into());
            }
            if is_over {
                self.dragged.clear();
            }
            ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
            return true;
        }
        if response.clicked()
            && let Some(at) = at
        {
            let is_straight = ui.input(|input| input.modifiers.shift);
            self.click(view, (at, is_straight), context);
            return true;
        }
        if response.hovered() && self.drawing.is_some() {
            ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
        }
        // A drag moves the map.
        false
    }

    fn takes_middle(&self, has_keyboard: bool) -> bool {
        has_keyboard && (self.drawing.is_some() || self.point.is_some())
    }

    fn paint(&self, stage: MapStage, canvas: &MapCanvas<'_>) {
        if stage != MapStage::Last {
            return;
        }
        let MapCanvas {
            painter,
            view,
            tokens,
            mission,
            ..
        } = *canvas;
        let drawn = self.drawing.as_ref().map(RoadDrawing::course);
        let course = drawn.as_deref();
        let course = course.unwrap_or_else(|| self.course(&mission.roads));
        let line: Vec<Pos2> = course.iter().map(|point| view.apply(point)).collect();
        for ends in line.windows(2) {
            // Its own colour: routes are lines of the accent.
            paint_lifted_line(painter, [ends[0], ends[1]], 4.0, tokens.road, tokens);
        }
        let edge = Stroke::new(1.0, tokens.outline());
        if self.drawing.is_none() {
            for (_, middle) in middles(view, course) {
                painter.circle(view.apply(&middle), 3.5, tokens.surface, edge);
            }
        }
        // Of a road that is drawn the ends of the legs, which are what is taken back.
        let drawn_ends = self
            .drawing
            .as_ref()
            .map(|it| it.ends().map(|end| view.apply(&end)));
        let points: Vec<Pos2> = drawn_ends.map_or_else(|| line.clone(), Iterator::collect);
        for (index, at) in points.iter().enumerate() {
            let is_chosen = self.point == Some(index);
            let radius = if is_chosen { 6.5 } else { 4.5 };
            painter.circle(*at, radius, tokens.accent, edge);
        }
        let Some((pointer, last)) = canvas.pointer.zip(line.last()) else {
            return;
        };
        if self.drawing.as_ref().is_some_and(|it| !it.is_ending) {
            let reach = HIT * view.metres_per_point;
            let place = snapped(&mission.roads, &[], view.inverse(pointer), reach);
            let to = place.map_or(pointer, |place| view.apply(&place));
            let next = Shape::dashed_line(&[*last, to], Stroke::new(2.0, tokens.accent), 6.0, 5.0);
            painter.extend(next);
            if place.is_some() {
                painter.circle_stroke(to, 8.0, Stroke::new(2.0, tokens.accent));
            }
        }
    }
}
