//! Roles of the series of a log in navigation.

mod reading;
mod series;

use serde::{Deserialize, Serialize};

pub(crate) use reading::{
    DEGREE, Meaning, RoleSource, RowCondition, RowReading, condition, field, of,
};
pub use series::RoleSeries;

use pilotage_flight::ChannelName;

/// A quantity that logs name in many ways. Values are SI and radians.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Role {
    /// Airspeed as measured, m/s.
    Airspeed,
    /// Heading, radians clockwise from true north.
    Heading,
    /// Roll, radians, right wing down positive.
    Roll,
    /// Pitch, radians, nose up positive.
    Pitch,
    /// Height above the ground below, metres.
    HeightAboveGround,
    /// Height by air pressure, metres above whatever the log took as zero.
    BarometricHeight,
    /// Latitude by satellite navigation, radians.
    Latitude,
    /// Longitude by satellite navigation, radians.
    Longitude,
    /// Height by satellite navigation, metres above sea level or ellipsoid as the receiver has it.
    GpsHeight,
    /// Velocity over ground northward by satellite navigation, m/s.
    GpsVelocityNorth,
    /// The same eastward, m/s.
    GpsVelocityEast,
    /// The same downward, m/s.
    GpsVelocityDown,
    /// Speed over ground by satellite navigation, m/s.
    GroundSpeed,
    /// Kind of fix: 0 or 1 none, 2 flat, 3 and more in space.
    GpsFix,
    /// Satellites used.
    GpsSatellites,
    /// Turn rate about the nose, rad/s.
    RollRate,
    /// Turn rate about the right wing, rad/s.
    PitchRate,
    /// Turn rate about the belly, rad/s.
    YawRate,
    /// Specific force forward, m/s².
    AccelerationForward,
    /// Specific force to the right, m/s².
    AccelerationRight,
    /// Specific force downward, m/s².
    AccelerationDown,
    /// Velocity of the air northward as the autopilot estimates it, m/s.
    WindNorth,
    /// The same eastward, m/s.
    WindEast,
    /// Latitude as the autopilot estimates it, radians.
    AutopilotLatitude,
    /// Longitude as the autopilot estimates it, radians.
    AutopilotLongitude,
    /// Height as the autopilot estimates it, metres above sea level.
    AutopilotHeight,
}

impl Role {
    /// Every role, in the order in which people read them.
    pub const ALL: [Self; 26] = [
        Self::Airspeed,
        Self::Heading,
        Self::Roll,
        Self::Pitch,
        Self::HeightAboveGround,
        Self::BarometricHeight,
        Self::Latitude,
        Self::Longitude,
        Self::GpsHeight,
        Self::GpsVelocityNorth,
        Self::GpsVelocityEast,
        Self::GpsVelocityDown,
        Self::GroundSpeed,
        Self::GpsFix,
        Self::GpsSatellites,
        Self::RollRate,
        Self::PitchRate,
        Self::YawRate,
        Self::AccelerationForward,
        Self::AccelerationRight,
        Self::AccelerationDown,
        Self::WindNorth,
        Self::WindEast,
        Self::AutopilotLatitude,
        Self::AutopilotLongitude,
        Self::AutopilotHeight,
    ];

