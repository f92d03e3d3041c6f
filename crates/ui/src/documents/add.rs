//! Routes, landmarks, no-fly areas, rally points and roads of files, added to the mission.

use pilotage_core::roads::without_known;

use super::{Brought, Documents};

/// Identities that added things have in the mission.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Added {
    /// Routes, in order.
    pub routes: Vec<u32>,
    /// Landmarks, in order.
    pub landmarks: Vec<u32>,
    /// Roads that were left out, because one with the same centre line was there.
    pub known_roads: usize,
}

impl Documents {
    /// Adds what several files brought, as one step; each gets a free identity.
    pub fn add_all(&mut self, files: Vec<Brought>) -> Added {
        self.mission.remember();
        self.mission.is_edited = true;
        let mut added = Added::default();
        for file in files {
            for mut route in file.routes {
                route.id = self.free_route_id();
                route.name = self.free_route_name(&route.name);
                added.routes.push(route.id);
                self.mission.routes.push(route);
            }
            for mut landmark in file.landmarks {
                landmark.id = self.mission.free_landmark_id();
                added.landmarks.push(landmark.id);
                self.mission.landmarks.push(landmark);
            }
            self.mission.no_fly.extend(file.no_fly);
            let roads = file.roads.len();
            let new = without_known(&self.mission.roads, file.roads);
            added.known_roads += roads - new.len();
            if !new.is_empty() {
                self.mission.roads.make_mut().extend(new);
            }
            for mut point in file.rally {
                point.name = self.mission.free_rally_name(&point.name);
                self.mission.rally.push(point);
            }
        }
        added
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::documents::Session;
    use pilotage_core::frames::{GroundPoint, GroundRect};
    use pilotage_core::landmark::Landmark;
    use pilotage_core::mission::{NoFlyZone, RallyPoint, Route};
    use pilotage_core::roads::RoadLine;

    #[test]
    fn what_two_files_brought_gets_free_identities_and_is_gone_after_one_undo() {
        let mut documents = Documents::new(&Session::demo());
        let bounds = GroundRect::centered(GroundPoint::default(), 20.0, 20.0);
        let own = documents.add_landmark(bounds);
        let before = documents.mission.clone();
        let file = || {
            let landmark = Landmark::new(own, "Barn", bounds);
            Brought {
                routes: vec![Route::default()],
                landmarks: vec![landmark],
                no_fly: vec![NoFlyZone::default()],
                rally: vec![RallyPoint::new(1, GroundPoint::default())],
                roads: vec![RoadLine::default()],
            }
        };
        let added = documents.add_all(vec![file(), file()]);
        assert_eq!(added.routes, [1, 2]);
        assert_eq!(added.landmarks, [own + 1, own + 2]);
        assert_eq!(documents.mission.no_fly.len(), 2);
        assert_eq!(documents.mission.roads.len(), 2);
        let names = documents.mission.rally.iter().map(|point| &point.name);
        assert_eq!(names.collect::<Vec<_>>(), ["Rally 1", "Rally 2"]);
        assert_eq!(documents.undo(), Some(true));
        assert_eq!(documents.mission.content, before);
    }
    #[test]
    fn a_road_that_is_there_is_not_added_again() {
        let mut documents = Documents::new(&Session::demo());
        let file = |east: [f64; 2]| Brought {
            roads: vec![RoadLine {
                course: east.map(|east| GroundPoint::new(0.0, east)).to_vec(),
                ..RoadLine::default()
            }],
            ..Brought::default()
        };
        let before = documents.mission.roads.len();
        let added = documents.add_all(vec![file([0.0, 50.0])]);
        assert_eq!(added.known_roads, 0);
        let added = documents.add_all(vec![file([50.0, 0.0]), file([0.0, 60.0])]);
        assert_eq!(added.known_roads, 1);
        assert_eq!(documents.mission.roads.len(), before + 2);
    }
}
