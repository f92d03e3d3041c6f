//! Dataflash logs message by message and field by field beside pymavlink.

use std::collections::BTreeMap;

use pilotage_core::flight::log::{
    FieldKind, FieldLayout, Log, LogFormat, Topic, TopicName, ValueScale, recognise,
};
use pilotage_tests::data::shared;
use pilotage_tests::logs::check::checked;
use pilotage_tests::logs::dataflash::Form;
use pilotage_tests::logs::made;
use pilotage_tests::oracle::{ask, bytes_of_hex, hex_of_bytes};
use serde::{Deserialize, Serialize};

#[derive(Serialize)]
struct Question {
    logs: Vec<Asked>,
}

#[derive(Serialize)]
struct Asked {
    name: String,
    hex: String,
    is_text: bool,
}

#[derive(Deserialize)]
struct Answer {
    formats: BTreeMap<String, Format>,
    messages: Vec<(String, Option<String>, String, Vec<String>)>,
    modes: Vec<String>,
    parameters: BTreeMap<String, String>,
    start: Option<f64>,
}

#[derive(Deserialize)]
struct Format {
    letters: String,
    columns: Vec<String>,
    units: Vec<String>,
}

fn theirs(name: &str, bytes: &[u8]) -> Option<Answer> {
    let is_text = recognise(bytes).map(|info| info.format) == Some(LogFormat::DataflashText);
    let asked = Asked {
        name: name.to_owned(),
        hex: hex_of_bytes(bytes),
        is_text,
    };
    let question = Question { logs: vec![asked] };
    let answers = ask::<_, Vec<Answer>>("pymavlink_dataflash.py", &question)?;
    Some(answers.into_iter().next().expect("one log, one answer"))
}

fn ours(bytes: &[u8]) -> Log {
    let info = recognise(bytes).expect("a log is recognised");
    checked(info, bytes, &[]).expect("a log is read")
}

fn double(hex: &str) -> f64 {
    let bytes = bytes_of_hex(hex);
    f64::from_be_bytes(bytes.try_into().expect("a double has eight bytes"))
}

/// Whether two numbers have the same bits, or are both none.
fn is_equal(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

/// The scale that a letter implies: the only one that pymavlink applies to values.
fn scale_of_letter(letter: char) -> Option<ValueScale> {
    match letter {
        'c' | 'C' | 'e' | 'E' => Some(ValueScale::Over(100.0)),
        'L' => Some(ValueScale::Over(1e7)),
        _ => None,
    }
}

/// Whether a value is what pymavlink says, to the bit. Text has fewer digits than a number of single
/// precision, and pymavlink reads it with double precision.
fn is_theirs(
    theirs: &str,
    field: &FieldLayout,
    letter: char,
    topic: &Topic,
    row: usize,
    is_text: bool,
) -> bool {
    let bytes = topic.rows.get(row).expect("there are as many rows");
    let (kind, said) = theirs.split_at(1);
    let stored = &bytes[field.offset..];
    match kind {
        "i" => field.kind.integer(stored).map(|n| n.to_string()).as_deref() == Some(said),
        "f" if is_text && field.kind == FieldKind::F32 => {
            let number = field.kind.number(stored).expect("it is a number");
            is_equal(f64::from(double(said) as f32), number)
        }
        "f" => {
            let number = field.kind.number(stored).expect("it is a number");
            let scale = scale_of_letter(letter).unwrap_or_default();
            is_equal(double(said), scale.apply(number))
        }
        "s" if letter == 'M' => {
            field.kind.integer(stored).map(|n| n.to_string()).as_deref() == Some(said)
        }
        "s" => match field.text(bytes) {
            // Of lines of text pymavlink leaves out what follows a comma.
            Some(text) => text
                .strip_prefix(said)
                .is_some_and(|rest| rest.is_empty() || (is_text && rest.starts_with(", "))),
            None => field
                .bytes(bytes)
                .is_some_and(|b| String::from_utf8_lossy(b).trim_end_matches('\0') == said),
        },
        "b" => field.bytes(bytes) == Some(&bytes_of_hex(said)),
        "a" => {
            let numbers = said.split(' ').map(|n| n.parse::<i16>().expect("numbers"));
            let numbers: Vec<u8> = numbers.flat_map(i16::to_le_bytes).collect();
            bytes[field.offset..].starts_with(&numbers)
        }
        _ => panic!("{theirs} is no value"),
    }
}

/// The unit as pymavlink writes it: it leaves values as they are and changes the unit.
fn unit_with_multiplier(field: &FieldLayout, letter: char) -> String {
    if field.unit.is_empty() || scale_of_letter(letter).is_some() {
        return field.unit.clone();
    }
    let prefixes = [
        (1.0, ""),
        (1e-1, "d"),
        (1e-2, "c"),
        (1e-3, "m"),
        (1e-6, "µ"),
        (1e-9, "n"),
    ];
    let factor = field.scale.factor();
    match prefixes.iter().find(|(known, _)| *known == factor) {
        Some((_, prefix)) => format!("{prefix}{}", field.unit),
        None => format!("{factor} {}", field.unit),
    }
}

/// The topic of a message.
fn topic_of<'a>(log: &'a Log, name: &str, instance: Option<&str>) -> &'a Topic {
    let instance = instance.map(|i| (i.parse().ok(), format!("{name}[{i}]")));
    let name = match instance {
        Some((Some(number), _)) => TopicName {
            name: name.to_owned(),
            instance: Some(number),
        },
        Some((None, name)) => TopicName::single(name),
        None => TopicName::single(name),
    };
    log.topic(&name)
        .unwrap_or_else(|| panic!("there is no {name}"))
}

