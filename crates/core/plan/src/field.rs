//! Field of localizability: the probability of a fix on a grid over the map.
//!
//! A fix is had at a place if a landmark lies wholly in the picture taken there and is accepted. The
//! aircraft is at the place only within the uncertainty of its position, and looks along any heading:
//! the probability is the mean over both.

use pilotage_base::sorting::sort;
use std::f64::consts::TAU;

use nalgebra::{Point2, Point3};
use serde::{Deserialize, Serialize};

use super::PlannedLandmark;
use pilotage_base::frames::{Attitude, GroundPoint, GroundRect, Pose};
use pilotage_base::statistics::normal_probability;
use pilotage_mission::settings::SensorNoise;
use pilotage_raster::camera::CameraModel;

/// Headings over which the probability is averaged.
const HEADINGS: usize = 12;
/// Standard deviations beyond which a place cannot matter.
const FAR: f64 = 4.0;
/// Greatest distance at which look-alikes are looked for, in sides of a box.
const WIDEST: f64 = 6.0;
/// Uncertainty of the position below which an edge is drawn as sharp, metres.
const SHARP: f64 = 1.0;

/// View of the ground: camera, height and uncertainties.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FieldView {
    /// The camera.
    pub camera: CameraModel,
    /// Its height above ground, metres.
    pub height: f64,
    /// Standard deviation of the position per axis, metres.
    pub position: f64,
    /// Standard deviation of the camera's roll and pitch, radians.
    pub tilt: f64,
}

/// Something that gives a fix while it lies wholly in the picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FixSource {
    /// Its box.
    pub bounds: GroundRect,
    /// Probability that it is accepted in a picture that holds it.
    pub probability: f64,
}

impl FixSource {
    /// The source that a landmark is from `height` metres; `None` if it is never found from there.
    pub fn of(landmark: &PlannedLandmark, height: f64) -> Option<Self> {
        let probability = landmark.detection.at(height)?.probability();
        (probability > 0.0).then_some(Self {
            bounds: landmark.landmark.bounds,
            probability,
        })
    }
}

/// Part of the ground in the picture, metres from the place below a level aircraft: ahead and to the
/// right.
#[derive(Clone, Copy, Debug)]
struct GroundInPicture {
    ahead: [f64; 2],
    right: [f64; 2],
}

impl FieldView {
    /// View of a flight at `height` metres above ground, whose position is known to `position` metres per axis and whose
    /// attitude as its sensors tell it.
    pub fn of_flight(
        camera: CameraModel,
        height: f64,
        position: f64,
        sensors: &SensorNoise,
    ) -> Self {
        Self {
            camera,
            height,
            position,
            tilt: sensors.roll.max(sensors.pitch),
        }
    }

    /// Uncertainty of where the picture lies on the ground, metres per axis.
    pub fn spread(&self) -> f64 {
        self.position.hypot(self.height * self.tilt).max(SHARP)
    }

    /// Distance around a box of `side` metres up to which the detector looks for it, metres: as many standard
    /// deviations as it searches, but a side at least, and no more than six.
    pub fn searched(&self, search_sigmas: f64, side: f64) -> f64 {
        (search_sigmas * self.spread()).clamp(side, WIDEST * side)
    }

    /// Shorter side of the picture on the ground, metres; `None` if it does not see the ground.
    ///
    /// ```
    /// use pilotage_plan::FieldView;
    /// use pilotage_raster::camera::CameraModel;
    ///
    /// // 480 rows with a focal length of 320 pixels, from 160 m.
    /// let camera = CameraModel::pinhole(640, 480, 90_f64.to_radians());
    /// let view = FieldView { camera, height: 160.0, position: 5.0, tilt: 0.02 };
    /// assert!((view.across().ok_or("no ground")? - 240.0).abs() < 1e-9);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn across(&self) -> Option<f64> {
        let seen = self.seen()?;
        Some((seen.ahead[1] - seen.ahead[0]).min(seen.right[1] - seen.right[0]))
    }

    /// Distance from a place beyond which nothing on the ground matters to it, metres.
    pub fn reach(&self) -> f64 {
        self.seen().map_or(0.0, |seen| {
            let far = |edges: [f64; 2]| edges[0].abs().max(edges[1].abs());
            far(seen.ahead).hypot(far(seen.right)) + FAR * self.spread()
        })
    }

    fn seen(&self) -> Option<GroundInPicture> {
        let pose = Pose {
            position_in_world: Point3::new(0.0, 0.0, -self.height),
            attitude: Attitude::level(0.0),
        };
        let (w, h) = (self.camera.width as f64, self.camera.height as f64);
        let at = |x: f64, y: f64| self.camera.ground_at(&pose, &Point2::new(x, y), 0.0);
        let (top, bottom) = (at(0.5 * w, 0.0)?, at(0.5 * w, h)?);
        let (left, right) = (at(0.0, 0.5 * h)?, at(w, 0.5 * h)?);
        let sorted = |a: f64, b: f64| [a.min(b), a.max(b)];
        Some(GroundInPicture {
            ahead: sorted(top.north, bottom.north),
            right: sorted(left.east, right.east),
        })
    }
}

