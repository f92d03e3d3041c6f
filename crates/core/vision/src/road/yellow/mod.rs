//! Roads by their yellow paint: colour, dilation, long thin blobs, straight lines.
//!
//! `DeAngelo` 2016, chapter 3, eqs (1)-(4). Bins, gaps and least lengths of the lines are not given there; they are the
//! defaults of the functions that it names.

mod blobs;
mod colour;
mod hough;
mod rule;

pub use blobs::{BlobShape, blobs, dilated};
pub use colour::{HueSaturationValue, hue_saturation_value};
pub use hough::{HoughAccumulator, HoughPeak, LineSegment};
pub use rule::{YellowLineRule, YellowLines};
