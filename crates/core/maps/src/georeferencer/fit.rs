//! A fit and what it is worth.

use nalgebra::{Matrix3, Point2, Vector2, Vector3};
use serde::{Deserialize, Serialize};

use super::kind::TransformKind;
use super::solve;
use pilotage_base::frames::ReferenceSystem;
use pilotage_base::georeference::{Georeference, WorldFile};

/// A point that is known in the picture and in the plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ControlPoint {
    /// Pixel, centres at half integers.
    pub pixel: Point2<f64>,
    /// Place in the plane: x east, y north.
    pub place: Point2<f64>,
    /// Whether it takes part in the fit.
    pub enabled: bool,
}

/// Why there is no fit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FitError {
    /// More points are needed.
    #[error("{found} points are on; a {kind} transform takes {needed}")]
    TooFew {
        /// Points that are on.
        found: usize,
        /// Points that it takes.
        needed: usize,
        /// Name of the transform.
        kind: &'static str,
    },
    /// The points do not determine the transform.
    #[error(
        "the points lie on one place or one line; spread them over the picture for a {kind} transform"
    )]
    Degenerate {
        /// Name of the transform.
        kind: &'static str,
    },
}

/// Residual of a control point: its distance from the place where the fit puts it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// From the point's place to where the fit puts its pixel, units of the plane: east, north.
    pub in_plane: Vector2<f64>,
    /// From the point's pixel to where the fit sees its place, pixels: right, down. `None` if the
    /// fit sees it beyond the horizon.
    pub in_pixels: Option<Vector2<f64>>,
    /// As `in_plane`, for the fit to the other points only; `None` if they are too few or the point
    /// is off.
    pub left_out: Option<Vector2<f64>>,
}

/// A transform from pixels to the plane, with its errors.
#[derive(Clone, Debug, PartialEq)]
pub struct TransformFit {
    /// Kind of the transform that was fitted.
    pub kind: TransformKind,
    /// (x, y, 1) up to a factor = matrix · (column, row, 1); the factor is positive on the seen side
    /// of the horizon.
    pub plane_from_pixel: Matrix3<f64>,
    /// Residuals of all control points, in their order.
    pub residuals: Vec<Residual>,
    /// Whether the points that are on are so few that a transform of this kind goes through any of them, and the residuals
    /// check nothing.
    pub is_exact: bool,
    /// Root mean square of the residuals of the points that are on, units of the plane.
    pub rms_in_plane: f64,
    /// The same in pixels.
    pub rms_in_pixels: f64,
    /// The same for every point left out of its own fit; `None` if points are too few.
    pub rms_left_out: Option<f64>,
}

/// Fits a transform of `kind` to the points that are on.
///
/// ```
/// use nalgebra::Point2;
/// use pilotage_maps::georeferencer::{ControlPoint, TransformKind, fit};
///
/// // Half a metre a pixel, north up, the corner at (1000, 2000).
/// let point = |x: f64, y: f64| ControlPoint {
///     pixel: Point2::new(x, y),
///     place: Point2::new(1000.0 + 0.5 * x, 2000.0 - 0.5 * y),
/// #     enabled: true,
/// };
/// let points = [point(0.0, 0.0), point(400.0, 0.0), point(0.0, 300.0)];
/// let fit = fit(&points, TransformKind::Similarity)?;
/// let place = fit.place_at(&Point2::new(100.0, 200.0)).ok_or("beyond the horizon")?;
/// assert!((place - Point2::new(1050.0, 1900.0)).norm() < 1e-6);
/// assert!(fit.rms_in_pixels < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn fit(points: &[ControlPoint], kind: TransformKind) -> Result<TransformFit, FitError> {
    let on: Vec<&ControlPoint> = points.iter().filter(|p| p.enabled).collect();
    let matrix = solve_for(&on, kind)?;
    let mut fit = TransformFit {
        kind,
        plane_from_pixel: matrix,
        residuals: Vec::new(),
        is_exact: on.len() <= kind.least_points(),
        rms_in_plane: 0.0,
        rms_in_pixels: 0.0,
        rms_left_out: None,
    };
    fit.residuals = points
        .iter()
        .map(|point| fit.residual(point, &on))
        .collect();
    let of_those_on = || points.iter().zip(&fit.residuals).filter(|(p, _)| p.enabled);
    let in_plane: Vec<_> = of_those_on().map(|(_, r)| r.in_plane).collect();
    let in_pixels: Vec<_> = of_those_on().filter_map(|(_, r)| r.in_pixels).collect();
    let left_out: Option<Vec<_>> = of_those_on().map(|(_, r)| r.left_out).collect();
    let (in_plane, in_pixels) = (rms(&in_plane), rms(&in_pixels));
    let left_out = left_out.as_deref().map(rms);
    fit.rms_in_plane = in_plane;
    fit.rms_in_pixels = in_pixels;
    fit.rms_left_out = left_out;
    Ok(fit)
}

