//! Detectors trained from the map, and how well they do where they were not trained.

pub mod evaluation;
