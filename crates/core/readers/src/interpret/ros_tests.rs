//! Recordings of ROS: topics that tell of something else, several vehicles and instruments, axes and units of drivers.

use super::measured_tests::with;
use super::*;
use crate::log::{Log, LogFormat};

#[test]
fn setpoints_and_cameras_of_ros_are_not_the_vehicle() {
    let mut log = Log::new("a.mcap", LogFormat::Mcap);
    let pose = ["x", "y", "z", "w"].map(|part| format!("pose.orientation.{part}"));
    let pose: Vec<&str> = pose.iter().map(String::as_str).collect();
    // East, and north, of ROS.
    let (east, north) = (
        [0.0, 0.0, 0.0, 1.0],
        [0.0, 0.0, 0.5_f64.sqrt(), 0.5_f64.sqrt()],
    );
    let kind = "geometry_msgs/msg/PoseStamped";
    let row = |time: f64, turn: [f64; 4]| [&[time][..], &turn].concat();
    let wanted = [row(0.0, east), row(1.0, north)];
    with(
        &mut log,
        "/mavros/setpoint_position/local",
        kind,
        &pose,
        &wanted,
    );
    assert_eq!(series(&log, Role::Heading), None);
    let flown = [row(0.0, north), row(1.0, east)];
    with(&mut log, "/mavros/local_position/pose", kind, &pose, &flown);
    let heading = series(&log, Role::Heading).unwrap();
    assert!(heading.values[0].abs() < 1e-9, "{heading:?}");
    let kind = "sensor_msgs/msg/Imu";
    let force = ["linear_acceleration.z"];
    with(
        &mut log,
        "/camera/imu",
        kind,
        &force,
        &[vec![0.0, 0.1], vec![1.0, 0.2]],
    );
    // A camera's alone is better than none.
    assert_eq!(
        series(&log, Role::AccelerationDown).unwrap().values,
        [-0.1, -0.2]
    );
    with(
        &mut log,
        "/imu/data",
        kind,
        &force,
        &[vec![0.0, 9.8], vec![1.0, 9.7]],
    );
    assert_eq!(
        series(&log, Role::AccelerationDown).unwrap().values,
        [-9.8, -9.7]
    );
}

#[test]
fn a_fix_of_which_the_driver_says_nothing_counts() {
    let mut log = Log::new("a.mcap", LogFormat::Mcap);
    let fields = ["status.status", "latitude", "longitude", "altitude"];
    // STATUS_UNKNOWN, then STATUS_NO_FIX.
    let rows = [
        vec![0.0, -2.0, 47.5, 8.5, 600.0],
        vec![1.0, -1.0, 0.0, 0.0, 0.0],
    ];
    with(
        &mut log,
        "/fix",
        "sensor_msgs/msg/NavSatFix",
        &fields,
        &rows,
    );
    let found: Vec<RoleSeries> = [Role::Latitude, Role::Longitude, Role::GpsHeight]
        .into_iter()
        .filter_map(|role| series(&log, role))
        .collect();
    let places = places(&found, Navigation::Gps);
    assert_eq!(places.len(), 1);
    assert!((places[0].1.latitude.to_degrees() - 47.5).abs() < 1e-9);
}

#[test]
fn the_vehicles_of_a_recording_of_ros_are_not_mixed() {
    let mut log = Log::new("a.mcap", LogFormat::Mcap);
    let (fix, imu) = ("sensor_msgs/msg/NavSatFix", "sensor_msgs/msg/Imu");
    let rate = ["angular_velocity.x"];
    with(
        &mut log,
        "/uav1/imu",
        imu,
        &rate,
        &[vec![0.0, 1.0], vec![1.0, 1.1]],
    );
    with(
        &mut log,
        "/uav2/imu",
        imu,
        &rate,
        &[vec![0.0, 2.0], vec![1.0, 2.2]],
    );
    let place = ["latitude", "longitude"];
    with(
        &mut log,
        "/uav2/fix",
        fix,
        &place,
        &[vec![0.0, 48.0, 8.0], vec![1.0, 48.1, 8.0]],
    );
    with(
        &mut log,
        "/uav1/fix",
        fix,
        &place,
        &[vec![0.0, 47.0, 8.0], vec![1.0, 47.1, 8.0]],
    );
    assert_eq!(
        series(&log, Role::RollRate).unwrap().source,
        "/uav2/imu.angular_velocity.x"
    );
    assert_eq!(
        series(&log, Role::Latitude).unwrap().source,
        "/uav2/fix.latitude"
    );
    let sets = log.sets_by_name().unwrap();
    assert_eq!((sets.first, sets.vehicles), ("uav2", vec!["uav1"]));
}

