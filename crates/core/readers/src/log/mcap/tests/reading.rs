//! Tests of reading sound files.

use super::super::super::testing::{self, essence};
use super::super::super::{Log, ReadReport, TopicName};
use super::super::INFO;
use super::written::{
    PACKINGS, Packing, Written, channel, chunk, description, flight, message, messages, record,
    schema, text,
};

fn read(file: &[u8]) -> Log {
    testing::read(&INFO, file, 1000)
}

#[test]
fn every_message_is_read_however_it_is_packed() {
    let mut essences = Vec::new();
    for packing in [None].into_iter().chain(PACKINGS.map(Some)) {
        let file = flight(25, packing);
        let mut log = read(&file);
        assert!(
            log.report.is_clean() && log.report.remarks.is_empty(),
            "{:?}",
            log.report
        );
        assert_eq!(
            (log.report.messages, log.report.used_bytes),
            (25, file.len() as u64)
        );
        let topic = log
            .topic(&TopicName::single("/turn"))
            .expect("there are turns");
        assert_eq!(topic.schema, "my_msgs/msg/Turn");
        assert_eq!(topic.times[24], 2.4);
        assert_eq!(topic.values("angle").expect("there are angles")[24], 3.0);
        assert_eq!(
            topic.values("rates.length").expect("there are lengths")[..4],
            [0.0, 1.0, 2.0, 0.0]
        );
        let second = topic.values("rates[1]").expect("there are rates");
        assert!(second[2] == 1.5 && second[3].is_nan());
        assert_eq!(topic.texts("name").expect("there are names")[7], "one");
        assert_eq!(topic.values("flags[0]").expect("there are flags")[7], 7.0);
        assert_eq!(log.utc_at_zero, Some(1.7e9));
        log.report = ReadReport::default();
        essences.push(essence(&log));
    }
    assert!(essences.iter().all(|log| *log == essences[0]));
}

#[test]
fn messages_wait_for_a_description_that_comes_with_the_summary() {
    let file = Written::new()
        .and(&chunk(Packing::Not, &messages(0, 10)))
        .end(10, &description());
    let log = read(&file);
    assert_eq!(
        log.first("/turn").map(super::super::super::Topic::len),
        Some(10)
    );
    assert!(log.report.remarks.is_empty(), "{:?}", log.report.remarks);
}

#[test]
fn messages_out_of_order_are_put_in_order_and_a_clock_set_back_is_not_hidden() {
    let times = |order: &[u64]| {
        let all: Vec<u8> = order.iter().flat_map(|index| messages(*index, 1)).collect();
        let file = Written::new().and(&description()).and(&all);
        let log = read(&file.end(order.len() as u64, &description()));
        let topic = log.first("/turn").expect("there are turns");
        let angles = topic.values("angle").expect("there are angles");
        let zero = order[0] as f64;
        for (time, angle) in topic.times.iter().zip(angles) {
            // Messages are a tenth of a second apart, and angles grow by an eighth.
            assert!((10.0 * time + zero - 8.0 * angle).abs() < 1e-6);
        }
        topic
            .times
            .iter()
            .map(|time| (10.0 * time + zero).round() as u64)
            .collect::<Vec<_>>()
    };
    assert_eq!(times(&[3, 1, 2, 0, 5, 4]), [0, 1, 2, 3, 4, 5]);
    assert_eq!(times(&[3, 4, 5, 0, 1, 2]), [0, 1, 2, 3, 4, 5]);
    assert_eq!(times(&[5, 4, 3, 2, 1, 0]), [0, 1, 2, 3, 4, 5]);
    assert_eq!(times(&[0, 1, 3, 2, 4, 5]), [0, 1, 2, 3, 4, 5]);
    let joined =
        |parts: &[std::ops::Range<u64>]| -> Vec<u64> { parts.iter().cloned().flatten().collect() };
    let ordered: Vec<u64> = (0..60).collect();
    for late in [
        [0..20, 40..60, 20..40, 60..60],
        [0..15, 30..45, 15..30, 45..60],
        [0..30, 31..32, 30..31, 32..60],
        [30..60, 0..20, 20..30, 60..60],
    ] {
        assert_eq!(times(&joined(&late)), ordered, "{late:?}");
    }
    for set_back in [
        vec![0..20, 10..30],
        vec![0..20, 10..30, 20..40],
        vec![20..60, 0..15, 10..30],
    ] {
        let order = joined(&set_back);
        assert_eq!(times(&order), order, "{set_back:?}");
    }
}

