//! Checks that must hold of every reader, whatever it reads.

use pilotage_core::flight::log::{Log, LogFormatInfo};

/// Bytes of memory that a byte of a file may cost at the most: a line of text that says hardly anything
/// still becomes a row.
const MEMORY_PER_BYTE: usize = 64;
/// Bytes of memory that any log may cost.
const MEMORY: usize = 1 << 17;

/// Reads a file in pieces that end at `ends` (and at its end).
pub fn read(info: &LogFormatInfo, bytes: &[u8], ends: &[usize]) -> Log {
    let mut reader = (info.reader)();
    let mut log = Log::new("log", info.format);
    let mut start = 0;
    for end in ends.iter().copied().chain([bytes.len()]) {
        let end = end.clamp(start, bytes.len());
        reader.feed(&bytes[start..end], &mut log);
        start = end;
    }
    reader.finish(&mut log);
    log
}

/// Reads a file and says what is wrong with its log.
///
/// # Errors
/// In words, if bytes are not accounted for, topics contradict themselves, or the memory is out of
/// proportion.
pub fn checked(info: &LogFormatInfo, bytes: &[u8], ends: &[usize]) -> Result<Log, String> {
    let log = read(info, bytes, ends);
    let report = &log.report;
    let length = bytes.len() as u64;
    if report.bytes != length {
        return Err(format!("{} bytes of {length} were looked at", report.bytes));
    }
    let (used, skipped) = (report.used_bytes, report.skipped_bytes);
    if used + skipped != length {
        return Err(format!(
            "{used} bytes used and {skipped} skipped of {length}"
        ));
    }
    let mut before = 0;
    for place in &report.skipped {
        if place.bytes == 0 || place.offset < before || place.offset + place.bytes > length {
            return Err(format!("skipped out of order: {place:?}"));
        }
        before = place.offset + place.bytes;
    }
    let remembered: u64 = report.skipped.iter().map(|place| place.bytes).sum();
    if report.skipped.len() as u64 == report.skipped_places && remembered != skipped {
        return Err(format!(
            "{remembered} skipped bytes remembered of {skipped}"
        ));
    }
    for topic in &log.topics {
        if topic.times.len() != topic.rows.len() {
            return Err(format!("{}: as many times as rows", topic.name));
        }
        let width = topic.rows.width();
        let reaches = |f: &_| field_end(f) > width;
        if let Some(field) = topic.fields.iter().find(|f| reaches(f)) {
            return Err(format!(
                "{}.{} reaches out of its row",
                topic.name, field.name
            ));
        }
    }
    let unpacked = report.unpacked_bytes as usize;
    if log.memory() > MEMORY + MEMORY_PER_BYTE * (bytes.len() + unpacked) {
        return Err(format!(
            "{} bytes of memory for {length} and {unpacked} unpacked",
            log.memory()
        ));
    }
    Ok(log)
}

fn field_end(field: &pilotage_core::flight::log::FieldLayout) -> usize {
    field.offset + field.kind.size()
}

/// Says where two logs differ, which were read from the same bytes in other pieces.
///
/// # Errors
/// In words, if they do.
pub fn same(one: &Log, other: &Log) -> Result<(), String> {
    let differs = |what: &str, a: String, b: String| {
        if a == b {
            Ok(())
        } else {
            Err(format!("{what} differ between pieces: {a} and {b}"))
        }
    };
    let names = |log: &Log| {
        format!(
            "{:?}",
            log.topics.iter().map(|t| &t.name).collect::<Vec<_>>()
        )
    };
    differs("topics", names(one), names(other))?;
    for (a, b) in one.topics.iter().zip(&other.topics) {
        if a.fields != b.fields {
            return Err(format!("the fields of {} differ between pieces", a.name));
        }
        let bits = |times: &[f64]| times.iter().map(|t| t.to_bits()).collect::<Vec<_>>();
        if a.rows != b.rows || bits(&a.times) != bits(&b.times) {
            return Err(format!("the rows of {} differ between pieces", a.name));
        }
    }
    let rest = |log: &Log| {
        format!(
            "{:?} {:?} {:?} {:?} {:?}",
            log.utc_at_zero, log.vehicle, log.parameters, log.messages, log.modes
        )
    };
    differs("contents", rest(one), rest(other))?;
    differs(
        "reports",
        format!("{:?}", one.report),
        format!("{:?}", other.report),
    )
}
