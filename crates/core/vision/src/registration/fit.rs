//! The pose that lays the matches where they were found.

use nalgebra::{Matrix2, Point2, SMatrix, SVector, Vector2};

use super::look::{FrameLook, MapPose};
use super::patches::PatchMatch;
use super::prior::PosePrior;
use pilotage_base::frames::{GroundPoint, wrap_pi};

/// Rounds of Gauss and Newton.
const ROUNDS: usize = 15;
/// Unknowns: north, east, down, roll, pitch, yaw, and the two of the map's shape.
pub const UNKNOWNS: usize = 8;
/// Steps of the central differences, in metres, radians and logarithms.
const STEPS: [f64; UNKNOWNS] = [1e-3, 1e-3, 1e-3, 1e-5, 1e-5, 1e-5, 1e-5, 1e-5];
/// Errors of matches are taken to be alike over this part of the picture's shorter side: relief and the
/// seams of an orthophoto move neighbours together.
const ALIKE: f64 = 0.3;
/// Standard deviation of a height's logarithm, or of a heading in radians, that are held: no match moves them.
const FIRMLY: f64 = 1e-6;
/// The least standard deviation of a match, pixels.
const LEAST_DEVIATION: f64 = 0.1;

/// A vector of the unknowns.
pub(super) type PoseVector = SVector<f64, UNKNOWNS>;
/// Their covariance or information.
type PoseMatrix = SMatrix<f64, UNKNOWNS, UNKNOWNS>;
/// Jacobian of a pixel by the unknowns.
type Jacobian = SMatrix<f64, 2, UNKNOWNS>;

/// A pose over the map with its covariance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseFit {
    /// Pose over the map and how the map is stretched.
    pub at: MapPose,
    /// Covariance of north, east, down (metres), roll, pitch, yaw (radians), and of the shape's two
    /// logarithms.
    pub covariance: PoseMatrix,
    /// Standard deviation of a match about the fit, pixels per axis.
    pub deviation: f64,
}

impl PoseFit {
    /// Place of the map in the middle of the picture and its covariance, m².
    pub fn centre(&self, look: &FrameLook<'_>) -> Option<(GroundPoint, Matrix2<f64>)> {
        let jacobian = differences(|step| {
            let place = look.centre(&moved(&self.at, step))?;
            Some(place.to_vector())
        })?;
        let covariance = jacobian * self.covariance * jacobian.transpose();
        Some((look.centre(&self.at)?, covariance))
    }
}

/// Tukey's weight of a residual `r` that counts as wrong beyond `limit`.
fn tukey(r: f64, limit: f64) -> f64 {
    let u = r / limit;
    if u < 1.0 { (1.0 - u * u).powi(2) } else { 0.0 }
}

pub(super) fn moved(at: &MapPose, step: &PoseVector) -> MapPose {
    let mut at = *at;
    at.pose.position_in_world += step.fixed_rows::<3>(0);
    at.pose.attitude.roll += step[3];
    at.pose.attitude.pitch += step[4];
    at.pose.attitude.yaw = wrap_pi(at.pose.attitude.yaw + step[5]);
    at.shape.along += step[6];
    at.shape.across += step[7];
    at
}

/// Central differences of a function of a step of the unknowns.
pub(super) fn differences(
    function: impl Fn(&PoseVector) -> Option<Vector2<f64>>,
) -> Option<Jacobian> {
    let mut jacobian = Jacobian::zeros();
    for (axis, step) in STEPS.into_iter().enumerate() {
        let at = |by: f64| {
            let mut shift = PoseVector::zeros();
            shift[axis] = by;
            function(&shift)
        };
        jacobian.set_column(axis, &((at(step)? - at(-step)?) / (2.0 * step)));
    }
    Some(jacobian)
}

/// Residual of a match in the picture, pixels: where its place on the map appears less where it was
/// seen.
pub(super) fn residual(look: &FrameLook<'_>, at: &MapPose, m: &PatchMatch) -> Option<Vector2<f64>> {
    Some(look.pixel(at, &m.ground)? - m.pixel)
}

/// Prior of roll, pitch, along and across, and of height and heading where these are held: index, deviation from its
/// mean, information.
fn held(look: &FrameLook<'_>, prior: &PosePrior, at: &MapPose) -> Vec<(usize, f64, f64)> {
    let attitude = at.pose.attitude;
    let tilt = prior.apparent_tilt_deviation().powi(-2);
    let shape = prior.shape_deviation.powi(-2);
    let held = FIRMLY.powi(-2);
    let height = look.ground_down - at.pose.position_in_world.z;
    // Down is less by as much as the height is more.
    let of_height = prior
        .holds_height()
        .then(|| (2, prior.height - height, held / (height * height)));
    let of_heading = prior
        .heading
        .held()
        .map(|heading| (5, wrap_pi(attitude.yaw - heading), held));
    let always = [
        (3, attitude.roll - prior.roll, tilt),
        (4, attitude.pitch - prior.pitch, tilt),
        (6, at.shape.along - prior.shape.along, shape),
        (7, at.shape.across - prior.shape.across, shape),
    ];
    let held = of_height.into_iter().chain(of_heading);
    always.into_iter().chain(held).collect()
}

/// Round of the fit: the normal equations of the matches at a pose, without the prior.
struct FitRound {
    /// `Σ w JᵀJ`.
    information: PoseMatrix,
    /// Of each match that counts: pixel and w Jᵀr.
    slopes: Vec<(Point2<f64>, PoseVector)>,
    weights: f64,
    squares: f64,
}

