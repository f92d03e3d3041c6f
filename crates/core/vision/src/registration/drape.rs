//! A laid picture as it lies on the map: its outline, and its own pixels.

use serde::{Deserialize, Serialize};

use super::look::{FrameLook, MapPose};
use pilotage_base::frames::GroundPoint;
use pilotage_raster::imagery::Window;
use pilotage_raster::raster::{Picture, Raster, Rgb, Rgba};

/// A picture laid on the map in its own colours.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Draped {
    /// Place of the pixels on the ground, north up.
    pub window: Window,
    /// Its pixels; clear where the picture shows nothing.
    pub pixels: Raster<Rgba>,
}

/// Places of the map at the corners of a picture that was stored turned by `stored_turn` (radians clockwise), clockwise
/// from its top left; a corner that looks past the horizon is left out.
pub fn outline(look: &FrameLook<'_>, at: &MapPose, stored_turn: f64) -> Vec<GroundPoint> {
    let camera = look.camera.stored_turned(stored_turn);
    let look = FrameLook {
        camera: &camera,
        ..*look
    };
    let corners = camera.corners();
    let seen = corners.iter().filter_map(|corner| look.ground(at, corner));
    seen.collect()
}

/// The colours of `picture` on the map, with `most` pixels along the longer side of its window; `None` where it sees
/// past the horizon.
pub fn drape(
    look: &FrameLook<'_>,
    at: &MapPose,
    stored_turn: f64,
    picture: &Picture,
    most: usize,
) -> Option<Draped> {
    let camera = look.camera.stored_turned(stored_turn);
    let look = FrameLook {
        camera: &camera,
        ..*look
    };
    let rect = look.footprint(at)?;
    let longer = rect.width().max(rect.height());
    let window = Window::covering(&rect, longer / most.max(1) as f64);
    let pixel = |x: f64, y: f64| look.pixel(at, &window.ground_at(x, y));
    let middle = (0.5 * window.width as f64, 0.5 * window.height as f64);
    let steps = pixel(middle.0, middle.1).zip(pixel(middle.0 + 1.0, middle.1));
    let apart = steps.map_or(1.0, |(here, beside)| (beside - here).norm());
    let block = (apart as usize).max(1);
    let small = averaged(picture, block);
    let shown = |x: usize, y: usize| {
        let seen = pixel(x as f64 + 0.5, y as f64 + 0.5)?;
        sample(&small, seen.x / block as f64, seen.y / block as f64)
    };
    let pixels = Raster::from_fn(window.width, window.height, |x, y| {
        shown(x, y).map_or([0; 4], |[r, g, b]| [r, g, b, u8::MAX])
    });
    Some(Draped { window, pixels })
}

/// The picture with each pixel the mean of a square of `block` by `block`.
fn averaged(picture: &Picture, block: usize) -> Picture {
    if block <= 1 {
        return picture.clone();
    }
    let size = |pixels: usize| pixels.div_ceil(block);
    Raster::from_fn(size(picture.width()), size(picture.height()), |x, y| {
        let end = ((y + 1) * block).min(picture.height());
        let rows = y * block..end;
        let mut sum = [0_u32; 3];
        let mut count = 0;
        for row in rows {
            let end = ((x + 1) * block).min(picture.width());
            for pixel in &picture.row(row)[x * block..end] {
                for (sum, value) in sum.iter_mut().zip(pixel) {
                    *sum += u32::from(*value);
                }
                count += 1;
            }
        }
        sum.map(|sum| (sum / count.max(1)) as u8)
    })
}

