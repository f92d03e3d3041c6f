//! The formats KML and KMZ.

use super::format_info::{FormatInfo, HeldBeside};
use super::format_work::{FormatWork, Read, TrackWork};
use super::kml_write::{pack, write};
use super::written::WrittenFile;
use super::{flown_kml, kml_read};

/// Note of a flown track without a date.
const UNDATED: &str = "the date is not known: times are counted from 1970-01-01T00:00:00Z";

/// The format.
pub(super) const KML: FormatInfo = FormatInfo {
    name: "KML",
    as_words: "KML",
    extensions: &["kml"],
    is_told_by_extension: true,
    begins: None,
    is_mission: false,
    holds_tracks: true,
    beside: HeldBeside::AreasAndRally,
};

/// Its reader and writers.
pub(super) const KML_WORK: FormatWork = FormatWork {
    read: Read::Text(kml_read::read),
    write: |places, frame| Ok(WrittenFile::of_text(write(places, frame))),
    track: Some(TrackWork {
        write: |track| Ok(flown_kml::write(track).into_bytes()),
        undated: Some(UNDATED),
    }),
};

/// The same, zipped.
pub(super) const KMZ: FormatInfo = FormatInfo {
    name: "KMZ",
    as_words: "KMZ",
    extensions: &["kmz"],
    is_told_by_extension: true,
    begins: None,
    is_mission: false,
    holds_tracks: true,
    beside: HeldBeside::AreasAndRally,
};

/// Its reader and writers.
pub(super) const KMZ_WORK: FormatWork = FormatWork {
    read: Read::Bytes(kml_read::read_packed),
    write: |places, frame| {
        let (text, notes) = write(places, frame);
        let bytes = pack(&text)?;
        Ok(WrittenFile { bytes, notes })
    },
    track: Some(TrackWork {
        write: |track| pack(&flown_kml::write(track)),
        undated: Some(UNDATED),
    }),
};
