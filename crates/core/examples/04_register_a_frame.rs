//! Registers a whole camera frame on the map, without landmarks and without a compass: where the camera was and
//! how it was turned, out of a square of 200 m.
//!
//! `cargo run -p pilotage-core --example 04_register_a_frame`

use std::error::Error;

use nalgebra::Point3;
use pilotage_core::frames::{Attitude, GroundPoint, Pose, wrap_pi};
use pilotage_core::imagery::CachedImagery;
use pilotage_core::raster::{PYRAMID_LEVELS, Pyramid};
use pilotage_core::registration::{
    FrameLook, HeadingPrior, MapShape, PosePrior, deviation_within, log_deviation_within, register,
};
use pilotage_core::simulate::{AerialCamera, AerialCameraSettings, Scenario, frame_random};

fn main() -> Result<(), Box<dyn Error>> {
    let map = CachedImagery::new(std::sync::Arc::new(Scenario::map()), 64);

    // From 122 m, heading 215°, banked by 3°.
    let camera = AerialCamera::new(Scenario::camera(), AerialCameraSettings::default());
    let pose = Pose {
        position_in_world: Point3::new(180.0, -140.0, -122.0),
        attitude: Attitude {
            roll: 3_f64.to_radians(),
            pitch: -1_f64.to_radians(),
            yaw: 215_f64.to_radians(),
        },
    };
    let frame = camera.take(&map, &pose, 0.0, &mut frame_random(5, 0));

    // What is known before: the place to 100 m on either axis, the height to 10 %, nothing of the heading.
    let prior = PosePrior {
        position: GroundPoint::new(130.0, -80.0),
        position_deviation: deviation_within(100.0),
        anywhere_on: None,
        height: 118.0,
        log_height_deviation: log_deviation_within(0.1),
        heading: HeadingPrior::Unknown,
        roll: 0.0,
        pitch: 0.0,
        tilt_deviation: 2_f64.to_radians(),
        slope_deviation: 0.002,
        shape: MapShape::default(),
        shape_deviation: 0.002,
        map_deviation: 0.1,
    };
    let look = FrameLook {
        camera: camera.model(),
        ground_down: 0.0,
        luminance: &Pyramid::new(frame.picture.to_gray(), PYRAMID_LEVELS),
        map: &map,
    };
    let found = register(&look, &prior).map_err(|why| why.to_string())?;

    // The mount shook: the frame knows from where it was really taken.
    let (truth, told) = (frame.pose, found.camera.pose);
    let error = told.position_in_world - truth.position_in_world;
    let turned = wrap_pi(told.attitude.yaw - truth.attitude.yaw).to_degrees();
    let sigma = found.camera.covariance.diagonal().map(f64::sqrt);
    println!("{} of {} patches agree", found.matches.len(), found.tried);
    println!("north {:+.2} m (sigma {:.2} m)", error.x, sigma[0]);
    println!("east {:+.2} m (sigma {:.2} m)", error.y, sigma[1]);
    println!("down {:+.2} m (sigma {:.2} m)", error.z, sigma[2]);
    println!(
        "heading {turned:+.2}° (sigma {:.2}°)",
        sigma[5].to_degrees()
    );
    if error.norm() > 3.0 || turned.abs() > 1.0 {
        return Err("the pose should be told to 3 m and 1°".into());
    }
    Ok(())
}