impl FitRound {
    fn new(look: &FrameLook<'_>, at: &MapPose, matches: &[PatchMatch], limit: f64) -> Option<Self> {
        let mut round = Self {
            information: PoseMatrix::zeros(),
            slopes: Vec::with_capacity(matches.len()),
            weights: 0.0,
            squares: 0.0,
        };
        for m in matches {
            let Some(r) = residual(look, at, m) else {
                continue;
            };
            let weight = tukey(r.norm(), limit);
            if weight == 0.0 {
                continue;
            }
            let jacobian = differences(|step| {
                let pixel = look.pixel(&moved(at, step), &m.ground)?;
                Some(pixel.coords)
            })?;
            round.information += weight * jacobian.transpose() * jacobian;
            round
                .slopes
                .push((m.pixel, weight * jacobian.transpose() * r));
            round.weights += weight;
            round.squares += weight * r.norm_squared();
        }
        (round.slopes.len() > UNKNOWNS / 2).then_some(round)
    }

    /// Variance of a match per axis, pixels².
    fn variance(&self) -> f64 {
        let degrees = (2.0 * self.weights - UNKNOWNS as f64).max(1.0);
        (self.squares / degrees).max(LEAST_DEVIATION.powi(2))
    }

    /// Sum of the products of slopes of matches within `range` pixels of each other, weighted by how
    /// near they are (Conley 1999, with Bartlett's kernel, which keeps the sum positive): the covariance
    /// of the gradient where errors of neighbours are alike.
    fn scatter(&self, range: f64) -> PoseMatrix {
        let near = |a: f64, b: f64| (1.0 - (a - b).abs() / range).max(0.0);
        let mut scatter = PoseMatrix::zeros();
        for (index, (a, slope_a)) in self.slopes.iter().enumerate() {
            scatter += slope_a * slope_a.transpose();
            for (b, slope_b) in &self.slopes[index + 1..] {
                let weight = near(a.x, b.x) * near(a.y, b.y);
                if weight > 0.0 {
                    let product = weight * slope_a * slope_b.transpose();
                    scatter += product + product.transpose();
                }
            }
        }
        scatter
    }
}

/// Fits pose and shape by iteratively weighted least squares, Tukey's weights with `limit` pixels, tilt
/// and shape held by the prior; `None` if the matches do not determine them.
pub(super) fn fit(
    look: &FrameLook<'_>,
    start: &MapPose,
    matches: &[PatchMatch],
    prior: &PosePrior,
    limit: f64,
) -> Option<PoseFit> {
    let mut at = *start;
    for _ in 0..ROUNDS {
        let round = FitRound::new(look, &at, matches, limit)?;
        let variance = round.variance();
        let mut information = round.information / variance;
        let mut slope: PoseVector = round.slopes.iter().map(|(_, s)| s / variance).sum();
        for (axis, off, weight) in held(look, prior, &at) {
            information[(axis, axis)] += weight;
            slope[axis] += weight * off;
        }
        let step = -information.cholesky()?.solve(&slope);
        at = moved(&at, &step);
        if step.fixed_rows::<3>(0).amax() < 1e-4 && step.fixed_rows::<5>(3).amax() < 1e-6 {
            break;
        }
    }
    let round = FitRound::new(look, &at, matches, limit)?;
    let variance = round.variance();
    let mut information = round.information / variance;
    let shorter = look.camera.width.min(look.camera.height) as f64;
    let mut scatter = round.scatter(ALIKE * shorter) / variance.powi(2);
    for (axis, _, weight) in held(look, prior, &at) {
        information[(axis, axis)] += weight;
        scatter[(axis, axis)] += weight;
    }
    let inverse = information.cholesky()?.inverse();
    Some(PoseFit {
        at,
        covariance: inverse * scatter * inverse,
        deviation: variance.sqrt(),
    })
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;

    use super::super::prior_for_tests::{GreyFrame, around, usual_prior};
    use super::super::shape::MapShape;
    use super::*;
    use pilotage_base::frames::{Attitude, Pose};
    use pilotage_raster::camera::CameraModel;

    #[test]
    fn a_height_and_a_heading_without_doubt_are_held_whatever_the_matches_say() {
        let frame = GreyFrame::new(CameraModel::pinhole(400, 300, 1.0));
        let look = frame.look();
        // The matches were seen from 100 m with heading 0.4.
        let truth = MapPose {
            pose: Pose {
                position_in_world: Point3::new(5.0, -7.0, -100.0),
                attitude: Attitude::level(0.4),
            },
            shape: MapShape::default(),
        };
        let pixels = (0..5).flat_map(|i| (0..4).map(move |j| (40 + 80 * i, 30 + 80 * j)));
        let matches: Vec<PatchMatch> = pixels
            .map(|(x, y)| {
                let pixel = Point2::new(f64::from(x), f64::from(y));
                let ground = look.ground(&truth, &pixel).unwrap();
                PatchMatch {
                    pixel,
                    ground,
                    expected: ground,
                    score: 1.0,
                }
            })
            .collect();
        let told = |log_height_deviation, deviation| {
            let prior = PosePrior {
                height: 103.0,
                log_height_deviation,
                heading: around(0.41, deviation),
                ..usual_prior()
            };
            let pose = fit(&look, &truth, &matches, &prior, 30.0).unwrap().at.pose;
            (-pose.position_in_world.z, pose.attitude.yaw)
        };
        let (height, heading) = told(0.05, 0.05);
        assert!((height - 100.0).abs() < 0.01 && (heading - 0.4).abs() < 1e-4);
        let (height, heading) = told(0.0, 0.0);
        assert!((height - 103.0).abs() < 0.01, "{height}");
        assert!((heading - 0.41).abs() < 1e-4, "{heading}");
    }
}
