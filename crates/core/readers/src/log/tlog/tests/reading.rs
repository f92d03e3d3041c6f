//! Tests of reading sound files.

use super::super::super::{
    Log, LogFormat, LogMessage, ModeChange, Topic, TopicName, recognise, testing,
};
use super::super::INFO;
use super::written::Written;
use crate::interpret::{factor_of_unit, series};
use crate::role::{Role, RowReading};

fn read(file: &Written, piece: usize) -> Log {
    let log = testing::read(&INFO, &file.bytes, piece);
    assert!(log.report.is_clean(), "{:?}", log.report);
    log
}

fn topic<'a>(log: &'a Log, name: &str, instance: u32) -> &'a Topic {
    let name = TopicName {
        name: name.to_owned(),
        instance: Some(instance),
    };
    log.topic(&name).unwrap_or_else(|| panic!("{name}"))
}

#[test]
fn both_versions_signed_or_not_make_one_topic() {
    let log = read(&Written::flight(12), 17);
    let attitude = topic(&log, "ATTITUDE", 1);
    assert_eq!(attitude.len(), 12);
    assert_eq!(attitude.times[11], 1.1);
    assert_eq!(attitude.values("time_boot_ms").unwrap()[11], 1100.0);
    assert_eq!(attitude.values("yaw").unwrap()[11], f64::from(0.11_f32));
    assert_eq!(attitude.values("yawspeed").unwrap(), [0.0; 12]);
    assert_eq!(attitude.field("roll").map(|f| f.unit.as_str()), Some("rad"));
    assert_eq!(log.utc_at_zero, Some(1.7e9));
    assert_eq!(log.report.messages, 14);
}

#[test]
fn scaled_integers_come_as_metres_and_degrees() {
    let fields: [&[u8]; 9] = [
        &5_u32.to_le_bytes(),
        &468_412_345_i32.to_le_bytes(),
        &(-919_876_543_i32).to_le_bytes(),
        &123_456_i32.to_le_bytes(),
        &0_i32.to_le_bytes(),
        &1234_i16.to_le_bytes(),
        &(-5_i16).to_le_bytes(),
        &0_i16.to_le_bytes(),
        &27_012_u16.to_le_bytes(),
    ];
    let log = read(&Written::new().version_2(0, 33, &fields), 100);
    let position = topic(&log, "GLOBAL_POSITION_INT", 1);
    let value = |name| {
        let field = position.field(name).unwrap();
        (position.value(field, 0).unwrap(), field.unit.clone())
    };
    assert_eq!(value("lat"), (46.841_234_5, "deg".to_owned()));
    assert_eq!(value("lon"), (-91.987_654_3, "deg".to_owned()));
    assert_eq!(value("alt"), (123.456, "m".to_owned()));
    assert_eq!(value("vx"), (12.34, "m/s".to_owned()));
    assert_eq!(value("hdg"), (270.12, "deg".to_owned()));
}

#[test]
fn senders_have_topics_of_their_own() {
    let file = Written::new()
        .heartbeat(0, 1, 3, 0)
        .from(1, 154)
        .heartbeat(1, 26, 8, 0)
        .from(255, 190)
        .heartbeat(2, 6, 8, 0);
    let log = read(&file, 100);
    for instance in [1, 1154, 255] {
        assert_eq!(topic(&log, "HEARTBEAT", instance).len(), 1);
    }
    assert_eq!(log.topics.len(), 3);
}

