//! Places in the films of `GoPro` (GPMF), as a flight at the times of the film.
//!
//! A track of the film (`gpmd`) has a payload a second, of nested pieces: key, type, size, number, data, filled up to four
//! bytes (<https://github.com/gopro/gpmf-parser>). Of its streams `GPS9` (each place with its fix) and `GPS5` (one fix for all)
//! tell places.

use std::sync::Arc;

use crate::folder::{FlightFolder, FolderError};
use crate::srt::with_frames_of_film;
use crate::text_tables::{flight_of_table, table};
use pilotage_base::bytes::ByteSource;
use pilotage_base::files::{FileSet, names_ending_in};
use pilotage_base::text::by_count;

/// Endings of films.
pub const FILMS: [&str; 3] = ["mp4", "mov", "360"];
/// Longest index of a film that is read, bytes.
const LONGEST: u64 = 1 << 26;
/// Longest payload, bytes.
const LONGEST_PAYLOAD: u64 = 1 << 22;
/// Most payloads of a film: one is a second.
const MOST: u64 = 1 << 20;
/// Kinds of fix from which on a place counts.
const FLAT_FIX: f64 = 2.0;
/// Most places of a film.
const MOST_PLACES: usize = 1 << 22;

/// Place at a second of the film.
type FilmedRow = (f64, [Option<f64>; 4]);

/// Offset and length in bytes, time and duration in seconds.
type FilmedPayload = (u64, u64, f64, f64);

/// Places of either stream, and those without a fix.
#[derive(Default)]
struct FilmedPlaces {
    rows: Vec<FilmedRow>,
    unfixed: usize,
    heights: FilmedHeights,
}

/// Surface from which heights are counted, as a stream says.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
enum FilmedHeights {
    /// It does not say.
    #[default]
    Unstated,
    /// Mean sea level.
    Sea,
    /// Ellipsoid of WGS 84.
    Ellipsoid,
}

/// The flight of the first film among `files` that tells where it was taken, with the frames of the film beside it; `None` if
/// there is none.
///
/// # Errors
/// Places of which no flight can be made, or a table of frames that cannot be read.
pub fn flight_of_film(files: &Arc<dyn FileSet>) -> Result<Option<FlightFolder>, FolderError> {
    let (mut found, mut failed): (Option<FlightFolder>, Option<FolderError>) = (None, None);
    for name in names_ending_in(files.as_ref(), &FILMS) {
        let Some(film) = files.source(&name) else {
            continue;
        };
        if let Some(first) = &mut found {
            if has_places(film.as_ref()) {
                let note = format!("{name} was left out: it is a film of its own");
                first.notes.push(note);
            }
            continue;
        }
        match of_film(&name, film.as_ref()) {
            Ok(Some((folder, begins))) => {
                found = Some(with_frames_of_film(&name, folder, begins, files)?);
            }
            Ok(None) => {}
            Err(cause) => failed = failed.or(Some(cause)),
        }
    }
    match (found, failed) {
        (Some(mut found), failed) => {
            found.notes.extend(failed.map(|cause| cause.to_string()));
            Ok(Some(found))
        }
        (None, Some(cause)) => Err(cause),
        (None, None) => Ok(None),
    }
}

/// Sentences about the films among `files` that hold places, where a flight was made of other files.
pub fn films_left_out(files: &dyn FileSet) -> Vec<String> {
    let mut names = names_ending_in(files, &FILMS);
    names.retain(|name| {
        let film = files.source(name);
        film.is_some_and(|film| has_places(film.as_ref()))
    });
    let told = |name: String| {
        format!(
            "the places in {name} were left out: other files tell of a flight; open it alone for them"
        )
    };
    names.into_iter().map(told).collect()
}

/// Whether a film has a track of places, by its index alone.
fn has_places(film: &dyn ByteSource) -> bool {
    let samples = index_of(film).and_then(|index| track_of(&index));
    samples.is_some_and(|samples| !samples.is_empty())
}

/// The flight that a film tells of; `None` if it has no such track.
///
/// # Errors
/// Places of which no flight can be made, as the tables of a flight; places without a fix; a film that is cut off before its
/// index.
pub fn read_gpmf(name: &str, film: &dyn ByteSource) -> Result<Option<FlightFolder>, FolderError> {
    Ok(of_film(name, film)?.map(|(folder, _)| folder))
}

