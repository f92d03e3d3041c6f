//! Fields of messages of ROS and of Foxglove that hold the roles.

use super::super::ulog;
use crate::role::{DEGREE, Meaning, Role, RoleSource, RowReading, field, of};

const IMU: &str = "sensor_msgs/Imu";
const FIX: &str = "sensor_msgs/NavSatFix";
const LOCATION: &str = "foxglove/LocationFix";
const ODOMETRY: &str = "nav_msgs/Odometry";
const POSE: &str = "geometry_msgs/PoseStamped";
const UNSURE_POSE: &str = "geometry_msgs/PoseWithCovarianceStamped";
const FOXGLOVE_POSE: &str = "foxglove/PoseInFrame";
/// Velocities in the world where their topic says that a receiver measured them.
const GPS_VELOCITY: &str = "geometry_msgs/TwistStamped@gps";
const UNSURE_GPS_VELOCITY: &str = "geometry_msgs/TwistWithCovarianceStamped@gps";
const HUD: &str = "mavros_msgs/VfrHud";
const ALTITUDE: &str = "mavros_msgs/Altitude";

/// Meaning of the topics for a flight: PX4's messages tell more plainly what they are.
pub(in super::super) const MEANING: Meaning = Meaning {
    roles: &[ulog::ROLES, ROS],
    triggers: ulog::MEANING.triggers,
    conditions: ulog::MEANING.conditions,
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
    field(
        Role::GpsSatellites,
        "mavros_msgs/GPSRAW",
        "satellites_visible",
        1.0,
    ),
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
