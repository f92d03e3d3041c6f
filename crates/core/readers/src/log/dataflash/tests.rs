//! Small logs made by hand.

use super::super::{FieldKind, Log, LogFormat, LogReader, TopicName, ValueScale, recognise};
use super::{DataflashReader, DataflashTextReader};

/// The bytes of a binary log.
#[derive(Clone, Default)]
struct Bytes(Vec<u8>);

impl Bytes {
    fn announce(
        mut self,
        number: u8,
        length: u8,
        name: &str,
        letters: &str,
        columns: &str,
    ) -> Self {
        let mut body = vec![number, length];
        for (text, size) in [(name, 4), (letters, 16), (columns, 64)] {
            let mut bytes = text.as_bytes().to_vec();
            bytes.resize(size, 0);
            body.extend(bytes);
        }
        self = self.message(0x80, &[&body]);
        self
    }

    fn message(mut self, number: u8, fields: &[&[u8]]) -> Self {
        self.0.extend([0xa3, 0x95, number]);
        self.0.extend(fields.concat());
        self
    }

    /// A message of kind 1, `ATT`: time in microseconds, roll in hundredths of degrees.
    fn att(self, time: u64, roll: i16) -> Self {
        self.message(1, &[&time.to_le_bytes(), &roll.to_le_bytes()])
    }

    fn raw(mut self, bytes: &[u8]) -> Self {
        self.0.extend(bytes);
        self
    }
}

/// A log that announces `ATT`.
fn attitude() -> Bytes {
    Bytes::default().announce(1, 13, "ATT", "Qc", "TimeUS,Roll")
}

fn read_by(mut reader: impl LogReader, format: LogFormat, bytes: &[u8]) -> Log {
    let mut log = Log::new("log", format);
    reader.feed(bytes, &mut log);
    reader.finish(&mut log);
    let report = &log.report;
    assert_eq!(report.bytes, bytes.len() as u64);
    assert_eq!(report.used_bytes + report.skipped_bytes, report.bytes);
    log
}

fn read(bytes: &Bytes) -> Log {
    read_by(DataflashReader::new(), LogFormat::Dataflash, &bytes.0)
}

fn read_text(text: &str) -> Log {
    read_by(
        DataflashTextReader::new(),
        LogFormat::DataflashText,
        text.as_bytes(),
    )
}

fn values(log: &Log, topic: &str, field: &str) -> Vec<f64> {
    log.first(topic)
        .and_then(|t| t.values(field))
        .unwrap_or_default()
}

fn times(log: &Log, topic: &str) -> Vec<f64> {
    log.first(topic)
        .map(|t| t.times.clone())
        .unwrap_or_default()
}

/// Places that were skipped, with their cause.
fn skipped(log: &Log) -> Vec<(u64, u64, &str)> {
    let places = log.report.skipped.iter();
    places
        .map(|s| (s.offset, s.bytes, s.cause.as_str()))
        .collect()
}

#[test]
fn rows_have_the_scale_of_their_letters_and_their_time() {
    let log = read(&attitude().att(1_500_000, -1234).att(2_000_000, 1));
    assert_eq!(values(&log, "ATT", "Roll"), [-12.34, 0.01]);
    assert_eq!(times(&log, "ATT"), [1.5, 2.0]);
    assert_eq!(times(&log, "FMT"), [1.5]);
    assert!(log.report.is_clean() && log.report.remarks.is_empty());
    assert_eq!(log.report.messages, 3);
}

