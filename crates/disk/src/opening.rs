//! Flights of whatever kind: folders, tables, logs, photos.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pilotage_core::flight::columns::{ColumnMap, flight_of_tables, guess_tables};
use pilotage_core::flight::files::{self, FileSet, ZipFiles};
use pilotage_core::flight::log::{Log, read_log};
use pilotage_core::flight::mat::{self, MatFiles};
use pilotage_core::flight::photo::photos_lack;
use pilotage_core::flight::{FLIGHT_FILE, FlightFolder};
use pilotage_jobs::{
    OpenFlight, StatedColumns, TABLES, choose_vehicle, flight_among, flight_of_file, foreign_kind,
    is_text_table, log_among, maps_beside, open_log, table_names, with_films_told,
};

use crate::files::{DirectoryFiles, DiskFile};

/// Most files of a folder or zip that are named where none of them is a flight.
const NAMED: usize = 5;

/// Contents of a path.
pub enum OpenedPath {
    /// A flight out of a folder or photos.
    Folder(Box<FlightFolder>),
    /// A flight out of tables, as somebody said what their columns mean or as that was guessed: what lies beside them need
    /// not be of the flight.
    Tables(Box<FlightFolder>),
    /// A log of another program, and the files beside it.
    Log(Box<Log>, Arc<dyn FileSet>),
    /// None of these, and why tables among them are none, or empty.
    Nothing(String),
}

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
    /// A log that tells of no flight.
    pub fn into_flight(self) -> Result<Option<(OpenFlight, Vec<String>)>, String> {
        match self {
            Self::Folder(mut folder) | Self::Tables(mut folder) => {
                let notes = std::mem::take(&mut folder.notes);
                Ok(Some((OpenFlight::of_folder(*folder, None), notes)))
            }
            Self::Log(log, beside) => {
                let (open, lost, mut notes) = open_log(&log, &beside)?;
                notes.extend(lost.map(|lost| format!("{lost}; its pictures are left out")));
                Ok(Some((open, notes)))
            }
            Self::Nothing(told) if told.is_empty() => Ok(None),
            Self::Nothing(told) => Err(told),
        }
    }
}

/// Opens a path: a flight folder or its flight.json; tables, as `columns` or a file of that kind beside them says, else
/// as their columns are guessed; a log; photos.
///
/// ```
/// use pilotage_disk::opening::{OpenedPath, open};
///
/// // What a satellite receiver said, under a name that does not tell.
/// let path = std::env::temp_dir().join(format!("pilotage-walk-{}.txt", std::process::id()));
/// let told = |at, minutes| format!("$GPGGA,{at},4807.{minutes},N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,\n");
/// std::fs::write(&path, [told("123519", "038"), told("123521", "044")].concat())?;
/// let OpenedPath::Folder(walk) = open(&path, None)? else { return Err("no flight".into()) };
/// let states = walk.flight.truth.ok_or("no track")?.states;
/// assert_eq!((states.len(), states[1].time - states[0].time), (2, 2.0));
/// std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Files that are there and cannot be read.
pub fn open(path: &Path, columns: Option<&Path>) -> Result<OpenedPath, Box<dyn std::error::Error>> {
    open_among(path, folder_at(path)?.as_ref(), columns)
}

/// The same of the files that the path holds, if it holds any.
pub(crate) fn open_among(
    path: &Path,
    files: Option<&Arc<dyn FileSet>>,
    columns: Option<&Path>,
) -> Result<OpenedPath, Box<dyn std::error::Error>> {
    if let Some(files) = files {
        return open_folder(files, columns);
    }
    let file = DiskFile::open(path, &path.to_string_lossy());
    let file = file.map_err(|e| format!("{}: {e}", path.display()))?;
    if let Some(mut log) = read_log(&file)? {
        let beside: Arc<dyn FileSet> = Arc::new(DirectoryFiles::around(path)?);
        choose_vehicle(beside.as_ref(), &mut log)?;
        return Ok(OpenedPath::Log(Box::new(log), beside));
    }
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    if let Some(folder) = flight_of_file(&name, &file)? {
        return Ok(OpenedPath::Folder(Box::new(folder)));
    }
    if !is_text_table(&file) {
        return Ok(OpenedPath::Nothing(String::new()));
    }
    let (files, names) = tables_at(&[path.to_owned()])?;
    let maps = said(files.as_ref(), &names, columns)?;
    Ok(match open_tables(&files, &names, maps)? {
        Some(folder) => OpenedPath::Tables(Box::new(folder)),
        // Text under any other name need not be a table.
        None if !has_ending(path, &TABLES) => OpenedPath::Nothing(String::new()),
        None => OpenedPath::Nothing(nothing(files.as_ref(), &names)),
    })
}

/// The files of a folder, a flight.json, a zip or a MATLAB file; `None` of anything else.
pub(crate) fn folder_at(
    path: &Path,
) -> Result<Option<Arc<dyn FileSet>>, Box<dyn std::error::Error>> {
    if let Some(files) = directory_at(path)? {
        return Ok(Some(Arc::new(files)));
    }
    Ok(unpacked(path)?)
}

/// The files of a folder or around a flight.json; `None` of anything else.
pub(crate) fn directory_at(path: &Path) -> std::io::Result<Option<DirectoryFiles>> {
    let is_flight_file = path.file_name().is_some_and(|n| n == FLIGHT_FILE);
    let is_folder = path.is_dir() || is_flight_file;
    is_folder.then(|| DirectoryFiles::open(path)).transpose()
}

