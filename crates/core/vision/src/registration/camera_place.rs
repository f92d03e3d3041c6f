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
    /// Change of north and east with the camera's roll and pitch where the middle of the picture stays, metres per radian.
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
        let left = (1.0 - share) * prior.tilt_deviation.powi(2);
        Some(CameraPlace {
            pose: at.pose,
            covariance: jacobian * self.covariance * jacobian.transpose()
                + left * own * own.transpose(),
            by_tilt,
        })
    }
}
