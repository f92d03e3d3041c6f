//! The camera against the regression pixels of the method notes, and its inverses.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Point2, Point3, Vector3};
use proptest::prelude::*;

use super::{CameraModel, Distortion, Lens, Mount};
use pilotage_base::frames::units::degrees;
use pilotage_base::frames::{Attitude, GroundPoint, Pose};

fn camera() -> CameraModel {
    CameraModel::pinhole(640, 480, degrees(60.0))
}

/// The thesis writes x east, y south, z down and degrees; feet count as the unit of the world here,
/// because the printed λ is a number of that unit too.
fn thesis_point([east, south, down]: [f64; 3]) -> Point3<f64> {
    Point3::new(-south, east, down)
}

fn thesis_pose([east, south, height]: [f64; 3], [roll, pitch, yaw]: [f64; 3]) -> Pose {
    Pose {
        position_in_world: Point3::new(-south, east, -height),
        attitude: Attitude {
            roll: degrees(roll),
            pitch: degrees(pitch),
            yaw: degrees(yaw),
        },
    }
}

fn level(height: f64) -> Pose {
    thesis_pose([0.0, 0.0, height], [0.0; 3])
}

/// Landmark, position, attitude, λ, pixel of the printed chain, pixel of the pinhole.
type Vector = ([f64; 3], [f64; 3], [f64; 3], f64, [f64; 2], [f64; 2]);

/// The pixels computed beside the thesis' equations 32-46, in feet.
#[rustfmt::skip]
const VECTORS: [Vector; 5] = [
    ([200.0, 0.0, 0.0], [0.0, 0.0, 1000.0], [0.0, 0.0, 0.0], 100.0, [342.222, 240.0], [430.851, 240.0]),
    ([0.0, -200.0, 0.0], [0.0, 0.0, 1000.0], [0.0, 0.0, 0.0], 356.6055, [320.0, 129.149], [320.0, 129.149]),
    ([5100.0, 2850.0, 0.0], [5000.0, 3000.0, 1000.0], [10.0, 5.0, 50.0], 356.6055, [389.191, 193.115], [389.370, 192.994]),
    ([5100.0, 2850.0, -40.0], [5000.0, 3000.0, 1000.0], [10.0, 5.0, 50.0], 356.6055, [389.597, 188.052], [388.217, 189.082]),
    ([-150.0, 120.0, 0.0], [0.0, 0.0, 400.0], [-15.0, 3.0, 307.0], 232.3302, [-291.938, 182.691], [-142.531, 196.683]),
];

#[test]
fn the_pinhole_gives_the_pixels_of_the_corrected_chain() {
    for (landmark, position, attitude, _, _, expected) in VECTORS {
        let pose = thesis_pose(position, attitude);
        let pixel = camera().project(&pose, &thesis_point(landmark)).unwrap();
        assert!(
            (pixel - Point2::from(expected)).norm() < 1e-3,
            "{pixel} {expected:?}"
        );
    }
}

#[test]
fn the_printed_model_gives_the_pixels_of_the_printed_equations() {
    for (landmark, position, attitude, lambda, expected, _) in VECTORS {
        let mut camera = camera();
        camera.lens = Lens::Lambda { lambda };
        let pose = thesis_pose(position, attitude);
        let pixel = camera.project(&pose, &thesis_point(landmark)).unwrap();
        assert!(
            (pixel - Point2::from(expected)).norm() < 1.5e-3,
            "{pixel} {expected:?}"
        );
    }
}

#[test]
fn the_printed_model_refuses_points_nearer_than_lambda() {
    let mut camera = camera();
    camera.lens = Lens::Lambda { lambda: 500.0 };
    assert_eq!(camera.project(&level(400.0), &Point3::origin()), None);
}

#[test]
fn the_angular_model_gives_the_pixel_of_appendix_a() {
    let mut camera = camera();
    camera.lens = Lens::Angular;
    let pose = thesis_pose([5000.0, 3000.0, 1000.0], [10.0, 5.0, 50.0]);
    let pixel = camera
        .project(&pose, &thesis_point([5100.0, 2850.0, 0.0]))
        .unwrap();
    assert!(
        (pixel - Point2::new(396.096, 190.309)).norm() < 1.5e-3,
        "{pixel}"
    );
}

