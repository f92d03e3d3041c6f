//! Units of fields of well-known messages.
//!
//! A schema tells no units. Those given here are what the packages of ROS (REP 103: SI units) and the
//! schemas of Foxglove bind to a name; PX4's messages keep theirs. Every other field has none.

use crate::log::growing::FieldUnit;
use crate::log::schema::{plain, px4_topic};
use crate::log::{FieldKind, ValueScale, px4_units};

/// Packages whose messages follow REP 103, and the schemas of Foxglove.
const PACKAGES: [&str; 5] = [
    "sensor_msgs/",
    "geometry_msgs/",
    "nav_msgs/",
    "mavros_msgs/",
    "foxglove/",
];

/// Names of vectors with what their parts are measured in.
const VECTORS: [(&str, &str); 8] = [
    ("angular_velocity", "rad/s"),
    ("linear_acceleration", "m/s²"),
    ("magnetic_field", "T"),
    ("angular", "rad/s"),
    ("linear", "m/s"),
    ("position", "m"),
    ("translation", "m"),
    ("velocity", "m/s"),
];

/// Names of numbers with what they are measured in.
const NUMBERS: [(&str, &str); 11] = [
    ("latitude", "deg"),
    ("longitude", "deg"),
    ("altitude", "m"),
    ("fluid_pressure", "Pa"),
    ("temperature", "°C"),
    ("airspeed", "m/s"),
    ("groundspeed", "m/s"),
    ("climb", "m/s"),
    ("monotonic", "m"),
    ("relative", "m"),
    ("bottom_clearance", "m"),
];

/// Units of the fields of messages of a schema.
pub(super) fn units_of(schema: &str) -> FieldUnit {
    let schema = schema.to_owned();
    Box::new(move |path, kind| {
        let (unit, scale) = unit_and_scale(&schema, path, kind);
        (unit.to_owned(), scale)
    })
}

/// Unit of the values of a field, and what the stored number is multiplied by to have it.
fn unit_and_scale(schema: &str, path: &str, kind: FieldKind) -> (&'static str, ValueScale) {
    if let Some(topic) = px4_topic(schema) {
        return px4_units::unit_and_scale(&topic, path, kind);
    }
    let schema = plain(schema);
    let is_known = PACKAGES.iter().any(|package| schema.starts_with(package));
    if !is_known || !kind.is_number() {
        return ("", ValueScale::One);
    }
    let mut parts = path.rsplit('.');
    let last = parts.next().unwrap_or_default();
    let unit = if matches!(last, "x" | "y" | "z") {
        let vector = parts.next().unwrap_or_default();
        VECTORS.iter().find(|(name, _)| *name == vector)
    } else {
        NUMBERS.iter().find(|(name, _)| *name == last)
    };
    (unit.map_or("", |(_, unit)| *unit), ValueScale::One)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_and_numbers_of_well_known_messages_have_units() {
        let unit = |schema, path| unit_and_scale(schema, path, FieldKind::F64).0;
        assert_eq!(unit("sensor_msgs/msg/Imu", "angular_velocity.x"), "rad/s");
        assert_eq!(unit("geometry_msgs/TwistStamped", "twist.linear.z"), "m/s");
        assert_eq!(unit("foxglove.LocationFix", "latitude"), "deg");
        assert_eq!(unit("sensor_msgs/msg/Imu", "orientation.x"), "");
        assert_eq!(unit("my_msgs/msg/Imu", "angular_velocity.x"), "");
    }

    #[test]
    fn messages_of_px4_have_the_units_of_its_logs() {
        let (unit, scale) = unit_and_scale("px4_msgs/msg/SensorGps", "lat", FieldKind::I32);
        assert_eq!((unit, scale), ("deg", ValueScale::Over(1e7)));
    }
}
