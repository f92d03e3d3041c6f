//! Unpacking of tiles and strips, never beyond the size that the layout gives them.

use std::io::{Cursor, Read};

use flate2::bufread::ZlibDecoder;
use image_webp::WebPDecoder;
use ruzstd::decoding::{BlockDecodingStrategy, FrameDecoder};
use weezl::{BitOrder, LzwStatus, decode::Decoder};
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use super::lerc::unlerc;
use super::{Compression, LercWrap, Photometric, TiffLayout};

/// Largest window of Zstandard that is allowed for, bytes: no tile is larger.
const WINDOW: u64 = 64 << 20;

/// Bytes that the headers of LERC take at most.
const LERC_HEADS: usize = 1 << 16;

/// Unpacks `packed` into `expected` bytes; less if it ends early. The error says why not.
pub(super) fn unpack(
    layout: &TiffLayout,
    packed: Vec<u8>,
    (width, rows): (usize, usize),
    expected: usize,
) -> Result<Vec<u8>, String> {
    match layout.compression {
        Compression::None => {
            let mut bytes = packed;
            bytes.truncate(expected);
            Ok(bytes)
        }
        Compression::Deflate => inflate(&packed, expected),
        Compression::Lzw => lzw(&packed, expected),
        Compression::PackBits => Ok(pack_bits(&packed, expected)),
        Compression::Jpeg => jpeg(layout, packed, (width, rows)),
        Compression::Zstandard => zstandard(&packed, expected),
        Compression::WebP => webp(layout, &packed, (width, rows)),
        Compression::Lerc(wrap) => {
            // Bands that cannot be made smaller lie within as they are, behind a header and a mask.
            let most = expected + expected / 8 + LERC_HEADS;
            let inner = match wrap {
                LercWrap::None => packed,
                LercWrap::Deflate => inflate(&packed, most)?,
                LercWrap::Zstandard => zstandard(&packed, most)?,
            };
            unlerc(layout, &inner, (width, rows))
        }
    }
}

/// Room for what can come out of `packed`, if one byte becomes at most `ratio` bytes.
fn room(packed: &[u8], ratio: usize, expected: usize) -> Vec<u8> {
    Vec::with_capacity(expected.min(packed.len().saturating_mul(ratio)))
}

fn inflate(packed: &[u8], expected: usize) -> Result<Vec<u8>, String> {
    let mut bytes = room(packed, 1032, expected);
    match ZlibDecoder::new(packed)
        .take(expected as u64)
        .read_to_end(&mut bytes)
    {
        Ok(_) => Ok(bytes),
        Err(cause) => Err(format!("deflate: {cause}")),
    }
}

fn lzw(packed: &[u8], expected: usize) -> Result<Vec<u8>, String> {
    let mut decoder = Decoder::with_tiff_size_switch(BitOrder::Msb, 8);
    let mut bytes = vec![0; room(packed, 4096, expected).capacity()];
    let (mut read, mut written) = (0, 0);
    while written < bytes.len() {
        let result = decoder.decode_bytes(&packed[read..], &mut bytes[written..]);
        read += result.consumed_in;
        written += result.consumed_out;
        match result.status {
            Ok(LzwStatus::Ok) if result.consumed_in + result.consumed_out > 0 => {}
            Ok(_) => break,
            Err(cause) => return Err(format!("LZW: {cause}")),
        }
    }
    bytes.truncate(written);
    Ok(bytes)
}

/// Runs: a count below zero repeats the next byte, one from zero copies that many and one more.
fn pack_bits(packed: &[u8], expected: usize) -> Vec<u8> {
    let mut bytes = room(packed, 64, expected);
    let mut rest = packed;
    while let [count, after @ ..] = rest
        && bytes.len() < expected
    {
        let count = *count as i8;
        rest = after;
        if count >= 0 {
            let n = (usize::from(count.unsigned_abs()) + 1).min(rest.len());
            bytes.extend_from_slice(&rest[..n]);
            rest = &rest[n..];
        } else if count > i8::MIN
            && let [value, after @ ..] = rest
        {
            let n = usize::from(count.unsigned_abs()) + 1;
            bytes.resize(bytes.len() + n, *value);
            rest = after;
        }
    }
    bytes.truncate(expected);
    bytes
}