/// Bilinear colour at continuous pixel (x, y), centres at half integers; `None` outside the picture.
fn sample(picture: &Picture, x: f64, y: f64) -> Option<Rgb> {
    let (width, height) = (picture.width() as f64, picture.height() as f64);
    if !(x >= 0.0 && y >= 0.0 && x <= width && y <= height) {
        return None;
    }
    let (cx, cy) = (
        (x - 0.5).clamp(0.0, width - 1.0),
        (y - 0.5).clamp(0.0, height - 1.0),
    );
    let (left, top) = (cx as usize, cy as usize);
    let right = (left + 1).min(picture.width() - 1);
    let bottom = (top + 1).min(picture.height() - 1);
    let (fx, fy) = (cx - left as f64, cy - top as f64);
    let corners = [
        picture.get(left, top),
        picture.get(right, top),
        picture.get(left, bottom),
        picture.get(right, bottom),
    ];
    let mix = |channel: usize| {
        let [a, b, c, d] = corners.map(|pixel| f64::from(pixel[channel]));
        let (upper, lower) = (a + fx * (b - a), c + fx * (d - c));
        (upper + fy * (lower - upper)).round() as u8
    };
    Some([mix(0), mix(1), mix(2)])
}

#[cfg(test)]
mod tests {
    use super::super::MapShape;
    use super::*;
    use nalgebra::Point3;
    use pilotage_base::frames::{Attitude, Pose};
    use pilotage_raster::camera::CameraModel;
    use pilotage_raster::imagery::Blank;
    use pilotage_raster::raster::Pyramid;

    /// Drapes a picture whose top half is red and whose bottom half is blue, by a camera 100 m above (10, 20) that
    /// heads as given; 400 by 200 pixels show 100 by 50 m.
    fn draped(heading: f64, turn: f64) -> (Vec<GroundPoint>, Draped) {
        let picture = Picture::from_fn(
            400,
            200,
            |_, row| {
                if row < 100 { [200, 0, 0] } else { [0, 0, 200] }
            },
        );
        let camera = CameraModel::pinhole(400, 200, 2.0 * 0.5_f64.atan());
        let luminance = Pyramid::new(picture.to_gray(), 1);
        let look = FrameLook {
            camera: &camera,
            ground_down: 0.0,
            luminance: &luminance,
            map: &Blank,
        };
        let at = MapPose {
            pose: Pose {
                position_in_world: Point3::new(10.0, 20.0, -100.0),
                attitude: Attitude {
                    roll: 0.0,
                    pitch: 0.0,
                    yaw: heading,
                },
            },
            shape: MapShape::default(),
        };
        let laid = drape(&look, &at, turn, &picture, 100).expect("it looks down");
        (outline(&look, &at, turn), laid)
    }

    fn colour(laid: &Draped, north: f64, east: f64) -> Rgba {
        let window = &laid.window;
        let column = (east - window.west_edge) / window.gsd;
        let row = (window.north_edge - north) / window.gsd;
        laid.pixels.get(column as usize, row as usize)
    }

    #[test]
    fn the_top_of_a_picture_lies_where_it_heads() {
        let (corners, laid) = draped(0.0, 0.0);
        assert!((corners[0].north - 35.0).abs() < 1e-6, "{corners:?}");
        assert!((corners[0].east + 30.0).abs() < 1e-6, "{corners:?}");
        assert_eq!((laid.window.width, laid.window.height), (100, 50));
        assert_eq!(colour(&laid, 30.0, 20.0), [200, 0, 0, 255]);
        assert_eq!(colour(&laid, -10.0, 20.0), [0, 0, 200, 255]);
        let (_, east) = draped(std::f64::consts::FRAC_PI_2, 0.0);
        assert_eq!(colour(&east, 10.0, 40.0), [200, 0, 0, 255]);
        let (_, upside_down) = draped(0.0, std::f64::consts::PI);
        assert_eq!(colour(&upside_down, 30.0, 20.0), [0, 0, 200, 255]);
    }

    #[test]
    fn what_a_turned_picture_does_not_show_is_clear() {
        let (_, laid) = draped(0.5, 0.0);
        assert_eq!(laid.pixels.get(0, 0)[3], 0);
        let window = laid.window;
        let middle = laid.pixels.get(window.width / 2, window.height / 2);
        assert_eq!(middle[3], 255);
    }
}
