//! Edits of the mission. Each says whether the run must be computed again.

use pilotage_core::calibration::CameraAdjustment;
use pilotage_core::frames::GroundRect;
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{NavigatorSettings, ROAD_MAP};

use super::Documents;

impl Documents {
    /// Adds a landmark with this box; its id.
    pub fn add_landmark(&mut self, bounds: GroundRect) -> u32 {
        self.mission.remember();
        let id = self.mission.free_landmark_id();
        let name = format!("Landmark {id}");
        self.mission.landmarks.push(Landmark::new(id, name, bounds));
        self.mission.is_edited = true;
        id
    }

    /// Gives a landmark another box; the reference point keeps its place in it. True once the drag
    /// is over and changed anything.
    pub fn reshape_landmark(&mut self, id: u32, bounds: GroundRect, finished: bool) -> bool {
        self.mission.history.begin_drag(&self.mission.content);
        // From where it was when the drag began: there and back again, it is as it was.
        let before = self.mission.history.before_drag();
        let before = before.and_then(|it| it.landmark(id)).cloned();
        let content = &mut self.mission.content;
        let now = content.landmarks.iter_mut().find(|l| l.id == id);
        if let (Some(landmark), Some(before)) = (now, before) {
            *landmark = before;
            if landmark.bounds != bounds {
                landmark.reshape(bounds);
            }
            self.mission.is_edited = true;
        }
        finished && self.mission.history.finish_drag(&self.mission.content)
    }

    /// Names a landmark.
    pub fn rename_landmark(&mut self, id: u32, name: String) {
        let known = self.mission.landmark(id).is_some_and(|l| l.name != name);
        if !known {
            return;
        }
        self.mission.remember();
        if let Some(landmark) = self.mission.landmarks.iter_mut().find(|l| l.id == id) {
            landmark.name = name;
            self.mission.is_edited = true;
        }
    }

    /// Switches a landmark on or off; true if that changed anything.
    pub fn enable_landmark(&mut self, id: u32, enabled: bool) -> bool {
        let changes = self
            .mission
            .landmark(id)
            .is_some_and(|l| l.enabled != enabled);
        if changes {
            self.mission.remember();
            for landmark in self.mission.landmarks.iter_mut().filter(|l| l.id == id) {
                landmark.enabled = enabled;
            }
            self.mission.is_edited = true;
        }
        changes
    }

    /// Deletes a landmark; true if there was one.
    pub fn delete_landmark(&mut self, id: u32) -> bool {
        self.delete_landmarks(&[id])
    }

    /// Navigates with other settings; true if they differ. `continues` joins the change to the
    /// drag under way.
    pub fn set_navigator(&mut self, settings: &NavigatorSettings, continues: bool) -> bool {
        if self.mission.navigator == *settings {
            return false;
        }
        if continues {
            self.mission.history.begin_drag(&self.mission.content);
        } else {
            self.mission.remember();
        }
        self.mission.navigator = settings.clone();
        self.mission.is_edited = true;
        true
    }

    /// Flies with the camera changed so, or as it was opened; true if that differs.
    pub fn set_camera_to_log(&mut self, change: Option<CameraAdjustment>) -> bool {
        if self.mission.camera_to_log == change {
            return false;
        }
        self.mission.remember();
        self.mission.camera_to_log = change;
        self.mission.is_edited = true;
        true
    }

    /// Takes the last edit back; `None` if there was none, else whether the run is affected.
    pub fn undo(&mut self) -> Option<bool> {
        let before = self.mission.history.undo(&self.mission.content)?;
        Some(self.replace_mission(before))
    }

    /// Makes the edit taken back again; `None` if there was none, else whether the run is affected.
    pub fn redo(&mut self) -> Option<bool> {
        let after = self.mission.history.redo(&self.mission.content)?;
        Some(self.replace_mission(after))
    }

    /// Whether the navigator looks for the mission's roads, so that the run depends on them.
    pub fn uses_roads(&self) -> bool {
        ROAD_MAP.of(&self.mission.navigator.aids).is_some()
    }

