//! Straight edges as generic landmarks: ends of roofs, roads and fields of which no class is told.
//!
//! One edge says nothing, and neither end of it is sure; dozens of a picture fit in one place of the map's table.
//! What they say is a soft sum over all of them ([`place_by_edges`]), not a set of pairs.

mod field;
mod photo;
mod place;
mod seen;
#[cfg(test)]
mod tests;

pub use field::EdgeField;
pub use photo::{PhotoBelief, PhotoEdges, PhotoEdgesError};
pub use place::{EdgePlace, EdgePrior, place_by_edges};
pub use seen::{EDGE, EDGE_GSD, EDGES, edges_in_map, edges_of_tile, edges_seen};
