//! Observations: what was measured, and what a filter makes of it.

use nalgebra::{
    Cholesky, DMatrix, DVector, Dyn, Matrix2, Matrix2x4, Matrix4, MatrixXx4, SMatrix, SVector,
    Vector2, dvector,
};

use super::JointReport;
use super::engine::{CorrectedStep, Engine, MeasurementModel};
use super::tilt::ByTilt;
use pilotage_estimation::filter::{FilterError, Gate, Verdict};

/// Something that was measured, by whatever aid.
pub struct Observation<'a> {
    /// Measured vector of m components.
    pub measured: DVector<f64>,
    /// Covariance of its noise, m × m.
    pub noise: DMatrix<f64>,
    /// Covariance by which it corrects, m × m, where it has errors in common with what was observed before: as much less
    /// is new in it.
    pub weakened: Option<DMatrix<f64>>,
    /// Expectation of it.
    pub model: MeasurementModel<'a>,
    /// Degrees of freedom of its normalized innovation squared: m, less what the measurement leaves open.
    pub degrees: usize,
    /// Part that the errors of a picture's pose have in it, if it was seen in one.
    pub in_picture: Option<PicturePart>,
}

/// Part that the errors of a picture's pose have in an observation of m components.
#[derive(Clone, Debug, PartialEq)]
pub struct PicturePart {
    /// Change of what is measured with the errors of roll, pitch, yaw (radians) and height (metres), true less assumed.
    pub by_pose: MatrixXx4<f64>,
    /// Covariance of the noise without them, m × m.
    pub own: DMatrix<f64>,
}

impl Observation<'static> {
    /// The place of the aircraft on the map (north, east, metres) as a picture tells it: `own` is its covariance without
    /// the errors of the picture's pose, `pose` that of these errors, and `by_pose` its change with them. The picture's yaw
    /// is the reading less the `believed` bias of the heading, radians.
    pub fn of_place(
        place: Vector2<f64>,
        own: &Matrix2<f64>,
        (by_pose, pose): (&Matrix2x4<f64>, &Matrix4<f64>),
        believed: f64,
    ) -> Self {
        let noise = own + by_pose * pose * by_pose.transpose();
        let by_heading = dvector![by_pose[(0, 2)], by_pose[(1, 2)]];
        let by_pose = MatrixXx4::from_fn(2, |i, j| by_pose[(i, j)]);
        let by_tilt = ByTilt::of(&by_pose);
        Self {
            measured: dvector![place.x, place.y],
            noise: DMatrix::from_column_slice(2, 2, noise.as_slice()),
            weakened: None,
            model: MeasurementModel::of_pose(move |seen| {
                let mut expected = dvector![seen.on_map.north, seen.on_map.east];
                by_tilt.add(&mut expected, seen);
                // A bias that is larger is a heading that is smaller.
                let bias = seen.heading_bias.unwrap_or(believed);
                expected.axpy(believed - bias, &by_heading, 1.0);
                Some(expected)
            }),
            degrees: 2,
            in_picture: Some(PicturePart {
                by_pose,
                own: DMatrix::from_column_slice(2, 2, own.as_slice()),
            }),
        }
    }
}

/// A normal distribution of `N` components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussianState<const N: usize> {
    pub mean: SVector<f64, N>,
    pub covariance: SMatrix<f64, N, N>,
}

/// Innovation of a measurement against what is expected, with its covariance.
pub struct GaussianInnovation {
    pub innovation: DVector<f64>,
    /// Innovation covariance.
    pub covariance: DMatrix<f64>,
    /// The part of it that is the measurement's noise.
    pub noise: DMatrix<f64>,
}

impl Observation<'_> {
    /// Innovation against what `engine` expects.
    pub fn innovation(&self, engine: &dyn Engine) -> Result<GaussianInnovation, FilterError> {
        let expected = engine.expect(&self.model, &self.noise)?;
        Ok(GaussianInnovation {
            innovation: &self.measured - expected.mean,
            covariance: expected.covariance,
            noise: self.noise.clone(),
        })
    }

    /// Verdict of `gate` on its innovation.
    pub fn verdict(
        &self,
        innovation: &GaussianInnovation,
        gate: Gate,
    ) -> Result<Verdict, FilterError> {
        Ok(gate.verdict(innovation.nis()?, self.degrees))
    }

    /// Corrects `engine` by it.
    pub fn correct(&self, engine: &mut dyn Engine) -> Result<CorrectedStep, FilterError> {
        let noise = self.weakened.as_ref().unwrap_or(&self.noise);
        engine.correct(&self.model, noise, &self.measured)
    }
}

impl GaussianInnovation {
    /// Normalized innovation squared.
    pub fn nis(&self) -> Result<f64, FilterError> {
        let root = self.root()?;
        Ok(root.solve(&self.innovation).dot(&self.innovation))
    }

    /// Logarithm of the innovation's density, without the factor of its dimension; as if the normalized
    /// innovation squared were at most `most`.
    pub fn log_likelihood(&self, most: f64) -> Result<f64, FilterError> {
        let log_volume: f64 = self.root()?.l().diagonal().iter().map(|d| d.ln()).sum();
        Ok(-0.5 * self.nis()?.min(most) - log_volume)
    }

    fn root(&self) -> Result<Cholesky<f64, Dyn>, FilterError> {
        let root = self.covariance.clone().cholesky();
        root.ok_or(FilterError::NotFinite {
            place: "innovation covariance",
        })
    }
}

impl JointReport {
    /// Report of the correction by an observation that a gate accepted.
    pub(super) fn of(verdict: &Verdict, step: &CorrectedStep, recovered: Option<f64>) -> Self {
        Self {
            nis: verdict.nis,
            degrees_of_freedom: verdict.dof,
            threshold: verdict.threshold,
            gain: step.gain.clone(),
            innovation: step.innovation.clone(),
            innovation_covariance: step.innovation_covariance.clone(),
            recovered,
        }
    }
}
