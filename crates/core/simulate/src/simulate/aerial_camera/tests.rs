//! Labelled points lie in the photograph where the camera model projects them.

use nalgebra::{Point2, Point3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::{AerialCamera, AerialCameraSettings};
use pilotage_base::frames::units::degrees;
use pilotage_base::frames::{Attitude, GroundPoint, GroundRect, Pose};
use pilotage_raster::camera::{CameraModel, Distortion, Lens};
use pilotage_raster::imagery::{CachedImagery, Imagery, Window};
use pilotage_raster::raster::{Picture, Raster, Rgba};

/// Dark ground with a bright round dot every `spacing` metres; `radius` is two standard deviations
/// of its light.
struct Dots {
    spacing: f64,
    radius: f64,
}

impl Dots {
    /// The dots nearest to `p`.
    fn nearest(&self, p: &GroundPoint) -> GroundPoint {
        let round = |v: f64| (v / self.spacing).round() * self.spacing;
        GroundPoint::new(round(p.north), round(p.east))
    }
}

impl Imagery for Dots {
    fn name(&self) -> &'static str {
        "dots"
    }
    fn bounds(&self) -> GroundRect {
        GroundRect::centered(GroundPoint::new(0.0, 0.0), 1e5, 1e5)
    }
    fn native_gsd(&self) -> f64 {
        0.15
    }
    fn window(&self, window: &Window) -> Raster<Rgba> {
        Raster::from_fn(window.width, window.height, |c, r| {
            let p = window.ground_at(c as f64 + 0.5, r as f64 + 0.5);
            let beyond = p.distance(&self.nearest(&p)) / self.radius;
            let light = if beyond < 2.0 {
                (-2.0 * beyond * beyond).exp()
            } else {
                0.0
            };
            let v = 40.0 + 200.0 * light;
            [v as u8, v as u8, v as u8, 255]
        })
    }
}

fn pose(height: f64, roll: f64, pitch: f64, yaw: f64) -> Pose {
    Pose {
        position_in_world: Point3::new(813.3, -402.8, -height),
        attitude: Attitude {
            roll: degrees(roll),
            pitch: degrees(pitch),
            yaw: degrees(yaw),
        },
    }
}

/// Centre of light above the ground's level within `reach` pixels of `around`.
fn centroid(picture: &Picture, around: &Point2<f64>, reach: f64) -> Point2<f64> {
    let (mut sum, mut x, mut y) = (0.0, 0.0, 0.0);
    let near = |v: f64| (v - reach) as usize..(v + reach + 1.0) as usize;
    for row in near(around.y).start..near(around.y).end.min(picture.height()) {
        for column in near(around.x).start..near(around.x).end.min(picture.width()) {
            let p = Point2::new(column as f64 + 0.5, row as f64 + 0.5);
            if (p - around).norm() <= reach {
                let light = (f64::from(picture.get(column, row)[1]) - 45.0).max(0.0);
                sum += light;
                x += light * p.x;
                y += light * p.y;
            }
        }
    }
    Point2::new(x / sum, y / sum)
}

/// Takes a picture of dots and answers how many were checked and the furthest distance between
/// where one is and where the model projects it, pixels.
fn furthest(camera: &CameraModel, settings: AerialCameraSettings, pose: &Pose) -> (usize, f64) {
    let height = -pose.position_in_world.z;
    let pixel_on_ground = height / camera.focal;
    let dots = Dots {
        spacing: 60.0 * pixel_on_ground,
        radius: 3.0 * pixel_on_ground,
    };
    let mut random = ChaCha8Rng::seed_from_u64(4);
    let frame = AerialCamera::new(camera.clone(), settings).take(&dots, pose, 0.0, &mut random);
    let (mut count, mut worst) = (0, 0.0f64);
    for row in (30..camera.height).step_by(40) {
        for column in (30..camera.width).step_by(40) {
            let pixel = Point2::new(column as f64, row as f64);
            let Some(ground) = camera.ground_at(&frame.pose, &pixel, 0.0) else {
                continue;
            };
            let dot = dots.nearest(&ground);
            let dot = Point3::new(dot.north, dot.east, 0.0);
            let Some(expected) = camera.project(&frame.pose, &dot) else {
                continue;
            };
            if camera.in_picture(&expected, 20.0) {
                let found = centroid(&frame.picture, &expected, 12.0);
                worst = worst.max((found - expected).norm());
                count += 1;
            }
        }
    }
    (count, worst)
}

