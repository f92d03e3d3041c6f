//! Roads as a feature: commands carried out, and the state of the work on them.

use egui::{Rect, Ui};
use pilotage_core::frames::GroundPoint;
use pilotage_core::roads::{RoadClass, RoadLine};
use pilotage_jobs::{JobEvent, JobId};
use serde_json::{Map, Value};

use super::Roads;
use super::card::FOLLOWING;
use super::command::{ID, LABEL, RoadChange, RoadCommand, commands};
use super::drawing::{LegKind, RoadDrawing};
use super::geometry::{HIT, alike, are_one, meeting, snapped};
use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::feature::{Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace};
use crate::map::{MapButton, MapTool};
use crate::shell::CommandLack;
use crate::shell::icons::Icon;
use crate::state_json::object;

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: ID,
    tab: "Roads",
    place: FeaturePlace::Nowhere,
    commands,
};

/// Lack of a point at which a road could be split, and what to do about it.
const NO_POINT: &str = "No point of a road is selected";
const CLICK_POINT: &str = "Click one between the ends of the selected road first.";

/// The middle of the map, or a place of a road but those of `own` that is as near to it as if it were on it.
fn here(own: &[usize], context: &FeatureContext<'_>) -> GroundPoint {
    let camera = &context.map.camera;
    let roads = &context.documents.mission.roads;
    let reach = HIT * camera.metres_per_point;
    snapped(roads, own, camera.center, reach).unwrap_or(camera.center)
}

impl Roads {
    /// Takes the map, without a selected landmark: a drag over one would move it.
    fn begin(&mut self, context: &mut FeatureContext<'_>) {
        if !self.is_on {
            self.is_on = true;
            *context.selection = None;
            context.take_map();
        }
    }

    /// Leaves the map; a road that is being drawn is one by now, where it has two points.
    fn end(&mut self, context: &mut FeatureContext<'_>) {
        self.finish(context);
        self.leave();
    }

    fn leave(&mut self) {
        *self = Self {
            class: self.class,
            legs: self.legs,
            ..Self::default()
        };
    }

    fn select(&mut self, road: Option<usize>, point: Option<usize>) {
        (self.selected, self.point) = (road, point);
        (self.is_joining, self.has_lost_point) = (false, false);
    }

    /// Number of roads, and of points of the selected one.
    fn counts(&self, roads: &[RoadLine]) -> (usize, usize) {
        let road = self.selected.and_then(|index| roads.get(index));
        (roads.len(), road.map_or(0, |road| road.course.len()))
    }

    /// Selects nothing any more once roads came or went by other hands, such as undo, for their numbers are those of other
    /// roads; and no point once points of the selected road did. Points of other roads that are dragged with its own have
    /// other numbers, too, where they are no longer at its place.
    fn catch_up(&mut self, roads: &[RoadLine]) {
        let counts = self.counts(roads);
        if self.counts.0 != counts.0 {
            self.select(None, None);
            self.dragged.clear();
        } else if self.counts.1 != counts.1 {
            self.has_lost_point |= self.point.take().is_some();
            self.dragged.clear();
        } else if !are_one(roads, &self.dragged) {
            self.dragged.clear();
        }
        self.counts = self.counts(roads);
    }

    /// Says that roads are others than before, which may change the run.
    fn changed(context: &mut FeatureContext<'_>) {
        context.document_changed();
        if context.documents.uses_roads() {
            context.run_is_stale();
        }
    }

    /// Begins a road, or ends the one that is being drawn, once its legs are known or at the second time.
    fn draw(&mut self, context: &mut FeatureContext<'_>) {
        match &mut self.drawing {
            None => {
                self.drawing = Some(RoadDrawing::default());
                self.select(None, None);
            }
            Some(drawing) if drawing.is_awaited() && !drawing.is_ending => drawing.is_ending = true,
            Some(_) => self.finish(context),
        }
    }

