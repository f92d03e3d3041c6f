//! Landmarks found by the orientation field of their map patch, for maps of another date or sensor.
//!
//! What stays from one date to the next is where edges run and how (see
//! [`pilotage_raster::raster::OrientationField`]). The patch is correlated with the rectified picture at every
//! place, turn and size that the prior allows, and each gets a likelihood against chance as whole frames do
//! ([`crate::evidence::Evidence`]). Likelihood times prior, over all of them, over what the picture does not show
//! and over the landmark's not being there any more, is the probability by which a place is believed.

mod detector;
mod patch;
mod rehearsal;
mod twins;
mod variants;
mod weighed;

pub use detector::LEAST_PROBABILITY;
pub(super) use detector::OrientedDetector;
pub(super) use rehearsal::rehearse;

#[cfg(test)]
mod tests;
