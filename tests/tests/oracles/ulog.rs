//! `ULog` files: what is read of them beside what pyulog reads, bit by bit.

use std::collections::BTreeMap;
use std::path::Path;

use pilotage_core::flight::log::{FieldKind, FieldLayout, Log, Topic, TopicName, recognise};
use pilotage_tests::{
    data::shared,
    oracle::{ask, bytes_of_hex},
};
use serde::{Deserialize, Serialize};
use serde_json::Value;

#[derive(Serialize)]
struct File<'a> {
    path: &'a Path,
    write: bool,
}

#[derive(Deserialize)]
struct Read {
    topics: Vec<ReadTopic>,
    initial: BTreeMap<String, f64>,
    changed: Vec<(u64, String, f64)>,
    defaults: [BTreeMap<String, f64>; 2],
    words: Vec<(u8, Option<u32>, u64, String)>,
    dropouts: Vec<(u64, u16)>,
    facts: Vec<(String, Value)>,
}

#[derive(Deserialize)]
struct ReadTopic {
    name: String,
    instance: u32,
    /// Name, type, column as hexadecimal digits.
    fields: Vec<(String, String, String)>,
}

fn read(path: &Path) -> Log {
    let bytes = std::fs::read(path).expect("the file can be read");
    let info = recognise(&bytes[..64]).expect("the file is known by its first bytes");
    let mut log = Log::new("flight.ulg", info.format);
    let mut reader = (info.reader)();
    for piece in bytes.chunks(4099) {
        reader.feed(piece, &mut log);
    }
    reader.finish(&mut log);
    log
}

fn seconds(microseconds: u64) -> f64 {
    microseconds as f64 / 1e6
}

/// The column of a field as pyulog has it: letters stand there one by one.
fn column(topic: &Topic, name: &str) -> Option<(FieldKind, Vec<u8>)> {
    let of = |field: &FieldLayout, kind: FieldKind, index: usize| {
        let start = field.offset + index;
        let bytes = |row: &[u8]| row[start..start + kind.size()].to_vec();
        (kind, topic.rows.iter().flat_map(bytes).collect())
    };
    if let Some(field) = topic.field(name) {
        return Some(of(field, field.kind, 0));
    }
    let (text, index) = name.strip_suffix(']')?.rsplit_once('[')?;
    let field = topic.field(text)?;
    let is_text = matches!(field.kind, FieldKind::Text(_));
    is_text.then(|| {
        of(
            field,
            FieldKind::Text(1),
            index.parse().expect("an index is a number"),
        )
    })
}

fn kind_of(name: &str) -> FieldKind {
    match name {
        "int8_t" => FieldKind::I8,
        "uint8_t" => FieldKind::U8,
        "int16_t" => FieldKind::I16,
        "uint16_t" => FieldKind::U16,
        "int32_t" => FieldKind::I32,
        "uint32_t" => FieldKind::U32,
        "int64_t" => FieldKind::I64,
        "uint64_t" => FieldKind::U64,
        "float" => FieldKind::F32,
        "double" => FieldKind::F64,
        "bool" => FieldKind::Bool,
        "char" => FieldKind::Text(1),
        _ => panic!("{name} is no type"),
    }
}

/// Rows of one topic that may be left out at most.
const FEW: usize = 3;

/// Marks the rows of a topic that we keep. Those left out are few, far from the log in time, and told with the
/// topic's name.
fn kept(log: &Log, topic: &Topic, expected: &ReadTopic) -> Vec<bool> {
    let (_, _, hex) = expected
        .fields
        .iter()
        .find(|(field, ..)| field == "timestamp")
        .expect("every topic has times");
    let bytes = bytes_of_hex(hex);
    let times = bytes.chunks(8).map(|eight| {
        let microseconds = u64::from_le_bytes(eight.try_into().expect("eight bytes"));
        seconds(microseconds)
    });
    let begins = log.begins.expect("the header says when it began");
    let mut ours = topic.times.iter().peekable();
    let mut left_out = 0;
    let mut is_kept = Vec::new();
    for time in times {
        let is_ours = ours.next_if_eq(&&time).is_some();
        is_kept.push(is_ours);
        if !is_ours {
            let name = &topic.name;
            assert!((time - begins).abs() > 10.0, "{name} at {time}");
            let is_named = |remark: &String| remark.contains(&name.to_string());
            assert!(log.report.remarks.iter().any(is_named), "{name} at {time}");
            left_out += 1;
        }
    }
    assert!(left_out <= FEW, "{}: {left_out}", topic.name);
    is_kept
}

