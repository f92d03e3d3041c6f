//! Fields of messages of ROS and of Foxglove that hold the roles.

use super::super::px4_roles;
use crate::role::{DEGREE, Meaning, Role, RoleSource, RowReading, field, of};

const IMU: &str = "sensor_msgs/Imu";
const FIX: &str = "sensor_msgs/NavSatFix";
const LOCATION: &str = "foxglove/LocationFix";
const ODOMETRY: &str = "nav_msgs/Odometry";
const POSE: &str = "geometry_msgs/PoseStamped";
const UNSURE_POSE: &str = "geometry_msgs/PoseWithCovarianceStamped";
const FOXGLOVE_POSE: &str = "foxglove/PoseInFrame";
/// Fixes of drivers and of `mavros` that tell more than the standard one.
const GPS_RAW: &str = "mavros_msgs/GPSRAW";
const NAV_PVT: &str = "ublox_msgs/NavPVT";
const GEO_POSE: &str = "geographic_msgs/GeoPoseStamped";
/// Degrees of 10⁻⁷, and millimetres.
const E7: f64 = 1e-7 * DEGREE;
const MILLI: f64 = 1e-3;
/// Velocities in the world where their topic says that a receiver measured them.
const GPS_VELOCITY: &str = "geometry_msgs/TwistStamped@gps";
const UNSURE_GPS_VELOCITY: &str = "geometry_msgs/TwistWithCovarianceStamped@gps";
const HUD: &str = "mavros_msgs/VfrHud";
const ALTITUDE: &str = "mavros_msgs/Altitude";

/// Meaning of the topics for a flight: PX4's messages tell more plainly what they are.
pub(in super::super) const MEANING: Meaning = Meaning {
    roles: &[px4_roles::ROLES, ROS, &GPS_FIXES, &COMMON_FIXES, DRIVERS],
    triggers: px4_roles::MEANING.triggers,
    conditions: px4_roles::MEANING.conditions,
    has_systems: false,
};

/// Places of the messages, for each role the best first.
const ROS: &[RoleSource] = &[
    field(Role::Airspeed, HUD, "airspeed", 1.0),
    of(Role::Heading, IMU, RowReading::RosQuaternion("orientation")),
    of(Role::Roll, IMU, RowReading::RosQuaternion("orientation")),
    of(Role::Pitch, IMU, RowReading::RosQuaternion("orientation")),
    of(
        Role::Heading,
        ODOMETRY,
        RowReading::RosQuaternion("pose.pose.orientation"),
    ),
    of(
        Role::Roll,
        ODOMETRY,
        RowReading::RosQuaternion("pose.pose.orientation"),
    ),
    of(
        Role::Pitch,
        ODOMETRY,
        RowReading::RosQuaternion("pose.pose.orientation"),
    ),
    of(
        Role::Heading,
        UNSURE_POSE,
        RowReading::RosQuaternion("pose.pose.orientation"),
    ),
    of(
        Role::Roll,
        UNSURE_POSE,
        RowReading::RosQuaternion("pose.pose.orientation"),
    ),
    of(
        Role::Pitch,
        UNSURE_POSE,
        RowReading::RosQuaternion("pose.pose.orientation"),
    ),
    of(
        Role::Heading,
        POSE,
        RowReading::RosQuaternion("pose.orientation"),
    ),
    of(
        Role::Roll,
        POSE,
        RowReading::RosQuaternion("pose.orientation"),
    ),
    of(
        Role::Pitch,
        POSE,
        RowReading::RosQuaternion("pose.orientation"),
    ),
    of(
        Role::Heading,
        FOXGLOVE_POSE,
        RowReading::RosQuaternion("pose.orientation"),
    ),
    of(
        Role::Roll,
        FOXGLOVE_POSE,
        RowReading::RosQuaternion("pose.orientation"),
    ),
    of(
        Role::Pitch,
        FOXGLOVE_POSE,
        RowReading::RosQuaternion("pose.orientation"),
    ),
    field(
        Role::Heading,
        "std_msgs/Float64@compass_hdg",
        "data",
        DEGREE,
    ),
    field(Role::Heading, HUD, "heading", DEGREE),
    field(Role::HeightAboveGround, ALTITUDE, "bottom_clearance", 1.0),
    field(
        Role::HeightAboveGround,
        "std_msgs/Float64@rel_alt",
        "data",
        1.0,
    ),
    // Of DJI's packages.
    field(
        Role::HeightAboveGround,
        "std_msgs/Float32@height_above_takeoff",
        "data",
        1.0,
    ),
    field(Role::HeightAboveGround, ALTITUDE, "relative", 1.0),
    field(Role::BarometricHeight, ALTITUDE, "monotonic", 1.0),
    of(
        Role::BarometricHeight,
        "sensor_msgs/FluidPressure",
        RowReading::Pressure("fluid_pressure"),
    ),
    field(Role::BarometricHeight, HUD, "altitude", 1.0),
    field(Role::Latitude, FIX, "latitude", DEGREE),
    field(Role::Longitude, FIX, "longitude", DEGREE),
    field(Role::GpsHeight, FIX, "altitude", 1.0),
    of(Role::GpsFix, FIX, RowReading::RosFix("status.status")),
    field(Role::Latitude, LOCATION, "latitude", DEGREE),
    field(Role::Longitude, LOCATION, "longitude", DEGREE),
    field(Role::GpsHeight, LOCATION, "altitude", 1.0),
    field(Role::GpsSatellites, GPS_RAW, "satellites_visible", 1.0),
    field(Role::GpsVelocityNorth, GPS_VELOCITY, "twist.linear.y", 1.0),
    field(Role::GpsVelocityEast, GPS_VELOCITY, "twist.linear.x", 1.0),
    field(Role::GpsVelocityDown, GPS_VELOCITY, "twist.linear.z", -1.0),
    field(
        Role::GpsVelocityNorth,
        UNSURE_GPS_VELOCITY,
        "twist.twist.linear.y",
        1.0,
    ),
    field(
        Role::GpsVelocityEast,
        UNSURE_GPS_VELOCITY,
        "twist.twist.linear.x",
        1.0,
    ),
    field(
        Role::GpsVelocityDown,
        UNSURE_GPS_VELOCITY,
        "twist.twist.linear.z",
        -1.0,
    ),
    field(Role::GroundSpeed, HUD, "groundspeed", 1.0),
    field(Role::RollRate, IMU, "angular_velocity.x", 1.0),
    field(Role::PitchRate, IMU, "angular_velocity.y", -1.0),
    field(Role::YawRate, IMU, "angular_velocity.z", -1.0),
    field(Role::AccelerationForward, IMU, "linear_acceleration.x", 1.0),
    field(Role::AccelerationRight, IMU, "linear_acceleration.y", -1.0),
    field(Role::AccelerationDown, IMU, "linear_acceleration.z", -1.0),
];

