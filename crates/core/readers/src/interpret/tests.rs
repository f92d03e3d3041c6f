//! Logs that are made here, and the flights that they tell of.

use std::f64::consts::FRAC_PI_2;

use nalgebra::UnitQuaternion;

use super::*;
use crate::log::{FieldKind, FieldLayout, Log, LogFormat, TopicName};
use pilotage_flight::ChannelName;

/// Adds a topic of double-precision numbers: names with units, and rows that begin with their time.
fn add(log: &mut Log, name: &str, fields: &[(&str, &str)], rows: &[Vec<f64>]) {
    add_topic(log, &TopicName::single(name), fields, rows);
}

/// Adds a topic of that name and instance.
fn add_topic(log: &mut Log, name: &TopicName, fields: &[(&str, &str)], rows: &[Vec<f64>]) {
    let layouts = || {
        let fields = fields.iter().enumerate();
        let layout = |(i, (name, unit)): (usize, &(&str, &str))| FieldLayout {
            unit: (*unit).to_owned(),
            ..FieldLayout::plain(*name, FieldKind::F64, 8 * i)
        };
        fields.map(layout).collect()
    };
    let place = log.topic_or_new(name, layouts);
    for row in rows {
        let bytes: Vec<u8> = row[1..].iter().flat_map(|v| v.to_le_bytes()).collect();
        log.topics[place].push(row[0], &bytes);
    }
}

/// A flight eastward at 20 m/s over Zurich, with its fixes once a second.
fn eastward() -> Log {
    let mut log = Log::new("east.bin", LogFormat::Dataflash);
    let attitude: Vec<_> = (0..50)
        .map(|i| vec![0.1 * f64::from(i), 0.0, 5.0, 90.0])
        .collect();
    let fields = [("Roll", "deg"), ("Pitch", "deg"), ("Yaw", "degheading")];
    add(&mut log, "ATT", &fields, &attitude);
    let degrees = 20.0 / 76_000.0;
    let fixes: Vec<_> = (0..6)
        .map(|i| {
            let i = f64::from(i);
            vec![i, 3.0, 47.0, 8.0 + i * degrees, 500.0 + i, 20.0, 90.0]
        })
        .collect();
    let fields = [
        ("Status", ""),
        ("Lat", "deglatitude"),
        ("Lng", "deglongitude"),
        ("Alt", "m"),
        ("Spd", "m/s"),
        ("GCrs", "degheading"),
    ];
    add(&mut log, "GPS", &fields, &fixes);
    log
}

#[test]
fn a_flight_begins_at_its_first_fix_and_goes_where_its_fixes_go() {
    let log = eastward();
    let flight = flight_from_log(&log).into_flight().unwrap();
    let truth = flight.truth.as_ref().unwrap();
    let last = truth.states.last().unwrap().position;
    assert!((last.y - 100.0).abs() < 0.2 && last.x.abs() < 0.1, "{last}");
    assert!((last.z + 5.0).abs() < 1e-9);
    assert_eq!(flight.value(ChannelName::HeightAboveGround, 5.0), Some(5.0));
    let heading = flight.value(ChannelName::Heading, 1.0).unwrap();
    assert!((heading - FRAC_PI_2).abs() < 1e-12);
    let velocity = series(&log, Role::GpsVelocityEast).unwrap();
    assert!((velocity.values[0] - 20.0).abs() < 1e-12);
    assert_eq!(velocity.source, "GPS.Spd, GCrs");
}

#[test]
fn fixes_without_a_fix_do_not_count() {
    let mut log = Log::new("none.bin", LogFormat::Dataflash);
    let fields = [("Status", ""), ("Lat", "deg"), ("Lng", "deg")];
    add(&mut log, "GPS", &fields, &[vec![0.0, 1.0, 47.0, 8.0]]);
    add(&mut log, "ATT", &[("Yaw", "deg")], &[vec![0.0, 10.0]]);
    let cause = flight_from_log(&log).into_flight().unwrap_err();
    assert!(matches!(cause, InterpretError::NoPosition { .. }));
    assert!(cause.to_string().starts_with("none.bin: "));
}

