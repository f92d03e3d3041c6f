//! Recorded flights with bytes changed, pieces missing, doubled or cut off.

use pilotage_core::flight::log::{HEAD, Log, Topic, recognise};
use pilotage_tests::data::shared;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Recorded flights, and from which part of the file on they hold nothing but rows.
const FLIGHTS: [(&str, f64); 2] = [
    ("px4_ulog/sample-small.ulg", 0.5),
    ("px4_ulog/sample_log_small.ulg", 0.5),
];

fn read(file: &[u8]) -> Log {
    let info = recognise(&file[..file.len().min(HEAD)]).expect("the beginning is sound");
    let mut log = Log::new("flight", info.format);
    let mut reader = (info.reader)();
    for piece in file.chunks(1 << 16) {
        reader.feed(piece, &mut log);
    }
    reader.finish(&mut log);
    let report = &log.report;
    assert_eq!(report.used_bytes + report.skipped_bytes, report.bytes);
    assert_eq!(report.bytes, file.len() as u64);
    log
}

fn rows(log: &Log) -> usize {
    log.topics.iter().map(Topic::len).sum()
}

/// Calls `check` with each recorded flight, what is read of it, and the byte from which on it is rows.
fn for_each_flight(mut check: impl FnMut(&str, &[u8], &Log, usize)) {
    for (name, begin) in FLIGHTS {
        let Some(path) = shared(name) else {
            continue;
        };
        let file = std::fs::read(path).expect("the file can be read");
        let whole = read(&file);
        check(name, &file, &whole, (begin * file.len() as f64) as usize);
    }
}

#[test]
fn a_wrong_byte_among_the_rows_costs_hardly_any_of_them() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    for_each_flight(|name, file, sound, begin| {
        let whole = rows(sound);
        for _ in 0..100 {
            let mut damaged = file.to_vec();
            let place = random.random_range(begin..file.len());
            damaged[place] ^= random.random_range(1..=255_u8);
            let log = read(&damaged);
            let found = rows(&log);
            assert!(
                found + 3 >= whole,
                "{name}, byte {place}: {found} of {whole}"
            );
            let is_told = !log.report.is_clean() || log.report.remarks != sound.report.remarks;
            assert!(found == whole || is_told, "{name}, byte {place}");
        }
    });
}

#[test]
fn a_missing_or_doubled_piece_costs_no_rows_beyond_it() {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    for_each_flight(|name, file, sound, begin| {
        let whole = rows(sound);
        for _ in 0..50 {
            let from = random.random_range(begin..file.len());
            let to = random.random_range(from..file.len().min(from + 5000));
            // Rows take more than eight bytes with their frame.
            let most = (to - from) / 8 + 3;
            let missing = [&file[..from], &file[to..]].concat();
            let found = rows(&read(&missing));
            assert!(
                found + most >= whole,
                "{name}, {from}..{to}: {found} of {whole}"
            );
            let doubled = [&file[..to], &file[from..]].concat();
            let found = rows(&read(&doubled));
            assert!(
                found + 3 >= whole,
                "{name}, {from}..{to}: {found} of {whole}"
            );
            let cut = rows(&read(&file[..to]));
            assert!(cut <= whole);
        }
    });
}

#[test]
fn noise_all_over_a_file_is_survived_and_accounted_for() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    for_each_flight(|_, file, sound, _| {
        for every in [10, 100, 1000, 10_000] {
            let mut damaged = file.to_vec();
            let mut place = 64;
            while place < damaged.len() {
                damaged[place] = random.random();
                place += random.random_range(1..2 * every);
            }
            assert!(rows(&read(&damaged)) <= rows(sound));
        }
    });
}
