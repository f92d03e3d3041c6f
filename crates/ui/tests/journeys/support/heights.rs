//! Heights of invented ground.

use pilotage_core::frames::GroundPoint;
use pilotage_core::imagery::terrain::{HeightDatum, HeightGrid, Terrain};
use pilotage_jobs::HeightsOrder;

/// Ground of a shape.
struct Shaped(fn(&GroundPoint) -> f64, HeightDatum);

impl Terrain for Shaped {
    fn name(&self) -> &'static str {
        "ridge.tif"
    }
    fn datum(&self) -> &HeightDatum {
        &self.1
    }
    fn height_at(&self, place: &GroundPoint) -> Option<f64> {
        Some(self.0(place))
    }
}

/// The heights of ground of a shape.
pub fn heights(shape: fn(&GroundPoint) -> f64, order: &HeightsOrder) -> HeightGrid {
    let datum = HeightDatum::MeanSeaLevel("EGM96".into());
    let mut grid = HeightGrid::over("ridge.tif", datum.clone(), order.area, 10.0, 640);
    let shaped = Shaped(shape, datum);
    while !grid.take_rows(&shaped, 64) {}
    grid
}