#[test]
fn the_angular_model_meets_the_pinhole_in_the_middle_of_each_edge() {
    let mut angular = camera();
    angular.lens = Lens::Angular;
    for pixel in [Point2::new(640.0, 240.0), Point2::new(320.0, 0.0)] {
        let ray = camera().ray_in_camera(&pixel);
        assert!((angular.pixel_from_camera(&ray).unwrap() - pixel).norm() < 1e-9);
    }
}

#[test]
fn a_landmark_north_of_the_aircraft_appears_above_the_centre() {
    let pixel = camera()
        .project(&level(300.0), &Point3::new(50.0, 0.0, 0.0))
        .unwrap();
    assert!((pixel.x - 320.0).abs() < 1e-9 && pixel.y < 240.0, "{pixel}");
}

#[test]
fn a_right_bank_moves_the_nadir_point_to_the_right() {
    let banked = thesis_pose([0.0, 0.0, 300.0], [20.0, 0.0, 130.0]);
    let pixel = camera().project(&banked, &Point3::origin()).unwrap();
    assert!(pixel.x > 330.0 && (pixel.y - 240.0).abs() < 1e-9, "{pixel}");
}

#[test]
fn a_camera_tilted_forward_centres_what_lies_ahead() {
    let mut camera = camera();
    camera.mount.pitch = degrees(35.0);
    let pose = thesis_pose([0.0, 0.0, 300.0], [0.0, 0.0, 90.0]);
    let ahead = Point3::new(0.0, 300.0 * degrees(35.0).tan(), 0.0);
    let pixel = camera.project(&pose, &ahead).unwrap();
    assert!((pixel - camera.principal).norm() < 1e-9, "{pixel}");
}

#[test]
fn what_lies_behind_the_lens_or_is_not_a_number_has_no_pixel() {
    let pose = thesis_pose([0.0, 0.0, 300.0], [0.0, 80.0, 0.0]);
    assert_eq!(
        camera().project(&pose, &Point3::new(-5000.0, 0.0, 0.0)),
        None
    );
    assert_eq!(
        camera().project(&pose, &Point3::new(f64::NAN, 0.0, 0.0)),
        None
    );
    let lost = thesis_pose([f64::NAN, 0.0, 300.0], [0.0; 3]);
    assert_eq!(camera().project(&lost, &Point3::origin()), None);
    assert_eq!(
        camera().ground_at(&lost, &Point2::new(f64::NAN, 1.0), 0.0),
        None
    );
    assert_eq!(
        camera().ground_at(&pose, &Point2::new(320.0, 0.0), 0.0),
        None
    );
    assert!(camera().footprint(&lost, f64::NAN).is_empty());
}

#[test]
fn a_far_point_does_not_fold_back_into_a_barrel_distorted_picture() {
    let mut camera = camera();
    camera.distortion.k1 = -0.3;
    let folded = camera.distortion.distort(&Point2::new(1.8, 0.0));
    assert!(
        folded.x.abs() < 0.1,
        "the polynomial folds it back: {folded}"
    );
    assert_eq!(camera.pixel_from_camera(&Vector3::new(1.8, 0.0, 1.0)), None);
}

fn any_lens() -> impl Strategy<Value = Lens> {
    prop_oneof![
        Just(Lens::Pinhole),
        Just(Lens::Angular),
        (20.0..120.0f64).prop_map(|lambda| Lens::Lambda { lambda }),
    ]
}

fn any_camera() -> impl Strategy<Value = CameraModel> {
    (
        any_lens(),
        -0.15..0.15f64,
        -0.02..0.02f64,
        -0.003..0.003f64,
        -0.4..0.4f64,
    )
        .prop_map(|(lens, k1, k2, p1, tilt)| {
            let mut camera = camera();
            camera.lens = lens;
            // A λ of few pixels sees so wide that no polynomial distortion reaches its corners.
            if !matches!(lens, Lens::Lambda { .. }) {
                camera.distortion = Distortion {
                    k1,
                    k2,
                    p1,
                    p2: -p1,
                    k3: 0.0,
                };
            }
            camera.mount = Mount {
                roll: 0.1 * tilt,
                pitch: tilt,
                yaw: 2.0 * tilt,
            };
            camera
        })
}

