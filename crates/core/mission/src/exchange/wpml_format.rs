//! The format WPML.

use super::format_info::FormatInfo;
use super::format_work::{FormatWork, Read};
use super::wpml::{read, write};
use super::written::Written;
use super::{Format, fence};

/// The format.
pub(super) const INFO: FormatInfo = FormatInfo {
    format: Format::Wpml,
    name: "DJI WPML",
    as_words: "a mission of DJI (WPML)",
    extensions: &["kmz"],
    is_told_by_extension: false,
    is_mission: true,
    holds_tracks: false,
};

/// Its reader and writers.
pub(super) const WORK: FormatWork = FormatWork {
    format: INFO.format,
    read: Read::Bytes(read),
    write: |places, frame| {
        let (bytes, mut notes) = write(&places.routes[0], frame)?;
        notes.extend(fence::left_out(&[], places.no_fly, frame));
        Ok(Written { bytes, notes })
    },
    track: None,
};
