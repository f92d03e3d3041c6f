//! Damaged logs are read as far as they make sense, by every reader, in whatever pieces they come.

use std::sync::OnceLock;

use pilotage_core::flight::log::{LogFormatInfo, all_formats, recognise};
use pilotage_tests::logs::check::{checked, same};
use pilotage_tests::logs::corpus::{Sample, samples};
use pilotage_tests::logs::damage::{Damage, apply};
use proptest::collection::vec;
use proptest::prelude::*;

/// Every reader that there are logs for, with what it is tried on.
fn corpora() -> &'static [(&'static LogFormatInfo, Vec<Sample>)] {
    static CORPORA: OnceLock<Vec<(&'static LogFormatInfo, Vec<Sample>)>> = OnceLock::new();
    CORPORA.get_or_init(|| {
        let formats = all_formats().iter();
        let corpora = formats.map(|info| (info, samples(info.format)));
        corpora.filter(|(_, samples)| !samples.is_empty()).collect()
    })
}

#[test]
fn every_reader_recognises_its_own_logs_and_reads_them_clean() {
    assert!(corpora().len() >= 2);
    for (info, samples) in corpora() {
        for sample in samples {
            let found = recognise(&sample.bytes).map(|found| found.format);
            assert_eq!(found, Some(info.format));
            let log = checked(info, &sample.bytes, &[]).expect("whole logs are read");
            assert!(log.report.messages > 0, "{}", info.format.label());
        }
    }
}

#[test]
fn a_log_is_the_same_byte_by_byte_as_at_once() {
    for (info, samples) in corpora() {
        for sample in samples {
            let whole = checked(info, &sample.bytes, &[]).expect("whole logs are read");
            for step in [1, 7, 600] {
                let ends: Vec<usize> = (step..sample.bytes.len()).step_by(step).collect();
                let pieces = checked(info, &sample.bytes, &ends).expect("whole logs are read");
                same(&whole, &pieces).unwrap_or_else(|e| panic!("{}: {e}", info.format.label()));
            }
        }
    }
}

#[test]
fn a_log_may_be_cut_off_anywhere() {
    for (info, samples) in corpora() {
        for sample in samples {
            for end in (0..sample.bytes.len()).step_by(3) {
                let cut = checked(info, &sample.bytes[..end], &[]);
                cut.unwrap_or_else(|e| panic!("{}, {end} bytes: {e}", info.format.label()));
            }
        }
    }
}

fn damage() -> impl Strategy<Value = Damage> {
    let part = || 0.0..=1.0_f64;
    let bytes = || vec(any::<u8>(), 1..12);
    prop_oneof![
        4 => (part(), any::<u8>()).prop_map(|(at, bit)| Damage::Flip(at, bit)),
        2 => (part(), bytes()).prop_map(|(at, new)| Damage::Write(at, new)),
        1 => (part(), bytes()).prop_map(|(at, new)| Damage::Insert(at, new)),
        1 => part().prop_map(Damage::Truncate),
        1 => (part(), part()).prop_map(|(a, b)| Damage::Lose(a, b)),
        1 => (part(), part(), part()).prop_map(|(a, b, at)| Damage::Repeat(a, b, at)),
        1 => (part(), part()).prop_map(|(at, from)| Damage::Splice(at, from)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn truncated_flipped_and_spliced_logs_are_accounted_for_in_any_pieces(
        sample in any::<prop::sample::Index>(),
        other in any::<prop::sample::Index>(),
        damages in vec(damage(), 0..8),
        ends in vec(0.0..=1.0_f64, 0..6),
    ) {
        for (info, samples) in corpora() {
            let mut bytes = sample.get(samples).bytes.clone();
            for damage in &damages {
                apply(&mut bytes, damage, &other.get(samples).bytes);
            }
            let mut ends: Vec<usize> = ends.iter().map(|e| (e * bytes.len() as f64) as usize).collect();
            ends.sort_unstable();
            let whole = checked(info, &bytes, &[]).map_err(TestCaseError::fail)?;
            let pieces = checked(info, &bytes, &ends).map_err(TestCaseError::fail)?;
            same(&whole, &pieces).map_err(TestCaseError::fail)?;
        }
    }

    #[test]
    fn bytes_that_are_no_log_are_accounted_for(bytes in vec(any::<u8>(), 0..2000)) {
        for (info, _) in corpora() {
            checked(info, &bytes, &[]).map_err(TestCaseError::fail)?;
        }
    }
}
