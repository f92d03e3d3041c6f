//! The rays of all pixels, for pictures computed pixel by pixel.

use nalgebra::Point2;

use super::CameraModel;

/// Directions seen at the pixel centres of a camera, z = 1, row by row.
///
/// They do not depend on the pose, so one table serves a whole flight.
#[derive(Clone, Debug)]
pub struct RayTable {
    width: usize,
    rays: Vec<[f32; 2]>,
}

impl RayTable {
    /// The rays of `camera`.
    pub fn new(camera: &CameraModel) -> Self {
        let mut rays = Vec::with_capacity(camera.width * camera.height);
        let mut above: Vec<Point2<f64>> = Vec::new();
        for row in 0..camera.height {
            let mut line = Vec::with_capacity(camera.width);
            for column in 0..camera.width {
                let pixel = Point2::new(column as f64 + 0.5, row as f64 + 0.5);
                let seen = camera.seen_at(&pixel);
                let ideal = if camera.distortion.is_none() {
                    seen
                } else {
                    // A neighbour's answer is the best guess.
                    let guess = line.last().or(above.get(column)).unwrap_or(&seen);
                    camera.distortion.undistort_from(&seen, guess)
                };
                rays.push([ideal.x as f32, ideal.y as f32]);
                line.push(ideal);
            }
            above = line;
        }
        Self {
            width: camera.width,
            rays,
        }
    }

    /// The rays of one row of pixels: (x, y) of camera vectors with z = 1.
    pub fn row(&self, row: usize) -> &[[f32; 2]] {
        &self.rays[row * self.width..][..self.width]
    }
}
