//! EXIF: directories of tags as in TIFF. What makes no sense is passed over tag by tag.

use pilotage_base::tiff_entry::{TiffEntry, unsigned};

/// Most tags of a directory.
const MOST_TAGS: usize = 1000;
/// Last type of values that EXIF has; those beyond are of `BigTIFF`.
const LAST_KIND: u16 = 13;

/// Width, height and XMP of a picture that is a TIFF itself.
pub(super) const WIDTH: u16 = 0x0100;
pub(super) const HEIGHT: u16 = 0x0101;
pub(super) const XMP: u16 = 0x02bc;
pub(super) const MAKE: u16 = 0x010f;
pub(super) const MODEL: u16 = 0x0110;
pub(super) const ORIENTATION: u16 = 0x0112;
pub(super) const SOFTWARE: u16 = 0x0131;
pub(super) const DATE_TIME: u16 = 0x0132;
const EXIF_DIRECTORY: u16 = 0x8769;
const GPS_DIRECTORY: u16 = 0x8825;
pub(super) const DATE_TIME_ORIGINAL: u16 = 0x9003;
pub(super) const DATE_TIME_DIGITIZED: u16 = 0x9004;
pub(super) const OFFSET_TIME: u16 = 0x9010;
pub(super) const OFFSET_TIME_ORIGINAL: u16 = 0x9011;
pub(super) const OFFSET_TIME_DIGITIZED: u16 = 0x9012;
pub(super) const SUB_SECONDS: u16 = 0x9290;
pub(super) const SUB_SECONDS_ORIGINAL: u16 = 0x9291;
pub(super) const SUB_SECONDS_DIGITIZED: u16 = 0x9292;
pub(super) const FOCAL_LENGTH: u16 = 0x920a;
pub(super) const FOCAL_PLANE_X: u16 = 0xa20e;
pub(super) const FOCAL_PLANE_UNIT: u16 = 0xa210;
pub(super) const PIXEL_WIDTH: u16 = 0xa002;
pub(super) const PIXEL_HEIGHT: u16 = 0xa003;
pub(super) const FOCAL_LENGTH_35: u16 = 0xa405;
pub(super) const LATITUDE_REF: u16 = 1;
pub(super) const LATITUDE: u16 = 2;
pub(super) const LONGITUDE_REF: u16 = 3;
pub(super) const LONGITUDE: u16 = 4;
pub(super) const ALTITUDE_REF: u16 = 5;
pub(super) const ALTITUDE: u16 = 6;
pub(super) const GPS_TIME: u16 = 7;
pub(super) const GPS_STATUS: u16 = 9;
pub(super) const DIRECTION_REF: u16 = 0x10;
pub(super) const DIRECTION: u16 = 0x11;
pub(super) const MAP_DATUM: u16 = 0x12;
pub(super) const GPS_DATE: u16 = 0x1d;

/// Entry of one tag: its number, the type of its values, and their bytes.
#[derive(Clone, Copy, Debug)]
struct ExifEntry<'a> {
    tag: u16,
    kind: u16,
    values: &'a [u8],
}

/// The tags of a directory.
#[derive(Clone, Debug, Default)]
pub(super) struct ExifDirectory<'a> {
    is_little: bool,
    entries: Vec<ExifEntry<'a>>,
}

/// The directories of a photo.
#[derive(Clone, Debug, Default)]
pub(super) struct Exif<'a> {
    pub image: ExifDirectory<'a>,
    pub photo: ExifDirectory<'a>,
    pub gps: ExifDirectory<'a>,
}

impl<'a> Exif<'a> {
    /// The tags in a TIFF; none where it is none.
    pub fn read(tiff: &'a [u8]) -> Self {
        let is_little = match tiff.first_chunk() {
            Some(b"II*\0") => true,
            Some(b"MM\0*") => false,
            _ => return Self::default(),
        };
        let directory = |offset| ExifDirectory::read(tiff, offset, is_little);
        let image = unsigned(tiff.get(4..8).unwrap_or_default(), is_little);
        let image = directory(Some(image));
        let photo = directory(image.whole(EXIF_DIRECTORY));
        let gps = directory(image.whole(GPS_DIRECTORY));
        Self { image, photo, gps }
    }
}

impl<'a> ExifDirectory<'a> {
    fn read(tiff: &'a [u8], offset: Option<u64>, is_little: bool) -> Self {
        let mut entries = Vec::new();
        let table = offset.and_then(|offset| tiff.get(usize::try_from(offset).ok()?..));
        let count = table
            .and_then(|table| table.get(..2))
            .map_or(0, |b| unsigned(b, is_little));
        let table = table.and_then(|table| table.get(2..)).unwrap_or_default();
        for bytes in table.chunks_exact(12).take((count as usize).min(MOST_TAGS)) {
            let read = TiffEntry::read(bytes, is_little);
            let TiffEntry { tag, kind, .. } = read;
            if let Some(values) = values(tiff, &read, is_little) {
                entries.push(ExifEntry { tag, kind, values });
            }
        }
        Self { is_little, entries }
    }

