//! Edits of several landmarks at once, each one undo step; a drag is one.

use pilotage_core::frames::GroundPoint;
use pilotage_core::landmark::{DetectorChoice, Landmark};

use super::Documents;

/// Sides of the box that a landmark gets of which only a point is marked, metres.
pub const POINT_SIDE: f64 = 20.0;

/// Change of landmarks.
#[derive(Clone, Debug, PartialEq)]
pub enum LandmarkChange {
    /// Category of the landmarks; empty for none.
    Category(String),
    /// Notes about the landmarks.
    Notes(String),
    /// Height of the reference point above the ground, metres.
    Height(f64),
    /// The direction in which they lie, radians clockwise from north.
    Orientation(Option<f64>),
    /// Place of the reference point.
    Reference(GroundPoint),
    /// Their outline.
    Outline(Vec<GroundPoint>),
    /// Enabled state: whether the navigator looks for them.
    Enabled(bool),
    /// By which detector it looks for them.
    Detector(DetectorChoice),
    /// Detector trained for a landmark, as [`Landmark::trained_text`] says it.
    Trained(String),
}

impl LandmarkChange {
    /// Whether the navigator would see another landmark, by whichever detector.
    fn affects_run(&self) -> bool {
        !matches!(
            self,
            Self::Category(_)
                | Self::Notes(_)
                | Self::Orientation(_)
                | Self::Detector(_)
                | Self::Trained(_)
        )
    }

    fn apply(&self, landmark: &mut Landmark) {
        match self {
            Self::Category(text) => landmark.set_category(text),
            Self::Notes(text) => landmark.set_notes(text),
            Self::Height(metres) => landmark.height = *metres,
            Self::Orientation(angle) => landmark.set_orientation(*angle),
            Self::Reference(place) => landmark.set_reference(*place),
            Self::Outline(corners) => landmark.set_outline(corners),
            Self::Enabled(enabled) => landmark.enabled = *enabled,
            Self::Detector(choice) => landmark.choose_detector(*choice),
            Self::Trained(text) => landmark.keep_trained_text(Some(text)),
        }
    }
}

/// A landmark that is no box.
#[derive(Clone, Debug, PartialEq)]
pub enum DrawnLandmark {
    /// Only this point of it is marked.
    Point(GroundPoint),
    /// Its outline of three corners or more.
    Outline(Vec<GroundPoint>),
}

impl Documents {
    /// Changes landmarks; `finished` is false while a drag goes on. Returns whether the run must be
    /// computed again, which is not while a drag goes on.
    pub fn edit_landmarks(&mut self, ids: &[u32], change: &LandmarkChange, finished: bool) -> bool {
        let mut landmarks = self.mission.landmarks.clone();
        for landmark in landmarks.iter_mut().filter(|l| ids.contains(&l.id)) {
            change.apply(landmark);
        }
        let changes = landmarks != self.mission.landmarks;
        let pairs = || std::iter::zip(&landmarks, &self.mission.landmarks);
        let other_detector = pairs().any(|(a, b)| a.detector_in_use() != b.detector_in_use());
        if changes {
            self.mission.history.begin_drag(&self.mission.content);
            self.mission.landmarks = landmarks;
            self.mission.is_edited = true;
        }
        if finished {
            self.mission.history.finish_drag(&self.mission.content);
        }
        finished && (other_detector || change.affects_run())
    }

    /// Adds a landmark that is no box; its id.
    pub fn add_drawn(&mut self, drawn: &DrawnLandmark) -> u32 {
        self.mission.remember();
        self.mission.is_edited = true;
        let id = self.mission.free_landmark_id();
        let name = format!("Landmark {id}");
        let landmark = match drawn {
            DrawnLandmark::Point(point) => Landmark::at_point(id, name, *point, POINT_SIDE),
            DrawnLandmark::Outline(corners) => {
                let around = pilotage_core::frames::GroundRect::around(corners.iter().copied());
                let mut landmark = Landmark::new(
                    id,
                    name,
                    around.unwrap_or_else(|| {
                        pilotage_core::frames::GroundRect::centered(
                            GroundPoint::default(),
                            1.0,
                            1.0,
                        )
                    }),
                );
                landmark.set_outline(corners);
                landmark
            }
        };
        self.mission.landmarks.push(landmark);
        id
    }

    /// Adds landmarks like others, each beside its own to the east; their ids.
    pub fn duplicate_landmarks(&mut self, ids: &[u32]) -> Vec<u32> {
        let originals: Vec<Landmark> = (self.mission.landmarks.iter())
            .filter(|l| ids.contains(&l.id))
            .cloned()
            .collect();
        if originals.is_empty() {
            return Vec::new();
        }
        self.mission.remember();
        self.mission.is_edited = true;
        let mut copies = Vec::new();
        for of in originals {
            let id = self.mission.free_landmark_id();
            let east = 1.25 * of.bounds.width();
            let mut copy = of;
            copy.id = id;
            copy.name.push_str(", copy");
            copy.bounds.west += east;
            copy.bounds.east += east;
            copy.reference.east += east;
            self.mission.landmarks.push(copy);
            copies.push(id);
        }
        copies
    }

