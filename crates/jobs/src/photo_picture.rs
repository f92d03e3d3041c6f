//! Pictures of photos: JPEG, PNG, and TIFF.

use std::sync::Arc;

use pilotage_core::frames::{Geodetic, LocalFrame};
use pilotage_core::imagery::{
    GeoTiff, GeoTiffError, GeoTiffFile, Georeference, Imagery, MapMemory, MemoryBytes, Window,
    WorldFile,
};
use pilotage_core::raster::{Picture, decode_picture};

/// The colours of a photo. A TIFF is read as a map of a metre a pixel is.
///
/// # Errors
/// A file that is none of the three, or damaged.
pub fn decode_photo(name: &str, bytes: &[u8]) -> Result<Picture, String> {
    if !(bytes.starts_with(b"II*\0") || bytes.starts_with(b"MM\0*")) {
        return decode_picture(bytes).map_err(|e| e.to_string());
    }
    let told = |e: GeoTiffError| e.to_string();
    let place = Georeference::Metres(WorldFile::of_pixels());
    let file = GeoTiffFile::put(Arc::new(MemoryBytes::new(name, bytes.to_vec())), place);
    let file = file.map_err(told)?;
    let (width, height) = (file.tiff.levels()[0].width, file.tiff.levels()[0].height);
    let frame = LocalFrame::new(Geodetic::from_degrees(0.0, 0.0, 0.0));
    let map = GeoTiff::new(file, &frame, MapMemory::default()).map_err(told)?;
    let picture = map.window(&Window {
        north_edge: 0.0,
        west_edge: 0.0,
        gsd: 1.0,
        width,
        height,
    });
    match map.problems().first() {
        Some(problem) => Err(problem.clone()),
        None => Ok(picture.map(|[r, g, b, _]| [r, g, b])),
    }
}

#[cfg(test)]
pub mod tests {
    use super::*;

    /// A TIFF of one strip that does not say where it lies.
    pub fn tiff(picture: &Picture) -> Vec<u8> {
        let pixels = picture.pixels().as_flattened();
        let (width, height) = (picture.width() as u32, picture.height() as u32);
        let bits = 8 + pixels.len() as u32;
        let tags: [(u16, u16, u32, u32); 9] = [
            (256, 4, 1, width),
            (257, 4, 1, height),
            (258, 3, 3, bits),
            (259, 3, 1, 1),
            (262, 3, 1, 2),
            (273, 4, 1, 8),
            (277, 3, 1, 3),
            (278, 4, 1, height),
            (279, 4, 1, pixels.len() as u32),
        ];
        let mut file = b"II*\0".to_vec();
        file.extend((bits + 6).to_le_bytes());
        file.extend(pixels);
        file.extend([8_u8, 0, 8, 0, 8, 0]);
        file.extend((tags.len() as u16).to_le_bytes());
        for (tag, kind, count, value) in tags {
            file.extend(tag.to_le_bytes());
            file.extend(kind.to_le_bytes());
            file.extend(count.to_le_bytes());
            file.extend(value.to_le_bytes());
        }
        file.extend([0; 4]);
        file
    }

    #[test]
    fn the_picture_of_a_tiff_is_that_which_was_stored() {
        let stored = Picture::from_fn(50, 30, |x, y| [(5 * x) as u8, (8 * y) as u8, 77]);
        let read = decode_photo("a.tif", &tiff(&stored)).expect("a picture");
        assert_eq!(read, stored);
        let cut = &tiff(&stored)[..2000];
        assert!(decode_photo("a.tif", cut).is_err());
        assert!(decode_photo("a.txt", b"no picture").is_err());
    }
}
