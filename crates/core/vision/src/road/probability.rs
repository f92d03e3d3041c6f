//! The probability of road for every pixel.

use pilotage_raster::raster::{Gray, Raster, Rgba};

use super::crossing::crossings;
use super::network::{RoadNetwork, network_input};
use super::ridge::{RoadBody, ridge_points, road_mask};
use super::seen::RoadsSeen;

/// Ground sample distance at which the network sees, metres per pixel.
pub const SEEN_GSD: f64 = 0.5;

/// Coarsest pixel of a picture in which roads are looked for, metres: a road of 6 m is five of them wide, and with half as
/// many it is a line like any other.
pub const COARSEST_SEEN: f64 = 1.2;

/// Probability from which a pixel is a road for sure, and from which it is where it is connected with such; the best of
/// ten pairs on drawn ground that was not learned from (`train_roads -- judge`).
const SURE: f32 = 0.6;
const LIKELY: f32 = 0.3;

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
    /// Pixels of the probability that belong to roads.
    pub fn mask(&self) -> Raster<bool> {
        road_mask(&self.probability, LIKELY, SURE)
    }

    /// Pixels of the probability along a pixel of the picture, whatever the direction.
    pub(super) fn mean_scale(&self) -> f64 {
        (self.scale[0] * self.scale[1]).sqrt()
    }

    /// Points of the centre lines and crossings, in pixels of the picture.
    pub fn roads(&self) -> RoadsSeen {
        let body = RoadBody::new(self.mask());
        let mut points = ridge_points(&body, &self.probability);
        let mut crossings = crossings(&body, &self.probability, &points);
        let [sx, sy] = self.scale;
        for point in &mut points {
            point.pixel = [point.pixel[0] / sx, point.pixel[1] / sy];
            point.width /= self.mean_scale();
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A pale street between lawns, 7 m wide, and a street that joins it.
    fn streets(metres_per_pixel: f64) -> Raster<Rgba> {
        let pixels = (128.0 / metres_per_pixel) as usize;
        let mut state = 5_u32;
        Raster::from_fn(pixels, pixels, |x, y| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let grain = (state >> 28) as u8;
            let (x, y) = (x as f64 * metres_per_pixel, y as f64 * metres_per_pixel);
            if (x - 60.0).abs() < 3.5 || (x > 60.0 && (y - 70.0).abs() < 3.0) {
                [128 + grain, 127 + grain, 126 + grain, 255]
            } else {
                [72 + grain, 98 + grain, 58 + grain, 255]
            }
        })
    }

    #[test]
    fn a_street_is_seen_at_its_place_at_any_scale_with_its_crossing() {
        for metres_per_pixel in [0.25, 0.5, 0.8] {
            let roads = roads_seen(&streets(metres_per_pixel), metres_per_pixel);
            let metres = |pixel: [f64; 2]| pixel.map(|p| p * metres_per_pixel);
            let of_street = |p: &&super::super::RoadPoint| {
                let [x, y] = metres(p.pixel);
                (x - 60.0).abs() < 1.0 && (20.0..108.0).contains(&y) && (y - 70.0).abs() > 10.0
            };
            let street: Vec<_> = roads.points.iter().filter(of_street).collect();
            assert!(
                street.len() as f64 * 0.5 > 50.0,
                "{metres_per_pixel}: {}",
                street.len()
            );
            let mean = street.iter().map(|p| p.width).sum::<f64>() / street.len() as f64;
            assert!((mean * metres_per_pixel - 7.0).abs() < 2.0, "{mean} px");
            let near = roads.crossings.iter().any(|c| {
                let [x, y] = metres(c.pixel);
                (x - 60.0).hypot(y - 70.0) < 5.0 && c.directions.len() == 3
            });
            assert!(near, "{metres_per_pixel}: {:?}", roads.crossings);
        }
    }

    #[test]
    fn nothing_is_seen_in_nothing() {
        assert_eq!(roads_seen(&Raster::filled(90, 70, [0; 4]), 0.5).points, []);
        assert_eq!(
            roads_seen(&Raster::filled(3, 2, [90, 90, 90, 255]), 0.5).points,
            []
        );
    }
}
