//! Boxes that people put around landmarks in the pictures of a flight.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// Steps per pixel in which corners are kept: fine enough for a hand, and exact in every format.
const STEPS: f64 = 256.0;
/// Least side of a box, pixels.
const LEAST_SIDE: f64 = 2.0;
/// Property with the outline of a label that a file of COCO had, in pixels.
const OUTLINE: &str = "coco:segmentation";

/// Box of a landmark in one picture.
///
/// Pixels with x right and y down, origin at the outer corner of the top left pixel; fractions count.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LabelBox {
    /// Id of the landmark.
    pub landmark: u32,
    /// Its name when the label was made.
    pub name: String,
    /// Left and top edge.
    pub min: [f64; 2],
    /// Right and bottom edge.
    pub max: [f64; 2],
    /// Whether it is hard to see: trainers may leave it out.
    #[serde(default)]
    pub difficult: bool,
    /// Whether the picture ends before the landmark does.
    #[serde(default)]
    pub truncated: bool,
    /// Other properties in the label's file, by name, as they stood there.
    #[serde(default)]
    pub properties: BTreeMap<String, String>,
}

impl LabelBox {
    /// A box between two corners in a picture of `size` (width, height), cut at its edges; `None` if
    /// too little of it lies in the picture.
    ///
    /// ```
    /// use pilotage_mission::mission::LabelBox;
    ///
    /// // Drawn from the lower right to beyond the left edge of a picture of 640 × 480 pixels.
    /// let label = LabelBox::new(3, "Bridge", [[50.0, 80.0], [-10.0, 20.0]], (640, 480));
    /// let label = label.ok_or("outside the picture")?;
    /// assert_eq!((label.min, label.max), ([0.0, 20.0], [50.0, 80.0]));
    /// assert!(label.truncated);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn new(
        landmark: u32,
        name: &str,
        corners: [[f64; 2]; 2],
        size: (u32, u32),
    ) -> Option<Self> {
        let limits = [f64::from(size.0), f64::from(size.1)];
        let [a, b] = corners;
        let (mut min, mut max, mut truncated) = ([0.0; 2], [0.0; 2], false);
        for axis in 0..2 {
            let (low, high) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
            if !(low.is_finite() && high.is_finite()) {
                return None;
            }
            let kept = |v: f64| (v.clamp(0.0, limits[axis]) * STEPS).round() / STEPS;
            (min[axis], max[axis]) = (kept(low), kept(high));
            truncated |= low <= 0.0 || high >= limits[axis];
        }
        let is_seen = (0..2).all(|axis| max[axis] - min[axis] >= LEAST_SIDE);
        is_seen.then(|| Self {
            landmark,
            name: name.to_owned(),
            min,
            max,
            difficult: false,
            truncated,
            properties: BTreeMap::new(),
        })
    }

    /// Width and height, pixels.
    pub fn size(&self) -> [f64; 2] {
        [self.max[0] - self.min[0], self.max[1] - self.min[1]]
    }

    /// The same label with other corners in a picture of `size`, as [`Self::new`] takes them. An outline beside it was that of
    /// the box before, and goes.
    #[must_use]
    pub fn reshaped(&self, corners: [[f64; 2]; 2], size: (u32, u32)) -> Option<Self> {
        let mut properties = self.properties.clone();
        properties.remove(OUTLINE);
        Some(Self {
            difficult: self.difficult,
            properties,
            ..Self::new(self.landmark, &self.name, corners, size)?
        })
    }

    /// Whether a file had the landmark's outline beside the box.
    pub fn has_outline(&self) -> bool {
        self.properties.contains_key(OUTLINE)
    }

    /// The box in a picture that is so many times as wide and as high. An outline beside it would be one of the other picture.
    fn scaled(&self, by: [f64; 2]) -> Self {
        let corner =
            |corner: [f64; 2]| [0, 1].map(|axis| (corner[axis] * by[axis] * STEPS).round() / STEPS);
        let mut scaled = Self {
            min: corner(self.min),
            max: corner(self.max),
            ..self.clone()
        };
        scaled.properties.remove(OUTLINE);
        scaled
    }
}

/// A picture that is labelled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LabelledPicture {
    /// Its flight, as [`pilotage_flight::Flight::identity`] says it; empty where nobody said.
    pub flight: String,
    /// Its file name, as the flight has it.
    pub frame: String,
    /// Width and height, pixels.
    pub size: (u32, u32),
}

/// Labels that people gave one picture. A landmark has one place in the world, so at most one box.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FrameLabels {
    /// Flight of the picture, as [`pilotage_flight::Flight::identity`] says it; empty where nobody said. Other flights
    /// have pictures of the same name.
    #[serde(default)]
    pub flight: String,
    /// File name of the picture, as the flight has it.
    pub frame: String,
    /// Width and height of the picture, pixels.
    pub size: (u32, u32),
    /// The boxes.
    #[serde(default)]
    pub boxes: Vec<LabelBox>,
    /// Ids of landmarks that are certainly not in the picture: views for a trainer to learn from.
    #[serde(default)]
    pub absent: Vec<u32>,
    /// Other properties in the picture's file, by name, as they stood there.
    #[serde(default)]
    pub properties: BTreeMap<String, String>,
}

