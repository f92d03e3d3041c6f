//! Plane geometry in single precision: vectors, boxes, outlines and their signed distances.

use std::ops::{Add, Mul, Sub};

use pilotage_base::frames::GroundPoint;

/// A place or a displacement on the ground, metres north and east.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Spot {
    pub(super) n: f32,
    pub(super) e: f32,
}

/// Shorthand for a [`Spot`].
pub(super) const fn spot(n: f32, e: f32) -> Spot {
    Spot { n, e }
}

impl Spot {
    /// The unit vector with that heading, radians clockwise from north.
    pub(super) fn heading(angle: f32) -> Self {
        spot(angle.cos(), angle.sin())
    }
    /// Rotated a quarter turn to the right.
    pub(super) fn right(self) -> Self {
        spot(-self.e, self.n)
    }
    pub(super) fn dot(self, o: Self) -> f32 {
        self.n * o.n + self.e * o.e
    }
    pub(super) fn cross(self, o: Self) -> f32 {
        self.n * o.e - self.e * o.n
    }
    pub(super) fn length(self) -> f32 {
        self.dot(self).sqrt()
    }
    pub(super) fn unit(self) -> Self {
        self * (1.0 / self.length().max(1e-6))
    }
    pub(super) fn ground(self) -> GroundPoint {
        GroundPoint::new(f64::from(self.n), f64::from(self.e))
    }
}

impl Add for Spot {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        spot(self.n + o.n, self.e + o.e)
    }
}
impl Sub for Spot {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        spot(self.n - o.n, self.e - o.e)
    }
}
impl Mul<f32> for Spot {
    type Output = Self;
    fn mul(self, k: f32) -> Self {
        spot(self.n * k, self.e * k)
    }
}

/// A rectangle at any angle: half lengths along `axis` and across it (to the right of it).
#[derive(Clone, Copy, Debug)]
pub(super) struct Slab {
    pub(super) center: Spot,
    /// Unit vector of the long side.
    pub(super) axis: Spot,
    /// Half extent along the axis, metres.
    pub(super) half_along: f32,
    /// Half extent across the axis, metres.
    pub(super) half_across: f32,
}

impl Slab {
    /// A rectangle of `length` along the heading `angle` (radians) and `width` across.
    pub(super) fn new(center: Spot, angle: f32, length: f32, width: f32) -> Self {
        Self {
            center,
            axis: Spot::heading(angle),
            half_along: 0.5 * length,
            half_across: 0.5 * width,
        }
    }
    /// Coordinates (along, across) of a place relative to the centre.
    #[inline]
    pub(super) fn local(&self, p: Spot) -> (f32, f32) {
        let d = p - self.center;
        (d.dot(self.axis), self.axis.cross(d))
    }
    /// The place at coordinates (along, across).
    pub(super) fn at(&self, along: f32, across: f32) -> Spot {
        self.center + self.axis * along + self.axis.right() * across
    }
    /// Signed distance (Chebyshev at the corners), negative inside.
    #[inline]
    pub(super) fn distance(&self, p: Spot) -> f32 {
        let (u, v) = self.local(p);
        (u.abs() - self.half_along).max(v.abs() - self.half_across)
    }
    pub(super) fn corners(&self) -> [Spot; 4] {
        let (a, b) = (self.half_along, self.half_across);
        [
            self.at(-a, -b),
            self.at(a, -b),
            self.at(a, b),
            self.at(-a, b),
        ]
    }
    /// Grown by a margin on every side.
    pub(super) fn grown(&self, margin: f32) -> Self {
        Self {
            half_along: self.half_along + margin,
            half_across: self.half_across + margin,
            ..*self
        }
    }
    /// Whether two rectangles overlap (separating axes).
    pub(super) fn overlaps(&self, other: &Self) -> bool {
        let d = other.center - self.center;
        let reach = |s: &Self, axis: Spot| {
            s.half_along * s.axis.dot(axis).abs() + s.half_across * s.axis.right().dot(axis).abs()
        };
        [self.axis, self.axis.right(), other.axis, other.axis.right()]
            .into_iter()
            .all(|axis| d.dot(axis).abs() < reach(self, axis) + reach(other, axis))
    }
}

/// An outline on the ground.
#[derive(Clone, Debug)]
pub(super) enum GroundOutline {
    Slab(Slab),
    Disc(Spot, f32),
    /// Corners in order, any simple polygon.
    Polygon(Vec<Spot>),
    /// An ellipse: centre, unit long axis, half extents.
    Ellipse(Slab),
}

