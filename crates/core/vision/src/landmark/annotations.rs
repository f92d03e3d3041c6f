//! Annotations of a landmark by people, beside its place: category, notes, direction, outline.
//!
//! They are properties like those of other programs, under the names and with the values that files
//! have; docs/formats.md lists them.

use serde_json::Value;

use super::Landmark;
use pilotage_base::frames::{GroundPoint, GroundRect};

/// Property with the category, a text.
pub const CATEGORY: &str = "category";
/// Property with notes, a text.
pub const NOTES: &str = "notes";
/// Property with the direction, degrees clockwise from north.
pub const ORIENTATION: &str = "orientation_deg";
/// Property with the corners of an outline: metres north and east of the reference point.
pub const OUTLINE: &str = "outline_m";
/// Property with the rings inside an outline that are not part of it, corners as those of the outline.
pub const HOLES: &str = "holes_m";
/// Property that says what a landmark is where that is no box.
const SHAPE: &str = "shape";
/// Shape of a landmark of which people marked only a point.
const POINT: &str = "point";

impl Landmark {
    pub(super) fn noted<T: serde::de::DeserializeOwned>(&self, name: &str) -> Option<T> {
        serde_json::from_str(self.properties.get(name)?).ok()
    }

    pub(super) fn note(&mut self, name: &str, value: Option<Value>) {
        match value {
            Some(value) => {
                self.properties.insert(name.to_owned(), value.to_string());
            }
            None => {
                self.properties.remove(name);
            }
        }
    }

    fn note_text(&mut self, name: &str, text: &str) {
        let text = text.trim();
        self.note(name, (!text.is_empty()).then(|| Value::from(text)));
    }

    /// Category of the landmark, in the user's words; empty if nobody said.
    pub fn category(&self) -> String {
        self.noted(CATEGORY).unwrap_or_default()
    }

    /// Says what kind of thing it is.
    pub fn set_category(&mut self, category: &str) {
        self.note_text(CATEGORY, category);
    }

    /// Notes of people on the landmark; empty without any.
    pub fn notes(&self) -> String {
        self.noted(NOTES).unwrap_or_default()
    }

    /// Notes something of it.
    pub fn set_notes(&mut self, notes: &str) {
        self.note_text(NOTES, notes);
    }

    /// The direction in which it lies, radians clockwise from north.
    pub fn orientation(&self) -> Option<f64> {
        self.noted::<f64>(ORIENTATION).map(f64::to_radians)
    }

    /// States the direction in which it lies, radians clockwise from north.
    pub fn set_orientation(&mut self, orientation: Option<f64>) {
        // To a millionth of a degree, so that the text of a file stays short.
        let degrees = orientation.map(|o| (o.to_degrees().rem_euclid(360.0) * 1e6).round() / 1e6);
        self.note(ORIENTATION, degrees.map(Value::from));
    }

    /// Whether people marked a point, so that the size of the box is nobody's choice.
    pub fn is_point(&self) -> bool {
        self.noted::<String>(SHAPE).as_deref() == Some(POINT)
    }

    /// A landmark of which only a point is marked, with a box of `side` metres around it.
    ///
    /// ```
    /// use pilotage_base::frames::GroundPoint;
    /// use pilotage_vision::landmark::Landmark;
    ///
    /// let point = GroundPoint::new(10.0, 20.0);
    /// let mut landmark = Landmark::at_point(7, "Crossroads", point, 30.0);
    /// assert_eq!((landmark.reference, landmark.bounds.width()), (point, 30.0));
    /// assert!(landmark.is_point());
    /// landmark.set_category("road");
    /// assert_eq!(landmark.category(), "road");
    /// ```
    pub fn at_point(id: u32, name: impl Into<String>, point: GroundPoint, side: f64) -> Self {
        let mut landmark = Self::new(id, name, GroundRect::centered(point, side, side));
        landmark.mark_point();
        landmark
    }

