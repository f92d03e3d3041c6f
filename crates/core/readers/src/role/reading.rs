//! A place where a role may be found, and how it is read there.

use super::Role;

pub(crate) const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Way to make a value of the fields of a row.
///
/// Those of ROS have the world's axes east, north, up and the body's forward, left, up (REP 103, REP 105).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RowReading {
    /// A field; the factor to SI counts where the log states no unit itself.
    Field(&'static str, f64),
    /// A field as above, of topics that have the second one as well.
    FieldBeside(&'static str, f64, &'static str),
    /// An angle of the attitude that takes body to world, as a quaternion in the fields `name[0]` to
    /// `name[3]` or `name1` to `name4`, the real part first.
    Quaternion(&'static str),
    /// The north or east part of a speed along a course: speed with its factor, course with its factor.
    Course(&'static str, f64, &'static str, f64),
    /// The north or east part of the air's velocity from the direction that wind comes from, with the
    /// factor of the direction, and its speed.
    WindFrom(&'static str, f64, &'static str),
    /// An angle of the attitude that takes body to world after ROS, as a quaternion in the fields `name.x` to
    /// `name.w`.
    RosQuaternion(&'static str),
    /// A kind of fix: none where the field is negative.
    RosFix(&'static str),
    /// The height at which the standard atmosphere has the pressure of a field, Pa.
    Pressure(&'static str),
    /// A part of the place that `ArduPilot` means by the fields `PN`, `PE` and `PD`: metres north, east and below the
    /// origin of its filter, which stands in rows of their own (`ORGN`).
    FromOrigin,
}

/// A place where a role may be found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoleSource {
    /// The role.
    pub role: Role,
    /// Name of the topic, whichever instance comes first; or the [kind](crate::log::Topic::kind) of its
    /// rows, and after an `@` what has to stand in its name.
    pub topic: &'static str,
    /// Reading of a row.
    pub reading: RowReading,
}

pub(crate) const fn field(
    role: Role,
    topic: &'static str,
    name: &'static str,
    factor: f64,
) -> RoleSource {
    RoleSource {
        role,
        topic,
        reading: RowReading::Field(name, factor),
    }
}

pub(crate) const fn of(role: Role, topic: &'static str, reading: RowReading) -> RoleSource {
    RoleSource {
        role,
        topic,
        reading,
    }
}

/// A field beside values without which they are none: that says whether the sensor knew them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RowCondition {
    /// Name of the topic, or the [kind](crate::log::Topic::kind) of its rows.
    pub topic: &'static str,
    /// Beginning of the names of the values.
    pub values: &'static str,
    /// The field; logs without it do not say.
    pub field: &'static str,
    /// Least and greatest number of the field beside values that count.
    pub range: [f64; 2],
    /// Number that counts in logs where no row has one of the range.
    pub stand_in: Option<f64>,
}

impl RowCondition {
    /// The condition with a number that counts where no row of the log has one of the range.
    pub(crate) const fn or(self, stand_in: f64) -> Self {
        Self {
            stand_in: Some(stand_in),
            ..self
        }
    }
}

pub(crate) const fn condition(
    topic: &'static str,
    values: &'static str,
    field: &'static str,
    range: [f64; 2],
) -> RowCondition {
    RowCondition {
        topic,
        values,
        field,
        range,
        stand_in: None,
    }
}

/// Meaning of a format's topics for a flight.
#[derive(Clone, Copy)]
pub struct Meaning {
    /// Tables of the places where roles may be found, for each role the best first.
    pub roles: &'static [&'static [RoleSource]],
    /// Topics that tell photos, and of each its field that is 0 for a photo that was not taken, if there is one. The surest
    /// stand first: that the shutter opened, before that it was asked to.
    pub triggers: &'static [(&'static str, &'static str)],
    /// Fields that say of rows whether their values were measured.
    pub conditions: &'static [RowCondition],
    /// Whether the instances of topics are the systems that send them, and components of those.
    pub has_systems: bool,
}