/// That flight, and the second of the film at which it begins.
fn of_film(name: &str, film: &dyn ByteSource) -> Result<Option<(FlightFolder, f64)>, FolderError> {
    let broken = |cause: String| FolderError::File {
        file: name.to_owned(),
        cause,
    };
    let Some((places, is_cut)) = places_of(film) else {
        if is_cut_off(film) {
            let told = "the film is cut off before the index at its end: copy it again";
            return Err(broken(told.to_owned()));
        }
        return Ok(None);
    };
    let Some((begins, _)) = places.rows.first().filter(|_| places.rows.len() > 1) else {
        return match (places.unfixed, places.rows.len()) {
            (0, _) => Ok(None),
            (count, 0) => Err(broken(format!(
                "{count} {}, none with a fix",
                by_count(count, "place", "places")
            ))),
            (count, _) => Err(broken(format!("{} places, one with a fix", count + 1))),
        };
    };
    let mut notes = vec!["times are those of the film".to_owned()];
    if places.unfixed > 0 {
        notes.push(format!(
            "{} {} left out",
            places.unfixed,
            by_count(
                places.unfixed,
                "place without a fix was",
                "places without a fix were"
            )
        ));
    }
    if is_cut {
        notes.push("the film is cut off or damaged: its last places cannot be read".to_owned());
    }
    let height = match places.heights {
        FilmedHeights::Unstated => "altitude [m]",
        FilmedHeights::Sea => "altitude msl [m]",
        FilmedHeights::Ellipsoid => "ellipsoid height [m]",
    };
    // Latitude, longitude, height and speed are the first numbers of either stream.
    let columns = [
        "latitude [deg]",
        "longitude [deg]",
        height,
        "speed over ground [m/s]",
    ];
    let rows = places.rows.iter();
    let rows: Vec<_> = rows
        .map(|(time, row)| (format!("{time:.3}"), *row))
        .collect();
    let folder = flight_of_table(name, table("time [s]", columns, &rows), notes)?;
    Ok(folder.map(|folder| (folder, *begins)))
}

/// The places of a film, and whether it ends before its last; `None` if it has no track of such.
fn places_of(film: &dyn ByteSource) -> Option<(FilmedPlaces, bool)> {
    let samples = track_of(&index_of(film)?)?;
    let [mut each, mut together] = [FilmedPlaces::default(), FilmedPlaces::default()];
    let mut is_cut = false;
    // An index can name the same bytes many times.
    let mut unread = film.length();
    for (offset, length, time, duration) in samples {
        let left = unread.checked_sub(length);
        let is_short = each.count() + together.count() < MOST_PLACES;
        let payload = left
            .filter(|_| is_short)
            .and_then(|_| read(film, offset, length));
        let (Some(payload), Some(left)) = (payload, left) else {
            is_cut = true;
            break;
        };
        unread = left;
        let streams = pieces(&payload).filter(|piece| piece.key == b"DEVC");
        let streams = streams.flat_map(|device| pieces(device.data));
        for stream in streams.filter(|piece| piece.key == b"STRM") {
            take_stream(stream.data, (time, duration), &mut each, &mut together);
        }
    }
    let has_each = !each.rows.is_empty() || together.rows.is_empty() && each.unfixed > 0;
    Some((if has_each { each } else { together }, is_cut))
}

impl FilmedPlaces {
    /// Number of places, with and without a fix.
    fn count(&self) -> usize {
        self.rows.len() + self.unfixed
    }
}

/// Payloads of the track of an index that tells places.
fn track_of(index: &[u8]) -> Option<Vec<FilmedPayload>> {
    let mut tracks = boxes(index).filter(|(kind, _)| *kind == b"trak");
    tracks.find_map(|(_, track)| samples_of(track))
}

/// So many bytes of a film; `None` where it does not reach so far.
fn read(film: &dyn ByteSource, offset: u64, length: u64) -> Option<Vec<u8>> {
    let is_there = offset.checked_add(length)? <= film.length();
    is_there.then(|| film.read(offset, length as usize).ok())?
}

/// A number of four bytes, the largest first.
fn whole(bytes: &[u8], at: usize) -> Option<u64> {
    let bytes = bytes.get(at..)?.first_chunk()?;
    Some(u64::from(u32::from_be_bytes(*bytes)))
}

/// The same of eight bytes.
fn long(bytes: &[u8], at: usize) -> Option<u64> {
    Some(u64::from_be_bytes(*bytes.get(at..)?.first_chunk()?))
}

/// Beginning of a box of a film.
struct BoxHead {
    kind: [u8; 4],
    /// Bytes of the whole box; all there are for one that goes on up to the end.
    size: u64,
    /// Bytes before its contents.
    before: u64,
}