/// Compares everything that both know of, and says how many values that were.
fn compare(log: &Log, answer: &Answer, is_text: bool) -> usize {
    let mut rows: BTreeMap<String, usize> = BTreeMap::new();
    let mut count = 0;
    for (name, instance, seconds, values) in &answer.messages {
        if is_text && name == "UNIT" {
            continue; // pymavlink leaves out lines that end with an empty text.
        }
        let topic = topic_of(log, name, instance.as_deref());
        let row = rows.entry(topic.name.to_string()).or_default();
        let format = &answer.formats[name];
        let columns = format.columns.iter().zip(format.letters.chars());
        for ((column, letter), value) in columns.zip(values) {
            let first = if letter == 'a' {
                format!("{column}[0]")
            } else {
                column.clone()
            };
            let field = topic
                .field(&first)
                .unwrap_or_else(|| panic!("{name} has no {column}"));
            // An array of text stays text for pymavlink.
            let value = match value.strip_prefix("s[") {
                Some(numbers) if letter == 'a' => format!("a{}", numbers.trim_end_matches(']')),
                _ => value.clone(),
            };
            assert!(
                is_theirs(&value, field, letter, topic, *row, is_text),
                "{name}.{column} of row {row}: {value}, here {:?}",
                topic.value(field, *row)
            );
            count += 1;
        }
        // What comes before the first time has none for pymavlink.
        let seconds = double(seconds);
        let time = topic.times[*row];
        assert!(
            seconds == 0.0 || (seconds - time).abs() < 1e-9 * seconds.max(1.0),
            "{name}: {time} s, not {seconds} s"
        );
        *row += 1;
    }
    for topic in &log.topics {
        let read = rows
            .get(&topic.name.to_string())
            .copied()
            .unwrap_or_default();
        assert!(
            read == topic.len() || (is_text && topic.name.name == "UNIT"),
            "{}: {read} rows",
            topic.name
        );
        let Some(format) = topic
            .name
            .name
            .split('[')
            .next()
            .and_then(|name| answer.formats.get(name))
        else {
            continue;
        };
        for ((column, letter), unit) in format
            .columns
            .iter()
            .zip(format.letters.chars())
            .zip(&format.units)
        {
            let first = if letter == 'a' {
                format!("{column}[0]")
            } else {
                column.clone()
            };
            let field = topic.field(&first).expect("compared above");
            assert_eq!(
                unit_with_multiplier(field, letter),
                *unit,
                "{}.{column}",
                topic.name
            );
        }
    }
    for (name, value) in &answer.parameters {
        let ours = log.parameter(name).expect("the parameter is there");
        let theirs = double(value);
        assert!(
            is_equal(ours, theirs) || (is_text && ours == f64::from(theirs as f32)),
            "{name}"
        );
    }
    assert_eq!(log.parameters.is_empty(), answer.parameters.is_empty());
    count
}

/// Modes after each message about one.
fn modes(log: &Log) -> Vec<String> {
    log.modes.iter().map(|change| change.mode.clone()).collect()
}