fn any_pose() -> impl Strategy<Value = Pose> {
    (-0.4..0.4f64, -0.3..0.3f64, -PI..PI, 130.0..1000.0f64).prop_map(|(roll, pitch, yaw, h)| Pose {
        position_in_world: Point3::new(120.0, -340.0, 15.0 - h),
        attitude: Attitude { roll, pitch, yaw },
    })
}

proptest! {
    #[test]
    fn the_ground_seen_at_a_pixel_appears_at_that_pixel(
        camera in any_camera(), pose in any_pose(),
        x in 80.0..560.0f64, y in 60.0..420.0f64,
    ) {
        let pixel = Point2::new(x, y);
        if let Some(ground) = camera.ground_at(&pose, &pixel, 15.0) {
            let back = camera.project(&pose, &Point3::new(ground.north, ground.east, 15.0));
            let back = back.expect("ground in view is in front of the lens");
            prop_assert!((back - pixel).norm() < 1e-6, "{back} {pixel}");
        }
    }

    #[test]
    fn the_jacobians_predict_a_small_move(
        camera in any_camera(), pose in any_pose(),
        d in proptest::array::uniform6(-1.0..1.0f64),
    ) {
        // Ground near the middle of the picture.
        let Some(ground) = camera.ground_at(&pose, &Point2::new(300.0, 260.0), 15.0) else {
            return Ok(());
        };
        prop_assume!(ground.distance(&GroundPoint::new(120.0, -340.0)) < 3000.0);
        let point = Point3::new(ground.north, ground.east, 15.0);
        let step = Vector3::new(d[0], d[1], d[2]) * 1e-3;
        let turn = Vector3::new(d[3], d[4], d[5]) * 1e-6;
        let mut moved = pose;
        moved.position_in_world += step;
        moved.attitude.roll += turn.x;
        moved.attitude.pitch += turn.y;
        moved.attitude.yaw += turn.z;
        let predicted = camera.pixel_by_position(&pose, &point).unwrap() * step
            + camera.pixel_by_attitude(&pose, &point).unwrap() * turn;
        let actual = camera.project(&moved, &point).unwrap() - camera.project(&pose, &point).unwrap();
        prop_assert!((predicted - actual).norm() < 1e-5 + 2e-3 * actual.norm(), "{predicted} {actual}");
    }

    #[test]
    fn the_footprint_is_the_edge_of_what_is_seen(camera in any_camera(), pose in any_pose()) {
        let outline = camera.footprint(&pose, 15.0);
        prop_assert!(outline.len() >= 3, "{outline:?}");
        let height = 15.0 - pose.position_in_world.z;
        let below = GroundPoint::new(120.0, -340.0);
        for p in &outline {
            let distance = p.distance(&below);
            prop_assert!(distance <= height * super::FARTHEST_HEIGHTS * 1.001);
            let Some(pixel) = camera.project(&pose, &Point3::new(p.north, p.east, 15.0)) else {
                continue; // At the fold of the distortion.
            };
            let edge = pixel.x.min(640.0 - pixel.x).min(pixel.y).min(480.0 - pixel.y);
            let at_limit = distance > height * super::FARTHEST_HEIGHTS * 0.999;
            prop_assert!(edge.abs() < 1e-3 || at_limit, "{pixel} at {distance} m");
        }
    }
}

#[test]
fn a_level_camera_sees_a_rectangle_below_it() {
    let outline = camera().footprint(&level(200.0), 0.0);
    let half = 200.0 * degrees(30.0).tan();
    assert_eq!(outline.len(), 4);
    assert!((outline[0].north - half * 0.75).abs() < 1e-9 && (outline[0].east + half).abs() < 1e-9);
    assert!((outline[2].north + half * 0.75).abs() < 1e-9 && (outline[2].east - half).abs() < 1e-9);
}

