//! Edits of routes, each one undo step; a drag is one.

use pilotage_core::frames::{Altitude, GroundPoint};
use pilotage_core::mission::{Mission, Route, WayPoint};

use super::patterns::Pattern;
use crate::context::route_of;
use crate::documents::Documents;

/// Extent of an edit: whole, or part of a drag that goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EditStep {
    /// Edit that is an undo step of its own.
    Whole,
    /// Part of a drag.
    Drag,
}

impl EditStep {
    /// A whole step if `finished`.
    pub fn of(finished: bool) -> Self {
        if finished { Self::Whole } else { Self::Drag }
    }
}

impl Documents {
    /// An id that no route of the mission has.
    pub fn free_route_id(&self) -> u32 {
        let ids = self.mission.routes.iter().map(|r| r.id + 1);
        ids.max().unwrap_or(1)
    }

    /// A name that no route of the mission has: `wanted`, or with a number behind it. Studies and exports know routes by
    /// their names.
    pub fn free_route_name(&self, wanted: &str) -> String {
        let is_taken = |name: &str| self.mission.routes.iter().any(|it| it.name == name);
        let wanted = if wanted.is_empty() { "Route" } else { wanted };
        let numbered = (2..).map(|number| format!("{wanted} {number}"));
        let mut names = std::iter::once(wanted.to_owned()).chain(numbered);
        names.find(|name| !is_taken(name)).unwrap_or_default()
    }

    /// Adds a route and returns its id.
    pub fn add_route(&mut self, name: Option<&str>, way_points: Vec<WayPoint>) -> u32 {
        self.mission.remember();
        self.mission.is_edited = true;
        let id = self.free_route_id();
        let name = name.map_or_else(|| format!("Route {id}"), str::to_owned);
        let name = self.free_route_name(&name);
        self.mission.routes.push(Route {
            id,
            name,
            way_points,
            ..Route::default()
        });
        id
    }

    /// Adds a route like another, with all that is known of it, and returns its id.
    pub fn duplicate_route(&mut self, id: u32) -> Option<u32> {
        let mut route = route_of(&self.mission, id)?.clone();
        self.mission.remember();
        self.mission.is_edited = true;
        route.id = self.free_route_id();
        route.name = self.free_route_name(&format!("{}, copy", route.name));
        let id = route.id;
        self.mission.routes.push(route);
        Some(id)
    }

    /// Adds a route that was made, called `kind` and its number, and returns its id.
    pub fn add_made(&mut self, mut route: Route, kind: &str) -> u32 {
        self.mission.remember();
        self.mission.is_edited = true;
        route.id = self.free_route_id();
        route.name = self.free_route_name(&format!("{kind} {}", route.id));
        let id = route.id;
        self.mission.routes.push(route);
        id
    }

    /// Changes a route. A step that changes nothing is none.
    pub fn edit_route(&mut self, id: u32, step: EditStep, change: impl FnOnce(&mut Route)) {
        let Some(at) = self.mission.routes.iter().position(|r| r.id == id) else {
            return;
        };
        let mut route = self.mission.routes[at].clone();
        change(&mut route);
        // The end of a drag closes its step, whether or not the last move changed anything.
        if route != self.mission.routes[at] {
            self.mission.history.begin_drag(&self.mission.content);
            self.mission.routes[at] = route;
            self.mission.is_edited = true;
        }
        if step == EditStep::Whole {
            self.mission.history.finish_drag(&self.mission.content);
        }
    }

    /// Gives a route a name that no other one has.
    pub fn rename_route(&mut self, id: u32, name: &str) {
        if route_of(&self.mission, id).is_some_and(|route| route.name != name) {
            let name = self.free_route_name(name);
            self.edit_route(id, EditStep::Whole, |route| route.name = name);
        }
    }

    /// Deletes a route.
    pub fn delete_route(&mut self, id: u32) {
        if route_of(&self.mission, id).is_some() {
            self.mission.remember();
            self.mission.routes.retain(|r| r.id != id);
            self.mission.is_edited = true;
        }
    }

    /// Takes away a route that came to nothing: no step to be undone, where nothing but it was edited since it was begun.
    pub fn give_up_route(&mut self, id: u32) {
        let without = |mission: &Mission| {
            let mut mission = mission.clone();
            mission.routes.retain(|route| route.id != id);
            mission
        };
        let mission = &mut self.mission;
        match mission.history.give_up(&mission.content, without) {
            Some(before) => mission.content = before,
            None => self.delete_route(id),
        }
    }

    /// Makes two routes of one at a way-point; the second one's id. Parts of a pattern are none.
    pub fn split_route(&mut self, id: u32, index: usize) -> Option<u32> {
        let whole = route_of(&self.mission, id)?;
        let (mut first, mut second) = whole.split(index)?;
        self.relief().keep_heights(whole, &mut second);
        Pattern::release(&mut first);
        Pattern::release(&mut second);
        self.mission.remember();
        self.mission.is_edited = true;
        let at = self.mission.routes.iter().position(|r| r.id == id)?;
        second.id = self.free_route_id();
        second.name = self.free_route_name(&format!("{}, second part", first.name));
        let new = second.id;
        self.mission.routes[at] = first;
        self.mission.routes.insert(at + 1, second);
        Some(new)
    }
}

