//! A time-stamped series of one quantity.

use serde::{Deserialize, Serialize};

/// The quantities that the navigator knows by name; everything in SI and radians.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum ChannelName {
    /// True airspeed, m/s.
    Airspeed,
    /// Heading, radians clockwise from true north.
    Heading,
    /// Roll, radians, right wing down positive.
    Roll,
    /// Pitch, radians, nose up positive.
    Pitch,
    /// Height above the ground plane, metres.
    HeightAboveGround,
    /// Position by satellite navigation, metres north of the origin.
    GpsNorth,
    /// Position by satellite navigation, metres east of the origin.
    GpsEast,
}

impl ChannelName {
    /// Every name, in the order in which people read them.
    pub const ALL: [Self; 7] = [
        Self::Airspeed,
        Self::Heading,
        Self::Roll,
        Self::Pitch,
        Self::HeightAboveGround,
        Self::GpsNorth,
        Self::GpsEast,
    ];

    /// Name in files.
    pub fn key(self) -> &'static str {
        match self {
            Self::Airspeed => "airspeed",
            Self::Heading => "heading",
            Self::Roll => "roll",
            Self::Pitch => "pitch",
            Self::HeightAboveGround => "height_above_ground",
            Self::GpsNorth => "gps_north",
            Self::GpsEast => "gps_east",
        }
    }

    /// Whether values are angles that wrap.
    pub fn is_angle(self) -> bool {
        matches!(self, Self::Heading | Self::Roll | Self::Pitch)
    }
}

/// A series of samples of one quantity in time order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Channel {
    /// Which quantity.
    pub name: ChannelName,
    /// Seconds in the flight's time base, not decreasing.
    pub times: Vec<f64>,
    /// Values in SI and radians, one per time.
    pub values: Vec<f64>,
}

impl Channel {
    /// The last value at or before `time`, or `None` before the first.
    pub fn latest(&self, time: f64) -> Option<f64> {
        let after = self.times.partition_point(|t| *t <= time + 1e-9);
        after.checked_sub(1).map(|i| self.values[i])
    }

    /// The value at `time` by linear interpolation (the short way round for angles), held at the ends.
    pub fn interpolated(&self, time: f64) -> Option<f64> {
        let after = self.times.partition_point(|t| *t <= time);
        if after == 0 {
            return self.values.first().copied();
        }
        let (t0, v0) = (self.times[after - 1], self.values[after - 1]);
        let Some((&t1, &v1)) = self.times.get(after).zip(self.values.get(after)) else {
            return Some(v0);
        };
        let fraction = if t1 > t0 {
            (time - t0) / (t1 - t0)
        } else {
            0.0
        };
        let step = if self.name.is_angle() {
            crate::frames::wrap_pi(v1 - v0)
        } else {
            v1 - v0
        };
        let value = v0 + fraction * step;
        Some(if self.name.is_angle() {
            crate::frames::wrap_pi(value)
        } else {
            value
        })
    }
}
