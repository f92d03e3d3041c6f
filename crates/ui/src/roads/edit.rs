//! Edits of roads, each one undo step; a drag is one.

use pilotage_core::frames::GroundPoint;
use pilotage_core::roads::{RoadClass, RoadLine};

use super::command::RoadChange;
use super::geometry::{alike, are_one, joined, through};
use crate::documents::Documents;

impl Documents {
    /// Adds a road, of the usual width of its class where its own (metres) is not known, with a crossing where it has a point on
    /// another; its index.
    pub fn add_road(
        &mut self,
        class: RoadClass,
        width: Option<f64>,
        course: &[GroundPoint],
    ) -> usize {
        self.mission.remember();
        self.mission.is_edited = true;
        self.mission.roads.make_mut().push(RoadLine {
            class,
            width: width.unwrap_or(class.usual_width()),
            course: course.to_vec(),
            ..RoadLine::default()
        });
        let index = self.mission.roads.len() - 1;
        self.cross(&[index], course);
        index
    }

    /// Gives every road, but for those of `own`, that leads through one of `places` a point there: they cross.
    fn cross(&mut self, own: &[usize], places: &[GroundPoint]) {
        for place in places {
            for (road, piece) in through(&self.mission.roads, own, *place) {
                let roads = self.mission.roads.make_mut();
                roads[road].course.insert(piece + 1, *place);
            }
        }
    }

    /// Puts points, each of a road and its index there, to one place, which is a crossing where another road leads through
    /// it; `finished` says that a drag is over. Whether that moved one: the whole drag, once it is over. Points that are no
    /// longer at one place, after an undo, are other ones than were taken hold of, and stay.
    pub fn move_road_points(
        &mut self,
        points: &[(usize, usize)],
        to: GroundPoint,
        finished: bool,
    ) -> bool {
        let roads = &self.mission.roads;
        if !are_one(roads, points) {
            return finished && self.mission.history.finish_drag(&self.mission.content);
        }
        let at = |(road, point): &(usize, usize)| roads.get(*road)?.course.get(*point);
        let is_moved = points.iter().filter_map(at).any(|place| *place != to);
        if is_moved {
            self.mission.history.begin_drag(&self.mission.content);
            let roads = self.mission.roads.make_mut();
            for (road, point) in points {
                let road = roads.get_mut(*road);
                if let Some(place) = road.and_then(|road| road.course.get_mut(*point)) {
                    *place = to;
                }
            }
            self.mission.is_edited = true;
        }
        if finished {
            let before = self.mission.history.before_drag();
            if before.is_some_and(|before| before.roads != self.mission.roads) {
                let own: Vec<usize> = points.iter().map(|it| it.0).collect();
                self.cross(&own, &[to]);
            }
            return self.mission.history.finish_drag(&self.mission.content);
        }
        is_moved
    }

    /// Changes a road; `finished` says that a drag is over. Whether that made another road of it: the whole drag, once it
    /// is over.
    pub fn edit_road(&mut self, index: usize, change: RoadChange, finished: bool) -> bool {
        let Some(old) = self.mission.roads.get(index) else {
            return false;
        };
        let mut road = old.clone();
        match change {
            RoadChange::Name(name) => road.name = name,
            RoadChange::Class(class) => {
                // A width that somebody measured stays.
                if road.width == road.class.usual_width() {
                    road.width = class.usual_width();
                }
                road.class = class;
            }
            RoadChange::Width(width) => road.width = width,
            RoadChange::Insert(before, at) if before <= road.course.len() => {
                road.course.insert(before, at);
            }
            RoadChange::Insert(..) => {}
        }
        let is_other = road != *old;
        if is_other {
            self.mission.history.begin_drag(&self.mission.content);
            self.mission.roads.make_mut()[index] = road;
            self.mission.is_edited = true;
        }
        if finished {
            return self.mission.history.finish_drag(&self.mission.content);
        }
        is_other
    }

    /// Deletes a point of a road, and those of other roads at its place: a crossing goes as one. A road keeps two points.
    /// Whether that road had one to spare.
    pub fn delete_road_point(&mut self, road: usize, point: usize) -> bool {
        let roads = &self.mission.roads;
        let length = roads.get(road).map_or(0, |road| road.course.len());
        if length <= 2 || point >= length {
            return false;
        }
        let mut points = alike(roads, road, point);
        points.retain(|it| it.0 != road || it.1 == point);
        // The last one first: those before keep their numbers.
        points.sort_unstable_by(|a, b| b.cmp(a));
        self.mission.remember();
        self.mission.is_edited = true;
        let roads = self.mission.roads.make_mut();
        for (road, point) in points {
            let course = &mut roads[road].course;
            if course.len() > 2 {
                course.remove(point);
            }
        }
        true
    }