    /// Deletes landmarks; true if there were any.
    pub fn delete_landmarks(&mut self, ids: &[u32]) -> bool {
        let known = self.mission.landmarks.iter().any(|l| ids.contains(&l.id));
        if known {
            self.mission.remember();
            self.mission.delete_landmarks(ids);
            self.mission.is_edited = true;
        }
        known
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::mission::LabelledPicture;

    use super::*;
    use crate::documents::Session;

    fn corners() -> Vec<GroundPoint> {
        [(0.0, 0.0), (0.0, 30.0), (40.0, 0.0)]
            .map(|(n, e)| GroundPoint::new(n, e))
            .to_vec()
    }

    fn documents() -> (Documents, [u32; 2]) {
        let mut documents = Documents::new(&Session::demo());
        let outline = documents.add_drawn(&DrawnLandmark::Outline(corners()));
        let point = documents.add_drawn(&DrawnLandmark::Point(GroundPoint::new(90.0, 0.0)));
        (documents, [outline, point])
    }

    #[test]
    fn a_category_for_several_is_one_step_and_leaves_the_run_alone() {
        let (mut documents, ids) = documents();
        let before = documents.mission.clone();
        let change = LandmarkChange::Category("roof".into());
        assert!(!documents.edit_landmarks(&ids, &change, true));
        let set = |d: &Documents| d.mission.landmarks.iter().all(|l| l.category() == "roof");
        assert!(set(&documents));
        assert_eq!(documents.undo(), Some(false));
        assert_eq!(documents.mission.content, before);
    }

    #[test]
    fn a_corner_that_is_dragged_goes_back_in_one_step() {
        let (mut documents, [outline, _]) = documents();
        let before = documents.mission.clone();
        for north in [41.0, 42.0, 43.0] {
            let mut outline_of = corners();
            outline_of[2].north = north;
            let change = LandmarkChange::Outline(outline_of);
            assert!(!documents.edit_landmarks(&[outline], &change, false));
        }
        let same = documents
            .mission
            .landmark(outline)
            .and_then(Landmark::outline);
        let change = LandmarkChange::Outline(same.unwrap());
        assert!(documents.edit_landmarks(&[outline], &change, true));
        assert_eq!(documents.undo(), Some(true), "the box is another one");
        assert_eq!(documents.mission.content, before);
    }

    #[test]
    fn a_detector_affects_the_run_where_it_is_looked_by_it() {
        let (mut documents, ids) = documents();
        let one = [ids[0]];
        let trained = |text: &str| LandmarkChange::Trained(text.into());
        let cascade = LandmarkChange::Detector(DetectorChoice::Cascade);
        assert!(
            !documents.edit_landmarks(&one, &trained("1"), true),
            "map patch"
        );
        assert!(documents.edit_landmarks(&ids, &cascade, true));
        let choice = |d: &Documents, i: usize| d.mission.landmarks[i].detector_choice();
        assert_eq!(choice(&documents, 1), DetectorChoice::Cascade);
        assert!(documents.edit_landmarks(&one, &trained("2"), true));
        let of_no_use = LandmarkChange::Detector(DetectorChoice::Both);
        let untrained = [ids[1]];
        assert!(!documents.edit_landmarks(&untrained, &of_no_use, true));
        assert_eq!(documents.undo(), Some(false));
        assert_eq!(documents.undo(), Some(true), "the other detector is back");
        assert_eq!(documents.undo(), Some(true), "the map patch");
        assert_eq!(choice(&documents, 0), DetectorChoice::Template);
        assert_eq!(documents.undo(), Some(false));
        assert_eq!(documents.mission.landmarks[0].trained_text(), None);
    }

    #[test]
    fn labels_go_and_come_back_with_their_landmark() {
        let (mut documents, [_, point]) = documents();
        let picture = LabelledPicture {
            flight: String::new(),
            frame: "00001.jpg".to_owned(),
            size: (640, 480),
        };
        documents.mission.mark_absent(&picture, point);
        let before = documents.mission.content.clone();
        assert!(documents.delete_landmarks(&[point]));
        assert!(documents.mission.labels.is_empty());
        documents.undo();
        assert!(documents.delete_landmark(point));
        assert!(documents.mission.labels.is_empty());
        let next = documents.add_drawn(&DrawnLandmark::Point(GroundPoint::new(0.0, 0.0)));
        assert_eq!(documents.mission.label_counts("", next), (0, 0));
        documents.undo();
        documents.undo();
        assert_eq!(documents.mission.content, before);
    }

    #[test]
    fn copies_lie_beside_what_they_are_of_and_go_together() {
        let (mut documents, ids) = documents();
        let copies = documents.duplicate_landmarks(&ids);
        assert_eq!(copies.len(), 2);
        let copy = documents.mission.landmark(copies[0]).unwrap();
        let outline = copy.outline().unwrap();
        assert!((outline[0].east - 37.5).abs() < 1e-9, "{outline:?}");
        assert!(documents.delete_landmarks(&copies));
        assert_eq!(documents.mission.landmarks.len(), 2);
        documents.undo();
        assert_eq!(documents.mission.landmarks.len(), 4);
    }
}
