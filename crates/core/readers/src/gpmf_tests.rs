//! Films made here, box by box.

use pilotage_base::bytes::MemoryBytes;
use pilotage_base::files::MemoryFiles;

use super::*;

fn boxed(kind: [u8; 4], parts: &[&[u8]]) -> Vec<u8> {
    let contents = parts.concat();
    let size = (contents.len() as u32 + 8).to_be_bytes();
    [&size[..], &kind, &contents].concat()
}

fn words(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_be_bytes()).collect()
}

fn piece(key: [u8; 4], kind: u8, size: u8, data: &[u8]) -> Vec<u8> {
    let count = (data.len() / usize::from(size)) as u16;
    let mut bytes = [&key[..], &[kind, size], &count.to_be_bytes(), data].concat();
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    bytes
}

fn signed(numbers: &[i32]) -> Vec<u8> {
    numbers.iter().flat_map(|n| n.to_be_bytes()).collect()
}

/// A second of ten places southward from 33.5° S, 70.5° W at 10 m/s, beginning with the one of that number.
fn payload(first: i32, fix: u32, is_each: bool) -> Vec<u8> {
    let mut rows = Vec::new();
    for i in first..first + 10 {
        rows.extend(signed(&[
            -335_000_000 - 90 * i,
            -705_000_000,
            520_000 + i,
            10_000,
        ]));
        if is_each {
            rows.extend(signed(&[1000, 9000, 0]));
            rows.extend([0, 150, 0, fix as u8]);
        } else {
            rows.extend(signed(&[1000]));
        }
    }
    let tens = [10_000_000, 10_000_000, 1000, 1000, 100, 1, 1000, 100, 1];
    let stream = if is_each {
        [
            piece(*b"SCAL", b'l', 4, &signed(&tens)),
            piece(*b"TYPE", b'c', 9, b"lllllllSS"),
            piece(*b"GPS9", b'?', 32, &rows),
        ]
        .concat()
    } else {
        [
            piece(*b"GPSF", b'L', 4, &words(&[fix])),
            piece(*b"GPSU", b'c', 16, b"240501100000.000"),
            piece(*b"SCAL", b'l', 4, &signed(&tens[..5])),
            piece(*b"GPS5", b'l', 20, &rows),
        ]
        .concat()
    };
    let other = piece(*b"STRM", 0, 1, &piece(*b"ACCL", b's', 6, &[0; 60]));
    let stream = [other, piece(*b"STRM", 0, 1, &stream)].concat();
    piece(*b"DEVC", 0, 1, &stream)
}

/// A film of these payloads, of 1.001 s each, two in a chunk.
fn film(payloads: &[Vec<u8>]) -> Vec<u8> {
    film_that_names(payloads, 1)
}

/// The same, whose index names all of them so many times.
fn film_that_names(payloads: &[Vec<u8>], times: usize) -> Vec<u8> {
    let head = boxed(*b"ftyp", &[b"mp41"]);
    let mut media = Vec::new();
    let mut chunks = Vec::new();
    for (index, payload) in payloads.iter().enumerate() {
        if index % 2 == 0 {
            media.extend([7; 5]);
            chunks.push((head.len() + 8 + media.len()) as u32);
        }
        media.extend(payload);
    }
    let count = (payloads.len() * times) as u32;
    let sizes: Vec<u32> = payloads.iter().map(|p| p.len() as u32).collect();
    let (sizes, chunks) = (sizes.repeat(times), chunks.repeat(times));
    let table = boxed(
        *b"stbl",
        &[
            &boxed(*b"stsd", &[&words(&[0, 1, 16]), b"gpmd", &[0; 8]]),
            &boxed(*b"stts", &[&words(&[0, 1, count, 1001])]),
            &boxed(*b"stsc", &[&words(&[0, 1, 1, 2, 1])]),
            &boxed(*b"stsz", &[&words(&[0, 0, count]), &words(&sizes)]),
            &boxed(
                *b"stco",
                &[&words(&[0, chunks.len() as u32]), &words(&chunks)],
            ),
        ],
    );
    let header = boxed(*b"mdhd", &[&words(&[0, 0, 0, 1000, 0, 0])]);
    let track = boxed(
        *b"trak",
        &[&boxed(*b"mdia", &[&header, &boxed(*b"minf", &[&table])])],
    );
    let index = boxed(
        *b"moov",
        &[&boxed(*b"trak", &[&boxed(*b"mdia", &[])]), &track],
    );
    [head, boxed(*b"mdat", &[&media]), index].concat()
}

#[test]
fn places_of_either_stream_are_a_flight_at_the_times_of_the_film() {
    for is_each in [false, true] {
        let payloads: Vec<_> = (0..5)
            .map(|i| payload(10 * i, if i == 0 { 0 } else { 3 }, is_each))
            .collect();
        let bytes = film(&payloads);
        let files: Arc<dyn FileSet> =
            Arc::new(MemoryFiles([("GX01.MP4".to_owned(), bytes)].into()));
        let folder = flight_of_film(&files).unwrap().unwrap();
        let states = &folder.flight.truth.as_ref().unwrap().states;
        assert_eq!(states.len(), 40, "{is_each}");
        let origin = folder.flight.frame_on_globe.unwrap().origin;
        assert!((origin.latitude.to_degrees() + 33.500_09).abs() < 1e-9);
        assert!((origin.longitude.to_degrees() + 70.5).abs() < 1e-9);
        let log = folder.log();
        let heights = log.topics[0].values("altitude [m]").unwrap();
        assert!((heights[39] - 520.049).abs() < 1e-6, "{heights:?}");
        // The second payload begins at 1.001 s.
        assert!((states[39].time - states[0].time - (3.9 * 1.001)).abs() < 2e-3);
        let north = states[39].position.x - states[0].position.x;
        assert!((north + 39.0 * 0.998).abs() < 0.1, "{north}");
        assert!(
            folder
                .notes
                .iter()
                .any(|note| note.contains("10 places without a fix")),
            "{:?}",
            folder.notes
        );
    }
}