/// The reason why a path is no flight: the one that tables among it `told`, else its kind by its content, else that it
/// is none.
pub fn no_flight(path: &Path, told: &str) -> String {
    let name = path.display();
    if !told.is_empty() {
        return format!("{name}: {told}");
    }
    foreign_words(path)
        .unwrap_or_else(|| format!("{name}: neither a flight folder, a log, tables nor photos"))
}

/// That a file is one of another program which is not read, and what to do, if it is.
pub fn foreign_words(path: &Path) -> Option<String> {
    let name = path.display();
    let is = foreign_kind(&DiskFile::open(path, &name.to_string()).ok()?)?;
    Some(is.sentence(&name.to_string()))
}

/// Contents of a zip or of a MATLAB file, as files; `None` of anything else.
pub fn unpacked(path: &Path) -> Result<Option<Arc<dyn FileSet>>, String> {
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
    let names = table_names(files.as_ref());
    let maps = said(files.as_ref(), &names, columns)?;
    if let Some(folder) = flight_among(files, maps.as_deref())?.map(Box::new) {
        return Ok(match maps {
            Some(_) => OpenedPath::Tables(folder),
            None => OpenedPath::Folder(folder),
        });
    }
    if let Some(source) = log_among(files.as_ref()).and_then(|name| files.source(&name))
        && let Some(mut log) = read_log(source.as_ref())?
    {
        choose_vehicle(files.as_ref(), &mut log)?;
        return Ok(OpenedPath::Log(Box::new(log), Arc::clone(files)));
    }
    if let Some(folder) = open_tables(files, &names, None)? {
        let folder = with_films_told(folder, files.as_ref());
        return Ok(OpenedPath::Tables(Box::new(folder)));
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
        let some: Vec<&str> = names.iter().take(NAMED).map(String::as_str).collect();
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
        let has_ending = |endings: &[&str]| {
            let mut all = names.iter();
            !names.is_empty() && all.all(|name| files::has_ending(name, endings))
        };
        let advice = match () {
            () if has_ending(&["zip"]) => "; unpack it, and open a zip that was in it".to_owned(),
            () if has_ending(&["png", "tif", "tiff", "webp", "heic", "jxl"]) => {
                "; photos with places are read from JPEG and PNG: save them so".to_owned()
            }
            () => kind_within(files, &names),
        };
        return format!(
            "no log, no table and no photos with places are among the files, and no flight.json: {held}{advice}"
        );
    }
    let guessed = guess_tables(files, tables);
    let told = |name: &String| {
        let table = guessed.iter().find(|table| table.map.file == *name);
        let Some(table) = table else {
            let is = files.source(name).and_then(|it| foreign_kind(it.as_ref()));
            let is = is.map_or_else(
                || "no table: fewer than two rows or columns, or no column of numbers".to_owned(),
                |is| format!("it is {}; {}", is.what, is.advice),
            );
            return format!("\n  {name}: {is}");
        };
        let is = files.source(name).and_then(|it| foreign_kind(it.as_ref()));
        if let Some(is) = is.filter(|_| !table.map.shape.has_header) {
            return format!("\n  {name}: it is {}; {}", is.what, is.advice);
        }
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

/// Words on the kind of the first of the named files that is of a known one, and what to do with it.
fn kind_within(files: &dyn FileSet, names: &[String]) -> String {
    let mut kinds = names.iter().take(NAMED).filter_map(|name| {
        let source = files.source(name)?;
        let is = foreign_kind(source.as_ref())?;
        Some(format!("; {name} is {}: {}", is.what, is.advice))
    });
    kinds.next().unwrap_or_default()
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

/// The flight of tables by the maps that people wrote, else as their columns are guessed; `None` of no flight's.
fn open_tables(
    files: &Arc<dyn FileSet>,
    names: &[String],
    maps: Option<Vec<ColumnMap>>,
) -> Result<Option<FlightFolder>, Box<dyn std::error::Error>> {
    let guessed = || -> Vec<ColumnMap> {
        let tables = guess_tables(files.as_ref(), names).into_iter();
        tables.filter(|t| t.is_proposed).map(|t| t.map).collect()
    };
    let maps = maps.unwrap_or_else(guessed);
    if maps.is_empty() {
        return Ok(None);
    }
    Ok(Some(flight_of_tables(files, &maps)?))
}

/// Column maps of tables that people wrote: in the file `columns`, or in one called [`pilotage_jobs::COLUMNS_FILE`] beside them. A
/// map of one table is taken for the only table, whatever that is called.
///
/// # Errors
/// A file that is not there or no column map, or maps of tables that are not there.
pub fn said(
    files: &dyn FileSet,
    names: &[String],
    columns: Option<&Path>,
) -> Result<Option<Vec<ColumnMap>>, String> {
    let Some(path) = columns else {
        return maps_beside(files, names);
    };
    let file = path.display().to_string();
    let text = std::fs::read(path).map_err(|e| format!("{file}: {e}"))?;
    let stated = StatedColumns::read(&file, &text, names)?;
    match stated.lost.first() {
        Some(table) => Err(format!("{file}: there is no table {table} among these")),
        None => Ok(Some(stated.maps).filter(|maps| !maps.is_empty())),
    }
}

/// Whether a file's name ends so.
pub fn has_ending(path: &Path, endings: &[&str]) -> bool {
    files::has_ending(&path.to_string_lossy(), endings)
}
