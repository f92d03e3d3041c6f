//! A camera's picture in its colours as it lies on the ground, north up.

use nalgebra::Point3;

use pilotage_base::frames::{GroundRect, Pose};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::Window;
use pilotage_raster::raster::{Picture, Raster, Rgb, Rgba};

/// Farthest ground that is shown, in heights above it: beyond, a pixel of the camera shows too much.
const FARTHEST_HEIGHTS: f64 = 1.5;

/// Pixels of ground at most: at 0.75 m each 13 km², for which what is found out of them takes some hundred megabytes.
const MOST_PIXELS: usize = 24_000_000;

/// Ground that a camera shows by the assumed `pose` over level ground, as a picture of `gsd` metres per pixel. `None` where
/// it looks past the horizon, or at more than 24 million pixels of ground.
pub fn ground_window(
    camera: &CameraModel,
    pose: &Pose,
    ground_down: f64,
    gsd: f64,
) -> Option<Window> {
    let height = ground_down - pose.position_in_world.z;
    let outline = camera.footprint_within(pose, ground_down, FARTHEST_HEIGHTS * height);
    let window = Window::covering(&GroundRect::around(outline)?, gsd);
    (window.width.saturating_mul(window.height) <= MOST_PIXELS).then_some(window)
}

/// The ground that `picture` shows, `gsd` metres per pixel, by the assumed `pose` over level ground; clear where the
/// camera saw nothing. `None` where [`ground_window`] has none.
pub fn ground_picture(
    camera: &CameraModel,
    pose: &Pose,
    ground_down: f64,
    picture: &Picture,
    gsd: f64,
) -> Option<(Window, Raster<Rgba>)> {
    let height = ground_down - pose.position_in_world.z;
    let window = ground_window(camera, pose, ground_down, gsd)?;
    let rotation = camera.camera_from_world(pose);
    let in_camera = |x: f64, y: f64| {
        let ground = window.ground_at(x, y);
        let point = Point3::new(ground.north, ground.east, ground_down);
        rotation * (point - pose.position_in_world)
    };
    // On the plane, camera coordinates are affine in the ground pixel.
    let origin = in_camera(0.5, 0.5);
    let along_x = in_camera(1.5, 0.5) - origin;
    let along_y = in_camera(0.5, 1.5) - origin;
    let apart = gsd * camera.focal / height.max(1e-3);
    let block = (apart + 0.25) as usize;
    let small = (block > 1).then(|| shrunk(picture, block));
    let (source, shrink) = small
        .as_ref()
        .map_or((picture, 1.0), |small| (small, 1.0 / block as f64));
    let pixels = Raster::from_fn(window.width, window.height, |column, row| {
        let point = origin + along_x * column as f64 + along_y * row as f64;
        let pixel = camera.pixel_from_camera(&point);
        let colour = pixel.and_then(|p| colour_at(source, p.x * shrink, p.y * shrink));
        colour.map_or([0; 4], |[r, g, b]| [r, g, b, u8::MAX])
    });
    Some((window, pixels))
}

/// The picture with each pixel the mean of a square of `block` by `block`; what is left over at the rim is dropped.
fn shrunk(picture: &Picture, block: usize) -> Picture {
    let share = (block * block) as u32;
    let (width, height) = (picture.width() / block, picture.height() / block);
    Raster::from_fn(width, height, |x, y| {
        let mut sum = [0_u32; 3];
        for row in y * block..(y + 1) * block {
            for pixel in &picture.row(row)[x * block..(x + 1) * block] {
                for (sum, value) in sum.iter_mut().zip(pixel) {
                    *sum += u32::from(*value);
                }
            }
        }
        sum.map(|sum| ((sum + share / 2) / share) as u8)
    })
}

/// Bilinear colour at continuous pixel (x, y), centres at half integers; `None` nearer than half a pixel to the rim.
fn colour_at(picture: &Picture, x: f64, y: f64) -> Option<Rgb> {
    let (x, y) = (x as f32 - 0.5, y as f32 - 0.5);
    let (width, height) = (picture.width(), picture.height());
    if !(x >= 0.0 && y >= 0.0 && x < (width - 1) as f32 && y < (height - 1) as f32) {
        return None;
    }
    let (left, top) = (x as usize, y as usize);
    let (fx, fy) = (x - left as f32, y - top as f32);
    let (upper, lower) = (&picture.row(top)[left..], &picture.row(top + 1)[left..]);
    let mix = |channel: usize| {
        let [a, b] = [upper[0][channel], upper[1][channel]].map(f32::from);
        let [c, d] = [lower[0][channel], lower[1][channel]].map(f32::from);
        let (above, below) = (a + fx * (b - a), c + fx * (d - c));
        (above + fy * (below - above) + 0.5) as u8
    };
    Some([mix(0), mix(1), mix(2)])
}