/// Compares every row; returns the number of values.
fn compare_rows(log: &Log, answer: &Read) -> usize {
    let mut values = 0;
    assert_eq!(log.topics.len(), answer.topics.len());
    for expected in &answer.topics {
        let name = TopicName {
            name: expected.name.clone(),
            instance: Some(expected.instance),
        };
        let topic = log.topic(&name).unwrap_or_else(|| panic!("no {name}"));
        let is_kept = kept(log, topic, expected);
        for (field, kind, hex) in &expected.fields {
            if field.contains("_padding") {
                continue;
            }
            let (found_kind, found) =
                column(topic, field).unwrap_or_else(|| panic!("no {name} {field}"));
            assert_eq!(found_kind, kind_of(kind), "{name} {field}");
            let wide = kind_of(kind).size();
            let expected = bytes_of_hex(hex);
            let rows = expected.chunks(wide).zip(&is_kept);
            let kept: Vec<u8> = rows
                .filter(|(_, is_kept)| **is_kept)
                .flat_map(|(value, _)| value.iter().copied())
                .collect();
            assert!(found == kept, "{name} {field}");
            values += topic.len();
        }
        let times = topic.values("timestamp").expect("every topic has times");
        let times: Vec<_> = times
            .iter()
            .map(|microseconds| microseconds / 1e6)
            .collect();
        assert_eq!(topic.times, times, "{name}");
    }
    values
}

fn compare_parameters(log: &Log, answer: &Read) {
    let (initial, changed) = log.parameters.split_at(answer.initial.len());
    let initial: BTreeMap<_, _> = initial.iter().map(|p| (p.name.clone(), p.value)).collect();
    assert_eq!(initial, answer.initial);
    let changed: Vec<_> = changed.iter().map(|p| (p.time, &p.name, p.value)).collect();
    let expected = answer.changed.iter().map(|(t, n, v)| (seconds(*t), n, *v));
    assert_eq!(changed, expected.collect::<Vec<_>>());
    for (defaults, of_airframe) in answer.defaults.iter().zip([false, true]) {
        let found = log.defaults.iter().filter(|d| d.of_airframe == of_airframe);
        let found: BTreeMap<_, _> = found.map(|d| (d.name.clone(), d.value)).collect();
        assert_eq!(found, *defaults);
    }
}

fn compare_words(log: &Log, answer: &Read) {
    let order = |tagged: bool| {
        log.messages
            .iter()
            .filter(move |m| m.source.is_some() == tagged)
    };
    let found: Vec<_> = order(false).chain(order(true)).collect();
    assert_eq!(found.len(), answer.words.len());
    for (found, (level, tag, time, text)) in found.into_iter().zip(&answer.words) {
        let severity = level - b'0';
        assert_eq!((found.time, found.source), (seconds(*time), *tag));
        assert_eq!((found.severity, &found.text), (Some(severity), text));
    }
    let gaps: Vec<_> = log
        .report
        .gaps
        .iter()
        .map(|g| (g.time, g.duration))
        .collect();
    let expected = answer.dropouts.iter();
    let expected: Vec<_> = expected
        .map(|(t, ms)| (seconds(*t), f64::from(*ms) / 1e3))
        .collect();
    assert_eq!(gaps, expected);
}

fn compare_facts(log: &Log, answer: &Read) {
    let mut found: Vec<_> = log.facts.iter().map(|f| (&f.name, &f.text)).collect();
    assert_eq!(found.len(), answer.facts.len());
    for (name, value) in &answer.facts {
        let fits = |(n, text): &(&String, &String)| {
            *n == name
                && match value {
                    Value::String(words) => words.trim_end_matches('\0') == *text,
                    Value::Null => true,
                    number => serde_json::from_str(text).is_ok_and(|text: Value| text == *number),
                }
        };
        let place = found.iter().position(fits);
        found.swap_remove(place.unwrap_or_else(|| panic!("no fact {name}: {value}")));
    }
}

fn compare(path: &Path, write: bool) -> Option<(Log, usize)> {
    let answer: Read = ask("pyulog_read.py", &File { path, write })?;
    let log = read(path);
    let values = compare_rows(&log, &answer);
    compare_parameters(&log, &answer);
    compare_words(&log, &answer);
    compare_facts(&log, &answer);
    Some((log, values))
}

#[test]
fn every_value_of_recorded_flights_is_the_one_that_pyulog_reads() {
    for name in ["sample.ulg", "sample-small.ulg", "sample_log_small.ulg"] {
        let Some(path) = shared(&format!("px4_ulog/{name}")) else {
            continue;
        };
        let Some((log, values)) = compare(&path, false) else {
            return;
        };
        assert!(log.report.is_clean(), "{name}: {:?}", log.report);
        assert!(values > 100_000, "{name}: {values}");
        println!(
            "{name}: {values} values, {}, {:?} {:?}",
            log.vehicle, log.utc_at_zero, log.modes
        );
    }
}

#[test]
fn every_kind_of_message_says_what_it_says_to_pyulog() {
    let path = std::env::temp_dir().join(format!("pilotage-{}.ulg", std::process::id()));
    let compared = compare(&path, true);
    std::fs::remove_file(&path).ok();
    let Some((log, values)) = compared else {
        return;
    };
    assert_eq!(values, 3 * (13 + 2 * (3 * 4 + 1 + 10)));
    // The message cut off before the appended data, and the one of a later version.
    assert_eq!(log.report.skipped_places, 2, "{:?}", log.report);
    assert_eq!(log.facts.last().map(|f| f.text.as_str()), Some("at 17"));
    assert_eq!(log.vehicle, "PX4 v1.15.0");
}
