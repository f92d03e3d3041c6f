//! `pilotage export`: the values of a log, to be compared with those of other programs or used in them.

use std::io::Write;
use std::path::{Path, PathBuf};

use pilotage_core::exchange::{Format, write_flown};
use pilotage_core::flight::log::{Log, Topic};
use pilotage_core::text::csv_cell;

use crate::CommandResult;
use crate::export_parquet::parquet;
use crate::export_track::{TrackKind, track};
use crate::export_value::{ExportValue, column_names, value};
use crate::opening::{OpenedPath, no_flight, open};

/// Arguments of `pilotage export`.
#[derive(clap::Args)]
pub struct Arguments {
    /// A flight log, or a flight of tables or photos.
    log: PathBuf,
    /// Topic as `pilotage inspect --counts` names it: `GPS`, `GPS[1]`; all instances of a name without one. Several for
    /// JSON.
    #[arg(long, value_name = "TOPIC")]
    topic: Vec<String>,
    /// Write where it flew instead, as this told it.
    #[arg(long, value_enum, conflicts_with = "topic")]
    track: Option<TrackKind>,
    /// Values beside the places of the track, and its colour in KML: `ATT.Roll`, or what is computed of such: `2 * ATT.Roll`.
    #[arg(long, value_name = "TOPIC.FIELD", requires = "track")]
    channel: Option<String>,
    /// Take the flight of another vehicle of a telemetry log, by the number of its system.
    #[arg(long, value_name = "SYSTEM")]
    vehicle: Option<u32>,
    /// Form of the output; without it as the ending of --out says, else CSV.
    #[arg(long, value_enum)]
    format: Option<OutputForm>,
    /// File to write; the terminal without it.
    #[arg(long, short, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Meaning of the columns of tables, as `pilotage columns --save` wrote it.
    #[arg(long, value_name = "MAP")]
    columns: Option<PathBuf>,
}

/// Forms of the output.
#[derive(Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum OutputForm {
    /// A line a row: `time_s`, then the fields with their units; of a track a line a place.
    Csv,
    /// An object by topic of an object by field of the list of its values.
    Json,
    /// Of a track: in time, and coloured by --channel.
    Kml,
    /// KML in a zip.
    Kmz,
    /// Of one topic: a column `time_s`, then one for each field; units stand in the properties of the file.
    Parquet,
    /// Of a track: a track.
    Gpx,
    /// Of a track: a line, with times and values in `coordinateProperties`.
    Geojson,
}

impl OutputForm {
    /// The format of a track, of that extension; `None` of a form that is for topics alone.
    fn of_track(self) -> Option<Format> {
        let form = clap::ValueEnum::to_possible_value(&self)?;
        let mut tracks = Format::all().filter(|format| format.holds_tracks());
        tracks.find(|format| format.extensions()[0] == form.get_name())
    }
}

impl Arguments {
    /// The form that was asked for, else that of the ending of the file to write, else CSV.
    fn form(&self) -> OutputForm {
        let ending = self.out.as_ref().and_then(|out| out.extension());
        let ending = ending.map(|ending| ending.to_string_lossy().into_owned());
        let by_name =
            ending.and_then(|ending| <OutputForm as clap::ValueEnum>::from_str(&ending, true).ok());
        self.format.or(by_name).unwrap_or(OutputForm::Csv)
    }
}

