//! Looks for a landmark of the map in a camera picture that was taken a few metres from where the pose says, on
//! another day than the map.
//!
//! `cargo run -p pilotage-core --example 03_find_a_landmark`

use std::{error::Error, sync::Arc};

use nalgebra::{Matrix2, Point3};
use pilotage_core::frames::{Attitude, GroundPoint, Pose};
use pilotage_core::landmark::{
    Detector, FrameView, SearchRequest, Sighting, TemplateDetector, TemplateSettings,
};
use pilotage_core::raster::{PYRAMID_LEVELS, Pyramid};
use pilotage_core::simulate::scenery::Day;
use pilotage_core::simulate::{AerialCamera, AerialCameraSettings, Scenario, frame_random};

/// Error of the place where the camera is believed to be: north and east, metres.
const WRONG_BY: [f64; 2] = [4.0, -3.0];
/// Height above ground, metres.
const HEIGHT: f64 = 122.0;

fn main() -> Result<(), Box<dyn Error>> {
    let map = Scenario::map();
    let scenario = Scenario::named("distinct-400ft-calm").ok_or("no such scenario")?;
    let mission = scenario.mission_over(&map);
    let landmark = mission.landmarks.first().ok_or("no landmarks")?;

    // A picture from above the landmark, heading 30°, in another season; the mount shakes by 1°.
    let camera = AerialCamera::new(Scenario::camera(), AerialCameraSettings::default());
    let at = |north: f64, east: f64| Pose {
        position_in_world: Point3::new(north, east, -HEIGHT),
        attitude: Attitude::level(30_f64.to_radians()),
    };
    let middle = landmark.reference;
    let today = map.on_day(Day::other_day());
    let mut random = frame_random(1, 0);
    let frame = camera.take(&today, &at(middle.north, middle.east), 0.0, &mut random);

    // What the filter believes: a pose that is off, known to 5 m on each axis.
    let luminance = Pyramid::new(frame.picture.to_gray(), PYRAMID_LEVELS);
    let view = FrameView {
        camera: camera.model(),
        pose: at(middle.north + WRONG_BY[0], middle.east + WRONG_BY[1]),
        ground_down: 0.0,
        luminance: &luminance,
    };
    let request = SearchRequest {
        landmark,
        displacement_covariance: Matrix2::identity() * 25.0,
        turn_deviation: 1_f64.to_radians(),
        log_scale_deviation: 0.02,
    };
    let mut detector = TemplateDetector::new(Arc::new(map), TemplateSettings::default());
    let found = match detector.detect(&view, &request) {
        Sighting::Found(found) => found,
        Sighting::Refused(why, _) => return Err(format!("refused: {}", why.reason()).into()),
    };

    // Somebody who believes to be farther north sees it farther north.
    let expected = GroundPoint::new(middle.north + WRONG_BY[0], middle.east + WRONG_BY[1]);
    let off = found.ground.to_vector() - middle.to_vector();
    let (name, north, east) = (&landmark.name, off.x, off.y);
    println!("{name}: {north:+.2} m north, {east:+.2} m east of its place on the map");
    let (score, second) = (found.score, found.second_score);
    println!("score {score:.3}, {second:.3} elsewhere");
    let error = found.ground.distance(&expected);
    println!("that is {error:.2} m from what the wrong pose explains");
    if error > 1.5 {
        return Err("the place should be told to 1.5 m".into());
    }
    Ok(())
}
