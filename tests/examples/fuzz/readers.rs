//! The readers that are tried, each with small files to begin with and with what must hold.

use std::sync::Arc;

use pilotage_core::flight::columns::{flight_of_tables, guess_tables, preview};
use pilotage_core::flight::files::{FileSet, MemoryFiles};
use pilotage_core::flight::foreign::foreign_file;
use pilotage_core::flight::log::{LogFormatInfo, all_formats};
use pilotage_core::flight::nmea::{is_nmea, read_nmea};
use pilotage_core::flight::photo::{read_photo, read_photos};
use pilotage_core::flight::srt::read_srt;
use pilotage_core::flight::video::{MotionJpegReader, VideoIndex};
use pilotage_core::imagery::MemoryBytes;
use pilotage_core::raster::{Picture, encode_jpeg};
use pilotage_tests::data::shared;
use pilotage_tests::logs::check::{checked, same};
use pilotage_tests::logs::corpus::{Sample, samples};

/// Messages that were read and whether every byte made sense, or what is wrong.
type Execution = Result<(u64, bool), String>;

/// Reads a file whole, and once more in pieces that end at the places where there are any.
type Execute = Box<dyn Fn(&[u8], &[usize]) -> Execution>;

/// A reader.
pub struct FuzzedReader {
    /// Its name on the command line.
    pub name: String,
    /// Small files to begin with.
    pub samples: Box<dyn Fn() -> Vec<Sample>>,
    /// Function that reads the files.
    pub execute: Execute,
}

/// Every reader of files that anybody may drop on the page as a flight.
pub fn all_readers() -> Vec<FuzzedReader> {
    let of_log = |info: &'static LogFormatInfo| FuzzedReader {
        name: format!("{:?}", info.format),
        samples: Box::new(|| samples(info.format)),
        execute: Box::new(|bytes, ends| log(info, bytes, ends)),
    };
    let mut readers: Vec<FuzzedReader> = all_formats().iter().map(of_log).collect();
    readers.push(FuzzedReader {
        name: "Photo".to_owned(),
        samples: Box::new(photos),
        execute: Box::new(|bytes, _| Ok(photo(bytes))),
    });
    readers.push(FuzzedReader {
        name: "Film".to_owned(),
        samples: Box::new(films),
        execute: Box::new(film),
    });
    readers.push(FuzzedReader {
        name: "Table".to_owned(),
        samples: Box::new(tables),
        execute: Box::new(|bytes, _| table(bytes)),
    });
    readers.push(FuzzedReader {
        name: "Nmea".to_owned(),
        samples: Box::new(|| plain([sentences(40), sentences(7)])),
        execute: Box::new(|bytes, _| Ok(sentences_of(bytes))),
    });
    readers.push(FuzzedReader {
        name: "Subtitles".to_owned(),
        samples: Box::new(|| plain([subtitles(false), subtitles(true)])),
        execute: Box::new(|bytes, _| {
            let read = read_srt("a.srt", bytes);
            Ok((1, read.is_ok_and(|folder| folder.is_some())))
        }),
    });
    readers
}

/// Sentences of a receiver in so many seconds.
fn sentences(seconds: u32) -> Vec<u8> {
    let sentence = |body: String| {
        let sum = body.bytes().fold(0, |sum, byte| sum ^ byte);
        format!("${body}*{sum:02X}\r\n")
    };
    let moment = |second: u32| {
        let clock = format!("1020{:02}.25", second % 60);
        let place = format!("4730.{:04},N,00833.9000,E", 7 * second);
        sentence(format!("GNGGA,{clock},{place},1,12,0.8,540.5,M,47.0,M,,"))
            + &sentence(format!("GNRMC,{clock},A,{place},19.4,12.5,010524,,,A"))
            + &sentence("GNVTG,12.5,T,,M,19.4,N,36.0,K,A".to_owned())
    };
    (0..seconds).map(moment).collect::<String>().into_bytes()
}

/// Files of sentences are told by their content, and named for what they are where they cannot be read.
fn sentences_of(bytes: &[u8]) -> (u64, bool) {
    let told = is_nmea(bytes) || foreign_file(&MemoryBytes::new("", bytes)).is_some();
    let read = read_nmea("a.nmea", bytes);
    (u64::from(told), read.is_ok_and(|folder| folder.is_some()))
}

