//! Roads of the generated world.

use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::Raster;
use pilotage_simulate::simulate::scenery::{SceneKind, Scenery};

use super::example::{RoadExample, RoadTruth};
use crate::polygon::for_spans_inside;

/// A window of generated scenery: roads and tracks, with car parks and yards unknown.
pub fn scenery_roads(scenery: &Scenery, window: &Window) -> RoadExample {
    let mut truth = Raster::filled(window.width, window.height, RoadTruth::Open);
    let labels = scenery.labels(&window.rect());
    let mut mark = |kinds: &[SceneKind], value: RoadTruth| {
        for label in labels.iter().filter(|label| kinds.contains(&label.kind)) {
            for_spans_inside(&label.polygon, window, &mut |row, columns| {
                columns.for_each(|column| truth.set(column, row, value));
            });
        }
    };
    let roads = [SceneKind::Road, SceneKind::Track, SceneKind::Crossing];
    mark(&[SceneKind::CarPark, SceneKind::Yard], RoadTruth::Unknown);
    mark(&roads, RoadTruth::Road);
    RoadExample {
        picture: scenery.window(window),
        truth,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_base::frames::GroundPoint;
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
