//! Tests of reading damaged files.

use proptest::prelude::*;

use super::super::super::{
    Log,
    testing::{self, any_damage, reads_alike, rows},
};
use super::super::INFO;
use super::written::Written;

fn read(file: &[u8]) -> Log {
    testing::read(&INFO, file, 1000)
}

#[test]
fn a_file_cut_off_anywhere_keeps_every_whole_message() {
    let file = Written::flight(20).bytes;
    let mut before = 0;
    for end in 0..=file.len() {
        let found = rows(&read(&file[..end]));
        assert!(found == before || found == before + 1);
        before = found;
    }
    assert_eq!(before, 22);
}

#[test]
fn one_wrong_byte_costs_one_message_and_is_told() {
    let file = Written::flight(20).bytes;
    for place in 0..file.len() {
        for flip in [0xff, 0x01, 0x80] {
            let mut damaged = file.clone();
            damaged[place] ^= flip;
            let log = read(&damaged);
            let found = rows(&log);
            assert!(found >= 21, "byte {place}: {:?}", log.report);
            let is_told = !log.report.is_clean() || !log.report.remarks.is_empty();
            assert!(found == 22 || is_told);
        }
    }
}

#[test]
fn a_log_whose_first_time_is_damaged_is_known_and_counts_from_the_second() {
    let mut file = Written::flight(30).bytes;
    file[0] ^= 0x7f;
    assert!((INFO.begins)(&file));
    let log = read(&file);
    assert!(rows(&log) >= 31);
    let (first, last) = log.span().unwrap();
    assert!(first.abs() < 1.0 && last < 10.0, "{first} to {last}");
}

#[test]
fn a_time_far_from_its_neighbours_is_left_out_but_a_later_flight_is_not() {
    let mut file = Written::flight(9).bytes;
    let stamp = file.len();
    file.extend(Written::flight(1).bytes);
    // Two years later, for one message.
    file[stamp + 1] ^= 0;
    file[stamp + 2] ^= 0x40;
    file.extend(Written::flight(9).bytes);
    let log = read(&file);
    let latest = log.span().map(|(_, last)| last);
    assert_eq!(latest, Some(0.8));
    let mut later = Written::flight(9);
    let flight = later.bytes.clone();
    for (start, _) in flight
        .iter()
        .enumerate()
        .filter(|(i, _)| is_stamp(&flight, *i))
    {
        later.bytes[start + 2] ^= 0x40;
    }
    let log = read(&[flight, later.bytes].concat());
    assert_eq!(rows(&log), 20);
    assert!(log.span().is_some_and(|(_, last)| last > 1e6));
}

fn is_stamp(file: &[u8], place: usize) -> bool {
    let head = super::written::START.to_be_bytes();
    file[place..].starts_with(&head[..4])
}

#[test]
fn kinds_that_are_not_known_are_told_once_each_and_stepped_over() {
    let mut file = Written::new();
    for time in 0..5 {
        file = file
            .heartbeat(time, 1, 3, 0)
            .version_2(time, 65_000, &[&[1, 2]]);
    }
    let log = read(&file.bytes);
    assert_eq!(rows(&log), 5);
    assert_eq!(log.report.skipped_places, 5);
    assert_eq!(log.report.remarks, ["messages of kind 65000 are not known"]);
}

#[test]
fn a_crowd_of_senders_does_not_fill_the_memory() {
    let mut file = Written::new();
    for system in 0..=255 {
        for component in 0..45 {
            file = file.from(system, component).version_2(0, 0, &[&[1]]);
        }
    }
    let log = read(&file.bytes);
    assert_eq!(log.topics.len(), 10_000);
    assert_eq!(
        log.report.messages + log.report.skipped_bytes / 21,
        256 * 45
    );
}

proptest! {
    #[test]
    fn damage_never_stops_the_reader_and_pieces_never_matter(
        damage in any_damage(),
        pieces in proptest::collection::vec(1_usize..200, 0..40),
    ) {
        let file = Written::flight(40).words(5_000_000, 3, "words", 0, 0);
        let file = file.parameter(6_000_000, "P", [1, 2, 3, 4], 6);
        reads_alike(&INFO, &damage.done_to(&file.bytes), pieces)?;
    }

    #[test]
    fn any_bytes_behind_a_message_are_survived(
        bytes in proptest::collection::vec(prop_oneof![Just(0), Just(0xfd), Just(0xfe), any::<u8>()], 0..2000),
    ) {
        reads_alike(&INFO, &[Written::flight(1).bytes, bytes].concat(), vec![64])?;
    }
}
