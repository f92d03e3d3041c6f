//! Search for a photo on a map: what it tells, what is known better, and how far around that is searched.

use serde::{Deserialize, Serialize};

use super::camera::focal_in_pixels;
use super::place::PhotoPlaceSource;
use super::pose::{PhotoPose, photo_pose};
use super::read::Photo;
use pilotage_base::frames::{Geodetic, GroundPoint, GroundRect, LocalFrame};
use pilotage_raster::camera::CameraModel;
use pilotage_vision::registration::{
    HeadingPrior, MapShape, PosePrior, StoredTurn, USUAL_MAP_DEVIATION, deviation_within,
    log_deviation_within,
};

/// Height that is assumed where nothing tells it: metres, and the share by which it may be exceeded.
const USUAL_HEIGHT: (f64, f64) = (100.0, 1.5);
/// Farthest ahead that the camera may be of what it shows, radians from straight down.
const FARTHEST_AHEAD: f64 = 1.0;
/// Standard deviation of roll and pitch, and of the slope of the ground, radians.
const TILT: f64 = 0.052;
/// Standard deviation of how the map is stretched.
const STRETCH: f64 = 0.02;

/// Settings of the search for a photo on a map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PhotoSearch {
    /// Place below the camera (its height does not count); what the photo says if `None`.
    pub at: Option<Geodetic>,
    /// Range of the search to each side of the place, metres.
    pub within: f64,
    /// Height above the ground, metres; what the photo says if `None`.
    pub height: Option<f64>,
    /// Share of the height by which it may be exceeded (0.2 is 20 %); as many times less is searched as well.
    pub height_within: f64,
    /// Heading of the picture's top, radians clockwise from north; what the photo says if `None`.
    pub heading: Option<f64>,
    /// Range of the search to each side of the heading, radians; π is all around.
    pub heading_within: f64,
    /// Angle by which the camera looks ahead of straight down, radians; what the photo says if `None`.
    pub ahead: Option<f64>,
    /// Focal length, pixels of the stored picture; what the photo says if `None`.
    pub focal: Option<f64>,
    /// Standard deviation of the map's own place per axis, metres.
    pub map_deviation: f64,
}

impl Default for PhotoSearch {
    fn default() -> Self {
        Self {
            at: None,
            within: 40.0,
            height: None,
            height_within: 0.2,
            heading: None,
            heading_within: 40_f64.to_radians(),
            ahead: None,
            focal: None,
            map_deviation: USUAL_MAP_DEVIATION,
        }
    }
}

impl PhotoSearch {
    /// The camera of a photo, which looks straight down; what was assumed of it goes to `assumed`, in words.
    pub fn camera(&self, photo: &Photo, assumed: &mut Vec<String>) -> CameraModel {
        let (focal, from) = match self.focal {
            Some(focal) => (focal, "as you said"),
            None => focal_in_pixels(photo),
        };
        assumed.push(format!("focal length {focal:.0} pixels, {from}"));
        CameraModel::of_focal(photo.width, photo.height, focal)
    }

    /// Prior of the pose of a photo before it is looked at, over a map that lies in `world` on the globe; what was
    /// assumed goes to `assumed`, in words. A photo of which no place is known is searched all over `ground`.
    ///
    /// # Errors
    /// A place that somebody states, over a map of which nobody knows where on the globe it lies: in words.
    pub fn prior(
        &self,
        photo: &Photo,
        world: Option<&LocalFrame>,
        ground: &GroundRect,
        assumed: &mut Vec<String>,
    ) -> Result<PosePrior, String> {
        let told = photo_pose(photo);
        let place = self.place(photo, world, assumed)?;
        let (height, height_within) = self.height(&told, assumed);
        let pitch = self.ahead.unwrap_or(told.pitch);
        let (position, within, anywhere_on) = if let Some(place) = place {
            (place, self.within, None)
        } else {
            let (width, length) = (ground.width(), ground.height());
            assumed.push(format!(
                "place anywhere on {width:.0} by {length:.0} m of the map"
            ));
            // Who looks ahead is not over what is seen.
            let ground = ground.grown(height * pitch.abs().min(FARTHEST_AHEAD).tan());
            let reach = 0.5 * ground.width().max(ground.height());
            (ground.center(), reach, Some(ground))
        };
        Ok(PosePrior {
            position,
            position_deviation: deviation_within(within.max(1.0)),
            anywhere_on,
            height,
            log_height_deviation: log_deviation_within(height_within),
            heading: self.heading(&told, assumed),
            roll: told.roll,
            pitch,
            tilt_deviation: TILT,
            slope_deviation: TILT,
            shape: MapShape::default(),
            shape_deviation: STRETCH,
            map_deviation: self.map_deviation,
        })
    }

    /// The place that is known, if one is.
    fn place(
        &self,
        photo: &Photo,
        world: Option<&LocalFrame>,
        assumed: &mut Vec<String>,
    ) -> Result<Option<GroundPoint>, String> {
        if self.at.is_some() && world.is_none() {
            let why = "the place is known by latitude and longitude, and the map does not tell where on the globe it lies";
            return Err(why.to_owned());
        }
        let of_photo = photo.place.map(|place| Geodetic {
            latitude: place.latitude,
            longitude: place.longitude,
            height: 0.0,
        });
        let Some((place, world)) = self.at.or(of_photo).zip(world) else {
            return Ok(None);
        };
        let by = match photo.placed_by {
            _ if self.at.is_some() => "as you said",
            PhotoPlaceSource::Photo => "as the photo says",
            PhotoPlaceSource::Table => "as the table beside it says",
        };
        assumed.push(format!("place {by}, within {:.0} m", self.within));
        Ok(Some(world.ground_from_geodetic(&place)))
    }

