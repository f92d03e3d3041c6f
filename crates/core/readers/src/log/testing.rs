//! Helpers of the tests of all readers: reading a file in pieces, and damaging one.

use proptest::{collection::vec, prelude::*, sample::Index};

use super::{Log, LogFormatInfo};

/// Reads a file in pieces of that length.
pub(super) fn read(info: &LogFormatInfo, file: &[u8], piece: usize) -> Log {
    read_in(info, file, std::iter::repeat(piece.max(1)))
}

/// Reads a file in pieces of those lengths.
pub(super) fn read_in(
    info: &LogFormatInfo,
    file: &[u8],
    pieces: impl IntoIterator<Item = usize>,
) -> Log {
    let mut log = Log::new("flight", info.format);
    let mut reader = (info.reader)();
    let mut rest = file;
    for piece in pieces {
        if rest.is_empty() {
            break;
        }
        let (now, later) = rest.split_at(piece.min(rest.len()));
        reader.feed(now, &mut log);
        rest = later;
    }
    reader.feed(rest, &mut log);
    reader.finish(&mut log);
    log
}

/// Rows of all topics.
pub(super) fn rows(log: &Log) -> usize {
    log.topics.iter().map(super::Topic::len).sum()
}

/// Everything in a log, to be compared with that of another reading of the same file.
pub(super) fn essence(log: &Log) -> String {
    let rows = |topic: &super::Topic| {
        let rows: Vec<_> = topic.rows.iter().map(<[u8]>::to_vec).collect();
        format!(
            "{} {:?} {:?} {rows:?}\n",
            topic.name, topic.fields, topic.times
        )
    };
    let topics: String = log.topics.iter().map(rows).collect();
    format!(
        "{:?}\n{topics}{:?}\n{:?}\n{:?}\n{:?}\n{:?}\n{} {:?}",
        log.report,
        log.parameters,
        log.defaults,
        log.facts,
        log.messages,
        log.modes,
        log.vehicle,
        log.utc_at_zero
    )
}

/// Damage that may be done to a file.
#[derive(Clone, Debug)]
pub(super) struct Damage {
    flips: Vec<(Index, u8)>,
    copied: Option<(Index, Index, Index)>,
    cut: Option<Index>,
}

/// Any damage: some bytes changed, a piece of the file put in elsewhere, the end cut off.
pub(super) fn any_damage() -> impl Strategy<Value = Damage> {
    (
        vec(any::<(Index, u8)>(), 0..12),
        any::<Option<(Index, Index, Index)>>(),
        any::<Option<Index>>(),
    )
        .prop_map(|(flips, copied, cut)| Damage { flips, copied, cut })
}

impl Damage {
    /// The file with the damage done to it.
    pub fn done_to(&self, file: &[u8]) -> Vec<u8> {
        let mut file = file.to_vec();
        for (place, bits) in &self.flips {
            let place = place.index(file.len());
            file[place] ^= bits;
        }
        if let Some((from, to, at)) = &self.copied {
            let (from, to) = (from.index(file.len()), to.index(file.len()));
            let piece = file[from.min(to)..from.max(to)].to_vec();
            let at = at.index(file.len());
            file.splice(at..at, piece);
        }
        if let Some(cut) = &self.cut {
            file.truncate(cut.index(file.len()));
        }
        file
    }
}

/// Reads a damaged file at once, byte by byte and in `pieces`, and fails where that is not the same.
pub(super) fn reads_alike(
    info: &LogFormatInfo,
    file: &[u8],
    pieces: Vec<usize>,
) -> Result<(), TestCaseError> {
    let whole = read(info, file, file.len());
    prop_assert_eq!(whole.report.bytes, file.len() as u64);
    let told = whole.report.used_bytes + whole.report.skipped_bytes;
    prop_assert_eq!(told, whole.report.bytes, "{:?}", whole.report);
    let whole = essence(&whole);
    prop_assert_eq!(&essence(&read(info, file, 1)), &whole);
    prop_assert_eq!(&essence(&read_in(info, file, pieces)), &whole);
    Ok(())
}
