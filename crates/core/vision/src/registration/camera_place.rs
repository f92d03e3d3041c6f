//! The camera's tilt told from the slope of the ground.

use nalgebra::{Matrix2, Matrix6, SMatrix};

use super::fit::{PoseFit, UNKNOWNS, differences, moved};
use super::look::{FrameLook, MapPose};
use super::prior::PosePrior;
use pilotage_base::frames::Pose;

/// Place of the camera itself: the pose without what of its tilt is the ground's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraPlace {
    /// Pose of the body; north and east on the map.
    pub pose: Pose,
    /// Covariance of north, east, down (metres), roll, pitch, yaw (radians).
    pub covariance: Matrix6<f64>,
    /// Change of north and east with the roll and the pitch that were assumed before the picture was seen, metres per
    /// radian: the middle of the picture stays, and so does as much of the tilt as the picture told.
    pub by_tilt: Matrix2<f64>,
}

impl PoseFit {
    /// Divides the tilt between the camera and the slope of the ground as their variances have it, with
    /// the middle of the picture and the height staying where they are.
    ///
    /// With the apparent tilt a = t + s, t ~ N(t₀, σ²), s ~ N(0, ς²): t | a has the mean
    /// t₀ + κ (a - t₀) and the variance (1 - κ) σ², κ = σ² / (σ² + ς²).
    pub fn camera(&self, look: &FrameLook<'_>, prior: &PosePrior) -> Option<CameraPlace> {
        let share = prior.share_of_tilt();
        let divided = |at: &MapPose, roll: f64, pitch: f64| -> Option<MapPose> {
            let mut at = *at;
            let middle = look.centre(&at)?.to_vector();
            let attitude = &mut at.pose.attitude;
            attitude.roll = prior.roll + share * (attitude.roll - prior.roll) + roll;
            attitude.pitch = prior.pitch + share * (attitude.pitch - prior.pitch) + pitch;
            let back = middle - look.centre(&at)?.to_vector();
            at.pose.position_in_world.x += back.x;
            at.pose.position_in_world.y += back.y;
            Some(at)
        };
        let at = divided(&self.at, 0.0, 0.0)?;
        // How north and east move with the unknowns, and with the camera's own tilt.
        let position = |at: Option<MapPose>| Some(at?.pose.position_in_world.xy().coords);
        let by_fit = differences(|step| position(divided(&moved(&self.at, step), 0.0, 0.0)))?;
        let by_tilt = differences(|step| position(divided(&self.at, step[3], step[4])))?;
        let mut jacobian = SMatrix::<f64, 6, UNKNOWNS>::identity();
        jacobian
            .fixed_view_mut::<2, UNKNOWNS>(0, 0)
            .copy_from(&by_fit);
        jacobian[(3, 3)] = share;
        jacobian[(4, 4)] = share;
        let mut own = SMatrix::<f64, 6, 2>::zeros();
        let by_tilt = by_tilt.fixed_view::<2, 2>(0, 3).into_owned();
        own.fixed_view_mut::<2, 2>(0, 0).copy_from(&by_tilt);
        own[(3, 0)] = 1.0;
        own[(4, 1)] = 1.0;
        // The apparent tilt follows its prior mean by as much as the picture left of its variance.
        let all = prior.apparent_tilt_deviation().powi(2);
        let followed = |axis: usize| {
            let told = 1.0 - self.covariance[(axis, axis)] / all;
            1.0 - share * told.clamp(0.0, 1.0)
        };
        let by_tilt = by_tilt * Matrix2::new(followed(3), 0.0, 0.0, followed(4));
        let left = (1.0 - share) * prior.tilt_deviation.powi(2);
        Some(CameraPlace {
            pose: at.pose,
            covariance: jacobian * self.covariance * jacobian.transpose()
                + left * own * own.transpose(),
            by_tilt,
        })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Point3, Vector2};
    use pilotage_base::frames::Attitude;
    use pilotage_raster::camera::CameraModel;

    use super::super::prior::HeadingPrior;
    use super::super::prior_for_tests::{GreyFrame, usual_prior};
    use super::super::shape::MapShape;
    use super::*;

    /// Prior of a camera 120 m up with this roll and pitch.
    fn prior(roll: f64, pitch: f64) -> PosePrior {
        PosePrior {
            height: 120.0,
            heading: HeadingPrior::Unknown,
            roll,
            pitch,
            tilt_deviation: 0.08,
            shape_deviation: 0.01,
            ..usual_prior()
        }
    }

    #[test]
    fn a_camera_moves_with_the_tilt_that_was_assumed_as_far_as_the_picture_did_not_tell_it() {
        let frame = GreyFrame::new(CameraModel::pinhole(400, 300, 1.0));
        let look = frame.look();
        let at = MapPose {
            pose: Pose {
                position_in_world: Point3::new(5.0, -7.0, -120.0),
                attitude: Attitude {
                    roll: 0.03,
                    pitch: 0.12,
                    yaw: 0.7,
                },
            },
            shape: MapShape::default(),
        };
        let assumed = prior(0.01, 0.02);
        let all = assumed.apparent_tilt_deviation().powi(2);
        for told in [0.0, 0.4, 0.95] {
            let mut covariance = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::identity() * 1e-4;
            covariance[(3, 3)] = (1.0 - told) * all;
            covariance[(4, 4)] = (1.0 - told) * all;
            let fit = PoseFit {
                at,
                covariance,
                deviation: 1.0,
            };
            let place = fit.camera(&look, &assumed).unwrap();
            let step = Vector2::new(1e-4, -2e-4);
            // The fit of a prior that is moved is moved by what the picture left, about the same middle.
            let mut moved = fit;
            moved.at.pose.attitude.roll += (1.0 - told) * step.x;
            moved.at.pose.attitude.pitch += (1.0 - told) * step.y;
            let back =
                look.centre(&at).unwrap().to_vector() - look.centre(&moved.at).unwrap().to_vector();
            moved.at.pose.position_in_world.x += back.x;
            moved.at.pose.position_in_world.y += back.y;
            let elsewhere = prior(0.01 + step.x, 0.02 + step.y);
            let other = moved.camera(&look, &elsewhere).unwrap();
            let went = (other.pose.position_in_world - place.pose.position_in_world).xy();
            let off = (went - place.by_tilt * step).norm();
            assert!(off < 0.01 * went.norm(), "{told}: {off} of {went}");
        }
    }
}