/// The probability of a fix on a grid over the map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Localizability {
    /// The ground that the cells cover; its north-west corner is that of the first cell.
    pub bounds: GroundRect,
    /// Side of a cell, metres.
    pub step: f64,
    /// Cells from west to east.
    pub columns: usize,
    /// Cells from north to south.
    pub rows: usize,
    /// Probability in the middle of each cell, row by row from the north-west; not a number where it
    /// is not known yet.
    pub values: Vec<f32>,
}

impl Localizability {
    /// A grid over `region` of which nothing is known yet.
    ///
    /// ```
    /// use pilotage_base::frames::{GroundPoint, GroundRect};
    /// use pilotage_plan::Localizability;
    ///
    /// let region = GroundRect::centered(GroundPoint::new(0.0, 0.0), 100.0, 200.0);
    /// let mut field = Localizability::unknown(&region, 50.0);
    /// assert_eq!((field.columns, field.rows), (4, 2));
    /// // The north-west cell.
    /// field.values[0] = 0.9;
    /// assert_eq!(field.at(&GroundPoint::new(40.0, -90.0)).map(|p| (100.0 * p).round()), Some(90.0));
    /// assert_eq!(field.at(&GroundPoint::new(0.0, 10.0)), None);
    /// assert_eq!(field.known(), 0.125);
    /// ```
    pub fn unknown(region: &GroundRect, step: f64) -> Self {
        let step = step.max(0.1);
        let count = |length: f64| (length / step).ceil().max(1.0) as usize;
        let (columns, rows) = (count(region.width()), count(region.height()));
        Self {
            bounds: GroundRect {
                north: region.north,
                south: region.north - rows as f64 * step,
                west: region.west,
                east: region.west + columns as f64 * step,
            },
            step,
            columns,
            rows,
            values: vec![f32::NAN; columns * rows],
        }
    }

    /// Middle of a cell.
    pub fn place(&self, column: usize, row: usize) -> GroundPoint {
        GroundPoint::new(
            self.bounds.north - (row as f64 + 0.5) * self.step,
            self.bounds.west + (column as f64 + 0.5) * self.step,
        )
    }

    /// Cell (column, row) of a place, if it lies on the grid.
    pub fn cell(&self, place: &GroundPoint) -> Option<(usize, usize)> {
        let column = ((place.east - self.bounds.west) / self.step).floor();
        let row = ((self.bounds.north - place.north) / self.step).floor();
        let inside =
            (0.0..self.columns as f64).contains(&column) && (0.0..self.rows as f64).contains(&row);
        inside.then_some((column as usize, row as usize))
    }

    /// Probability of a fix at a place; `None` beyond the grid or where it is not known.
    pub fn at(&self, place: &GroundPoint) -> Option<f64> {
        let (column, row) = self.cell(place)?;
        let value = f64::from(self.values[row * self.columns + column]);
        value.is_finite().then_some(value)
    }

    /// Share of the cells that are known.
    pub fn known(&self) -> f64 {
        let known = self.values.iter().filter(|v| v.is_finite()).count();
        known as f64 / self.values.len().max(1) as f64
    }

    /// Share of the known ground where a fix is less likely than `least`.
    pub fn blind_share(&self, least: f64) -> Option<f64> {
        let known = self.values.iter().filter(|v| v.is_finite());
        let (mut all, mut blind) = (0_usize, 0_usize);
        for value in known {
            all += 1;
            blind += usize::from(f64::from(*value) < least);
        }
        (all > 0).then(|| blind as f64 / all as f64)
    }
}

