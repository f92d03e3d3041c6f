//! Points and rectangles on the ground plane.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

/// A point on the ground in the world frame, metres north and east of the origin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct GroundPoint {
    /// Metres north of the origin.
    pub north: f64,
    /// Metres east of the origin.
    pub east: f64,
}

impl GroundPoint {
    /// The point `north`, `east` metres from the origin.
    pub const fn new(north: f64, east: f64) -> Self {
        Self { north, east }
    }

    /// Distance to `other`, metres.
    pub fn distance(&self, other: &Self) -> f64 {
        (self.north - other.north).hypot(self.east - other.east)
    }

    /// As a vector (north, east), metres.
    pub fn to_vector(self) -> Vector2<f64> {
        Vector2::new(self.north, self.east)
    }
}

impl From<Vector2<f64>> for GroundPoint {
    fn from(v: Vector2<f64>) -> Self {
        Self::new(v.x, v.y)
    }
}

/// Whether a point lies in the polygon with these corners in order around it, convex or not (crossing number).
///
/// ```
/// use pilotage_base::frames::{GroundPoint, inside};
///
/// let triangle = [(0.0, 0.0), (100.0, 0.0), (0.0, 100.0)].map(|(n, e)| GroundPoint::new(n, e));
/// assert!(inside(&triangle, &GroundPoint::new(40.0, 40.0)));
/// assert!(!inside(&triangle, &GroundPoint::new(60.0, 60.0)));
/// ```
pub fn inside<P: Copy + Into<GroundPoint>>(outline: &[P], point: &GroundPoint) -> bool {
    let mut within = false;
    let next = outline.iter().cycle().skip(1);
    for (from, to) in outline.iter().zip(next) {
        let (a, b): (GroundPoint, GroundPoint) = ((*from).into(), (*to).into());
        if (a.east > point.east) != (b.east > point.east) {
            let share = (point.east - a.east) / (b.east - a.east);
            if point.north < a.north + share * (b.north - a.north) {
                within = !within;
            }
        }
    }
    within
}

/// A north-aligned rectangle on the ground, metres in the world frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GroundRect {
    /// Southern edge, metres north of the origin.
    pub south: f64,
    /// Northern edge, metres north of the origin.
    pub north: f64,
    /// Western edge, metres east of the origin.
    pub west: f64,
    /// Eastern edge, metres east of the origin.
    pub east: f64,
}

impl GroundRect {
    /// The rectangle around `center` with the given extents, metres.
    pub fn centered(center: GroundPoint, north_extent: f64, east_extent: f64) -> Self {
        Self {
            south: center.north - 0.5 * north_extent,
            north: center.north + 0.5 * north_extent,
            west: center.east - 0.5 * east_extent,
            east: center.east + 0.5 * east_extent,
        }
    }

    /// The smallest rectangle that holds all `points`, or `None` for no points.
    ///
    /// ```
    /// use pilotage_base::frames::{GroundPoint, GroundRect};
    ///
    /// let points = [(0.0, 10.0), (30.0, -10.0), (20.0, 0.0)];
    /// let points = points.map(|(north, east)| GroundPoint::new(north, east));
    /// let around = GroundRect::around(points);
    /// let around = around.ok_or("no points")?;
    /// assert_eq!((around.height(), around.width()), (30.0, 20.0));
    /// assert_eq!(around.center(), GroundPoint::new(15.0, 0.0));
    /// # Ok::<(), &str>(())
    /// ```
    pub fn around(points: impl IntoIterator<Item = GroundPoint>) -> Option<Self> {
        points.into_iter().fold(None, |rect: Option<Self>, p| {
            let own = Self {
                south: p.north,
                north: p.north,
                west: p.east,
                east: p.east,
            };
            Some(rect.map_or(own, |r| r.union(&own)))
        })
    }

    /// Centre of the rectangle.
    pub fn center(&self) -> GroundPoint {
        GroundPoint::new(
            0.5 * (self.south + self.north),
            0.5 * (self.west + self.east),
        )
    }

    /// Its corners from the south-west by way of the south-east.
    pub fn corners(&self) -> [GroundPoint; 4] {
        [
            GroundPoint::new(self.south, self.west),
            GroundPoint::new(self.south, self.east),
            GroundPoint::new(self.north, self.east),
            GroundPoint::new(self.north, self.west),
        ]
    }

    /// North-south extent, metres.
    pub fn height(&self) -> f64 {
        self.north - self.south
    }

    /// East-west extent, metres.
    pub fn width(&self) -> f64 {
        self.east - self.west
    }

    /// Whether all of `other` lies inside.
    pub fn contains_rect(&self, other: &Self) -> bool {
        other.south >= self.south
            && other.north <= self.north
            && other.west >= self.west
            && other.east <= self.east
    }

    /// Whether `p` lies inside or on the edge.
    pub fn contains(&self, p: &GroundPoint) -> bool {
        (self.south..=self.north).contains(&p.north) && (self.west..=self.east).contains(&p.east)
    }

    #[must_use]
    /// The rectangle grown by `margin` metres on every side.
    pub fn grown(&self, margin: f64) -> Self {
        Self {
            south: self.south - margin,
            north: self.north + margin,
            west: self.west - margin,
            east: self.east + margin,
        }
    }

    #[must_use]
    /// The smallest rectangle that holds both.
    pub fn union(&self, other: &Self) -> Self {
        Self {
            south: self.south.min(other.south),
            north: self.north.max(other.north),
            west: self.west.min(other.west),
            east: self.east.max(other.east),
        }
    }

    /// Part that lies in both; `None` where they share no point.
    ///
    /// ```
    /// use pilotage_base::frames::{GroundPoint, GroundRect};
    ///
    /// let around = |north| GroundRect::centered(GroundPoint::new(north, 0.0), 20.0, 20.0);
    /// let both = around(0.0).intersection(&around(15.0)).ok_or("apart")?;
    /// assert_eq!((both.south, both.north, both.width()), (5.0, 10.0, 20.0));
    /// assert_eq!(around(0.0).intersection(&around(21.0)), None);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn intersection(&self, other: &Self) -> Option<Self> {
        self.overlaps(other).then(|| Self {
            south: self.south.max(other.south),
            north: self.north.min(other.north),
            west: self.west.max(other.west),
            east: self.east.min(other.east),
        })
    }

    /// Whether the rectangles share a point.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.south <= other.north
            && other.south <= self.north
            && self.west <= other.east
            && other.west <= self.east
    }
}
