//! The table of DeAngelo 2016, chapter 3: a row of three unsigned integers for each landmark.

use crate::ReferenceTable;
use pilotage_raster::imagery::Window;

impl ReferenceTable {
    /// Rows (pixel x, pixel y, number of the class) of the landmarks that lie in a map's `picture`, from its top.
    ///
    /// A map of more than 65,535 pixels along a side has no such table: what lies beyond is left out.
    pub fn pixel_rows(&self, picture: &Window) -> Vec<[u16; 3]> {
        let row = |landmark: &crate::GenericLandmark| {
            let (x, y) = picture.pixel_at(&landmark.place);
            let inside = (0.0..picture.width as f64).contains(&x)
                && (0.0..picture.height as f64).contains(&y)
                && x.max(y) < f64::from(u16::MAX);
            inside.then(|| [x as u16, y as u16, u16::from(landmark.class.number())])
        };
        self.landmarks().iter().rev().filter_map(row).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{GenericClass, GenericLandmark};
    use pilotage_base::frames::{GroundPoint, GroundRect};

    #[test]
    fn the_thesis_table_counts_pixels_from_the_top_left_and_takes_six_bytes_a_row() {
        let at = |north, east, class| GenericLandmark {
            place: GroundPoint::new(north, east),
            class,
            size: 9.0,
            orientation: 0.0,
            confidence: 1.0,
            stability: 1.0,
        };
        let all = vec![
            at(10.0, -40.0, GenericClass::Tree),
            at(40.0, 0.0, GenericClass::Building),
            at(60.0, 0.0, GenericClass::Building),
        ];
        let ground = GroundRect::centered(GroundPoint::new(0.0, 0.0), 100.0, 100.0);
        let rows = ReferenceTable::new(all, Vec::new()).pixel_rows(&Window::covering(&ground, 0.5));
        assert_eq!(rows, [[100, 20, 1], [20, 80, 3]]);
        assert_eq!(size_of_val(&rows[..]), 12);
    }
}