/// The beginning of the box at an offset; `None` where the film ends before.
fn head_at(film: &dyn ByteSource, at: u64) -> Option<BoxHead> {
    let head = read(film, at, 16)?;
    let (size, before) = match whole(&head, 0)? {
        0 => (u64::MAX, 8),
        1 => (long(&head, 8)?, 16),
        size => (size, 8),
    };
    let kind = *head.get(4..)?.first_chunk()?;
    Some(BoxHead { kind, size, before })
}

/// The contents of the box that tells what is where in a film.
fn index_of(film: &dyn ByteSource) -> Option<Vec<u8>> {
    let mut at = 0;
    loop {
        let head = head_at(film, at)?;
        let length = head.size.checked_sub(head.before)?;
        match &head.kind {
            b"moov" if length > LONGEST => return None,
            b"moov" => return read(film, at + head.before, length),
            kind if at == 0 && kind != b"ftyp" => return None,
            _ => at = at.checked_add(head.size)?,
        }
    }
}

/// Whether a film ends before its index does.
fn is_cut_off(film: &dyn ByteSource) -> bool {
    let mut at = 0;
    while at < film.length() {
        let Some(BoxHead { kind, size, .. }) = head_at(film, at) else {
            return at > 0;
        };
        let Some(next) = at.checked_add(size).filter(|_| size >= 8) else {
            return at > 0 && &kind == b"mdat";
        };
        if at == 0 && &kind != b"ftyp" || &kind == b"moov" && next <= film.length() {
            return false;
        }
        if next > film.length() {
            return at > 0 && [b"mdat", b"moov", b"free", b"wide"].contains(&&kind);
        }
        at = next;
    }
    false
}

/// Kinds and contents of boxes one after the other.
fn boxes(bytes: &[u8]) -> impl Iterator<Item = (&[u8], &[u8])> {
    let mut rest = bytes;
    std::iter::from_fn(move || {
        let size = whole(rest, 0)? as usize;
        let found = (rest.get(4..8)?, rest.get(8..size)?);
        rest = &rest[size..];
        Some(found)
    })
}

/// The contents of the box at the end of a path.
fn inside<'a>(bytes: &'a [u8], path: &[&[u8; 4]]) -> Option<&'a [u8]> {
    path.iter().try_fold(bytes, |bytes, kind| {
        let found = boxes(bytes).find(|(found, _)| found == kind);
        found.map(|(_, contents)| contents)
    })
}

/// Offset, length, time and duration in seconds of the payloads of a track; `None` if it is another.
fn samples_of(track: &[u8]) -> Option<Vec<FilmedPayload>> {
    let media = inside(track, &[b"mdia"])?;
    let table = inside(media, &[b"minf", b"stbl"])?;
    if inside(table, &[b"stsd"])?.get(12..16)? != b"gpmd" {
        return None;
    }
    let header = inside(media, &[b"mdhd"])?;
    let is_long = header.first()? == &1;
    let per_second = whole(header, if is_long { 20 } else { 12 })?.max(1) as f64;
    let sizes = inside(table, &[b"stsz"])?;
    let size = |sample: usize| match whole(sizes, 4)? {
        0 => whole(sizes, 12 + 4 * sample),
        size => Some(size),
    };
    let chunk = |index: usize| match inside(table, &[b"stco"]) {
        Some(chunks) => whole(chunks, 8 + 4 * index),
        None => long(inside(table, &[b"co64"])?, 8 + 8 * index),
    };
    let counts = inside(table, &[b"stsc"])?;
    let durations = inside(table, &[b"stts"])?;
    let mut lasting = (8..durations.len()).step_by(8).flat_map(|run| {
        let [count, ticks] = [run, run + 4].map(|at| whole(durations, at).unwrap_or(0));
        std::iter::repeat_n(ticks, count as usize)
    });
    let total = whole(sizes, 8)?.min(MOST) as usize;
    let (mut samples, mut ticks, mut run) = (Vec::new(), 0, 8);
    for index in 0..total {
        let Some(mut offset) = chunk(index) else {
            break;
        };
        // The last run that begins at the chunk, counted from one, or before it.
        while whole(counts, run + 12).is_some_and(|first| first <= index as u64 + 1) {
            run += 12;
        }
        for _ in 0..whole(counts, run + 4)? {
            let next = size(samples.len()).filter(|_| samples.len() < total);
            let Some((length, lasts)) = next.zip(lasting.next()) else {
                return Some(samples);
            };
            if length > LONGEST_PAYLOAD {
                return Some(samples);
            }
            let [time, duration] = [ticks, lasts].map(|ticks| ticks as f64 / per_second);
            samples.push((offset, length, time, duration));
            offset = offset.saturating_add(length);
            ticks += lasts;
        }
    }
    Some(samples)
}

