//! Tests of reading sound files.

use super::super::super::{
    Fact, FieldKind, Log, LogFormat, LogMessage, ModeChange, Topic, TopicName, recognise, testing,
};
use super::super::INFO;
use super::written::Written;

fn read(file: &[u8], piece: usize) -> Log {
    testing::read(&INFO, file, piece)
}

fn instance(name: &str, instance: u32) -> TopicName {
    TopicName {
        name: name.to_owned(),
        instance: Some(instance),
    }
}

#[test]
fn rows_stay_as_they_are_and_are_decoded_by_name() {
    let file = Written::flight(4).0;
    let log = read(&file, file.len());
    assert!(log.report.is_clean(), "{:?}", log.report);
    let topic = log.topic(&instance("vehicle_status", 0)).unwrap();
    assert_eq!(topic.times, [1.0, 1.1, 1.2, 1.3]);
    assert_eq!(topic.values("p[1].a"), Some(vec![0.0, 1.0, 2.0, 3.0]));
    assert_eq!(topic.values("p[1].b"), Some(vec![2.0; 4]));
    assert_eq!(topic.values("nav_state"), Some(vec![3.0, 3.0, 5.0, 5.0]));
    assert_eq!(topic.rows.width(), 21);
    assert!(topic.field("_padding0").is_none());
    assert_eq!(log.report.messages, 5 + 4);
    assert_eq!(log.report.bytes, file.len() as u64);
}

#[test]
fn a_row_may_come_with_its_padding_and_a_file_in_any_pieces() {
    let file = Written::new(0)
        .definition("led:uint64_t timestamp;uint8_t colour;uint8_t[7] _padding0;")
        .announce(0, 2, "led")
        .row(0, &[&5_u64.to_le_bytes(), &[7], &[0; 7]])
        .row(0, &[&6_u64.to_le_bytes(), &[8]])
        .0;
    for piece in 1..file.len() {
        let log = read(&file, piece);
        assert!(log.report.is_clean());
        let topic = log.topic(&instance("led", 2)).unwrap();
        assert_eq!(topic.values("colour"), Some(vec![7.0, 8.0]));
    }
}

#[test]
fn modes_have_names_of_px4_or_their_number() {
    let mut file = Written::new(0)
        .definition("vehicle_status:uint64_t timestamp;uint8_t nav_state;")
        .announce(0, 0, "vehicle_status");
    for (time, state) in [(0_u64, 2_u8), (1, 2), (2, 11), (3, 5)] {
        file = file.row(0, &[&(time * 1_000_000).to_le_bytes(), &[state]]);
    }
    let log = read(&file.0, 1000);
    let expected = [(0.0, "Position"), (2.0, "11"), (3.0, "Return")];
    let expected = expected.map(|(time, mode)| ModeChange {
        time,
        mode: mode.to_owned(),
    });
    assert_eq!(log.modes, expected);
}

#[test]
fn parameters_change_at_the_time_of_the_latest_row_and_have_defaults() {
    let file = Written::flight(3)
        .keyed(b'P', &[], "float FW_AIRSPD_TRIM", &18.5_f32.to_le_bytes())
        .keyed(b'Q', &[3], "int32_t SYS_AUTOSTART", &2100_i32.to_le_bytes())
        .keyed(b'Q', &[1], "float FW_AIRSPD_TRIM", &15.0_f32.to_le_bytes());
    let log = read(&file.0, 1000);
    let found: Vec<_> = log.parameters.iter().map(|p| (p.time, p.value)).collect();
    assert_eq!(found, [(1.0, 15.0), (1.2, 18.5)]);
    assert_eq!(log.parameter("FW_AIRSPD_TRIM"), Some(18.5));
    let found: Vec<_> = log
        .defaults
        .iter()
        .map(|d| (d.name.as_str(), d.value, d.of_airframe))
        .collect();
    assert_eq!(
        found,
        [
            ("SYS_AUTOSTART", 2100.0, false),
            ("SYS_AUTOSTART", 2100.0, true),
            ("FW_AIRSPD_TRIM", 15.0, false)
        ]
    );
}