#[test]
fn a_flight_without_heading_is_known_by_its_track_and_said_to_be_not_navigable() {
    let mut log = Log::new("gps.bin", LogFormat::Dataflash);
    let fields = [("Status", ""), ("Lat", "deg"), ("Lng", "deg"), ("Alt", "m")];
    let rows = [
        vec![0.0, 3.0, 47.0, 8.0, 500.0],
        vec![1.0, 3.0, 47.001, 8.0, 510.0],
    ];
    add(&mut log, "GPS", &fields, &rows);
    let interpreted = flight_from_log(&log);
    let trouble = interpreted.measured().trouble.cloned();
    assert!(matches!(trouble, Some(InterpretError::NoHeading { .. })));
    let flight = interpreted.into_flight().unwrap();
    let last = flight.truth.unwrap().states[1].position;
    assert!((last.x - 111.2).abs() < 0.1, "{last}");
    assert!((last.z + 10.0).abs() < 1e-9, "{last}");
}

#[test]
fn times_that_go_back_and_numbers_beyond_reason_are_counted_and_left_out() {
    let mut log = Log::new("odd.bin", LogFormat::Dataflash);
    let rows = [
        vec![0.0, 10.0],
        vec![1.0, f64::NAN],
        vec![2.0, 20.0],
        vec![1.5, 30.0],
        vec![3.0, 1e9],
        vec![4.0, -170.0],
    ];
    add(&mut log, "ATT", &[("Yaw", "deg")], &rows);
    let heading = series(&log, Role::Heading).unwrap();
    assert_eq!(heading.times, [0.0, 2.0, 4.0]);
    assert_eq!((heading.implausible, heading.out_of_order), (2, 1));
    assert!((heading.values[2] + 170.0_f64.to_radians()).abs() < 1e-12);
}

#[test]
fn a_sensor_that_logs_one_number_for_ever_gives_way_to_one_that_lives() {
    let mut log = eastward();
    let dead: Vec<_> = (0..5).map(|i| vec![f64::from(i), 0.0]).collect();
    add(&mut log, "ARSP", &[("Airspeed", "m/s")], &dead);
    let found = series(&log, Role::Airspeed).unwrap();
    assert_eq!(found.source, "ARSP.Airspeed");
    let alive: Vec<_> = (0..5)
        .map(|i| vec![f64::from(i), 18.0 + f64::from(i)])
        .collect();
    add(&mut log, "NTUN", &[("Arspd", "")], &alive);
    let found = series(&log, Role::Airspeed).unwrap();
    assert_eq!(found.source, "NTUN.Arspd");
}

#[test]
fn an_attitude_as_a_quaternion_is_turned_into_angles() {
    let mut log = Log::new("px4.ulg", LogFormat::Ulog);
    let half = 0.5 * FRAC_PI_2;
    let fields = [("q[0]", ""), ("q[1]", ""), ("q[2]", ""), ("q[3]", "")];
    let east = vec![0.0, half.cos(), 0.0, 0.0, half.sin()];
    let rolled = vec![1.0, half.cos(), half.sin(), 0.0, 0.0];
    add(&mut log, "vehicle_attitude", &fields, &[east, rolled]);
    let heading = series(&log, Role::Heading).unwrap();
    assert!((heading.values[0] - FRAC_PI_2).abs() < 1e-12);
    let roll = series(&log, Role::Roll).unwrap();
    assert!((roll.values[1] - FRAC_PI_2).abs() < 1e-12);
}

#[test]
fn a_wind_from_the_west_blows_east() {
    let mut log = Log::new("ground.tlog", LogFormat::Tlog);
    let fields = [("direction", "deg"), ("speed", "m/s")];
    let rows = [vec![0.0, 270.0, 8.0], vec![1.0, 270.0, 9.0]];
    add(&mut log, "WIND", &fields, &rows);
    let east = series(&log, Role::WindEast).unwrap();
    assert!((east.values[0] - 8.0).abs() < 1e-12);
    let north = series(&log, Role::WindNorth).unwrap();
    assert!(north.values[0].abs() < 1e-12);
}

