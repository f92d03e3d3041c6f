//! A log read from its beginning to its end.

use super::{HEAD, Log, recognise};
use pilotage_base::bytes::ByteSource;

/// Bytes that are read at a time.
const PIECE: u64 = 4 << 20;

/// Everything in the file, or `None` if it is no log; the error says in words why its bytes cannot be had.
///
/// ```
/// use pilotage_readers::bytes::MemoryBytes;
/// use pilotage_readers::log::read_log;
///
/// // ArduPilot's log as text: kinds of messages announce themselves.
/// let text = "FMT, 1, 13, ATT, Qcc, TimeUS,Roll,Yaw\n\
///             ATT, 1000000, 1.5, 90.0\n\
///             ATT, 1500000, -2.25, 91.0\n";
/// let log = read_log(&MemoryBytes::new("flight.log", text.as_bytes()))?.ok_or("no log")?;
/// let attitude = log.first("ATT").ok_or("no attitude")?;
/// assert_eq!(attitude.times, [1.0, 1.5]);
/// assert_eq!(attitude.values("Roll"), Some(vec![1.5, -2.25]));
/// # Ok::<(), String>(())
/// ```
pub fn read_log(source: &dyn ByteSource) -> Result<Option<Log>, String> {
    let length = source.length();
    let head = source.read(0, (HEAD as u64).min(length) as usize)?;
    let Some(info) = recognise(&head) else {
        return Ok(None);
    };
    let mut log = Log::new(source.name(), info.format);
    let mut reader = (info.reader)();
    let mut offset = 0;
    while offset < length {
        let bytes = source.read(offset, PIECE.min(length - offset) as usize)?;
        reader.feed(&bytes, &mut log);
        offset += bytes.len() as u64;
    }
    reader.finish(&mut log);
    Ok(Some(log))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_base::bytes::MemoryBytes;

    #[test]
    fn a_file_that_is_no_log_is_none() {
        for bytes in [&b""[..], b"x", b"Dear engineer, this is no log.\n"] {
            let source = MemoryBytes::new("letter.bin", bytes);
            assert!(matches!(read_log(&source), Ok(None)));
        }
    }
}
