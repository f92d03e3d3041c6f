//! The camera picture as a north-up ground view at the map's scale.

use nalgebra::{Point3, Vector3};

use super::FrameView;
use pilotage_base::frames::GroundPoint;
use pilotage_raster::camera::{CameraModel, Distortion, Lens};
use pilotage_raster::imagery::Window;
use pilotage_raster::raster::{Gray, Pyramid, bilinear};

/// A rectified picture and how much of it the camera saw.
#[derive(Clone, Debug)]
pub struct GroundView {
    /// Ground that the pixels show, under the assumed pose.
    pub window: Window,
    /// Luminance; the mean of the seen part where nothing was seen.
    pub luminance: Gray,
    /// Whether the camera saw every pixel.
    pub complete: bool,
    /// Mask: 1 where the camera saw the ground, 0 elsewhere; empty if complete.
    pub seen: Gray,
}

/// Rectifies the part of the picture that shows `window`: every ground pixel is projected with the
/// assumed pose and sampled at the pyramid level that fits the scale.
///
/// ```
/// use nalgebra::Point3;
/// use pilotage_base::frames::{Attitude, Pose};
/// use pilotage_raster::{camera::CameraModel, imagery::Window, raster::{Gray, Pyramid}};
/// use pilotage_vision::landmark::{FrameView, rectify};
///
/// // Heading east, the top of the picture shows the east. It is the bright half.
/// let picture = Gray::from_fn(100, 100, |_, row| if row < 50 { 200.0 } else { 50.0 });
/// let (camera, luminance) = (CameraModel::pinhole(100, 100, 1.0), Pyramid::new(picture, 1));
/// # let position_in_world = Point3::new(0.0, 0.0, -100.0);
/// # let pose = Pose { position_in_world, attitude: Attitude::level(90_f64.to_radians()) };
/// let view = FrameView { camera: &camera, pose, ground_down: 0.0, luminance: &luminance };
/// let window = Window { north_edge: 20.0, west_edge: -20.0, gsd: 2.0, width: 20, height: 20 };
/// let ground = rectify(&view, &window).luminance;
/// assert!((ground.get(2, 10) - 50.0).abs() < 1e-3); // west
/// assert!((ground.get(17, 10) - 200.0).abs() < 1e-3); // east
/// ```
pub fn rectify(view: &FrameView<'_>, window: &Window) -> GroundView {
    let rotation = view.camera.camera_from_world(&view.pose);
    rectify_plane(view.camera, view.luminance, window, |ground| {
        let point = Point3::new(ground.north, ground.east, view.ground_down);
        rotation * (point - view.pose.position_in_world)
    })
}

/// As [`rectify`], with ground points brought into camera coordinates by `camera_from_ground`, which has
/// to be affine.
pub fn rectify_plane(
    camera: &CameraModel,
    luminance: &Pyramid,
    window: &Window,
    camera_from_ground: impl Fn(GroundPoint) -> Vector3<f64>,
) -> GroundView {
    let in_camera = |x: f64, y: f64| camera_from_ground(window.ground_at(x, y));
    // On the plane, camera coordinates are affine in the ground pixel.
    let origin = in_camera(0.5, 0.5);
    let along_x = in_camera(1.5, 0.5) - origin;
    let along_y = in_camera(0.5, 1.5) - origin;
    let middle = in_camera(0.5 * window.width as f64, 0.5 * window.height as f64);
    let camera_pixels = window.gsd * camera.focal / middle.z.max(1e-3);
    let level = luminance.level_for(camera_pixels);
    let source = luminance.level(level);
    let shrink = 0.5_f64.powi(level as i32);
    let plain = camera.lens == Lens::Pinhole && camera.distortion == Distortion::default();

    let mut shown = Gray::filled(window.width, window.height, 0.0);
    let mut seen = Gray::filled(window.width, window.height, 1.0);
    let (mut missing, mut sum) = (0_usize, 0.0_f64);
    for row in 0..window.height {
        let start = origin + along_y * row as f64;
        for column in 0..window.width {
            let p = start + along_x * column as f64;
            let pixel = if plain {
                (p.z > 1e-6).then(|| {
                    let scale = camera.focal / p.z;
                    (
                        scale * p.x + camera.principal.x,
                        scale * p.y + camera.principal.y,
                    )
                })
            } else {
                camera.pixel_from_camera(&p).map(|q| (q.x, q.y))
            };
            let value =
                pixel.and_then(|(x, y)| bilinear(source, (x * shrink) as f32, (y * shrink) as f32));
            if let Some(value) = value {
                shown.set(column, row, value);
                sum += f64::from(value);
            } else {
                seen.set(column, row, 0.0);
                missing += 1;
            }
        }
    }
    let complete = missing == 0;
    if complete {
        seen = Gray::filled(0, 0, 0.0);
    } else {
        let count = window.width * window.height - missing;
        let mean = if count > 0 {
            (sum / count as f64) as f32
        } else {
            0.0
        };
        for (pixel, seen) in shown.pixels_mut().iter_mut().zip(seen.pixels()) {
            if *seen == 0.0 {
                *pixel = mean;
            }
        }
    }
    GroundView {
        window: *window,
        luminance: shown,
        complete,
        seen,
    }
}