/// Decodes a frame of Zstandard (RFC 8878), up to `expected` bytes.
fn zstandard(packed: &[u8], expected: usize) -> Result<Vec<u8>, String> {
    let wrong = |cause: &dyn std::fmt::Display| format!("Zstandard: {cause}");
    let mut rest = packed;
    let mut decoder = FrameDecoder::new();
    decoder.set_max_window_size(WINDOW);
    decoder.init(&mut rest).map_err(|cause| wrong(&cause))?;
    let mut bytes = Vec::new();
    while !decoder.is_finished() && bytes.len() < expected {
        let one = BlockDecodingStrategy::UptoBlocks(1);
        decoder
            .decode_blocks(&mut rest, one)
            .map_err(|cause| wrong(&cause))?;
        (&mut decoder)
            .take((expected - bytes.len()) as u64)
            .read_to_end(&mut bytes)
            .map_err(|cause| wrong(&cause))?;
    }
    Ok(bytes)
}

/// Decodes a `WebP` picture; one without transparency is opaque where the file has a sample for it.
fn webp(
    layout: &TiffLayout,
    packed: &[u8],
    (width, rows): (usize, usize),
) -> Result<Vec<u8>, String> {
    let wrong = |cause: &dyn std::fmt::Display| format!("WebP: {cause}");
    let mut decoder = WebPDecoder::new(Cursor::new(packed)).map_err(|cause| wrong(&cause))?;
    let (w, h) = decoder.dimensions();
    if (w as usize, h as usize) != (width, rows) || decoder.is_animated() {
        return Err(format!(
            "a WebP of {w} × {h} pixels in a tile of {width} × {rows}"
        ));
    }
    decoder.set_memory_limit(64 << 20);
    let own = if decoder.has_alpha() { 4 } else { 3 };
    let mut pixels = vec![0; width * rows * own];
    decoder
        .read_image(&mut pixels)
        .map_err(|cause| wrong(&cause))?;
    let samples = layout.samples_together();
    Ok(match (own, samples) {
        (4, 3) => (pixels.chunks_exact(4))
            .flat_map(|pixel| [pixel[0], pixel[1], pixel[2]])
            .collect(),
        (3, 4) => (pixels.chunks_exact(3))
            .flat_map(|pixel| [pixel[0], pixel[1], pixel[2], 255])
            .collect(),
        _ => pixels,
    })
}

/// Decodes an abbreviated JPEG with the shared tables in front of it.
fn jpeg(
    layout: &TiffLayout,
    packed: Vec<u8>,
    (width, rows): (usize, usize),
) -> Result<Vec<u8>, String> {
    let samples = layout.samples_together();
    let stream = with_tables(&layout.jpeg_tables, packed);
    let options = DecoderOptions::default()
        .set_strict_mode(false)
        .set_max_width(width)
        .set_max_height(rows);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(stream.as_slice()), options);
    decoder
        .decode_headers()
        .map_err(|cause| format!("JPEG: {cause:?}"))?;
    // Three samples are taken for luminance and colour differences unless the stream says otherwise;
    // where the file says that they are not, asking for those leaves them as they are.
    let stored = decoder.input_colorspace();
    let wanted = match (samples, layout.photometric) {
        (1, _) => Some(ColorSpace::Luma),
        (3, Photometric::YCbCr) => Some(ColorSpace::RGB),
        (3 | 4, _) => stored,
        _ => None,
    };
    let wanted = wanted.ok_or_else(|| format!("a JPEG of {samples} samples a pixel"))?;
    decoder.set_options(options.jpeg_set_out_colorspace(wanted));
    let (w, h) = decoder.dimensions().ok_or("a JPEG without a size")?;
    if w != width || h > rows {
        return Err(format!(
            "a JPEG of {w} × {h} pixels in a tile of {width} × {rows}"
        ));
    }
    if decoder.output_buffer_size() != Some(w * h * samples) {
        return Err(format!("a JPEG with other than {samples} samples a pixel"));
    }
    decoder.decode().map_err(|cause| format!("JPEG: {cause:?}"))
}

/// The stream with the tables (both are whole JPEG streams) put behind its first marker.
fn with_tables(tables: &[u8], stream: Vec<u8>) -> Vec<u8> {
    let inner = tables
        .strip_prefix(&[0xff, 0xd8])
        .and_then(|tables| tables.strip_suffix(&[0xff, 0xd9]));
    match (inner, stream.strip_prefix(&[0xff, 0xd8])) {
        (Some(tables), Some(rest)) => [&[0xff, 0xd8], tables, rest].concat(),
        _ => stream,
    }
}