#[test]
fn an_imu_whose_third_axis_is_down_is_not_of_the_axes_of_ros() {
    let mut log = Log::new("a.mcap", LogFormat::Mcap);
    let fields = [
        "orientation.x",
        "orientation.y",
        "orientation.z",
        "orientation.w",
        "angular_velocity.z",
        "linear_acceleration.y",
        "linear_acceleration.z",
    ];
    // A heading of 90° counted from north, which of ROS would be 0°.
    let half = 0.5_f64.sqrt();
    let row = |time: f64| {
        vec![
            time,
            0.0,
            0.0,
            half,
            half,
            0.2 + time,
            0.5 + time,
            -9.8 + 0.1 * time,
        ]
    };
    with(
        &mut log,
        "/imu",
        "sensor_msgs/msg/Imu",
        &fields,
        &[row(0.0), row(1.0)],
    );
    let first = |role| series(&log, role).unwrap().values[0];
    assert!((first(Role::Heading) - std::f64::consts::FRAC_PI_2).abs() < 1e-9);
    assert_eq!(first(Role::YawRate), 0.2);
    assert_eq!(first(Role::AccelerationRight), 0.5);
    assert_eq!(first(Role::AccelerationDown), -9.8);
    let source = series(&log, Role::YawRate).unwrap().source;
    assert!(source.contains("as gravity says"), "{source}");
}

#[test]
fn forces_in_multiples_of_gravity_and_pressures_in_hectopascals_are_known_by_their_amounts() {
    let mut log = Log::new("a.mcap", LogFormat::Mcap);
    let fields = [
        "linear_acceleration.x",
        "linear_acceleration.y",
        "linear_acceleration.z",
        "angular_velocity.x",
    ];
    // As the IMU of a Livox is written.
    let rows = [
        vec![0.0, 0.1, 0.2, 0.99, 0.5],
        vec![1.0, 0.1, 0.2, 0.98, 0.6],
    ];
    with(
        &mut log,
        "/livox/imu",
        "sensor_msgs/msg/Imu",
        &fields,
        &rows,
    );
    let first = |role| series(&log, role).unwrap().values[0];
    assert!((first(Role::AccelerationDown) + 0.99 * 9.806_65).abs() < 1e-9);
    assert!((first(Role::AccelerationRight) + 0.2 * 9.806_65).abs() < 1e-9);
    assert_eq!(first(Role::RollRate), 0.5);
    // Forces without gravity are what they are.
    let mut bare = Log::new("b.mcap", LogFormat::Mcap);
    let rows = [
        vec![0.0, 0.9, 0.2, 0.1, 0.5],
        vec![1.0, -0.8, -0.3, 0.1, 0.6],
    ];
    with(&mut bare, "/imu", "sensor_msgs/msg/Imu", &fields, &rows);
    assert_eq!(
        series(&bare, Role::AccelerationForward).unwrap().values,
        [0.9, -0.8]
    );
    let pressure = [vec![0.0, 954.61], vec![1.0, 953.0]];
    with(
        &mut log,
        "/baro",
        "sensor_msgs/msg/FluidPressure",
        &["fluid_pressure"],
        &pressure,
    );
    // 954.61 hPa are 500 m in the standard atmosphere.
    let height = series(&log, Role::BarometricHeight).unwrap();
    assert!((height.values[0] - 500.0).abs() < 0.5, "{height:?}");
}

