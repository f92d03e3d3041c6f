//! `pilotage export`: the values of a log, to be compared with those of other programs or used in them.

use std::io::Write;
use std::path::PathBuf;

use pilotage_core::flight::log::{FieldLayout, Log, Scale, Topic};
use pilotage_core::text::csv_cell;

use crate::Outcome;
use crate::opening::{Opened, open};

/// Arguments of `pilotage export`.
#[derive(clap::Args)]
pub struct Arguments {
    /// A flight log, or a flight of tables or photos.
    log: PathBuf,
    /// Topic as `pilotage inspect --counts` names it: `GPS`, `GPS[1]`; all instances of a name without one. Several for
    /// JSON.
    #[arg(long, value_name = "TOPIC")]
    topic: Vec<String>,
    /// Form of the output.
    #[arg(long, value_enum, default_value = "csv")]
    format: Form,
    /// File to write; the terminal without it.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Meaning of the columns of tables, as `pilotage columns --save` wrote it.
    #[arg(long, value_name = "MAP")]
    columns: Option<PathBuf>,
}

/// Forms of the output.
#[derive(Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Form {
    /// A line a row: `time_s`, then the fields with their units.
    Csv,
    /// An object by topic of an object by field of the list of its values.
    Json,
}

/// Writes the rows of topics, in the units of the log.
pub fn run(arguments: &Arguments) -> Outcome {
    let path = &arguments.log;
    let log = match open(path, arguments.columns.as_deref())? {
        Opened::Log(log, _) => *log,
        Opened::Folder(folder) => folder.log(),
        Opened::Nothing(_) => {
            return Err(format!("{}: no flight log and no flight", path.display()).into());
        }
    };
    let topics = chosen(&log, &arguments.topic)?;
    let text = match (arguments.format, topics.as_slice()) {
        (Form::Csv, [topic]) => csv(topic),
        (Form::Csv, _) => {
            let names = names(&topics);
            return Err(format!("a table has one topic; say which with --topic: {names}").into());
        }
        (Form::Json, topics) => json(topics)?,
    };
    match &arguments.out {
        Some(out) => std::fs::write(out, text).map_err(|e| format!("{}: {e}", out.display()))?,
        None => std::io::stdout().lock().write_all(text.as_bytes())?,
    }
    for remark in &log.report.remarks {
        eprintln!("note: {remark}");
    }
    Ok(())
}

/// The topics of these names; all with rows if none is named.
fn chosen<'a>(log: &'a Log, wanted: &[String]) -> Result<Vec<&'a Topic>, String> {
    let all: Vec<&Topic> = log
        .topics
        .iter()
        .filter(|topic| !topic.is_empty())
        .collect();
    if wanted.is_empty() {
        return Ok(all);
    }
    let mut found = Vec::new();
    for name in wanted {
        let is_it = |topic: &&&Topic| topic.name.to_string() == *name || topic.name.name == *name;
        let before = found.len();
        found.extend(all.iter().filter(is_it).copied());
        if found.len() == before {
            let names = names(&all);
            return Err(format!("{}: no topic {name}; there are {names}", log.name));
        }
    }
    Ok(found)
}

fn names(topics: &[&Topic]) -> String {
    let names: Vec<String> = topics.iter().map(|topic| topic.name.to_string()).collect();
    names.join(", ")
}

/// A value of a row.
enum Value {
    Whole(i128),
    Real(f64),
    Text(String),
}

/// The value of a field in its unit; whole numbers that nothing scales keep all their digits, and bytes that are neither
/// number nor letters are written as hexadecimal digits.
fn value(field: &FieldLayout, row: &[u8]) -> Option<Value> {
    let bytes = field.bytes(row)?;
    if field.scale == Scale::One
        && let Some(whole) = field.kind.integer(bytes)
    {
        return Some(Value::Whole(whole));
    }
    let real = field.value(row).map(Value::Real);
    let text = || field.text(row).map(Value::Text);
    real.or_else(text)
        .or_else(|| Some(Value::Text(hex_digits(bytes))))
}

fn hex_digits(bytes: &[u8]) -> String {
    let digits = bytes.iter().flat_map(|byte| [byte >> 4, byte & 15]);
    let letters = digits.filter_map(|digit| char::from_digit(u32::from(digit), 16));
    letters.collect()
}

fn csv(topic: &Topic) -> String {
    let head = topic.fields.iter().map(|field| {
        let unit = if field.unit.is_empty() {
            String::new()
        } else {
            format!(" [{}]", field.unit)
        };
        csv_cell(&format!("{}{unit}", field.name))
    });
    let mut text = format!("time_s,{}\n", head.collect::<Vec<_>>().join(","));
    for (time, row) in topic.times.iter().zip(topic.rows.iter()) {
        text += &time.to_string();
        for field in &topic.fields {
            text.push(',');
            match value(field, row) {
                Some(Value::Whole(whole)) => text += &whole.to_string(),
                Some(Value::Real(real)) => text += &real.to_string(),
                Some(Value::Text(words)) => text += &csv_cell(&words),
                None => {}
            }
        }
        text.push('\n');
    }
    text
}

/// Numbers that are none are null, as JSON has no others.
fn json(topics: &[&Topic]) -> Result<String, serde_json::Error> {
    use serde_json::{Map, Value as Json};
    let of = |topic: &&Topic| {
        let mut fields = Map::new();
        fields.insert("time_s".to_owned(), topic.times.clone().into());
        for field in &topic.fields {
            let values = topic.rows.iter().map(|row| match value(field, row) {
                Some(Value::Whole(whole)) => i64::try_from(whole)
                    .map(Json::from)
                    .or_else(|_| u64::try_from(whole).map(Json::from))
                    .unwrap_or(Json::Null),
                Some(Value::Real(real)) => Json::from(real),
                Some(Value::Text(words)) => Json::from(words),
                None => Json::Null,
            });
            fields.insert(field.name.clone(), values.collect());
        }
        (topic.name.to_string(), Json::Object(fields))
    };
    let all: Map<String, Json> = topics.iter().map(of).collect();
    serde_json::to_string(&all)
}
