//! Boosted cascades (Viola and Jones): detectors that were trained, run over pictures.
//!
//! A window is shown to one stage after the other; each sums the votes of its trees and lets the window
//! pass or ends it, and nearly all end in the first ones. DeAngelo 2016, section 3.3, finds his
//! landmarks with them.

mod binary;
mod build;
mod check;
mod error;
mod grid;
mod group;
mod histograms;
mod integral;
mod layout;
mod model;
mod patch;
mod read;
mod responses;
mod rows;
mod scale;
mod scan;
mod simd;
#[cfg(test)]
mod tests;
pub mod train;
#[cfg(test)]
mod twin;
mod write;
mod xml;

pub use build::{Split, TrainedNode, TrainedStage, TrainedTree};
pub use error::CascadeError;
pub use group::{Group, group};
pub use model::{Area, Cascade, Feature, HaarFeature, Kind, Stage};
pub use patch::{Evaluator, Patch, feature_codes, feature_values};
pub use responses::{Responses, responses};
pub use scan::{Rectangle, ScanSettings, Scanned, scan};
