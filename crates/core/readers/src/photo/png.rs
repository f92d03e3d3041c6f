//! The chunks of a PNG file that say something of a photo: its size, EXIF (`eXIf`) and XMP (`iTXt`), which may stand
//! before or behind its pixels.

use pilotage_base::bytes::ByteSource;

pub(super) const SIGNATURE: &[u8; 8] = b"\x89PNG\r\n\x1a\n";
/// Longest chunk that is read, bytes, and most chunks that are looked at.
const LONGEST: u64 = 1 << 24;
const MOST_CHUNKS: usize = 1 << 14;
/// Begin of an `iTXt` chunk of XMP that is not compressed, up to its language.
const XMP: &[u8] = b"XML:com.adobe.xmp\0\0\0";

/// Contents of a PNG file besides its pixels.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct PngHead {
    /// The TIFF within that EXIF is; empty where there is none.
    pub exif: Vec<u8>,
    /// XMP, which is XML; empty where there is none.
    pub xmp: Vec<u8>,
    /// Width and height in pixels.
    pub size: Option<(usize, usize)>,
}

/// Looks at all chunks of a file; those whose check sum does not fit are passed over.
pub(super) fn png_head(source: &dyn ByteSource) -> Result<PngHead, String> {
    let mut head = PngHead::default();
    let mut at = SIGNATURE.len() as u64;
    for _ in 0..MOST_CHUNKS {
        let has_room = at.checked_add(12).is_some_and(|end| end <= source.length());
        if !has_room {
            break;
        }
        let begin = source.read(at, 8)?;
        let (Some(length), Some(kind)) = (begin.first_chunk::<4>(), begin.get(4..8)) else {
            break;
        };
        let length = u64::from(u32::from_be_bytes(*length));
        let is_told = matches!(kind, b"IHDR" | b"eXIf" | b"iTXt");
        let is_there = at + 12 + length <= source.length();
        if is_told && is_there && length <= LONGEST {
            let chunk = source.read(at + 4, length as usize + 8)?;
            if let Some((body, sum)) = chunk.split_last_chunk::<4>()
                && crc32fast::hash(body) == u32::from_be_bytes(*sum)
            {
                head.take(kind, &body[4..]);
            }
        }
        if kind == b"IEND" {
            break;
        }
        at += 12 + length;
    }
    Ok(head)
}

impl PngHead {
    fn take(&mut self, kind: &[u8], contents: &[u8]) {
        let side = |at: usize| {
            let bytes = contents.get(at..)?.first_chunk::<4>()?;
            usize::try_from(u32::from_be_bytes(*bytes))
                .ok()
                .filter(|side| *side > 0)
        };
        match kind {
            b"IHDR" => self.size = side(0).zip(side(4)),
            b"eXIf" if self.exif.is_empty() => {
                // Some programs leave the head of JPEG's segment before it.
                let tiff = contents.strip_prefix(b"Exif\0\0").unwrap_or(contents);
                self.exif = tiff.to_vec();
            }
            b"iTXt" if self.xmp.is_empty() => {
                let behind = contents.strip_prefix(XMP);
                // The language and the translated keyword end in a zero each.
                let text = behind.and_then(|rest| rest.splitn(3, |b| *b == 0).nth(2));
                self.xmp = text.unwrap_or_default().to_vec();
            }
            _ => {}
        }
    }
}
