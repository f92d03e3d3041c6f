//! Files that are saved: the mission, the run, and what other programs read.

mod feature;
mod missing;
mod mission_file;
mod places;
mod track;

pub use feature::ExportsFeature;