    /// Deletes a road; whether there is one.
    pub fn delete_road(&mut self, index: usize) -> bool {
        let is_there = index < self.mission.roads.len();
        if is_there {
            self.mission.remember();
            self.mission.is_edited = true;
            self.mission.roads.make_mut().remove(index);
        }
        is_there
    }

    /// Splits a road at a point between its ends, which both parts have then; whether there is one.
    pub fn split_road(&mut self, index: usize, point: usize) -> bool {
        let Some(road) = self.mission.roads.get(index) else {
            return false;
        };
        if point == 0 || point + 1 >= road.course.len() {
            return false;
        }
        let rest = RoadLine {
            course: road.course[point..].to_vec(),
            ..road.clone()
        };
        self.mission.remember();
        self.mission.is_edited = true;
        let roads = self.mission.roads.make_mut();
        roads[index].course.truncate(point + 1);
        roads.insert(index + 1, rest);
        true
    }

    /// Joins two roads at the ends that are nearest to each other into one, like the first of them; its index.
    pub fn join_roads(&mut self, first: usize, second: usize) -> Option<usize> {
        let roads = &self.mission.roads;
        let (one, other) = (roads.get(first)?, roads.get(second)?);
        if first == second || one.course.is_empty() || other.course.is_empty() {
            return None;
        }
        let course = joined(&one.course, &other.course);
        self.mission.remember();
        self.mission.is_edited = true;
        let roads = self.mission.roads.make_mut();
        roads[first].course = course;
        roads.remove(second);
        Some(first - usize::from(second < first))
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::roads::{RoadJoining, RoadMap, SharedRoads};

    use super::*;
    use crate::documents::Session;

    fn line(east: &[f64]) -> Vec<GroundPoint> {
        east.iter()
            .map(|east| GroundPoint::new(0.0, *east))
            .collect()
    }

    fn with_road(east: &[f64]) -> Documents {
        let mut documents = Documents::new(&Session::demo());
        documents.mission.roads = SharedRoads::default();
        documents.add_road(RoadClass::Track, None, &line(east));
        documents
    }

    #[test]
    fn a_split_road_is_one_again_when_joined_and_every_step_is_undone_by_itself() {
        let mut documents = with_road(&[0.0, 10.0, 30.0]);
        assert!(!documents.split_road(0, 0) && !documents.split_road(0, 2));
        assert!(documents.split_road(0, 1));
        let courses: Vec<_> = documents
            .mission
            .roads
            .iter()
            .map(|road| road.course.clone())
            .collect();
        assert_eq!(courses, [line(&[0.0, 10.0]), line(&[10.0, 30.0])]);
        assert_eq!(documents.join_roads(1, 0), Some(0));
        let road = &documents.mission.roads[0];
        assert_eq!(road.course.len(), 3);
        assert_eq!(documents.mission.roads.len(), 1);
        for count in [2, 1, 0] {
            documents.undo();
            assert_eq!(documents.mission.roads.len(), count);
        }
    }

    #[test]
    fn a_drag_is_one_step() {
        let mut documents = with_road(&[0.0, 10.0]);
        for east in [12.0, 14.0, 16.0] {
            let to = GroundPoint::new(0.0, east);
            assert!(documents.move_road_points(&[(0, 1)], to, east == 16.0));
        }
        assert_eq!(documents.mission.roads[0].course, line(&[0.0, 16.0]));
        documents.undo();
        assert_eq!(documents.mission.roads[0].course, line(&[0.0, 10.0]));
    }

    #[test]
    fn an_edit_says_whether_it_made_another_road() {
        let mut documents = with_road(&[0.0, 10.0]);
        let mut moved = |point: (usize, usize), east: f64, finished| {
            documents.move_road_points(&[point], GroundPoint::new(0.0, east), finished)
        };
        assert!(!moved((0, 1), 10.0, true));
        assert!(!moved((0, 7), 0.0, true));
        assert!(!moved((3, 1), 12.0, true));
        // Dragged away; then the mouse is let go at the same place, and after another drag where it was grasped.
        assert!(moved((0, 1), 12.0, false));
        assert!(moved((0, 1), 12.0, true));
        assert!(moved((0, 1), 14.0, false));
        assert!(!moved((0, 1), 12.0, true));
        assert!(documents.delete_road(0) && !documents.delete_road(0));
    }

    #[test]
    fn a_class_brings_its_usual_width_unless_another_was_given() {
        let mut documents = with_road(&[0.0, 10.0]);
        documents.edit_road(0, RoadChange::Class(RoadClass::Primary), true);
        assert_eq!(documents.mission.roads[0].width, 8.0);
        documents.edit_road(0, RoadChange::Width(7.1), true);
        documents.edit_road(0, RoadChange::Class(RoadClass::Track), true);
        assert_eq!(documents.mission.roads[0].width, 7.1);
    }

    /// Crossings of the mission, as it is flown and looked for with.
    fn crossings(documents: &Documents) -> usize {
        let roads = documents.mission.roads.to_vec();
        let map = RoadMap::new(roads, RoadJoining::SHARED_POINTS);
        map.crossings().len()
    }

    #[test]
    fn a_road_that_ends_on_a_piece_of_another_crosses_it_and_does_so_wherever_the_crossing_is_dragged()
     {
        let mut documents = with_road(&[0.0, 100.0]);
        let side = [GroundPoint::new(40.0, 30.0), GroundPoint::new(0.0, 30.0)];
        let before = documents.mission.history.depth();
        documents.add_road(RoadClass::Track, None, &side);
        assert_eq!(crossings(&documents), 1);
        assert_eq!(documents.mission.history.depth().0, before.0 + 1);
        let points = alike(&documents.mission.roads, 1, 1);
        assert_eq!(points, [(1, 1), (0, 1)]);
        for north in [-3.0, -6.0] {
            let to = GroundPoint::new(north, 35.0);
            assert!(documents.move_road_points(&points, to, north == -6.0));
            assert_eq!(crossings(&documents), 1);
        }
        documents.undo();
        assert_eq!(documents.mission.roads[0].course[1], side[1]);
        documents.undo();
        assert_eq!(documents.mission.roads[0].course, line(&[0.0, 100.0]));
    }

    #[test]
    fn an_end_that_is_dragged_onto_a_piece_of_another_road_crosses_it_in_the_same_step() {
        let mut documents = with_road(&[0.0, 100.0]);
        let end = |north: f64| GroundPoint::new(north, 30.0);
        documents.add_road(RoadClass::Track, None, &[end(40.0), end(10.0)]);
        for (north, is_over) in [(5.0, false), (0.0, false), (0.0, true)] {
            documents.move_road_points(&[(1, 1)], end(north), is_over);
        }
        assert_eq!(crossings(&documents), 1);
        documents.undo();
        assert_eq!(documents.mission.roads[0].course, line(&[0.0, 100.0]));
        assert_eq!(documents.mission.roads[1].course[1], end(10.0));
    }

    #[test]
    fn a_crossing_that_undo_took_back_is_dragged_no_further() {
        let mut documents = with_road(&[0.0, 100.0]);
        let end = |north: f64| GroundPoint::new(north, 30.0);
        documents.add_road(RoadClass::Track, None, &[end(40.0), end(10.0)]);
        documents.move_road_points(&[(1, 1)], end(0.0), true);
        let points = alike(&documents.mission.roads, 1, 1);
        assert_eq!(points, [(1, 1), (0, 1)]);
        documents.undo();
        for finished in [false, true] {
            assert!(!documents.move_road_points(&points, end(70.0), finished));
        }
        assert_eq!(documents.mission.roads[0].course, line(&[0.0, 100.0]));
        assert_eq!(documents.mission.roads[1].course[1], end(10.0));
    }

    #[test]
    fn a_road_keeps_two_points() {
        let mut documents = with_road(&[0.0, 5.0, 10.0]);
        assert!(documents.delete_road_point(0, 1));
        assert!(!documents.delete_road_point(0, 1));
        assert_eq!(documents.mission.roads[0].course, line(&[0.0, 10.0]));
    }

    #[test]
    fn a_point_of_a_crossing_is_deleted_from_all_of_its_roads_in_one_step() {
        let mut documents = with_road(&[0.0, 20.0, 30.0, 100.0]);
        let place = |north: f64| GroundPoint::new(north, 30.0);
        let across = [place(40.0), place(0.0), place(-40.0)];
        documents.add_road(RoadClass::Track, None, &across);
        documents.add_road(RoadClass::Track, None, &across[1..]);
        assert_eq!(crossings(&documents), 1);
        assert!(documents.delete_road_point(0, 2));
        let course =
            |documents: &Documents, road: usize| documents.mission.roads[road].course.clone();
        assert_eq!(course(&documents, 0), line(&[0.0, 20.0, 100.0]));
        assert_eq!(course(&documents, 1), [place(40.0), place(-40.0)]);
        assert_eq!(
            course(&documents, 2),
            across[1..],
            "a road keeps two points"
        );
        documents.undo();
        assert_eq!(course(&documents, 0).len(), 4);
        assert_eq!(course(&documents, 1), across);
    }
}
