//! Report of all that a reader could not use.

use serde::{Deserialize, Serialize};

/// Most places and gaps that are remembered one by one.
const REMEMBERED: usize = 1000;
/// Most remarks.
const REMARKS: usize = 100;

/// Bytes that made no sense.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Skipped {
    /// First byte in the file.
    pub offset: u64,
    /// Number of bytes.
    pub bytes: u64,
    /// Why, in words.
    pub cause: String,
}

/// A time in which the logger lost rows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoggerDropout {
    /// Seconds in the log's time base at which it was noted.
    pub time: f64,
    /// Duration, seconds.
    pub duration: f64,
}

/// Bytes and messages that were read, and those that were not.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ReadReport {
    /// Bytes looked at.
    pub bytes: u64,
    /// Messages read.
    pub messages: u64,
    /// Bytes that made sense. With [`skipped_bytes`](Self::skipped_bytes) they are all the bytes of a
    /// file that is over.
    pub used_bytes: u64,
    /// Bytes that came out of parts of the file that were packed.
    pub unpacked_bytes: u64,
    /// The first thousand places that were skipped, in the order of the file.
    pub skipped: Vec<Skipped>,
    /// All bytes that were skipped.
    pub skipped_bytes: u64,
    /// All places that were skipped.
    pub skipped_places: u64,
    /// The first thousand gaps that the logger itself noted.
    pub gaps: Vec<LoggerDropout>,
    /// All gaps that the logger noted.
    pub gap_count: u64,
    /// All of them together, seconds.
    pub gap_duration: f64,
    /// Remarks that people should know beside those, in words: a file cut off, times that go back. A hundred
    /// at the most.
    pub remarks: Vec<String>,
    /// The last place that was skipped, remembered or not.
    last: Option<Skipped>,
}

impl ReadReport {
    /// Notes a message of so many bytes.
    #[inline]
    pub fn message(&mut self, bytes: usize) {
        self.messages += 1;
        self.used_bytes += bytes as u64;
    }

    /// Notes that `bytes` from `offset` on were skipped. What follows right after the last place for
    /// the same reason joins it.
    pub fn skip(&mut self, offset: u64, bytes: u64, cause: &str) {
        self.skipped_bytes += bytes;
        if let Some(last) = &mut self.last
            && last.offset + last.bytes == offset
            && last.cause == cause
        {
            last.bytes += bytes;
            if self.skipped_places <= REMEMBERED as u64
                && let Some(remembered) = self.skipped.last_mut()
            {
                remembered.bytes += bytes;
            }
            return;
        }
        self.skipped_places += 1;
        let place = Skipped {
            offset,
            bytes,
            cause: cause.to_owned(),
        };
        if self.skipped.len() < REMEMBERED {
            self.skipped.push(place.clone());
        }
        self.last = Some(place);
    }

    /// Notes that the logger lost rows for `duration` seconds before `time`.
    pub fn gap(&mut self, time: f64, duration: f64) {
        self.gap_count += 1;
        self.gap_duration += duration;
        if self.gaps.len() < REMEMBERED {
            self.gaps.push(LoggerDropout { time, duration });
        }
    }

    /// Notes something for people, once; what comes after a hundred remarks is left out.
    pub fn remark(&mut self, remark: impl Into<String>) {
        let remark = remark.into();
        if self.remarks.len() < REMARKS && !self.remarks.contains(&remark) {
            self.remarks.push(remark);
        }
    }

    /// Whether every byte made sense.
    pub fn is_clean(&self) -> bool {
        self.skipped_places == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbouring_bytes_skipped_for_one_reason_are_one_place() {
        let mut report = ReadReport::default();
        report.skip(10, 1, "no message begins here");
        report.skip(11, 2, "no message begins here");
        report.skip(20, 5, "no message begins here");
        report.skip(25, 5, "a message is cut off");
        assert_eq!(report.skipped_places, 3);
        assert_eq!(report.skipped_bytes, 13);
        assert_eq!((report.skipped[0].offset, report.skipped[0].bytes), (10, 3));
        assert!(!report.is_clean());
    }

    #[test]
    fn a_thousand_places_are_remembered_and_all_are_counted() {
        let mut report = ReadReport::default();
        for i in 0..3000 {
            report.skip(10 * i, 1, "noise");
            report.skip(10 * i + 1, 1, "noise");
        }
        assert_eq!(report.skipped.len(), 1000);
        assert!(report.skipped.iter().all(|place| place.bytes == 2));
        assert_eq!((report.skipped_places, report.skipped_bytes), (3000, 6000));
    }

    #[test]
    fn gaps_are_added_up() {
        let mut report = ReadReport::default();
        report.gap(5.0, 0.25);
        report.gap(9.0, 0.5);
        assert_eq!((report.gap_count, report.gap_duration), (2, 0.75));
        assert_eq!(report.gaps[1].time, 9.0);
    }

    #[test]
    fn remarks_are_made_once_and_never_without_end() {
        let mut report = ReadReport::default();
        for i in 0..1000 {
            report.remark(format!("remark {}", i / 2));
        }
        assert_eq!(report.remarks.len(), 100);
        assert_eq!(report.remarks[99], "remark 99");
    }
}