#[test]
fn a_log_is_recognised_by_what_stands_in_it() {
    let found = |bytes: &[u8]| recognise(bytes).map(|info| info.format);
    assert_eq!(found(&attitude().0), Some(LogFormat::Dataflash));
    assert_eq!(
        found(&Bytes::default().raw(b"noise").raw(&attitude().0).0),
        Some(LogFormat::Dataflash)
    );
    assert_eq!(
        found(b"\nArduPlane V2.74b\nFMT, 1, 13, ATT, Qc, TimeUS,Roll\n"),
        Some(LogFormat::DataflashText)
    );
    assert_eq!(
        found(b"FMT,1,13,ATT,Qc,TimeUS,Roll"),
        Some(LogFormat::DataflashText)
    );
    assert_eq!(found(b"Dear pilot,\nFMT, they say, is a message.\n"), None);
    assert_eq!(
        found(&Bytes::default().raw(&[0xa3, 0x95, 0x80]).raw(&[7; 90]).0),
        None
    );
    assert_eq!(found(b""), None);
}

#[test]
fn noise_between_messages_is_left_out_and_told() {
    let noise = [0, 0xa3, 0x95, 0x01, 9, 9, 0xa3];
    let start = attitude().att(1, 1);
    let place = start.0.len() as u64;
    let log = read(&start.raw(&noise).att(2, 2).att(3, 3));
    assert_eq!(values(&log, "ATT", "Roll"), [0.01, 0.02, 0.03]);
    assert_eq!(skipped(&log), [(place, 7, "no message begins here")]);
}

#[test]
fn a_message_cut_short_by_another_one_is_left_out() {
    let start = attitude().att(1, 1);
    let place = start.0.len() as u64;
    let cut = start.raw(&[0xa3, 0x95, 1, 7, 7, 7]).att(2, 2).att(3, 3);
    let log = read(&cut);
    assert_eq!(values(&log, "ATT", "Roll"), [0.01, 0.02, 0.03]);
    assert_eq!(
        skipped(&log),
        [(place, 6, "a message that another one interrupts")]
    );
}

#[test]
fn a_damaged_length_of_an_announcement_is_that_of_its_fields() {
    for length in [9, 12, 14, 45, 141] {
        let announced = Bytes::default().announce(1, length, "ATT", "Qc", "TimeUS,Roll");
        let log = read(
            &announced
                .att(1_000_000, 100)
                .att(2_000_000, -250)
                .att(3_000_000, 5),
        );
        assert_eq!(values(&log, "ATT", "Roll"), [1.0, -2.5, 0.05], "{length}");
        assert_eq!(times(&log, "ATT"), [1.0, 2.0, 3.0]);
        assert_eq!(log.report.skipped_bytes, 0);
    }
    // Bytes behind the last field are kept, where the next message begins behind them.
    let long = Bytes::default().announce(1, 15, "ATT", "Qc", "TimeUS,Roll");
    let row = |log: Bytes, roll: i16| {
        log.message(1, &[&7_u64.to_le_bytes(), &roll.to_le_bytes(), &[1, 2]])
    };
    assert_eq!(
        values(&read(&row(row(long, 100), 200)), "ATT", "Roll"),
        [1.0, 2.0]
    );
}

#[test]
fn a_file_may_end_within_a_message() {
    let start = attitude().att(1, 1);
    let place = start.0.len() as u64;
    for kept in 1..13_usize {
        let whole = start.clone().att(2, 2).0;
        let log = read(&Bytes(whole[..place as usize + kept].to_vec()));
        assert_eq!(values(&log, "ATT", "Roll"), [0.01]);
        assert_eq!(
            skipped(&log),
            [(place, kept as u64, "the file ends within a message")]
        );
    }
}

#[test]
fn messages_that_were_never_announced_are_one_place() {
    let start = attitude().att(1, 1);
    let place = start.0.len() as u64;
    let log = read(&start.message(9, &[&[1, 2, 3, 4]]).att(2, 2));
    assert_eq!(values(&log, "ATT", "Roll"), [0.01, 0.02]);
    assert_eq!(
        skipped(&log),
        [(place, 7, "a kind of message that was not announced")]
    );
}

