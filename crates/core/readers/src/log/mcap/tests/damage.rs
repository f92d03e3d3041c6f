//! Tests of reading damaged files.

use proptest::prelude::*;

use super::super::super::Log;
use super::super::super::testing::{self, any_damage, reads_alike, rows};
use super::super::INFO;
use super::written::{PACKINGS, Packing, Written, chunk, description, flight, messages};

fn read(file: &[u8], piece: usize) -> Log {
    testing::read(&INFO, file, piece)
}

#[test]
fn a_file_cut_off_anywhere_keeps_every_whole_message() {
    for packing in [None, Some(Packing::Not)] {
        let file = flight(25, packing);
        let mut before = 0;
        for end in 0..=file.len() {
            let found = rows(&read(&file[..end], 1000));
            assert!(
                found == before || found == before + 1,
                "{packing:?} {end}: {found} {before}"
            );
            before = found;
        }
        assert_eq!(before, 25);
    }
}

#[test]
fn a_packed_chunk_that_is_cut_off_gives_what_can_be_unpacked() {
    // Bytes that do not pack well come in blocks, of which the first are whole.
    for packing in [Packing::Lz4, Packing::Zstandard] {
        let records = [description(), messages(0, 5000)].concat();
        let file = Written::new().and(&chunk(packing, &records)).0;
        let log = read(&file[..file.len() * 3 / 4], 1 << 16);
        assert!(
            rows(&log) > 1000 && rows(&log) < 5000,
            "{packing:?}: {}",
            rows(&log)
        );
        let told = format!("of which {} messages were read", rows(&log));
        let remarks = &log.report.remarks;
        assert!(remarks.iter().any(|it| it.ends_with(&told)), "{remarks:?}");
        // What was read of it is not told as lost.
        let lost = log.report.skipped_bytes as f64 / log.report.bytes as f64;
        assert!(lost < 0.5, "{packing:?} {lost}");
    }
}

#[test]
fn one_wrong_byte_costs_at_most_two_messages_outside_of_chunks_and_is_told() {
    let file = flight(25, None);
    let (from, to) = {
        let before = Written::new().and(&description());
        (before.0.len(), before.and(&messages(0, 25)).0.len())
    };
    for place in from..to {
        for flip in [0xff, 0x01] {
            let mut damaged = file.clone();
            damaged[place] ^= flip;
            let log = read(&damaged, 1000);
            let report = &log.report;
            assert!(rows(&log) >= 23, "byte {place}: {} {report:?}", rows(&log));
            assert!(
                !report.is_clean() || !report.remarks.is_empty(),
                "byte {place}"
            );
        }
    }
}

#[test]
fn one_wrong_byte_in_a_packed_chunk_costs_no_other_chunk_and_is_told() {
    for packing in [Packing::Lz4, Packing::Zstandard] {
        let file = flight(30, Some(packing));
        let first = Written::new().0.len();
        let chunks = [description(), messages(0, 10)].concat();
        let first = first + chunk(packing, &chunks).len();
        let second = chunk(packing, &messages(10, 10)).len();
        for place in first..first + second {
            let mut damaged = file.clone();
            damaged[place] ^= 0x10;
            let log = read(&damaged, 1000);
            let report = &log.report;
            assert!(rows(&log) >= 20, "{packing:?} byte {place}: {report:?}");
            let is_told = !report.is_clean() || !report.remarks.is_empty();
            // The first and last time of a chunk are asked by nobody.
            assert!(
                is_told || place < first + 9 + 16,
                "{packing:?} byte {place}"
            );
        }
    }
}

#[test]
fn a_lost_chunk_with_the_descriptions_costs_its_own_messages_only() {
    let file = flight(30, Some(Packing::Lz4));
    let start = Written::new().0.len();
    let mut damaged = file.clone();
    // The name of its packing.
    damaged[start + 9 + 28 + 4] = b'x';
    let log = read(&damaged, 1000);
    assert_eq!(rows(&log), 20, "{:?}", log.report);
    assert!(
        log.report
            .remarks
            .iter()
            .any(|r| r.contains("30 messages; 20"))
    );
    assert!(log.report.remarks.iter().any(|r| r.contains("xz4")));
}

#[test]
fn a_length_made_long_by_damage_does_not_swallow_the_rest() {
    let file = flight(2000, None);
    let at = Written::new()
        .and(&description())
        .and(&messages(0, 1000))
        .0
        .len();
    for byte in 1..9 {
        let mut damaged = file.clone();
        damaged[at + byte] = 0x20;
        let log = read(&damaged, 1 << 20);
        assert!(
            rows(&log) >= 1998,
            "byte {byte}: {} {:?}",
            rows(&log),
            log.report
        );
    }
}

#[test]
fn a_second_file_behind_the_first_is_read_by_its_own_description() {
    let second = String::from_utf8_lossy(&description()).replace("/turn", "/bank");
    let second = Written::new()
        .and(second.as_bytes())
        .and(&messages(0, 5))
        .end(5, &[]);
    let file = [
        flight(10, Some(Packing::Zstandard)),
        b"noise".to_vec(),
        second,
    ]
    .concat();
    for piece in [1, 64, file.len()] {
        let log = read(&file, piece);
        let names: Vec<_> = log
            .topics
            .iter()
            .map(|t| (t.name.to_string(), t.len()))
            .collect();
        assert_eq!(names, [("/turn".to_owned(), 10), ("/bank".to_owned(), 5)]);
        assert_eq!(log.report.skipped_bytes, 5);
        assert_eq!(log.report.remarks.len(), 1, "{:?}", log.report.remarks);
    }
}

#[test]
fn a_chunk_that_says_it_unpacks_to_more_than_can_be_is_refused() {
    let records = [description(), messages(0, 5)].concat();
    let mut file = Written::new().and(&chunk(Packing::Zstandard, &records)).0;
    let size = Written::new().0.len() + 9 + 16;
    file[size..size + 8].copy_from_slice(&(1_u64 << 40).to_le_bytes());
    let log = read(&file, 1000);
    assert_eq!(rows(&log), 0);
    assert!(log.report.skipped[0].cause.contains("far more"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn damage_never_stops_the_reader_and_pieces_never_matter(
        damage in any_damage(),
        packing in 0..4_usize,
        pieces in proptest::collection::vec(1_usize..200, 0..40),
    ) {
        let packing = PACKINGS.get(packing).copied();
        reads_alike(&INFO, &damage.done_to(&flight(25, packing)), pieces)?;
    }

    #[test]
    fn any_bytes_behind_a_beginning_are_survived(
        bytes in proptest::collection::vec(any::<u8>(), 0..2000),
    ) {
        reads_alike(&INFO, &[Written::new().0, bytes].concat(), vec![64])?;
    }
}
