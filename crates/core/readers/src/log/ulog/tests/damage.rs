//! Tests of reading damaged files.

use proptest::prelude::*;

use super::super::super::{
    Log,
    testing::{self, any_damage, reads_alike, rows},
};
use super::super::INFO;
use super::written::Written;

fn read(file: &[u8], piece: usize) -> Log {
    testing::read(&INFO, file, piece)
}

#[test]
fn a_file_cut_off_anywhere_keeps_every_whole_row() {
    let file = Written::flight(30).0;
    let whole = rows(&read(&file, file.len()));
    let mut before = 0;
    for end in 0..=file.len() {
        let log = read(&file[..end], 1000);
        let found = rows(&log);
        assert!(found == before || found == before + 1);
        before = found;
        assert_eq!(log.report.bytes, end as u64);
    }
    assert_eq!(before, whole);
}

#[test]
fn one_wrong_byte_costs_at_most_two_rows_and_is_told() {
    let file = Written::flight(30).0;
    let first_row = Written::flight(0).0.len();
    for place in first_row..file.len() {
        for flip in [0xff, 0x01] {
            let mut damaged = file.clone();
            damaged[place] ^= flip;
            let log = read(&damaged, 1000);
            assert!(rows(&log) >= 28, "byte {place}: {:?}", log.report);
            let is_told = !log.report.is_clean() || !log.report.remarks.is_empty();
            assert!(rows(&log) == 30 || is_told);
        }
    }
}

/// A hundred rows from second 101 on, of which some have other times; a header that says second 100, and dropouts.
fn timed(other: &[(u64, u64)]) -> Log {
    let mut file = Written::new(100_000_000)
        .definition("a:uint64_t timestamp;float x;")
        .definition("once:uint64_t timestamp;uint8_t y;")
        .announce(1, 0, "a")
        .announce(2, 0, "once")
        .row(2, &[&0_u64.to_le_bytes(), &[7]]);
    for index in 0..100 {
        let usual = 101_000_000 + 100_000 * index;
        let other = other.iter().find(|(at, _)| *at == index);
        let time = other.map_or(usual, |(_, time)| *time);
        file = file.row(1, &[&time.to_le_bytes(), &(index as f32).to_le_bytes()]);
        if index == 80 {
            file = file.message(b'O', &[&20_u16.to_le_bytes()]);
        }
    }
    read(&file.0, 1000)
}

#[test]
fn a_wrong_time_costs_its_row_and_the_log_counts_from_its_header() {
    let span = |log: &Log| {
        log.span()
            .map(|(a, b)| ((a * 10.0).round(), (b * 10.0).round()))
    };
    let whole = timed(&[]);
    assert_eq!(span(&whole), Some((1000.0, 1109.0)));
    // What was told at no time is left out.
    assert!(
        whole
            .first("once")
            .is_some_and(super::super::super::Topic::is_empty)
    );
    for at in [0, 1, 50, 98, 99] {
        for wrong in [0, 1, 0x7f << 56, (1 << 40) + 105_000_000, u64::MAX] {
            let log = timed(&[(at, wrong)]);
            let topic = log.first("a").unwrap();
            assert_eq!(topic.len(), 99, "{wrong} at {at}: {:?}", log.report);
            assert!(topic.values("x").unwrap().iter().all(|x| *x != at as f64));
            let last = if at == 99 { 1108.0 } else { 1109.0 };
            assert_eq!(span(&log), Some((1000.0, last)), "{wrong} at {at}");
            assert!(log.report.remarks[0].contains("left out"));
            let gap = log.report.gaps[0].time;
            assert!((gap - 109.0).abs() < 0.2, "{wrong} at {at}: {gap}");
        }
    }
    let several = timed(&[(40, 1 << 50), (41, 1 << 50), (42, (1 << 50) + 100_000)]);
    assert_eq!(
        several.first("a").map(super::super::super::Topic::len),
        Some(97)
    );
}

#[test]
fn a_length_made_long_by_damage_does_not_swallow_the_rest() {
    let file = Written::flight(2000).0;
    let at = Written::flight(1000).0.len();
    let mut damaged = file.clone();
    damaged[at + 1] = 0xff;
    let log = read(&damaged, 1 << 20);
    assert_eq!(rows(&log), 1999);
    assert_eq!(log.report.skipped_places, 1);
    assert_eq!(log.report.skipped[0].offset, at as u64);
    // The same near the end, where the length reaches beyond the file.
    let at = Written::flight(1990).0.len();
    let mut damaged = file;
    damaged[at + 1] = 0xff;
    let log = read(&damaged, 1 << 20);
    assert_eq!(rows(&log), 1999);
}

#[test]
fn a_row_of_another_length_than_its_definition_is_left_out_alone() {
    let file = Written::flight(10).row(3, &[&[1; 30]]).0;
    let good = file.len();
    let file = [
        file,
        Written::flight(20).0[Written::flight(10).0.len()..].to_vec(),
    ]
    .concat();
    let log = read(&file, 50);
    assert_eq!(rows(&log), 20);
    assert_eq!(log.report.skipped.len(), 1);
    assert_eq!(log.report.skipped[0].bytes, 35);
    assert_eq!(log.report.skipped[0].offset + 35, good as u64);
}

#[test]
fn a_second_log_behind_the_first_is_read_by_its_own_definitions() {
    let second = Written::new(0)
        .definition("led:uint64_t timestamp;uint8_t colour;")
        .announce(3, 0, "led")
        .row(3, &[&5_u64.to_le_bytes(), &[9]]);
    let file = [Written::flight(10).0, b"noise".to_vec(), second.0].concat();
    for piece in [1, 64, file.len()] {
        let log = read(&file, piece);
        assert_eq!(rows(&log), 11);
        assert_eq!(log.first("led").unwrap().values("colour"), Some(vec![9.0]));
        assert_eq!(log.report.remarks.len(), 1);
        assert_eq!(log.report.skipped_bytes, 5);
    }
}

#[test]
fn a_definition_made_to_fill_memory_is_refused() {
    let mut file = Written::new(0);
    file = file.definition("a0:uint8_t[4000] x;");
    for level in 1..20 {
        file = file.definition(&format!("a{level}:a{}[4000] x;", level - 1));
    }
    for number in 0..500 {
        file = file.announce(number, 0, "a19").row(number, &[&[0; 8]]);
    }
    let log = read(&file.0, 1 << 16);
    assert!(log.topics.is_empty());
    assert!(log.report.remarks[0].contains("a19"));
}

proptest! {
    #[test]
    fn damage_never_stops_the_reader_and_pieces_never_matter(
        damage in any_damage(),
        pieces in proptest::collection::vec(1_usize..200, 0..40),
    ) {
        reads_alike(&INFO, &damage.done_to(&Written::flight(40).0), pieces)?;
    }

    #[test]
    fn any_bytes_behind_a_header_are_survived(
        bytes in proptest::collection::vec(any::<u8>(), 0..2000),
    ) {
        reads_alike(&INFO, &[Written::new(7).0, bytes].concat(), vec![64])?;
    }
}