    fn height(&self, told: &PhotoPose, assumed: &mut Vec<String>) -> (f64, f64) {
        match (self.height, told.height.filter(|height| *height > 0.0)) {
            (Some(height), _) => {
                assumed.push(format!("height {height:.0} m as you said"));
                (height, self.height_within)
            }
            (None, Some(height)) => {
                assumed.push(format!(
                    "height {height:.0} m, which is counted from take-off"
                ));
                (height, self.height_within)
            }
            (None, None) => {
                let (height, share) = USUAL_HEIGHT;
                assumed.push(format!(
                    "height {height:.0} m give or take {:.0} %: nothing tells it",
                    100.0 * share
                ));
                USUAL_HEIGHT
            }
        }
    }

    fn heading(&self, told: &PhotoPose, assumed: &mut Vec<String>) -> HeadingPrior {
        let degrees = |angle: f64| angle.to_degrees().rem_euclid(360.0);
        assumed.push(match (self.heading, told.heading) {
            (Some(heading), _) => format!("heading {:.0}° as you said", degrees(heading)),
            (None, Some(heading)) => format!(
                "heading {:.0}°, pitch {:.0}° {}",
                degrees(heading),
                told.pitch.to_degrees(),
                told.told_by
            ),
            (None, None) => "any heading".to_owned(),
        });
        match self.heading.or(told.heading) {
            Some(heading) if self.heading_within < std::f64::consts::PI - 1e-9 => {
                HeadingPrior::Around {
                    heading,
                    deviation: deviation_within(self.heading_within),
                    stored: StoredTurn::None,
                }
            }
            _ => HeadingPrior::Unknown,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::place::PhotoPlace;
    use super::*;
    use pilotage_base::frames::Attitude;
    use pilotage_vision::registration::{limit_of, share_of};

    const GROUND: GroundRect = GroundRect {
        north: 300.0,
        south: -300.0,
        west: -500.0,
        east: 500.0,
    };

    fn photo() -> Photo {
        Photo {
            width: 1000,
            height: 562,
            place: Some(PhotoPlace {
                latitude: 47.001_f64.to_radians(),
                longitude: 8_f64.to_radians(),
                altitude: None,
            }),
            height_above_take_off: Some(120.0),
            is_gimbal_blank: true,
            aircraft: Some(Attitude {
                roll: 0.1,
                pitch: 0.1,
                yaw: 2.0,
            }),
            ..Photo::default()
        }
    }

    fn world() -> LocalFrame {
        LocalFrame::new(Geodetic::from_degrees(47.0, 8.0, 0.0))
    }

    #[test]
    fn a_photo_is_looked_for_where_it_says_and_what_was_assumed_is_said() {
        let mut assumed = Vec::new();
        let search = PhotoSearch::default();
        let prior = search
            .prior(&photo(), Some(&world()), &GROUND, &mut assumed)
            .unwrap();
        assert!((prior.position.north - 111.2).abs() < 0.2, "{prior:?}");
        assert!((limit_of(prior.position_deviation) - 40.0).abs() < 1e-9);
        assert_eq!(prior.height, 120.0);
        assert!((share_of(prior.log_height_deviation) - 0.2).abs() < 1e-9);
        assert_eq!((prior.roll, prior.pitch), (0.0, 0.0));
        let said = assumed.join("; ");
        for part in ["within 40 m", "120 m", "from take-off", "gimbal", "115°"] {
            assert!(said.contains(part), "{part}: {said}");
        }
    }

    #[test]
    fn what_is_known_better_counts_before_what_the_photo_says() {
        let mut assumed = Vec::new();
        let search = PhotoSearch {
            at: Some(Geodetic::from_degrees(47.0, 8.0, 0.0)),
            height: Some(90.0),
            heading: Some(1.0),
            ahead: Some(0.2),
            ..PhotoSearch::default()
        };
        let prior = search
            .prior(&photo(), Some(&world()), &GROUND, &mut assumed)
            .unwrap();
        assert!(prior.position.north.abs() < 1e-6);
        assert_eq!((prior.height, prior.pitch), (90.0, 0.2));
        // A map that is nowhere on the globe cannot have the place.
        let why = search.prior(&photo(), None, &GROUND, &mut Vec::new());
        assert!(why.unwrap_err().contains("globe"));
        let HeadingPrior::Around { heading, .. } = prior.heading else {
            panic!("{prior:?}");
        };
        assert_eq!(heading, 1.0);
        assert!(assumed.iter().all(|text| text.contains("as you said")));
    }

    #[test]
    fn a_photo_that_says_nothing_may_be_anywhere_with_any_heading() {
        let mut assumed = Vec::new();
        let bare = Photo {
            width: 1000,
            height: 562,
            ..Photo::default()
        };
        let search = PhotoSearch::default();
        let prior = search
            .prior(&bare, Some(&world()), &GROUND, &mut assumed)
            .unwrap();
        assert_eq!(prior.heading, HeadingPrior::Unknown);
        assert_eq!(prior.anywhere_on, Some(GROUND));
        assert!((limit_of(prior.position_deviation) - 500.0).abs() < 1e-9);
        assert!((share_of(prior.log_height_deviation) - 1.5).abs() < 1e-9);
        let said = assumed.join("; ");
        assert!(
            said.contains("any heading") && said.contains("anywhere on 1000 by 600 m"),
            "{said}"
        );
    }
}
