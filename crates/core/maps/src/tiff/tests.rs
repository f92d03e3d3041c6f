//! TIFF files made here, whole and damaged.

use std::io::Write;
use std::sync::Arc;

use flate2::{Compression as Level, write::ZlibEncoder};
use lerc_writer::{EncodeOptions, RasterView};
use proptest::prelude::*;
use weezl::BitOrder;

use super::*;
use pilotage_base::bytes::MemoryBytes;

/// Settings of a TIFF file to write.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Recipe {
    pub width: usize,
    pub height: usize,
    /// Side of the tiles, or rows of a strip.
    pub chunk: usize,
    pub is_tiled: bool,
    pub compression: Compression,
    pub samples: usize,
    pub is_big: bool,
}

impl Default for Recipe {
    fn default() -> Self {
        Self {
            width: 50,
            height: 40,
            chunk: 16,
            is_tiled: true,
            compression: Compression::Deflate,
            samples: 3,
            is_big: false,
        }
    }
}

/// Sample of a pixel: smooth, so that JPEG keeps it.
pub(crate) fn sample(column: usize, row: usize, band: usize) -> u8 {
    (40 + 3 * column + 2 * row + 20 * band).min(255) as u8
}

fn pack(recipe: &Recipe, bytes: &[u8], width: usize, height: usize) -> Vec<u8> {
    match recipe.compression {
        Compression::Deflate => {
            let mut encoder = ZlibEncoder::new(Vec::new(), Level::fast());
            encoder.write_all(bytes).unwrap();
            encoder.finish().unwrap()
        }
        Compression::Lzw => weezl::encode::Encoder::with_tiff_size_switch(BitOrder::Msb, 8)
            .encode(bytes)
            .unwrap(),
        Compression::PackBits => (bytes.chunks(128))
            .flat_map(|run| std::iter::once(run.len() as u8 - 1).chain(run.iter().copied()))
            .collect(),
        Compression::None => bytes.to_vec(),
        Compression::Zstandard => {
            ruzstd::encoding::compress_to_vec(bytes, ruzstd::encoding::CompressionLevel::Fastest)
        }
        Compression::WebP => {
            let mut out = Vec::new();
            let colour = image_webp::ColorType::Rgb8;
            image_webp::WebPEncoder::new(&mut out)
                .encode(bytes, width as u32, height as u32, colour)
                .unwrap();
            out
        }
        Compression::Lerc(wrap) => {
            let pixels = bytes.chunks_exact(recipe.samples);
            let (width, height) = (width as u32, pixels.len() as u32 / width as u32);
            let raster = RasterView::new(width, height, recipe.samples as u32, bytes).unwrap();
            let lerc = lerc_writer::encode(raster, None, EncodeOptions::new()).unwrap();
            let compression = match wrap {
                LercWrap::None => Compression::None,
                LercWrap::Deflate => Compression::Deflate,
                LercWrap::Zstandard => Compression::Zstandard,
            };
            let around = Recipe {
                compression,
                ..*recipe
            };
            pack(&around, &lerc, width as usize, height as usize)
        }
        Compression::Jpeg => {
            let mut out = Vec::new();
            image::codecs::jpeg::JpegEncoder::new_with_quality(&mut out, 98)
                .encode(
                    bytes,
                    width as u32,
                    height as u32,
                    if recipe.samples == 1 {
                        image::ExtendedColorType::L8
                    } else {
                        image::ExtendedColorType::Rgb8
                    },
                )
                .unwrap();
            out
        }
    }
}

/// The number of a compression in the tag.
fn code(compression: Compression) -> usize {
    match compression {
        Compression::None => 1,
        Compression::Lzw => 5,
        Compression::Jpeg => 7,
        Compression::Deflate => 8,
        Compression::PackBits => 32_773,
        Compression::Zstandard => 50_000,
        Compression::WebP => 50_001,
        Compression::Lerc(_) => 34_887,
    }
}

