//! Edits of roads, each one undo step; a drag is one.

use pilotage_core::frames::GroundPoint;
use pilotage_core::roads::{RoadClass, RoadLine};

use super::command::RoadChange;
use super::geometry::joined;
use crate::documents::Documents;

impl Documents {
    /// Adds a road of the usual width of its class; its index.
    pub fn add_road(&mut self, class: RoadClass, course: Vec<GroundPoint>) -> usize {
        self.mission.remember();
        self.mission.is_edited = true;
        self.mission.roads.make_mut().push(RoadLine {
            class,
            width: class.usual_width(),
            course,
            ..RoadLine::default()
        });
        self.mission.roads.len() - 1
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
            RoadChange::Move(point, to) => {
                if let Some(place) = road.course.get_mut(point) {
                    *place = to;
                }
            }
            RoadChange::Insert(before, at) if before <= road.course.len() => {
                road.course.insert(before, at);
            }
            RoadChange::Remove(point) if point < road.course.len() && road.course.len() > 2 => {
                road.course.remove(point);
            }
            RoadChange::Insert(..) | RoadChange::Remove(_) => {}
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
    use pilotage_core::roads::SharedRoads;

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
        documents.add_road(RoadClass::Track, line(east));
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
            assert!(documents.edit_road(0, RoadChange::Move(1, to), east == 16.0));
        }
        assert_eq!(documents.mission.roads[0].course, line(&[0.0, 16.0]));
        documents.undo();
        assert_eq!(documents.mission.roads[0].course, line(&[0.0, 10.0]));
    }

    #[test]
    fn an_edit_says_whether_it_made_another_road() {
        let mut documents = with_road(&[0.0, 10.0]);
        let to = |east: f64| RoadChange::Move(1, GroundPoint::new(0.0, east));
        assert!(!documents.edit_road(0, to(10.0), true));
        assert!(!documents.edit_road(0, RoadChange::Move(7, GroundPoint::default()), true));
        assert!(!documents.edit_road(3, to(12.0), true));
        // Dragged away; then the mouse is let go at the same place, and after another drag where it was grasped.
        assert!(documents.edit_road(0, to(12.0), false));
        assert!(documents.edit_road(0, to(12.0), true));
        assert!(documents.edit_road(0, to(14.0), false));
        assert!(!documents.edit_road(0, to(12.0), true));
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

    #[test]
    fn a_road_keeps_two_points() {
        let mut documents = with_road(&[0.0, 5.0, 10.0]);
        documents.edit_road(0, RoadChange::Remove(1), true);
        documents.edit_road(0, RoadChange::Remove(1), true);
        assert_eq!(documents.mission.roads[0].course, line(&[0.0, 10.0]));
    }
}
