//! Labels of a mission's pictures: asked, added, taken away.

use super::{FrameLabels, LabelBox, LabelledPicture, Mission};
use pilotage_base::text::by_count;

impl Mission {
    /// Labels of a picture of a flight; those of which nobody said the flight where that picture has none of its own.
    pub fn labels_of(&self, flight: &str, frame: &str) -> Option<&FrameLabels> {
        self.labels.get(self.place_of(flight, frame)?)
    }

    /// Pictures of a flight with a box of a landmark, and pictures that are marked as without it.
    pub fn label_counts(&self, flight: &str, landmark: u32) -> (usize, usize) {
        let own = || self.labels.iter().filter(|l| l.is_of(flight));
        let count = |of: &dyn Fn(&FrameLabels) -> bool| own().filter(|l| of(l)).count();
        (
            count(&|l| l.of(landmark).is_some()),
            count(&|l| l.lacks(landmark)),
        )
    }

    /// Labels that are not used with a flight because they are of others, and those that are although nobody said of which
    /// they are, in sentences.
    pub fn told_of_labels(&self, flight: &str) -> Vec<String> {
        let counted = |count: usize| {
            format!(
                "Labels of {count} {}",
                by_count(count, "picture", "pictures")
            )
        };
        let count =
            |of: &dyn Fn(&FrameLabels) -> bool| self.labels.iter().filter(|l| of(l)).count();
        let (others, unnamed) = (
            count(&|l| !l.is_of(flight)),
            count(&|l| l.flight.is_empty()),
        );
        let others = (others > 0).then(|| {
            format!(
                "{} are of other flights and not used with this one.",
                counted(others)
            )
        });
        let unnamed = (unnamed > 0).then(|| {
            format!(
                "{} do not say their flight: they are taken for this one's where it has pictures of their names.",
                counted(unnamed)
            )
        });
        others.into_iter().chain(unnamed).collect()
    }

    /// Puts a box into a picture, in place of an earlier one of the same landmark.
    pub fn set_label(&mut self, picture: &LabelledPicture, label: LabelBox) {
        let labels = self.labels_entry(picture);
        let place = labels
            .boxes
            .iter()
            .position(|b| b.landmark == label.landmark);
        labels.absent.retain(|id| *id != label.landmark);
        match place {
            Some(place) => labels.boxes[place] = label,
            None => labels.boxes.push(label),
        }
    }

    /// Marks a landmark as not in a picture; a box of it goes.
    pub fn mark_absent(&mut self, picture: &LabelledPicture, landmark: u32) {
        let labels = self.labels_entry(picture);
        labels.forget(landmark);
        labels.absent.push(landmark);
    }

    /// Takes away what was said of a landmark in a picture of a flight; false if that was nothing.
    pub fn clear_label(&mut self, flight: &str, frame: &str, landmark: u32) -> bool {
        let place = self.place_of(flight, frame);
        let Some(place) = place.filter(|place| self.labels[*place].tells_of(landmark)) else {
            return false;
        };
        let labels = &mut self.labels[place];
        labels.forget(landmark);
        if labels.is_empty() {
            self.labels.remove(place);
        }
        true
    }

    /// Takes landmarks away, and what was said of them in pictures; false if the mission has none of them.
    pub fn delete_landmarks(&mut self, ids: &[u32]) -> bool {
        let before = self.landmarks.len();
        self.landmarks
            .retain(|landmark| !ids.contains(&landmark.id));
        if self.landmarks.len() == before {
            return false;
        }
        for labels in &mut self.labels {
            for id in ids {
                labels.forget(*id);
            }
        }
        self.labels.retain(|labels| !labels.is_empty());
        true
    }

    /// Adds labels; where a landmark is labelled in the same picture already, the new one counts.
    pub fn add_labels(&mut self, frames: Vec<FrameLabels>) {
        for frame in frames {
            let FrameLabels {
                flight,
                frame,
                size,
                boxes,
                absent,
                properties,
            } = frame;
            let picture = LabelledPicture {
                flight,
                frame,
                size,
            };
            self.labels_entry(&picture).properties.extend(properties);
            for id in absent {
                self.mark_absent(&picture, id);
            }
            for label in boxes {
                self.set_label(&picture, label);
            }
        }
    }

    /// Place of the labels of a picture of a flight among all.
    fn place_of(&self, flight: &str, frame: &str) -> Option<usize> {
        FrameLabels::place_among(&self.labels, flight, frame)
    }

