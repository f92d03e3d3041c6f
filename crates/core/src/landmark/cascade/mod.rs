//! Boosted cascades (Viola and Jones): detectors that were trained, run over pictures.
//!
//! A window is shown to one stage after the other; each sums the votes of its trees and lets the window
//! pass or ends it, and nearly all end in the first ones. DeAngelo 2016, section 3.3, finds his
//! landmarks with them.

mod error;
mod group;
mod integral;
mod model;
mod read;
mod scale;
mod scan;
mod xml;

pub use error::CascadeError;
pub use group::{Group, group};
pub use model::{Cascade, Feature, HaarFeature, Stage};
pub use scan::{Rectangle, ScanSettings, Scanned, scan};
