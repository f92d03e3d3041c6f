//! Positions as the pictures of a run told them, apart from what the filter knew before.

use nalgebra::{Matrix2, Vector2};

use super::{Estimate, Run, StepReport};
use crate::instruments::PositionFix;
use pilotage_base::frames::GroundPoint;

/// Share of what is known afterwards that a picture has to add in every direction to be a position.
const LEAST_ADDED: f64 = 1e-3;

/// A position for every frame that corrected `run`, in order of time.
///
/// Information adds up: what a measurement of the position brings is P₊⁻¹ - P₋⁻¹ of the position's marginal
/// covariances, exactly so for a linear one, whatever else the state holds, since adding to the position's block of
/// the information matrix adds as much to its Schur complement. Frames that tell the place along one direction
/// alone, as one landmark far away does, are left out.
pub fn position_fixes(run: &Run) -> Vec<PositionFix> {
    run.steps.iter().filter_map(fix).collect()
}

fn fix(step: &StepReport) -> Option<PositionFix> {
    step.frame.as_ref()?.joint.as_ref()?;
    let (before, after) = (known(&step.predicted)?, known(&step.after)?);
    let added = after.0 - before.0;
    let least = added.symmetric_eigenvalues().min();
    if least < LEAST_ADDED * after.0.symmetric_eigenvalues().max() {
        return None;
    }
    let covariance = added.try_inverse()?;
    let place = covariance * (after.1 - before.1);
    Some(PositionFix {
        time: step.time,
        position: GroundPoint::new(place.x, place.y),
        covariance,
    })
}

/// Information about the position (north, east): its matrix, 1/m², and that times the mean, 1/m.
fn known(estimate: &Estimate) -> Option<(Matrix2<f64>, Vector2<f64>)> {
    let information = estimate.position_covariance().try_inverse()?;
    Some((information, information * estimate.position().to_vector()))
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector, Matrix4, SMatrix, Vector4};

    use super::*;

    fn estimate(mean: &Vector4<f64>, covariance: &Matrix4<f64>) -> Estimate {
        Estimate {
            mean: DVector::from_column_slice(mean.as_slice()),
            covariance: DMatrix::from_column_slice(4, 4, covariance.as_slice()),
        }
    }

    #[test]
    fn what_a_measured_position_said_is_found_again_in_what_it_changed() {
        let root = Matrix4::new(
            3.0, 0.2, 0.1, 0.0, 0.5, 4.0, 0.3, 0.2, 0.4, 0.1, 1.0, 0.2, 0.3, 0.6, 0.1, 1.5,
        );
        let prior = root * root.transpose();
        let mean = Vector4::new(100.0, -50.0, 3.0, -1.0);
        let noise = Matrix2::new(2.0, 0.7, 0.7, 5.0);
        let seen = Vector2::new(104.0, -47.0);
        let model = SMatrix::<f64, 2, 4>::identity();
        let innovation = model * prior * model.transpose() + noise;
        let gain = prior * model.transpose() * innovation.try_inverse().unwrap();
        let mean_after = mean + gain * (seen - model * mean);
        let after = (Matrix4::identity() - gain * model) * prior;
        let (before, after) = (
            known(&estimate(&mean, &prior)).unwrap(),
            known(&estimate(&mean_after, &after)).unwrap(),
        );
        let covariance = (after.0 - before.0).try_inverse().unwrap();
        assert!((covariance - noise).norm() < 1e-9, "{covariance}");
        assert!((covariance * (after.1 - before.1) - seen).norm() < 1e-8);
    }
}
