//! A photo in its flight.

use super::read::Photo;

/// A photo with its time in the flight, seconds.
pub(super) struct TimedPhoto {
    pub time: f64,
    pub photo: Photo,
}