/// A file by the recipe, with further tags (number, type, values as bytes) of `GeoTIFF`.
pub(crate) fn write(recipe: &Recipe, more: &[(u16, u16, Vec<u8>)]) -> Vec<u8> {
    let Recipe {
        width,
        height,
        chunk,
        is_tiled,
        samples,
        is_big,
        ..
    } = *recipe;
    let chunk_width = if is_tiled { chunk } else { width };
    let mut out = if is_big {
        b"II\x2b\0\x08\0\0\0\0\0\0\0\0\0\0\0".to_vec()
    } else {
        b"II\x2a\0\0\0\0\0".to_vec()
    };
    let (mut offsets, mut counts) = (Vec::new(), Vec::new());
    for row in (0..height).step_by(chunk) {
        for column in (0..width).step_by(chunk_width) {
            let rows = if is_tiled {
                chunk
            } else {
                chunk.min(height - row)
            };
            let mut bytes = Vec::new();
            for y in row..row + rows {
                for x in column..column + chunk_width {
                    bytes.extend((0..samples).map(|band| sample(x, y, band)));
                }
            }
            let packed = pack(recipe, &bytes, chunk_width, rows);
            offsets.push(out.len() as u32);
            counts.push(packed.len() as u32);
            out.extend(packed);
        }
    }
    let long = |v: usize| (4_u16, (v as u32).to_le_bytes().to_vec());
    let short = |v: usize| (3_u16, (v as u16).to_le_bytes().to_vec());
    let longs = |v: &[u32]| (4_u16, v.iter().flat_map(|v| v.to_le_bytes()).collect());
    let photometric = match (samples, recipe.compression) {
        (1, _) => 1,
        (_, Compression::Jpeg) => 6,
        _ => 2,
    };
    let mut tags: Vec<(u16, (u16, Vec<u8>))> = vec![
        (256, long(width)),
        (257, long(height)),
        (258, short(8)),
        (259, short(code(recipe.compression))),
        (262, short(photometric)),
        (277, short(samples)),
    ];
    if is_tiled {
        tags.extend([(322, long(chunk)), (323, long(chunk))]);
        tags.extend([(324, longs(&offsets)), (325, longs(&counts))]);
    } else {
        tags.extend([(273, longs(&offsets)), (278, long(chunk))]);
        tags.push((279, longs(&counts)));
    }
    if let Compression::Lerc(wrap) = recipe.compression {
        tags.push((50_674, longs(&[6, wrap as u32])));
    }
    tags.extend(more.iter().map(|(tag, kind, v)| (*tag, (*kind, v.clone()))));
    tags.sort_by_key(|(tag, _)| *tag);
    let word = if is_big { 8 } else { 4 };
    let number = |v: usize| (v as u64).to_le_bytes()[..word].to_vec();
    let mut entries = Vec::new();
    for (tag, (kind, values)) in &tags {
        let size = [0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8][usize::from(*kind)];
        entries.extend(tag.to_le_bytes());
        entries.extend(kind.to_le_bytes());
        entries.extend(number(values.len() / size));
        if values.len() <= word {
            let mut inline = values.clone();
            inline.resize(word, 0);
            entries.extend(inline);
        } else {
            entries.extend(number(out.len()));
            out.extend(values);
        }
    }
    let directory = number(out.len());
    if is_big {
        out[8..16].copy_from_slice(&directory);
        out.extend((tags.len() as u64).to_le_bytes());
    } else {
        out[4..8].copy_from_slice(&directory);
        out.extend((tags.len() as u16).to_le_bytes());
    }
    out.extend(entries);
    out.extend(number(0));
    out
}

pub(crate) fn open(bytes: Vec<u8>) -> Result<TiffFile, TiffError> {
    TiffFile::open(Arc::new(MemoryBytes::new("map.tif", bytes)))
}

/// Reads every tile; `Ok` if all could be read.
fn read_all(file: &TiffFile) -> Result<(), TiffError> {
    for (level, layout) in file.levels().iter().enumerate() {
        for row in 0..layout.down() {
            for column in 0..layout.across() {
                file.chunk(level, column, row)?;
            }
        }
    }
    Ok(())
}

fn recipes() -> impl Strategy<Value = Recipe> {
    let compressions = prop::sample::select(vec![
        Compression::None,
        Compression::Deflate,
        Compression::Lzw,
        Compression::PackBits,
        Compression::Jpeg,
        Compression::Zstandard,
        Compression::WebP,
        Compression::Lerc(LercWrap::None),
        Compression::Lerc(LercWrap::Deflate),
        Compression::Lerc(LercWrap::Zstandard),
    ]);
    let shape = (1_usize..70, 1_usize..70, 1_usize..5);
    (
        shape,
        compressions,
        any::<bool>(),
        any::<bool>(),
        any::<bool>(),
    )
        .prop_map(
            |((width, height, chunk), compression, is_tiled, is_big, is_grey)| Recipe {
                width,
                height,
                chunk: 16 * chunk,
                is_tiled,
                compression,
                samples: if is_grey && compression != Compression::WebP {
                    1
                } else {
                    3
                },
                is_big,
            },
        )
}

#[test]
fn a_damaged_tile_is_named_with_its_file() {
    let recipe = Recipe {
        compression: Compression::Lzw,
        ..Recipe::default()
    };
    let mut bytes = write(&recipe, &[]);
    // The second tile of the first row begins where the first one ends.
    let file = open(bytes.clone()).unwrap();
    let (offset, count) = file.levels()[0].place(0, 1, 0);
    bytes[offset as usize..(offset + count) as usize].fill(0xff);
    let file = open(bytes).unwrap();
    let error = file.chunk(0, 1, 0).unwrap_err();
    let text = error.to_string();
    assert!(text.starts_with("map.tif, tile 1, 0: LZW"), "{text}");
    assert!(file.chunk(0, 0, 0).is_ok());
}

