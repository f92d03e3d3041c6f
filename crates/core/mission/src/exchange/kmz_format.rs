//! The format KMZ: KML, zipped.

use super::file_look::{Claim, FileForm, FileLook};
use super::format_info::{FormatInfo, HeldBeside, HeldTogether};
use super::format_work::{FormatWork, Read, TrackWork};
use super::kml_write::{UNDATED, pack, write};
use super::written::WrittenFile;
use super::{flown_kml, kml_read};

/// The format.
pub(super) const INFO: FormatInfo = FormatInfo {
    name: "KMZ",
    as_words: "KMZ",
    extensions: &["kmz"],
    anybodys: &[],
    maker: None,
    together: HeldTogether::Both,
    holds_tracks: true,
    beside: HeldBeside::AreasAndRally,
};

/// A zip of that name, or in whose list there is a document of KML.
fn claims(look: &FileLook<'_>) -> Claim {
    match look.form {
        FileForm::Zip if look.is_named(&INFO) || look.has(b".kml") => Claim::Likely,
        _ => look.named_text(&INFO),
    }
}

/// Its reader and writers.
pub(super) const WORK: FormatWork = FormatWork {
    claims,
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
