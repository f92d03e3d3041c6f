//! Names of schemas.

/// Plain name of a schema, whichever ROS or encoding it came by: `sensor_msgs/Imu` for `sensor_msgs/msg/Imu`,
/// `foxglove/LocationFix` for `foxglove.LocationFix` and `foxglove_msgs/msg/LocationFix`, and PX4's messages as in
/// its own logs, `vehicle_attitude` for `px4_msgs/msg/VehicleAttitude`.
pub(super) fn plain(schema: &str) -> String {
    if let Some(topic) = px4_topic(schema) {
        return topic;
    }
    let name = schema.replacen("/msg/", "/", 1);
    match name
        .strip_prefix("foxglove.")
        .or(name.strip_prefix("foxglove_msgs/"))
    {
        Some(name) => format!("foxglove/{name}"),
        None => name,
    }
}

/// Name of a message of PX4 in its own logs; `None` for those of others.
pub(super) fn px4_topic(schema: &str) -> Option<String> {
    let name = schema.strip_prefix("px4_msgs/")?;
    let name = name.strip_prefix("msg/").unwrap_or(name);
    let mut topic = String::with_capacity(name.len() + 4);
    for letter in name.chars() {
        if letter.is_ascii_uppercase() && !topic.is_empty() {
            topic.push('_');
        }
        topic.push(letter.to_ascii_lowercase());
    }
    Some(topic)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_message_has_one_name_whatever_it_came_by() {
        for (schema, name) in [
            ("sensor_msgs/msg/Imu", "sensor_msgs/Imu"),
            ("sensor_msgs/Imu", "sensor_msgs/Imu"),
            ("foxglove.LocationFix", "foxglove/LocationFix"),
            ("foxglove_msgs/msg/LocationFix", "foxglove/LocationFix"),
            ("px4_msgs/msg/VehicleGpsPosition", "vehicle_gps_position"),
            ("px4_msgs/SensorGps", "sensor_gps"),
            ("", ""),
        ] {
            assert_eq!(plain(schema), name);
        }
    }
}