impl GroundOutline {
    /// Signed distance, metres, negative inside (approximate outside for ellipses).
    #[inline]
    pub(super) fn distance(&self, p: Spot) -> f32 {
        match self {
            Self::Slab(s) => s.distance(p),
            Self::Disc(c, r) => (p - *c).length() - r,
            Self::Polygon(corners) => polygon_distance(corners, p),
            Self::Ellipse(s) => {
                let (u, v) = s.local(p);
                let k = ((u / s.half_along).powi(2) + (v / s.half_across).powi(2)).sqrt();
                (k - 1.0) * s.half_along.min(s.half_across)
            }
        }
    }
    /// Corners of (an approximation of) the outline.
    pub(super) fn corners(&self) -> Vec<Spot> {
        let round = |s: &Slab| {
            (0..24)
                .map(|i| {
                    let (sin, cos) = (i as f32 * std::f32::consts::TAU / 24.0).sin_cos();
                    s.at(cos * s.half_along, sin * s.half_across)
                })
                .collect()
        };
        match self {
            Self::Slab(s) => s.corners().to_vec(),
            Self::Disc(c, r) => round(&Slab::new(*c, 0.0, 2.0 * r, 2.0 * r)),
            Self::Polygon(corners) => corners.clone(),
            Self::Ellipse(s) => round(s),
        }
    }
}

/// Signed distance to a simple polygon, negative inside.
pub(super) fn polygon_distance(corners: &[Spot], p: Spot) -> f32 {
    let mut best = f32::MAX;
    let mut inside = false;
    let mut previous = corners[corners.len() - 1];
    for &c in corners {
        best = best.min(segment_distance(p, previous, c).0);
        if (c.n > p.n) != (previous.n > p.n)
            && p.e < (previous.e - c.e) * (p.n - c.n) / (previous.n - c.n) + c.e
        {
            inside = !inside;
        }
        previous = c;
    }
    if inside { -best } else { best }
}

/// Distance to the segment from `a` to `b`, and the share of the way along it.
#[inline]
pub(super) fn segment_distance(p: Spot, a: Spot, b: Spot) -> (f32, f32) {
    let (d, q) = (b - a, p - a);
    let t = (q.dot(d) / d.dot(d).max(1e-9)).clamp(0.0, 1.0);
    ((q - d * t).length(), t)
}

/// Convex hull in order (monotone chain), clockwise or counter-clockwise but consistent.
pub(super) fn convex_hull(mut points: Vec<Spot>) -> Vec<Spot> {
    points.sort_by(|a, b| a.n.total_cmp(&b.n).then(a.e.total_cmp(&b.e)));
    let half = |points: &mut dyn Iterator<Item = Spot>| {
        let mut chain: Vec<Spot> = Vec::new();
        for p in points {
            while chain.len() >= 2 {
                let (a, b) = (chain[chain.len() - 2], chain[chain.len() - 1]);
                if (b - a).cross(p - b) > 1e-5 {
                    break;
                }
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut points.iter().copied());
    hull.extend(half(&mut points.iter().rev().copied()));
    hull
}

/// Corners of a smooth curve through the control points (centripetal enough for roads), with
/// steps of about `step` metres.
pub(super) fn smooth_curve(controls: &[Spot], step: f32) -> Vec<Spot> {
    let mut curve = Vec::new();
    let last = controls.len() - 1;
    for i in 0..last {
        let (b, c) = (controls[i], controls[i + 1]);
        let span = (c - b).length();
        let tangent = |k: usize| {
            if k == 0 {
                (controls[1] - controls[0]).unit()
            } else if k == last {
                (controls[last] - controls[last - 1]).unit()
            } else {
                let before = (controls[k] - controls[k - 1]).unit();
                let after = (controls[k + 1] - controls[k]).unit();
                (before + after).unit()
            }
        };
        let (m0, m1) = (tangent(i) * span, tangent(i + 1) * span);
        let straight = m0.unit().dot(m1.unit()) > 0.999_9;
        let steps = if straight {
            (span / 60.0).ceil()
        } else {
            (span / step).ceil()
        }
        .max(1.0) as usize;
        for k in 0..steps {
            let t = k as f32 / steps as f32;
            let (t2, t3) = (t * t, t * t * t);
            curve.push(
                b * (2.0 * t3 - 3.0 * t2 + 1.0)
                    + m0 * (t3 - 2.0 * t2 + t)
                    + c * (3.0 * t2 - 2.0 * t3)
                    + m1 * (t3 - t2),
            );
        }
    }
    curve.push(controls[last]);
    curve
}
