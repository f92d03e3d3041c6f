//! Heights of an area in memory, taken from a slower model.

use serde::{Deserialize, Serialize};

use super::{HeightDatum, Terrain, between_posts};
use pilotage_base::frames::{GroundPoint, GroundRect};

/// Heights at a north-up grid of posts; between posts they are interpolated.
///
/// Small enough to be sent from where a model is read to where its heights are used.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeightGrid {
    name: String,
    datum: HeightDatum,
    /// The first post stands in the north-west corner.
    area: GroundRect,
    /// Metres between posts.
    spacing: f64,
    columns: usize,
    /// Metres above the datum, row by row from the north; not a number where unknown.
    heights: Vec<f32>,
}

impl HeightGrid {
    /// A grid over `area` without heights, with posts `spacing` metres apart or farther, so that it
    /// has at most `most_posts` along a side. [`take_rows`](Self::take_rows) fills it.
    ///
    /// ```
    /// use pilotage_maps::frames::{GroundPoint, GroundRect};
    /// use pilotage_maps::terrain::{HeightDatum, HeightGrid, Terrain};
    ///
    /// struct Slope; // rises by one in ten towards the north
    /// impl Terrain for Slope {
    /// #     fn name(&self) -> &str { "slope" }
    /// #     fn datum(&self) -> &HeightDatum { &HeightDatum::NotStated }
    ///     fn height_at(&self, place: &GroundPoint) -> Option<f64> { Some(0.1 * place.north) }
    /// }
    /// let area = GroundRect::centered(GroundPoint::new(0.0, 0.0), 200.0, 200.0);
    /// let mut grid = HeightGrid::over("grid", HeightDatum::NotStated, area, 50.0, 100);
    /// assert!(grid.take_rows(&Slope, usize::MAX)); // all at once
    /// assert_eq!(grid.extremes(), Some((-10.0, 10.0)));
    /// assert_eq!(grid.height_at(&GroundPoint::new(25.0, 10.0)), Some(2.5));
    /// ```
    pub fn over(
        name: &str,
        datum: HeightDatum,
        area: GroundRect,
        spacing: f64,
        most_posts: usize,
    ) -> Self {
        let longest = area.width().max(area.height());
        let spacing = spacing
            .max(longest / (most_posts.max(2) - 1) as f64)
            .max(1e-3);
        let columns = (area.width() / spacing).ceil().max(1.0) as usize + 1;
        Self {
            name: name.to_owned(),
            datum,
            area,
            spacing,
            columns,
            heights: Vec::new(),
        }
    }

    /// Rows in all.
    pub fn rows(&self) -> usize {
        (self.area.height() / self.spacing).ceil().max(1.0) as usize + 1
    }

    /// Rows that are filled.
    pub fn rows_taken(&self) -> usize {
        self.heights.len() / self.columns
    }

    /// Fills the next `count` rows from `terrain`; true once all are.
    pub fn take_rows(&mut self, terrain: &dyn Terrain, count: usize) -> bool {
        let rows = self.rows();
        for _ in 0..count {
            let row = self.rows_taken();
            if row >= rows {
                break;
            }
            let north = self.area.north - row as f64 * self.spacing;
            for column in 0..self.columns {
                let east = self.area.west + column as f64 * self.spacing;
                let height = terrain.height_at(&GroundPoint::new(north, east));
                self.heights.push(height.map_or(f32::NAN, |h| h as f32));
            }
        }
        self.rows_taken() >= rows
    }

    /// The ground that was asked for.
    pub fn area(&self) -> &GroundRect {
        &self.area
    }

    /// Metres between posts.
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Lowest and highest post, metres; `None` if no height is known.
    pub fn extremes(&self) -> Option<(f64, f64)> {
        let known = self.heights.iter().filter(|h| h.is_finite());
        let low = known.clone().copied().reduce(f32::min)?;
        let high = known.copied().reduce(f32::max)?;
        Some((f64::from(low), f64::from(high)))
    }
}

impl Terrain for HeightGrid {
    fn name(&self) -> &str {
        &self.name
    }

    fn datum(&self) -> &HeightDatum {
        &self.datum
    }

    /// Bilinear between the four posts around the place; unknown outside and where a post that
    /// counts is.
    fn height_at(&self, place: &GroundPoint) -> Option<f64> {
        let x = (place.east - self.area.west) / self.spacing;
        let y = (self.area.north - place.north) / self.spacing;
        let (last_column, last_row) = (self.columns - 1, self.rows() - 1);
        let inside =
            (0.0..=last_column as f64).contains(&x) && (0.0..=last_row as f64).contains(&y);
        if !inside {
            return None;
        }
        let sum = between_posts((x, y), (last_column, last_row), |column, row| {
            let post = self.heights.get(row * self.columns + column)?;
            Some(f64::from(*post))
        })?;
        sum.is_finite().then_some(sum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A slope with a lake of unknown depth.
    struct Slope(HeightDatum);

    impl Terrain for Slope {
        fn name(&self) -> &'static str {
            "slope"
        }
        fn datum(&self) -> &HeightDatum {
            &self.0
        }
        fn height_at(&self, place: &GroundPoint) -> Option<f64> {
            let lake = GroundRect::centered(GroundPoint::new(400.0, 400.0), 30.0, 30.0);
            (!lake.contains(place)).then_some(100.0 + 0.1 * place.north - 0.05 * place.east)
        }
    }

    fn grid(most_posts: usize) -> HeightGrid {
        let area = GroundRect::centered(GroundPoint::new(0.0, 0.0), 1000.0, 1400.0);
        let slope = Slope(HeightDatum::NotStated);
        let mut grid = HeightGrid::over("slope", slope.0.clone(), area, 10.0, most_posts);
        assert!(grid.height_at(&GroundPoint::new(0.0, 0.0)).is_none());
        while !grid.take_rows(&slope, 7) {}
        grid
    }

    #[test]
    fn a_slope_is_the_same_in_the_grid_also_between_posts() {
        let grid = grid(1000);
        assert!((grid.spacing() - 10.0).abs() < 1e-9);
        for (north, east) in [(0.0, 0.0), (-499.0, 3.3), (123.4, -699.9)] {
            let place = GroundPoint::new(north, east);
            let height = grid.height_at(&place).unwrap();
            assert!((height - (100.0 + 0.1 * north - 0.05 * east)).abs() < 1e-3);
        }
        let (low, high) = grid.extremes().unwrap();
        assert!((low - 15.0).abs() < 1e-3 && (high - 185.0).abs() < 1e-3);
    }

    #[test]
    fn what_is_unknown_stays_unknown() {
        let grid = grid(1000);
        assert_eq!(grid.height_at(&GroundPoint::new(400.0, 400.0)), None);
        assert_eq!(grid.height_at(&GroundPoint::new(600.0, 0.0)), None);
    }

    #[test]
    fn a_large_area_gets_posts_farther_apart() {
        let grid = grid(50);
        assert!((grid.spacing() - 1400.0 / 49.0).abs() < 1e-9);
        assert!(grid.height_at(&GroundPoint::new(0.0, 0.0)).is_some());
    }
}