/// A piece of a payload.
struct GpmfPiece<'a> {
    key: &'a [u8],
    kind: u8,
    size: usize,
    data: &'a [u8],
}

/// The pieces one after the other; ends before what is cut off.
fn pieces(bytes: &[u8]) -> impl Iterator<Item = GpmfPiece<'_>> {
    let mut rest = bytes;
    std::iter::from_fn(move || {
        let head: &[u8; 8] = rest.first_chunk()?;
        let (size, count) = (usize::from(head[5]), u16::from_be_bytes([head[6], head[7]]));
        let length = size * usize::from(count);
        let piece = GpmfPiece {
            key: rest.get(..4)?,
            kind: head[4],
            size,
            data: rest.get(8..8 + length)?,
        };
        rest = rest
            .get(8 + length.next_multiple_of(4)..)
            .unwrap_or_default();
        Some(piece)
    })
}

/// Numbers of these types (one letter each) one after the other; those of other types are none.
fn numbers(kinds: &[u8], data: &[u8]) -> Vec<f64> {
    let mut rest = data;
    let number = |kind: &u8| {
        let size = match kind {
            b'b' | b'B' => 1,
            b's' | b'S' => 2,
            b'l' | b'L' | b'f' => 4,
            _ => 8,
        };
        let (bytes, behind) = rest.split_at_checked(size)?;
        rest = behind;
        let raw = bytes
            .iter()
            .fold(0_u64, |all, byte| all << 8 | u64::from(*byte));
        Some(match kind {
            b'b' => f64::from((raw as u8).cast_signed()),
            b's' => f64::from((raw as u16).cast_signed()),
            b'l' => f64::from((raw as u32).cast_signed()),
            b'f' => f64::from(f32::from_bits(raw as u32)),
            b'd' => f64::from_bits(raw),
            b'B' | b'S' | b'L' | b'J' => raw as f64,
            _ => f64::NAN,
        })
    };
    kinds.iter().map_while(number).collect()
}

/// Takes the places of a stream of a payload that begins at a time and has a duration, seconds.
fn take_stream(
    stream: &[u8],
    (time, duration): (f64, f64),
    each: &mut FilmedPlaces,
    together: &mut FilmedPlaces,
) {
    let (mut scales, mut kinds, mut fix) = (vec![1.0], Vec::new(), f64::INFINITY);
    let mut heights = FilmedHeights::Unstated;
    for piece in pieces(stream) {
        let of_one_kind = || {
            let count = piece.data.len() / piece.size.max(1);
            numbers(&vec![piece.kind; count], piece.data)
        };
        match piece.key {
            b"SCAL" => scales = of_one_kind(),
            b"TYPE" => kinds = piece.data.to_vec(),
            b"GPSF" => fix = of_one_kind().first().copied().unwrap_or(0.0),
            b"GPSA" if piece.data.starts_with(b"WGS") => heights = FilmedHeights::Ellipsoid,
            b"GPSA" if piece.data.starts_with(b"MSL") => heights = FilmedHeights::Sea,
            b"GPS5" | b"GPS9" if piece.size > 0 => {
                let is_each = piece.key == b"GPS9";
                let places = if is_each { &mut *each } else { &mut *together };
                if heights != FilmedHeights::Unstated {
                    places.heights = heights;
                }
                let kinds = if is_each { kinds.as_slice() } else { b"lllll" };
                let rows = piece.data.chunks_exact(piece.size);
                let step = duration / rows.len().max(1) as f64;
                for (index, row) in rows.enumerate() {
                    let raw = numbers(kinds, row);
                    let value = |at: usize| {
                        let scale = scales.get(at).or(scales.first())?;
                        Some(raw.get(at)? / scale).filter(|value| value.is_finite())
                    };
                    let fix = if is_each {
                        value(8).unwrap_or(0.0)
                    } else {
                        fix
                    };
                    let values = [0, 1, 2, 3].map(value);
                    let is_place = values[..2].iter().all(Option::is_some)
                        && values[..2] != [Some(0.0), Some(0.0)];
                    if fix >= FLAT_FIX && is_place {
                        places.rows.push((time + step * index as f64, values));
                    } else {
                        places.unfixed += 1;
                    }
                }
            }
            _ => {}
        }
    }
}

#[cfg(test)]
#[path = "gpmf_tests.rs"]
mod tests;