/// A log of `TST` with a time, an instance, an angle in hundredths and a length in whatever `MULT` says.
fn labelled() -> Bytes {
    let text = |text: &str, size| {
        let mut bytes = text.as_bytes().to_vec();
        bytes.resize(size, 0);
        bytes
    };
    let unit = |id: u8, label: &str| [vec![0; 8], vec![id], text(label, 64)].concat();
    let mult = |id: u8, factor: f64| [vec![0; 8], vec![id], factor.to_le_bytes().to_vec()].concat();
    let labels = [&[0; 8][..], &[1], &text("s#dm", 16), &text("F-BC", 16)].concat();
    Bytes::default()
        .announce(1, 3 + 8 + 1 + 2 + 2, "TST", "QBch", "TimeUS,I,Angle,Length")
        .announce(2, 76, "UNIT", "QbZ", "TimeUS,Id,Label")
        .announce(3, 20, "MULT", "Qbd", "TimeUS,Id,Mult")
        .announce(4, 44, "FMTU", "QBNN", "TimeUS,FmtType,UnitIds,MultIds")
        .message(2, &[&unit(b's', "s")])
        .message(2, &[&unit(b'd', "deg")])
        .message(2, &[&unit(b'm', "m")])
        .message(2, &[&unit(b'#', "instance")])
        .message(3, &[&mult(b'F', 1e-6)])
        .message(3, &[&mult(b'-', 0.0)])
        .message(3, &[&mult(b'B', 0.01)])
        .message(3, &[&mult(b'C', 0.001)])
        .message(4, &[&labels])
}

fn tst(log: Bytes, time: u64, instance: u8, length: i16) -> Bytes {
    log.message(
        1,
        &[
            &time.to_le_bytes(),
            &[instance],
            &[100, 0],
            &length.to_le_bytes(),
        ],
    )
}

fn instance(name: &str, instance: u32) -> TopicName {
    TopicName {
        name: name.to_owned(),
        instance: Some(instance),
    }
}

#[test]
fn instances_are_topics_and_multipliers_make_plain_units() {
    let log = read(&tst(tst(tst(labelled(), 1, 0, 1500), 2, 3, 2500), 3, 0, -1));
    let first = log.topic(&instance("TST", 0)).unwrap();
    assert_eq!(first.values("Length"), Some(vec![1.5, -0.001]));
    assert_eq!(first.values("Angle"), Some(vec![1.0, 1.0]));
    let length = first.field("Length").unwrap();
    assert_eq!(
        (length.unit.as_str(), length.scale),
        ("m", ValueScale::Over(1000.0))
    );
    let time = first.field("TimeUS").unwrap();
    assert_eq!(
        (time.unit.as_str(), time.scale),
        ("s", ValueScale::Over(1e6))
    );
    let second = log.topic(&instance("TST", 3)).unwrap();
    assert_eq!((second.len(), second.times[0]), (1, 2e-6));
    assert!(log.topic(&TopicName::single("TST")).is_none());
}

#[test]
fn units_and_instances_may_be_told_after_the_rows() {
    let all = labelled().0;
    let announcements = 4 * 89;
    let early = Bytes(all[..announcements].to_vec());
    let early = tst(tst(tst(early, 1, 2, 1500), 2, 5, 1), 3, 2, 7);
    let log = read(&early.raw(&all[announcements..]));
    let names: Vec<String> = log.topics.iter().map(|t| t.name.to_string()).collect();
    assert_eq!(names, ["FMT", "TST[2]", "TST[5]", "UNIT", "MULT", "FMTU"]);
    let topic = log.topic(&instance("TST", 2)).unwrap();
    assert_eq!(topic.values("Length"), Some(vec![1.5, 0.007]));
    assert_eq!(topic.times, [1e-6, 3e-6]);
    assert_eq!(topic.field("Length").map(|f| f.unit.as_str()), Some("m"));
}

