//! Stamped `MAVLink`: what is read beside what pymavlink reads, bit by bit, for every kind of message.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use pilotage_core::flight::log::{FieldKind, Log, Topic, TopicName, recognise};
use pilotage_tests::{
    data::repository,
    oracle::{ask, bytes_of_hex},
};
use serde::{Deserialize, Serialize};
use serde_json::Value;

#[derive(Serialize)]
struct File {
    path: PathBuf,
    seed: u64,
    version: u8,
}

/// Microseconds, name, system, component, fields.
type Message = (u64, String, u32, u32, BTreeMap<String, Value>);

#[derive(Deserialize)]
struct Read {
    messages: Vec<Message>,
    parameters: BTreeMap<String, f64>,
    modes: Vec<(u64, String)>,
}

fn read(path: &Path) -> Log {
    let bytes = std::fs::read(path).expect("the file can be read");
    let info = recognise(&bytes[..4096]).expect("the file is known by its first bytes");
    let mut log = Log::new("flight.tlog", info.format);
    let mut reader = (info.reader)();
    for piece in bytes.chunks(777) {
        reader.feed(piece, &mut log);
    }
    reader.finish(&mut log);
    log
}

/// Whether the stored number of a field is the one that JSON has.
fn is_number(topic: &Topic, name: &str, row: &[u8], expected: &Value) -> bool {
    let Some(field) = topic.field(name) else {
        return false;
    };
    let bytes = field.bytes(row).expect("a row has all its fields");
    match field.kind.integer(bytes) {
        Some(number) => whole(expected) == Some(number),
        None => field.kind.number(bytes).map(f64::to_bits) == expected.as_f64().map(f64::to_bits),
    }
}

fn whole(number: &Value) -> Option<i128> {
    let signed = number.as_i64().map(i128::from);
    signed.or_else(|| number.as_u64().map(i128::from))
}

/// Compares the fields of one message; returns the number of values.
fn compare(topic: &Topic, index: usize, fields: &BTreeMap<String, Value>) -> usize {
    let row = topic
        .rows
        .get(index)
        .expect("there are as many rows as messages");
    let mut values = 0;
    for (name, expected) in fields {
        let place = || format!("{} {index} {name}: {expected}", topic.name);
        match expected {
            Value::String(hex) => {
                let field = topic.field(name).unwrap_or_else(|| panic!("{}", place()));
                assert!(matches!(field.kind, FieldKind::Text(_)), "{}", place());
                let mut letters = bytes_of_hex(hex);
                letters.resize(field.kind.size(), 0);
                assert_eq!(field.bytes(row), Some(&*letters), "{}", place());
                values += 1;
            }
            Value::Array(numbers) if topic.field(name).is_some() => {
                // Many bytes stay together.
                let bytes = topic.field(name).and_then(|field| field.bytes(row));
                let numbers = numbers.iter().map(|n| n.as_u64().expect("a byte") as u8);
                assert_eq!(bytes, Some(&*numbers.collect::<Vec<_>>()), "{}", place());
                values += 1;
            }
            Value::Array(numbers) => {
                for (i, number) in numbers.iter().enumerate() {
                    let name = format!("{name}[{i}]");
                    assert!(is_number(topic, &name, row, number), "{}", place());
                }
                values += numbers.len();
            }
            number => {
                assert!(is_number(topic, name, row, number), "{}", place());
                values += 1;
            }
        }
    }
    values
}

/// Compares all that was read of a written file; returns the number of kinds and of values.
fn compare_all(seed: u64, version: u8) -> Option<(usize, usize)> {
    let name = format!("pilotage-{}-{version}.tlog", std::process::id());
    let path = std::env::temp_dir().join(name);
    let question = File {
        path: path.clone(),
        seed,
        version,
    };
    let answer: Read = ask("pymavlink_tlog.py", &question)?;
    let log = read(&path);
    std::fs::remove_file(&path).ok();
    assert!(log.report.is_clean(), "{:?}", log.report);
    assert_eq!(log.report.messages, answer.messages.len() as u64);
    let first = answer.messages[0].0;
    let seconds = |time: u64| (time - first) as f64 / 1e6;
    // The first that is heard, but the autopilot (component 1) wherever it is heard.
    let mut components = BTreeMap::new();
    for (_, name, system, component, _) in &answer.messages {
        let own = components.entry((name, system)).or_insert(component);
        if *component == 1 {
            *own = component;
        }
    }
    let mut counts = BTreeMap::new();
    let mut values = 0;
    for (time, name, system, component, fields) in &answer.messages {
        let own = components.get(&(name, system)) == Some(&component);
        let instance = if own {
            *system
        } else {
            1000 * system + component
        };
        let topic = TopicName {
            name: name.clone(),
            instance: Some(instance),
        };
        let topic = log.topic(&topic).unwrap_or_else(|| panic!("no {topic}"));
        let index = counts.entry(&topic.name).or_insert(0);
        assert_eq!(topic.times[*index], seconds(*time));
        values += compare(topic, *index, fields);
        *index += 1;
    }
    let parameters = log.parameters.iter().map(|p| (p.name.clone(), p.value));
    assert_eq!(parameters.collect::<BTreeMap<_, _>>(), answer.parameters);
    let modes: Vec<_> = log.modes.iter().map(|m| (m.time, &m.mode)).collect();
    let expected = answer
        .modes
        .iter()
        .map(|(time, mode)| (seconds(*time), mode));
    assert_eq!(modes, expected.collect::<Vec<_>>());
    let mut kinds: Vec<_> = answer.messages.iter().map(|message| &message.1).collect();
    kinds.sort_unstable();
    kinds.dedup();
    Some((kinds.len(), values))
}

#[test]
fn every_kind_of_message_says_what_it_says_to_pymavlink() {
    for (seed, version, least) in [(1, 1, 190), (2, 2, 340)] {
        let Some((kinds, values)) = compare_all(seed, version) else {
            return;
        };
        println!("version {version}: {kinds} kinds of messages, {values} values");
        assert!(kinds >= least && values > 20 * kinds, "{kinds} {values}");
    }
}

#[test]
fn the_table_of_messages_is_what_pymavlink_has() {
    let Some(expected) = ask::<_, String>("mavlink_dialect.py", &()) else {
        return;
    };
    let path = repository().join("crates/core/readers/src/log/tlog/dialect.txt");
    let table = std::fs::read_to_string(path).expect("the table is part of the repository");
    assert!(
        table == expected,
        "write tlog/dialect.txt anew by tests/oracles/mavlink_dialect.py"
    );
}
