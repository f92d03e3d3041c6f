//! The flight among files, looked for by page and terminal in one order.

use std::sync::Arc;

use pilotage_core::flight::columns::{ColumnMap, flight_of_tables};
use pilotage_core::flight::files::{FileSet, has_ending, names_ending_in};
use pilotage_core::flight::gpmf::{FILMS, films_left_out, flight_of_film, read_gpmf};
use pilotage_core::flight::igc::{flight_of_record, is_igc, read_igc};
use pilotage_core::flight::nmea::{flight_of_sentences, is_nmea, read_nmea};
use pilotage_core::flight::photo::read_photos;
use pilotage_core::flight::srt::{flight_of_subtitles, read_srt};
use pilotage_core::flight::track_files::{flight_of_track, is_track, read_track};
use pilotage_core::flight::{FlightFolder, FolderError, read_flight};
use pilotage_core::imagery::ByteSource;

use super::log_flights::{head, log_among};
use super::photo_places::flight_of_tabled_photos;
use super::table_names::tables_among;

/// Files of a kind that may be a flight without saying so in a file beside them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FlownFiles {
    /// Words for them.
    pub words: &'static str,
    /// Endings of their names, without the dot.
    pub endings: &'static [&'static str],
}

/// Tracks, which say no more than where somebody was.
const TRACKS: FlownFiles = of_kind("tracks", &["plt", "tcx"]);

/// Endings of files of routes and landmarks, of which some have tracks with times.
const MAY_BE_TRACKS: [&str; 2] = ["gpx", "kml"];

/// Every kind of them, in the order in which people are told of them.
pub const FLOWN: [FlownFiles; 5] = [
    of_kind(
        "photos that say where they were taken",
        &["jpg", "jpeg", "png"],
    ),
    of_kind("subtitles of films", &["srt"]),
    of_kind("sentences of a receiver", &["nmea"]),
    of_kind("flight records of gliders", &["igc"]),
    TRACKS,
];

const fn of_kind(words: &'static str, endings: &'static [&'static str]) -> FlownFiles {
    FlownFiles { words, endings }
}

/// Files that may be a flight without saying so in a file beside them, in words, with the endings of their names.
///
/// ```
/// assert!(pilotage_jobs::flown_in_words().ends_with(", tracks (.plt, .tcx)"));
/// ```
pub fn flown_in_words() -> String {
    let kind = |kind: FlownFiles| format!("{} (.{})", kind.words, kind.endings.join(", ."));
    FLOWN.map(kind).join(", ")
}

/// The flight among files: that of tables whose columns somebody said the `maps` of, a flight folder, or what says itself
/// where it was: subtitles, sentences, photos, tracks, and films last. `None` beside tables that make a flight as their columns are
/// guessed where nothing but a film, or photos that tables without times place, says so too, and beside a log, which is read piece by piece and whose camera frames
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
        let flown = flight_of_tables(files, maps).map_err(told)?;
        return Ok(Some(with_films_told(flown, files.as_ref())));
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
    let has_no_track = has_none(TRACKS.endings) && has_none(&MAY_BE_TRACKS);
    let has_none_flown = has_no_track && FLOWN.iter().all(|kind| has_none(kind.endings));
    if has_none_flown && has_none(&FILMS) || log_among(files.as_ref()).is_some() {
        return Ok(None);
    }
    let mut flown = flight_of_subtitles(files).map_err(told)?;
    if flown.is_none() {
        flown = flight_of_sentences(files).map_err(told)?;
    }
    if flown.is_none() {
        flown = flight_of_record(files).map_err(told)?;
    }
    if let Some(mut flown) = flown.or_else(|| read_photos(files)) {
        let tracks = names_ending_in(files.as_ref(), TRACKS.endings).into_iter();
        let left_out = |name| format!("{name} is left out: other files beside it are the flight");
        flown.notes.extend(tracks.map(left_out));
        return Ok(Some(with_films_told(flown, files.as_ref())));
    }
    let tabled = flight_of_tabled_photos(files);
    if tabled.is_none() && has_no_track && has_none(&FILMS) {
        return Ok(None);
    }
    let tables = tables_among(files.as_ref());
    if tables.iter().any(|table| table.is_proposed) {
        return Ok(None);
    }
    if let Some(flown) = tabled {
        return Ok(Some(with_films_told(flown, files.as_ref())));
    }
    match flight_of_track(files).map_err(told) {
        Ok(Some(flown)) => return Ok(Some(with_films_told(flown, files.as_ref()))),
        Err(why) if tables.is_empty() && has_none(&FILMS) => return Err(why),
        // Other files may be the flight.
        Ok(None) | Err(_) => {}
    }
    if has_none(&FILMS) {
        return Ok(None);
    }
    match flight_of_film(files).map_err(told) {
        // Tables may be a flight as somebody says what their columns mean.
        Err(_) if !tables.is_empty() => Ok(None),
        other => other,
    }
}

