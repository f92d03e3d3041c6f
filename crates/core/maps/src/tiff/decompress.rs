//! Unpacking of tiles and strips, never beyond the size that the layout gives them.

use std::io::Read;

use flate2::bufread::ZlibDecoder;
use weezl::{BitOrder, LzwStatus, decode::Decoder};
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use super::{Compression, Layout, Photometric};

/// Unpacks `packed` into `expected` bytes; less if it ends early. The error says why not.
pub(super) fn unpack(
    layout: &Layout,
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

/// Decodes an abbreviated JPEG with the shared tables in front of it.
fn jpeg(
    layout: &Layout,
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
