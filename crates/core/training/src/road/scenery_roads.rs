//! Roads of the generated world.

use pilotage_base::frames::GroundPoint;
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::Raster;
use pilotage_simulate::simulate::scenery::{SceneKind, Scenery};

use super::example::{RoadExample, RoadTruth};

/// A window of generated scenery: roads and tracks, with car parks and yards unknown.
pub fn scenery_roads(scenery: &Scenery, window: &Window) -> RoadExample {
    let mut truth = Raster::filled(window.width, window.height, RoadTruth::Open);
    let labels = scenery.labels(&window.rect());
    let of = |kinds: &'static [SceneKind]| labels.iter().filter(|l| kinds.contains(&l.kind));
    for label in of(&[SceneKind::CarPark, SceneKind::Yard]) {
        fill(&mut truth, window, &label.polygon, RoadTruth::Unknown);
    }
    for label in of(&[SceneKind::Road, SceneKind::Track, SceneKind::Crossing]) {
        fill(&mut truth, window, &label.polygon, RoadTruth::Road);
    }
    RoadExample {
        picture: scenery.window(window),
        truth,
    }
}

/// Sets the pixels whose middle lies in a polygon.
fn fill(truth: &mut Raster<RoadTruth>, window: &Window, polygon: &[GroundPoint], value: RoadTruth) {
    let corners: Vec<(f64, f64)> = polygon.iter().map(|p| window.pixel_at(p)).collect();
    let low = |values: &dyn Fn(&(f64, f64)) -> f64, size: usize| {
        let least = corners.iter().map(values).fold(f64::INFINITY, f64::min);
        let most = corners.iter().map(values).fold(f64::NEG_INFINITY, f64::max);
        least.floor().clamp(0.0, size as f64) as usize..most.ceil().clamp(0.0, size as f64) as usize
    };
    let columns = low(&|c| c.0, window.width);
    for row in low(&|c| c.1, window.height) {
        for column in columns.clone() {
            let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
            let mut inside = false;
            for (i, &(ax, ay)) in corners.iter().enumerate() {
                let (bx, by) = corners[(i + 1) % corners.len()];
                if (ay > y) != (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax) {
                    inside = !inside;
                }
            }
            if inside {
                truth.set(column, row, value);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_simulate::simulate::scenery::{DEMO_SEED, Day};

    /// The straight piece of South Road from (-40, 230) to (-720, -450) of the plan is turned by half a turn.
    #[test]
    fn south_road_is_road_and_the_field_beside_it_is_not() {
        let scenery = Scenery::new(DEMO_SEED, Day::map_day());
        let window = Window {
            north_edge: 400.0,
            west_edge: 90.0,
            gsd: 1.0,
            width: 40,
            height: 40,
        };
        let example = scenery_roads(&scenery, &window);
        let at = |north: f64, east: f64| {
            let (x, y) = window.pixel_at(&GroundPoint::new(north, east));
            example.truth.get(x as usize, y as usize)
        };
        // The road runs north-east there.
        assert_eq!(at(380.0, 110.0), RoadTruth::Road);
        assert_eq!(at(390.0, 120.0), RoadTruth::Road);
        assert_eq!(at(388.5, 101.5), RoadTruth::Open);
        assert_eq!(at(371.5, 118.5), RoadTruth::Open);
    }
}
