//! The probability of road for every pixel.

use pilotage_raster::raster::{Gray, Raster, Rgba};

use super::crossing::crossings;
use super::network::{RoadNetwork, network_input};
use super::ridge::{RoadBody, ridge_points};
use super::seen::RoadsSeen;

/// Ground sample distance at which the network sees, metres per pixel.
pub const SEEN_GSD: f64 = 0.5;

/// Probability from which a pixel belongs to a road.
const LEAST: f32 = 0.4;

/// Probability of road for pixels of half a metre or so.
#[derive(Clone, Debug, PartialEq)]
pub struct RoadProbability {
    /// Probability, 0 to 1.
    pub probability: Gray,
    /// Pixels of the probability for each pixel of the picture, across and down.
    pub scale: [f64; 2],
}

/// Probability of road in a picture of the ground, pixels of coverage 0 showing nothing, by the built-in network.
pub fn road_probability(picture: &Raster<Rgba>, metres_per_pixel: f64) -> RoadProbability {
    probability_by(&RoadNetwork::built_in(), picture, metres_per_pixel)
}

/// As [`road_probability`], by another network.
pub fn probability_by(
    network: &RoadNetwork,
    picture: &Raster<Rgba>,
    metres_per_pixel: f64,
) -> RoadProbability {
    let size =
        |pixels: usize| ((pixels as f64 * metres_per_pixel / SEEN_GSD).round() as usize).max(1);
    let (width, height) = (size(picture.width()), size(picture.height()));
    let scale = [
        width as f64 / picture.width().max(1) as f64,
        height as f64 / picture.height().max(1) as f64,
    ];
    let input = if (width, height) == (picture.width(), picture.height()) {
        network_input(picture)
    } else {
        network_input(&resized(picture, width, height))
    };
    let odds = network.log_odds(input);
    let mut probability = Gray::filled(width, height, 0.0);
    for row in 0..height {
        let odds = &odds.values[row * odds.width..][..width];
        for (value, odds) in probability.row_mut(row).iter_mut().zip(odds) {
            *value = 1.0 / (1.0 + libm::expf(-odds));
        }
    }
    RoadProbability { probability, scale }
}

/// Roads in a picture of the ground, pixels of coverage 0 showing nothing, by the built-in network.
pub fn roads_seen(picture: &Raster<Rgba>, metres_per_pixel: f64) -> RoadsSeen {
    road_probability(picture, metres_per_pixel).roads()
}

impl RoadProbability {
    /// Points of the centre lines and crossings, in pixels of the picture.
    pub fn roads(&self) -> RoadsSeen {
        let body = RoadBody::new(&self.probability, LEAST);
        let mut points = ridge_points(&body, &self.probability);
        let mut crossings = crossings(&body, &self.probability, &points);
        let [sx, sy] = self.scale;
        for point in &mut points {
            point.pixel = [point.pixel[0] / sx, point.pixel[1] / sy];
            point.width /= (sx * sy).sqrt();
        }
        for crossing in &mut crossings {
            crossing.pixel = [crossing.pixel[0] / sx, crossing.pixel[1] / sy];
        }
        RoadsSeen { points, crossings }
    }
}

/// The picture with so many pixels, each the mean of what it covers (between pixels where it is made larger).
fn resized(picture: &Raster<Rgba>, width: usize, height: usize) -> Raster<Rgba> {
    let range = |at: usize, count: usize, size: usize| {
        let from = at * size / count;
        from..((at + 1) * size).div_ceil(count).clamp(from + 1, size)
    };
    Raster::from_fn(width, height, |column, row| {
        let columns = range(column, width, picture.width());
        let (mut sum, mut count, mut all) = ([0_u32; 3], 0_u32, 0_u32);
        for y in range(row, height, picture.height()) {
            for pixel in &picture.row(y)[columns.clone()] {
                all += 1;
                if pixel[3] > 0 {
                    count += 1;
                    for (sum, value) in sum.iter_mut().zip(pixel) {
                        *sum += u32::from(*value);
                    }
                }
            }
        }
        if 2 * count < all {
            return [0; 4];
        }
        let [red, green, blue] = sum.map(|s| (s / count.max(1)) as u8);
        [red, green, blue, u8::MAX]
    })
}