#[test]
fn the_footprint_ends_before_the_horizon() {
    let pose = thesis_pose([0.0, 0.0, 100.0], [0.0, 75.0, 0.0]);
    let outline = camera().footprint_within(&pose, 0.0, 1000.0);
    let farthest = outline
        .iter()
        .map(|p| p.north.hypot(p.east))
        .fold(0.0, f64::max);
    assert!((farthest - 1000.0).abs() < 1e-3, "{farthest}");
    assert!(outline.iter().all(|p| p.north > 0.0));
    // Looking up there is no ground at all.
    let up = thesis_pose([0.0, 0.0, 100.0], [0.0, 170.0, 0.0]);
    assert!(camera().footprint(&up, 0.0).is_empty());
}

#[test]
fn a_degree_of_roll_moves_the_nadir_by_the_focal_length_times_a_degree() {
    let mut covariance = Matrix3::zeros();
    covariance[(0, 0)] = degrees(1.0).powi(2);
    let spread = camera()
        .pixel_covariance_from_attitude(&level(500.0), &Point3::origin(), &covariance)
        .unwrap();
    assert!(
        (spread[(0, 0)].sqrt() - camera().focal * degrees(1.0)).abs() < 1e-3,
        "{spread}"
    );
    assert!(spread[(1, 1)] < 1e-9);
}

#[test]
fn the_ray_table_holds_the_rays_of_all_pixels() {
    let mut camera = camera();
    camera.distortion = Distortion {
        k1: -0.12,
        k2: 0.03,
        p1: 0.001,
        p2: -0.002,
        k3: 0.0,
    };
    let table = super::RayTable::new(&camera);
    for (column, row) in [(0, 0), (639, 0), (320, 240), (17, 479), (639, 479)] {
        let ray = camera.ray_in_camera(&Point2::new(column as f64 + 0.5, row as f64 + 0.5));
        let [x, y] = table.row(row)[column];
        assert!((f64::from(x) - ray.x).abs() < 1e-6 && (f64::from(y) - ray.y).abs() < 1e-6);
    }
}

/// A picture stored turned shows the same ground at turned pixels, however the camera is mounted.
#[test]
fn a_turned_picture_turns_about_its_own_axis() {
    let mut camera = camera();
    camera.mount = Mount {
        roll: 0.1,
        pitch: -0.2,
        yaw: 0.7,
    };
    let pose = level(50.0);
    let point = Point3::new(4.0, -9.0, 0.0);
    let upright = camera.project(&pose, &point).unwrap() - camera.principal;
    let turned = camera.stored_turned(PI).project(&pose, &point).unwrap() - camera.principal;
    assert!((upright + turned).norm() < 1e-9, "{upright} {turned}");
    // A picture turned clockwise by a quarter shows to the right what was up.
    let quarter = camera.stored_turned(PI / 2.0);
    let turned = quarter.project(&pose, &point).unwrap() - camera.principal;
    let expected = nalgebra::Vector2::new(-upright.y, upright.x);
    assert!((turned - expected).norm() < 1e-9, "{upright} {turned}");
    assert_eq!(quarter.focal, camera.focal);
}

#[test]
fn a_turned_picture_takes_its_principal_point_and_all_of_its_distortion_with_it() {
    let mut camera = camera();
    camera.principal = Point2::new(340.0, 230.0);
    camera.distortion = Distortion {
        k1: -0.12,
        k2: 0.03,
        p1: 0.01,
        p2: -0.02,
        k3: 0.0,
    };
    let pose = level(50.0);
    let (width, height) = (camera.width as f64, camera.height as f64);
    let middle = Point2::new(0.5 * width, 0.5 * height);
    for point in [Point3::new(4.0, -9.0, 0.0), Point3::new(-7.0, 11.0, 0.0)] {
        let upright = camera.project(&pose, &point).unwrap();
        let upside_down = camera.stored_turned(PI).project(&pose, &point).unwrap();
        let expected = Point2::new(width - upright.x, height - upright.y);
        assert!((upside_down - expected).norm() < 1e-9, "{upside_down}");
        // Clockwise by a quarter: what was so far up is so far to the right of the middle.
        let quarter = camera.stored_turned(PI / 2.0).project(&pose, &point);
        let (quarter, from) = (quarter.unwrap() - middle, upright - middle);
        assert!((quarter.x + from.y).abs() < 1e-9 && (quarter.y - from.x).abs() < 1e-9);
    }
}