#[test]
fn receivers_are_told_apart_without_units() {
    let text = "FMT, 130, 19, GPS, QBBL, TimeUS,I,Status,Lat\nFMT, 131, 12, PIDR, Qf, TimeUS,I\n";
    let rows = "GPS, 1000, 0, 3, 47.5\nGPS, 1100, 1, 3, -33.5\nPIDR, 1000, 0.5\nPIDR, 1100, 1.5\nGPS, 2000, 0, 3, 47.6\n";
    let log = read_text(&format!("{text}{rows}"));
    let topics = log.topics.iter().filter(|topic| topic.name.name != "FMT");
    let names: Vec<_> = topics.map(|topic| topic.name.clone()).collect();
    let right = [
        instance("GPS", 0),
        instance("GPS", 1),
        TopicName::single("PIDR"),
    ];
    assert_eq!(names, right);
    assert_eq!(log.topic(&instance("GPS", 0)).unwrap().len(), 2);
}

#[test]
fn instances_may_be_words() {
    let start = labelled();
    let labels = [
        &[0; 8][..],
        &[5],
        b"s#m\0\0\0\0\0\0\0\0\0\0\0\0\0",
        &[0; 16],
    ]
    .concat();
    let nvf = |log: Bytes, name: &[u8; 4], value: f32| {
        log.message(5, &[&1_u64.to_le_bytes(), name, &value.to_le_bytes()])
    };
    let log = start
        .announce(5, 19, "NVF", "Qnf", "TimeUS,Name,Value")
        .message(4, &[&labels]);
    let log = read(&nvf(nvf(log, b"rpm\0", 2.0), b"load", 3.0));
    let topic = |name: &str| {
        log.topic(&TopicName::single(name))
            .and_then(|t| t.values("Value"))
    };
    assert_eq!(topic("NVF[rpm]"), Some(vec![2.0]));
    assert_eq!(topic("NVF[load]"), Some(vec![3.0]));
}

#[test]
fn another_layout_under_the_same_name_is_another_topic() {
    let log = attitude()
        .att(1, 100)
        .announce(1, 15, "ATT", "Qcc", "TimeUS,Roll,Pitch");
    let log = log.message(1, &[&2_u64.to_le_bytes(), &[200, 0], &[44, 1]]);
    let log = read(
        &log.announce(7, 13, "ATT", "Qc", "TimeUS,Roll")
            .message(7, &[&[0; 10]]),
    );
    assert_eq!(values(&log, "ATT", "Roll"), [1.0, 0.0]);
    assert_eq!(values(&log, "ATT~2", "Pitch"), [3.0]);
    assert!(
        log.report
            .remarks
            .iter()
            .any(|r| r.contains("ATT~2: its fields change"))
    );
}

#[test]
fn arrays_are_fields_with_numbers_and_pieces_of_files_are_bytes() {
    let numbers: Vec<u8> = (0..32_i16).flat_map(|i| (i * 1000).to_le_bytes()).collect();
    let log = Bytes::default()
        .announce(1, 67, "ISBD", "a", "x")
        .announce(2, 83, "FILE", "NZ", "FileName,Data")
        .message(1, &[&numbers])
        .message(2, &[b"a.lua\0\0\0\0\0\0\0\0\0\0\0", &[0xff; 64]]);
    let log = read(&log);
    assert_eq!(values(&log, "ISBD", "x[31]"), [31_000.0]);
    assert_eq!(log.first("ISBD").map(|t| t.fields.len()), Some(32));
    let data = log.first("FILE").and_then(|t| t.field("Data"));
    assert_eq!(data.map(|f| f.kind), Some(FieldKind::Bytes(64)));
}

