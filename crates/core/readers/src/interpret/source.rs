//! Where formats keep the roles: tables to be read, one line a place.

use super::Role;
use super::reading::{DEGREE, Reading, Source, field, of};
use super::ros::ROS;
use crate::log::LogFormat;

const GRAVITY: f64 = pilotage_base::frames::units::GRAVITY;

/// Places of a format, for each role the best first.
pub fn sources(format: LogFormat) -> impl Iterator<Item = &'static Source> {
    let tables: &[&[Source]] = match format {
        LogFormat::Dataflash | LogFormat::DataflashText => &[DATAFLASH],
        LogFormat::Ulog => &[ULOG],
        LogFormat::Tlog => &[TLOG],
        // PX4's messages tell more plainly what they are.
        LogFormat::Mcap => &[ULOG, ROS],
        LogFormat::Tables | LogFormat::Photos => &[],
    };
    tables.iter().copied().flatten()
}

const DATAFLASH: &[Source] = &[
    field(Role::Airspeed, "ARSP", "Airspeed", 1.0),
    field(Role::Airspeed, "ASP2", "Airspeed", 1.0),
    field(Role::Airspeed, "CTUN", "As", 1.0),
    field(Role::Airspeed, "NTUN", "Arspd", 1.0),
    field(Role::Airspeed, "NTUN", "ArSpd", 1.0),
    field(Role::Heading, "ATT", "Yaw", DEGREE),
    field(Role::Roll, "ATT", "Roll", DEGREE),
    field(Role::Pitch, "ATT", "Pitch", DEGREE),
    field(Role::Heading, "AHR2", "Yaw", DEGREE),
    field(Role::Roll, "AHR2", "Roll", DEGREE),
    field(Role::Pitch, "AHR2", "Pitch", DEGREE),
    field(Role::HeightAboveGround, "TERR", "CHeight", 1.0),
    field(Role::HeightAboveGround, "CTUN", "TAlt", 1.0),
    field(Role::BarometricHeight, "BARO", "Alt", 1.0),
    field(Role::BarometricHeight, "CTUN", "BAlt", 1.0),
    field(Role::BarometricHeight, "CTUN", "BarAlt", 1.0),
    field(Role::BarometricHeight, "NTUN", "Alt", 1.0),
    field(Role::Latitude, "GPS", "Lat", DEGREE),
    field(Role::Longitude, "GPS", "Lng", DEGREE),
    field(Role::GpsHeight, "GPS", "Alt", 1.0),
    of(
        Role::GpsVelocityNorth,
        "GPS",
        Reading::Course("Spd", 1.0, "GCrs", DEGREE),
    ),
    of(
        Role::GpsVelocityEast,
        "GPS",
        Reading::Course("Spd", 1.0, "GCrs", DEGREE),
    ),
    field(Role::GpsVelocityDown, "GPS", "VZ", 1.0),
    field(Role::GpsVelocityDown, "GPS", "VelZ", 1.0),
    field(Role::GroundSpeed, "GPS", "Spd", 1.0),
    field(Role::GpsFix, "GPS", "Status", 1.0),
    field(Role::GpsSatellites, "GPS", "NSats", 1.0),
    field(Role::RollRate, "IMU", "GyrX", 1.0),
    field(Role::PitchRate, "IMU", "GyrY", 1.0),
    field(Role::YawRate, "IMU", "GyrZ", 1.0),
    field(Role::AccelerationForward, "IMU", "AccX", 1.0),
    field(Role::AccelerationRight, "IMU", "AccY", 1.0),
    field(Role::AccelerationDown, "IMU", "AccZ", 1.0),
    field(Role::WindNorth, "XKF2", "VWN", 1.0),
    field(Role::WindEast, "XKF2", "VWE", 1.0),
    field(Role::WindNorth, "NKF2", "VWN", 1.0),
    field(Role::WindEast, "NKF2", "VWE", 1.0),
    field(Role::WindNorth, "EKF2", "VWN", 0.01),
    field(Role::WindEast, "EKF2", "VWE", 0.01),
];

const ULOG: &[Source] = &[
    field(
        Role::Airspeed,
        "airspeed_validated",
        "true_airspeed_m_s",
        1.0,
    ),
    field(Role::Airspeed, "airspeed", "true_airspeed_m_s", 1.0),
    of(Role::Heading, "vehicle_attitude", Reading::Quaternion("q")),
    of(Role::Roll, "vehicle_attitude", Reading::Quaternion("q")),
    of(Role::Pitch, "vehicle_attitude", Reading::Quaternion("q")),
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
];