/// A flight of messages of ROS: eastward, nose down, right wing down, in its axes.
fn of_ros() -> Log {
    let mut log = Log::new("bag.mcap", LogFormat::Mcap);
    let mut add_kind = |name: &str, schema: &str, fields: &[(&str, &str)], row: Vec<f64>| {
        let later: Vec<_> = row.iter().map(|v| v + 1e-3).collect();
        add(&mut log, name, fields, &[row, later]);
        schema.clone_into(&mut log.topics.last_mut().unwrap().schema);
    };
    let quaternion = [
        "orientation.x",
        "orientation.y",
        "orientation.z",
        "orientation.w",
    ];
    let quaternion = quaternion.map(|name| (name, ""));
    add_kind("/raw", "sensor_msgs/msg/Imu", &quaternion, vec![0.0; 5]);
    // East is forward along the world's first axis; nose down is positive about the left axis.
    let attitude = UnitQuaternion::from_euler_angles(0.2, 0.1, 0.0);
    let q = attitude.coords;
    add_kind(
        "/imu",
        "sensor_msgs/msg/Imu",
        &quaternion,
        vec![0.0, q.x, q.y, q.z, q.w],
    );
    let rates = [
        ("angular_velocity.y", "rad/s"),
        ("linear_acceleration.z", "m/s²"),
    ];
    add_kind("/rates", "sensor_msgs/Imu", &rates, vec![0.0, 0.3, 9.8]);
    let fix = [
        ("latitude", "deg"),
        ("longitude", "deg"),
        ("status.status", ""),
    ];
    add_kind(
        "/fix",
        "sensor_msgs/msg/NavSatFix",
        &fix,
        vec![0.0, 47.0, 8.0, 0.0],
    );
    let velocity = [("twist.linear.x", "m/s"), ("twist.linear.y", "m/s")];
    add_kind(
        "/cmd_vel",
        "geometry_msgs/TwistStamped",
        &velocity,
        vec![0.0, 99.0, 99.0],
    );
    add_kind(
        "/gps/velocity",
        "geometry_msgs/TwistStamped",
        &velocity,
        vec![0.0, 20.0, 1.0],
    );
    let pressure = [("fluid_pressure", "Pa")];
    add_kind(
        "/air",
        "sensor_msgs/msg/FluidPressure",
        &pressure,
        vec![0.0, 89_874.57],
    );
    log
}

#[test]
fn axes_of_ros_become_those_of_aircraft() {
    let log = of_ros();
    let first = |role| {
        series(&log, role)
            .unwrap_or_else(|| panic!("no {role:?}"))
            .values[0]
    };
    assert!((first(Role::Heading) - FRAC_PI_2).abs() < 1e-12);
    assert!((first(Role::Roll) - 0.2).abs() < 1e-12);
    assert!((first(Role::Pitch) + 0.1).abs() < 1e-12);
    assert_eq!(first(Role::PitchRate), -0.3);
    assert_eq!(first(Role::AccelerationDown), -9.8);
    assert_eq!(
        [first(Role::GpsVelocityNorth), first(Role::GpsVelocityEast)],
        [1.0, 20.0]
    );
    // ISO 2533 has 89 874.57 Pa at 1000 m.
    assert!((first(Role::BarometricHeight) - 1000.0).abs() < 0.1);
    assert!(flight_from_log(&log).into_flight().is_ok());
}

#[test]
fn messages_of_px4_are_known_by_what_they_are_wherever_they_come_from() {
    let mut log = Log::new("bag.mcap", LogFormat::Mcap);
    let fields = [("q[0]", ""), ("q[1]", ""), ("q[2]", ""), ("q[3]", "")];
    let half = 0.5 * FRAC_PI_2;
    let rows = [
        vec![0.0, half.cos(), 0.0, 0.0, half.sin()],
        vec![1.0, 1.0, 0.0, 0.0, 0.0],
    ];
    add(&mut log, "/fmu/out/vehicle_attitude", &fields, &rows);
    "px4_msgs/msg/VehicleAttitude".clone_into(&mut log.topics[0].schema);
    let heading = series(&log, Role::Heading).unwrap();
    assert!((heading.values[0] - FRAC_PI_2).abs() < 1e-12);
    assert_eq!(heading.source, "/fmu/out/vehicle_attitude.q");
}