    /// Makes a road of the one that is being drawn, which is none with less than two points; legs that are awaited are straight.
    fn finish(&mut self, context: &mut FeatureContext<'_>) {
        let Some(mut drawing) = self.drawing.take() else {
            return;
        };
        drawing.stop(context);
        let course = drawing.course();
        if course.len() > 1 {
            let width = drawing.width();
            let road = context.documents.add_road(self.class, width, &course);
            self.select(Some(road), None);
            Self::changed(context);
        }
        self.counts = self.counts(&context.documents.mission.roads);
    }

    /// Adds a leg to the road that is being drawn, which begins with it if none is.
    fn add(&mut self, place: GroundPoint, kind: LegKind, context: &mut FeatureContext<'_>) {
        let drawing = self.drawing.get_or_insert_default();
        drawing.add(place, kind, context);
        self.select(None, None);
    }

    fn back(&mut self, context: &mut FeatureContext<'_>) {
        match &mut self.drawing {
            // A road by now, as a route would be: undo takes it away again.
            Some(drawing) if drawing.len() > 1 => self.draw(context),
            Some(drawing) => {
                if !drawing.take_back(context) {
                    self.drawing = None;
                }
            }
            None if self.is_joining => self.is_joining = false,
            None if self.point.is_some() => self.point = None,
            None if self.selected.is_some() => self.select(None, None),
            None => self.leave(),
        }
    }

    fn carry_out(&mut self, command: RoadCommand, context: &mut FeatureContext<'_>) {
        if command == RoadCommand::Toggle && self.is_on {
            self.end(context);
            return;
        }
        if self.is_on {
            self.catch_up(&context.documents.mission.roads);
        }
        self.begin(context);
        let is_ending = self.drawing.as_ref().is_some_and(|it| it.is_ending);
        if is_ending && command != RoadCommand::TakeBack {
            // Whoever goes on does not wait.
            self.finish(context);
        }
        if !is_ending || !matches!(command, RoadCommand::Draw | RoadCommand::Back) {
            self.obey(command, context);
        }
        self.counts = self.counts(&context.documents.mission.roads);
    }

    /// Does what a command says, while it has the map.
    fn obey(&mut self, command: RoadCommand, context: &mut FeatureContext<'_>) {
        let roads = &context.documents.mission.roads;
        match command {
            RoadCommand::Toggle if roads.is_empty() => self.draw(context),
            RoadCommand::Toggle => {}
            RoadCommand::Draw => self.draw(context),
            RoadCommand::Add(place) => {
                let place = place.unwrap_or_else(|| here(&[], context));
                self.add(place, self.legs, context);
            }
            RoadCommand::AddStraight(place) => self.add(place, LegKind::Straight, context),
            RoadCommand::TakeBack => {
                if let Some(drawing) = &mut self.drawing {
                    drawing.take_back(context);
                }
            }
            RoadCommand::ToggleFollowing => {
                self.legs = match self.legs {
                    LegKind::Straight => LegKind::Followed,
                    LegKind::Followed => LegKind::Straight,
                };
            }
            RoadCommand::Back => self.back(context),
            RoadCommand::Select(road, point) => self.select(road, point),
            RoadCommand::Next => {
                self.finish(context);
                let roads = &context.documents.mission.roads;
                let next = self.selected.map_or(0, |road| road + 1);
                let next = (!roads.is_empty()).then(|| next % roads.len());
                self.select(next, None);
            }
            RoadCommand::NextPoint => {
                let road = self.selected.and_then(|road| roads.get(road));
                let next = self.point.map_or(0, |point| point + 1);
                self.point = road.map(|road| next % road.course.len().max(1));
            }
            RoadCommand::MoveHere
            | RoadCommand::Move { .. }
            | RoadCommand::Change { .. }
            | RoadCommand::DeletePoint
            | RoadCommand::Delete
            | RoadCommand::Split
            | RoadCommand::Join
            | RoadCommand::JoinWith(_) => {
                if let Some(road) = self.selected {
                    self.edit(road, command, context);
                }
            }
        }
    }

