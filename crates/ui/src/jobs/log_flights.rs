//! Logs among dropped files, and the flights that they tell of.

use std::sync::Arc;

use pilotage_core::flight::Flight;
use pilotage_core::flight::beside_log::add_pictures;
use pilotage_core::flight::files::FileSet;
use pilotage_core::flight::interpret::flight_from_log;
use pilotage_core::flight::log::{HEAD, read_log, recognise};
use pilotage_core::imagery::ByteSource;

use super::file_pool::FilePool;
use super::flights::{KeptFrames, OpenFlight};

/// The first log among files, by what is in it.
pub fn log_among(pool: &FilePool) -> Option<String> {
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

/// A flight with the pictures that lie beside its log, or why it has none of them.
pub fn with_pictures(mut flight: Flight, pool: Arc<FilePool>) -> (OpenFlight, Option<String>) {
    let files: Arc<dyn FileSet> = pool;
    match add_pictures(&mut flight, &files) {
        Ok(Some(source)) => {
            let frames = KeptFrames::stored(&flight, source);
            let flight = Arc::new(flight);
            let open = OpenFlight {
                flight,
                frames,
                mission: None,
            };
            (open, None)
        }
        Ok(None) => (OpenFlight::without_pictures(flight), None),
        Err(cause) => (
            OpenFlight::without_pictures(flight),
            Some(cause.to_string()),
        ),
    }
}

/// The flight that the log among the files tells of; reads all of it at once.
pub fn flight_of_log(pool: &Arc<FilePool>) -> Result<Option<OpenFlight>, String> {
    let Some(file) = log_among(pool) else {
        return Ok(None);
    };
    let source = pool.source(&file).ok_or("the log is gone")?;
    let blame = |cause: String| format!("{file}: {cause}");
    let Some(log) = read_log(source.as_ref()).map_err(blame)? else {
        return Ok(None);
    };
    let flight = flight_from_log(&log).into_flight();
    let flight = flight.map_err(|cause| cause.to_string())?;
    Ok(Some(with_pictures(flight, pool.clone()).0))
}