/// The two places of a track's ends, degrees and metres.
fn ends(log: &Log) -> Vec<[f64; 3]> {
    let found = super::flight::all_series(log);
    let places = places(&found, Navigation::Autopilot);
    let ends = [places.first().unwrap(), places.last().unwrap()];
    ends.map(|(_, p)| [p.latitude.to_degrees(), p.longitude.to_degrees(), p.height])
        .to_vec()
}

#[test]
fn the_autopilots_own_place_stands_beside_that_of_the_receiver() {
    let mut log = eastward();
    let fields = [
        ("Lat", "deglatitude"),
        ("Lng", "deglongitude"),
        ("Alt", "m"),
    ];
    let rows = [vec![0.0, 47.0, 8.0, 501.0], vec![5.0, 47.001, 8.001, 507.0]];
    add(&mut log, "POS", &fields, &rows);
    let expected = [[47.0, 8.0, 501.0], [47.001, 8.001, 507.0]];
    for (found, expected) in ends(&log).iter().flatten().zip(expected.iter().flatten()) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
    let flight = flight_from_log(&log).into_flight().unwrap();
    // A thousandth of a degree of latitude and of longitude there.
    let north = flight.value(ChannelName::AutopilotNorth, 5.0).unwrap();
    let east = flight.value(ChannelName::AutopilotEast, 5.0).unwrap();
    assert!(
        (north - 111.17).abs() < 0.03 && (east - 76.05).abs() < 0.03,
        "{north} {east}"
    );
    assert_eq!(flight.value(ChannelName::AutopilotHeight, 5.0), Some(507.0));
}

#[test]
fn the_first_receiver_that_has_a_fix_says_where_it_was_in_whatever_order_they_are_logged() {
    let fields = [
        ("Status", ""),
        ("Lat", "deglatitude"),
        ("Lng", "deglongitude"),
        ("Alt", "m"),
    ];
    let rows = |status: f64, latitude: f64| -> Vec<Vec<f64>> {
        let row = |i: f64| vec![i, status, latitude + 1e-5 * i, 8.0, 500.0 + i];
        (0..5).map(|i| row(f64::from(i))).collect()
    };
    for (receivers, expected) in [
        ([(0, 0.0, 0.0), (1, 3.0, 47.0)], Some(47.0)),
        ([(1, 3.0, 47.0), (0, 1.0, 9.0)], Some(47.0)),
        ([(1, 3.0, 47.0), (0, 3.0, 48.0)], Some(48.0)),
        ([(0, 3.0, 48.0), (1, 3.0, 47.0)], Some(48.0)),
        ([(0, 0.0, 9.0), (1, 0.0, 10.0)], None),
    ] {
        let mut log = Log::new("two.bin", LogFormat::Dataflash);
        for (instance, status, latitude) in receivers {
            let name = TopicName {
                name: "GPS".to_owned(),
                instance: Some(instance),
            };
            add_topic(&mut log, &name, &fields, &rows(status, latitude));
        }
        let found = places(&super::flight::all_series(&log), Navigation::Gps);
        let first = found
            .first()
            .map(|place| place.1.latitude.to_degrees().round());
        assert_eq!(first, expected, "{receivers:?}");
    }
}

#[test]
fn a_second_receiver_of_a_kind_of_its_own_is_taken_where_the_first_has_no_fix() {
    let row = |i: f64, fix: f64, unit: f64, place: [f64; 2]| {
        vec![i, fix, unit * (place[0] + 1e-5 * i), unit * place[1]]
    };
    let kinds = [
        (
            LogFormat::Dataflash,
            ["GPS", "GPS2"],
            ["Status", "Lat", "Lng"],
            1.0,
        ),
        (
            LogFormat::Tlog,
            ["GPS_RAW_INT", "GPS2_RAW"],
            ["fix_type", "lat", "lon"],
            1e7,
        ),
    ];
    for (format, names, fields, unit) in kinds {
        for (fix, expected) in [(1.0, 48.0), (3.0, 47.0)] {
            let mut log = Log::new("two", format);
            let fields = fields.map(|field| (field, ""));
            let rows = |fix: f64, place| -> Vec<Vec<f64>> {
                (0..5)
                    .map(|i| row(f64::from(i), fix, unit, place))
                    .collect()
            };
            let first = if fix < 2.0 { [0.0; 2] } else { [47.0, 8.0] };
            add(&mut log, names[0], &fields, &rows(fix, first));
            add(&mut log, names[1], &fields, &rows(3.0, [48.0, 9.0]));
            let found = places(&super::flight::all_series(&log), Navigation::Gps);
            assert_eq!(found.len(), 5, "{format:?} {fix}");
            let latitude = found[0].1.latitude.to_degrees();
            assert!((latitude - expected).abs() < 1e-3, "{format:?}: {latitude}");
        }
    }
}