    /// Does something to the selected road.
    fn edit(&mut self, road: usize, command: RoadCommand, context: &mut FeatureContext<'_>) {
        let documents = &mut *context.documents;
        let is_changed = match command {
            RoadCommand::Change { change, finished } => {
                if let RoadChange::Class(class) = change {
                    self.class = class;
                }
                // No name matters for the run.
                let is_over = finished && !matches!(change, RoadChange::Name(_));
                let is_changed = documents.edit_road(road, change, finished);
                if is_changed && !is_over {
                    context.document_changed();
                }
                is_changed && is_over
            }
            RoadCommand::MoveHere => self.move_here(road, context),
            RoadCommand::Move {
                points,
                to,
                finished,
            } => {
                let is_changed = documents.move_road_points(&points, to, finished);
                if is_changed && !finished {
                    context.document_changed();
                }
                is_changed && finished
            }
            RoadCommand::DeletePoint => self.delete_point(road, context),
            RoadCommand::Delete => {
                self.select(None, None);
                documents.delete_road(road)
            }
            RoadCommand::Split => {
                let point = self.point.take();
                let is_split = point.is_some_and(|point| documents.split_road(road, point));
                if !is_split {
                    context.note(NO_POINT, CLICK_POINT);
                }
                is_split
            }
            RoadCommand::Join => {
                let other = meeting(&documents.mission.roads, road);
                self.is_joining = other.is_none();
                other.is_some_and(|other| self.join(road, other, documents))
            }
            RoadCommand::JoinWith(other) => self.join(road, other, documents),
            // Nothing about one road.
            RoadCommand::Toggle
            | RoadCommand::Draw
            | RoadCommand::Add(_)
            | RoadCommand::AddStraight(_)
            | RoadCommand::TakeBack
            | RoadCommand::ToggleFollowing
            | RoadCommand::Back
            | RoadCommand::Select(..)
            | RoadCommand::Next
            | RoadCommand::NextPoint => false,
        };
        if is_changed {
            Self::changed(context);
        }
    }

    /// Puts the selected point of a road, and those of others at the same place, into the middle of the map; whether one
    /// was moved.
    fn move_here(&self, road: usize, context: &mut FeatureContext<'_>) -> bool {
        let Some(point) = self.point else {
            return false;
        };
        let points = alike(&context.documents.mission.roads, road, point);
        let own: Vec<usize> = points.iter().map(|it| it.0).collect();
        let to = here(&own, context);
        context.documents.move_road_points(&points, to, true)
    }

    /// Joins two roads; whether they are one now.
    fn join(&mut self, road: usize, other: usize, documents: &mut Documents) -> bool {
        let joined = documents.join_roads(road, other);
        self.select(joined.or(Some(road)), None);
        joined.is_some()
    }

    /// Deletes the selected point of a road, with those of others at the same place, or the road where it would be none
    /// without; whether one was deleted. Where the point went by other hands, it was that and not the road which was meant.
    fn delete_point(&mut self, road: usize, context: &mut FeatureContext<'_>) -> bool {
        let point = self.point.take();
        if std::mem::take(&mut self.has_lost_point) && point.is_none() {
            context.note(NO_POINT, CLICK_POINT);
            return false;
        }
        let documents = &mut *context.documents;
        let length = documents.mission.roads.get(road);
        let length = length.map_or(0, |road| road.course.len());
        if let Some(point) = point.filter(|_| length > 2) {
            return documents.delete_road_point(road, point);
        }
        self.select(None, None);
        documents.delete_road(road)
    }
}