/// A way-point like `before` at another place.
pub fn like(before: Option<&WayPoint>, at: GroundPoint, otherwise: Altitude) -> WayPoint {
    let mut new = WayPoint::new(at, before.map_or(otherwise, |w| w.altitude));
    new.speed = before.and_then(|w| w.speed);
    new
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::documents::Session;
    use pilotage_core::frames::AltitudeFrame;

    const ALTITUDE: Altitude = Altitude::new(120.0, AltitudeFrame::AboveGround);

    fn documents() -> (Documents, u32) {
        let mut documents = Documents::new(&Session::demo());
        let places = [(0.0, 0.0), (300.0, 0.0), (300.0, 400.0)];
        let way_points = places.map(|(n, e)| WayPoint::new(GroundPoint::new(n, e), ALTITUDE));
        let id = documents.add_route(None, way_points.to_vec());
        (documents, id)
    }

    #[test]
    fn a_route_that_is_given_up_after_a_click_leaves_nothing_to_be_undone() {
        let (mut documents, first) = documents();
        let depth = documents.mission.history.depth();
        let begun = documents.add_route(None, Vec::new());
        let point = WayPoint::new(GroundPoint::new(5.0, 6.0), ALTITUDE);
        documents.edit_route(begun, EditStep::Whole, |route| route.way_points.push(point));
        documents.give_up_route(begun);
        assert_eq!(documents.mission.history.depth(), depth);
        assert!(route_of(&documents.mission, first).is_some());
        // With an edit in between there is something to be undone.
        let begun = documents.add_route(None, Vec::new());
        documents.delete_route(first);
        documents.give_up_route(begun);
        assert_eq!(documents.mission.history.depth().0, depth.0 + 3);
        assert!(documents.mission.routes.iter().all(|it| it.id != begun));
    }

    #[test]
    fn a_way_point_dragged_far_goes_back_in_one_step() {
        let (mut documents, id) = documents();
        let depth = documents.mission.history.depth().0;
        for metres in [10.0, 20.0, 30.0] {
            documents.edit_route(id, EditStep::Drag, |r| {
                r.way_points[1].position.north += metres;
            });
        }
        documents.edit_route(id, EditStep::Whole, |_| {});
        assert_eq!(documents.mission.history.depth().0, depth + 1);
        documents.undo();
        let route = route_of(&documents.mission, id).unwrap();
        assert_eq!(route.way_points[1].position.north, 300.0);
    }

    #[test]
    fn a_split_route_is_whole_again_after_one_undo() {
        let (mut documents, id) = documents();
        let before = documents.mission.clone();
        let second = documents.split_route(id, 1).unwrap();
        assert_ne!(second, id);
        assert_eq!(documents.mission.routes.len(), 2);
        assert_eq!(documents.undo(), Some(false), "the flight is not affected");
        assert_eq!(documents.mission.content, before);
    }

    #[test]
    fn each_part_of_a_route_that_is_split_twice_has_a_name_of_its_own() {
        let (mut documents, id) = documents();
        let place = WayPoint::new(GroundPoint::new(600.0, 400.0), ALTITUDE);
        documents.edit_route(id, EditStep::Whole, |r| r.way_points.push(place));
        documents.split_route(id, 2).unwrap();
        documents.split_route(id, 1).unwrap();
        let mut names: Vec<_> = documents.mission.routes.iter().map(|r| &r.name).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), 3, "{names:?}");
    }

    #[test]
    fn the_parts_of_a_split_pattern_are_patterns_no_more_but_a_copy_is_one() {
        let (mut documents, id) = documents();
        let frame = pilotage_core::frames::LocalFrame::new(documents.mission.origin);
        let places = route_of(&documents.mission, id).unwrap().way_points.clone();
        let places: Vec<GroundPoint> = places.iter().map(|w| w.position).collect();
        let pattern = Pattern::new(
            super::super::patterns::CoveredGround::Survey,
            &places,
            &frame,
        );
        let text = serde_json::to_string(&pattern).unwrap();
        documents.edit_route(id, EditStep::Whole, |r| {
            r.properties.insert("pattern".to_owned(), text);
            r.properties.insert("owner".to_owned(), "\"us\"".to_owned());
        });
        let copy = documents.duplicate_route(id).unwrap();
        let of = |documents: &Documents, id| route_of(&documents.mission, id).cloned().unwrap();
        let (original, copied) = (of(&documents, id), of(&documents, copy));
        assert_eq!(Pattern::of(&copied), Some(pattern));
        assert_eq!(copied.properties, original.properties);
        assert_eq!(copied.name, format!("{}, copy", original.name));
        let second = documents.split_route(id, 1).unwrap();
        for part in [id, second] {
            let part = of(&documents, part);
            assert_eq!(Pattern::of(&part), None);
            assert!(part.properties.contains_key("owner"));
        }
    }

    #[test]
    fn a_route_that_is_split_or_renamed_has_a_name_of_its_own() {
        let (mut documents, first) = documents();
        let copy = documents.duplicate_route(first).unwrap();
        let name =
            |documents: &Documents, id| route_of(&documents.mission, id).unwrap().name.clone();
        documents.rename_route(copy, &name(&documents, first));
        assert_eq!(name(&documents, copy), "Route 1 2");
        documents.rename_route(copy, "Home");
        documents.rename_route(copy, "Home");
        assert_eq!(name(&documents, copy), "Home");
        // Both parts of a route that was split before, too.
        let second = documents.split_route(copy, 1).unwrap();
        let way_points = route_of(&documents.mission, first)
            .unwrap()
            .way_points
            .clone();
        documents.edit_route(copy, EditStep::Whole, |route| route.way_points = way_points);
        let third = documents.split_route(copy, 1).unwrap();
        assert_eq!(name(&documents, second), "Home, second part");
        assert_eq!(name(&documents, third), "Home, second part 2");
    }

    #[test]
    fn an_edit_that_changes_nothing_is_no_step() {
        let (mut documents, id) = documents();
        let depth = documents.mission.history.depth();
        documents.edit_route(id, EditStep::Whole, |r| r.name = "Route 1".into());
        assert_eq!(documents.mission.history.depth(), depth);
    }
}