/// A flight that was made of other files than films, with a note on each film among the files that holds places too.
pub fn with_films_told(mut flown: FlightFolder, files: &dyn FileSet) -> FlightFolder {
    flown.notes.extend(films_left_out(files));
    flown
}

/// The flight of one file that says itself where it was: subtitles of a film, a film of `GoPro`, or what a satellite receiver
/// or a glider's recorder said, which is known by its content, whatever its name. `None` of any other file.
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
    } else {
        match head(source) {
            Some(head) if is_nmea(&head) => read_nmea,
            Some(head) if is_igc(&head) => read_igc,
            Some(head) if is_track(&head) => read_track,
            _ => return Ok(None),
        }
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

    fn among(files: &[(&str, String)]) -> Result<Option<FlightFolder>, String> {
        let files: Vec<_> = (files.iter())
            .map(|(name, text)| ((*name).to_owned(), text.clone().into_bytes().into()))
            .collect();
        let pool = FilePool::new(&files, &LentFiles::default()).unwrap();
        let pool: Arc<dyn FileSet> = Arc::new(pool);
        flight_among(&pool, None)
    }

    #[test]
    fn a_track_of_gpx_is_the_flight_and_a_route_of_gpx_is_none() {
        let point = |i: u32, time: &str| {
            format!(
                "<trkpt lat=\"47.00{i}\" lon=\"8.5\"><time>2024-05-01T10:00:0{i}{time}</time></trkpt>"
            )
        };
        let of = |time: &str| {
            let points: String = (0..9).map(|i| point(i, time)).collect();
            (
                "walk.gpx",
                format!("<gpx version=\"1.1\"><trk><trkseg>{points}</trkseg></trk></gpx>"),
            )
        };
        let note = ("readme.txt", "the day of the flight".to_owned());
        for files in [vec![of("Z")], vec![of("Z"), note.clone()]] {
            let flown = among(&files).unwrap().unwrap();
            assert_eq!(flown.flight.truth.unwrap().states.len(), 9);
        }
        // Times that are none.
        for files in [vec![of(" or so")], vec![of(" or so"), note]] {
            assert!(among(&files).unwrap().is_none());
        }
    }

    #[test]
    fn a_watchs_track_is_the_flight_where_nothing_else_is() {
        let point = |second: u32, latitude: f64| {
            format!(
                "<Trackpoint><Time>2024-05-01T10:00:{second:02}Z</Time><Position><LatitudeDegrees>{latitude}</LatitudeDegrees>\
                 <LongitudeDegrees>8.5</LongitudeDegrees></Position></Trackpoint>"
            )
        };
        let (one, other) = (point(0, 47.0), point(10, 47.001));
        let track = format!("<TrainingCenterDatabase>{one}{other}</TrainingCenterDatabase>");
        let track = ("walk.tcx", track);
        let note = ("readme.txt", "the day of the flight".to_owned());
        let alone = among(&[track.clone(), note]).unwrap().unwrap();
        assert_eq!(alone.flight.truth.unwrap().states.len(), 2);
        let row = |i: i32| format!("{i},{},8.5,500,0,12", 47.0 + 1.1e-4 * f64::from(i));
        let rows = (0..40).map(row).collect::<Vec<_>>().join("\n");
        let table = format!("time [s],latitude,longitude,altitude,heading,airspeed\n{rows}");
        let table = ("flight.csv", table);
        let ozi = "OziExplorer Track Point File Version 2.1\nTokyo\n".to_owned();
        for beside in [track, ("old.plt", ozi)] {
            // The table, as its columns are guessed.
            assert!(among(&[table.clone(), beside]).unwrap().is_none());
        }
    }

    /// A film whose one track has places at these numbers of the same payload.
    fn film(fix: u32) -> Vec<u8> {
        let boxed = |kind: &[u8; 4], parts: &[&[u8]]| {
            let contents = parts.concat();
            [
                &(contents.len() as u32 + 8).to_be_bytes()[..],
                kind,
                &contents,
            ]
            .concat()
        };
        let words = |words: &[u32]| -> Vec<u8> {
            words.iter().flat_map(|word| word.to_be_bytes()).collect()
        };
        let piece = |key: &[u8; 4], kind: u8, size: u8, data: &[u8]| {
            let count = (data.len() / usize::from(size)) as u16;
            [&key[..], &[kind, size], &count.to_be_bytes(), data].concat()
        };
        let rows: Vec<u32> = (0..10)
            .flat_map(|i| [470_000_000 + 90 * i, 85_000_000, 520_000, 10_000, 1000])
            .collect();
        let stream = [
            piece(b"GPSF", b'L', 4, &words(&[fix])),
            piece(
                b"SCAL",
                b'l',
                4,
                &words(&[10_000_000, 10_000_000, 1000, 1000, 100]),
            ),
            piece(b"GPS5", b'l', 20, &words(&rows)),
        ];
        let payload = piece(b"DEVC", 0, 1, &piece(b"STRM", 0, 1, &stream.concat()));
        let head = boxed(b"ftyp", &[b"mp41"]);
        let at = head.len() as u32 + 8;
        let table = boxed(
            b"stbl",
            &[
                &boxed(b"stsd", &[&words(&[0, 1, 16]), b"gpmd", &[0; 8]]),
                &boxed(b"stts", &[&words(&[0, 1, 1, 1000])]),
                &boxed(b"stsc", &[&words(&[0, 1, 1, 1, 1])]),
                &boxed(b"stsz", &[&words(&[0, payload.len() as u32, 1])]),
                &boxed(b"stco", &[&words(&[0, 1, at])]),
            ],
        );
        let header = boxed(b"mdhd", &[&words(&[0, 0, 0, 1000, 0, 0])]);
        let media = boxed(b"mdia", &[&header, &boxed(b"minf", &[&table])]);
        let index = boxed(b"moov", &[&boxed(b"trak", &[&media])]);
        [head, boxed(b"mdat", &[&payload]), index].concat()
    }

    #[test]
    fn a_film_counts_last_and_is_told_where_something_else_tells_of_the_flight() {
        let among = |files: &[(&str, Vec<u8>)]| {
            let files = files.iter().cloned();
            let files: Vec<_> = files
                .map(|(name, bytes)| (name.to_owned(), bytes.into()))
                .collect();
            let pool = FilePool::new(&files, &LentFiles::default()).unwrap();
            let pool: Arc<dyn FileSet> = Arc::new(pool);
            flight_among(&pool, None)
        };
        let [sound, unfixed] = [3, 0].map(film);
        let said = ("run.nmea", SAID.as_bytes().to_vec());
        let rows = (0..40).map(|i| format!("{i},47.{:05},8.5,500\n", 10 * i));
        let rows: Vec<String> = rows.collect();
        let names = "time [s],latitude [deg],longitude [deg],altitude msl [m]\n".to_owned();
        let table = names + &rows.concat();
        let table = ("flight.csv", table.into_bytes());
        let notes = ("notes.csv", b"a,b\n1,2\n2,5\n3,1\n".to_vec());
        for film in [&sound, &unfixed] {
            let film = ("GX010001.MP4", film.clone());
            let flown = among(&[film.clone(), said.clone()]).unwrap().unwrap();
            assert_eq!(flown.flight.truth.unwrap().states.len(), 2);
            let told = flown.notes.iter().any(|note| note.contains("GX010001.MP4"));
            assert!(told, "{:?}", flown.notes);
            // The table is left to whoever guesses its columns.
            assert!(among(&[film.clone(), table.clone()]).unwrap().is_none());
        }
        let film = ("GX010001.MP4", sound);
        for files in [vec![film.clone()], vec![film, notes.clone()]] {
            let flown = among(&files).unwrap().unwrap();
            assert_eq!(flown.flight.truth.unwrap().states.len(), 10);
        }
        let film = ("GX010001.MP4", unfixed);
        let error = among(&[film.clone(), ("b.txt", b"x".to_vec())])
            .err()
            .unwrap();
        assert!(error.contains("10 places, none with a fix"), "{error}");
        assert!(among(&[film, notes]).unwrap().is_none());
    }
}