/// Subtitles of a film, as old and as new firmware writes them.
fn subtitles(is_old: bool) -> Vec<u8> {
    let cue = |i: u32| {
        let words = if is_old {
            format!("F/2.8, GPS (8.{i:04}, 47.1, 15), D 24.6m, H 20.{i}m, H.S 0.1m/s")
        } else {
            format!(
                "[latitude: 47.{i:06}] [longitude: 8.5] [rel_alt: {i}.5 abs_alt: 440.0] [gb_yaw: {i}.0 gb_pitch: -80.0]"
            )
        };
        format!("{i}\n00:00:{i:02},000 --> 00:00:{i:02},500\n{words}\n\n")
    };
    (0..20).map(cue).collect::<String>().into_bytes()
}

fn log(info: &LogFormatInfo, bytes: &[u8], ends: &[usize]) -> Execution {
    let log = checked(info, bytes, &[])?;
    if !ends.is_empty() {
        same(&log, &checked(info, bytes, ends)?)?;
    }
    Ok((log.report.messages, log.report.is_clean()))
}

/// Files with nothing told of where their parts begin.
fn plain(files: impl IntoIterator<Item = Vec<u8>>) -> Vec<Sample> {
    let sample = |bytes| Sample {
        bytes,
        seams: Vec::new(),
    };
    files.into_iter().map(sample).collect()
}

/// The heads of real photos, without their thumbnails.
fn photos() -> Vec<Sample> {
    let names = [
        ("brighton_beach", "DJI_0026_original.JPG"),
        ("caliterra", "IMG_9360_original.jpg"),
        ("caliterra", "IMG_9400_original.jpg"),
    ];
    let head = |(folder, name): (&str, &str)| {
        let bytes = std::fs::read(shared(folder)?.join(name)).ok()?;
        Some(shortened(&bytes))
    };
    plain(names.into_iter().filter_map(head))
}

/// The segments of a JPEG file up to its pixels, none of them longer than a few kilobytes: tags stand at the
/// beginning of theirs, the thumbnail at the end.
fn shortened(jpeg: &[u8]) -> Vec<u8> {
    const LONGEST: usize = 4000;
    const PIXELS: u8 = 0xda;
    let mut short = jpeg[..2].to_vec();
    let mut at = 2;
    while let Some(&[0xff, kind, high, low]) = jpeg.get(at..at + 4) {
        let length = usize::from(u16::from_be_bytes([high, low]));
        let kept = length.min(LONGEST);
        short.extend([0xff, kind]);
        short.extend((kept as u16).to_be_bytes());
        short.extend(jpeg[at + 4..].iter().take(kept - 2));
        at += 2 + length;
        if kind == PIXELS {
            break;
        }
    }
    short
}

fn photo(bytes: &[u8]) -> (u64, bool) {
    let read = read_photo(&MemoryBytes::new("a.jpg", bytes));
    let names = ["a.jpg", "b.jpg"].map(|name| (name.to_owned(), bytes.to_vec()));
    let files: Arc<dyn FileSet> = Arc::new(MemoryFiles(names.into_iter().collect()));
    let flight = read_photos(&files);
    (u64::from(read.is_ok()), flight.is_some())
}

fn chunk(name: &[u8], data: &[u8]) -> Vec<u8> {
    let length = (data.len() as u32).to_le_bytes();
    [name, &length[..], data, &vec![0; data.len() % 2]].concat()
}

