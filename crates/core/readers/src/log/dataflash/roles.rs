//! Fields of `ArduPilot`'s messages that hold the roles, and those that tell photos: tables to be read, one line a place.

use crate::role::{DEGREE, Meaning, Role, RoleSource, RowReading, condition, field, of};

/// Meaning of the topics for a flight.
pub(in super::super) const MEANING: Meaning = Meaning {
    roles: &[DATAFLASH],
    triggers: &[("CAM", ""), ("TRIG", "")],
    // The terrain is known (`TerrainStatusOK`), the sensor of airspeed healthy.
    conditions: &[
        condition("TERR", "CHeight", "Status", [2.0; 2]),
        condition("ARSP", "Airspeed", "H", [1.0, f64::INFINITY]),
    ],
    has_systems: false,
};

const DATAFLASH: &[RoleSource] = &[
    field(Role::Airspeed, "ARSP", "Airspeed", 1.0),
    field(Role::Airspeed, "ASP2", "Airspeed", 1.0),
    field(Role::Airspeed, "CTUN", "As", 1.0),
    field(Role::Airspeed, "NTUN", "Arspd", 1.0),
    field(Role::Airspeed, "NTUN", "ArSpd", 1.0),
    // PX4's logs of before 2017, whose angles are radians beside a quaternion.
    of(Role::Heading, "ATT", RowReading::Quaternion("q")),
    of(Role::Roll, "ATT", RowReading::Quaternion("q")),
    of(Role::Pitch, "ATT", RowReading::Quaternion("q")),
    // And of the first years, without one.
    of(Role::Heading, "ATT", radians("Yaw")),
    of(Role::Roll, "ATT", radians("Roll")),
    of(Role::Pitch, "ATT", radians("Pitch")),
    field(Role::Airspeed, "AIRS", "TrueSpeed", 1.0),
    field(Role::BarometricHeight, "SENS", "BaroAlt", 1.0),
    field(Role::Longitude, "GPS", "Lon", DEGREE),
    field(Role::GpsVelocityNorth, "GPS", "VelN", 1.0),
    field(Role::GpsVelocityEast, "GPS", "VelE", 1.0),
    field(Role::GpsVelocityDown, "GPS", "VelD", 1.0),
    field(Role::GpsFix, "GPS", "Fix", 1.0),
    field(Role::GpsSatellites, "GPS", "nSat", 1.0),
    field(Role::RollRate, "IMU", "GyroX", 1.0),
    field(Role::PitchRate, "IMU", "GyroY", 1.0),
    field(Role::YawRate, "IMU", "GyroZ", 1.0),
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
        RowReading::Course("Spd", 1.0, "GCrs", DEGREE),
    ),
    of(
        Role::GpsVelocityEast,
        "GPS",
        RowReading::Course("Spd", 1.0, "GCrs", DEGREE),
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
    field(Role::WindNorth, "EKF2", "VWN", 1.0),
    field(Role::WindEast, "EKF2", "VWE", 1.0),
    field(Role::AutopilotLatitude, "POS", "Lat", DEGREE),
    field(Role::AutopilotLongitude, "POS", "Lng", DEGREE),
    field(Role::AutopilotHeight, "POS", "Alt", 1.0),
    of(Role::AutopilotLatitude, "XKF1", RowReading::FromOrigin),
    of(Role::AutopilotLongitude, "XKF1", RowReading::FromOrigin),
    of(Role::AutopilotHeight, "XKF1", RowReading::FromOrigin),
    of(Role::AutopilotLatitude, "NKF1", RowReading::FromOrigin),
    of(Role::AutopilotLongitude, "NKF1", RowReading::FromOrigin),
    of(Role::AutopilotHeight, "NKF1", RowReading::FromOrigin),
    of(Role::AutopilotLatitude, "EKF1", RowReading::FromOrigin),
    of(Role::AutopilotLongitude, "EKF1", RowReading::FromOrigin),
    of(Role::AutopilotHeight, "EKF1", RowReading::FromOrigin),
];

/// An angle in radians, as PX4 wrote it beside the rates, which `ArduPilot` writes elsewhere.
const fn radians(name: &'static str) -> RowReading {
    RowReading::FieldBeside(name, 1.0, "RollRate")
}