#[test]
fn modes_have_the_names_of_their_autopilot() {
    let modes = |kind, autopilot, numbers: &[u32]| {
        let mut file = Written::new();
        for (second, number) in numbers.iter().enumerate() {
            let time = second as u64 * 1_000_000;
            file = file.from(255, 190).heartbeat(time, 6, 8, 77).from(1, 1);
            file = file.heartbeat(time, kind, autopilot, *number);
        }
        read(&file, 64).modes
    };
    let named = |names: &[(f64, &str)]| -> Vec<_> {
        let change = |(time, mode): &(f64, &str)| ModeChange {
            time: *time,
            mode: (*mode).to_owned(),
        };
        names.iter().map(change).collect()
    };
    assert_eq!(
        modes(1, 3, &[5, 5, 10]),
        named(&[(0.0, "FBWA"), (2.0, "AUTO")])
    );
    assert_eq!(
        modes(2, 3, &[5, 9]),
        named(&[(0.0, "LOITER"), (1.0, "LAND")])
    );
    assert_eq!(
        modes(10, 3, &[15, 99]),
        named(&[(0.0, "GUIDED"), (1.0, "99")])
    );
    let px4 = [0x0003_0000, 0x0404_0000, 0x0904_0000];
    let expected = [
        (0.0, "Position"),
        (1.0, "Mission"),
        (2.0, "Precision Landing"),
    ];
    assert_eq!(modes(2, 12, &px4), named(&expected));
}

#[test]
fn parameters_are_floats_or_the_bytes_of_their_type() {
    let log = |autopilot| {
        let file = Written::new()
            .parameter(0, "ARSPD_RATIO", 2.5_f32.to_le_bytes(), 9)
            .heartbeat(1_000_000, 1, autopilot, 0)
            .parameter(2_000_000, "SYS_AUTOSTART", 2100_i32.to_le_bytes(), 6)
            .parameter(3_000_000, "ARSPD_RATIO", 2.5_f32.to_le_bytes(), 9)
            .parameter(4_000_000, "ARSPD_RATIO", 3.0_f32.to_le_bytes(), 9)
            .from(1, 154)
            .parameter(5_000_000, "ARSPD_RATIO", 7.0_f32.to_le_bytes(), 9);
        read(&file, 33)
    };
    let px4 = log(12);
    let found: Vec<_> = px4
        .parameters
        .iter()
        .map(|p| (p.time, p.name.as_str(), p.value))
        .collect();
    let expected = [
        (0.0, "ARSPD_RATIO", 2.5),
        (2.0, "SYS_AUTOSTART", 2100.0),
        (4.0, "ARSPD_RATIO", 3.0),
    ];
    assert_eq!(found, expected);
    let float = f64::from(f32::from_bits(2100));
    assert_eq!(log(3).parameter("SYS_AUTOSTART"), Some(float));
}

#[test]
fn words_in_pieces_become_one_text() {
    let long = "x".repeat(50);
    let file = Written::new()
        .words(0, 6, "short", 0, 0)
        .words(1_000_000, 2, &long, 7, 0)
        .from(2, 1)
        .words(1_100_000, 9, "between", 7, 0)
        .from(1, 1)
        .words(1_200_000, 2, &long, 7, 1)
        .words(1_300_000, 2, "end", 7, 3)
        .words(1_400_000, 2, "new", 7, 0);
    let said = |time, source, severity, text: &str| LogMessage {
        time,
        source: Some(source),
        severity,
        text: text.to_owned(),
    };
    assert_eq!(
        read(&file, 50).messages,
        [
            said(0.0, 1, Some(6), "short"),
            said(1.0, 1, Some(2), &format!("{long}{long} … end")),
            said(1.1, 2, None, "between"),
            said(1.4, 1, Some(2), "new"),
        ]
    );
}

#[test]
fn the_vehicle_is_named_by_its_words_or_else_by_its_heartbeat_and_version() {
    let version = [&[0; 16][..], &0x0405_01ff_u32.to_le_bytes(), &[1]];
    let file = Written::new()
        .heartbeat(0, 1, 3, 0)
        .version_2(1, 148, &version);
    assert_eq!(read(&file, 9).vehicle, "ArduPilot v4.5.1, aeroplane");
    let file = file.words(2, 6, "ArduPlane V4.5.1 (0123abcd)", 0, 0);
    assert_eq!(read(&file, 9).vehicle, "ArduPlane V4.5.1 (0123abcd)");
    let file = Written::new().heartbeat(0, 20, 12, 0);
    assert_eq!(read(&file, 9).vehicle, "PX4, vertical take-off aeroplane");
}

