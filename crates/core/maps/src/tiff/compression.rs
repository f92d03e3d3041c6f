//! Packings of tiles and strips.

use super::{Directory, Tag, TiffError};

/// Packing of the bytes of a tile or strip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compression {
    /// Not at all.
    None,
    /// LZW.
    Lzw,
    /// JPEG with shared tables.
    Jpeg,
    /// Deflate, as in zip.
    Deflate,
    /// Runs of equal bytes.
    PackBits,
    /// Zstandard.
    Zstandard,
    /// `WebP`.
    WebP,
    /// LERC, bare or packed once more.
    Lerc(LercWrap),
}

/// Compression around LERC's bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LercWrap {
    /// Nothing.
    None,
    /// Deflate.
    Deflate,
    /// Zstandard.
    Zstandard,
}

/// The packing of tiles and strips that the directory states; those that are not read are refused by name.
pub(super) fn compression(directory: &Directory) -> Result<Compression, TiffError> {
    Ok(match directory.number(Tag::Compression)?.unwrap_or(1) {
        1 => Compression::None,
        5 => Compression::Lzw,
        7 => Compression::Jpeg,
        8 | 32_946 => Compression::Deflate,
        32_773 => Compression::PackBits,
        50_000 => Compression::Zstandard,
        50_001 => Compression::WebP,
        34_887 => Compression::Lerc(lerc_wrap(directory)?),
        other => {
            let name = match other {
                2..=4 => "CCITT fax, ",
                6 => "old-style JPEG, ",
                34_712 | 33_003 | 33_005 => "JPEG 2000, ",
                34_925 => "LZMA, ",
                50_002 => "JPEG XL, ",
                _ => "",
            };
            return Err(directory
                .blame(&Tag::Compression.name())
                .unsupported(format!(
                    "{name}method {other} is not read; export it with deflate, LZW, Zstandard, JPEG, WebP, LERC or none"
                )));
        }
    })
}

fn lerc_wrap(directory: &Directory) -> Result<LercWrap, TiffError> {
    let parameters = directory.numbers(Tag::LercParameters)?;
    Ok(match parameters.get(1).copied().unwrap_or(0) {
        0 => LercWrap::None,
        1 => LercWrap::Deflate,
        2 => LercWrap::Zstandard,
        other => {
            let name = Tag::LercParameters.name();
            return Err(directory.blame(&name).unsupported(format!(
                "LERC within method {other} is not read; export it with deflate"
            )));
        }
    })
}