#[test]
fn a_log_without_a_receiver_is_placed_by_the_autopilot() {
    let mut log = Log::new("own.bin", LogFormat::Dataflash);
    let fields = [
        ("Lat", "deglatitude"),
        ("Lng", "deglongitude"),
        ("Alt", "m"),
    ];
    let rows: Vec<_> = (0..5)
        .map(|i| vec![f64::from(i), 47.0 + 1e-5 * f64::from(i), 8.0, 500.0])
        .collect();
    add(&mut log, "POS", &fields, &rows);
    // With a receiver that never knows where it is, it is the same.
    for has_receiver in [false, true] {
        if has_receiver {
            let fields = [fields.as_slice(), &[("Status", "")]].concat();
            let unfixed = (0..5).map(|i| vec![f64::from(i), 0.0, 0.0, 0.0, 1.0]);
            add(&mut log, "GPS", &fields, &unfixed.collect::<Vec<_>>());
        }
        let latitude = series(&log, Role::Latitude).unwrap();
        assert_eq!(
            (latitude.role, latitude.source.as_str()),
            (Role::Latitude, "POS.Lat")
        );
        let interpreted = flight_from_log(&log);
        let found = &interpreted.measured().found;
        assert_eq!(places(found, Navigation::Gps).len(), 5);
        assert_eq!(estimated_places(found), Some("POS.Lat"));
        let told = crate::overview::overview(&log, &interpreted.measured());
        let is_told =
            |f: &crate::overview::Finding| f.text.contains("autopilot's own estimate (POS.Lat)");
        assert!(told.findings.iter().any(is_told), "{:?}", told.findings);
        let is_called_gps = |s: &crate::overview::Sensor| s.role == Role::GpsHeight;
        assert!(!told.sensors.iter().any(is_called_gps));
        // No channel says that a receiver measured it.
        let flight = interpreted.into_flight().unwrap();
        assert_eq!(flight.truth.as_ref().map(|t| t.states.len()), Some(5));
        let has = |name| flight.channel(name).is_some();
        assert!(!has(ChannelName::GpsNorth) && has(ChannelName::AutopilotNorth));
    }
    assert_eq!(estimated_places(&flight_from_log(&eastward()).found), None);
}

#[test]
fn of_a_receiver_that_never_has_a_fix_nothing_of_a_place_counts() {
    let fields = [
        ("Lat", "deglatitude"),
        ("Lng", "deglongitude"),
        ("Alt", "m"),
        ("Status", ""),
    ];
    let flown = |i: u32, fix: f64| {
        let north = 1e-5 * f64::from(i);
        vec![f64::from(i), 47.0 + north, 8.0, 500.0 + f64::from(i), fix]
    };
    let last_known = |i: u32, fix: f64| vec![f64::from(i), 46.9, 8.4, 480.0, fix];
    let nowhere = |i: u32, fix: f64| vec![f64::from(i), 0.0, 0.0, -17.0, fix];
    let wandering = |i: u32, fix: f64| {
        let east = 1e-4 * f64::from(i * i);
        vec![f64::from(i), 46.9, 8.4 + east, 480.0 - f64::from(i), fix]
    };
    for (receiver, name) in [
        (&last_known as &dyn Fn(u32, f64) -> Vec<f64>, "last known"),
        (&nowhere, "nowhere"),
        (&wandering, "wandering"),
    ] {
        // With a fix its places count, even if they stand still, but not noughts.
        for fix in [1.0, 3.0] {
            let mut log = Log::new("own.bin", LogFormat::Dataflash);
            let rows = |of: &dyn Fn(u32, f64) -> Vec<f64>| -> Vec<Vec<f64>> {
                (0..5).map(|i| of(i, fix)).collect()
            };
            add(
                &mut log,
                "POS",
                &fields[..3],
                &rows(&|i, fix| flown(i, fix)[..4].to_vec()),
            );
            add(&mut log, "GPS", &fields, &rows(receiver));
            let is_lost = fix < 2.0 || name == "nowhere";
            let expected = if is_lost { "POS" } else { "GPS" };
            for (role, field) in [
                (Role::Latitude, "Lat"),
                (Role::Longitude, "Lng"),
                (Role::GpsHeight, "Alt"),
            ] {
                let source = series(&log, role).unwrap().source;
                assert_eq!(source, format!("{expected}.{field}"), "{name} {fix}");
            }
            if is_lost {
                let interpreted = flight_from_log(&log);
                let places = places(interpreted.measured().found, Navigation::Gps);
                assert_eq!(places.len(), 5, "{name}");
                assert!((places[4].1.height - 504.0).abs() < 1e-9, "{name}");
            }
        }
    }
}

