//! The format KML.

use super::file_look::{Claim, FileForm, FileLook};
use super::format_info::{FormatInfo, HeldBeside};
use super::format_work::{FormatWork, Read, TrackWork};
use super::kml_write::write;
use super::written::WrittenFile;
use super::{flown_kml, kml_read};

/// Note of a flown track without a date.
pub(super) const UNDATED: &str =
    "the date is not known: times are counted from 1970-01-01T00:00:00Z";

/// The format.
pub(super) const INFO: FormatInfo = FormatInfo {
    name: "KML",
    as_words: "KML",
    extensions: &["kml"],
    is_told_by_extension: true,
    is_mission: false,
    holds_tracks: true,
    beside: HeldBeside::AreasAndRally,
};

fn claims(look: &FileLook<'_>) -> Claim {
    match look.form {
        FileForm::Xml if look.head.contains("<kml") || look.head.contains(":kml") => Claim::Likely,
        FileForm::Xml if look.is_named(&INFO) => Claim::Named,
        _ => look.named_text(&INFO),
    }
}

/// Its reader and writers.
pub(super) const WORK: FormatWork = FormatWork {
    claims,
    read: Read::Text(kml_read::read),
    write: |places, frame| Ok(WrittenFile::of_text(write(places, frame))),
    track: Some(TrackWork {
        write: |track| Ok(flown_kml::write(track).into_bytes()),
        undated: Some(UNDATED),
    }),
};
