//! Flights of whatever kind: folders, tables, logs, photos.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pilotage_core::flight::beside_log::add_pictures;
use pilotage_core::flight::columns::{ColumnMap, flight_of_tables, guess_tables};
use pilotage_core::flight::files::{FileSet, ZipFiles};
use pilotage_core::flight::foreign::foreign;
use pilotage_core::flight::interpret::flight_from_log;
use pilotage_core::flight::log::{HEAD, Log, read_log, recognise};
use pilotage_core::flight::mat::{self, MatFiles};
use pilotage_core::flight::nmea::{flight_of_sentences, is_nmea, read_nmea};
use pilotage_core::flight::photo::{add_photos, photos_lack, read_photos};
use pilotage_core::flight::srt::{flight_of_subtitles, read_srt};
use pilotage_core::flight::{
    FLIGHT_FILE, Flight, FlightFolder, FolderError, FrameSource, NoPictures, read_flight,
};
use pilotage_core::imagery::ByteSource;
use pilotage_jobs::COLUMNS_FILE;

use crate::files::{DirectoryFiles, DiskFile};

/// Endings of tables.
pub const TABLES: [&str; 3] = ["csv", "tsv", "txt"];

/// Contents of a path.
pub enum OpenedPath {
    /// A flight out of a folder, tables or photos.
    Folder(Box<FlightFolder>),
    /// A log of another program, and the files beside it.
    Log(Box<Log>, Arc<dyn FileSet>),
    /// None of these, and why tables among them are none, or empty.
    Nothing(String),
}

/// Pictures of a flight.
pub type Frames = Box<dyn FrameSource>;

impl OpenedPath {
    /// The contents with the vehicle of that system as the one that flies; all but telemetry logs know one vehicle.
    ///
    /// # Errors
    /// In words, where no such system flies in the log.
    pub fn of_vehicle(mut self, system: Option<u32>) -> Result<Self, String> {
        if let (Self::Log(log, _), Some(system)) = (&mut self, system) {
            log.choose_vehicle(system)?;
        }
        Ok(self)
    }

    /// The flight with its pictures, and what was assumed or left out, in sentences; `None` where there is none.
    ///
    /// # Errors
    /// A log that tells of no flight, or a table of pictures beside it that cannot be read.
    pub fn into_flight(self) -> Result<Option<(Flight, Frames, Vec<String>)>, String> {
        match self {
            Self::Folder(folder) => {
                Ok(Some((folder.flight, Box::new(folder.frames), folder.notes)))
            }
            Self::Log(log, beside) => {
                let flight = flight_from_log(&log).into_flight();
                let mut flight = flight.map_err(|e| e.to_string())?;
                let frames = add_pictures(&mut flight, &beside).map_err(|e| e.to_string())?;
                if let Some(frames) = frames {
                    return Ok(Some((flight, frames, Vec::new())));
                }
                let placed = add_photos(&log, &mut flight, &beside);
                let (frames, notes) = placed.map_or((None, Vec::new()), |p| (p.frames, p.notes));
                let frames = frames.unwrap_or_else(|| Box::new(NoPictures));
                Ok(Some((flight, frames, notes)))
            }
            Self::Nothing(told) if told.is_empty() => Ok(None),
            Self::Nothing(told) => Err(told),
        }
    }
}

/// Opens a path: a flight folder or its flight.json; tables, as `columns` or a file of that kind beside them says, else
/// as their columns are guessed; a log; photos.
///
/// # Errors
/// Files that are there and cannot be read.
pub fn open(path: &Path, columns: Option<&Path>) -> Result<OpenedPath, Box<dyn std::error::Error>> {
    let is_flight_file = path.file_name().is_some_and(|n| n == FLIGHT_FILE);
    if path.is_dir() || is_flight_file {
        let files: Arc<dyn FileSet> = Arc::new(DirectoryFiles::open(path)?);
        return open_folder(&files, columns);
    }
    if let Some(files) = unpacked(path)? {
        return open_folder(&files, columns);
    }
    let file = DiskFile::open(path, &path.to_string_lossy());
    let file = file.map_err(|e| format!("{}: {e}", path.display()))?;
    if let Some(log) = read_log(&file)? {
        let beside: Arc<dyn FileSet> = Arc::new(DirectoryFiles::around(path)?);
        return Ok(OpenedPath::Log(Box::new(log), beside));
    }
    let length = HEAD.min(usize::try_from(file.length()).unwrap_or(HEAD));
    if file.read(0, length).is_ok_and(|head| is_nmea(&head)) {
        let bytes = std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
        let name = path.file_name().map(|name| name.to_string_lossy());
        let folder = read_nmea(&name.unwrap_or_default(), &bytes)?;
        return Ok(folder.map_or(OpenedPath::Nothing(String::new()), |folder| {
            OpenedPath::Folder(Box::new(folder))
        }));
    }
    if has_ending(path, &["srt"]) {
        let bytes = std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
        let name = path.file_name().map(|name| name.to_string_lossy());
        let folder = read_srt(&name.unwrap_or_default(), &bytes)?;
        return Ok(folder.map_or(OpenedPath::Nothing(String::new()), |folder| {
            OpenedPath::Folder(Box::new(folder))
        }));
    }
    if !has_ending(path, &TABLES) {
        return Ok(OpenedPath::Nothing(String::new()));
    }
    let (files, names) = tables_at(&[path.to_owned()])?;
    let folder = open_tables(&files, &names, columns)?;
    Ok(match folder {
        Some(folder) => OpenedPath::Folder(Box::new(folder)),
        None => OpenedPath::Nothing(nothing(files.as_ref(), &names)),
    })
}

