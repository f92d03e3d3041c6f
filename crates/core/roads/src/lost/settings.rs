//! Ranges within which a view is looked for.

use std::f64::consts::PI;

/// Knowledge before a view is laid on a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LostSettings {
    /// Believed heading of what the view calls ahead, radians clockwise from north.
    pub turn: f64,
    /// Greatest difference from it to either side, radians; π where the heading is unknown.
    pub within_turn: f64,
    /// Standard deviation of the scale as a share: that of the height over the height.
    pub scale: f64,
    /// Probability that the view shows ground of the map, before it is looked at.
    pub on_map: f64,
}

impl Default for LostSettings {
    fn default() -> Self {
        Self {
            turn: 0.0,
            within_turn: PI,
            scale: 0.02,
            on_map: 0.5,
        }
    }
}
