//! The faults of instruments that a plan can name.

use serde::{Deserialize, Serialize};

/// Fault of an instrument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum FaultKind {
    /// None.
    None,
    /// The airspeed stays as it is.
    AirspeedStuck,
    /// No airspeed comes any more.
    AirspeedSilent,
    /// No heading comes any more.
    HeadingSilent,
    /// The heading is turned.
    HeadingTurned,
    /// No height comes any more.
    HeightSilent,
    /// Pictures show what was some time before.
    CameraLate,
}

impl FaultKind {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::None,
        Self::AirspeedStuck,
        Self::AirspeedSilent,
        Self::HeadingSilent,
        Self::HeadingTurned,
        Self::HeightSilent,
        Self::CameraLate,
    ];

    /// Name in plans.
    pub fn key(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::AirspeedStuck => "airspeed-stuck",
            Self::AirspeedSilent => "airspeed-silent",
            Self::HeadingSilent => "heading-silent",
            Self::HeadingTurned => "heading-turned",
            Self::HeightSilent => "height-silent",
            Self::CameraLate => "camera-late",
        }
    }
}
