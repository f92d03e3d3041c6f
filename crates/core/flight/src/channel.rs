//! A time-stamped series of one quantity.

use serde::{Deserialize, Serialize};

/// Physical quantity of a channel; its values are in the SI unit of this.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Quantity {
    /// Metres.
    Length,
    /// Metres a second.
    Speed,
    /// Radians.
    Angle,
    /// Radians a second.
    AngularRate,
    /// Metres a second squared.
    Acceleration,
}

impl Quantity {
    /// Its SI unit, as people write it.
    ///
    /// ```
    /// use pilotage_flight::{ChannelName, Quantity};
    ///
    /// assert_eq!(Quantity::AngularRate.unit(), "rad/s");
    /// assert_eq!(ChannelName::Airspeed.quantity().unit(), "m/s");
    /// ```
    pub fn unit(self) -> &'static str {
        match self {
            Self::Length => "m",
            Self::Speed => "m/s",
            Self::Angle => "rad",
            Self::AngularRate => "rad/s",
            Self::Acceleration => "m/s²",
        }
    }
}

macro_rules! channels {
    ($($(#[$doc:meta])* $variant:ident = $key:literal, $quantity:ident;)+) => {
        /// The quantities that the program knows by name; everything in SI and radians.
        ///
        /// Heights are above sea level unless the name says otherwise. Forward, right and down are the
        /// axes of the body.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
        pub enum ChannelName {
            $($(#[$doc])* $variant,)+
        }

        impl ChannelName {
            /// Every name, in the order in which people read them.
            pub const ALL: [Self; [$($key),+].len()] = [$(Self::$variant),+];

            /// Name in files.
            pub fn key(self) -> &'static str {
                match self {
                    $(Self::$variant => $key,)+
                }
            }

            /// Physical quantity of the channel.
            pub fn quantity(self) -> Quantity {
                match self {
                    $(Self::$variant => Quantity::$quantity,)+
                }
            }
        }
    };
}

channels! {
    /// True airspeed, m/s.
    Airspeed = "airspeed", Speed;
    /// Heading, radians clockwise from true north.
    Heading = "heading", Angle;
    /// Roll, radians, right wing down positive.
    Roll = "roll", Angle;
    /// Pitch, radians, nose up positive.
    Pitch = "pitch", Angle;
    /// Height above the ground plane, metres.
    HeightAboveGround = "height_above_ground", Length;
    /// Position by satellite navigation, metres north of the origin.
    GpsNorth = "gps_north", Length;
    /// Position by satellite navigation, metres east of the origin.
    GpsEast = "gps_east", Length;
    /// Height by satellite navigation, metres.
    GpsHeight = "gps_height", Length;
    /// Velocity over ground by satellite navigation, m/s north.
    GpsVelocityNorth = "gps_velocity_north", Speed;
    /// Velocity over ground by satellite navigation, m/s east.
    GpsVelocityEast = "gps_velocity_east", Speed;
    /// Velocity by satellite navigation, m/s down.
    GpsVelocityDown = "gps_velocity_down", Speed;
    /// Velocity over ground by other means than satellites (motion capture, optical flow), m/s north.
    VelocityNorth = "velocity_north", Speed;
    /// Velocity over ground by other means than satellites, m/s east.
    VelocityEast = "velocity_east", Speed;
    /// Turn rate about the forward axis, rad/s, right wing going down positive.
    RollRate = "roll_rate", AngularRate;
    /// Turn rate about the right axis, rad/s, nose going up positive.
    PitchRate = "pitch_rate", AngularRate;
    /// Turn rate about the down axis, rad/s, nose going right positive.
    YawRate = "yaw_rate", AngularRate;
    /// Reading of an accelerometer along the forward axis, m/s²: acceleration without gravity.
    AccelerationForward = "acceleration_forward", Acceleration;
    /// Reading of an accelerometer along the right axis, m/s².
    AccelerationRight = "acceleration_right", Acceleration;
    /// Reading of an accelerometer along the down axis, m/s²; -9.8 in level flight.
    AccelerationDown = "acceleration_down", Acceleration;
    /// Height by air pressure, metres above whatever the barometer was set to.
    BarometricHeight = "barometric_height", Length;
    /// Equivalent airspeed, m/s: what the pressure would mean at sea level in the standard atmosphere.
    EquivalentAirspeed = "equivalent_airspeed", Speed;
    /// Wind as the autopilot estimated it: velocity of the air, m/s north.
    WindNorth = "wind_north", Speed;
    /// Wind as the autopilot estimated it: velocity of the air, m/s east.
    WindEast = "wind_east", Speed;
    /// Position as the autopilot estimated it, metres north of the origin.
    AutopilotNorth = "autopilot_north", Length;
    /// Position as the autopilot estimated it, metres east of the origin.
    AutopilotEast = "autopilot_east", Length;
    /// Height as the autopilot estimated it, metres above sea level.
    AutopilotHeight = "autopilot_height", Length;
    /// Heading by the earth's magnetic field alone, radians clockwise from true north: the declination is taken out.
    MagneticHeading = "magnetic_heading", Angle;
    /// Distance to the ground along the body's down axis, by laser or radar, metres.
    GroundRange = "ground_range", Length;
}

impl ChannelName {
    /// Whether it is of an inertial sensor: much faster than everything else, and nothing to look at.
    ///
    /// ```
    /// use pilotage_flight::ChannelName;
    ///
    /// assert!(ChannelName::YawRate.is_inertial());
    /// assert!(!ChannelName::Heading.is_inertial());
    /// // Six of all: three rates, three accelerations.
    /// assert_eq!(ChannelName::ALL.iter().filter(|name| name.is_inertial()).count(), 6);
    /// ```
    pub fn is_inertial(self) -> bool {
        matches!(
            self.quantity(),
            Quantity::AngularRate | Quantity::Acceleration
        )
    }

    /// Whether values are angles that wrap.
    pub fn is_angle(self) -> bool {
        self.quantity() == Quantity::Angle
    }
}

/// A series of samples of one quantity in time order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Channel {
    /// Name of the quantity.
    pub name: ChannelName,
    /// Seconds in the flight's time base, not decreasing.
    pub times: Vec<f64>,
    /// Values in SI and radians, one per time.
    pub values: Vec<f64>,
}

impl Channel {
    /// The last value at or before `time`, or `None` before the first.
    ///
    /// ```
    /// use pilotage_flight::{Channel, ChannelName};
    ///
    /// let (times, values) = (vec![1.0, 2.0], vec![20.0, 21.0]);
    /// let airspeed = Channel { name: ChannelName::Airspeed, times, values };
    /// assert_eq!(airspeed.latest(1.9), Some(20.0));
    /// assert_eq!(airspeed.latest(0.5), None);
    /// ```
    pub fn latest(&self, time: f64) -> Option<f64> {
        let after = self.times.partition_point(|t| *t <= time + 1e-9);
        after.checked_sub(1).map(|i| self.values[i])
    }

    /// The value at `time` by linear interpolation (the short way round for angles), held at the ends.
    ///
    /// ```
    /// use pilotage_flight::{Channel, ChannelName};
    ///
    /// // From 350° to 10°: half way lies north, not south.
    /// let values = [350_f64, 10.0].map(f64::to_radians).to_vec();
    /// let heading = Channel { name: ChannelName::Heading, times: vec![0.0, 2.0], values };
    /// let half_way = heading.interpolated(1.0).ok_or("no samples")?;
    /// assert!(half_way.abs() < 1e-12);
    /// # Ok::<(), &str>(())
    /// ```
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
            pilotage_base::frames::wrap_pi(v1 - v0)
        } else {
            v1 - v0
        };
        let value = v0 + fraction * step;
        Some(if self.name.is_angle() {
            pilotage_base::frames::wrap_pi(value)
        } else {
            value
        })
    }
}
