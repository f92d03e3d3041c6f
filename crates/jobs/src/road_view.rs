//! Roads that a picture of a camera shows, as a view that is looked for among all roads of a map.

use nalgebra::Point3;
use pilotage_core::camera::CameraModel;
use pilotage_core::frames::{Attitude, GroundPoint, GroundRect, Pose};
use pilotage_core::raster::Picture;
use pilotage_core::road::{COARSEST_SEEN, NorthUpPicture, RoadDetection, SEEN_GSD};
use pilotage_core::roads::lost::{RoadView, ViewCrossing, ViewPoint};

/// Least probability of a point of a road that counts.
const LEAST_PROBABILITY: f64 = 0.5;
/// Ground that is looked at, as far as so many heights from below the camera.
const FARTHEST_HEIGHTS: f64 = 2.0;
/// Most ground that a picture may show, square metres: 30 million pixels of what the network sees.
const MOST_GROUND: f64 = 7.5e6;

/// Roads that a `picture` shows of level ground `height` metres below its camera, by the network. Ahead is the heading of
/// the camera's carrier, whatever that is; its roll and pitch are those of `attitude`.
///
/// # Errors
/// A picture of which a pixel shows too much for a road, or which shows too much ground, in words.
pub fn road_view(
    camera: &CameraModel,
    attitude: Attitude,
    height: f64,
    picture: &Picture,
) -> Result<RoadView, String> {
    let pose = Pose {
        position_in_world: Point3::new(0.0, 0.0, -height),
        attitude: Attitude {
            yaw: 0.0,
            ..attitude
        },
    };
    let farthest = FARTHEST_HEIGHTS * height;
    let outline = camera.footprint_within(&pose, 0.0, farthest);
    bounded(&outline, height / camera.focal)?;
    let ground = NorthUpPicture::of(camera, &pose, 0.0, picture, SEEN_GSD, farthest);
    let Some(NorthUpPicture { window, pixels }) = ground else {
        return Ok(RoadView::default());
    };
    let seen = RoadDetection::Network.roads_seen(&pixels, SEEN_GSD);
    let mut crossings = seen.crossings;
    crossings.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    let place = |[x, y]: [f64; 2]| window.ground_at(x, y).to_vector();
    let points = seen.points.iter();
    let points = points.filter(|point| point.probability >= LEAST_PROBABILITY);
    let view = RoadView {
        points: points
            .map(|point| ViewPoint {
                place: place(point.pixel),
                direction: point.direction,
            })
            .collect(),
        crossings: (crossings.into_iter())
            .map(|crossing| ViewCrossing {
                place: place(crossing.pixel),
                directions: crossing.directions,
            })
            .collect(),
        outline: outline.iter().map(|corner| corner.to_vector()).collect(),
    };
    view.checked().map_err(|why| why.to_string())?;
    Ok(view)
}

/// Refuses a picture whose pixels show no roads, `pixel` metres each below the camera, or which shows too much ground.
fn bounded(outline: &[GroundPoint], pixel: f64) -> Result<(), String> {
    let is_seen = pixel <= COARSEST_SEEN;
    if !is_seen {
        return Err(format!(
            "at this height a pixel of the picture shows {pixel:.1} m, and roads are seen up to {COARSEST_SEEN} m"
        ));
    }
    let ground = GroundRect::around(outline.iter().copied());
    let area = ground.map_or(0.0, |ground| ground.width() * ground.height());
    if area > MOST_GROUND {
        return Err(format!(
            "at this height the picture shows ground of {:.0} km², and at most {:.1} km² are searched for roads",
            1e-6 * area,
            1e-6 * MOST_GROUND
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_of_too_much_ground_are_refused_in_words() {
        let square = |side: f64| GroundRect::centered(GroundPoint::default(), side, side).corners();
        assert_eq!(bounded(&square(2000.0), 0.5), Ok(()));
        let why = bounded(&square(2000.0), 2.7).unwrap_err();
        assert!(why.contains("a pixel of the picture shows 2.7 m"), "{why}");
        assert!(bounded(&square(2000.0), f64::INFINITY).is_err());
        let why = bounded(&square(4000.0), 0.5).unwrap_err();
        assert!(why.contains("ground of 16 km²"), "{why}");
    }
}