#[test]
fn messages_logged_in_bursts_have_the_times_of_their_headers() {
    let definition = b"std_msgs/Header header\nfloat64 angle\n";
    // Of every so many stamps one repeats that before it.
    let read_astray = |has_stamps: bool, burst: u64, every: u64| {
        let mut file = Written::new()
            .and(&schema(3, "my_msgs/msg/Turn", "ros2msg", definition))
            .and(&channel(7, 3, "/turn", "cdr"));
        for index in 0..120_u64 {
            let stamped = index - u64::from(index % every == every / 2);
            let made = 1_000 + stamped / 10 * u64::from(has_stamps);
            let mut data = vec![0, 1, 0, 0];
            data.extend((made as i32).to_le_bytes());
            let part = if has_stamps {
                stamped % 10 * 100_000_000
            } else {
                0
            };
            data.extend((part as u32).to_le_bytes());
            data.extend([1, 0, 0, 0, 0, 0, 0, 0]);
            data.extend((index as f64).to_le_bytes());
            // Handed over every two seconds, when the last of them is made.
            let logged =
                1_700_000_000_000_000_000 + (index / burst * burst + burst - 1) * 100_000_000;
            file = file.and(&message(7, logged, &data));
        }
        read(&file.end(120, &[]))
    };
    let read_with = |has_stamps, burst| read_astray(has_stamps, burst, u64::MAX);
    // A few that are wrong do not hide the others; of many nothing is known, which is told.
    for (every, is_used) in [(100, true), (30, true), (5, false)] {
        let log = read_astray(true, 20, every);
        let times = &log.first("/turn").expect("there are turns").times;
        let is_regular = (times[51] - times[41] - 1.0).abs() < 1e-6;
        assert_eq!(is_regular, is_used, "{every}: {times:?}");
        let mut told = log.report.remarks.iter();
        let told = told.find(|r| r.contains("in bursts")).expect("it is told");
        assert_eq!(told.contains("24 of their 120"), !is_used, "{told}");
    }
    let log = read_with(true, 20);
    let times = &log.first("/turn").expect("there are turns").times;
    assert_eq!(times.len(), 120);
    for (index, time) in times.iter().enumerate() {
        // The first burst was logged at second 0, with its last message.
        let expected = 0.1 * (index as f64 - 19.0);
        assert!((time - expected).abs() < 1e-6, "{index}: {time}");
    }
    let remarks = &log.report.remarks;
    assert!(
        remarks.iter().any(|r| r.contains("in bursts")),
        "{remarks:?}"
    );
    // Stamps that stand still say nothing, and what is logged at once needs none.
    for (has_stamps, burst) in [(false, 20), (true, 1)] {
        let log = read_with(has_stamps, burst);
        let told = log.report.remarks.iter().any(|r| r.contains("in bursts"));
        assert!(!told, "{has_stamps} {burst}");
    }
}

#[test]
fn messages_that_nobody_describes_keep_their_times_and_lengths() {
    let file = Written::new()
        .and(&message(9, 5_000, b"abc"))
        .and(&message(9, 6_000, b""))
        .0;
    let log = read(&file);
    let topic = log.first("channel 9").expect("there is a topic for it");
    assert_eq!(topic.values("bytes"), Some(vec![3.0, 0.0]));
    assert_eq!(topic.times, [0.0, 1e-6]);
    assert!(
        log.report
            .remarks
            .iter()
            .any(|r| r.contains("described nowhere"))
    );
}

