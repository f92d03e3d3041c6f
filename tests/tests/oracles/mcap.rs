//! MCAP files of the format's own libraries: what is read of them beside what those read, bit by bit.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use pilotage_core::flight::log::{FieldLayout, Log, Topic, recognise};
use pilotage_tests::oracle::ask;
use serde::{Deserialize, Serialize};

#[derive(Serialize)]
struct File<'a> {
    path: PathBuf,
    packing: &'a str,
    chunks: bool,
    seed: u64,
}

#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum Value {
    Double { double: String },
    Natural(u64),
    Whole(i64),
    Text(String),
}

/// Topic, schema, times of logging and publishing in nanoseconds, values.
type Message = (String, String, u64, u64, BTreeMap<String, Value>);

#[derive(Deserialize)]
struct Read {
    messages: Vec<Message>,
    metadata: Vec<(String, String)>,
    attachments: Vec<String>,
}

fn read(path: &Path) -> Log {
    let bytes = std::fs::read(path).expect("the file can be read");
    let info = recognise(&bytes[..64]).expect("the file is known by its first bytes");
    let mut log = Log::new("flight.mcap", info.format);
    let mut reader = (info.reader)();
    for piece in bytes.chunks(4099) {
        reader.feed(piece, &mut log);
    }
    reader.finish(&mut log);
    log
}

fn is_whole(field: &FieldLayout, bytes: &[u8], expected: i128) -> bool {
    match field.kind.integer(bytes) {
        Some(found) => found == expected,
        None => field.kind.number(bytes) == Some(expected as f64),
    }
}

fn is_same(field: &FieldLayout, row: &[u8], expected: &Value) -> bool {
    let bytes = field.bytes(row).expect("a row has all its fields");
    match expected {
        Value::Text(text) => field.text(row).as_ref() == Some(text),
        Value::Natural(number) => is_whole(field, bytes, i128::from(*number)),
        Value::Whole(number) => is_whole(field, bytes, i128::from(*number)),
        Value::Double { double } => {
            let bits = u64::from_str_radix(double, 16).expect("bits are hexadecimal digits");
            field.kind.number(bytes).map(f64::to_bits) == Some(bits)
        }
    }
}

/// Whether nothing was said of a field.
fn is_blank(field: &FieldLayout, row: &[u8]) -> bool {
    let bytes = field.bytes(row).expect("a row has all its fields");
    bytes.iter().all(|b| *b == 0) || field.kind.number(bytes).is_some_and(f64::is_nan)
}

/// Compares one message with its row; returns the number of values.
fn compare(topic: &Topic, index: usize, fields: &BTreeMap<String, Value>) -> usize {
    let row = topic
        .rows
        .get(index)
        .expect("there are as many rows as messages");
    let place = |name: &str| format!("{} {index} {name}", topic.name);
    for (name, expected) in fields {
        match topic.field(name) {
            Some(field) => {
                assert!(
                    is_same(field, row, expected),
                    "{}: {expected:?}",
                    place(name)
                );
            }
            // Of lists that are always as long, nobody has to tell how long.
            None => assert!(
                ["three", "pair", "two"]
                    .iter()
                    .any(|l| format!("{l}.length") == *name),
                "{}",
                place(name)
            ),
        }
    }
    for field in topic
        .fields
        .iter()
        .filter(|field| !fields.contains_key(&field.name))
    {
        assert!(
            field.name == "publish_time" || is_blank(field, row),
            "{}",
            place(&field.name)
        );
    }
    fields.len()
}

fn every_value_is_that_of_the_oracle(packing: &str, chunks: bool, seed: u64) {
    let name = format!(
        "pilotage-{}-{packing}{chunks}{seed}.mcap",
        std::process::id()
    );
    let path = std::env::temp_dir().join(name);
    let file = File {
        path: path.clone(),
        packing,
        chunks,
        seed,
    };
    let answer: Option<Read> = ask("mcap_read.py", &file);
    let log = answer.is_some().then(|| read(&path));
    std::fs::remove_file(&path).ok();
    let (Some(answer), Some(log)) = (answer, log) else {
        return;
    };
    assert!(
        log.report.is_clean() && log.report.skipped_bytes == 0,
        "{:?}",
        log.report
    );
    assert_eq!(log.report.messages, answer.messages.len() as u64);
    let mut rows: BTreeMap<&str, usize> = BTreeMap::new();
    let zero = answer.messages[0].2;
    let mut values = 0;
    for (name, schema, logged, published, fields) in &answer.messages {
        let topic = log.first(name).unwrap_or_else(|| panic!("no {name}"));
        let index = rows.entry(name).or_default();
        let since = |time: u64| (i128::from(time) - i128::from(zero)) as f64 / 1e9;
        assert_eq!(
            (&topic.schema, topic.times[*index]),
            (schema, since(*logged))
        );
        let told = topic
            .values("publish_time")
            .expect("some are published before they are logged")[*index];
        assert!(told == since(*published) || told.is_nan() && logged == published);
        values += compare(topic, *index, fields);
        *index += 1;
    }
    assert!(
        log.topics
            .iter()
            .all(|topic| rows[topic.name.name.as_str()] == topic.len())
    );
    assert_eq!(log.utc_at_zero, Some(zero as f64 / 1e9));
    for (name, text) in &answer.metadata {
        assert!(
            log.facts.iter().any(|f| f.name == *name && f.text == *text),
            "{name}"
        );
    }
    for name in &answer.attachments {
        assert!(log.facts.iter().any(|f| f.name.ends_with(name)), "{name}");
    }
    // Of long lists of bytes only the length is kept, and that is told.
    assert!(
        log.report
            .remarks
            .iter()
            .all(|r| r.contains("left out: the bytes of")),
        "{:?}",
        log.report
    );
    println!(
        "{packing} {chunks}: {} messages, {values} values",
        answer.messages.len()
    );
}

#[test]
fn every_value_is_that_of_the_oracle_without_chunks() {
    every_value_is_that_of_the_oracle("", false, 1);
}

#[test]
fn every_value_is_that_of_the_oracle_in_chunks() {
    every_value_is_that_of_the_oracle("", true, 2);
}

#[test]
fn every_value_is_that_of_the_oracle_in_chunks_packed_with_lz4() {
    every_value_is_that_of_the_oracle("lz4", true, 3);
}

#[test]
fn every_value_is_that_of_the_oracle_in_chunks_packed_with_zstandard() {
    every_value_is_that_of_the_oracle("zstd", true, 4);
}
