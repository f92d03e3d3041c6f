//! The format WPML.

use super::file_look::{Claim, FileForm, FileLook};
use super::format_info::{FormatInfo, HeldBeside, HeldTogether};
use super::format_work::{FormatWork, Read};
use super::wpml::{NAME, is_text, is_zip, read, write};
use super::written::WrittenFile;
use super::{fence, rally};

/// The format.
pub(super) const INFO: FormatInfo = FormatInfo {
    name: NAME,
    as_words: "a DJI mission (WPML)",
    extensions: &["kmz", "wpml"],
    anybodys: &[],
    maker: Some("dji"),
    together: HeldTogether::Mission,
    holds_tracks: false,
    beside: HeldBeside::Nothing,
};

/// It is a kind of KML, or of a zip with that.
fn claims(look: &FileLook<'_>) -> Claim {
    match look.form {
        FileForm::Zip if is_zip(look) => Claim::Special,
        FileForm::Xml if is_text(look.head) => Claim::Special,
        _ => Claim::None,
    }
}

/// Its reader and writers.
pub(super) const WORK: FormatWork = FormatWork {
    claims,
    read: Read::Bytes(read),
    write: |places, frame| {
        let (bytes, mut notes) = write(&places.routes[0], frame)?;
        notes.extend(fence::left_out(&[], places.no_fly, frame));
        notes.extend(rally::left_out(places));
        Ok(WrittenFile { bytes, notes })
    },
    track: None,
};