#[test]
fn films_without_places_are_none_and_damaged_ones_never_panic() {
    let read = |bytes: &[u8]| {
        read_gpmf("a.mp4", &MemoryBytes::new("a.mp4", bytes.to_vec())).map(|f| f.is_some())
    };
    assert!(!read(&boxed(*b"ftyp", &[b"mp42"])).unwrap());
    let sound = film(&[
        payload(0, 3, false),
        payload(10, 3, false),
        payload(20, 3, false),
    ]);
    assert!(read(&sound).unwrap());
    for cut in (0..sound.len()).step_by(3) {
        let _ = read(&sound[..cut]);
        let mut flipped = sound.clone();
        flipped[cut] ^= 0x91;
        let _ = read(&flipped);
    }
}

fn film_set(films: &[(&str, Vec<u8>)]) -> Arc<dyn FileSet> {
    let films = films.iter().cloned();
    Arc::new(MemoryFiles(
        films.map(|(name, film)| (name.to_owned(), film)).collect(),
    ))
}

#[test]
fn of_several_films_the_others_are_told_and_one_that_fails_stops_none() {
    let sound = |first| film(&[payload(first, 3, true), payload(first + 10, 3, true)]);
    let unfixed = film(&[payload(0, 0, true)]);
    let other = boxed(*b"ftyp", &[b"mp42"]);
    let files = film_set(&[
        ("GX010000.MP4", unfixed.clone()),
        ("GX010001.MP4", sound(0)),
        ("GX020001.MP4", sound(20)),
        ("phone.mp4", other.clone()),
    ]);
    let folder = flight_of_film(&files).unwrap().unwrap();
    let told = |name: &str, words: &str| {
        let mut notes = folder.notes.iter();
        notes.any(|note| note.contains(name) && note.contains(words))
    };
    assert!(told("GX020001.MP4", "left out"), "{:?}", folder.notes);
    assert!(told("GX010000.MP4", "10 places, none with a fix"));
    assert!(!told("phone.mp4", ""), "{:?}", folder.notes);
    assert_eq!(films_left_out(files.as_ref()).len(), 3);
    assert!(
        flight_of_film(&film_set(&[("a.mp4", other)]))
            .unwrap()
            .is_none()
    );
    let failed = flight_of_film(&film_set(&[("a.mp4", unfixed)]))
        .err()
        .unwrap();
    assert_eq!(failed.to_string(), "a.mp4: 10 places, none with a fix");
}

#[test]
fn a_film_that_is_cut_off_before_its_index_is_told() {
    let sound = film(&[payload(0, 3, false), payload(10, 3, false)]);
    let index = sound.windows(4).position(|four| four == b"moov").unwrap() - 4;
    for cut in [40, index / 2, index - 1, index + 30, sound.len() - 1] {
        let bytes = MemoryBytes::new("a.mp4", sound[..cut].to_vec());
        let told = read_gpmf("a.mp4", &bytes).err().unwrap().to_string();
        assert!(told.contains("copy it again"), "{cut}: {told}");
    }
    for other in [&b"a text that says nothing of a film"[..], b""] {
        let bytes = MemoryBytes::new("a.mp4", other.to_vec());
        assert!(read_gpmf("a.mp4", &bytes).unwrap().is_none());
    }
}

#[test]
fn an_index_that_names_the_same_bytes_many_times_is_read_as_far_as_the_film_is_long() {
    let payloads = [payload(0, 3, false), payload(10, 3, false)];
    let bytes = film_that_names(&payloads, 10_000);
    let most = bytes.len() / payloads[0].len();
    let index = index_of(&MemoryBytes::new("a.mp4", bytes.clone())).unwrap();
    assert_eq!(track_of(&index).unwrap().len(), 20_000);
    let (places, is_cut) = places_of(&MemoryBytes::new("a.mp4", bytes)).unwrap();
    assert!(
        is_cut && places.rows.len() <= 10 * most,
        "{}",
        places.rows.len()
    );
}

#[test]
fn heights_above_the_ellipsoid_are_told_as_such() {
    for (stated, is_told) in [("MSLV", false), ("WGS84", true), ("", false)] {
        for is_each in [false, true] {
            let mut rows = payload(0, 3, is_each);
            if !stated.is_empty() {
                // In the stead of the acceleration of the other stream, in that of the places.
                let piece = piece(*b"GPSA", b'c', 1, stated.as_bytes());
                let streams: Vec<_> = pieces(pieces(&rows).next().unwrap().data)
                    .map(|stream| [&piece[..], stream.data].concat())
                    .map(|stream| super::tests::piece(*b"STRM", 0, 1, &stream))
                    .collect();
                rows = super::tests::piece(*b"DEVC", 0, 1, &streams.concat());
            }
            let bytes = MemoryBytes::new("a.mp4", film(&[rows.clone(), rows]));
            let folder = read_gpmf("a.mp4", &bytes).unwrap().unwrap();
            let told = folder.notes.iter().any(|note| note.contains("ellipsoid"));
            assert_eq!(told, is_told, "{stated} {is_each}: {:?}", folder.notes);
            let height = folder
                .flight
                .channel(pilotage_flight::ChannelName::GpsHeight);
            assert!((height.unwrap().values[0] - 520.0).abs() < 0.01, "{stated}");
        }
    }
}
