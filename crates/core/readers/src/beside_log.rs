//! Pictures that lie beside a log, and when they were taken.

use std::sync::Arc;

use super::folder::FolderFrames;
use pilotage_base::files::{FileSet, file_of, folder_of, joined};
use pilotage_flight::{Flight, Frame, FrameSource};
use pilotage_raster::camera::{CameraModel, UNSTATED_MOUNT_DEVIATION};

/// Name of the table of times that lies beside pictures.
pub const PICTURE_TABLE: &str = "frames.csv";
/// Horizontal field of view of a camera of which nothing is known, radians.
const LIKELY_FIELD: f64 = 60.0 * std::f64::consts::PI / 180.0;

/// Why pictures beside a log cannot be put in time.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BesideLogError {
    /// The table has no such column.
    #[error("{file}: no column `{column}` in its first line; it needs `time` (seconds) and `file`")]
    NoColumn {
        /// The table.
        file: String,
        /// The column.
        column: &'static str,
    },
    /// A line of the table makes no sense.
    #[error("{file}, line {line}: {cause}")]
    Line {
        /// The table.
        file: String,
        /// The line, from one.
        line: u64,
        /// Error of the line, in words.
        cause: String,
    },
}

/// Pictures beside a log.
pub struct PicturesBesideLog {
    /// Pictures of the flight.
    pub frames: Box<dyn FrameSource>,
    /// Notes on other tables of pictures that were left out.
    pub notes: Vec<String>,
}

/// Puts the pictures beside a log into its flight: those that the table [`PICTURE_TABLE`] names, with their
/// times in seconds since the first moment of the log. `None` if there is no such table.
///
/// Nothing says which field of view the camera has: 60 degrees are assumed until it is measured.
///
/// # Errors
/// A table that cannot be read, with its line.
pub fn add_pictures(
    flight: &mut Flight,
    files: &Arc<dyn FileSet>,
) -> Result<Option<PicturesBesideLog>, BesideLogError> {
    let (first, _) = flight.span();
    let (frames, notes) = pictures_counted_from(first, None, flight, files)?;
    Ok(frames.map(|frames| PicturesBesideLog {
        frames: Box::new(frames),
        notes,
    }))
}

/// Film whose pictures a table has, as the page names the folder that it puts them into: `a.MP4.frames`.
fn film_of(table: &str) -> Option<&str> {
    folder_of(table).strip_suffix(".frames")
}

/// Name of a file without its ending, in small letters, with its folder and without.
fn stems(name: &str) -> [String; 2] {
    let name = name.to_lowercase();
    let file = file_of(&name);
    let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
    [joined(folder_of(&name), stem), stem.to_owned()]
}

/// The table of pictures that belongs to `film`, which may lie in another folder: one that names no film will do.
/// Of a flight of no film it is the first.
fn table_of<'a>(film: Option<&str>, tables: &'a [String]) -> Option<&'a String> {
    let Some(film) = film.map(stems) else {
        return tables.first();
    };
    let same = |place: usize| {
        let is_same = |table: &&String| {
            film_of(table).is_some_and(|other| stems(other)[place] == film[place])
        };
        tables.iter().find(is_same)
    };
    same(0)
        .or_else(|| same(1))
        .or_else(|| tables.iter().find(|table| film_of(table).is_none()))
}

/// The same with the table's times counted from `zero` of the flight, seconds; of a flight that a film, or what was written
/// beside it, tells of, the pictures of that film. Also notes on tables that were left out.
pub(crate) fn pictures_counted_from(
    zero: f64,
    film: Option<&str>,
    flight: &mut Flight,
    files: &Arc<dyn FileSet>,
) -> Result<(Option<FolderFrames>, Vec<String>), BesideLogError> {
    let is_table = |name: &String| name.rsplit('/').next() == Some(PICTURE_TABLE);
    let mut tables = files.names();
    tables.retain(is_table);
    let chosen = table_of(film, &tables);
    let others = tables.iter().filter(|table| Some(*table) != chosen);
    let notes = others.map(|other| match film_of(other) {
        Some(film) => format!("the pictures of {film} were left out: they are of another film"),
        None => format!("the pictures of {other} were left out: there are others"),
    });
    let notes = notes.collect();
    let Some(table) = chosen else {
        return Ok((None, notes));
    };
    let bytes = files.read(table).unwrap_or_default();
    let mut found = times_and_names(table, &bytes)?;
    let has_file = |name: &str| files.source(&joined(folder_of(table), name)).is_some();
    found.retain(|(_, name)| has_file(name));
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let names: Vec<String> = found.iter().map(|(_, name)| name.clone()).collect();
    flight.frames = found
        .into_iter()
        .map(|(time, name)| Frame {
            time: zero + time,
            name,
            stored_turn: 0.0,
        })
        .collect();
    let folders = vec![folder_of(table).to_owned()];
    let mut source = FolderFrames::new(files.clone(), folders, "", names);
    if let Ok(picture) = source.picture(0) {
        flight.camera = CameraModel {
            mount_deviation: UNSTATED_MOUNT_DEVIATION,
            ..CameraModel::pinhole(picture.width(), picture.height(), LIKELY_FIELD)
        };
    }
    Ok((Some(source), notes))
}