#[test]
fn a_file_is_known_by_its_first_message() {
    let known = |bytes: &[u8]| recognise(bytes).map(|info| info.format) == Some(LogFormat::Tlog);
    let file = Written::flight(3).bytes;
    assert!(known(&file));
    let mut damaged = file.clone();
    damaged[20] ^= 1;
    assert!(known(&damaged), "the second message tells it");
    let mut alone = Written::new().heartbeat(0, 1, 3, 0).bytes;
    alone[20] ^= 1;
    assert!(!known(&alone));
    // A first message of a kind that is not known.
    let file = Written::new()
        .version_2(0, 65_000, &[&[1, 2]])
        .heartbeat(1, 1, 3, 0)
        .bytes;
    assert!(known(&file));
    assert!(!known(&file[..20]));
    assert!(!known(
        b"no log at all, but a text of some length \xfe with \xfd bytes"
    ));
    assert!(!known(&[0; 4096]));
}

#[test]
fn every_unit_that_a_definition_states_is_known_where_a_role_is_read() {
    let mut dialect = super::super::dialect::Dialect::default();
    let kinds: Vec<_> = (0..400)
        .filter_map(|number| {
            dialect
                .get(number)
                .map(|kind| (kind.name, kind.fields.clone()))
        })
        .collect();
    for source in super::super::MEANING.roles.iter().copied().flatten() {
        let RowReading::Field(name, _) = source.reading else {
            continue;
        };
        let (_, fields) = kinds
            .iter()
            .find(|(kind, _)| *kind == source.topic)
            .unwrap();
        let unit = &fields.iter().find(|field| field.name == name).unwrap().unit;
        let is_known = unit.is_empty() || factor_of_unit(unit).is_some();
        assert!(is_known, "{}.{name} in {unit}", source.topic);
    }
}

#[test]
fn accelerations_in_thousandths_of_gravity_are_metres_a_second_squared() {
    let raw = |force: i16| -> Vec<u8> {
        let parts: [&[u8]; 4] = [&[0; 8], &[0; 4], &force.to_le_bytes(), &[0; 12]];
        parts.concat()
    };
    let file =
        Written::new()
            .version_2(0, 27, &[&raw(-1000)])
            .version_2(100_000, 27, &[&raw(-1010)]);
    let found = series(&read(&file, 50), Role::AccelerationDown).unwrap();
    assert!((found.values[0] + 9.806_65).abs() < 1e-9, "{found:?}");
}

#[test]
fn scaled_sensors_are_read_where_there_are_no_raw_ones() {
    let scaled = |force: i16| -> Vec<u8> {
        let rate = 200_i16.to_le_bytes();
        let parts: [&[u8]; 5] = [&[0; 4], &[0; 4], &force.to_le_bytes(), &rate, &[0; 10]];
        parts.concat()
    };
    let file = Written::new()
        .version_2(0, 26, &[&scaled(-1000)])
        .version_2(100_000, 26, &[&scaled(-1010)]);
    let log = read(&file, 50);
    let first = |role| series(&log, role).unwrap().values[0];
    assert!((first(Role::AccelerationDown) + 9.806_65).abs() < 1e-9);
    assert!((first(Role::RollRate) - 0.2).abs() < 1e-9);
}

