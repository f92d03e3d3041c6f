//! Units of PX4's fields.
//!
//! A `ULog` file tells no units. Those given here are what PX4's message definitions (`msg/*.msg`) bind
//! to a name: times, names that end in their unit, and the scaled integers of satellite positions.
//! Every other field has none.

use super::{FieldKind, ValueScale};

/// Endings of names that are their unit.
const ENDINGS: [(&str, &str); 13] = [
    ("_m_s", "m/s"),
    ("_m_s2", "m/s²"),
    ("_rad_s", "rad/s"),
    ("_rad", "rad"),
    ("_deg", "deg"),
    ("_celsius", "°C"),
    ("_celcius", "°C"),
    ("_pa", "Pa"),
    ("_meter", "m"),
    ("_msl_m", "m"),
    ("_ellipsoid_m", "m"),
    ("_mah", "mAh"),
    ("_us", "us"),
];

/// Unit of the field's values, and what the stored number is multiplied by to have it.
pub(super) fn unit_and_scale(
    topic: &str,
    field: &str,
    kind: FieldKind,
) -> (&'static str, ValueScale) {
    if !kind.is_number() {
        return ("", ValueScale::One);
    }
    let is_receiver = matches!(topic, "vehicle_gps_position" | "sensor_gps");
    if is_receiver && kind == FieldKind::I32 {
        match field {
            "lat" | "lon" => return ("deg", ValueScale::Over(1e7)),
            "alt" | "alt_ellipsoid" => return ("m", ValueScale::Over(1e3)),
            _ => {}
        }
    }
    let name = field.rsplit('.').next().unwrap_or(field);
    let name = name.split('[').next().unwrap_or(name);
    if kind == FieldKind::U64 && (name.starts_with("timestamp") || name == "time_utc_usec") {
        return ("us", ValueScale::One);
    }
    let ending = ENDINGS.iter().find(|(ending, _)| name.ends_with(ending));
    ending.map_or(("", ValueScale::One), |(_, unit)| (unit, ValueScale::One))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_end_in_their_unit_have_it() {
        let unit = |field, kind| unit_and_scale("airspeed", field, kind).0;
        assert_eq!(unit("true_airspeed_m_s", FieldKind::F32), "m/s");
        assert_eq!(unit("gyro_rad_s[2]", FieldKind::F32), "rad/s");
        assert_eq!(unit("imu[1].temperature_celsius", FieldKind::F32), "°C");
        assert_eq!(unit("timestamp_sample", FieldKind::U64), "us");
        assert_eq!(unit("confidence", FieldKind::F32), "");
        assert_eq!(unit("format", FieldKind::F32), "");
    }

    #[test]
    fn positions_of_satellite_receivers_are_scaled_integers_or_plain_doubles() {
        let unit = |field, kind| unit_and_scale("sensor_gps", field, kind);
        assert_eq!(unit("lat", FieldKind::I32), ("deg", ValueScale::Over(1e7)));
        assert_eq!(unit("alt", FieldKind::I32), ("m", ValueScale::Over(1e3)));
        assert_eq!(
            unit("latitude_deg", FieldKind::F64),
            ("deg", ValueScale::One)
        );
        assert_eq!(
            unit_and_scale("home", "lat", FieldKind::F64),
            ("", ValueScale::One)
        );
    }
}
