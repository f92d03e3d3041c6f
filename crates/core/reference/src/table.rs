//! The table of a map's generic landmarks.

use serde::{Deserialize, Serialize};

use crate::{GenericClass, GenericLandmark};
use pilotage_base::frames::{Geodetic, GroundPoint, GroundRect};

/// Generic landmarks of a map, from south to north.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ReferenceTable {
    /// Names of the classes that people added, for [`GenericClass::Other`].
    others: Vec<String>,
    /// Sorted by how far north they lie, so that a band of them is a slice.
    landmarks: Vec<GenericLandmark>,
    /// Place of the origin from which places are metres north and east.
    origin: Option<Geodetic>,
    /// Ground in a pixel in which the landmarks were sought, metres.
    gsd: Option<f64>,
}

impl ReferenceTable {
    /// Widest pixel in which things are sought, metres.
    pub const WIDEST_PIXEL: f64 = 1e4;

    /// A table of `landmarks`, in any order, with the names of classes that people added. Landmarks whose numbers
    /// are not finite, or whose class has no name, are left out.
    ///
    /// ```
    /// use pilotage_base::frames::GroundPoint;
    /// use pilotage_reference::{GenericClass, GenericLandmark, ReferenceTable};
    ///
    /// let house = GenericLandmark {
    ///     place: GroundPoint::new(120.0, 40.0),
    ///     class: GenericClass::Building,
    ///     size: 12.0,
    ///     orientation: 0.0,
    ///     confidence: 0.9,
    ///     stability: 0.9,
    /// };
    /// let nowhere = GenericLandmark { place: GroundPoint::new(f64::NAN, 0.0), ..house };
    /// let table = ReferenceTable::new(vec![house, nowhere], Vec::new());
    /// assert_eq!(table.landmarks().len(), 1);
    /// ```
    pub fn new(mut landmarks: Vec<GenericLandmark>, mut others: Vec<String>) -> Self {
        others.truncate(usize::from(GenericClass::MOST_OTHERS));
        landmarks.retain(|landmark| {
            let numbers = [
                landmark.place.north,
                landmark.place.east,
                landmark.size,
                landmark.orientation,
                landmark.confidence,
                landmark.stability,
            ];
            let is_named = match landmark.class {
                GenericClass::Other(name) => usize::from(name) < others.len(),
                _ => true,
            };
            is_named && numbers.iter().all(|number| number.is_finite())
        });
        landmarks.sort_by(|a, b| a.place.north.total_cmp(&b.place.north));
        Self {
            others,
            landmarks,
            origin: None,
            gsd: None,
        }
    }

    /// The same table of a map whose world has its origin there, if it is known where on the globe.
    #[must_use]
    pub fn on_globe(self, origin: Option<Geodetic>) -> Self {
        Self { origin, ..self }
    }

    /// The same table of landmarks that were sought in pixels of `gsd` metres, at most [`ReferenceTable::WIDEST_PIXEL`].
    ///
    /// ```
    /// use pilotage_reference::ReferenceTable;
    ///
    /// let gsd = |metres| ReferenceTable::default().sought_in(metres).gsd();
    /// assert_eq!(gsd(0.5), Some(0.5));
    /// assert_eq!([0.0, f64::NAN, 20_000.0].map(gsd), [None; 3]);
    /// ```
    #[must_use]
    pub fn sought_in(self, gsd: f64) -> Self {
        let gsd = (gsd > 0.0 && gsd <= Self::WIDEST_PIXEL).then_some(gsd);
        Self { gsd, ..self }
    }

    /// Place of the origin from which places are metres north and east, if it is known.
    pub fn origin(&self) -> Option<Geodetic> {
        self.origin
    }

    /// Ground in a pixel in which its landmarks were sought, metres, if it is known.
    pub fn gsd(&self) -> Option<f64> {
        self.gsd
    }

    /// Its landmarks, from south to north.
    pub fn landmarks(&self) -> &[GenericLandmark] {
        &self.landmarks
    }

    /// Names of the classes that people added.
    pub fn others(&self) -> &[String] {
        &self.others
    }

    /// Ground that holds all landmarks; `None` of an empty table.
    pub fn bounds(&self) -> Option<GroundRect> {
        GroundRect::around(self.landmarks.iter().map(|landmark| landmark.place))
    }

    /// Landmarks at most `reach` metres from `place`.
    ///
    /// ```
    /// use pilotage_base::frames::GroundPoint;
    /// use pilotage_reference::{GenericClass, GenericLandmark, ReferenceTable};
    ///
    /// let tree = |(north, east)| GenericLandmark {
    ///     place: GroundPoint::new(north, east),
    ///     class: GenericClass::Tree,
    ///     size: 8.0,
    ///     orientation: 0.0,
    ///     confidence: 1.0,
    ///     stability: 1.0,
    /// };
    /// let table = ReferenceTable::new([(3.0, 4.0), (3.0, 5.0), (0.0, -5.0)].map(tree).to_vec(), Vec::new());
    /// // √(3² + 4²) is within reach, √(3² + 5²) is not.
    /// let near: Vec<f64> = table.near(GroundPoint::default(), 5.0).map(|tree| tree.place.east).collect();
    /// assert_eq!(near, [-5.0, 4.0]);
    /// ```
    pub fn near(
        &self,
        place: GroundPoint,
        reach: f64,
    ) -> impl Iterator<Item = &GenericLandmark> + '_ {
        let south_of = |north: f64| move |landmark: &GenericLandmark| landmark.place.north < north;
        let first = self
            .landmarks
            .partition_point(south_of(place.north - reach));
        let band = self.landmarks[first..]
            .iter()
            .take_while(move |landmark| landmark.place.north <= place.north + reach);
        band.filter(move |landmark| landmark.place.distance(&place) <= reach)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(north: f64, east: f64, class: GenericClass) -> GenericLandmark {
        GenericLandmark {
            place: GroundPoint::new(north, east),
            class,
            size: 10.0,
            orientation: 0.0,
            confidence: 1.0,
            stability: 1.0,
        }
    }

    #[test]
    fn landmarks_near_a_place_are_those_within_reach_and_no_others() {
        let all = (0..400)
            .map(|i| {
                at(
                    f64::from(i % 20) * 10.0,
                    f64::from(i / 20) * 10.0,
                    GenericClass::Tree,
                )
            })
            .collect();
        let table = ReferenceTable::new(all, Vec::new());
        let here = GroundPoint::new(93.0, 57.0);
        let found = table.near(here, 35.0).count();
        let every = table.landmarks().iter();
        let expected = every.filter(|l| l.place.distance(&here) <= 35.0).count();
        assert_eq!(found, expected);
        assert!(found > 30);
    }

    #[test]
    fn a_landmark_of_a_class_without_name_is_left_out() {
        let all = vec![
            at(0.0, 0.0, GenericClass::Other(0)),
            at(0.0, 0.0, GenericClass::Other(1)),
            at(f64::NAN, 0.0, GenericClass::Tree),
        ];
        let table = ReferenceTable::new(all, vec!["haystack".to_owned()]);
        assert_eq!(table.landmarks().len(), 1);
    }
}
