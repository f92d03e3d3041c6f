//! The format WPML.

use super::format_info::{FormatInfo, HeldBeside};
use super::format_work::{FormatWork, Read};
use super::wpml::{NAME, read, write};
use super::written::WrittenFile;
use super::{fence, rally};

/// The format.
pub(super) const INFO: FormatInfo = FormatInfo {
    name: NAME,
    as_words: "a DJI mission (WPML)",
    extensions: &["kmz", "wpml"],
    is_told_by_extension: false,
    begins: None,
    is_mission: true,
    holds_tracks: false,
    beside: HeldBeside::Nothing,
};

/// Its reader and writers.
pub(super) const WORK: FormatWork = FormatWork {
    read: Read::Bytes(read),
    write: |places, frame| {
        let (bytes, mut notes) = write(&places.routes[0], frame)?;
        notes.extend(fence::left_out(&[], places.no_fly, frame));
        notes.extend(rally::left_out(places));
        Ok(WrittenFile { bytes, notes })
    },
    track: None,
};
