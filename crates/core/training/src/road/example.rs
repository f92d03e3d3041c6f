//! A picture with its roads.

use pilotage_raster::raster::{Raster, Rgba};

/// Truth of one pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RoadTruth {
    /// Something else than a road.
    Open,
    /// A road.
    Road,
    /// Not known, or a matter of taste: nothing is learned from it.
    Unknown,
}

/// A picture at half a metre per pixel, and what is road in it.
#[derive(Clone, Debug, PartialEq)]
pub struct RoadExample {
    /// The picture; its sides are multiples of 4.
    pub picture: Raster<Rgba>,
    /// Truth of each pixel.
    pub truth: Raster<RoadTruth>,
}