    /// Says that people marked a point.
    pub fn mark_point(&mut self) {
        self.note(SHAPE, Some(Value::from(POINT)));
    }

    /// The corners of its outline, where that is no box; without the first one again at the end.
    pub fn outline(&self) -> Option<Vec<GroundPoint>> {
        let corners: Vec<[f64; 2]> = self.noted(OUTLINE)?;
        let r = self.reference;
        let place = |[north, east]: [f64; 2]| GroundPoint::new(r.north + north, r.east + east);
        (corners.len() >= 3).then(|| corners.into_iter().map(place).collect())
    }

    /// Gives it an outline of three corners or more, and the box around it. The reference point stays.
    pub fn set_outline(&mut self, corners: &[GroundPoint]) {
        let Some(bounds) = GroundRect::around(corners.iter().copied()) else {
            return;
        };
        if corners.len() < 3 {
            return;
        }
        self.bounds = bounds;
        self.properties.remove(SHAPE);
        self.write_outline(corners);
    }

    fn write_outline(&mut self, corners: &[GroundPoint]) {
        let r = self.reference;
        let offset = |c: &GroundPoint| Value::from(vec![c.north - r.north, c.east - r.east]);
        let list: Vec<Value> = corners.iter().map(offset).collect();
        self.note(OUTLINE, Some(Value::from(list)));
    }

    /// Rings inside of it that are not part of it; each without its first corner again at the end.
    pub fn holes(&self) -> Vec<Vec<GroundPoint>> {
        let holes: Vec<Vec<[f64; 2]>> = self.noted(HOLES).unwrap_or_default();
        let r = self.reference;
        let place = |[north, east]: [f64; 2]| GroundPoint::new(r.north + north, r.east + east);
        holes
            .into_iter()
            .map(|ring| ring.into_iter().map(place).collect())
            .collect()
    }

    /// Gives it rings that are not part of it; those of fewer than three corners are none.
    pub fn set_holes(&mut self, holes: &[Vec<GroundPoint>]) {
        let r = self.reference;
        let offset = |c: &GroundPoint| [c.north - r.north, c.east - r.east];
        let rings: Vec<Vec<[f64; 2]>> = holes
            .iter()
            .filter(|ring| ring.len() >= 3)
            .map(|ring| ring.iter().map(offset).collect())
            .collect();
        self.note(HOLES, (!rings.is_empty()).then(|| serde_json::json!(rings)));
    }

    /// Gives it another box; outline and reference point keep their places in it. Another size is
    /// somebody's choice, so that what was a point is a box then.
    pub fn reshape(&mut self, bounds: GroundRect) {
        let old = self.bounds;
        let (height, width) = (old.height().max(1e-6), old.width().max(1e-6));
        let place = |p: &GroundPoint| {
            let north = (p.north - old.south) / height;
            let east = (p.east - old.west) / width;
            GroundPoint::new(
                bounds.south + north * bounds.height(),
                bounds.west + east * bounds.width(),
            )
        };
        let (outline, mut holes) = (self.outline(), self.holes());
        self.reference = place(&self.reference);
        self.bounds = bounds;
        for corner in holes.iter_mut().flatten() {
            *corner = place(corner);
        }
        self.set_holes(&holes);
        if let Some(corners) = outline {
            let corners: Vec<GroundPoint> = corners.iter().map(place).collect();
            self.write_outline(&corners);
        }
        let is_resized = (bounds.height() - old.height()).abs() > 1e-6
            || (bounds.width() - old.width()).abs() > 1e-6;
        if is_resized {
            self.properties.remove(SHAPE);
        }
    }