    /// Whether a flight by another mission, with the same settings of the navigator, would be another run.
    pub fn is_seen_otherwise(&self, mission: &Mission) -> bool {
        self.mission.camera_to_log != mission.camera_to_log
            || self.uses_roads() && self.mission.roads != mission.roads
            || self.mission.landmarks.len() != mission.landmarks.len()
            || std::iter::zip(&self.mission.landmarks, &mission.landmarks).any(|(a, b)| {
                let of = |l: &Landmark| (l.id, l.bounds, l.enabled, l.reference, l.height);
                of(a) != of(b) || a.detector_in_use() != b.detector_in_use()
            })
    }

    fn replace_mission(&mut self, mission: Mission) -> bool {
        let affected =
            self.mission.navigator != mission.navigator || self.is_seen_otherwise(&mission);
        self.mission.content = mission;
        self.mission.is_edited = true;
        affected
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::navigator::ChosenAid;
    use pilotage_core::roads::RoadLine;

    use super::*;
    use crate::documents::{Brought, Session};

    fn box_of(size: f64) -> GroundRect {
        GroundRect::centered(
            pilotage_core::frames::GroundPoint::new(0.0, 0.0),
            size,
            size,
        )
    }

    #[test]
    fn an_added_landmark_is_gone_after_undo_and_back_after_redo() {
        let mut documents = Documents::new(&Session::demo());
        let id = documents.add_landmark(box_of(20.0));
        assert_eq!(documents.undo(), Some(true));
        assert!(documents.mission.landmark(id).is_none());
        assert_eq!(documents.redo(), Some(true));
        assert!(documents.mission.landmark(id).is_some());
    }

    #[test]
    fn a_new_name_does_not_affect_the_run() {
        let mut documents = Documents::new(&Session::demo());
        let id = documents.add_landmark(box_of(20.0));
        documents.rename_landmark(id, "Barn".into());
        assert_eq!(documents.undo(), Some(false));
    }

    #[test]
    fn the_reference_point_moves_with_its_box() {
        let mut documents = Documents::new(&Session::demo());
        let id = documents.add_landmark(box_of(20.0));
        let moved = GroundRect::centered(
            pilotage_core::frames::GroundPoint::new(5.0, -3.0),
            20.0,
            20.0,
        );
        documents.reshape_landmark(id, moved, true);
        let reference = documents.mission.landmark(id).map(|l| l.reference);
        assert_eq!(reference, Some(moved.center()));
    }

    #[test]
    fn a_landmark_that_is_dragged_there_and_back_is_as_it_was() {
        let mut documents = Documents::new(&Session::demo());
        let id = documents.add_landmark(box_of(20.0));
        let landmarks = &mut documents.mission.content.landmarks;
        let landmark = landmarks.iter_mut().find(|l| l.id == id).unwrap();
        landmark.reference = pilotage_core::frames::GroundPoint::new(0.1, 0.7);
        let (before, depth) = (landmark.clone(), documents.mission.history.depth());
        for size in [31.7, 0.3, 47.1] {
            assert!(!documents.reshape_landmark(id, box_of(size), false));
        }
        assert!(!documents.reshape_landmark(id, before.bounds, true));
        assert_eq!(documents.mission.landmark(id), Some(&before));
        assert_eq!(documents.mission.history.depth(), depth);
        assert!(documents.reshape_landmark(id, box_of(10.0), true));
    }

    #[test]
    fn roads_affect_the_run_of_a_navigator_that_looks_for_them_alone() {
        let mut documents = Documents::new(&Session::demo());
        let roads = || {
            let roads = vec![RoadLine::default()];
            let file = Brought {
                roads,
                ..Brought::default()
            };
            vec![file]
        };
        documents.add_all(roads());
        assert_eq!(documents.undo(), Some(false));
        let aids = &mut documents.mission.navigator.aids;
        aids.push(ChosenAid::usual(ROAD_MAP.aid));
        documents.add_all(roads());
        assert_eq!(documents.undo(), Some(true));
    }
}
