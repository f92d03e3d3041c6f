//! Fields of `MAVLink` messages that hold the roles, and those that tell photos: tables to be read, one line a place.

use crate::role::{DEGREE, Meaning, Role, RoleSource, RowReading, condition, field, of};

const GRAVITY: f64 = pilotage_base::frames::units::GRAVITY;

/// Meaning of the topics for a flight.
pub(in super::super) const MEANING: Meaning = Meaning {
    roles: &[TLOG],
    triggers: &[
        ("CAMERA_IMAGE_CAPTURED", "capture_result"),
        ("CAMERA_FEEDBACK", ""),
        ("CAMERA_TRIGGER", ""),
    ],
    // A spacing of 0 says that the terrain is not known there.
    conditions: &[condition(
        "TERRAIN_REPORT",
        "current_height",
        "spacing",
        [1.0, f64::INFINITY],
    )],
    has_systems: true,
};

const TLOG: &[RoleSource] = &[
    field(Role::Airspeed, "VFR_HUD", "airspeed", 1.0),
    field(Role::Heading, "ATTITUDE", "yaw", 1.0),
    field(Role::Roll, "ATTITUDE", "roll", 1.0),
    field(Role::Pitch, "ATTITUDE", "pitch", 1.0),
    of(
        Role::Heading,
        "ATTITUDE_QUATERNION",
        RowReading::Quaternion("q"),
    ),
    of(
        Role::Roll,
        "ATTITUDE_QUATERNION",
        RowReading::Quaternion("q"),
    ),
    of(
        Role::Pitch,
        "ATTITUDE_QUATERNION",
        RowReading::Quaternion("q"),
    ),
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
    field(
        Role::HeightAboveGround,
        "ALTITUDE",
        "altitude_relative",
        1.0,
    ),
    field(Role::BarometricHeight, "VFR_HUD", "alt", 1.0),
    field(
        Role::BarometricHeight,
        "ALTITUDE",
        "altitude_monotonic",
        1.0,
    ),
    field(Role::Latitude, "GPS_RAW_INT", "lat", 1e-7 * DEGREE),
    field(Role::Longitude, "GPS_RAW_INT", "lon", 1e-7 * DEGREE),
    field(Role::GpsHeight, "GPS_RAW_INT", "alt", 1e-3),
    of(
        Role::GpsVelocityNorth,
        "GPS_RAW_INT",
        RowReading::Course("vel", 0.01, "cog", 0.01 * DEGREE),
    ),
    of(
        Role::GpsVelocityEast,
        "GPS_RAW_INT",
        RowReading::Course("vel", 0.01, "cog", 0.01 * DEGREE),
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
    field(Role::RollRate, "SCALED_IMU", "xgyro", 1e-3),
    field(Role::PitchRate, "SCALED_IMU", "ygyro", 1e-3),
    field(Role::YawRate, "SCALED_IMU", "zgyro", 1e-3),
    field(
        Role::AccelerationForward,
        "SCALED_IMU",
        "xacc",
        1e-3 * GRAVITY,
    ),
    field(
        Role::AccelerationRight,
        "SCALED_IMU",
        "yacc",
        1e-3 * GRAVITY,
    ),
    field(Role::AccelerationDown, "SCALED_IMU", "zacc", 1e-3 * GRAVITY),
    of(
        Role::WindNorth,
        "WIND",
        RowReading::WindFrom("direction", DEGREE, "speed"),
    ),
    of(
        Role::WindEast,
        "WIND",
        RowReading::WindFrom("direction", DEGREE, "speed"),
    ),
    field(Role::WindNorth, "WIND_COV", "wind_x", 1.0),
    field(Role::WindEast, "WIND_COV", "wind_y", 1.0),
    field(
        Role::AutopilotLatitude,
        "GLOBAL_POSITION_INT",
        "lat",
        1e-7 * DEGREE,
    ),
    field(
        Role::AutopilotLongitude,
        "GLOBAL_POSITION_INT",
        "lon",
        1e-7 * DEGREE,
    ),
    field(Role::AutopilotHeight, "GLOBAL_POSITION_INT", "alt", 1e-3),
    // By satellite nothing else comes.
    field(
        Role::AutopilotLatitude,
        "HIGH_LATENCY2",
        "latitude",
        1e-7 * DEGREE,
    ),
    field(
        Role::AutopilotLongitude,
        "HIGH_LATENCY2",
        "longitude",
        1e-7 * DEGREE,
    ),
    field(Role::AutopilotHeight, "HIGH_LATENCY2", "altitude", 1.0),
    field(Role::Heading, "HIGH_LATENCY2", "heading", 2.0 * DEGREE),
    field(Role::Airspeed, "HIGH_LATENCY2", "airspeed", 0.2),
    field(Role::GroundSpeed, "HIGH_LATENCY2", "groundspeed", 0.2),
];
