//! How well a detector does on pictures it was not trained on, with what is not known about it.

mod look;

pub use look::{EvaluatedLook, EvaluatedMark};
