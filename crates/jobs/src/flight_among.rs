//! The flight among files, looked for by page and terminal in one order.

use std::sync::Arc;

use pilotage_core::flight::columns::{ColumnMap, flight_of_tables};
use pilotage_core::flight::files::FileSet;
use pilotage_core::flight::nmea::flight_of_sentences;
use pilotage_core::flight::photo::read_photos;
use pilotage_core::flight::srt::flight_of_subtitles;
use pilotage_core::flight::{FlightFolder, FolderError, read_flight};

use super::file_pool::names_ending_in;
use super::log_flights::log_among;

/// Endings of files that may be a flight without saying so in a file beside them: photos, subtitles of films, and what a
/// satellite receiver said.
const FLOWN: [&str; 4] = ["jpg", "jpeg", "srt", "nmea"];

/// The flight among files: that of tables whose columns somebody said the `maps` of, a flight folder, or what says itself
/// where it was: subtitles, sentences, photos. `None` beside a log, which is read piece by piece and whose camera frames
/// photos are.
///
/// # Errors
/// Files of a flight that cannot be read, in words.
pub fn flight_among(
    files: &Arc<dyn FileSet>,
    maps: Option<&[ColumnMap]>,
) -> Result<Option<FlightFolder>, String> {
    let told = |cause: FolderError| cause.to_string();
    if let Some(maps) = maps {
        return flight_of_tables(files, maps).map(Some).map_err(told);
    }
    match read_flight(Arc::clone(files)) {
        Err(FolderError::NoFlightFile) => {}
        other => return other.map(Some).map_err(told),
    }
    if names_ending_in(files.as_ref(), &FLOWN).is_empty() || log_among(files.as_ref()).is_some() {
        return Ok(None);
    }
    if let Some(filmed) = flight_of_subtitles(files).map_err(told)? {
        return Ok(Some(filmed));
    }
    let recorded = flight_of_sentences(files).map_err(told)?;
    Ok(recorded.or_else(|| read_photos(files)))
}