/// Writes the rows of topics, in the units of the log.
pub fn run(arguments: &Arguments) -> CommandResult {
    let path = &arguments.log;
    let opened = open(path, arguments.columns.as_deref())?.of_vehicle(arguments.vehicle)?;
    if let OpenedPath::Nothing(told) = &opened {
        return Err(no_flight(path, told).into());
    }
    let form = arguments.form();
    if let Some(kind) = arguments.track {
        let format = form.of_track();
        let format = format.ok_or_else(|| {
            format!(
                "a track is written as one of {}",
                Format::track_extensions()
            )
        })?;
        let written = write_flown(format, &track(opened, kind, arguments.channel.as_deref())?)?;
        for note in &written.notes {
            eprintln!("note: {note}");
        }
        return put(arguments.out.as_deref(), &written.bytes);
    }
    let log = match opened {
        OpenedPath::Log(log, _) => *log,
        OpenedPath::Folder(folder) | OpenedPath::Tables(folder) => folder.log(),
        OpenedPath::Nothing(told) => return Err(no_flight(path, &told).into()),
    };
    let topics = chosen(&log, &arguments.topic)?;
    let bytes = match (form, topics.as_slice()) {
        (OutputForm::Csv, [topic]) => csv(topic).into_bytes(),
        (OutputForm::Parquet, [topic]) => parquet(topic)?,
        (OutputForm::Csv | OutputForm::Parquet, _) => {
            let names = names(&topics);
            return Err(format!("a table has one topic; say which with --topic: {names}").into());
        }
        (OutputForm::Json, topics) => json(topics)?.into_bytes(),
        _ => return Err("values are written as csv, json or parquet; a track by --track".into()),
    };
    put(arguments.out.as_deref(), &bytes)?;
    for remark in &log.report.remarks {
        eprintln!("note: {remark}");
    }
    Ok(())
}

/// Writes to a file, or to the terminal without one.
fn put(out: Option<&Path>, bytes: &[u8]) -> CommandResult {
    match out {
        Some(out) => crate::files::write_whole(out, bytes)?,
        None => std::io::stdout().lock().write_all(bytes)?,
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

fn csv(topic: &Topic) -> String {
    let names = column_names(topic);
    let head = topic.fields.iter().zip(names).map(|(field, name)| {
        let unit = if field.unit.is_empty() {
            String::new()
        } else {
            format!(" [{}]", field.unit)
        };
        csv_cell(&format!("{name}{unit}"))
    });
    let mut text = format!("time_s,{}\n", head.collect::<Vec<_>>().join(","));
    for (time, row) in topic.times.iter().zip(topic.rows.iter()) {
        text += &time.to_string();
        for field in &topic.fields {
            text.push(',');
            match value(field, row) {
                Some(ExportValue::Whole(whole)) => text += &whole.to_string(),
                Some(ExportValue::Real(real)) => text += &real.to_string(),
                Some(ExportValue::Text(words)) => text += &csv_cell(&words),
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
        for (field, name) in topic.fields.iter().zip(column_names(topic)) {
            let values = topic.rows.iter().map(|row| match value(field, row) {
                Some(ExportValue::Whole(whole)) => i64::try_from(whole)
                    .map(Json::from)
                    .or_else(|_| u64::try_from(whole).map(Json::from))
                    .unwrap_or(Json::Null),
                Some(ExportValue::Real(real)) => Json::from(real),
                Some(ExportValue::Text(words)) => Json::from(words),
                None => Json::Null,
            });
            fields.insert(name, values.collect());
        }
        (topic.name.to_string(), Json::Object(fields))
    };
    let all: Map<String, Json> = topics.iter().map(of).collect();
    serde_json::to_string(&all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_format_of_tracks_can_be_asked_for() {
        let forms = <OutputForm as clap::ValueEnum>::value_variants();
        for format in Format::all().filter(|format| format.holds_tracks()) {
            let asked = forms.iter().find(|form| form.of_track() == Some(format));
            assert!(asked.is_some(), "{format:?}");
        }
        assert_eq!(OutputForm::Parquet.of_track(), None);
    }

    #[test]
    fn the_help_names_every_form_that_is_written() {
        let all = <crate::Arguments as clap::CommandFactory>::command();
        let export = all.find_subcommand("export").expect("the command");
        let about = export.get_about().expect("a line of help").to_string();
        for form in <OutputForm as clap::ValueEnum>::value_variants() {
            let form = clap::ValueEnum::to_possible_value(form).expect("a name");
            let named = about.to_lowercase();
            let mut words = named.split(|c: char| !c.is_alphanumeric());
            assert!(words.any(|word| word == form.get_name()), "{about}");
        }
    }
}