#[test]
fn facts_make_the_vehicle_and_words_keep_severity_and_speaker() {
    let file = Written::flight(1)
        .keyed(
            b'I',
            &[],
            "uint32_t ver_sw_release",
            &0x010e_0300_u32.to_le_bytes(),
        )
        .keyed(b'I', &[], "char[10] ver_hw", b"PX4_FMU_V5")
        .keyed(b'M', &[0], "char[5] boot", b"hello")
        .keyed(b'M', &[1], "char[2] boot", b"!!")
        .words(4, 2_500_000, "low battery")
        .message(b'C', &[b"2\x05\0", &3_000_000_u64.to_le_bytes(), b"engine"]);
    let log = read(&file.0, 1000);
    assert_eq!(log.vehicle, "PX4 v1.14.3 (development), PX4_FMU_V5");
    let texts: Vec<_> = log.facts.iter().map(|f| f.text.as_str()).collect();
    assert_eq!(texts, ["PX4", "17695488", "PX4_FMU_V5", "hello", "!!"]);
    assert_eq!(
        log.facts[3],
        Fact {
            name: "boot".to_owned(),
            text: "hello".to_owned()
        }
    );
    let words = |time, severity, source, text: &str| LogMessage {
        time,
        severity: Some(severity),
        source,
        text: text.to_owned(),
    };
    assert_eq!(
        log.messages,
        [
            words(2.5, 4, None, "low battery"),
            words(3.0, 2, Some(5), "engine")
        ]
    );
}

#[test]
fn dropouts_are_gaps_before_the_latest_row() {
    let log = read(&Written::flight(5).message(b'O', &[&[250, 0]]).sync().0, 9);
    assert!(log.report.is_clean());
    assert_eq!(log.report.gap_count, 1);
    assert_eq!(
        (log.report.gaps[0].time, log.report.gaps[0].duration),
        (1.4, 0.25)
    );
}

#[test]
fn a_receiver_with_a_fix_tells_the_time_of_day() {
    let row = |time: u64, utc: u64, fix: u8| {
        let mut row = time.to_le_bytes().to_vec();
        row.extend(utc.to_le_bytes());
        row.push(fix);
        row
    };
    let definition = "sensor_gps:uint64_t timestamp;uint64_t time_utc_usec;uint8_t fix_type;";
    let mut file = Written::new(0)
        .definition(definition)
        .announce(0, 0, "sensor_gps");
    for (time, utc, fix) in [
        (1, 0, 0),
        (2, 1_600_000_000, 0),
        (3, 1_700_000_003, 3),
        (4, 9, 3),
    ] {
        file = file.row(0, &[&row(time * 1_000_000, utc * 1_000_000, fix)]);
    }
    let log = read(&file.0, 7);
    assert_eq!(log.utc_at_zero, Some(1_700_000_000.0));
    let field = log
        .first("sensor_gps")
        .unwrap()
        .field("time_utc_usec")
        .unwrap();
    assert_eq!((field.kind, field.unit.as_str()), (FieldKind::U64, "us"));
}

#[test]
fn data_that_were_appended_are_read_even_where_the_first_part_was_cut_off() {
    let mut flags = [0_u8; 40];
    flags[8] = 1;
    let mut first = Written::new(0)
        .message(b'B', &[&flags])
        .definition("led:uint64_t timestamp;")
        .announce(0, 0, "led")
        .row(0, &[&5_u64.to_le_bytes()]);
    let good = first.0.len();
    first = first.row(0, &[&6_u64.to_le_bytes()]);
    first.0.truncate(good + 7);
    let start = first.0.len() as u64;
    first.0[16 + 3 + 16..][..8].copy_from_slice(&start.to_le_bytes());
    let file = first.keyed(b'M', &[0], "char[5] crash", b"at 17").0;
    for piece in [1, 5, file.len()] {
        let log = read(&file, piece);
        assert_eq!(log.facts[0].text, "at 17");
        assert_eq!(log.first("led").map(Topic::len), Some(1));
        let skipped = &log.report.skipped;
        assert_eq!(skipped.len(), 1);
        assert_eq!((skipped[0].offset, skipped[0].bytes), (good as u64, 7));
    }
}

#[test]
fn a_file_is_known_by_its_first_bytes() {
    let file = Written::flight(1).0;
    assert_eq!(
        recognise(&file[..64]).map(|info| info.format),
        Some(LogFormat::Ulog)
    );
    assert!(recognise(b"ULog is a format of logs, and this is text.").is_none());
    assert!(recognise(b"").is_none());
}
