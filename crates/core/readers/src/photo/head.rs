//! The segments of a JPEG file before its picture.

/// Contents of the head of a JPEG file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct JpegHead<'a> {
    /// The TIFF within that EXIF is.
    pub exif: Option<&'a [u8]>,
    /// XMP, which is XML.
    pub xmp: Option<&'a [u8]>,
    /// Width and height in pixels.
    pub size: Option<(usize, usize)>,
}

const EXIF: &[u8] = b"Exif\0\0";
const XMP: &[u8] = b"http://ns.adobe.com/xap/1.0/\0";

/// Head of the file that `bytes` begin, as far as it is there.
pub(super) enum HeadSearch<'a> {
    /// It is all there.
    Whole(JpegHead<'a>),
    /// It goes on behind these bytes; what there is so far.
    Part(JpegHead<'a>),
    /// They are no JPEG.
    None,
}

/// Looks at the segments up to the one that says how large the picture is.
pub(super) fn head(bytes: &[u8]) -> HeadSearch<'_> {
    if !bytes.starts_with(&[0xff, 0xd8]) {
        return HeadSearch::None;
    }
    let mut head = JpegHead::default();
    let mut rest = &bytes[2..];
    loop {
        // Any number of 0xff may stand before a marker.
        let Some(marker) = rest.iter().position(|b| *b != 0xff) else {
            return HeadSearch::Part(head);
        };
        if marker == 0 {
            return HeadSearch::Whole(head);
        }
        let kind = rest[marker];
        rest = &rest[marker + 1..];
        match kind {
            // Markers that nothing belongs to.
            0x01 | 0xd0..=0xd7 => continue,
            // The picture itself begins, or the file ends.
            0xd8..=0xda => return HeadSearch::Whole(head),
            _ => {}
        }
        let Some(length) = rest.first_chunk().map(|length| u16::from_be_bytes(*length)) else {
            return HeadSearch::Part(head);
        };
        let length = usize::from(length);
        if length < 2 {
            return HeadSearch::Whole(head);
        }
        let Some((segment, after)) = rest.split_at_checked(length) else {
            return HeadSearch::Part(head);
        };
        rest = after;
        let segment = &segment[2..];
        match kind {
            0xe1 => {
                head.exif = head.exif.or(segment.strip_prefix(EXIF));
                head.xmp = head.xmp.or(segment.strip_prefix(XMP));
            }
            0xc0..=0xc3 | 0xc5..=0xc7 | 0xc9..=0xcb | 0xcd..=0xcf => {
                let number = |at: usize| {
                    let bytes = segment.get(at..at + 2)?;
                    Some(usize::from(u16::from_be_bytes([bytes[0], bytes[1]])))
                };
                head.size = number(3)
                    .zip(number(1))
                    .filter(|(width, height)| *width > 0 && *height > 0);
                return HeadSearch::Whole(head);
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segment(kind: u8, contents: &[u8]) -> Vec<u8> {
        let length = u16::try_from(contents.len() + 2).expect("a test is short");
        [&[0xff, kind][..], &length.to_be_bytes(), contents].concat()
    }

    #[test]
    fn exif_xmp_and_size_are_found_among_the_segments() {
        let exif = segment(0xe1, b"Exif\0\0II*\0");
        let xmp = segment(0xe1, b"http://ns.adobe.com/xap/1.0/\0<x/>");
        let size = segment(0xc2, &[8, 1, 0, 2, 0, 3]);
        let file = [
            b"\xff\xd8\xff\xff".to_vec(),
            xmp,
            exif,
            segment(0xe2, b"x"),
            size,
        ]
        .concat();
        let HeadSearch::Whole(found) = head(&file) else {
            panic!("it is whole");
        };
        assert_eq!(found.exif, Some(&b"II*\0"[..]));
        assert_eq!(found.xmp, Some(&b"<x/>"[..]));
        assert_eq!(found.size, Some((512, 256)));
        for end in 2..file.len() {
            assert!(matches!(head(&file[..end]), HeadSearch::Part(_)), "{end}");
        }
        assert!(matches!(head(&file[1..]), HeadSearch::None));
    }
}
