//! Laying a single photo on a map.

use nalgebra::{Matrix2, Matrix6};
use serde::{Deserialize, Serialize};

use super::read::{Photo, read_photo};
use super::search::PhotoSearch;
use super::tabled::PhotoRow;
use pilotage_base::bytes::ByteSource;
use pilotage_base::frames::{GroundPoint, GroundRect, LocalFrame, Pose};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::Imagery;
use pilotage_raster::raster::{PYRAMID_LEVELS, Picture, Pyramid};
use pilotage_vision::registration::{
    FrameLook, MapPose, NotRegistered, PosePrior, Registration, RegistrationMethod, outline,
    register,
};

/// A photo that is ready to be laid on a map.
pub struct PhotoLook {
    /// Its pixels.
    pub picture: Picture,
    /// Attributes that its file tells.
    pub told: Photo,
    /// Its camera, which looks straight down when the body is level.
    pub camera: CameraModel,
    /// Prior of its pose.
    pub prior: PosePrior,
    /// Assumptions, and their sources, in words.
    pub assumed: Vec<String>,
    luminance: Pyramid,
}

/// Result of laying a photo on a map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PhotoAnswer {
    /// Assumptions, and their sources, in words.
    pub assumed: Vec<String>,
    /// Probability of the likeliest place by the whole frame alone, 0 to 1.
    pub probability: f64,
    /// Place of the photo on the map, or why it was not laid, in words.
    pub laid: Result<RegisteredPhoto, String>,
}

/// Photo laid on a map; places are metres north and east in the map's world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RegisteredPhoto {
    /// Pose over the map, by which the picture is drawn on it.
    pub at: MapPose,
    /// Turn of the stored picture, radians clockwise, a multiple of a quarter turn.
    pub stored_turn: f64,
    /// Pose of the camera, the slope of the ground told from its tilt.
    pub camera: Pose,
    /// Its covariance: north, east, down (metres), roll, pitch, yaw (radians).
    pub camera_covariance: Matrix6<f64>,
    /// Ground in the middle of the picture.
    pub centre: GroundPoint,
    /// Its covariance (north, east), m², the map's own error in it.
    pub centre_covariance: Matrix2<f64>,
    /// By what it was believed.
    pub laid_by: RegistrationMethod,
    /// Patches that agree, of those that could be found.
    pub patches: [usize; 2],
    /// Logarithm (base 10) of how likely it is wrong.
    pub log_doubt: f64,
    /// Ground at the corners of the picture, clockwise from its top left.
    pub outline: Vec<GroundPoint>,
}

/// Decoder of a photo's file, by its name and its bytes; the error says in words why it cannot.
pub type DecodePhoto = fn(&str, &[u8]) -> Result<Picture, String>;

impl PhotoLook {
    /// Reads a photo, and gathers of it what its file tells, what the `row` of a table beside it tells where the file says no
    /// place, and what is known better. The map lies in `world` on the globe; a photo of which no place is known is searched all over `ground`.
    ///
    /// # Errors
    /// The picture cannot be read or decoded, or a place is stated that the map cannot have: in words that name it.
    pub fn read(
        source: &dyn ByteSource,
        decode: DecodePhoto,
        row: Option<&PhotoRow>,
        search: &PhotoSearch,
        world: Option<&LocalFrame>,
        ground: &GroundRect,
    ) -> Result<Self, String> {
        let told = |cause: &dyn std::fmt::Display| format!("{}: {cause}", source.name());
        let bytes = source.read(0, source.length() as usize);
        let bytes = bytes.map_err(|cause| told(&cause))?;
        let picture = decode(source.name(), &bytes).map_err(|cause| told(&cause))?;
        // What is neither JPEG nor TIFF says nothing of itself.
        let mut photo = Photo {
            width: picture.width(),
            height: picture.height(),
            ..read_photo(source).unwrap_or_default()
        };
        if let Some(row) = row {
            row.tell(&mut photo);
        }
        let mut assumed = Vec::new();
        let camera = search.camera(&photo, &mut assumed);
        let prior = search.prior(&photo, world, ground, &mut assumed);
        let prior = prior.map_err(|cause| told(&cause))?;
        Ok(Self {
            luminance: Pyramid::new(picture.to_gray(), PYRAMID_LEVELS),
            picture,
            told: photo,
            camera,
            prior,
            assumed,
        })
    }

    /// The photo over `map`, whose ground is level at zero.
    pub fn over<'a>(&'a self, map: &'a dyn Imagery) -> FrameLook<'a> {
        FrameLook {
            camera: &self.camera,
            ground_down: 0.0,
            luminance: &self.luminance,
            map,
        }
    }

    /// Lays it on `map`.
    pub fn lay(&self, map: &dyn Imagery) -> PhotoAnswer {
        let look = self.over(map);
        let found = register(&look, &self.prior);
        let probability = found
            .as_ref()
            .map_or_else(NotRegistered::probability, |found| found.probability);
        PhotoAnswer {
            assumed: self.assumed.clone(),
            probability,
            laid: match &found {
                Ok(found) => Ok(RegisteredPhoto::of(&look, found)),
                Err(cause) => Err(cause.to_string()),
            },
        }
    }
}

impl RegisteredPhoto {
    fn of(look: &FrameLook<'_>, found: &Registration) -> Self {
        Self {
            at: found.fit.at,
            stored_turn: found.stored_turn,
            camera: found.camera.pose,
            camera_covariance: found.camera.covariance,
            centre: found.centre,
            centre_covariance: found.centre_covariance,
            laid_by: found.laid_by,
            patches: [found.matches.len(), found.tried],
            log_doubt: found.log_false_alarms,
            outline: outline(look, &found.fit.at, found.stored_turn),
        }
    }

    /// Ground straight below the camera.
    pub fn below(&self) -> GroundPoint {
        let position = self.camera.position_in_world;
        GroundPoint::new(position.x, position.y)
    }

    /// Height of the camera above the ground, metres.
    pub fn height(&self) -> f64 {
        -self.camera.position_in_world.z
    }

    /// Standard deviation of a part of the camera's pose, by its number in the covariance: metres and radians.
    pub fn camera_deviation(&self, part: usize) -> f64 {
        self.camera_covariance[(part, part)].max(0.0).sqrt()
    }

    /// Standard deviation per axis of the ground in the middle of the picture, metres.
    pub fn centre_deviation(&self) -> f64 {
        (0.5 * self.centre_covariance.trace().max(0.0)).sqrt()
    }
}
