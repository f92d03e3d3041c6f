//! The aerial camera: any imagery, pose and camera → picture.
//!
//! The ground is a plane textured with the imagery, as in DeAngelo 2016, Table 5; the projection is
//! [`CameraModel`]'s own, so that a labelled point lies where the measurement model says.

use nalgebra::{Point2, Vector3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

use crate::camera::{CameraModel, Distortion, Lens};
use crate::frames::{GroundPoint, GroundRect, Pose};
use crate::imagery::{CachedImagery, Imagery};
use crate::raster::{Picture, Raster, Rgba, gaussian_blur_colour};

/// What a real camera adds to the ideal picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AerialCameraSettings {
    /// Standard deviation of the exposure from frame to frame, as a factor's logarithm.
    pub exposure: f64,
    /// Blur of lens and motion, standard deviation in pixels.
    pub blur: f64,
    /// Sensor noise at mid grey, standard deviation in grey values.
    pub noise: f64,
    /// Darkening at the corners, 0 to 1.
    pub vignetting: f64,
    /// JPEG quality, 1 to 100.
    pub jpeg_quality: u8,
}

impl Default for AerialCameraSettings {
    fn default() -> Self {
        Self {
            exposure: 0.06,
            blur: 0.6,
            noise: 3.0,
            vignetting: 0.12,
            jpeg_quality: 88,
        }
    }
}

/// Rays steeper than this fraction of their length are followed to the ground; others show haze.
const LEAST_DESCENT: f64 = 0.08;
/// Colour where no ground is seen.
const NOTHING: [f32; 3] = [128.0, 134.0, 138.0];

/// The ideal picture: what the imagery's ground looks like from `pose`, anti-aliased.
///
/// Every pixel is the mean of four bilinear samples of a north-up window whose scale is at most two
/// thirds of a picture pixel on the ground.
pub fn render(
    imagery: &CachedImagery,
    camera: &CameraModel,
    pose: &Pose,
    ground_down: f64,
) -> Picture {
    let height = (ground_down - pose.position_in_world.z).max(0.1);
    let level = imagery.level_for(0.75 * height / camera.focal);
    let rect = GroundRect::around(ground_outline(camera, pose, ground_down));
    let Some(rect) = rect else {
        return Raster::filled(camera.width, camera.height, NOTHING.map(|v| v as u8));
    };
    let reach = 6.0 * height;
    let here = GroundPoint::new(pose.position_in_world.x, pose.position_in_world.y);
    let near = GroundRect::centered(here, 2.0 * reach, 2.0 * reach);
    let rect = GroundRect {
        south: rect.south.max(near.south),
        north: rect.north.min(near.north),
        west: rect.west.max(near.west),
        east: rect.east.min(near.east),
    };
    let window = imagery.aligned(&rect.grown(2.0), level);
    let ground = imagery.window(&window);
    let rotation = camera.camera_from_world(pose).inverse();
    let rays = camera.lens == Lens::Pinhole && camera.distortion == Distortion::default();
    let sample = |x: f64, y: f64| -> [f32; 3] {
        let ray: Vector3<f64> = if rays {
            let direction = Vector3::new(
                (x - camera.principal.x) / camera.focal,
                (y - camera.principal.y) / camera.focal,
                1.0,
            );
            rotation * direction
        } else {
            rotation * camera.ray_in_camera(&Point2::new(x, y))
        };
        if ray.z < LEAST_DESCENT * ray.norm() {
            return NOTHING;
        }
        let scale = height / ray.z;
        let (px, py) = window.pixel_at(&GroundPoint::new(
            pose.position_in_world.x + scale * ray.x,
            pose.position_in_world.y + scale * ray.y,
        ));
        bilinear_colour(&ground, px as f32, py as f32)
    };
    Raster::from_fn(camera.width, camera.height, |column, row| {
        let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
        let mut sum = [0.0_f32; 3];
        for (dx, dy) in [(-0.25, -0.25), (0.25, -0.25), (-0.25, 0.25), (0.25, 0.25)] {
            let value = sample(x + dx, y + dy);
            for (s, v) in sum.iter_mut().zip(value) {
                *s += v;
            }
        }
        sum.map(|s| (0.25 * s + 0.5) as u8)
    })
}