#[test]
fn a_recorded_log_has_the_messages_values_and_times_that_pymavlink_reads() {
    let Some(path) = shared("ardupilot_bin/test.BIN") else {
        return;
    };
    let bytes = std::fs::read(path).expect("the log is readable");
    let Some(answer) = theirs("test.BIN", &bytes) else {
        return;
    };
    let log = ours(&bytes);
    assert_eq!(log.report.messages, answer.messages.len() as u64);
    let count = compare(&log, &answer, false);
    assert!(count > 10_000, "{count} values");
    assert_eq!(modes(&log), answer.modes);
    assert_eq!(answer.parameters.len(), log.parameters.len());
    let start = log.utc_at_zero.expect("the log tells the date");
    assert!((start - answer.start.expect("the log tells the date")).abs() < 1e-6);
}

#[test]
fn every_letter_unit_multiplier_and_instance_is_as_pymavlink_reads_it() {
    let bytes = made::modern(Form::Binary, 1, 200);
    let Some(answer) = theirs("modern.bin", &bytes) else {
        return;
    };
    let log = ours(&bytes);
    assert!(log.report.is_clean(), "{:?}", log.report);
    assert_eq!(log.report.messages, answer.messages.len() as u64);
    compare(&log, &answer, false);
    assert_eq!(modes(&log), answer.modes);
    let instances = log.topics.iter().filter(|t| t.name.instance.is_some());
    assert!(instances.count() >= 9);
    assert!(log.topic(&TopicName::single("NVF[a b]")).is_some());
    let start = log.utc_at_zero.expect("the log tells the date");
    assert!((start - answer.start.expect("the log tells the date")).abs() < 1e-6);
}

#[test]
fn a_log_of_2013_is_as_pymavlink_reads_it_but_for_the_leap_seconds_of_that_year() {
    let bytes = made::of_2013(Form::Binary, 100);
    let Some(answer) = theirs("2013.bin", &bytes) else {
        return;
    };
    let log = ours(&bytes);
    assert!(log.report.is_clean());
    compare(&log, &answer, false);
    assert_eq!(modes(&log), answer.modes);
    let start = log.utc_at_zero.expect("the log tells the date");
    // pymavlink takes the 18 leap seconds since 2017 for all times; in 2013 there were 16.
    let theirs = answer.start.expect("the log tells the date") + 2.0;
    assert!((start - theirs).abs() < 1e-6, "{start} and {theirs}");
}

#[test]
fn logs_that_are_text_are_as_pymavlink_reads_them() {
    for (name, bytes) in [
        ("modern.log", made::modern(Form::Text, 1, 200)),
        ("2013.log", made::of_2013(Form::Text, 100)),
    ] {
        let Some(answer) = theirs(name, &bytes) else {
            return;
        };
        let log = ours(&bytes);
        assert!(log.report.is_clean(), "{:?}", log.report);
        let count = compare(&log, &answer, true);
        assert!(count > 500, "{count} values");
    }
}

#[test]
fn the_same_log_binary_and_as_text_is_the_same() {
    for (binary, text) in [
        (
            made::modern(Form::Binary, 2, 100),
            made::modern(Form::Text, 2, 100),
        ),
        (
            made::of_2013(Form::Binary, 50),
            made::of_2013(Form::Text, 50),
        ),
    ] {
        let (binary, text) = (ours(&binary), ours(&text));
        assert_eq!(binary.topics.len(), text.topics.len());
        for (a, b) in binary.topics.iter().zip(&text.topics) {
            assert_eq!(
                (&a.name, &a.fields, &a.times),
                (&b.name, &b.fields, &b.times)
            );
            for field in &a.fields {
                for row in 0..a.len() {
                    let value = |t: &Topic| t.value(field, row).map(|v| (v.is_nan(), v.to_bits()));
                    let text = |t: &Topic| t.rows.get(row).and_then(|r| field.text(r));
                    let same = match (value(a), value(b)) {
                        (Some((true, _)), Some((is_nan, _))) => is_nan,
                        (x, y) => x == y,
                    };
                    assert!(
                        same && text(a) == text(b),
                        "{}.{} of row {row}",
                        a.name,
                        field.name
                    );
                }
            }
        }
        assert_eq!(
            format!("{:?}", binary.parameters),
            format!("{:?}", text.parameters)
        );
        assert_eq!(
            (&binary.messages, &binary.modes),
            (&text.messages, &text.modes)
        );
        assert_eq!(
            (binary.utc_at_zero, &binary.vehicle),
            (text.utc_at_zero, &text.vehicle)
        );
    }
}