/// Pictures one after another, by themselves and in AVI files.
fn films() -> Vec<Sample> {
    let picture = |shade: u8| encode_jpeg(&Picture::filled(16, 8, [shade, 90, 30]), 80);
    let pictures: Vec<Vec<u8>> = (0..4).filter_map(|i| picture(40 * i).ok()).collect();
    let mut head = b"vidsMJPG".to_vec();
    head.resize(20, 0);
    head.extend([1_u32, 10].map(u32::to_le_bytes).concat());
    head.resize(48, 0);
    let list = |kind: &[u8], inside: Vec<u8>| chunk(b"LIST", &[kind, &inside].concat());
    let header = list(b"hdrl", list(b"strl", chunk(b"strh", &head)));
    let movie = pictures.iter().flat_map(|jpeg| chunk(b"00dc", jpeg));
    let inside = [header, list(b"movi", movie.collect())].concat();
    let avi = chunk(b"RIFF", &[b"AVI ", &inside[..]].concat());
    let sent = pictures.iter().flat_map(|jpeg| {
        let lines = format!(
            "--frame\r\nContent-Type: image/jpeg\r\nContent-Length: {}\r\n\r\n",
            jpeg.len()
        );
        [lines.as_bytes(), jpeg, b"\r\n"].concat()
    });
    plain([avi, pictures.concat(), sent.collect()])
}

fn index(bytes: &[u8], ends: &[usize]) -> VideoIndex {
    let mut reader = MotionJpegReader::default();
    let mut start = 0;
    for end in ends.iter().copied().chain([bytes.len()]) {
        reader.feed(&bytes[start..end]);
        start = end;
    }
    reader.finish()
}

fn film(bytes: &[u8], ends: &[usize]) -> Execution {
    let found = index(bytes, &[]);
    let report = &found.report;
    if report.used_bytes + report.skipped_bytes != bytes.len() as u64 {
        return Err(format!("{report:?} of {} bytes", bytes.len()));
    }
    let mut end = 0;
    for picture in &found.pictures {
        if picture.offset < end {
            return Err(format!("{picture:?} lies in the one before"));
        }
        end = picture.offset + picture.length as u64;
    }
    if end > bytes.len() as u64 {
        return Err("a picture goes on after the end".to_owned());
    }
    if !ends.is_empty() && index(bytes, ends) != found {
        return Err("another film in pieces".to_owned());
    }
    Ok((found.pictures.len() as u64, report.is_clean()))
}

/// The beginnings of real tables, and made ones in the manners of other programs.
fn tables() -> Vec<Sample> {
    const HEAD: usize = 1500;
    let names = [
        "TestLog2_ATT.csv",
        "TestLog2_GPS.csv",
        "TestLog2_NTUN.csv",
        "SwissLog1_airdata.csv",
    ];
    let head = |name: &&str| {
        let mut bytes = std::fs::read(shared("inertialnav_x8")?.join(name)).ok()?;
        bytes.truncate(HEAD);
        Some(bytes)
    };
    let mut files: Vec<Vec<u8>> = names.iter().filter_map(head).collect();
    let rows = |row: fn(f64) -> String| (0..25).map(|i| row(f64::from(i))).collect::<String>();
    let semicolons = rows(|i| {
        format!(
            "{},5;{:.5};8,{:05};\"{}\"\n",
            i,
            47.0 + 1e-5 * i,
            i * 7.0,
            i
        )
    });
    let dates = rows(|i| {
        format!(
            "2024-05-01T10:20:{:02}.5Z\t{:.6}\t{:.6}\t{i}\n",
            i,
            47.0 + 1e-5 * i,
            8.0
        )
    });
    files.push(format!("time [s];latitude;longitude;\"heading, deg\"\n{semicolons}").into());
    files.push(format!("# made\nutc\tlat\tlon\tairspeed_kt\n{dates}").into());
    plain(files)
}

fn table(bytes: &[u8]) -> Execution {
    let names = vec!["a.csv".to_owned()];
    let only = [(names[0].clone(), bytes.to_vec())];
    let files: Arc<dyn FileSet> = Arc::new(MemoryFiles(only.into_iter().collect()));
    let mut told = 0;
    let mut is_flight = false;
    for guessed in guess_tables(files.as_ref(), &names) {
        let shown = preview(bytes, &guessed.map, 8);
        if shown
            .rows
            .iter()
            .any(|row| row.len() != guessed.map.columns.len())
        {
            return Err("a row of the preview has other columns".to_owned());
        }
        told += guessed.map.columns.len() as u64;
        is_flight |= flight_of_tables(&files, &[guessed.map]).is_ok();
    }
    Ok((told, is_flight))
}