impl FrameLabels {
    /// Whether the picture may be of that flight: it is, or nobody said of which it is.
    pub fn is_of(&self, flight: &str) -> bool {
        self.flight.is_empty() || self.flight == flight
    }

    /// The same labels of a copy of the picture of another size: each side of a box goes with its side of the picture.
    #[must_use]
    pub fn at_size(&self, size: (u32, u32)) -> Self {
        let is_known = self.size.0 > 0 && self.size.1 > 0;
        if !is_known || self.size == size {
            return Self {
                size,
                ..self.clone()
            };
        }
        let by = [(size.0, self.size.0), (size.1, self.size.1)];
        let by = by.map(|(to, from)| f64::from(to) / f64::from(from));
        Self {
            size,
            boxes: self.boxes.iter().map(|label| label.scaled(by)).collect(),
            ..self.clone()
        }
    }

    /// The box of a landmark.
    pub fn of(&self, landmark: u32) -> Option<&LabelBox> {
        self.boxes.iter().find(|b| b.landmark == landmark)
    }

    /// Whether a landmark is marked as not in the picture.
    pub fn lacks(&self, landmark: u32) -> bool {
        self.absent.contains(&landmark)
    }

    /// Place among `labels` of those of a picture of a flight: its own, else those of which nobody said the flight.
    pub fn place_among(labels: &[Self], flight: &str, frame: &str) -> Option<usize> {
        let place = |of: &str| {
            let is_it = |l: &Self| l.frame == frame && l.flight == of;
            labels.iter().position(is_it)
        };
        place(flight).or_else(|| place(""))
    }

    /// Whether something is said of a landmark: a box of it, or that it is not in the picture.
    pub fn tells_of(&self, landmark: u32) -> bool {
        self.of(landmark).is_some() || self.lacks(landmark)
    }

    /// Whether nothing is said of the picture.
    pub(super) fn is_empty(&self) -> bool {
        self.boxes.is_empty() && self.absent.is_empty() && self.properties.is_empty()
    }

    /// Ids of the landmarks of which something is said.
    pub(super) fn landmarks(&self) -> impl Iterator<Item = u32> {
        let boxes = self.boxes.iter().map(|b| b.landmark);
        boxes.chain(self.absent.iter().copied())
    }

    /// Takes away what was said of a landmark.
    pub(super) fn forget(&mut self, landmark: u32) {
        self.boxes.retain(|b| b.landmark != landmark);
        self.absent.retain(|id| *id != landmark);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: (u32, u32) = (640, 480);

    fn label(landmark: u32, left: f64) -> LabelBox {
        LabelBox::new(landmark, "Barn", [[left, 10.0], [left + 30.5, 42.25]], SIZE).unwrap()
    }

    #[test]
    fn boxes_go_with_the_size_of_their_picture_side_by_side() {
        // The middle of a copy that was stretched to a square is the middle of the picture.
        let square = FrameLabels {
            size: (640, 640),
            boxes: LabelBox::new(1, "", [[300.0, 310.0], [340.0, 330.0]], (640, 640))
                .into_iter()
                .collect(),
            ..FrameLabels::default()
        };
        let whole = square.at_size((4000, 3000));
        assert_eq!(whole.boxes[0].min, [1875.0, 1453.125]);
        assert_eq!(whole.boxes[0].max, [2125.0, 1546.875]);
        assert_eq!(whole.at_size((640, 640)), square);
    }

    #[test]
    fn a_box_that_is_moved_keeps_what_other_programs_said_but_for_its_outline() {
        let mut own = label(1, 5.0);
        own.difficult = true;
        for name in ["voc:pose", OUTLINE] {
            own.properties.insert(name.to_owned(), "1".to_owned());
        }
        let moved = own.reshaped([[6.0, 10.0], [36.5, 42.25]], SIZE).unwrap();
        assert!(own.has_outline() && !moved.has_outline());
        own.properties.remove(OUTLINE);
        (own.min[0], own.max[0]) = (6.0, 36.5);
        assert_eq!(moved, own);
    }

    #[test]
    fn a_box_is_cut_at_the_edges_and_says_so() {
        let cut = LabelBox::new(1, "", [[-20.0, 30.0], [15.5, 12.0]], SIZE).unwrap();
        assert_eq!((cut.min, cut.max), ([0.0, 12.0], [15.5, 30.0]));
        assert!(cut.truncated && !label(1, 5.0).truncated);
        assert_eq!(cut.size(), [15.5, 18.0]);
        assert!(LabelBox::new(1, "", [[-20.0, 3.0], [1.0, 12.0]], SIZE).is_none());
        assert!(LabelBox::new(1, "", [[f64::NAN, 3.0], [9.0, 12.0]], SIZE).is_none());
    }
}