#[test]
fn messages_in_a_form_that_is_not_known_keep_their_times_and_lengths_and_are_told() {
    let file = Written::new()
        .and(&schema(1, "Odd", "flatbuffer", b"?"))
        .and(&channel(1, 1, "/odd", "flatbuffer"))
        .and(&message(1, 0, &[0; 40]));
    let log = read(&file.end(1, &[]));
    let topic = log.first("/odd").expect("there is a topic for it");
    assert_eq!(topic.values("bytes"), Some(vec![40.0]));
    assert_eq!(log.report.remarks.len(), 1);
    assert!(log.report.remarks[0].contains("flatbuffer"));
    assert!(log.report.is_clean());
}

#[test]
fn json_messages_may_differ_from_one_another() {
    let mut file = Written::new().and(&channel(1, 0, "/state", "json"));
    let says = [
        r#"{"a":{"b":1.5,"on":true},"list":[1,2],"id":18000000000000000001}"#,
        r#"{"a":{"b":"none"},"late":-3,"list":[]}"#,
        r#"{"a":null,"late":4}"#,
    ];
    for (i, says) in says.iter().enumerate() {
        file = file.and(&message(1, i as u64, says.as_bytes()));
    }
    let log = read(&file.end(3, &[]));
    assert!(
        log.report.is_clean() && log.report.remarks.is_empty(),
        "{:?}",
        log.report
    );
    let topic = log.first("/state").expect("there are states");
    let values = |name| topic.values(name).unwrap_or_else(|| panic!("no {name}"));
    assert_eq!(values("a.on"), [1.0, 0.0, 0.0]);
    assert!(values("a.b")[0] == 1.5 && values("a.b")[1].is_nan());
    assert_eq!(
        topic.texts("a.b.text").expect("there is a text"),
        ["", "none", ""]
    );
    assert!(values("late")[0].is_nan() && values("late")[1..] == [-3.0, 4.0]);
    assert_eq!(values("list.length"), [2.0, 0.0, 0.0]);
    let id = topic.field("id").expect("there is an id");
    let row = topic
        .rows
        .get(0)
        .and_then(|row| id.bytes(row))
        .expect("there is a row");
    assert_eq!(id.kind.integer(row), Some(18_000_000_000_000_000_001));
}

#[test]
fn two_kinds_of_message_under_one_name_are_two_topics() {
    let other = schema(4, "my_msgs/msg/Other", "ros2msg", b"uint16 word\n");
    let file = Written::new()
        .and(&description())
        .and(&messages(0, 2))
        .and(&[other, channel(8, 4, "/turn", "cdr")].concat())
        .and(&message(8, 1_700_000_000_150_000_000, &[0, 1, 0, 0, 5, 1]))
        .and(&messages(2, 1));
    let log = read(&file.end(4, &[]));
    let names: Vec<_> = log
        .topics
        .iter()
        .map(|t| (t.name.to_string(), t.len()))
        .collect();
    assert_eq!(names, [("/turn".to_owned(), 3), ("/turn[1]".to_owned(), 1)]);
    assert_eq!(log.topics[1].values("word"), Some(vec![261.0]));
}

#[test]
fn what_is_attached_and_said_of_the_file_is_told() {
    let contents = [
        &[0; 16][..],
        &text("calib.yaml"),
        &text("text/yaml"),
        &3_u64.to_le_bytes(),
        b"a:1",
    ];
    let contents = contents.concat();
    let checksum = crc32fast::hash(&contents).to_le_bytes();
    let pairs = [text("robot"), text("x8")].concat();
    let pairs = [&(pairs.len() as u32).to_le_bytes(), &*pairs].concat();
    let file = Written::new()
        .and(&record(9, &[&contents, &checksum]))
        .and(&record(12, &[&text("site"), &pairs]))
        .end(0, &[]);
    for piece in [1, 30, file.len()] {
        let log = testing::read(&INFO, &file, piece);
        let facts: Vec<_> = log
            .facts
            .iter()
            .map(|f| (f.name.as_str(), f.text.as_str()))
            .collect();
        let expected = [
            ("profile", "test"),
            ("library", "by hand"),
            ("attached: calib.yaml", "text/yaml, 3 bytes"),
            ("site: robot", "x8"),
        ];
        assert_eq!(facts, expected);
        assert!(
            log.report.is_clean() && log.report.remarks.is_empty(),
            "{:?}",
            log.report
        );
    }
}

