//! Corpus that a format's reader is tried on: small logs, real and made.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use pilotage_core::flight::log::{LogFormat, recognise};

use super::dataflash::Form;
use super::made;
use super::mcap::{self, McapPacking};
use super::tlog;
use crate::data::shared;

/// Bytes of a real log that are taken from its beginning, its middle and its end.
const PIECE: usize = 1500;

/// A log and the places between its messages.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The file.
    pub bytes: Vec<u8>,
    /// Places at which messages begin, as parts of its length.
    pub seams: Vec<f64>,
}

/// Small logs of a format.
pub fn samples(format: LogFormat) -> Vec<Sample> {
    let mut files: Vec<Vec<u8>> = Vec::new();
    match format {
        LogFormat::Dataflash => {
            files.extend((0..8).map(|seed| thinned(&made::modern(Form::Binary, seed, 30), seed)));
            files.push(made::modern(Form::Binary, 8, 7));
            files.push(thinned(&made::of_2013(Form::Binary, 12), 0));
            for log in real_logs(format) {
                files.extend((0..4).map(|seed| thinned(&log, seed)));
            }
        }
        LogFormat::DataflashText => {
            let modern = |seed| thinned_text(&made::modern(Form::Text, seed, 30), seed);
            files.extend((0..8).map(modern));
            files.push(made::modern(Form::Text, 8, 7));
            files.push(thinned_text(&made::of_2013(Form::Text, 12), 0));
        }
        LogFormat::Mcap => {
            for packing in McapPacking::ALL {
                files.extend(
                    [(4, 4), (9, 4), (30, 15)]
                        .map(|(count, chunk)| mcap::file(packing, count, chunk)),
                );
            }
        }
        LogFormat::Tlog => {
            let file = |(version, count)| tlog::file(version, count);
            files.extend([(1, 7), (1, 40), (2, 7), (2, 40)].map(file));
        }
        // Recorded ones, and the example in the folder of the format. Logs made of tables and photos have no files.
        _ => {
            for log in real_logs(format) {
                let middle = log.len() / 2;
                files.push(log[..log.len().min(2 * PIECE)].to_vec());
                let parts = [
                    &log[..log.len().min(PIECE)],
                    &log[middle..log.len().min(middle + PIECE)],
                ];
                files.push(parts.concat());
            }
        }
    }
    let sample = |bytes: Vec<u8>| Sample {
        seams: seams(format, &bytes),
        bytes,
    };
    files.into_iter().map(sample).collect()
}

/// Recorded logs of a format, whatever their names, and files named `example` in the folders of formats.
fn real_logs(format: LogFormat) -> Vec<Vec<u8>> {
    let entries = |folder: PathBuf| std::fs::read_dir(folder).into_iter().flatten().flatten();
    let folders = ["ardupilot_bin", "px4_ulog"].into_iter().filter_map(shared);
    let recorded = folders.flat_map(entries).map(|entry| entry.path());
    let formats = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../crates/core/readers/src/log"
    );
    let examples = entries(formats.into()).flat_map(|folder| entries(folder.path()));
    let examples = examples.map(|entry| entry.path());
    let examples = examples.filter(|path| path.file_stem().is_some_and(|stem| stem == "example"));
    let mut paths: Vec<_> = recorded.chain(examples).collect();
    paths.sort();
    let files = paths.iter().filter_map(|path| std::fs::read(path).ok());
    files
        .filter(|bytes| {
            recognise(&bytes[..bytes.len().min(4096)]).is_some_and(|i| i.format == format)
        })
        .collect()
}

/// Places where messages may begin, as parts of the file's length.
fn seams(format: LogFormat, bytes: &[u8]) -> Vec<f64> {
    let begins = |at: usize| match format {
        LogFormat::Dataflash => bytes[at..].starts_with(&[0xa3, 0x95]),
        // A kind of record and the upper bytes of its length.
        LogFormat::Mcap => {
            let upper = bytes.get(at + 3..at + 9);
            (1..16).contains(&bytes[at]) && upper.is_some_and(|upper| upper.iter().all(|b| *b == 0))
        }
        // The upper bytes of a time before one of the two versions.
        LogFormat::Tlog => bytes[at] == 0 && matches!(bytes.get(at + 8), Some(0xfd | 0xfe)),
        LogFormat::DataflashText => at > 0 && matches!(bytes[at - 1], b'\n' | b','),
        _ => at.is_multiple_of(16),
    };
    let places = (0..bytes.len()).filter(|at| begins(*at));
    // A little behind the very part, so that no rounding falls short of it.
    places
        .map(|at| (at as f64 + 0.01) / bytes.len() as f64)
        .collect()
}

/// Cuts a binary log into its messages.
fn messages(log: &[u8]) -> Vec<&[u8]> {
    let starts: Vec<usize> = (0..log.len().saturating_sub(2))
        .filter(|at| log[*at..].starts_with(&[0xa3, 0x95]))
        .chain([log.len()])
        .collect();
    starts
        .windows(2)
        .map(|pair| &log[pair[0]..pair[1]])
        .collect()
}

/// Rest of a log if few kinds of message stay, and of each a few, chosen by the seed. The announcements of
/// kinds that went stay away, too.
fn thinned(log: &[u8], seed: u64) -> Vec<u8> {
    let kept = thin(&messages(log), seed, |message| {
        let byte = |at: usize| message.get(at).copied().unwrap_or_default();
        let kind = if byte(2) == 0x80 { byte(3) } else { byte(2) };
        (u64::from(kind), byte(2) == 0x80)
    });
    kept.concat()
}

/// The same of a log that is text.
fn thinned_text(log: &[u8], seed: u64) -> Vec<u8> {
    let lines: Vec<&[u8]> = log.split_inclusive(|b| *b == b'\n').collect();
    let kept = thin(&lines, seed, |line| {
        let mut values = line.split(|b| *b == b',').map(<[u8]>::trim_ascii);
        let name = values.next().unwrap_or_default();
        let announced = values.nth(2).filter(|_| name == b"FMT");
        let kind = announced.unwrap_or(name).iter();
        let kind = kind.fold(7_u64, |h, b| h.wrapping_mul(31) + u64::from(*b));
        (kind, announced.is_some())
    });
    kept.concat()
}

/// Messages of about eight kinds, five of each at the most. `kind` says which kind a message is of or
/// announces, and whether it announces it.
fn thin<'a>(
    messages: &[&'a [u8]],
    seed: u64,
    kind: impl Fn(&[u8]) -> (u64, bool),
) -> Vec<&'a [u8]> {
    let kinds: BTreeSet<u64> = messages.iter().map(|m| kind(m).0).collect();
    let share = (kinds.len() as u64 / 8).max(1);
    let stays = |kind: u64| {
        let mixed = (kind ^ (seed << 8)).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32;
        mixed.is_multiple_of(share)
    };
    let mut counts: BTreeMap<u64, u32> = BTreeMap::new();
    let mut kept = Vec::new();
    for message in messages {
        let (kind, announces) = kind(message);
        let count = counts.entry(kind).or_default();
        if stays(kind) && (announces || *count < 5) {
            *count += u32::from(!announces);
            kept.push(*message);
        }
    }
    kept
}