fn solve_for(on: &[&ControlPoint], kind: TransformKind) -> Result<Matrix3<f64>, FitError> {
    if on.len() < kind.least_points() {
        return Err(FitError::TooFew {
            found: on.len(),
            needed: kind.least_points(),
            kind: kind.name(),
        });
    }
    let pairs: Vec<_> = on.iter().map(|p| (p.pixel, p.place)).collect();
    solve::transform(&pairs, kind).ok_or(FitError::Degenerate { kind: kind.name() })
}

fn rms(vectors: &[Vector2<f64>]) -> f64 {
    let sum: f64 = vectors.iter().map(Vector2::norm_squared).sum();
    (sum / vectors.len().max(1) as f64).sqrt()
}

/// A point under a transform; `None` beyond the horizon.
fn mapped(matrix: &Matrix3<f64>, point: &Point2<f64>) -> Option<Point2<f64>> {
    let h = matrix * point.to_homogeneous();
    (h.z > 0.0).then(|| Point2::new(h.x / h.z, h.y / h.z))
}

impl TransformFit {
    /// Place of a pixel; `None` beyond the horizon.
    pub fn place_at(&self, pixel: &Point2<f64>) -> Option<Point2<f64>> {
        mapped(&self.plane_from_pixel, pixel)
    }

    /// Pixel of a place; `None` beyond the horizon.
    pub fn pixel_at(&self, place: &Point2<f64>) -> Option<Point2<f64>> {
        let inverse = self.plane_from_pixel.try_inverse()?;
        let h = inverse * place.to_homogeneous();
        let pixel = Point2::new(h.x / h.z, h.y / h.z);
        // The inverse has lost the sign; the way back shows on which side the pixel lies.
        self.place_at(&pixel).map(|_| pixel)
    }

    fn residual(&self, point: &ControlPoint, on: &[&ControlPoint]) -> Residual {
        let unknown = Vector2::repeat(f64::NAN);
        let in_plane = |matrix: &Matrix3<f64>| {
            mapped(matrix, &point.pixel).map_or(unknown, |place| place - point.place)
        };
        let others: Vec<_> = (on.iter().copied())
            .filter(|other| !std::ptr::eq(*other, point))
            .collect();
        let left_out = if point.enabled {
            solve_for(&others, self.kind).ok().map(|m| in_plane(&m))
        } else {
            None
        };
        Residual {
            in_plane: in_plane(&self.plane_from_pixel),
            in_pixels: self.pixel_at(&point.place).map(|seen| seen - point.pixel),
            left_out,
        }
    }

    /// The transform as a world file; `None` for a projective one, which those cannot hold.
    pub fn world_file(&self) -> Option<WorldFile> {
        if self.kind == TransformKind::Projective {
            return None;
        }
        let m = self.plane_from_pixel / self.plane_from_pixel[(2, 2)];
        let first = m * Vector3::new(0.5, 0.5, 1.0);
        Some(WorldFile {
            a: m[(0, 0)],
            d: m[(1, 0)],
            b: m[(0, 1)],
            e: m[(1, 1)],
            c: first.x,
            f: first.y,
        })
    }

    /// Georeference of the picture by the fit, if its plane is that of `system`.
    pub fn georeference(&self, system: ReferenceSystem) -> Georeference {
        match self.world_file() {
            Some(file) => Georeference::Projected { system, file },
            None => Georeference::Projective {
                system,
                plane_from_pixel: self.plane_from_pixel,
            },
        }
    }
}
