//! The format KML.

use super::file_look::{Claim, FileForm, FileLook};
use super::format_info::{FormatInfo, HeldBeside, HeldTogether};
use super::format_work::{FormatWork, Read, TrackWork};
use super::kml_write::{UNDATED, write};
use super::written::WrittenFile;
use super::{flown_kml, kml_read};

/// The format.
pub(super) const INFO: FormatInfo = FormatInfo {
    name: "KML",
    as_words: "KML",
    extensions: &["kml"],
    anybodys: &[],
    maker: None,
    together: HeldTogether::Both,
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
