//! Pictures in files: JPEG and PNG.

use std::io::Cursor;

use ::image::codecs::jpeg::JpegEncoder;
use ::image::codecs::png::PngEncoder;
use ::image::{ExtendedColorType, ImageEncoder, ImageFormat, ImageReader, Limits};

use super::{Picture, Raster, Rgba};

/// Longest side that is decoded, pixels.
const LONGEST_SIDE: u32 = 32_768;
/// Most memory for a decoded picture, bytes.
const MOST_MEMORY: u64 = 1 << 30;

/// Why a picture could not be read or written.
#[derive(Debug, thiserror::Error)]
pub enum CodecError {
    /// The bytes do not begin like a JPEG or PNG file.
    #[error("neither a JPEG nor a PNG picture; convert it to one of them")]
    UnknownFormat,
    /// The file is damaged, cut off, too large or of a kind that is not read.
    #[error("the picture cannot be decoded: {0}; open it elsewhere and save it again")]
    Decode(::image::ImageError),
    /// The picture cannot be written in this format.
    #[error("the picture cannot be encoded: {0}")]
    Encode(::image::ImageError),
}

fn decode(bytes: &[u8]) -> Result<image::DynamicImage, CodecError> {
    let mut reader = ImageReader::new(Cursor::new(bytes))
        .with_guessed_format()
        .map_err(|_| CodecError::UnknownFormat)?;
    if !matches!(reader.format(), Some(ImageFormat::Jpeg | ImageFormat::Png)) {
        return Err(CodecError::UnknownFormat);
    }
    let mut limits = Limits::default();
    limits.max_image_width = Some(LONGEST_SIDE);
    limits.max_image_height = Some(LONGEST_SIDE);
    limits.max_alloc = Some(MOST_MEMORY);
    reader.limits(limits);
    reader.decode().map_err(CodecError::Decode)
}

/// The colours of a JPEG or PNG file; transparency is dropped, 16-bit colours are cut to 8.
pub fn decode_picture(bytes: &[u8]) -> Result<Picture, CodecError> {
    let picture = decode(bytes)?.into_rgb8();
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let pixels = picture.as_raw().as_chunks::<3>().0.to_vec();
    Raster::from_pixels(width, height, pixels).ok_or(CodecError::UnknownFormat)
}

/// As [`decode_picture`], with the transparency as coverage.
pub fn decode_picture_with_coverage(bytes: &[u8]) -> Result<Raster<Rgba>, CodecError> {
    let picture = decode(bytes)?.into_rgba8();
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let pixels = picture.as_raw().as_chunks::<4>().0.to_vec();
    Raster::from_pixels(width, height, pixels).ok_or(CodecError::UnknownFormat)
}

/// A baseline JPEG file; `quality` from 1 (small) to 100 (good).
pub fn encode_jpeg(picture: &Picture, quality: u8) -> Result<Vec<u8>, CodecError> {
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, quality.clamp(1, 100))
        .write_image(
            picture.pixels().as_flattened(),
            picture.width() as u32,
            picture.height() as u32,
            ExtendedColorType::Rgb8,
        )
        .map_err(CodecError::Encode)?;
    Ok(bytes)
}

/// A PNG file, without loss.
///
/// ```
/// use pilotage_raster::raster::{Raster, decode_picture, encode_png};
///
/// let picture = Raster::from_fn(3, 2, |column, row| [column as u8, row as u8, 200]);
/// let file = encode_png(&picture)?;
/// assert_eq!(&file[1..4], b"PNG");
/// assert_eq!(decode_picture(&file)?, picture);
/// # Ok::<(), pilotage_raster::raster::CodecError>(())
/// ```
pub fn encode_png(picture: &Picture) -> Result<Vec<u8>, CodecError> {
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes)
        .write_image(
            picture.pixels().as_flattened(),
            picture.width() as u32,
            picture.height() as u32,
            ExtendedColorType::Rgb8,
        )
        .map_err(CodecError::Encode)?;
    Ok(bytes)
}

/// A PNG file with coverage as transparency, without loss.
pub fn encode_png_with_coverage(picture: &Raster<Rgba>) -> Result<Vec<u8>, CodecError> {
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes)
        .write_image(
            picture.pixels().as_flattened(),
            picture.width() as u32,
            picture.height() as u32,
            ExtendedColorType::Rgba8,
        )
        .map_err(CodecError::Encode)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture() -> Picture {
        Picture::from_fn(37, 23, |x, y| {
            [(5 * x) as u8, (9 * y) as u8, (3 * x + 2 * y) as u8]
        })
    }

    #[test]
    fn a_png_comes_back_as_it_was() {
        let bytes = encode_png(&picture()).unwrap();
        assert_eq!(decode_picture(&bytes).unwrap(), picture());
        let covered = decode_picture_with_coverage(&bytes).unwrap();
        assert!(covered.pixels().iter().all(|p| p[3] == 255));
        let holed = covered.map(|[r, g, b, _]| [r, g, b, r]);
        let bytes = encode_png_with_coverage(&holed).unwrap();
        assert_eq!(decode_picture_with_coverage(&bytes).unwrap(), holed);
    }

    #[test]
    fn a_jpeg_of_high_quality_comes_back_almost_as_it_was() {
        let back = decode_picture(&encode_jpeg(&picture(), 95).unwrap()).unwrap();
        let furthest = back
            .pixels()
            .as_flattened()
            .iter()
            .zip(picture().pixels().as_flattened())
            .map(|(a, b)| a.abs_diff(*b))
            .max();
        assert!(furthest < Some(24), "{furthest:?}");
    }

    #[test]
    fn damaged_files_are_refused_and_never_panic() {
        let jpeg = encode_jpeg(&picture(), 80).unwrap();
        let png = encode_png(&picture()).unwrap();
        for bytes in [&jpeg, &png] {
            for length in 0..bytes.len() {
                let _ = decode_picture(&bytes[..length]);
                let mut flipped = bytes.clone();
                flipped[length] ^= 0x5a;
                let _ = decode_picture(&flipped);
            }
        }
        assert!(matches!(
            decode_picture(b"GIF89a"),
            Err(CodecError::UnknownFormat)
        ));
        assert!(decode_picture(&png[..png.len() / 2]).is_err());
        assert!(encode_jpeg(&Picture::filled(0, 0, [0; 3]), 80).is_err());
    }
}
