//! Cascades against what OpenCV 4.14 finds with the same files in the same pictures.

use std::collections::BTreeMap;
use std::fs;

use pilotage_core::landmark::cascade::{
    Cascade, CascadeError, CascadeKind, Rectangle, ScanSettings, group, scan,
};
use pilotage_core::raster::{Raster, decode_picture};
use pilotage_tests::data::shared;
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;
use serde_json::Value;

fn rectangle(value: &Value) -> Rectangle {
    let side = |i: usize| value[i].as_i64().expect("a whole number of pixels") as i32;
    Rectangle {
        x: side(0),
        y: side(1),
        width: side(2),
        height: side(3),
    }
}

#[test]
fn cascades_find_the_very_windows_that_opencv_finds() {
    let Some(folder) = shared("opencv_cascades") else {
        return;
    };
    let expected = fs::read(folder.join("expected_opencv_4.14.json")).unwrap();
    let expected: Value = serde_json::from_slice(&expected).unwrap();
    let mut pictures: BTreeMap<String, Raster<u8>> = BTreeMap::new();
    let mut cascades: BTreeMap<String, Cascade> = BTreeMap::new();
    let (mut wanted, mut matched, mut extra, mut groups, mut complaints) = (0, 0, 0, 0, Vec::new());
    for case in expected["cases"].as_array().unwrap() {
        let name = |key: &str| case[key].as_str().unwrap().to_owned();
        let picture = pictures.entry(name("image")).or_insert_with(|| {
            let bytes = fs::read(folder.join("images").join(name("image"))).unwrap();
            decode_picture(&bytes).unwrap().map(|p| p[0])
        });
        let cascade = cascades.entry(name("xml")).or_insert_with(|| {
            let text = fs::read_to_string(folder.join(name("xml"))).unwrap();
            Cascade::read(&name("xml"), &text).unwrap()
        });
        let settings = ScanSettings {
            scale_step: case["scaleFactor"].as_f64().unwrap(),
            ..ScanSettings::default()
        };
        let found = scan(cascade, picture, &settings);
        let (width, height) = (picture.width(), picture.height());
        let clipped = |r: &Rectangle| r.within(width, height);
        let mut raw: Vec<Rectangle> = found.iter().map(|f| clipped(&f.rectangle)).collect();
        raw.sort_unstable();
        let theirs: Vec<Rectangle> = case["raw"]
            .as_array()
            .unwrap()
            .iter()
            .map(rectangle)
            .collect();
        let common = theirs
            .iter()
            .filter(|r| raw.binary_search(r).is_ok())
            .count();
        wanted += theirs.len();
        matched += common;
        extra += raw.len() - common.min(raw.len());
        let title = format!("{} {} {}", name("xml"), name("image"), settings.scale_step);
        if common != theirs.len() || raw.len() != theirs.len() {
            complaints.push(format!(
                "{title}: {} of {}, {} found",
                common,
                theirs.len(),
                raw.len()
            ));
        }
        let mut ours: Vec<(Rectangle, f64)> = group(&found, 3)
            .iter()
            .map(|g| (clipped(&g.rectangle), g.score))
            .collect();
        ours.sort_by_key(|(r, _)| *r);
        let mut theirs: Vec<(Rectangle, f64)> = case["reject_levels"]
            .as_array()
            .unwrap()
            .iter()
            .map(|g| (rectangle(&g["rect"]), g["weight"].as_f64().unwrap()))
            .collect();
        theirs.sort_by_key(|(r, _)| *r);
        groups += theirs.len();
        let alike = ours.len() == theirs.len()
            && ours
                .iter()
                .zip(&theirs)
                .all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() < 1e-6);
        if !alike {
            complaints.push(format!("{title}: groups {ours:?} instead of {theirs:?}"));
        }
    }
    println!("{matched} of {wanted} windows, {extra} more; {groups} groups");
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

#[test]
fn every_file_comes_back_from_what_is_written_of_it() {
    let Some(folder) = shared("opencv_cascades") else {
        return;
    };
    let (mut files, mut read, mut written) = (0, 0, 0);
    for kind in ["haarcascades", "lbpcascades"] {
        for entry in fs::read_dir(folder.join(kind)).unwrap() {
            let text = fs::read_to_string(entry.unwrap().path()).unwrap();
            let cascade = Cascade::read(kind, &text).unwrap();
            let again = Cascade::read("written", &cascade.to_xml()).unwrap();
            assert!(again == cascade);
            let bytes = cascade.to_bytes();
            assert!(Cascade::from_bytes(&bytes).unwrap() == cascade);
            files += 1;
            read += text.len();
            written += bytes.len();
            if cascade.kind() == CascadeKind::Haar {
                let former = cascade.to_former_xml().unwrap();
                let once = Cascade::read("former", &former).unwrap();
                let twice = Cascade::read("former", &once.to_former_xml().unwrap()).unwrap();
                assert!(once == twice);
            } else {
                assert!(cascade.to_former_xml().is_err());
            }
        }
    }
    assert_eq!(files, 22);
    println!("{read} bytes of XML in {written} bytes");
}

