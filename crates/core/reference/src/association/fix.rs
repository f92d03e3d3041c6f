//! The error of the believed position that a set of pairs tells of.

use nalgebra::{Matrix2, Matrix2x4, Matrix2x6, Matrix6, Vector2, Vector4, Vector6};

use super::AssociationProblem;
use super::candidates::Candidate;

/// Error of the believed position, as pairs tell it together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointFix {
    /// Error of the believed position, metres north and east: the true one less the believed one.
    pub offset: Vector2<f64>,
    /// Its covariance, square metres, by the pairs and what is known of the attitude, but not by the belief.
    pub covariance: Matrix2<f64>,
    /// Change of the offset with the errors of roll, pitch, yaw (radians) and height (metres), true less assumed: their
    /// part of its covariance is in common with whatever else is seen in the picture.
    pub by_pose: Matrix2x4<f64>,
    /// Sum of the squares of what is left, normalized.
    pub chi_square: f64,
    /// Degrees of freedom of that sum.
    pub degrees: usize,
    /// Errors of the assumed roll, pitch, yaw (radians) and height (metres): assumed less true.
    pub pose: Vector4<f64>,
    /// Covariance of `offset` and `pose` together.
    pub joint: Matrix6<f64>,
}

/// Least squares over the position's error (north, east) and the shared errors of roll, pitch, yaw and height.
pub struct SharedErrorFit {
    pub state: Vector6<f64>,
    pub covariance: Matrix6<f64>,
}

/// Change of a pair's offset with the state.
fn design(problem: &AssociationProblem<'_>, pair: &Candidate) -> Matrix2x6<f64> {
    let mut rows = Matrix2x6::zeros();
    rows.fixed_view_mut::<2, 2>(0, 0).fill_diagonal(1.0);
    let by_pose = -problem.observed[pair.observed].by_pose;
    rows.fixed_view_mut::<2, 4>(0, 2).copy_from(&by_pose);
    rows
}

impl SharedErrorFit {
    /// Fit to `pairs`, the believed position counted if `with_belief`; `None` where the errors have no inverse.
    pub fn to<'a>(
        problem: &AssociationProblem<'_>,
        pairs: impl Iterator<Item = &'a Candidate>,
        with_belief: bool,
    ) -> Option<Self> {
        let mut information = Matrix6::zeros();
        if with_belief {
            let known = problem.common.position.try_inverse()?;
            information.fixed_view_mut::<2, 2>(0, 0).copy_from(&known);
        }
        let known = problem.common.pose.try_inverse()?;
        information.fixed_view_mut::<4, 4>(2, 2).copy_from(&known);
        let mut right = Vector6::zeros();
        for pair in pairs {
            let rows = design(problem, pair);
            let weighed = rows.transpose() * pair.covariance.try_inverse()?;
            information += weighed * rows;
            right += weighed * pair.offset;
        }
        let covariance = information.cholesky()?.inverse();
        Some(Self {
            state: covariance * right,
            covariance,
        })
    }

    /// Part of a pair's offset that the fit does not explain.
    pub fn residual(&self, problem: &AssociationProblem<'_>, pair: &Candidate) -> Vector2<f64> {
        pair.offset - design(problem, pair) * self.state
    }

    /// Covariance of the offset that the fit predicts for a pair.
    pub fn spread(&self, problem: &AssociationProblem<'_>, pair: &Candidate) -> Matrix2<f64> {
        let rows = design(problem, pair);
        rows * self.covariance * rows.transpose()
    }

    /// Covariance of the position's error.
    pub fn position(&self) -> Matrix2<f64> {
        self.covariance.fixed_view::<2, 2>(0, 0).into()
    }
}

impl JointFix {
    /// The fix of `pairs`; `None` of no pair.
    pub fn of<'a>(
        problem: &AssociationProblem<'_>,
        pairs: impl Iterator<Item = &'a Candidate> + Clone,
    ) -> Option<Self> {
        let count = pairs.clone().count();
        let fit = (count > 0).then(|| SharedErrorFit::to(problem, pairs.clone(), false))??;
        let mut chi_square = 0.0;
        for pair in pairs {
            let residual = fit.residual(problem, pair);
            chi_square += (pair.covariance.try_inverse()? * residual).dot(&residual);
        }
        let shared = fit.state.fixed_rows::<4>(2);
        let known = problem.common.pose.try_inverse()?;
        chi_square += (known * shared).dot(&shared);
        Some(Self {
            by_pose: fit.covariance.fixed_view::<2, 4>(0, 2) * known,
            offset: fit.state.fixed_rows::<2>(0).into(),
            covariance: fit.position(),
            chi_square,
            degrees: 2 * count - 2,
            pose: fit.state.fixed_rows::<4>(2).into(),
            joint: fit.covariance,
        })
    }

    /// Distance of a place on the ground from where the assumed pose has it, with its covariance: metres north and
    /// east, of which `by_pose` is the change with the assumed roll, pitch, yaw and height.
    pub fn shift(&self, by_pose: &Matrix2x4<f64>) -> (Vector2<f64>, Matrix2<f64>) {
        let mut rows = Matrix2x6::identity();
        rows.fixed_view_mut::<2, 4>(0, 2).copy_from(&-by_pose);
        let shift = self.offset - by_pose * self.pose;
        (shift, rows * self.joint * rows.transpose())
    }
}
