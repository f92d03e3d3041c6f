//! The form of a roof.

use super::shape::Spot;

/// Form of a roof at a place.
pub(super) struct Face {
    pub(super) slope: Spot,
    pub(super) height: f32,
    /// Metres down from the ridge, measured level.
    pub(super) down: f32,
    /// Metres along the eaves.
    pub(super) along: f32,
    /// Share of steep glazing (saw teeth).
    pub(super) glazing: f32,
    /// Distance to a ridge or hip, metres.
    pub(super) ridge: f32,
}