#[test]
fn labelled_points_lie_where_the_camera_model_projects_them() {
    let plain = CameraModel::pinhole(640, 480, degrees(60.0));
    let mut bent = plain.clone();
    bent.distortion = Distortion {
        k1: -0.12,
        k2: 0.03,
        p1: 0.001,
        p2: -0.0015,
        k3: 0.0,
    };
    let mut tilted = plain.clone();
    tilted.mount.pitch = degrees(15.0);
    let mut angular = plain.clone();
    angular.lens = Lens::Angular;
    let mut wide = CameraModel::pinhole(1280, 960, degrees(75.0));
    wide.principal = Point2::new(651.2, 470.9);
    let poses = [
        pose(122.0, 0.0, 0.0, 0.0),
        pose(122.0, 22.0, 4.0, 133.0),
        pose(305.0, -25.0, -6.0, 301.0),
        pose(777.0, 5.0, 12.0, 47.0),
    ];
    let poses_of_all = [&plain, &bent].map(|camera| (camera, &poses[..]));
    let poses_of_some = [&tilted, &angular, &wide].map(|camera| (camera, &poses[1..3]));
    for (camera, poses) in poses_of_all.into_iter().chain(poses_of_some) {
        for pose in poses {
            let (count, worst) = furthest(camera, AerialCameraSettings::ideal(), pose);
            assert!(count > 40, "{count} dots only");
            assert!(worst < 0.1, "{worst} px, {camera:?}, {pose:?}");
        }
    }
}

#[test]
fn they_still_do_in_a_shaking_noisy_compressed_picture() {
    let camera = CameraModel::pinhole(640, 480, degrees(60.0));
    let (count, worst) = furthest(
        &camera,
        AerialCameraSettings::default(),
        &pose(122.0, 18.0, 3.0, 210.0),
    );
    assert!(count > 40 && worst < 0.25, "{count} dots, {worst} px");
}

#[test]
fn the_mount_shakes_by_the_given_angle() {
    let camera = AerialCamera::new(
        CameraModel::pinhole(16, 12, degrees(60.0)),
        AerialCameraSettings::default(),
    );
    let dots = Dots {
        spacing: 50.0,
        radius: 3.0,
    };
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let level = pose(100.0, 0.0, 0.0, 0.0);
    let squares: f64 = (0..300)
        .map(|_| {
            let a = camera.take(&dots, &level, 0.0, &mut random).pose.attitude;
            (a.roll * a.roll + a.pitch * a.pitch + a.yaw * a.yaw) / 3.0
        })
        .sum();
    let sd = (squares / 300.0).sqrt().to_degrees();
    assert!((sd - 1.0).abs() < 0.1, "{sd}");
}

#[test]
fn the_same_seed_takes_the_same_picture_from_the_source_and_from_the_cache() {
    let camera = AerialCamera::new(
        CameraModel::pinhole(160, 120, degrees(60.0)),
        AerialCameraSettings::default(),
    );
    let dots = || Dots {
        spacing: 30.0,
        radius: 4.0,
    };
    let cached = CachedImagery::new(std::sync::Arc::new(dots()), 4);
    let take = |imagery: &dyn Imagery| {
        let mut random = ChaCha8Rng::seed_from_u64(9);
        camera.take(imagery, &pose(150.0, 10.0, 2.0, 80.0), 0.0, &mut random)
    };
    let plain = take(&dots());
    assert_eq!(take(&cached), plain);
    assert_eq!(take(&cached), plain);
    assert!(plain.encoded.is_some());
}

#[test]
fn over_the_horizon_there_is_haze_and_no_panic() {
    let camera = AerialCamera::new(
        CameraModel::pinhole(64, 48, degrees(60.0)),
        AerialCameraSettings::ideal(),
    );
    let dots = Dots {
        spacing: 30.0,
        radius: 4.0,
    };
    let mut random = ChaCha8Rng::seed_from_u64(9);
    for pose in [
        pose(100.0, 0.0, 80.0, 0.0),
        pose(100.0, 180.0, 0.0, 0.0),
        pose(-5.0, 0.0, 0.0, 0.0),
        pose(f64::NAN, 0.0, f64::NAN, 0.0),
    ] {
        let frame = camera.take(&dots, &pose, 0.0, &mut random);
        assert_eq!(frame.picture.get(32, 0), [168, 178, 188]);
    }
}