/// Adds a receiver's place and a turn rate of an IMU under these names.
fn add_set(log: &mut Log, [fix, imu]: [&str; 2], value: f64) {
    let rows = |values: [f64; 2]| {
        let row = |time: f64| [&[time][..], &values.map(|v| v + 0.01 * time)].concat();
        [row(0.0), row(1.0)]
    };
    let place = ["latitude", "longitude"];
    let kind = "sensor_msgs/msg/NavSatFix";
    with(log, fix, kind, &place, &rows([40.0 + value, 8.0]));
    let rates = ["angular_velocity.x", "angular_velocity.z"];
    let kind = "sensor_msgs/msg/Imu";
    with(log, imu, kind, &rates, &rows([value, value]));
}

#[test]
fn instruments_of_one_aircraft_are_no_vehicles() {
    let mut log = Log::new("a.mcap", LogFormat::Mcap);
    add_set(&mut log, ["/novatel/fix", "/novatel/imu"], 1.0);
    add_set(&mut log, ["/mavros/global/fix", "/mavros/imu/data"], 2.0);
    let airspeed = [vec![0.0, 20.0], vec![1.0, 21.0]];
    with(
        &mut log,
        "/mavros/vfr_hud",
        "mavros_msgs/msg/VfrHud",
        &["airspeed"],
        &airspeed,
    );
    let source = |role| series(&log, role).unwrap().source;
    assert_eq!(source(Role::Latitude), "/novatel/fix.latitude");
    assert_eq!(source(Role::RollRate), "/novatel/imu.angular_velocity.x");
    // What the first set has not, comes of the other.
    assert_eq!(source(Role::Airspeed), "/mavros/vfr_hud.airspeed");
    let sets = log.sets_by_name().unwrap();
    assert!(sets.vehicles.is_empty() && sets.instruments == ["mavros"]);
}

#[test]
fn cameras_are_no_vehicles_but_vehicles_may_be_called_so() {
    let mut log = Log::new("a.mcap", LogFormat::Mcap);
    add_set(&mut log, ["/camera/fix", "/camera/imu"], 1.0);
    add_set(
        &mut log,
        ["/camera_drone/mavros/fix", "/camera_drone/mavros/imu/data"],
        2.0,
    );
    assert_eq!(log.sets_by_name(), None);
    let rate = series(&log, Role::RollRate).unwrap();
    assert_eq!(
        rate.source,
        "/camera_drone/mavros/imu/data.angular_velocity.x"
    );
    let latitude = series(&log, Role::Latitude).unwrap();
    assert_eq!(latitude.source, "/camera_drone/mavros/fix.latitude");
    let names = ["/b/mavros/fix", "/b/mavros/imu/data"];
    add_set(&mut log, names, 3.0);
    let sets = log.sets_by_name().unwrap();
    assert_eq!((sets.first, sets.vehicles), ("camera_drone", vec!["b"]));
}

#[test]
fn an_imu_upside_down_under_a_world_that_is_up_keeps_the_axes_of_ros() {
    let parts = ["x", "y", "z", "w"].map(|part| format!("orientation.{part}"));
    let mut fields: Vec<&str> = parts.iter().map(String::as_str).collect();
    fields.extend(["angular_velocity.z", "linear_acceleration.z"]);
    for (yaw, heading) in [(0.0, 90.0_f64), (30.0, 60.0)] {
        let mut log = Log::new("a.mcap", LogFormat::Mcap);
        let yaw = f64::to_radians(yaw);
        let turn = nalgebra::UnitQuaternion::from_euler_angles(std::f64::consts::PI, 0.0, yaw);
        let q = turn.coords;
        let row = |time: f64| vec![time, q.x, q.y, q.z, q.w, 0.2 + time, -9.8 + 0.1 * time];
        with(
            &mut log,
            "/imu",
            "sensor_msgs/msg/Imu",
            &fields,
            &[row(0.0), row(1.0)],
        );
        let first = |role| series(&log, role).unwrap().values[0];
        let found = first(Role::Heading).to_degrees();
        assert!((found - heading).abs() < 1e-9, "{found}");
        assert_eq!(first(Role::YawRate), -0.2);
        assert_eq!(first(Role::AccelerationDown), 9.8);
    }
}