#[test]
fn fields_behind_an_unknown_letter_stay_bytes() {
    let log = Bytes::default()
        .announce(1, 8, "NEW", "B?H", "a,b,c")
        .message(1, &[&[1, 2, 3, 4, 5]]);
    let log = read(&log);
    let topic = log.first("NEW").unwrap();
    let fields: Vec<_> = topic
        .fields
        .iter()
        .map(|f| (f.name.as_str(), f.kind))
        .collect();
    assert_eq!(
        fields,
        [("a", FieldKind::U8), ("rest", FieldKind::Bytes(4))]
    );
    assert_eq!(topic.rows.get(0), Some(&[1, 2, 3, 4, 5][..]));
    assert!(log.report.remarks[0].contains("letter ?"));
}

#[test]
fn times_that_go_back_or_stand_still_stay_and_are_told() {
    let log = read(
        &attitude()
            .att(3_000_000, 0)
            .att(3_000_000, 0)
            .att(1_000_000, 0),
    );
    assert_eq!(times(&log, "ATT"), [3.0, 3.0, 1.0]);
    assert_eq!(
        log.report.remarks,
        [
            "ATT: times go back once, from 3 s to 1 s",
            "1 row has the time of the row before it: ATT 1"
        ]
    );
}

#[test]
fn satellites_tell_the_date() {
    let gps = |log: Bytes, time: u64, status: u8, milliseconds: u32, week: u16| {
        let [milliseconds, week] = [&milliseconds.to_le_bytes()[..], &week.to_le_bytes()];
        log.message(1, &[&time.to_le_bytes(), &[status], milliseconds, week])
    };
    let start = Bytes::default().announce(1, 18, "GPS", "QBIH", "TimeUS,Status,GMS,GWk");
    let log = gps(start, 1_000_000, 1, 0, 0);
    assert_eq!(read(&log).utc_at_zero, None);
    let log = gps(log, 2_000_000, 1, 999, 1);
    let log = gps(log, 3_000_000, 3, 7_000, 2139);
    let log = gps(log, 9_000_000, 4, 7_000, 2139);
    assert_eq!(read(&log).utc_at_zero, Some(1_609_631_982.0 + 7.0 - 3.0));
}

#[test]
fn receivers_of_2013_have_the_time_since_the_start_in_a_field_of_their_own() {
    let log = read_text(
        "FMT, 1, 50, GPS, BIHI, Status,TimeMS,Week,T\n\
         FMT, 2, 50, ATT, Ic, TimeMS,Roll\n\
         FMT, 3, 50, ACC1, If, TimeMS,AccX\n\
         ATT, 13178, 1.50\n\
         GPS, 3, 511214500, 1768, 13341\n\
         ACC1, 4, 9.5\n",
    );
    assert_eq!(times(&log, "ATT"), [13.178]);
    assert_eq!(times(&log, "GPS"), [13.341]);
    assert_eq!(times(&log, "ACC1"), [13.341]);
    let start = 315_964_800.0 + 1768.0 * 604_800.0 + 511_214.5 - 16.0 - 13.341;
    assert!((log.utc_at_zero.unwrap() - start).abs() < 1e-6);
}

#[test]
fn without_a_clock_rows_are_spread_between_the_fixes() {
    let log = read_text(
        "FMT, 1, 50, GPS, BIH, Status,TimeMS,Week\n\
         FMT, 2, 50, ATT, c, Roll\n\
         ATT, 1\n\
         GPS, 3, 1000, 1700\n\
         ATT, 2\n\
         ATT, 3\n\
         ATT, 4\n\
         GPS, 3, 3000, 1700\n\
         ATT, 5\n",
    );
    assert_eq!(times(&log, "ATT"), [0.0, 0.5, 1.0, 1.5, 2.0]);
    assert_eq!(times(&log, "GPS"), [0.0, 2.0]);
    assert_eq!(
        log.utc_at_zero,
        Some(315_964_800.0 + 1700.0 * 604_800.0 + 1.0 - 16.0)
    );
}

