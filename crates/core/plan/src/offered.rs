//! Field of fixes that the map itself offers: its places rehearsed one after the other, and what follows from
//! them.

use std::sync::Arc;

use super::candidate::LandmarkCandidate;
use super::field::{FieldBuilder, FieldView, FixSource, Localizability};
use super::suggest::Ranking;
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_raster::imagery::Imagery;

/// The field of a map without landmarks: every place of a lattice is rehearsed as if it were one.
///
/// A place whose patch is flat or like its neighbours fails its rehearsal, so that water, woods and
/// bare fields come out blind. Look-alikes count as far away as the detector will have to search for the
/// stated uncertainty of the position.
pub struct OfferedField {
    map: Arc<dyn Imagery>,
    days: Vec<Arc<dyn Imagery>>,
    side: f64,
    radius: f64,
    reach: f64,
    lattice: Lattice,
    next: usize,
    found: Vec<LandmarkCandidate>,
    builder: FieldBuilder,
}

/// Middles of boxes side by side over a region, row by row from the north.
#[derive(Clone, Copy, Debug)]
struct Lattice {
    corner: GroundPoint,
    side: f64,
    columns: usize,
    rows: usize,
}

impl Lattice {
    fn over(region: &GroundRect, side: f64) -> Self {
        let count = |length: f64| (length / side).floor().max(0.0) as usize;
        Self {
            corner: GroundPoint::new(region.north, region.west),
            side,
            columns: count(region.width()),
            rows: count(region.height()),
        }
    }

    fn len(&self) -> usize {
        self.columns * self.rows
    }

    fn bounds(&self, index: usize) -> GroundRect {
        let (row, column) = (index / self.columns, index % self.columns);
        let north = self.corner.north - self.side * row as f64;
        let west = self.corner.east + self.side * column as f64;
        GroundRect {
            south: north - self.side,
            north,
            west,
            east: west + self.side,
        }
    }
}

impl OfferedField {
    /// Prepares to rehearse boxes of `side` metres side by side over `region` on `days`, for a field
    /// with cells of `step` metres.
    ///
    /// `search_sigmas` is the half width of the detector's search in standard deviations.
    pub fn new(
        map: Arc<dyn Imagery>,
        days: Vec<Arc<dyn Imagery>>,
        view: FieldView,
        region: &GroundRect,
        (side, step): (f64, f64),
        search_sigmas: f64,
    ) -> Self {
        let radius = view.searched(search_sigmas, side);
        Self {
            map,
            days,
            side,
            radius,
            reach: view.reach(),
            lattice: Lattice::over(region, side),
            next: 0,
            found: Vec::new(),
            builder: FieldBuilder::new(view, region, step, Vec::new()),
        }
    }

    /// Places rehearsed, and places in all.
    pub fn progress(&self) -> (usize, usize) {
        (self.next, self.lattice.len())
    }

    /// Field as far as it is known.
    pub fn field(&self) -> &Localizability {
        self.builder.field()
    }

    /// The places that passed so far, from north to south.
    pub fn found(&self) -> &[LandmarkCandidate] {
        &self.found
    }

    /// The field, finished or not.
    pub fn into_field(self) -> Localizability {
        self.builder.into_field()
    }

    /// Rehearses the next place and computes the rows of the field to which no further place matters;
    /// false when all is done.
    pub fn advance(&mut self) -> bool {
        if self.next < self.lattice.len() {
            let bounds = self.lattice.bounds(self.next);
            let map = Arc::clone(&self.map);
            // A hair wider, so that rounding leaves room for the one box.
            let around = bounds.grown(1e-3);
            let mut one = Ranking::new(map, &self.days, &around, self.side, self.radius);
            one.advance();
            if let Some(candidate) = one.ranked().into_iter().next() {
                self.builder.add(FixSource {
                    bounds,
                    probability: candidate.probability(),
                });
                self.found.push(candidate);
            }
            self.next += 1;
        }
        let done = self.next == self.lattice.len();
        let rows = self.next / self.lattice.columns.max(1);
        let southernmost = self.lattice.corner.north - self.side * (rows as f64 + 0.5);
        while let Some(north) = self.builder.next_north()
            && (done || north - self.reach > southernmost)
        {
            self.builder.advance();
        }
        !done
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_raster::camera::CameraModel;
    use pilotage_raster::imagery::Window;
    use pilotage_raster::raster::{Raster, Rgba};

    /// Still water with one house that looks like nothing else, or without.
    struct Water {
        house: bool,
    }

    impl Imagery for Water {
        fn name(&self) -> &'static str {
            "water"
        }

        fn bounds(&self) -> GroundRect {
            GroundRect::centered(GroundPoint::default(), 640.0, 640.0)
        }

        fn native_gsd(&self) -> f64 {
            0.5
        }

        fn window(&self, window: &Window) -> Raster<Rgba> {
            Raster::from_fn(window.width, window.height, |column, row| {
                let p = window.ground_at(column as f64 + 0.5, row as f64 + 0.5);
                let wall = (p.north - 80.0).abs() < 9.0 && (p.east + 80.0).abs() < 6.0;
                let yard = (p.north - 75.0).abs() < 13.0 && (p.east + 72.0).abs() < 10.0;
                let grey = match (self.house, wall, yard) {
                    (true, true, _) => 220,
                    (true, _, true) => 140,
                    _ => 70,
                };
                [grey, grey, grey, 255]
            })
        }
    }

    fn field(house: bool) -> Localizability {
        let map: Arc<dyn Imagery> = Arc::new(Water { house });
        let days = vec![Arc::clone(&map)];
        let view = FieldView {
            camera: CameraModel::pinhole(640, 480, 60_f64.to_radians()),
            height: 120.0,
            position: 5.0,
            tilt: 0.0,
        };
        let region = map.bounds();
        let mut offered = OfferedField::new(map, days, view, &region, (32.0, 20.0), 3.5);
        while offered.advance() {}
        offered.into_field()
    }

    #[test]
    fn water_is_blind_and_a_house_in_it_is_not() {
        let bare = field(false);
        assert_eq!(bare.known(), 1.0);
        assert_eq!(bare.blind_share(0.01), Some(1.0));
        let built = field(true);
        let over = built.at(&GroundPoint::new(80.0, -80.0)).unwrap();
        assert!(over > 0.3, "{over}");
        let far = built.at(&GroundPoint::new(-250.0, 250.0)).unwrap();
        assert!(far < 1e-3, "{far}");
    }

    #[test]
    fn rows_appear_from_the_north_while_places_are_rehearsed() {
        let map: Arc<dyn Imagery> = Arc::new(Water { house: true });
        let days = vec![Arc::clone(&map)];
        let view = FieldView {
            camera: CameraModel::pinhole(640, 480, 60_f64.to_radians()),
            height: 60.0,
            position: 2.0,
            tilt: 0.0,
        };
        let region = map.bounds();
        let mut offered = OfferedField::new(map, days, view, &region, (32.0, 20.0), 3.5);
        let (_, all) = offered.progress();
        while offered.progress().0 < all / 2 {
            offered.advance();
        }
        let known = offered.field().known();
        assert!((0.2..0.6).contains(&known), "{known}");
        assert!(offered.field().values[0].is_finite());
        while offered.advance() {}
        assert_eq!(offered.field().known(), 1.0);
    }
}