    /// The labels of a picture, in pixels of its size. Those of which nobody said the flight become those of the one in which they are changed.
    fn labels_entry(&mut self, picture: &LabelledPicture) -> &mut FrameLabels {
        let LabelledPicture {
            flight,
            frame,
            size,
        } = picture;
        let place = self.place_of(flight, frame).unwrap_or_else(|| {
            let place = self.labels.partition_point(|l| l.frame < *frame);
            let new = FrameLabels {
                frame: frame.clone(),
                ..FrameLabels::default()
            };
            self.labels.insert(place, new);
            place
        });
        let labels = &mut self.labels[place];
        if labels.size != *size {
            *labels = labels.at_size(*size);
        }
        labels.flight.clone_from(flight);
        labels
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mission::read_mission;
    use pilotage_base::frames::{GroundPoint, GroundRect};
    use pilotage_vision::landmark::Landmark;

    const SIZE: (u32, u32) = (640, 480);
    const FLIGHT: &str = "Route from 0.0 m, 0.0 m";

    fn picture(frame: &str) -> LabelledPicture {
        LabelledPicture {
            flight: FLIGHT.to_owned(),
            frame: frame.to_owned(),
            size: SIZE,
        }
    }

    fn mission() -> Mission {
        let text = r#"{ "type": "FeatureCollection", "features": [] }"#;
        read_mission(text.as_bytes()).unwrap()
    }

    fn label(landmark: u32, left: f64) -> LabelBox {
        LabelBox::new(landmark, "Barn", [[left, 10.0], [left + 30.5, 42.25]], SIZE).unwrap()
    }

    #[test]
    fn a_landmark_has_one_box_in_a_picture_and_is_in_it_or_not() {
        let mut mission = mission();
        mission.set_label(&picture("00002.jpg"), label(1, 5.0));
        mission.set_label(&picture("00001.jpg"), label(1, 5.0));
        mission.set_label(&picture("00002.jpg"), label(1, 90.0));
        mission.set_label(&picture("00002.jpg"), label(2, 7.0));
        assert_eq!(
            mission.labels_of(FLIGHT, "00002.jpg").unwrap().boxes.len(),
            2
        );
        assert_eq!(
            mission
                .labels_of(FLIGHT, "00002.jpg")
                .unwrap()
                .of(1)
                .unwrap()
                .min[0],
            90.0
        );
        assert_eq!(
            mission.labels[0].frame, "00001.jpg",
            "in the order of names"
        );
        mission.mark_absent(&picture("00002.jpg"), 1);
        assert_eq!(mission.label_counts(FLIGHT, 1), (1, 1));
        mission.set_label(&picture("00002.jpg"), label(1, 4.0));
        assert_eq!(mission.label_counts(FLIGHT, 1), (2, 0));
        assert!(
            mission.clear_label(FLIGHT, "00001.jpg", 1)
                && !mission.clear_label(FLIGHT, "00001.jpg", 1)
        );
        assert_eq!(mission.labels.len(), 1, "nothing is left of the first");
    }

    #[test]
    fn labels_are_of_one_flight_and_those_of_none_become_those_of_the_one_that_changes_them() {
        let mut mission = mission();
        let second = "Route from 3.0 m, 0.0 m";
        mission.set_label(&picture("00012.jpg"), label(1, 5.0));
        assert!(mission.labels_of(second, "00012.jpg").is_none());
        assert_eq!(mission.label_counts(second, 1), (0, 0));
        assert!(!mission.clear_label(second, "00012.jpg", 1));
        let of_second = LabelledPicture {
            flight: second.to_owned(),
            ..picture("00012.jpg")
        };
        mission.mark_absent(&of_second, 1);
        assert_eq!(mission.label_counts(second, 1), (0, 1));
        assert_eq!(mission.label_counts(FLIGHT, 1), (1, 0));
        assert_eq!(
            mission.told_of_labels(second),
            ["Labels of 1 picture are of other flights and not used with this one."]
        );
        // As files of before have them.
        mission.labels.retain(|labels| labels.flight == FLIGHT);
        mission.labels[0].flight.clear();
        for flight in [FLIGHT, second] {
            assert_eq!(mission.label_counts(flight, 1), (1, 0));
            let told = mission.told_of_labels(flight);
            assert!(
                told[0].starts_with("Labels of 1 picture do not say"),
                "{told:?}"
            );
        }
        mission.set_label(&of_second, label(2, 90.0));
        assert_eq!(
            (mission.labels.len(), mission.labels[0].boxes.len()),
            (1, 2)
        );
        assert_eq!(mission.label_counts(FLIGHT, 1), (0, 0));
    }

    #[test]
    fn a_box_keeps_its_place_when_another_is_put_into_the_picture_in_another_size() {
        let mut mission = mission();
        let half = LabelledPicture {
            size: (320, 240),
            ..picture("00001.jpg")
        };
        mission.set_label(&half, label(1, 150.0));
        mission.set_label(&picture("00001.jpg"), label(2, 5.0));
        let labels = mission.labels_of(FLIGHT, "00001.jpg").unwrap();
        assert_eq!(labels.size, SIZE);
        let corners = |id| labels.of(id).map(|b| (b.min, b.max));
        assert_eq!(corners(1), Some(([300.0, 20.0], [361.0, 84.5])));
        assert_eq!(corners(2), Some(([5.0, 10.0], [35.5, 42.25])));
    }

    #[test]
    fn labels_go_with_their_landmark_and_are_never_those_of_the_next_one() {
        let mut mission = mission();
        let bounds = GroundRect::centered(GroundPoint::new(0.0, 0.0), 20.0, 20.0);
        let add = |mission: &mut Mission, name: &str| {
            let id = mission.free_landmark_id();
            mission.landmarks.push(Landmark::new(id, name, bounds));
            id
        };
        let [pool, barn] = ["Pool", "Barn"].map(|name| add(&mut mission, name));
        mission.set_label(&picture("00001.jpg"), label(barn, 5.0));
        mission.set_label(&picture("00001.jpg"), label(pool, 90.0));
        mission.mark_absent(&picture("00002.jpg"), barn);
        assert!(mission.delete_landmarks(&[barn]) && !mission.delete_landmarks(&[barn]));
        assert_eq!(mission.label_counts(FLIGHT, pool), (1, 0));
        assert_eq!(
            mission.labels.len(),
            1,
            "of the second picture nothing is said"
        );
        let next = add(&mut mission, "Shed");
        assert_eq!(mission.label_counts(FLIGHT, next), (0, 0));
        // Labels of a landmark that is gone, as files of before may hold them.
        mission.set_label(&picture("00001.jpg"), label(7, 200.0));
        assert_eq!(mission.free_landmark_id(), 8);
    }
}
