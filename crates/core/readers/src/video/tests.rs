//! Videos that are made here, whole and damaged.

use std::sync::Arc;

use proptest::prelude::*;

use super::*;
use pilotage_base::bytes::MemoryBytes;
use pilotage_flight::FrameSource;
use pilotage_raster::raster::{Picture, encode_jpeg};

fn picture(index: u8) -> Vec<u8> {
    encode_jpeg(&Picture::filled(16, 8, [10 * index, 90, 30]), 80).unwrap()
}

fn chunk(name: &[u8], data: &[u8]) -> Vec<u8> {
    let length = (data.len() as u32).to_le_bytes();
    let padding = vec![0; data.len() % 2];
    [name, &length[..], data, &padding].concat()
}

fn list(name: &[u8], kind: &[u8], chunks: &[Vec<u8>]) -> Vec<u8> {
    chunk(name, &[kind, &chunks.concat()].concat())
}

/// Sound and pictures of a video at 12.5 a second; the third of its pictures is left out.
fn avi(count: u8) -> Vec<u8> {
    let mut sound = b"auds".to_vec();
    sound.resize(48, 0);
    let mut video = b"vidsMJPG".to_vec();
    video.resize(20, 0);
    video.extend([2_u32, 25].map(u32::to_le_bytes).concat());
    video.resize(48, 0);
    let streams = [sound, video].map(|head| list(b"LIST", b"strl", &[chunk(b"strh", &head)]));
    let header = list(
        b"LIST",
        b"hdrl",
        &[chunk(b"avih", &[0; 56]), streams.concat()],
    );
    let mut chunks = Vec::new();
    for index in 0..count {
        chunks.push(chunk(b"00wb", &[index; 33]));
        let jpeg = if index == 2 {
            Vec::new()
        } else {
            picture(index)
        };
        chunks.push(chunk(b"01dc", &jpeg));
    }
    let movie = list(b"LIST", b"movi", &chunks);
    list(
        b"RIFF",
        b"AVI ",
        &[
            header,
            chunk(b"JUNK", &[0; 9]),
            movie,
            chunk(b"idx1", &[1; 32]),
        ],
    )
}

fn read(file: &[u8], piece: usize) -> VideoIndex {
    let mut reader = MotionJpegReader::default();
    for bytes in file.chunks(piece.max(1)) {
        reader.feed(bytes);
    }
    reader.finish()
}

fn checked(file: &[u8], piece: usize) -> VideoIndex {
    let index = read(file, piece);
    let report = &index.report;
    assert_eq!(report.bytes, file.len() as u64);
    assert_eq!(
        report.used_bytes + report.skipped_bytes,
        report.bytes,
        "{report:?}"
    );
    let mut end = 0;
    for picture in &index.pictures {
        assert!(picture.offset >= end);
        end = picture.offset + picture.length as u64;
        assert!(file[picture.offset as usize..end as usize].starts_with(&[0xff, 0xd8]));
    }
    assert!(end <= report.bytes);
    index
}

#[test]
fn pictures_of_an_avi_have_the_times_of_its_header() {
    let file = avi(6);
    assert!(is_motion_jpeg(&file[..400]));
    let index = checked(&file, 100);
    assert!(index.report.is_clean(), "{:?}", index.report);
    assert_eq!((index.rate, index.size), (Some(12.5), Some((16, 8))));
    let source = Arc::new(MemoryBytes::new("a.avi", file));
    let mut video = open_motion_jpeg(source).unwrap();
    let times = video.times(30.0);
    let expected = [0.0, 0.08, 0.24, 0.32, 0.4];
    assert!(
        times
            .iter()
            .zip(expected)
            .all(|(a, b)| (a - b).abs() < 1e-12),
        "{times:?}"
    );
    let shown = video.picture(2).unwrap();
    assert!(shown.get(4, 4)[0].abs_diff(30) < 4, "{:?}", shown.get(4, 4));
    assert!(video.encoded(5).is_err());
}