/// A log of a receiver that tells the time in those milliseconds five times a second, with two angles between.
fn by_fixes(names: &str, milliseconds: impl Fn(u32) -> String) -> Log {
    let mut text = format!("FMT, 1, 50, GPS, {names}\nFMT, 2, 50, ATT, c, Roll\n");
    for i in 0..100 {
        text += "ATT, 1\nATT, 2\nGPS, 3, ";
        text += &milliseconds(i);
        text += "\n";
    }
    read_text(&text)
}

#[test]
fn a_wrong_time_of_a_receiver_is_not_the_clock_and_a_week_may_end() {
    let regular = |log: &Log, gone: usize| {
        let (fixes, angles) = (times(log, "GPS"), times(log, "ATT"));
        assert_eq!(
            (fixes.len(), angles.len()),
            (100, 200),
            "{:?}",
            log.report.remarks
        );
        for (i, time) in fixes.iter().enumerate() {
            let right = 0.2 * i as f64;
            assert!(
                (time - right).abs() < if i == gone { 0.2 } else { 1e-6 },
                "{i}: {time}"
            );
        }
        let steps: Vec<f64> = angles[4..].windows(2).map(|w| w[1] - w[0]).collect();
        assert!(steps.iter().all(|step| *step > 0.05 && *step < 0.15));
    };
    let week = "BIH, Status,TimeMS,Week";
    for wrong in [1_u32 << 24, 1 << 29, 0x4000_0000] {
        let log = by_fixes(week, |i| {
            format!(
                "{}, 1790",
                (295_200_000 + 200 * i) ^ if i == 50 { wrong } else { 0 }
            )
        });
        regular(&log, 50);
        let told = |word: &str| {
            log.report
                .remarks
                .iter()
                .any(|remark| remark.contains(word))
        };
        assert!(
            told("1 fix has a time far from"),
            "{:?}",
            log.report.remarks
        );
        let start = 315_964_800.0 + 1790.0 * 604_800.0 + 295_200.0 - 16.0;
        assert!((log.utc_at_zero.unwrap() - start).abs() < 1e-6);
    }
    let turning = |i: u32| (604_790_000 + 200 * i) % 604_800_000;
    regular(
        &by_fixes("BI, Status,Time", |i| turning(i).to_string()),
        1000,
    );
    regular(
        &by_fixes(week, |i| {
            format!("{}, {}", turning(i), 1790 + u32::from(i >= 50))
        }),
        1000,
    );
}

#[test]
fn a_receiver_that_pauses_or_is_set_back_goes_on() {
    let set = |by: i64| {
        let told = move |i: u32| 295_200_000 + 200 * i64::from(i) + if i < 50 { 0 } else { by };
        by_fixes("BIH, Status,TimeMS,Week", move |i| {
            format!("{}, 1790", told(i))
        })
    };
    let later = times(&set(3_600_000), "GPS");
    assert!((later[99] - 3619.8).abs() < 1e-6 && (later[49] - 9.8).abs() < 1e-6);
    assert!((later[50] - 3610.0).abs() < 1e-6);
    let log = set(-3_600_000);
    let back = times(&log, "GPS");
    assert!(
        back.windows(2).all(|w| (w[1] - w[0] - 0.2).abs() < 1e-6),
        "{back:?}"
    );
    assert!(
        log.report
            .remarks
            .iter()
            .any(|it| it.contains("set back by 3600 s"))
    );
    // Without a fix it counts from when it was switched on.
    let log = by_fixes("BIH, Status,TimeMS,Week", |i| match i {
        0..50 => format!("{}, 0", 5000 + 200 * i),
        _ => format!("{}, 1790", 295_200_000 + 200 * i),
    });
    let fixes = times(&log, "GPS");
    assert!(
        fixes.windows(2).all(|w| (w[1] - w[0] - 0.2).abs() < 1e-6),
        "{fixes:?}"
    );
    let start = 315_964_800.0 + 1790.0 * 604_800.0 + 295_200.0 - 16.0;
    assert!(
        (log.utc_at_zero.unwrap() - start).abs() < 0.3,
        "{:?}",
        log.utc_at_zero
    );
}