/// Smallest file of every kind.
const SMALL: [&str; 3] = [
    "lbpcascades/lbpcascade_frontalface.xml",
    "haarcascades/haarcascade_licence_plate_rus_16stages.xml",
    "haarcascades/haarcascade_russian_plate_number.xml",
];

fn mutated(bytes: &[u8], random: &mut ChaCha8Rng) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    let place = |random: &mut ChaCha8Rng, len: usize| random.random_range(0..len.max(1));
    match random.random_range(0..5) {
        0 => bytes.truncate(place(random, bytes.len())),
        1 => {
            let (from, to) = (place(random, bytes.len()), place(random, bytes.len()));
            bytes.drain(from.min(to)..from.max(to));
        }
        2 => {
            let (from, to) = (place(random, bytes.len()), place(random, bytes.len()));
            let piece = bytes[from.min(to)..from.max(to)].to_vec();
            let at = place(random, bytes.len());
            bytes.splice(at..at, piece);
        }
        3 => {
            // A digit turned into another one: mostly a cascade still, with other thoughts.
            let digits: Vec<usize> = (0..bytes.len())
                .filter(|i| bytes[*i].is_ascii_digit())
                .collect();
            if let Some(&at) = digits.get(place(random, digits.len())) {
                bytes[at] = b'0' + random.random_range(0..10);
            }
        }
        _ => {
            for _ in 0..random.random_range(1..20) {
                let at = place(random, bytes.len());
                bytes[at] = *b"0123456789-.e<>/_ a"
                    .get(random.random_range(0..19))
                    .unwrap_or(&b' ');
            }
        }
    }
    bytes
}

/// Result of reading a file, and the beginning that a complaint about it has to have.
type Read = (Result<Cascade, CascadeError>, String);

/// Reads two thousand files that `broken` makes of the small ones, from name, text and number, and runs
/// those that are cascades.
fn break_files(seed: u64, mut broken: impl FnMut(&str, &str, usize, &mut ChaCha8Rng) -> Read) {
    let Some(folder) = shared("opencv_cascades") else {
        return;
    };
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let picture = Raster::from_fn(90, 60, |x, y| ((x * 31 + y * 57 + x * y) % 256) as u8);
    let settings = ScanSettings {
        scale_step: 1.3,
        ..ScanSettings::default()
    };
    let (mut read, mut refused) = (0, 0);
    for name in SMALL {
        let text = fs::read_to_string(folder.join(name)).expect("a small cascade");
        assert!(Cascade::read(name, &text).is_ok());
        for i in 0..667 {
            match broken(name, &text, i, &mut random) {
                (Ok(cascade), _) => {
                    scan(&cascade, &picture, &settings);
                    read += 1;
                }
                (Err(cause), beginning) => {
                    assert!(cause.to_string().starts_with(&beginning), "{cause}");
                    refused += 1;
                }
            }
        }
    }
    println!("{read} read, {refused} refused");
    assert!(read > 50 && refused > 500, "{read} read, {refused} refused");
}

#[test]
fn two_thousand_broken_files_are_refused_or_read_and_never_more() {
    break_files(4, |name, text, _, random| {
        let broken = mutated(text.as_bytes(), random);
        let cascade = Cascade::read(name, &String::from_utf8_lossy(&broken));
        (cascade, name.to_owned())
    });
}

/// As the compact form says: four bytes of FNV-1a over all before.
fn with_check_sum(mut bytes: Vec<u8>) -> Vec<u8> {
    bytes.truncate(bytes.len().saturating_sub(4));
    let step = |hash: u32, byte: &u8| (hash ^ u32::from(*byte)).wrapping_mul(0x0100_0193);
    let sum = bytes.iter().fold(0x811c_9dc5, step);
    bytes.extend(sum.to_le_bytes());
    bytes
}

#[test]
fn two_thousand_broken_compact_files_are_refused_or_read_and_never_more() {
    let mut whole: BTreeMap<String, Vec<u8>> = BTreeMap::new();
    break_files(5, |name, text, i, random| {
        let bytes = whole
            .entry(name.to_owned())
            .or_insert_with(|| Cascade::read(name, text).unwrap().to_bytes());
        let mut broken = mutated(bytes, random);
        if i % 4 != 0 {
            // Every fourth keeps its wrong sum; the others look sound from outside.
            let at = random.random_range(0..broken.len().max(1));
            if let Some(byte) = broken.get_mut(at) {
                *byte ^= 1 << random.random_range(0..8);
            }
            broken = with_check_sum(broken);
        }
        (Cascade::from_bytes(&broken), "byte ".to_owned())
    });
}
