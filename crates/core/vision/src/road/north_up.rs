//! A camera picture as the ground that it shows, north up.

use nalgebra::Point3;

use pilotage_base::frames::{GroundRect, Pose};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::Window;
use pilotage_raster::raster::{Picture, Raster, Rgba};

/// Most samples of a picture along each side of a ground pixel.
const MOST_SAMPLES: usize = 4;

/// Ground that a picture shows, and its colours there; coverage 0 where the picture shows nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct NorthUpPicture {
    /// Place of the pixels, north up.
    pub window: Window,
    /// Colours.
    pub pixels: Raster<Rgba>,
}

impl NorthUpPicture {
    /// The ground within `farthest` metres of the point below a camera, as its `picture` shows it from `pose` over level
    /// ground `ground_down` metres below the world's origin, at `gsd` metres a pixel; `None` where it shows none.
    ///
    /// ```
    /// use nalgebra::Point3;
    /// use pilotage_base::frames::{Attitude, Pose};
    /// use pilotage_raster::{camera::CameraModel, raster::Picture};
    /// use pilotage_vision::road::NorthUpPicture;
    ///
    /// // Heading east, the top of the picture shows the east. It is the bright half.
    /// let picture = Picture::from_fn(200, 200, |_, row| if row < 100 { [200; 3] } else { [50; 3] });
    /// let camera = CameraModel::pinhole(200, 200, 1.0);
    /// let position_in_world = Point3::new(0.0, 0.0, -100.0);
    /// let pose = Pose { position_in_world, attitude: Attitude::level(90_f64.to_radians()) };
    /// let ground = NorthUpPicture::of(&camera, &pose, 0.0, &picture, 1.0, 200.0).ok_or("no ground")?;
    /// let (width, height) = (ground.pixels.width(), ground.pixels.height());
    /// assert_eq!(ground.pixels.get(width / 4, height / 2), [50, 50, 50, 255]); // west
    /// assert_eq!(ground.pixels.get(3 * width / 4, height / 2), [200, 200, 200, 255]); // east
    /// # Ok::<(), &str>(())
    /// ```
    pub fn of(
        camera: &CameraModel,
        pose: &Pose,
        ground_down: f64,
        picture: &Picture,
        gsd: f64,
        farthest: f64,
    ) -> Option<Self> {
        let outline = camera.footprint_within(pose, ground_down, farthest);
        let window = Window::covering(&GroundRect::around(outline)?, gsd);
        let rotation = camera.camera_from_world(pose);
        let height = ground_down - pose.position_in_world.z;
        let samples = (gsd * camera.focal / height).ceil() as usize;
        let samples = samples.clamp(1, MOST_SAMPLES);
        let seen = |x: f64, y: f64| {
            let ground = window.ground_at(x, y);
            let point = Point3::new(ground.north, ground.east, ground_down);
            let pixel = camera.pixel_from_camera(&(rotation * (point - pose.position_in_world)))?;
            let inside = pixel.x >= 0.0
                && pixel.y >= 0.0
                && pixel.x < picture.width() as f64
                && pixel.y < picture.height() as f64;
            inside.then(|| picture.get(pixel.x as usize, pixel.y as usize))
        };
        let pixels = Raster::from_fn(window.width, window.height, |column, row| {
            let mut sum = [0_u32; 3];
            let mut count = 0;
            for i in 0..samples * samples {
                let within = |k: usize| (k as f64 + 0.5) / samples as f64;
                let (x, y) = (within(i % samples), within(i / samples));
                if let Some(color) = seen(column as f64 + x, row as f64 + y) {
                    for (sum, value) in sum.iter_mut().zip(color) {
                        *sum += u32::from(value);
                    }
                    count += 1;
                }
            }
            match count {
                0 => [0; 4],
                count => {
                    let [r, g, b] = sum.map(|sum| (sum / count) as u8);
                    [r, g, b, u8::MAX]
                }
            }
        });
        Some(Self { window, pixels })
    }
}