#[test]
fn what_mavlink_says_nobody_knows_is_no_value() {
    let mut log = Log::new("link.tlog", LogFormat::Tlog);
    let fields = || {
        vec![
            FieldLayout::plain("vel", FieldKind::U16, 0),
            FieldLayout::plain("cog", FieldKind::U16, 2),
            FieldLayout::plain("satellites_visible", FieldKind::U8, 4),
        ]
    };
    let place = log.topic_or_new(&TopicName::single("GPS_RAW_INT"), fields);
    // 5 m/s northward by 9 satellites; nothing is known; a speed without a course.
    for (time, row) in [
        (0.0, [0xf4, 1, 0, 0, 9]),
        (1.0, [255; 5]),
        (2.0, [0xf4, 1, 255, 255, 8]),
    ] {
        log.topics[place].push(time, &row);
    }
    let of = |role| series(&log, role).unwrap();
    for role in [Role::GroundSpeed, Role::GpsSatellites] {
        assert_eq!(of(role).times, [0.0, 2.0], "{role:?}");
    }
    let north = of(Role::GpsVelocityNorth);
    assert_eq!((north.times, north.values), (vec![0.0], vec![5.0]));
}

#[test]
fn a_quaternion_whose_parts_are_numbered_from_one_is_an_attitude() {
    let mut log = Log::new("link.tlog", LogFormat::Tlog);
    let names = ["q1", "q2", "q3", "q4"];
    let half = 0.4_f64;
    let row = |time| vec![time, half.cos(), 0.0, 0.0, half.sin()];
    add(
        &mut log,
        "ATTITUDE_QUATERNION",
        &names.map(|name| (name, "")),
        &[row(0.0), row(1.0)],
    );
    let heading = series(&log, Role::Heading).unwrap();
    assert!((heading.values[1] - 2.0 * half).abs() < 1e-12);
}

#[test]
fn metres_from_the_origin_of_the_filter_are_a_place_as_the_autopilot_reckons() {
    let mut log = eastward();
    let metres = [("PN", "m"), ("PE", "m"), ("PD", "m")];
    let rows = [
        vec![0.0, 0.0, 0.0, -1.0],
        vec![5.0, 1_113.188_450_2, -500.0, -20.0],
    ];
    add(&mut log, "XKF1", &metres, &rows);
    // Without an origin nobody knows where that is.
    assert!(series(&log, Role::AutopilotLatitude).is_none());
    let fields = [("Type", ""), ("Lat", "deg"), ("Lng", "deg"), ("Alt", "m")];
    let places = [
        vec![0.0, 1.0, 9.0, 9.0, 9.0],
        vec![0.0, 0.0, 47.0, 8.0, 500.0],
    ];
    add(&mut log, "ORGN", &fields, &places);
    let found = ends(&log);
    assert!(
        (found[1][0] - 47.01).abs() < 1e-9 && (found[1][2] - 520.0).abs() < 1e-9,
        "{found:?}"
    );
    // Metres of a degree of longitude halfway between 47 and 47.01 degrees.
    let wide = 111_318.845_02 * 47.005_f64.to_radians().cos();
    assert!(
        (found[1][1] - (8.0 - 500.0 / wide)).abs() < 1e-9,
        "{found:?}"
    );
}
