//! Labels of a mission's pictures: asked, added, taken away.

use super::{FrameLabels, LabelBox, Mission};

impl Mission {
    /// Labels of a picture.
    pub fn labels_of(&self, frame: &str) -> Option<&FrameLabels> {
        self.labels.iter().find(|l| l.frame == frame)
    }

    /// Pictures with a box of a landmark, and pictures that are marked as without it.
    pub fn label_counts(&self, landmark: u32) -> (usize, usize) {
        let count =
            |of: &dyn Fn(&FrameLabels) -> bool| self.labels.iter().filter(|l| of(l)).count();
        (
            count(&|l| l.of(landmark).is_some()),
            count(&|l| l.lacks(landmark)),
        )
    }

    /// Puts a box into a picture of `size`, in place of an earlier one of the same landmark.
    pub fn set_label(&mut self, frame: &str, size: (u32, u32), label: LabelBox) {
        let labels = self.labels_entry(frame, size);
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

    /// Marks a landmark as not in a picture of `size`; a box of it goes.
    pub fn mark_absent(&mut self, frame: &str, size: (u32, u32), landmark: u32) {
        let labels = self.labels_entry(frame, size);
        labels.forget(landmark);
        labels.absent.push(landmark);
    }

    /// Takes away what was said of a landmark in a picture; false if that was nothing.
    pub fn clear_label(&mut self, frame: &str, landmark: u32) -> bool {
        let known = |l: &FrameLabels| l.of(landmark).is_some() || l.lacks(landmark);
        let Some(place) = self
            .labels
            .iter()
            .position(|l| l.frame == frame && known(l))
        else {
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
                frame: name,
                size,
                boxes,
                absent,
                properties,
            } = frame;
            self.labels_entry(&name, size).properties.extend(properties);
            for id in absent {
                self.mark_absent(&name, size, id);
            }
            for label in boxes {
                self.set_label(&name, size, label);
            }
        }
    }

    fn labels_entry(&mut self, frame: &str, size: (u32, u32)) -> &mut FrameLabels {
        let known = self.labels.iter().position(|l| l.frame == frame);
        let place = known.unwrap_or_else(|| {
            let place = self.labels.partition_point(|l| l.frame.as_str() < frame);
            let new = FrameLabels {
                frame: frame.to_owned(),
                ..FrameLabels::default()
            };
            self.labels.insert(place, new);
            place
        });
        let labels = &mut self.labels[place];
        labels.size = size;
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
        mission.set_label("00002.jpg", SIZE, label(1, 5.0));
        mission.set_label("00001.jpg", SIZE, label(1, 5.0));
        mission.set_label("00002.jpg", SIZE, label(1, 90.0));
        mission.set_label("00002.jpg", SIZE, label(2, 7.0));
        assert_eq!(mission.labels_of("00002.jpg").unwrap().boxes.len(), 2);
        assert_eq!(
            mission.labels_of("00002.jpg").unwrap().of(1).unwrap().min[0],
            90.0
        );
        assert_eq!(
            mission.labels[0].frame, "00001.jpg",
            "in the order of names"
        );
        mission.mark_absent("00002.jpg", SIZE, 1);
        assert_eq!(mission.label_counts(1), (1, 1));
        mission.set_label("00002.jpg", SIZE, label(1, 4.0));
        assert_eq!(mission.label_counts(1), (2, 0));
        assert!(mission.clear_label("00001.jpg", 1) && !mission.clear_label("00001.jpg", 1));
        assert_eq!(mission.labels.len(), 1, "nothing is left of the first");
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
        mission.set_label("00001.jpg", SIZE, label(barn, 5.0));
        mission.set_label("00001.jpg", SIZE, label(pool, 90.0));
        mission.mark_absent("00002.jpg", SIZE, barn);
        assert!(mission.delete_landmarks(&[barn]) && !mission.delete_landmarks(&[barn]));
        assert_eq!(mission.label_counts(pool), (1, 0));
        assert_eq!(
            mission.labels.len(),
            1,
            "of the second picture nothing is said"
        );
        let next = add(&mut mission, "Shed");
        assert_eq!(mission.label_counts(next), (0, 0));
        // Labels of a landmark that is gone, as files of before may hold them.
        mission.set_label("00001.jpg", SIZE, label(7, 200.0));
        assert_eq!(mission.free_landmark_id(), 8);
    }
}