#[test]
fn words_and_modes_of_the_vehicle_are_told_as_such() {
    let log_text = b"uint8 level\nstring name\nstring msg\n";
    let state_text = b"bool armed\nstring mode\n";
    let mut file = Written::new()
        .and(&schema(1, "rcl_interfaces/msg/Log", "ros2msg", log_text))
        .and(&channel(1, 1, "/rosout", "cdr"))
        .and(&schema(2, "mavros_msgs/msg/State", "ros2msg", state_text))
        .and(&channel(2, 2, "/mavros/state", "cdr"));
    let words = [
        &[0, 1, 0, 0, 30, 0, 0, 0][..],
        &text("a"),
        &[0; 3],
        &text("low battery\0"),
    ]
    .concat();
    file = file.and(&message(1, 0, &words));
    for (time, mode) in [(1, "AUTO\0"), (2, "AUTO\0"), (3, "RTL\0")] {
        let state = [&[0, 1, 0, 0, 1, 0, 0, 0][..], &text(mode)].concat();
        file = file.and(&message(2, time * 1_000_000_000, &state));
    }
    let log = read(&file.0);
    assert_eq!(log.messages.len(), 1, "{:?}", log.report);
    assert_eq!(
        (log.messages[0].severity, log.messages[0].text.as_str()),
        (Some(4), "low battery")
    );
    let modes: Vec<_> = log
        .modes
        .iter()
        .map(|m| (m.time, m.mode.as_str()))
        .collect();
    assert_eq!(modes, [(1.0, "AUTO"), (3.0, "RTL")]);
}

#[test]
fn a_list_longer_than_is_kept_tells_its_length_and_that() {
    let file = Written::new()
        .and(&schema(
            1,
            "a/msg/Scan",
            "ros2msg",
            b"float32[] ranges\nuint8[] picture\nuint16 behind\n",
        ))
        .and(&channel(1, 1, "/scan", "cdr"));
    let mut data = vec![0, 1, 0, 0, 100, 0, 0, 0];
    (0..100_u8).for_each(|i| data.extend(f32::from(i).to_le_bytes()));
    data.extend([6, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 0]);
    let log = read(&file.and(&message(1, 0, &data)).0);
    let topic = log.first("/scan").expect("there is a scan");
    let value = |name| topic.values(name).unwrap_or_else(|| panic!("no {name}"))[0];
    assert_eq!((value("ranges.length"), value("ranges[63]")), (100.0, 63.0));
    assert_eq!((value("picture.length"), value("behind")), (6.0, 7.0));
    assert_eq!(topic.field("ranges[64]"), None);
    assert!(
        log.report
            .remarks
            .iter()
            .any(|r| r.contains("ranges beyond")),
        "{:?}",
        log.report
    );
}

#[test]
fn heights_of_a_fix_of_ros_are_told_to_be_above_the_ellipsoid() {
    let told = |kind: &str, height: f64| {
        let definition = b"float64 latitude\nfloat64 longitude\nfloat64 altitude\n";
        let mut file = Written::new()
            .and(&schema(3, kind, "ros2msg", definition))
            .and(&channel(7, 3, "/fix", "cdr"));
        for time in 1..10 {
            let place = [47.5, 8.5, height].map(f64::to_le_bytes);
            let data = [&[0, 1, 0, 0], place.as_flattened()].concat();
            file = file.and(&message(7, 1_000_000_000 * time, &data));
        }
        let log = read(&file.end(9, &[]));
        let mut remarks = log.report.remarks.iter();
        remarks.any(|it| it.contains("/fix.altitude is above the ellipsoid"))
    };
    assert!(told("sensor_msgs/msg/NavSatFix", 600.0));
    // A receiver without a height, and a message whose heights are above the sea.
    assert!(!told("sensor_msgs/msg/NavSatFix", f64::NAN));
    assert!(!told("gps_msgs/msg/GPSFix", 600.0));
}