/// Places of a `GPSFix`, of which two packages have the same one.
const fn gps_fix(message: &'static str) -> [RoleSource; 8] {
    [
        field(Role::Latitude, message, "latitude", DEGREE),
        field(Role::Longitude, message, "longitude", DEGREE),
        field(Role::GpsHeight, message, "altitude", 1.0),
        of(Role::GpsFix, message, RowReading::RosFix("status.status")),
        of(
            Role::GpsVelocityNorth,
            message,
            RowReading::Course("speed", 1.0, "track", DEGREE),
        ),
        of(
            Role::GpsVelocityEast,
            message,
            RowReading::Course("speed", 1.0, "track", DEGREE),
        ),
        field(Role::GpsVelocityDown, message, "climb", -1.0),
        field(Role::GroundSpeed, message, "speed", 1.0),
    ]
}
const GPS_FIXES: [RoleSource; 8] = gps_fix("gps_msgs/GPSFix");
const COMMON_FIXES: [RoleSource; 8] = gps_fix("gps_common/GPSFix");

/// Places of the messages of drivers of receivers, after all others.
const DRIVERS: &[RoleSource] = &[
    field(Role::Latitude, NAV_PVT, "lat", E7),
    field(Role::Longitude, NAV_PVT, "lon", E7),
    field(Role::GpsHeight, NAV_PVT, "h_msl", MILLI),
    field(Role::GpsHeight, NAV_PVT, "hMSL", MILLI),
    field(Role::GpsFix, NAV_PVT, "fix_type", 1.0),
    field(Role::GpsFix, NAV_PVT, "fixType", 1.0),
    field(Role::GpsSatellites, NAV_PVT, "num_sv", 1.0),
    field(Role::GpsSatellites, NAV_PVT, "numSV", 1.0),
    field(Role::GpsVelocityNorth, NAV_PVT, "vel_n", MILLI),
    field(Role::GpsVelocityNorth, NAV_PVT, "velN", MILLI),
    field(Role::GpsVelocityEast, NAV_PVT, "vel_e", MILLI),
    field(Role::GpsVelocityEast, NAV_PVT, "velE", MILLI),
    field(Role::GpsVelocityDown, NAV_PVT, "vel_d", MILLI),
    field(Role::GpsVelocityDown, NAV_PVT, "velD", MILLI),
    field(Role::Latitude, GPS_RAW, "lat", E7),
    field(Role::Longitude, GPS_RAW, "lon", E7),
    field(Role::GpsHeight, GPS_RAW, "alt", MILLI),
    field(Role::GpsFix, GPS_RAW, "fix_type", 1.0),
    field(Role::Latitude, GEO_POSE, "pose.position.latitude", DEGREE),
    field(Role::Longitude, GEO_POSE, "pose.position.longitude", DEGREE),
    field(Role::GpsHeight, GEO_POSE, "pose.position.altitude", 1.0),
];