#[test]
fn pictures_without_a_container_are_found_with_or_without_text_between_them() {
    let bare: Vec<u8> = (0..4).flat_map(picture).collect();
    let sent: Vec<u8> = (0..4)
        .flat_map(|i| {
            [
                b"--cut\r\nContent-Type: image/jpeg\r\n\r\n".to_vec(),
                picture(i),
            ]
            .concat()
        })
        .collect();
    for file in [bare, sent] {
        assert!(is_motion_jpeg(&file[..200]));
        let index = checked(&file, 77);
        assert!(index.report.is_clean());
        assert_eq!((index.pictures.len(), index.rate), (4, None));
    }
    assert!(!is_motion_jpeg(b"RIFF\0\0\0\0WAVEfmt MJPG"));
}

#[test]
fn one_damaged_picture_costs_no_other() {
    let file: Vec<u8> = (0..4).flat_map(picture).collect();
    let [start, end] = [1, 2].map(|count| (0..count).map(|i| picture(i).len()).sum::<usize>());
    for place in start..end {
        let mut damaged = file.clone();
        damaged[place] ^= 0x41;
        let found = checked(&damaged, 1000).pictures.len();
        assert!(found >= 2, "byte {place}: {found}");
    }
    let file = avi(8);
    for place in 12..file.len() {
        let mut damaged = file.clone();
        damaged[place] ^= 0x41;
        let found = checked(&damaged, 1000).pictures.len();
        assert!(found >= 5, "byte {place}: {found}");
    }
}

#[test]
fn a_video_cut_off_anywhere_keeps_its_whole_pictures() {
    for file in [avi(5), (0..4).flat_map(picture).collect()] {
        let mut before = 0;
        for end in 0..=file.len() {
            let found = checked(&file[..end], 500).pictures.len();
            assert!(found == before || found == before + 1);
            before = found;
        }
        assert_eq!(before, 4);
    }
}

#[test]
fn frames_of_a_flight_have_the_times_of_the_flights_clock() {
    let clock = VideoClock {
        offset: 100.0,
        rate: 1.001,
    };
    let files = std::sync::Arc::new(pilotage_base::files::MemoryFiles(
        [(
            "flight.json".to_owned(),
            br#"{"pilotage_flight":1,"name":"x","start":{"time_s":0,
            "north_m":0,"east_m":0,"standard_deviation_m":1}}"#
                .to_vec(),
        )]
        .into(),
    ));
    let flight = crate::read_flight(files).unwrap().flight;
    let camera = pilotage_raster::camera::CameraModel::pinhole(16, 8, 1.0);
    let flight = with_pictures(flight, "a.avi", &[0.0, 10.0], clock, camera);
    assert_eq!(flight.camera.width, 16);
    let frames: Vec<_> = flight.frames.iter().map(|f| f.name.as_str()).collect();
    assert_eq!(frames, ["a.avi 1", "a.avi 2"]);
    assert_eq!(flight.frames[0].time, 100.0);
    assert!((flight.frames[1].time - 110.01).abs() < 1e-9);
}

proptest! {
    #[test]
    fn damage_is_survived_and_pieces_never_matter(
        flips in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..12),
        cut in any::<prop::sample::Index>(),
        is_avi in any::<bool>(),
        piece in 1..300_usize,
    ) {
        let mut file = if is_avi { avi(5) } else { (0..4).flat_map(picture).collect() };
        for (place, byte) in flips {
            let place = place.index(file.len());
            file[place] = byte;
        }
        file.truncate(cut.index(file.len()) + 1);
        let whole = checked(&file, file.len());
        prop_assert_eq!(checked(&file, piece), whole);
    }

    #[test]
    fn any_bytes_are_survived(bytes in proptest::collection::vec(any::<u8>(), 0..2000)) {
        checked(&bytes, 64);
        checked(&[&b"RIFF\0\0\0\0AVI "[..], &bytes].concat(), 64);
    }
}
