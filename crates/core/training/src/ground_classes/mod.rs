//! Classes of the ground, learned from labelled tiles: those of the generated country, or people's own.

mod examples;
mod generated;
mod judge;
mod label_grid;
mod looks;
mod pair_counts;
mod place_errors;
#[cfg(test)]
mod tests;
mod train;

pub use examples::{ClassExamples, LabelledTile};
pub use generated::{GeneratedTiles, generated_tile};
pub use judge::CoverJudgement;
pub use looks::GeneratedLooks;
pub use pair_counts::{PairCounts, RightPairs};
pub use place_errors::PlaceErrors;
pub use train::{ClassTraining, ClassTrainingError};