/// Computes a field row by row, from north to south.
#[derive(Clone, Debug)]
pub struct FieldBuilder {
    view: FieldView,
    seen: Option<GroundInPicture>,
    sources: Vec<FixSource>,
    field: Localizability,
    row: usize,
}

impl FieldBuilder {
    /// Prepares a grid over `region` with cells of `step` metres.
    ///
    /// ```
    /// # use pilotage_base::frames::{GroundPoint, GroundRect};
    /// use pilotage_plan::{FieldBuilder, FieldView, FixSource};
    /// # use pilotage_raster::camera::CameraModel;
    ///
    /// // 200 × 150 m of ground in the picture; one landmark that is found in nine of ten.
    /// let camera = CameraModel::pinhole(640, 480, 90_f64.to_radians());
    /// let view = FieldView { camera, height: 100.0, position: 5.0, tilt: 0.01 };
    /// let bounds = GroundRect::centered(GroundPoint::new(0.0, 0.0), 20.0, 20.0);
    /// let region = GroundRect::centered(GroundPoint::new(0.0, 0.0), 820.0, 820.0);
    /// let sources = vec![FixSource { bounds, probability: 0.9 }];
    /// let mut builder = FieldBuilder::new(view, &region, 20.0, sources);
    /// while builder.advance() {}
    /// let at = |north| builder.field().at(&GroundPoint::new(north, 0.0)).ok_or("unknown");
    /// assert!((at(0.0)? - 0.9).abs() < 1e-3);
    /// assert!(at(300.0)? < 1e-6);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn new(view: FieldView, region: &GroundRect, step: f64, sources: Vec<FixSource>) -> Self {
        let mut sources = sources;
        sort(&mut sources, &|a, b| {
            b.bounds.center().north.total_cmp(&a.bounds.center().north)
        });
        Self {
            seen: view.seen(),
            view,
            sources,
            field: Localizability::unknown(region, step),
            row: 0,
        }
    }

    /// Another source, south of those before.
    pub fn add(&mut self, source: FixSource) {
        self.sources.push(source);
    }

    /// Field as far as it is known.
    pub fn field(&self) -> &Localizability {
        &self.field
    }

    /// The field, finished or not.
    pub fn into_field(self) -> Localizability {
        self.field
    }

    /// Rows done, and rows in all.
    pub fn progress(&self) -> (usize, usize) {
        (self.row, self.field.rows)
    }

    /// North coordinate of the next row; `None` when all are done.
    pub fn next_north(&self) -> Option<f64> {
        (self.row < self.field.rows).then(|| self.field.place(0, self.row).north)
    }

    /// Computes the next row; false when all are done.
    pub fn advance(&mut self) -> bool {
        let Some(north) = self.next_north() else {
            return false;
        };
        let reach = self.view.reach();
        // Sources lie in order from north to south.
        let first = self
            .sources
            .partition_point(|s| s.bounds.center().north > north + reach);
        let end = self
            .sources
            .partition_point(|s| s.bounds.center().north >= north - reach);
        let row = &self.sources[first..end];
        let begin = self.row * self.field.columns;
        for column in 0..self.field.columns {
            let place = self.field.place(column, self.row);
            self.field.values[begin + column] = self.probability(&place, row, reach) as f32;
        }
        self.row += 1;
        true
    }

    fn probability(&self, place: &GroundPoint, sources: &[FixSource], reach: f64) -> f64 {
        let near: Vec<&FixSource> = sources
            .iter()
            .filter(|s| s.bounds.center().distance(place) <= reach)
            .collect();
        let Some(seen) = self.seen.filter(|_| !near.is_empty()) else {
            return 0.0;
        };
        let spread = self.view.spread();
        let mut sum = 0.0;
        for turn in 0..HEADINGS {
            let (sin, cos) = (TAU * (turn as f64 + 0.25) / HEADINGS as f64).sin_cos();
            let mut missed = 1.0;
            for source in &near {
                let b = &source.bounds;
                let way = b.center().to_vector() - place.to_vector();
                let (ahead, right) = (cos * way.x + sin * way.y, cos * way.y - sin * way.x);
                // Half of the box across the two axes of the picture.
                let (n, e) = (0.5 * b.height(), 0.5 * b.width());
                let half_ahead = n * cos.abs() + e * sin.abs();
                let half_right = n * sin.abs() + e * cos.abs();
                let held = within(ahead, seen.ahead, half_ahead, spread)
                    * within(right, seen.right, half_right, spread);
                missed *= 1.0 - source.probability * held;
            }
            sum += 1.0 - missed;
        }
        sum / HEADINGS as f64
    }
}

