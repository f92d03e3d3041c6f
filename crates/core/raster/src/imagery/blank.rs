//! Ground of which there is no picture.

use super::{Imagery, Window};
use crate::raster::{Raster, Rgba};
use pilotage_base::frames::GroundRect;

/// No picture anywhere: for flights that are looked at without a map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Blank;

impl Imagery for Blank {
    fn name(&self) -> &'static str {
        "No map"
    }

    fn bounds(&self) -> GroundRect {
        GroundRect {
            north: 0.0,
            south: 0.0,
            west: 0.0,
            east: 0.0,
        }
    }

    fn native_gsd(&self) -> f64 {
        1.0
    }

    fn window(&self, window: &Window) -> Raster<Rgba> {
        Raster::filled(window.width, window.height, [0; 4])
    }
}