#[test]
fn fixes_of_drivers_are_places() {
    let place = |row: usize| (47.5 + 1e-4 * row as f64, 8.5, 600.0 + row as f64);
    for (schema, fields, row) in [
        (
            "gps_msgs/msg/GPSFix",
            &[
                "status.status",
                "latitude",
                "longitude",
                "altitude",
                "track",
                "speed",
                "climb",
            ][..],
            &(|(lat, lon, alt): (f64, f64, f64)| vec![0.0, lat, lon, alt, 30.0, 10.0, 1.0])
                as &dyn Fn((f64, f64, f64)) -> Vec<f64>,
        ),
        (
            "ublox_msgs/msg/NavPVT",
            &["fix_type", "lat", "lon", "h_msl", "vel_n", "vel_e", "vel_d"],
            &|(lat, lon, alt)| {
                let north = 1e4 * 30_f64.to_radians().cos();
                vec![3.0, 1e7 * lat, 1e7 * lon, 1e3 * alt, north, 5e3, -1e3]
            },
        ),
        (
            "mavros_msgs/msg/GPSRAW",
            &["fix_type", "lat", "lon", "alt"],
            &|(lat, lon, alt)| vec![3.0, 1e7 * lat, 1e7 * lon, 1e3 * alt],
        ),
        (
            "geographic_msgs/msg/GeoPoseStamped",
            &[
                "pose.position.latitude",
                "pose.position.longitude",
                "pose.position.altitude",
            ],
            &|(lat, lon, alt)| vec![lat, lon, alt],
        ),
    ] {
        let mut log = Log::new("a.mcap", LogFormat::Mcap);
        let rows = (0..5).map(|at| [vec![at as f64], row(place(at))].concat());
        with(&mut log, "/gps", schema, fields, &rows.collect::<Vec<_>>());
        let found: Vec<RoleSeries> = [Role::Latitude, Role::Longitude, Role::GpsHeight]
            .into_iter()
            .filter_map(|role| series(&log, role))
            .collect();
        let places = places(&found, Navigation::Gps);
        assert_eq!(places.len(), 5, "{schema}");
        let (_, last) = places[4];
        assert!(
            (last.latitude.to_degrees() - 47.5004).abs() < 1e-9,
            "{schema}"
        );
        assert!((last.longitude.to_degrees() - 8.5).abs() < 1e-9, "{schema}");
        let height = series(&log, Role::GpsHeight).unwrap().values[4];
        assert!((height - 604.0).abs() < 1e-9, "{schema}");
        if fields.len() > 4 {
            for (role, value) in [
                (Role::GpsVelocityNorth, 10.0 * 30_f64.to_radians().cos()),
                (Role::GpsVelocityEast, 5.0),
                (Role::GpsVelocityDown, -1.0),
            ] {
                let found = series(&log, role).unwrap().values[0];
                assert!((found - value).abs() < 1e-9, "{schema} {role:?} {found}");
            }
        }
    }
}

#[test]
fn a_height_above_the_take_off_is_known_by_the_name_of_its_topic() {
    let mut log = Log::new("a.mcap", LogFormat::Mcap);
    let rows = [vec![0.0, 0.0], vec![1.0, 2.5]];
    let kind = "std_msgs/msg/Float32";
    with(&mut log, "/dji_osdk_ros/gps_health", kind, &["data"], &rows);
    assert_eq!(series(&log, Role::HeightAboveGround), None);
    let topic = "/dji_osdk_ros/height_above_takeoff";
    with(&mut log, topic, kind, &["data"], &rows);
    let height = series(&log, Role::HeightAboveGround).unwrap();
    assert_eq!(height.values, [0.0, 2.5]);
}