impl Feature for Roads {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        let command = command.action::<RoadCommand>().cloned();
        let is_known = command.is_some();
        if let Some(command) = command {
            self.carry_out(command, context);
        }
        is_known
    }

    fn missing(
        &self,
        command: &FeatureCommand,
        documents: &Documents,
        _selected: Option<u32>,
    ) -> Option<CommandLack> {
        let (is_there, what, advice) = match command.action()? {
            RoadCommand::Next => (
                !documents.mission.roads.is_empty(),
                "No roads",
                "Draw one, or open a file of them.",
            ),
            RoadCommand::NextPoint | RoadCommand::Delete | RoadCommand::Join => (
                self.selected.is_some(),
                "No road is selected",
                "Click one on the map.",
            ),
            RoadCommand::MoveHere | RoadCommand::DeletePoint | RoadCommand::Split => {
                (self.point.is_some(), NO_POINT, CLICK_POINT)
            }
            _ => return None,
        };
        CommandLack::unless(is_there, what, advice)
    }

    /// Takes the last leg of a road that is being drawn back.
    fn intercept(&mut self, command: &Command, context: &mut FeatureContext<'_>) -> bool {
        let drawing = self.drawing.as_mut().filter(|_| self.is_on);
        *command == Command::Undo && drawing.is_some_and(|it| it.take_back(context))
    }

    fn on_event(&mut self, job: JobId, event: JobEvent, context: &mut FeatureContext<'_>) -> bool {
        let Some(drawing) = &mut self.drawing else {
            return false;
        };
        let is_own = drawing.take(job, &event, context);
        if drawing.is_ending && !drawing.is_awaited() {
            self.finish(context);
        }
        is_own
    }

    /// Has the legs that are awaited go straight.
    fn stop(&mut self, context: &mut FeatureContext<'_>) -> bool {
        let is_stopped = self.drawing.as_mut().is_some_and(|it| it.stop(context));
        if is_stopped && self.drawing.as_ref().is_some_and(|it| it.is_ending) {
            self.finish(context);
        }
        is_stopped
    }

    fn progress(&self) -> Option<(f32, &str)> {
        let share = self.drawing.as_ref()?.progress()?;
        Some((share, FOLLOWING))
    }

    fn leave_map(&mut self, context: &mut FeatureContext<'_>) {
        if self.is_on {
            self.end(context);
        }
    }

    fn tend(&mut self, context: &mut FeatureContext<'_>) {
        if self.is_on {
            self.catch_up(&context.documents.mission.roads);
        }
    }

    fn on_flight_changed(&mut self, context: &mut FeatureContext<'_>) {
        if let Some(drawing) = &mut self.drawing {
            drawing.stop(context);
        }
        self.leave();
    }

    fn tool(&mut self) -> Option<&mut dyn MapTool> {
        if self.is_on { Some(self) } else { None }
    }

    fn over_map(&self, ui: &mut Ui, rect: Rect, context: &mut ViewContext<'_>) -> Vec<Rect> {
        let card = self.is_on.then(|| self.card(ui, rect, context));
        card.into_iter().collect()
    }

    fn is_open_over(&self) -> bool {
        self.is_on
    }

    fn map_button(&self) -> Option<MapButton> {
        Some(MapButton {
            icon: Icon::Road,
            label: LABEL,
            command: RoadCommand::Toggle.into(),
            is_on: self.is_on,
        })
    }

    fn needs_no_advice(&self) -> bool {
        self.is_on
    }

    fn state(&self, documents: &Documents) -> Value {
        let roads = &documents.mission.roads;
        let classes = RoadClass::ALL.iter().map(|(class, key, _)| {
            let count = roads.iter().filter(|road| road.class == *class).count();
            ((*key).to_owned(), Value::from(count))
        });
        let classes: Map<String, Value> = classes.filter(|it| it.1 != 0).collect();
        let selected = self.selected.and_then(|index| roads.get(index));
        object!({
            "count": roads.len(),
            "classes": classes,
            "on": self.is_on,
            "drawing": self.drawing.as_ref().map(RoadDrawing::len),
            "awaited": self.drawing.as_ref().is_some_and(RoadDrawing::is_awaited),
            "follows": self.legs == LegKind::Followed,
            "joining": self.is_joining,
            "point": self.point,
            "selected": selected.map(|road| object!({
                "name": road.name,
                "class": road.class.key(),
                "width": road.width,
                "course": road.course.iter().map(|p| [p.north, p.east]).collect::<Vec<_>>(),
            })),
        })
    }
}