    fn entry(&self, tag: u16) -> Option<ExifEntry<'a>> {
        self.entries.iter().find(|entry| entry.tag == tag).copied()
    }

    /// The first whole number of a tag.
    pub fn whole(&self, tag: u16) -> Option<u64> {
        let entry = self.entry(tag)?;
        let size = match entry.kind {
            1 | 7 => 1,
            3 => 2,
            4 | 13 => 4,
            _ => return None,
        };
        Some(unsigned(entry.values.get(..size)?, self.is_little))
    }

    /// The numbers of a tag, in their places: those over zero are no numbers (NaN).
    pub fn reals(&self, tag: u16) -> Vec<f64> {
        let Some(entry) = self.entry(tag) else {
            return Vec::new();
        };
        let whole = |bytes: &[u8]| unsigned(bytes, self.is_little);
        let signed = |bytes: &[u8]| f64::from(whole(bytes) as u32 as i32);
        let values = entry.values;
        let reals: Vec<f64> = match entry.kind {
            3 => values.chunks_exact(2).map(|v| whole(v) as f64).collect(),
            4 => values.chunks_exact(4).map(|v| whole(v) as f64).collect(),
            5 => values
                .chunks_exact(8)
                .map(|v| whole(&v[..4]) as f64 / whole(&v[4..]) as f64)
                .collect(),
            10 => values
                .chunks_exact(8)
                .map(|v| signed(&v[..4]) / signed(&v[4..]))
                .collect(),
            _ => Vec::new(),
        };
        let finite = reals
            .into_iter()
            .map(|v| if v.is_finite() { v } else { f64::NAN });
        finite.collect()
    }

    /// The bytes of a tag.
    pub fn bytes(&self, tag: u16) -> Option<&'a [u8]> {
        Some(self.entry(tag)?.values)
    }

    /// The first of the numbers of a tag, if it is one.
    pub fn real(&self, tag: u16) -> Option<f64> {
        self.reals(tag).first().copied().filter(|v| v.is_finite())
    }

    /// The letters of a tag up to the first zero, without blanks around them; `None` where nothing is left.
    pub fn text(&self, tag: u16) -> Option<String> {
        let entry = self
            .entry(tag)
            .filter(|entry| matches!(entry.kind, 2 | 7))?;
        let letters = entry.values.split(|b| *b == 0).next().unwrap_or_default();
        let text = String::from_utf8_lossy(letters).trim().to_owned();
        (!text.is_empty()).then_some(text)
    }
}

/// The bytes of an entry's values; `None` where they lie out of the file or are of a type that EXIF does not have.
fn values<'a>(tiff: &'a [u8], entry: &TiffEntry<'a>, is_little: bool) -> Option<&'a [u8]> {
    let is_known = entry.kind <= LAST_KIND;
    let length = usize::try_from(entry.length().filter(|_| is_known)?).ok()?;
    if let Some(values) = entry.inline.get(..length) {
        return Some(values);
    }
    let start = unsigned(entry.inline, is_little) as usize;
    tiff.get(start..start.checked_add(length)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tag_that_points_out_of_the_file_is_passed_over_and_the_others_read() {
        let mut tiff = b"MM\0*\0\0\0\x08\0\x03".to_vec();
        tiff.extend([0x01, 0x0f, 0, 2, 0, 0, 0, 4, b'D', b'J', b'I', 0]);
        tiff.extend([0x01, 0x10, 0, 2, 0, 0, 0, 9, 0xff, 0xff, 0xff, 0xf0]);
        tiff.extend([0x01, 0x12, 0, 3, 0, 0, 0, 1, 0, 6, 0, 0]);
        let exif = Exif::read(&tiff);
        assert_eq!(exif.image.text(MAKE).as_deref(), Some("DJI"));
        assert_eq!(exif.image.text(MODEL), None);
        assert_eq!(exif.image.whole(ORIENTATION), Some(6));
        for end in 0..tiff.len() {
            Exif::read(&tiff[..end]);
        }
    }

    #[test]
    fn fractions_over_zero_are_no_numbers() {
        let mut tiff = b"II*\0\x08\0\0\0\x01\0".to_vec();
        tiff.extend([2, 0, 5, 0, 3, 0, 0, 0, 22, 0, 0, 0]);
        for part in [46_u32, 1, 50, 2, 7, 0] {
            tiff.extend(part.to_le_bytes());
        }
        let directory = ExifDirectory::read(&tiff, Some(8), true);
        let reals = directory.reals(LATITUDE);
        assert_eq!(reals[..2], [46.0, 25.0]);
        assert!(reals.len() == 3 && reals[2].is_nan());
        tiff[30..34].copy_from_slice(&0_u32.to_le_bytes());
        let directory = ExifDirectory::read(&tiff, Some(8), true);
        assert_eq!(directory.real(LATITUDE), Some(46.0));
        tiff[26..30].copy_from_slice(&0_u32.to_le_bytes());
        let directory = ExifDirectory::read(&tiff, Some(8), true);
        assert_eq!(directory.real(LATITUDE), None);
    }
}