/// The reason why a path is no flight: the one that tables among it `told`, else its kind by its content, else that it
/// is none.
pub fn no_flight(path: &Path, told: &str) -> String {
    let name = path.display();
    if !told.is_empty() {
        return format!("{name}: {told}");
    }
    let file = DiskFile::open(path, &path.to_string_lossy()).ok();
    let is = file.and_then(|file| {
        let length = HEAD.min(usize::try_from(file.length()).unwrap_or(HEAD));
        foreign(&file.read(0, length).ok()?, file.length())
    });
    match is {
        Some(is) => format!(
            "{name}: it is {}, which is not read; {}",
            is.what, is.advice
        ),
        None => format!("{name}: neither a flight folder, a log, tables nor photos"),
    }
}

/// Contents of a zip or of a MATLAB file, as files; `None` of anything else.
fn unpacked(path: &Path) -> Result<Option<Arc<dyn FileSet>>, String> {
    let blame = |e: &dyn std::fmt::Display| format!("{}: {e}", path.display());
    let is_zip = has_ending(path, &["zip"]);
    if !is_zip && !has_ending(path, &[mat::ENDING]) {
        return Ok(None);
    }
    let bytes = std::fs::read(path).map_err(|e| blame(&e))?;
    if is_zip {
        let files = ZipFiles::open(&bytes).map_err(|e| blame(&e))?;
        return Ok(Some(Arc::new(files)));
    }
    let name = path
        .file_name()
        .map_or_else(String::new, |n| n.to_string_lossy().into_owned());
    let files = MatFiles::open(&name, &bytes).map_err(|e| e.to_string())?;
    Ok(Some(Arc::new(files)))
}

fn open_folder(
    files: &Arc<dyn FileSet>,
    columns: Option<&Path>,
) -> Result<OpenedPath, Box<dyn std::error::Error>> {
    match read_flight(Arc::clone(files)) {
        Err(FolderError::NoFlightFile) => {}
        other => return Ok(OpenedPath::Folder(Box::new(other?))),
    }
    if columns.is_none()
        && let Some(source) = log_among(files.as_ref())
        && let Some(log) = read_log(source.as_ref())?
    {
        return Ok(OpenedPath::Log(Box::new(log), Arc::clone(files)));
    }
    let names = table_names(files.as_ref());
    if let Some(folder) = open_tables(files, &names, columns)? {
        return Ok(OpenedPath::Folder(Box::new(folder)));
    }
    if let Some(filmed) = flight_of_subtitles(files)? {
        return Ok(OpenedPath::Folder(Box::new(filmed)));
    }
    if let Some(recorded) = flight_of_sentences(files)? {
        return Ok(OpenedPath::Folder(Box::new(recorded)));
    }
    if let Some(photos) = read_photos(files) {
        return Ok(OpenedPath::Folder(Box::new(photos)));
    }
    let why = photos_lack(files.as_ref()).filter(|_| names.is_empty());
    Err(why
        .unwrap_or_else(|| nothing(files.as_ref(), &names))
        .into())
}

/// That nothing among files is a flight, and what to do.
fn nothing(files: &dyn FileSet, tables: &[String]) -> String {
    if tables.is_empty() {
        let names = files.names();
        let some: Vec<&str> = names.iter().take(5).map(String::as_str).collect();
        let more = if names.len() > some.len() {
            ", …"
        } else {
            ""
        };
        let held = if some.is_empty() {
            "there is nothing in it".to_owned()
        } else {
            format!("it holds {}{more}", some.join(", "))
        };
        return format!(
            "no log, no table and no photos with places are among the files, and no flight.json: {held}"
        );
    }
    let guessed = guess_tables(files, tables);
    let told = |name: &String| {
        let table = guessed.iter().find(|table| table.map.file == *name);
        let Some(table) = table else {
            let named = || {
                let source = files.source(name)?;
                let length = HEAD.min(usize::try_from(source.length()).unwrap_or(HEAD));
                foreign(&source.read(0, length).ok()?, source.length())
            };
            let is = named().map_or_else(
                || "no table: fewer than two rows or columns, or no column of numbers".to_owned(),
                |is| format!("it is {}; {}", is.what, is.advice),
            );
            return format!("\n  {name}: {is}");
        };
        let findings = table.map.findings.iter();
        let findings: Vec<String> = findings.map(|finding| format!("; {finding}")).collect();
        format!("\n  {name}: {}{}", lacking(&table.map), findings.concat())
    };
    let told: Vec<String> = tables.iter().map(told).collect();
    format!(
        "no flight can be made of it as its columns are guessed; say what they mean with `pilotage columns`{}",
        told.concat()
    )
}

