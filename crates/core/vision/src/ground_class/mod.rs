//! Classes of the ground, seen from above: a probability of each class for every cell of a metre or two.
//!
//! Colour, brightness, texture and direction at several scales, by integral images, go into a small network whose
//! weights lie beside this file (`pilotage classes train` makes them).

mod cover;
mod cover_map;
mod features;
mod ground_picture;
mod network;
mod planes;
#[cfg(test)]
mod tests;

pub use cover::GroundCover;
pub use cover_map::{CoverMap, classify_ground};
pub use features::{CoverFeatures, FEATURES};
pub use ground_picture::{ground_picture, ground_window};
pub use network::{CoverNetwork, CoverNetworkError, HIDDEN};

/// Ground in a pixel of pictures that are to be classified, metres.
pub const CLASS_GSD: f64 = 0.75;
/// Pixels along a side of a cell.
pub const CELL_PIXELS: usize = 2;