/// Ground points along the edge of the picture.
fn ground_outline(camera: &CameraModel, pose: &Pose, ground_down: f64) -> Vec<GroundPoint> {
    let (w, h) = (camera.width as f64, camera.height as f64);
    (0..=8)
        .flat_map(|i| {
            let t = f64::from(i) / 8.0;
            [(t * w, 0.0), (t * w, h), (0.0, t * h), (w, t * h)]
        })
        .filter_map(|(x, y)| camera.ground_at(pose, &Point2::new(x, y), ground_down))
        .collect()
}

fn bilinear_colour(ground: &Raster<Rgba>, x: f32, y: f32) -> [f32; 3] {
    let (cx, cy) = (x - 0.5, y - 0.5);
    let (width, height) = (ground.width(), ground.height());
    if !(cx >= 0.0 && cy >= 0.0 && cx < (width - 1) as f32 && cy < (height - 1) as f32) {
        return NOTHING;
    }
    let (c, r) = (cx as usize, cy as usize);
    let (fx, fy) = (cx - c as f32, cy - r as f32);
    let (upper, lower) = (&ground.row(r)[c..c + 2], &ground.row(r + 1)[c..c + 2]);
    let mut out = [0.0; 3];
    for (k, value) in out.iter_mut().enumerate() {
        let mix = |row: &[Rgba]| {
            let (a, b) = (f32::from(row[0][k]), f32::from(row[1][k]));
            a + fx * (b - a)
        };
        let (top, bottom) = (mix(upper), mix(lower));
        *value = top + fy * (bottom - top);
    }
    out
}

/// The picture as the sensor gives it: exposure, vignetting, blur and noise, all from `random`.
pub fn expose(
    ideal: &Picture,
    settings: &AerialCameraSettings,
    random: &mut ChaCha8Rng,
) -> Picture {
    let normal = |random: &mut ChaCha8Rng| -> f32 { StandardNormal.sample(random) };
    let gain = (settings.exposure as f32 * normal(random)).exp();
    let blurred = gaussian_blur_colour(ideal, settings.blur);
    // Cheap noise: a table of Gaussian numbers read from random places, one table a frame.
    let table: Vec<f32> = (0..4096).map(|_| normal(random)).collect();
    let (width, height) = (ideal.width() as f32, ideal.height() as f32);
    let corner = 0.25 * (width * width + height * height);
    let mut state = random_word(random);
    let mut out = blurred;
    for row in 0..ideal.height() {
        let dy = row as f32 + 0.5 - 0.5 * height;
        for (column, pixel) in out.row_mut(row).iter_mut().enumerate() {
            let dx = column as f32 + 0.5 - 0.5 * width;
            let shade = 1.0 - settings.vignetting as f32 * (dx * dx + dy * dy) / corner;
            for channel in pixel.iter_mut() {
                state ^= state << 13;
                state ^= state >> 7;
                state ^= state << 17;
                let ideal = f32::from(*channel) * gain * shade;
                // Photon noise grows with the root of the light.
                let spread = settings.noise as f32 * (0.3 + 0.7 * ideal / 128.0).max(0.0).sqrt();
                *channel =
                    (ideal + spread * table[(state >> 52) as usize] + 0.5).clamp(0.0, 255.0) as u8;
            }
        }
    }
    out
}

fn random_word(random: &mut ChaCha8Rng) -> u64 {
    use rand::Rng as _;
    random.next_u64() | 1
}