/// The lack of a table that is no flight, with the columns that it has.
fn lacking(map: &ColumnMap) -> String {
    let names = map.columns.iter().map(|column| column.name.as_str());
    let names: Vec<&str> = names.take(12).collect();
    let more = if map.columns.len() > names.len() {
        ", …"
    } else {
        ""
    };
    let why = map
        .lacks()
        .unwrap_or_else(|| "no column is surely the time".to_owned());
    format!("{why}; its columns are {}{more}", names.join(", "))
}

/// The first log among files, by what is in it.
fn log_among(files: &dyn FileSet) -> Option<Arc<dyn ByteSource>> {
    let mut names = files.names();
    names.sort();
    names.into_iter().find_map(|name| {
        let source = files.source(&name)?;
        let length = HEAD.min(usize::try_from(source.length()).unwrap_or(HEAD));
        let head = source.read(0, length).ok()?;
        recognise(&head).map(|_| source)
    })
}

/// The names among files that may be tables, in order.
pub fn table_names(files: &dyn FileSet) -> Vec<String> {
    let mut names = files.names();
    names.retain(|name| has_ending(Path::new(name), &TABLES));
    names.sort();
    names
}

/// The folder in which tables at these paths lie, and their names in it: all tables of a folder.
///
/// # Errors
/// A path that is not there, or tables in several folders.
pub fn tables_at(paths: &[PathBuf]) -> Result<(Arc<dyn FileSet>, Vec<String>), String> {
    let [first, others @ ..] = paths else {
        return Err("say which tables".to_owned());
    };
    if first.is_dir() {
        let files = DirectoryFiles::open(first).map_err(|e| format!("{}: {e}", first.display()))?;
        let names = table_names(&files);
        return Ok((Arc::new(files), names));
    }
    if let Some(files) = unpacked(first)? {
        let names = table_names(files.as_ref());
        return Ok((files, names));
    }
    let files = DirectoryFiles::around(first)?;
    if let Some(other) = others.iter().find(|other| other.parent() != first.parent()) {
        return Err(format!(
            "{}: it is in another folder than {}",
            other.display(),
            first.display()
        ));
    }
    let name = |path: &PathBuf| path.file_name().map(|n| n.to_string_lossy().into_owned());
    Ok((Arc::new(files), paths.iter().filter_map(name).collect()))
}

fn open_tables(
    files: &Arc<dyn FileSet>,
    names: &[String],
    columns: Option<&Path>,
) -> Result<Option<FlightFolder>, Box<dyn std::error::Error>> {
    let guessed = || -> Vec<ColumnMap> {
        let tables = guess_tables(files.as_ref(), names).into_iter();
        tables.filter(|t| t.is_proposed).map(|t| t.map).collect()
    };
    let maps = said(files.as_ref(), names, columns)?.unwrap_or_else(guessed);
    if maps.is_empty() {
        return Ok(None);
    }
    Ok(Some(flight_of_tables(files, &maps)?))
}

/// Column maps of tables that people wrote: in the file `columns`, or in one called [`COLUMNS_FILE`] beside them. A
/// map of one table is taken for the only table, whatever that is called.
///
/// # Errors
/// A file that is not there or no column map, or maps of tables that are not there.
pub fn said(
    files: &dyn FileSet,
    names: &[String],
    columns: Option<&Path>,
) -> Result<Option<Vec<ColumnMap>>, String> {
    let bytes = match columns {
        Some(path) => Some(std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?),
        None => files.read(COLUMNS_FILE),
    };
    let Some(bytes) = bytes else { return Ok(None) };
    let file = columns.map_or(COLUMNS_FILE.to_owned(), |path| path.display().to_string());
    let mut maps: Vec<ColumnMap> =
        serde_json::from_slice(&bytes).map_err(|e| format!("{file}: {e}"))?;
    if let ([map], [name]) = (maps.as_mut_slice(), names) {
        map.file.clone_from(name);
    }
    let short = |name: &str| name.rsplit('/').next().unwrap_or(name).to_owned();
    for map in &mut maps {
        let by_whole = names.iter().find(|name| **name == map.file);
        let by_short = || names.iter().find(|name| short(name) == short(&map.file));
        match by_whole.or_else(by_short) {
            Some(name) => map.file.clone_from(name),
            // A map beside tables may tell of more than are looked at.
            None if columns.is_none() => {}
            None => {
                return Err(format!(
                    "{file}: there is no table {} among these",
                    map.file
                ));
            }
        }
    }
    maps.retain(|map| names.contains(&map.file));
    Ok(Some(maps).filter(|maps| !maps.is_empty()))
}

/// Whether a file's name ends so.
pub fn has_ending(path: &Path, endings: &[&str]) -> bool {
    pilotage_jobs::has_ending(&path.to_string_lossy(), endings)
}
