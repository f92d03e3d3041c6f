//! Logs among dropped files, and the flights that they tell of.

use std::sync::Arc;

use pilotage_core::flight::beside_log::add_pictures;
use pilotage_core::flight::files::FileSet;
use pilotage_core::flight::foreign::{Foreign, foreign_file};
use pilotage_core::flight::interpret::{BesideFlight, Interpreted, flight_from_log};
use pilotage_core::flight::log::{HEAD, Log, read_log, recognise};
use pilotage_core::flight::overview::{Overview, overview};
use pilotage_core::flight::photo::add_photos;
use pilotage_core::flight::{Flight, NoPictures};
use pilotage_core::imagery::ByteSource;

use super::flights::{KeptFrames, OpenFlight};
use super::vehicle::choose_vehicle;

/// The first log among files, by what is in it.
///
/// ```
/// use pilotage_core::flight::files::MemoryFiles;
/// use pilotage_jobs::log_among;
///
/// let file = |(name, bytes): (&str, &[u8])| (name.to_owned(), bytes.to_vec());
/// let files = [("a.ulg", &b"a word"[..]), ("flight.dat", &b"ULog\x01\x12\x35\x01"[..])].map(file);
/// // By its first bytes, whatever it is called.
/// assert_eq!(log_among(&MemoryFiles(files.into())).as_deref(), Some("flight.dat"));
/// ```
pub fn log_among(pool: &dyn FileSet) -> Option<String> {
    let mut names = pool.names();
    names.sort();
    names.into_iter().find(|name| {
        let head = pool.source(name).and_then(|source| head(source.as_ref()));
        head.is_some_and(|head| recognise(&head).is_some())
    })
}

/// The first bytes of a file, in which a log says what it is.
pub fn head(source: &dyn ByteSource) -> Option<Vec<u8>> {
    let length = HEAD.min(source.length() as usize);
    source.read(0, length).ok()
}

/// The kind of a file of another program that is not read, by its first bytes.
pub fn foreign_kind(source: &dyn ByteSource) -> Option<Foreign> {
    foreign_file(source)
}

/// A flight with the pictures that lie beside its log, why it has none of them, and what was assumed of photos or why
/// they are none of it.
fn with_pictures(
    log: &Log,
    mut flight: Flight,
    files: &Arc<dyn FileSet>,
) -> (OpenFlight, Option<String>, Vec<String>) {
    let open = |flight: Flight, source| OpenFlight {
        utc_at_zero: log.utc_at_zero,
        frames: KeptFrames::stored(&flight, source),
        flight: Arc::new(flight),
        mission: None,
    };
    match add_pictures(&mut flight, files) {
        Ok(Some(found)) => (open(flight, found.frames), None, found.notes),
        Ok(None) => {
            let placed = add_photos(log, &mut flight, files);
            let (source, notes) = placed.map_or((None, Vec::new()), |p| (p.frames, p.notes));
            let open = match source {
                Some(source) => open(flight, source),
                None => open(flight, Box::new(NoPictures)),
            };
            (open, None, notes)
        }
        Err(cause) => (
            open(flight, Box::new(NoPictures)),
            Some(cause.to_string()),
            Vec::new(),
        ),
    }
}

/// A log at a glance, and the flight that it tells of.
pub struct LogGlance {
    /// Contents of the log, with the pictures beside it.
    pub overview: Overview,
    /// The flight with its pictures, or why the log tells of none, in words.
    pub flight: Result<OpenFlight, String>,
    /// Reason why the pictures beside the log are left out, if they are.
    pub lost_pictures: Option<String>,
}

impl LogGlance {
    /// A log as it was `interpreted`, and the pictures beside it among `files`.
    pub fn of(log: &Log, interpreted: Interpreted, files: &Arc<dyn FileSet>) -> Self {
        let mut overview = overview(log, &interpreted.measured());
        let flight = interpreted.into_flight().map_err(|why| why.to_string());
        let mut lost_pictures = None;
        let flight = flight.map(|flight| {
            let (open, lost, notes) = with_pictures(log, flight, files);
            overview.add_pictures(open.flight.frames.len());
            overview.note_photos(&notes);
            lost_pictures = lost;
            open
        });
        Self {
            overview,
            flight,
            lost_pictures,
        }
    }
}

/// The log of a flight of tables or photos at a glance.
pub fn glance_at_folder(log: &Log, beside: &BesideFlight, flight: &Flight) -> Overview {
    let mut overview = overview(log, &beside.measured());
    overview.add_pictures(flight.frames.len());
    overview
}

/// The flight that a log tells of, with the pictures that lie beside it among `files`, why it has none of them, and what was
/// assumed of photos.
///
/// # Errors
/// A log that tells of no flight, in words.
pub fn open_log(
    log: &Log,
    files: &Arc<dyn FileSet>,
) -> Result<(OpenFlight, Option<String>, Vec<String>), String> {
    let flight = flight_from_log(log).into_flight();
    let flight = flight.map_err(|cause| cause.to_string())?;
    Ok(with_pictures(log, flight, files))
}

/// The flight that the log among the files tells of; reads all of it at once.
pub fn flight_of_log(pool: &Arc<dyn FileSet>) -> Result<Option<OpenFlight>, String> {
    let Some(file) = log_among(pool.as_ref()) else {
        return Ok(None);
    };
    let source = pool.source(&file).ok_or("the log is gone")?;
    let blame = |cause: String| format!("{file}: {cause}");
    let Some(mut log) = read_log(source.as_ref()).map_err(blame)? else {
        return Ok(None);
    };
    choose_vehicle(pool.as_ref(), &mut log)?;
    Ok(Some(open_log(&log, pool)?.0))
}