#[test]
fn parameters_messages_and_modes_are_told_by_themselves() {
    let log = read_text(
        "FMT,1,50,PARM,QNf,TimeUS,Name,Value\n\
         FMT,2,50,MSG,QZ,TimeUS,Message\n\
         FMT,3,50,MODE,QMB,TimeUS,Mode,ModeNum\n\
         MODE,1000000,5,5\n\
         PARM,2000000,ARSPD_RATIO,1.75\n\
         MSG,3000000,ArduPlane V3.8.2, with a comma\n\
         MODE,4000000,Auto,10\n\
         MSG,5000000,\n",
    );
    assert_eq!(log.parameter("ARSPD_RATIO"), Some(1.75));
    assert_eq!(log.vehicle, "ArduPlane V3.8.2, with a comma");
    let texts: Vec<_> = log
        .messages
        .iter()
        .map(|m| (m.time, m.text.as_str()))
        .collect();
    assert_eq!(texts, [(3.0, "ArduPlane V3.8.2, with a comma"), (5.0, "")]);
    let modes: Vec<_> = log
        .modes
        .iter()
        .map(|m| (m.time, m.mode.as_str()))
        .collect();
    assert_eq!(modes, [(1.0, "FBWA"), (4.0, "AUTO")]);
    assert!(log.report.is_clean());
}

#[test]
fn lines_that_are_no_messages_are_left_out_and_told() {
    let log = read_text(
        "ArduCopter V3.1 (abc)\r\n\
         \r\n\
         FMT, 1, 13, ATT, Qc, TimeUS,Roll\r\n\
         ATT, 1000000\r\n\
         ATT, 2000000, flat\r\n\
         ATT, 3000000, 4.00\r\n\
         ATT, 4000000, 5.0",
    );
    assert_eq!(values(&log, "ATT", "Roll"), [4.0, 5.0]);
    assert_eq!(log.vehicle, "ArduCopter V3.1 (abc)");
    let causes: Vec<_> = skipped(&log).iter().map(|(_, _, cause)| *cause).collect();
    let expected = [
        "no kind of message has this name",
        "a line has too few values",
        "a value is no number",
    ];
    assert_eq!(causes, expected);
    assert_eq!(
        log.report.remarks,
        ["the last line has no end and may be cut off"]
    );
}

#[test]
fn a_line_without_end_takes_no_memory() {
    let mut text = b"FMT, 1, 13, ATT, Qc, TimeUS,Roll\n".to_vec();
    let place = text.len() as u64;
    text.extend(vec![b'x'; 200_000]);
    text.extend(b"\nATT, 1, 2.00\n");
    let mut reader = DataflashTextReader::new();
    let mut log = Log::new("log", LogFormat::DataflashText);
    for piece in text.chunks(7) {
        reader.feed(piece, &mut log);
    }
    reader.finish(&mut log);
    assert_eq!(values(&log, "ATT", "Roll"), [2.0]);
    assert_eq!(skipped(&log), [(place, 200_001, "a line is too long")]);
}

#[test]
fn any_pieces_make_the_same_log() {
    let mut bytes = tst(tst(labelled(), 1, 0, 1500), 2, 3, 2500).raw(&[0; 40]);
    bytes = tst(bytes.message(9, &[&[0; 30]]), 5, 0, 7).raw(&[0xa3, 0x95]);
    let whole = read(&bytes);
    for size in [1, 2, 3, 17, 88, 511, 512, 513] {
        let mut reader = DataflashReader::new();
        let mut log = Log::new("log", LogFormat::Dataflash);
        for piece in bytes.0.chunks(size) {
            reader.feed(piece, &mut log);
        }
        reader.finish(&mut log);
        assert_eq!(log.report, whole.report, "pieces of {size}");
        assert_eq!(log.topics, whole.topics, "pieces of {size}");
    }
}