#[test]
fn a_companion_that_is_heard_first_is_not_the_autopilot_where_no_vehicle_is_heard() {
    let place = |latitude: i32| -> Vec<u8> {
        let parts: [&[u8]; 4] = [&[0; 4], &latitude.to_le_bytes(), &[0; 19], &[1]];
        parts.concat()
    };
    let mut file = Written::new();
    for i in 0..3 {
        let time = 1000 * i;
        file = file.from(1, 191).version_2(time, 33, &[&place(100)]);
        let own = place(470_000_000 + i as i32);
        file = file.from(1, 1).version_2(time + 500, 33, &[&own]);
    }
    let log = read(&file, 61);
    assert_eq!(log.chosen_vehicle(), None);
    let found = series(&log, Role::AutopilotLatitude).unwrap();
    assert!((found.values[0].to_degrees() - 47.0).abs() < 1e-6);
}

#[test]
fn the_autopilots_own_messages_are_its_systems_whoever_spoke_first() {
    let place = |latitude: i32| -> Vec<u8> {
        let parts: [&[u8]; 3] = [&[0; 4], &latitude.to_le_bytes(), &[0; 19]];
        let mut payload = parts.concat();
        payload.push(1);
        payload
    };
    let beat = |kind: u8, autopilot: u8| [0, 0, 0, 0, kind, autopilot, 81, 4, 3];
    let mut file = Written::new().version_2(0, 0, &[&beat(1, 3)]);
    for i in 0..3 {
        let time = 1000 * i;
        file = file
            .from(1, 191)
            .version_2(time, 33, &[&place(100 + i as i32)]);
        file = file
            .from(1, 1)
            .version_2(time + 500, 33, &[&place(470_000_000 + i as i32)]);
    }
    let log = read(&file, 61);
    assert_eq!(
        topic(&log, "GLOBAL_POSITION_INT", 1).values("lat").unwrap()[0],
        47.0
    );
    assert_eq!(topic(&log, "GLOBAL_POSITION_INT", 1191).len(), 3);
    let found = series(&log, Role::AutopilotLatitude).unwrap();
    assert!(
        (found.values[0].to_degrees() - 47.0).abs() < 1e-9,
        "{found:?}"
    );
}

#[test]
fn an_antenna_that_follows_the_vehicle_is_not_the_flight() {
    let beat = |kind: u8| [0, 0, 0, 0, kind, 3, 81, 4, 3];
    let file = Written::new().from(2, 1).version_2(0, 0, &[&beat(5)]);
    let file = file.from(1, 1).version_2(1000, 0, &[&beat(1)]);
    let log = read(&file, 40);
    assert_eq!(log.vehicles, [1]);
    assert_eq!(log.vehicle, "ArduPilot, aeroplane");
}

#[test]
fn messages_by_satellite_tell_place_heading_and_speeds() {
    // Wire order: time, latitude, longitude, custom mode, altitude and its target, target distance, way-point, failures, then
    // bytes: type, autopilot, heading (two degrees each), target heading, throttle, airspeed (fifths) …
    let message = |north: i32| -> Vec<u8> {
        let mut payload = [
            0_i32.to_le_bytes(),
            (470_000_000 + north).to_le_bytes(),
            85_000_000_i32.to_le_bytes(),
        ]
        .concat();
        payload.extend([0, 0]);
        payload.extend(600_i16.to_le_bytes());
        payload.extend([0; 8]);
        payload.extend([1, 3, 45, 0, 50, 90, 0, 60]);
        payload.extend([1; 10]);
        payload
    };
    let file = Written::new().version_2(0, 235, &[&message(0)]).version_2(
        1_000_000,
        235,
        &[&message(1000)],
    );
    let log = read(&file, 64);
    let first = |role| series(&log, role).unwrap().values[0];
    assert!((first(Role::Latitude).to_degrees() - 47.0).abs() < 1e-9);
    assert!((first(Role::Longitude).to_degrees() - 8.5).abs() < 1e-9);
    assert_eq!(first(Role::GpsHeight), 600.0);
    assert!((first(Role::Heading).to_degrees() - 90.0).abs() < 1e-9);
    assert_eq!(
        (first(Role::Airspeed), first(Role::GroundSpeed)),
        (18.0, 12.0)
    );
}