const TLOG: &[Source] = &[
    field(Role::Airspeed, "VFR_HUD", "airspeed", 1.0),
    field(Role::Heading, "ATTITUDE", "yaw", 1.0),
    field(Role::Roll, "ATTITUDE", "roll", 1.0),
    field(Role::Pitch, "ATTITUDE", "pitch", 1.0),
    field(
        Role::HeightAboveGround,
        "TERRAIN_REPORT",
        "current_height",
        1.0,
    ),
    field(
        Role::HeightAboveGround,
        "GLOBAL_POSITION_INT",
        "relative_alt",
        1e-3,
    ),
    field(Role::BarometricHeight, "VFR_HUD", "alt", 1.0),
    field(Role::Latitude, "GPS_RAW_INT", "lat", 1e-7 * DEGREE),
    field(Role::Longitude, "GPS_RAW_INT", "lon", 1e-7 * DEGREE),
    field(Role::GpsHeight, "GPS_RAW_INT", "alt", 1e-3),
    of(
        Role::GpsVelocityNorth,
        "GPS_RAW_INT",
        Reading::Course("vel", 0.01, "cog", 0.01 * DEGREE),
    ),
    of(
        Role::GpsVelocityEast,
        "GPS_RAW_INT",
        Reading::Course("vel", 0.01, "cog", 0.01 * DEGREE),
    ),
    field(Role::GpsVelocityDown, "GLOBAL_POSITION_INT", "vz", 0.01),
    field(Role::GroundSpeed, "GPS_RAW_INT", "vel", 0.01),
    field(Role::GpsFix, "GPS_RAW_INT", "fix_type", 1.0),
    field(
        Role::GpsSatellites,
        "GPS_RAW_INT",
        "satellites_visible",
        1.0,
    ),
    field(Role::RollRate, "HIGHRES_IMU", "xgyro", 1.0),
    field(Role::PitchRate, "HIGHRES_IMU", "ygyro", 1.0),
    field(Role::YawRate, "HIGHRES_IMU", "zgyro", 1.0),
    field(Role::AccelerationForward, "HIGHRES_IMU", "xacc", 1.0),
    field(Role::AccelerationRight, "HIGHRES_IMU", "yacc", 1.0),
    field(Role::AccelerationDown, "HIGHRES_IMU", "zacc", 1.0),
    field(Role::RollRate, "RAW_IMU", "xgyro", 1e-3),
    field(Role::PitchRate, "RAW_IMU", "ygyro", 1e-3),
    field(Role::YawRate, "RAW_IMU", "zgyro", 1e-3),
    field(Role::AccelerationForward, "RAW_IMU", "xacc", 1e-3 * GRAVITY),
    field(Role::AccelerationRight, "RAW_IMU", "yacc", 1e-3 * GRAVITY),
    field(Role::AccelerationDown, "RAW_IMU", "zacc", 1e-3 * GRAVITY),
    of(
        Role::WindNorth,
        "WIND",
        Reading::WindFrom("direction", DEGREE, "speed"),
    ),
    of(
        Role::WindEast,
        "WIND",
        Reading::WindFrom("direction", DEGREE, "speed"),
    ),
];

/// Factor to SI and radians of a unit as logs write it; `None` if it is not known.
pub fn factor_of_unit(unit: &str) -> Option<f64> {
    Some(match unit {
        "deg" | "degheading" | "deglatitude" | "deglongitude" | "deg/s" | "degrees" => DEGREE,
        "cdeg" | "cdeg/s" => 0.01 * DEGREE,
        "degE7" => 1e-7 * DEGREE,
        "rad" | "rad/s" | "m" | "m/s" | "m/s/s" | "m/s^2" | "m/s²" | "s" | "satellites" => 1.0,
        "mrad/s" | "mm" | "mm/s" => 1e-3,
        "cm" | "cm/s" => 0.01,
        "km" => 1e3,
        "km/h" => 1.0 / 3.6,
        "knots" | "kt" => pilotage_base::frames::units::MPS_PER_KNOT,
        "ft" => pilotage_base::frames::units::METRES_PER_FOOT,
        "mG" | "mg" => 1e-3 * GRAVITY,
        _ => return None,
    })
}