#[test]
fn a_file_of_another_kind_is_called_so() {
    for bytes in [&b""[..], b"II", b"\x89PNG\r\n\x1a\n0000", b"II\x2a\0"] {
        let error = open(bytes.to_vec()).err().unwrap();
        assert!(matches!(error, TiffError::NotTiff { .. }), "{error}");
    }
}

#[test]
fn directories_in_a_circle_are_noticed() {
    let mut bytes = write(&Recipe::default(), &[]);
    let first = u32::from_le_bytes(bytes[4..8].try_into().unwrap());
    let end = bytes.len();
    bytes[end - 4..].copy_from_slice(&first.to_le_bytes());
    let error = open(bytes).err().unwrap().to_string();
    assert!(error.contains("circle"), "{error}");
}

#[test]
fn what_is_not_read_is_named_with_what_would_be() {
    let mut bytes = write(&Recipe::default(), &[]);
    let place = (0..bytes.len() - 12)
        .find(|i| bytes[*i..*i + 4] == [0x03, 0x01, 0x03, 0x00])
        .unwrap();
    bytes[place + 8..place + 10].copy_from_slice(&50_002_u16.to_le_bytes());
    let error = open(bytes).err().unwrap().to_string();
    assert!(error.contains("tag Compression (259)"), "{error}");
    assert!(
        error.contains("JPEG XL") && error.contains("deflate"),
        "{error}"
    );
}

#[test]
fn a_claim_of_more_pixels_than_bytes_is_refused_before_memory_is_asked_for() {
    let recipe = Recipe {
        is_tiled: false,
        chunk: 60_000,
        compression: Compression::None,
        ..Recipe::default()
    };
    let bytes = write(&recipe, &[]);
    let width = (0..bytes.len())
        .find(|i| bytes[*i..].starts_with(&[0, 1, 4, 0, 1, 0, 0, 0, 50]))
        .unwrap();
    let mut huge = bytes;
    huge[width + 8..width + 12].copy_from_slice(&900_000_u32.to_le_bytes());
    huge[width + 20..width + 24].copy_from_slice(&15_000_u32.to_le_bytes());
    let error = open(huge).err().unwrap().to_string();
    assert!(error.contains("in a file of"), "{error}");
}

proptest! {
    #[test]
    fn every_sample_comes_back(recipe in recipes()) {
        let file = open(write(&recipe, &[])).unwrap();
        let layout = &file.levels()[0];
        for row in 0..layout.down() {
            for column in 0..layout.across() {
                let chunk = file.chunk(0, column, row).unwrap().unwrap();
                for y in 0..chunk.height {
                    for x in 0..chunk.width {
                        let (px, py) = (column * layout.chunk_width + x, row * layout.chunk_height + y);
                        for band in 0..recipe.samples {
                            let index = (y * chunk.width + x) * recipe.samples + band;
                            let off = chunk.samples.real(index) - f64::from(sample(px, py, band));
                            let most = if recipe.compression == Compression::Jpeg { 30.0 } else { 0.0 };
                            prop_assert!(off.abs() <= most, "{px} {py}: {off}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn a_cut_off_file_never_panics(recipe in recipes(), kept in 0.0_f64..1.0) {
        let bytes = write(&recipe, &[]);
        let kept = (bytes.len() as f64 * kept) as usize;
        if let Ok(file) = open(bytes[..kept].to_vec()) {
            prop_assert!(read_all(&file).is_err());
        }
    }

    #[test]
    fn flipped_bits_never_panic(
        recipe in recipes(),
        flips in prop::collection::vec((any::<prop::sample::Index>(), 0_u8..8), 1..8),
    ) {
        let mut bytes = write(&recipe, &[]);
        for (place, bit) in flips {
            let place = place.index(bytes.len());
            bytes[place] ^= 1 << bit;
        }
        if let Ok(file) = open(bytes) {
            let _ = read_all(&file);
        }
    }

    #[test]
    fn flipped_bits_of_the_directory_never_panic(
        recipe in recipes(),
        flips in prop::collection::vec((0_usize..400, 0_u8..8), 1..6),
    ) {
        let mut bytes = write(&recipe, &[]);
        for (place, bit) in flips {
            let place = bytes.len() - 1 - place.min(bytes.len() - 1);
            bytes[place] ^= 1 << bit;
        }
        if let Ok(file) = open(bytes) {
            let _ = read_all(&file);
        }
    }

    #[test]
    fn spliced_files_never_panic(
        one in recipes(),
        other in recipes(),
        cut in any::<prop::sample::Index>(),
        onward in any::<prop::sample::Index>(),
    ) {
        let (one, other) = (write(&one, &[]), write(&other, &[]));
        let bytes = [&one[..cut.index(one.len())], &other[onward.index(other.len())..]].concat();
        if let Ok(file) = open(bytes) {
            let _ = read_all(&file);
        }
    }
}
