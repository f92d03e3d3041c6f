//! The flight among files, looked for by page and terminal in one order.

use std::sync::Arc;

use pilotage_core::flight::columns::{ColumnMap, flight_of_tables};
use pilotage_core::flight::files::FileSet;
use pilotage_core::flight::gpmf::{FILMS, flight_of_film, read_gpmf};
use pilotage_core::flight::nmea::{flight_of_sentences, is_nmea, read_nmea};
use pilotage_core::flight::photo::read_photos;
use pilotage_core::flight::srt::{flight_of_subtitles, read_srt};
use pilotage_core::flight::{FlightFolder, FolderError, read_flight};
use pilotage_core::imagery::ByteSource;

use super::file_pool::{has_ending, names_ending_in};
use super::log_flights::{head, log_among};

/// Endings of files that may be a flight without saying so in a file beside them: photos, subtitles of films, and what a
/// satellite receiver said.
const FLOWN: [&str; 5] = ["jpg", "jpeg", "png", "srt", "nmea"];

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
    if let [only] = &files.names()[..]
        && let Some(source) = files.source(only)
        && let Some(flown) = flight_of_file(only, source.as_ref())?
    {
        return Ok(Some(flown));
    }
    let has_none = |endings: &[&str]| names_ending_in(files.as_ref(), endings).is_empty();
    if has_none(&FLOWN) && has_none(&FILMS) || log_among(files.as_ref()).is_some() {
        return Ok(None);
    }
    if let Some(filmed) = flight_of_subtitles(files).map_err(told)? {
        return Ok(Some(filmed));
    }
    if let Some(filmed) = flight_of_film(files).map_err(told)? {
        return Ok(Some(filmed));
    }
    let recorded = flight_of_sentences(files).map_err(told)?;
    Ok(recorded.or_else(|| read_photos(files)))
}

/// The flight of one file that says itself where it was: subtitles of a film, a film of `GoPro`, or what a satellite receiver
/// said, which is known by its content, whatever its name. `None` of any other file.
///
/// ```
/// use pilotage_core::imagery::MemoryBytes;
/// use pilotage_jobs::flight_of_file;
///
/// // Two sentences of a receiver, a second and 0.006' of latitude (11.1 m) apart.
/// let text = "$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,\n\
///             $GPGGA,123520,4807.044,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,\n";
/// let source = MemoryBytes::new("walk.txt", text.as_bytes());
/// let folder = flight_of_file("walk.txt", &source)?.ok_or("no flight")?;
/// let states = folder.flight.truth.as_ref().map(|truth| &truth.states[..]).unwrap_or_default();
/// assert!(((states[1].position - states[0].position).norm() - 11.1).abs() < 0.05);
/// assert!(flight_of_file("notes.txt", &MemoryBytes::new("notes.txt", &b"a word"[..]))?.is_none());
/// # Ok::<(), String>(())
/// ```
///
/// # Errors
/// A file of these that cannot be read, or that tells of no flight, in words.
pub fn flight_of_file(name: &str, source: &dyn ByteSource) -> Result<Option<FlightFolder>, String> {
    if has_ending(name, &FILMS) {
        return read_gpmf(name, source).map_err(|cause| cause.to_string());
    }
    let read = if has_ending(name, &["srt"]) {
        read_srt
    } else if head(source).is_some_and(|head| is_nmea(&head)) {
        read_nmea
    } else {
        return Ok(None);
    };
    let bytes = source.read(0, source.length() as usize)?;
    read(name, &bytes).map_err(|cause| cause.to_string())
}

#[cfg(test)]
mod tests {
    use super::super::LentFiles;
    use super::super::file_pool::FilePool;
    use super::*;

    const SAID: &str = "$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,\n\
                        $GPGGA,123520,4807.044,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,\n";

    #[test]
    fn what_a_receiver_said_is_a_flight_under_any_name_and_other_text_is_none() {
        let among = |name: &str, text: &str| {
            let files = [(name.to_owned(), text.as_bytes().to_vec().into())];
            let pool = FilePool::new(&files, &LentFiles::default()).unwrap();
            let pool: Arc<dyn FileSet> = Arc::new(pool);
            flight_among(&pool, None).unwrap()
        };
        for name in ["walk.nmea", "walk.txt", "walk"] {
            let truth = among(name, SAID).unwrap().flight.truth.unwrap();
            assert_eq!(truth.states.len(), 2, "{name}");
        }
        assert!(among("walk.txt", "dear diary, today").is_none());
    }
}