/// Probability that `at`, with a deviation of `spread`, lies `half` metres inside both edges.
fn within(at: f64, [low, high]: [f64; 2], half: f64, spread: f64) -> f64 {
    let (low, high) = (low + half, high - half);
    if high <= low {
        return 0.0;
    }
    (normal_probability((high - at) / spread) - normal_probability((low - at) / spread)).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn view(height: f64, position: f64) -> FieldView {
        FieldView {
            camera: CameraModel::pinhole(640, 480, 60_f64.to_radians()),
            height,
            position,
            tilt: 0.0,
        }
    }

    fn source(north: f64, east: f64, probability: f64) -> FixSource {
        FixSource {
            bounds: GroundRect::centered(GroundPoint::new(north, east), 30.0, 30.0),
            probability,
        }
    }

    fn field(view: FieldView, sources: Vec<FixSource>) -> Localizability {
        let region = GroundRect::centered(GroundPoint::default(), 900.0, 700.0);
        let mut builder = FieldBuilder::new(view, &region, 12.0, sources);
        while builder.advance() {}
        builder.into_field()
    }

    #[test]
    fn ground_without_anything_to_find_is_blind_everywhere() {
        let field = field(view(120.0, 5.0), Vec::new());
        assert!(field.values.iter().all(|v| *v == 0.0));
        assert_eq!(field.blind_share(0.01), Some(1.0));
        assert_eq!(field.known(), 1.0);
    }

    #[test]
    fn a_landmark_makes_a_disc_of_its_footprint() {
        let view = view(120.0, 2.0);
        let middle = GroundPoint::new(7.0, -23.0);
        let field = field(view.clone(), vec![source(middle.north, middle.east, 0.9)]);
        // The picture is 138.6 m by 103.9 m on the ground; the box has a half diagonal of 21.2 m.
        let certain = 0.5 * 103.9 - 21.2 - 8.0;
        let out_of_reach = 0.5 * 138.6_f64.hypot(103.9) - 15.0 + 8.0;
        for row in 0..field.rows {
            for column in 0..field.columns {
                let place = field.place(column, row);
                let p = field.at(&place).unwrap();
                let away = place.distance(&middle);
                if away < certain {
                    assert!((p - 0.9).abs() < 1e-3, "{p} at {away} m");
                } else if away > out_of_reach {
                    assert!(p < 1e-3, "{p} at {away} m");
                }
            }
        }
    }

    #[test]
    fn an_uncertain_position_blurs_the_disc_and_keeps_its_weight() {
        let weight = |position: f64| {
            let field = field(view(120.0, position), vec![source(0.0, 0.0, 0.8)]);
            let sum: f64 = field.values.iter().map(|v| f64::from(*v)).sum();
            let top = field.at(&GroundPoint::default()).unwrap();
            (sum, top)
        };
        let (sharp, top) = weight(1.0);
        let (blurred, low) = weight(60.0);
        assert!((sharp / blurred - 1.0).abs() < 0.02, "{sharp} {blurred}");
        assert!(low < 0.5 * top, "{low} under {top}");
    }

    #[test]
    fn a_box_that_does_not_fit_into_the_picture_gives_no_fix() {
        let low = field(view(25.0, 2.0), vec![source(0.0, 0.0, 1.0)]);
        assert!(low.values.iter().all(|v| *v == 0.0));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn another_landmark_never_makes_a_place_blinder(
            places in prop::collection::vec((-400.0_f64..400.0, -300.0_f64..300.0, 0.0_f64..1.0), 1..8),
            position in 0.0_f64..40.0,
        ) {
            let all: Vec<FixSource> = places.iter().map(|(n, e, p)| source(*n, *e, *p)).collect();
            let fewer = field(view(120.0, position), all[1..].to_vec());
            let more = field(view(120.0, position), all);
            for (a, b) in fewer.values.iter().zip(&more.values) {
                prop_assert!(*b >= a - 1e-6 && (0.0..=1.0).contains(b), "{a} {b}");
            }
        }
    }
}
