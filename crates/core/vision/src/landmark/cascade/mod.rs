//! Boosted cascades (Viola and Jones): detectors that were trained, run over pictures.
//!
//! A window is shown to one stage after the other; each sums the votes of its trees and lets the window
//! pass or ends it, and nearly all end in the first ones. DeAngelo 2016, chapter 3, finds his
//! landmarks with them.

mod answers;
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
mod refine;
mod responses;
mod rows;
mod scale;
mod scan;
mod simd;
mod suppress;
#[cfg(test)]
mod tests;
mod trace;
pub mod train;
#[cfg(test)]
mod twin;
mod write;
mod xml;

pub use answers::{FeatureAnswer, stage_answers};
pub use build::{NodeSplit, TrainedNode, TrainedStage, TrainedTree};
pub use error::CascadeError;
pub use group::{WindowGroup, group};
pub use model::{Area, Cascade, CascadeFeature, CascadeKind, HaarFeature, Stage};
pub use patch::{Patch, PatchEvaluator, feature_codes, feature_values};
pub use refine::{Refined, refined};
pub use responses::{Responses, responses};
pub use scan::{Rectangle, ScanSettings, Scanned, scan};
pub use suppress::{Suppressed, soft_suppressed};
pub use trace::{HogPicture, ShownFeature, Trace, edge_angle, hog_picture, stage_features, trace};
