//! A picture from the air beside the table: what it shows, and what of the table may be there.

use nalgebra::Vector2;

use super::mapping::SeenTiles;
use super::observed::{observed, possible};
use super::things::landmarks_seen;
use crate::GenericLandmark;
use crate::association::{
    Association, AssociationProblem, AssociationSettings, CommonError, ObservedLandmark, associate,
};
use pilotage_base::frames::{GroundPoint, Pose};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::raster::Picture;
use pilotage_vision::ground_class::{
    CLASS_GSD, CoverNetwork, classify_ground, ground_picture, ground_window,
};

/// Landmarks that one picture shows by an assumed pose over level ground.
pub struct PictureView<'a> {
    /// Landmarks seen, where they lie by the assumed pose.
    pub seen: Vec<GenericLandmark>,
    camera: &'a CameraModel,
    pose: &'a Pose,
    /// Height of the ground, metres below the world's origin.
    ground_down: f64,
}

impl<'a> PictureView<'a> {
    /// View of `picture`, which `camera` took, by the assumed `pose` over ground `ground_down` metres below the world's
    /// origin; `None` where it [is too wide](Self::is_too_wide).
    pub fn of(
        camera: &'a CameraModel,
        pose: &'a Pose,
        ground_down: f64,
        picture: &Picture,
        network: &CoverNetwork,
    ) -> Option<Self> {
        let (window, pixels) = ground_picture(camera, pose, ground_down, picture, CLASS_GSD)?;
        Some(Self {
            seen: landmarks_seen(&classify_ground(&window, &pixels, network)),
            camera,
            pose,
            ground_down,
        })
    }

    /// Whether such a picture shows no ground, or more than is looked at.
    pub fn is_too_wide(camera: &CameraModel, pose: &Pose, ground_down: f64) -> bool {
        ground_window(camera, pose, ground_down, CLASS_GSD).is_none()
    }

    /// Ground below the assumed position.
    pub fn below(&self) -> GroundPoint {
        GroundPoint::from(self.pose.position_in_world.xy().coords)
    }

    /// Corners of the ground in the picture, in order around it: metres north and east of the ground below.
    pub fn corners(&self) -> Vec<Vector2<f64>> {
        let below = self.below().to_vector();
        let corners = self.camera.footprint(self.pose, self.ground_down);
        corners.iter().map(|p| p.to_vector() - below).collect()
    }

    /// A landmark seen as the association takes it; `None` where the camera does not look there.
    pub fn observed(&self, landmark: &GenericLandmark) -> Option<ObservedLandmark> {
        observed(landmark, self.camera, self.pose, self.ground_down)
    }

    /// Landmarks of the table at most `reach` metres from the ground below.
    pub fn around(&self, known: &mut SeenTiles, reach: f64) -> Vec<GenericLandmark> {
        known.near(self.below(), reach)
    }

    /// Association of what was observed with the landmarks of the table `around`, whose pairs have their indices.
    pub fn associated(
        &self,
        observed: &[ObservedLandmark],
        around: &[GenericLandmark],
        common: CommonError,
    ) -> Association {
        let below = self.below();
        let possible: Vec<_> = around.iter().map(|l| possible(l, below)).collect();
        let problem = AssociationProblem {
            observed,
            possible: &possible,
            common,
            view: &self.corners(),
        };
        associate(&problem, &AssociationSettings::default())
    }
}