    /// Puts its reference point elsewhere; box and outline stay.
    pub fn set_reference(&mut self, reference: GroundPoint) {
        let (outline, holes) = (self.outline(), self.holes());
        self.reference = reference;
        self.set_holes(&holes);
        if let Some(corners) = outline {
            self.write_outline(&corners);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle() -> Landmark {
        let bounds = GroundRect::centered(GroundPoint::new(10.0, 20.0), 4.0, 4.0);
        let mut landmark = Landmark::new(1, "Roof", bounds);
        landmark.set_outline(&corners());
        landmark
    }

    fn corners() -> [GroundPoint; 3] {
        [(0.0, 0.0), (0.0, 30.0), (40.0, 0.0)].map(|(n, e)| GroundPoint::new(n, e))
    }

    #[test]
    fn an_outline_has_its_box_around_it() {
        let landmark = triangle();
        assert_eq!(landmark.outline(), Some(corners().to_vec()));
        assert_eq!(landmark.bounds.height(), 40.0);
        assert_eq!(landmark.bounds.width(), 30.0);
    }

    #[test]
    fn holes_move_and_grow_with_the_box_and_stay_under_another_reference() {
        let mut landmark = triangle();
        let hole = [(5.0, 5.0), (5.0, 10.0), (10.0, 5.0)].map(|(n, e)| GroundPoint::new(n, e));
        landmark.set_holes(&[hole.to_vec(), vec![GroundPoint::default()]]);
        landmark.set_reference(GroundPoint::new(1.0, 2.0));
        assert_eq!(landmark.holes(), [hole.to_vec()]);
        let moved = GroundRect {
            south: 100.0,
            north: 180.0,
            west: 0.0,
            east: 60.0,
        };
        landmark.reshape(moved);
        let corner = landmark.holes()[0][1];
        assert!(
            corner.distance(&GroundPoint::new(110.0, 20.0)) < 1e-9,
            "{corner:?}"
        );
    }

    #[test]
    fn an_outline_moves_and_grows_with_its_box_and_stays_under_another_reference() {
        let mut landmark = triangle();
        let twice = GroundRect {
            south: 100.0,
            north: 180.0,
            west: 0.0,
            east: 60.0,
        };
        landmark.reshape(twice);
        let last = landmark.outline().unwrap()[2];
        assert!(
            last.distance(&GroundPoint::new(180.0, 0.0)) < 1e-9,
            "{last:?}"
        );
        landmark.set_reference(GroundPoint::new(120.0, 5.0));
        let same = landmark.outline().unwrap()[2];
        assert!(same.distance(&last) < 1e-9, "{same:?}");
    }

    #[test]
    fn a_point_that_is_given_a_size_is_a_box() {
        let mut point = Landmark::at_point(1, "Mast", GroundPoint::new(0.0, 0.0), 20.0);
        assert!(point.is_point());
        point.reshape(GroundRect::centered(GroundPoint::new(5.0, 5.0), 20.0, 20.0));
        assert!(point.is_point(), "it was only moved");
        point.reshape(GroundRect::centered(GroundPoint::new(5.0, 5.0), 24.0, 20.0));
        assert!(!point.is_point());
    }

    #[test]
    fn what_is_noted_is_read_again_and_nothing_is_no_property() {
        let mut landmark = triangle();
        landmark.set_category(" building ");
        landmark.set_notes("red roof, \"Miller\"");
        landmark.set_orientation(Some(-0.5_f64.to_radians()));
        assert_eq!(landmark.category(), "building");
        assert_eq!(landmark.notes(), "red roof, \"Miller\"");
        assert_eq!(landmark.properties[ORIENTATION], "359.5");
        landmark.set_category("");
        landmark.set_orientation(None);
        assert_eq!(landmark.orientation(), None);
        assert!(!landmark.properties.contains_key(CATEGORY));
    }

    #[test]
    fn a_property_of_somebody_else_with_our_name_is_not_taken_for_ours() {
        let mut landmark = triangle();
        let own = "{\"a\":1}".to_owned();
        landmark.properties.insert(CATEGORY.to_owned(), own.clone());
        assert_eq!(landmark.category(), "");
        assert_eq!(landmark.properties[CATEGORY], own);
    }
}
