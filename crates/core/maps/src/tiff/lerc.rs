//! Tiles packed by Limited Error Raster Compression (Esri's LERC, version 2), as libtiff stores them.

use lerc_core::PixelData;
use lerc_reader::decode_band_set;

use super::{SampleKind, TiffLayout};

/// First bytes of every band.
const KEY: &[u8] = b"Lerc2 ";

/// Unpacks a tile into the bytes that an unpacked one would have in this file. Pixels that are not valid are not a number
/// among real ones, zero among whole ones, and transparent where the file has a sample for that.
pub(super) fn unlerc(
    layout: &TiffLayout,
    packed: &[u8],
    (width, rows): (usize, usize),
) -> Result<Vec<u8>, String> {
    let samples = layout.samples_together();
    check_heads(packed, (width, rows), samples)?;
    let decoded = decode_band_set(packed).map_err(|cause| format!("LERC: {cause}"))?;
    let depth = decoded.info().bands().first().map_or(0, |band| band.depth) as usize;
    let (_, bands, masks) = decoded.into_parts();
    if bands.len() > 1 && depth > 1 {
        return Err("LERC: several bands of several samples each".to_owned());
    }
    let stored = bands.len() * depth;
    // The last sample of a pixel is then its mask.
    let is_masked = stored + 1 == samples && layout.kind == SampleKind::U8;
    if stored != samples && !is_masked {
        return Err(format!("LERC: {stored} samples a pixel of {samples}"));
    }
    let size = layout.kind.bits() / 8;
    let mut bytes = vec![0; width * rows * samples * size];
    for (index, (band, mask)) in bands.iter().zip(&masks).enumerate() {
        let is_valid = |pixel: usize| mask.as_ref().is_none_or(|mask| mask[pixel] != 0);
        let values = values(layout.kind, band, layout.is_little_endian, |i| {
            is_valid(i / depth)
        })?;
        for (pixel, value) in values.chunks_exact(depth * size).enumerate() {
            let at = (pixel * samples + index) * size;
            bytes[at..at + value.len()].copy_from_slice(value);
            if is_masked && index == 0 {
                bytes[at + samples - 1] = if is_valid(pixel) { u8::MAX } else { 0 };
            }
        }
    }
    Ok(bytes)
}

/// Refuses bands of another size than the tile before memory is asked for.
fn check_heads(packed: &[u8], (width, rows): (usize, usize), samples: usize) -> Result<(), String> {
    let mut rest = packed;
    let mut left = samples;
    while !rest.is_empty() {
        let (size, stored) = head(rest).ok_or("LERC: a header of no known version")?;
        let [h, w, depth] = stored;
        if (w, h) != (width, rows) {
            return Err(format!(
                "LERC: {w} × {h} pixels in a tile of {width} × {rows}"
            ));
        }
        left = (left.checked_sub(depth)).ok_or("LERC: more samples than the pixels have")?;
        rest = (rest.get(size..).filter(|_| size > 0)).ok_or("LERC: a band that is cut off")?;
    }
    Ok(())
}

/// Bytes of the first band, and its rows, columns and samples a pixel.
fn head(bytes: &[u8]) -> Option<(usize, [usize; 3])> {
    let mut rest = bytes.strip_prefix(KEY)?;
    let mut next = || {
        let (word, after) = rest.split_first_chunk()?;
        rest = after;
        usize::try_from(u32::from_le_bytes(*word)).ok()
    };
    let version = next()?;
    if !(2..=6).contains(&version) {
        return None;
    }
    if version > 2 {
        let _checksum = next()?;
    }
    let (rows, columns) = (next()?, next()?);
    let depth = if version > 3 { next()? } else { 1 };
    let (_valid_pixels, _block) = (next()?, next()?);
    Some((next()?, [rows, columns, depth]))
}

/// The samples of a band as bytes in the order of the file: libtiff packs them as they lie in a file of either order.
fn values(
    kind: SampleKind,
    band: &PixelData,
    is_little_endian: bool,
    is_valid: impl Fn(usize) -> bool,
) -> Result<Vec<u8>, String> {
    macro_rules! bytes {
        ($samples:expr, $none:expr) => {{
            let none = if is_little_endian {
                $none.to_le_bytes()
            } else {
                $none.to_be_bytes()
            };
            let samples = $samples.iter().enumerate();
            Ok(samples
                .flat_map(|(i, sample)| {
                    if is_valid(i) {
                        sample.to_le_bytes()
                    } else {
                        none
                    }
                })
                .collect())
        }};
    }
    match (kind, band) {
        (SampleKind::U8, PixelData::U8(samples)) => bytes!(samples, 0_u8),
        (SampleKind::I8, PixelData::I8(samples)) => bytes!(samples, 0_i8),
        (SampleKind::U16, PixelData::U16(samples)) => bytes!(samples, 0_u16),
        (SampleKind::I16, PixelData::I16(samples)) => bytes!(samples, 0_i16),
        (SampleKind::U32, PixelData::U32(samples)) => bytes!(samples, 0_u32),
        (SampleKind::I32, PixelData::I32(samples)) => bytes!(samples, 0_i32),
        (SampleKind::F32, PixelData::F32(samples)) => bytes!(samples, f32::NAN),
        (SampleKind::F64, PixelData::F64(samples)) => bytes!(samples, f64::NAN),
        _ => Err("LERC: samples of another kind than the file has".to_owned()),
    }
}