/// The generator for frame `index` of the flight with this seed: frames can be taken in any order.
pub fn frame_random(seed: u64, index: usize) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream((2 << 32) | index as u64);
    random
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use nalgebra::Point3;

    use super::*;
    use crate::frames::Attitude;
    use crate::imagery::Window;

    /// Bright dots on dark ground.
    fn dots(window: &Window, places: &[GroundPoint]) -> Raster<Rgba> {
        Raster::from_fn(window.width, window.height, |c, r| {
            let p = window.ground_at(c as f64 + 0.5, r as f64 + 0.5);
            let light: f64 = places
                .iter()
                .map(|q| (-0.5 * (p.distance(q) / 0.6).powi(2)).exp())
                .sum();
            let v = (30.0 + 220.0 * light.min(1.0)) as u8;
            [v, v, v, 255]
        })
    }

    struct Dots(Vec<GroundPoint>);

    impl Imagery for Dots {
        fn name(&self) -> &'static str {
            "dots"
        }
        fn bounds(&self) -> GroundRect {
            GroundRect {
                south: -500.0,
                north: 500.0,
                west: -500.0,
                east: 500.0,
            }
        }
        fn native_gsd(&self) -> f64 {
            0.1
        }
        fn window(&self, window: &Window) -> Raster<Rgba> {
            dots(window, &self.0)
        }
    }

    /// Centre of light around a pixel.
    fn centroid(picture: &Picture, around: &Point2<f64>) -> Point2<f64> {
        let (mut sum, mut x, mut y) = (0.0, 0.0, 0.0);
        for row in (around.y as usize - 9)..(around.y as usize + 10) {
            for column in (around.x as usize - 9)..(around.x as usize + 10) {
                let light = f64::from(picture.get(column, row)[1].saturating_sub(40));
                sum += light;
                x += light * (column as f64 + 0.5);
                y += light * (row as f64 + 0.5);
            }
        }
        Point2::new(x / sum, y / sum)
    }

    #[test]
    fn labelled_points_lie_where_the_measurement_model_says_to_a_tenth_of_a_pixel() {
        let mut camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
        let places: Vec<GroundPoint> = (-2..=2)
            .flat_map(|i| {
                (-2..=2).map(move |j| GroundPoint::new(f64::from(i) * 17.0, f64::from(j) * 21.0))
            })
            .collect();
        let imagery = CachedImagery::new(Arc::new(Dots(places.clone())), 64);
        for distorted in [false, true] {
            if distorted {
                camera.distortion = Distortion {
                    k1: -0.12,
                    k2: 0.03,
                    p1: 1e-3,
                    p2: -5e-4,
                    k3: 0.0,
                };
            }
            for (roll, pitch, yaw) in [(0.0, 0.0, 0.0), (15.0, 5.0, 50.0), (-12.0, -6.0, 307.0)] {
                let pose = Pose {
                    position_in_world: Point3::new(5.0, -4.0, -120.0),
                    attitude: Attitude {
                        roll: f64::to_radians(roll),
                        pitch: f64::to_radians(pitch),
                        yaw: f64::to_radians(yaw),
                    },
                };
                let picture = render(&imagery, &camera, &pose, 0.0);
                let mut seen = 0;
                for place in &places {
                    let point = Point3::new(place.north, place.east, 0.0);
                    let Some(expected) = camera.project(&pose, &point) else {
                        continue;
                    };
                    if !camera.in_picture(&expected, 12.0) {
                        continue;
                    }
                    let found = centroid(&picture, &expected);
                    assert!((found - expected).norm() < 0.1, "{expected} {found}");
                    seen += 1;
                }
                assert!(seen >= 8, "{seen} dots in view");
            }
        }
    }

    #[test]
    fn a_frame_is_the_same_whenever_it_is_taken() {
        let ideal = Picture::filled(32, 24, [90, 120, 80]);
        let settings = AerialCameraSettings::default();
        let first = expose(&ideal, &settings, &mut frame_random(5, 17));
        let again = expose(&ideal, &settings, &mut frame_random(5, 17));
        let other = expose(&ideal, &settings, &mut frame_random(5, 18));
        assert_eq!(first, again);
        assert_ne!(first, other);
    }
}