/// Seconds and file of each line.
fn times_and_names(file: &str, bytes: &[u8]) -> Result<Vec<(f64, String)>, BesideLogError> {
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .flexible(true)
        .from_reader(bytes);
    let bad = |line: u64, cause: String| BesideLogError::Line {
        file: file.to_owned(),
        line,
        cause,
    };
    let headers = reader
        .headers()
        .map_err(|cause| bad(1, cause.to_string()))?
        .clone();
    let column = |name: &'static str| {
        let found = headers.iter().position(|h| h.eq_ignore_ascii_case(name));
        found.ok_or_else(|| BesideLogError::NoColumn {
            file: file.to_owned(),
            column: name,
        })
    };
    let (time_column, file_column) = (column("time")?, column("file")?);
    let mut found = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|cause| {
            let line = cause.position().map_or(0, csv::Position::line);
            bad(line, cause.to_string())
        })?;
        let line = record.position().map_or(0, csv::Position::line);
        let text = record.get(time_column).unwrap_or_default();
        let time = text.parse::<f64>().ok().filter(|t| t.is_finite());
        let time = time.ok_or_else(|| bad(line, format!("\"{text}\" is no time in seconds")))?;
        let name = record.get(file_column).filter(|name| !name.is_empty());
        let name = name.ok_or_else(|| bad(line, "no file is named".to_owned()))?;
        found.push((time, name.to_owned()));
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use super::*;
    use crate::interpret::flight_from_log;
    use crate::log::{Log, recognise};
    use pilotage_base::files::MemoryFiles;
    use pilotage_raster::raster::{Picture, encode_png};

    fn flight() -> Flight {
        let mut text = String::from(
            "FMT, 128, 89, FMT, BBnNZ, Type,Length,Name,Format,Columns\n\
             FMT, 1, 23, ATT, Qfff, TimeUS,Roll,Pitch,Yaw\n\
             FMT, 2, 27, GPS, QBLLfff, TimeUS,Status,Lat,Lng,Alt,Spd,GCrs\n",
        );
        for i in 0..50_u32 {
            let time = 7_000_000 + 100_000 * i;
            let gps = format!("GPS, {time}, 3, 47.0, 8.0, 500, 20, 90");
            writeln!(text, "ATT, {time}, 0, 0, 90\n{gps}").unwrap();
        }
        let mut reader = (recognise(text.as_bytes()).unwrap().reader)();
        let mut log = Log::new("a.log", recognise(text.as_bytes()).unwrap().format);
        reader.feed(text.as_bytes(), &mut log);
        reader.finish(&mut log);
        flight_from_log(&log).into_flight().unwrap()
    }

    fn files(table: &str) -> Arc<dyn FileSet> {
        let picture = encode_png(&Picture::filled(80, 60, [1, 2, 3])).unwrap();
        let files = [
            ("film/frames.csv", table.as_bytes().to_vec()),
            ("film/a.png", picture.clone()),
            ("film/b.png", picture),
        ];
        let named = files.map(|(name, bytes)| (name.to_owned(), bytes));
        Arc::new(MemoryFiles(named.into()))
    }

    #[test]
    fn pictures_come_in_order_of_time_counted_from_the_first_moment_of_the_log() {
        let mut flight = flight();
        let (first, _) = flight.span();
        let files = files("time,file\n2.5,b.png\n0.5,a.png\n3,lost.png\n");
        let mut source = add_pictures(&mut flight, &files).unwrap().unwrap();
        let times: Vec<f64> = flight.frames.iter().map(|f| f.time - first).collect();
        assert_eq!(times, [0.5, 2.5]);
        assert_eq!(flight.frames[1].name, "b.png");
        assert_eq!((flight.camera.width, flight.camera.height), (80, 60));
        assert_eq!(source.frames.picture(1).unwrap().width(), 80);
        assert!(source.notes.is_empty());
    }

    #[test]
    fn of_several_films_beside_a_log_the_first_is_taken_and_the_others_are_told() {
        let table = b"time,file\n0.5,a.png\n".to_vec();
        let files = ["a.MP4.frames/frames.csv", "b.MP4.frames/frames.csv"];
        let files = files.map(|name| (name.to_owned(), table.clone()));
        let files: Arc<dyn FileSet> = Arc::new(MemoryFiles(files.into()));
        let found = add_pictures(&mut flight(), &files).unwrap().unwrap();
        let told = "the pictures of b.MP4 were left out: they are of another film";
        assert_eq!(found.notes, [told]);
    }

    #[test]
    fn without_a_table_there_are_no_pictures() {
        let none: Arc<dyn FileSet> = Arc::new(MemoryFiles::default());
        assert!(add_pictures(&mut flight(), &none).unwrap().is_none());
    }

    #[test]
    fn a_table_that_makes_no_sense_is_named_with_its_line() {
        let cause = |table| {
            let found = add_pictures(&mut flight(), &files(table));
            found.err().unwrap().to_string()
        };
        assert!(
            cause("time,file\n0.5,a.png\nlate,b.png\n").contains("frames.csv, line 3: \"late\"")
        );
        assert!(cause("when,file\n0.5,a.png\n").contains("no column `time`"));
    }
}
