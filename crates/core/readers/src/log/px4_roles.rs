//! Fields of PX4's topics that hold the roles, and those that tell photos: tables to be read, one line a place.

use crate::role::{
    DEGREE, Meaning, Role, RoleSource, RowCondition, RowReading, condition, field, of,
};

/// Meaning of the topics for a flight.
pub(super) const MEANING: Meaning = Meaning {
    roles: &[ROLES],
    triggers: &[("camera_capture", "result"), ("camera_trigger", "feedback")],
    conditions: CONDITIONS,
    has_systems: false,
};

/// `ROTATION_DOWNWARD_FACING` of range sensors, and what PX4 said in its place in the first years of ULog.
const DOWNWARD: f64 = 25.0;
const EARLY_DOWNWARD: f64 = 8.0;

const CONDITIONS: &[RowCondition] = &[
    condition(
        "vehicle_local_position",
        "dist_bottom",
        "dist_bottom_valid",
        [1.0; 2],
    ),
    condition(
        "distance_sensor",
        "current_distance",
        "orientation",
        [DOWNWARD; 2],
    )
    .or(EARLY_DOWNWARD),
    velocity("vehicle_gps_position", "vel_n_m_s"),
    velocity("vehicle_gps_position", "vel_e_m_s"),
    velocity("vehicle_gps_position", "vel_d_m_s"),
    velocity("sensor_gps", "vel_n_m_s"),
    velocity("sensor_gps", "vel_e_m_s"),
    velocity("sensor_gps", "vel_d_m_s"),
];

/// A part of a receiver's velocity, which counts where it says so. Its speed over ground (`vel_m_s`) needs no direction.
const fn velocity(topic: &'static str, part: &'static str) -> RowCondition {
    condition(topic, part, "vel_ned_valid", [1.0; 2])
}

/// Places of the topics, for each role the best first.
pub(super) const ROLES: &[RoleSource] = &[
    field(
        Role::Airspeed,
        "airspeed_validated",
        "true_airspeed_m_s",
        1.0,
    ),
    field(Role::Airspeed, "airspeed", "true_airspeed_m_s", 1.0),
    of(
        Role::Heading,
        "vehicle_attitude",
        RowReading::Quaternion("q"),
    ),
    of(Role::Roll, "vehicle_attitude", RowReading::Quaternion("q")),
    of(Role::Pitch, "vehicle_attitude", RowReading::Quaternion("q")),
    field(
        Role::HeightAboveGround,
        "vehicle_local_position",
        "dist_bottom",
        1.0,
    ),
    field(
        Role::HeightAboveGround,
        "distance_sensor",
        "current_distance",
        1.0,
    ),
    field(
        Role::BarometricHeight,
        "vehicle_air_data",
        "baro_alt_meter",
        1.0,
    ),
    field(
        Role::BarometricHeight,
        "sensor_combined",
        "baro_alt_meter",
        1.0,
    ),
    field(
        Role::Latitude,
        "vehicle_gps_position",
        "latitude_deg",
        DEGREE,
    ),
    field(
        Role::Longitude,
        "vehicle_gps_position",
        "longitude_deg",
        DEGREE,
    ),
    field(
        Role::GpsHeight,
        "vehicle_gps_position",
        "altitude_msl_m",
        1.0,
    ),
    field(Role::Latitude, "vehicle_gps_position", "lat", 1e-7 * DEGREE),
    field(
        Role::Longitude,
        "vehicle_gps_position",
        "lon",
        1e-7 * DEGREE,
    ),
    field(Role::GpsHeight, "vehicle_gps_position", "alt", 1e-3),
    field(Role::Latitude, "sensor_gps", "latitude_deg", DEGREE),
    field(Role::Longitude, "sensor_gps", "longitude_deg", DEGREE),
    field(Role::GpsHeight, "sensor_gps", "altitude_msl_m", 1.0),
    field(Role::Latitude, "sensor_gps", "lat", 1e-7 * DEGREE),
    field(Role::Longitude, "sensor_gps", "lon", 1e-7 * DEGREE),
    field(Role::GpsHeight, "sensor_gps", "alt", 1e-3),
    field(
        Role::GpsVelocityNorth,
        "vehicle_gps_position",
        "vel_n_m_s",
        1.0,
    ),
    field(
        Role::GpsVelocityEast,
        "vehicle_gps_position",
        "vel_e_m_s",
        1.0,
    ),
    field(
        Role::GpsVelocityDown,
        "vehicle_gps_position",
        "vel_d_m_s",
        1.0,
    ),
    field(Role::GpsVelocityNorth, "sensor_gps", "vel_n_m_s", 1.0),
    field(Role::GpsVelocityEast, "sensor_gps", "vel_e_m_s", 1.0),
    field(Role::GpsVelocityDown, "sensor_gps", "vel_d_m_s", 1.0),
    field(Role::GroundSpeed, "vehicle_gps_position", "vel_m_s", 1.0),
    field(Role::GroundSpeed, "sensor_gps", "vel_m_s", 1.0),
    field(Role::GpsFix, "vehicle_gps_position", "fix_type", 1.0),
    field(Role::GpsFix, "sensor_gps", "fix_type", 1.0),
    field(
        Role::GpsSatellites,
        "vehicle_gps_position",
        "satellites_used",
        1.0,
    ),
    field(Role::GpsSatellites, "sensor_gps", "satellites_used", 1.0),
    field(Role::RollRate, "sensor_combined", "gyro_rad[0]", 1.0),
    field(Role::PitchRate, "sensor_combined", "gyro_rad[1]", 1.0),
    field(Role::YawRate, "sensor_combined", "gyro_rad[2]", 1.0),
    field(
        Role::AccelerationForward,
        "sensor_combined",
        "accelerometer_m_s2[0]",
        1.0,
    ),
    field(
        Role::AccelerationRight,
        "sensor_combined",
        "accelerometer_m_s2[1]",
        1.0,
    ),
    field(
        Role::AccelerationDown,
        "sensor_combined",
        "accelerometer_m_s2[2]",
        1.0,
    ),
    field(Role::WindNorth, "wind", "windspeed_north", 1.0),
    field(Role::WindEast, "wind", "windspeed_east", 1.0),
    field(Role::WindNorth, "wind_estimate", "windspeed_north", 1.0),
    field(Role::WindEast, "wind_estimate", "windspeed_east", 1.0),
    field(
        Role::AutopilotLatitude,
        "vehicle_global_position",
        "lat",
        DEGREE,
    ),
    field(
        Role::AutopilotLongitude,
        "vehicle_global_position",
        "lon",
        DEGREE,
    ),
    field(Role::AutopilotHeight, "vehicle_global_position", "alt", 1.0),
];