    /// Name for people.
    pub fn label(self) -> &'static str {
        match self {
            Self::Airspeed => "Airspeed",
            Self::Heading => "Heading",
            Self::Roll => "Roll",
            Self::Pitch => "Pitch",
            Self::HeightAboveGround => "Height above ground",
            Self::BarometricHeight => "Barometric height",
            Self::Latitude => "Latitude",
            Self::Longitude => "Longitude",
            Self::GpsHeight => "GPS height",
            Self::GpsVelocityNorth => "GPS velocity north",
            Self::GpsVelocityEast => "GPS velocity east",
            Self::GpsVelocityDown => "GPS velocity down",
            Self::GroundSpeed => "Ground speed",
            Self::GpsFix => "GPS fix",
            Self::GpsSatellites => "GPS satellites",
            Self::RollRate => "Roll rate",
            Self::PitchRate => "Pitch rate",
            Self::YawRate => "Yaw rate",
            Self::AccelerationForward => "Acceleration forward",
            Self::AccelerationRight => "Acceleration right",
            Self::AccelerationDown => "Acceleration down",
            Self::WindNorth => "Wind north, autopilot",
            Self::WindEast => "Wind east, autopilot",
            Self::AutopilotLatitude => "Latitude, autopilot",
            Self::AutopilotLongitude => "Longitude, autopilot",
            Self::AutopilotHeight => "Height, autopilot",
        }
    }

    /// The unit in which people read it, and how many of it are one in SI and radians.
    pub fn unit(self) -> (&'static str, f64) {
        let degrees = 1.0_f64.to_degrees();
        match self {
            Self::Heading
            | Self::Roll
            | Self::Pitch
            | Self::Latitude
            | Self::Longitude
            | Self::AutopilotLatitude
            | Self::AutopilotLongitude => ("deg", degrees),
            Self::RollRate | Self::PitchRate | Self::YawRate => ("deg/s", degrees),
            Self::HeightAboveGround
            | Self::BarometricHeight
            | Self::GpsHeight
            | Self::AutopilotHeight => ("m", 1.0),
            Self::AccelerationForward | Self::AccelerationRight | Self::AccelerationDown => {
                ("m/s²", 1.0)
            }
            Self::GpsFix | Self::GpsSatellites => ("", 1.0),
            _ => ("m/s", 1.0),
        }
    }

    /// The channel of a flight that it becomes. Places become the track, and the rest of satellite navigation is no
    /// channel.
    pub fn channel(self) -> Option<ChannelName> {
        Some(match self {
            Self::Airspeed => ChannelName::Airspeed,
            Self::Heading => ChannelName::Heading,
            Self::Roll => ChannelName::Roll,
            Self::Pitch => ChannelName::Pitch,
            Self::HeightAboveGround => ChannelName::HeightAboveGround,
            Self::BarometricHeight => ChannelName::BarometricHeight,
            Self::GpsHeight => ChannelName::GpsHeight,
            Self::GpsVelocityNorth => ChannelName::GpsVelocityNorth,
            Self::GpsVelocityEast => ChannelName::GpsVelocityEast,
            Self::GpsVelocityDown => ChannelName::GpsVelocityDown,
            Self::RollRate => ChannelName::RollRate,
            Self::PitchRate => ChannelName::PitchRate,
            Self::YawRate => ChannelName::YawRate,
            Self::AccelerationForward => ChannelName::AccelerationForward,
            Self::AccelerationRight => ChannelName::AccelerationRight,
            Self::AccelerationDown => ChannelName::AccelerationDown,
            Self::WindNorth => ChannelName::WindNorth,
            Self::WindEast => ChannelName::WindEast,
            Self::AutopilotHeight => ChannelName::AutopilotHeight,
            Self::Latitude
            | Self::Longitude
            | Self::GroundSpeed
            | Self::GpsFix
            | Self::GpsSatellites
            | Self::AutopilotLatitude
            | Self::AutopilotLongitude => return None,
        })
    }

    /// The autopilot's estimate of what a satellite receiver measures of a place; `None` of other roles.
    pub fn autopilots_own(self) -> Option<Self> {
        match self {
            Self::Latitude => Some(Self::AutopilotLatitude),
            Self::Longitude => Some(Self::AutopilotLongitude),
            Self::GpsHeight => Some(Self::AutopilotHeight),
            _ => None,
        }
    }

    /// The role of a channel: that which becomes it, and airspeed of either kind as measured.
    pub fn of_channel(name: ChannelName) -> Option<Self> {
        if name == ChannelName::EquivalentAirspeed {
            return Some(Self::Airspeed);
        }
        let mut all = Self::ALL.into_iter();
        all.find(|role| role.channel() == Some(name))
    }

    /// The role that people call so.
    pub fn from_label(label: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|role| role.label() == label)
    }

    /// Whether values are angles that wrap.
    pub fn is_angle(self) -> bool {
        matches!(self, Self::Heading | Self::Roll | Self::Pitch)
    }

    /// Largest amount that anything that flies could have, in SI; what is beyond was not measured.
    pub fn plausible(self) -> f64 {
        use std::f64::consts::{FRAC_PI_2, PI, TAU};
        match self {
            Self::Airspeed
            | Self::GroundSpeed
            | Self::GpsVelocityNorth
            | Self::GpsVelocityEast
            | Self::GpsVelocityDown => 1000.0,
            Self::Heading | Self::Roll | Self::Pitch => TAU,
            Self::HeightAboveGround
            | Self::BarometricHeight
            | Self::GpsHeight
            | Self::AutopilotHeight => 50_000.0,
            Self::Latitude | Self::AutopilotLatitude => FRAC_PI_2,
            Self::Longitude | Self::AutopilotLongitude => PI + 1e-9,
            Self::GpsFix | Self::GpsSatellites => 255.0,
            Self::RollRate | Self::PitchRate | Self::YawRate => 100.0,
            Self::AccelerationForward | Self::AccelerationRight | Self::AccelerationDown => 2000.0,
            Self::WindNorth | Self::WindEast => 150.0,
        }
    }
}
