//! Pictures of few pixels, of which rasterio tells the same.

use std::io::Write as _;

use flate2::{Compression, write::ZlibEncoder};

use super::colour::Colours;
use crate::tiff::TiffFile;
use crate::tiff::tests::open;
use pilotage_raster::raster::Rgba;

/// Image of a file: its width, its height, its pixels as stored, and tags of short numbers.
struct Image<'a>(usize, usize, &'a [u8], &'a [(u16, &'a [u16])]);

/// A TIFF file of images of one strip each; a second one is the mask of the first.
fn tiff(images: &[Image<'_>]) -> TiffFile {
    let mut out = b"II\x2a\0\0\0\0\0".to_vec();
    let mut link = 4;
    for (number, Image(width, height, pixels, tags)) in images.iter().enumerate() {
        let short = |values: &[u16]| {
            values
                .iter()
                .flat_map(|v| v.to_le_bytes())
                .collect::<Vec<u8>>()
        };
        let long = |value: usize| (value as u32).to_le_bytes().to_vec();
        let data = out.len();
        out.extend(*pixels);
        let mut entries = vec![
            (254, 4, long(4 * number)),
            (256, 4, long(*width)),
            (257, 4, long(*height)),
            (273, 4, long(data)),
            (278, 4, long(*height)),
            (279, 4, long(pixels.len())),
        ];
        entries.extend(tags.iter().map(|(tag, values)| (*tag, 3, short(values))));
        entries.sort();
        let mut table = (entries.len() as u16).to_le_bytes().to_vec();
        for (tag, kind, value) in entries {
            table.extend(tag.to_le_bytes());
            table.extend(u16::to_le_bytes(kind));
            table.extend(long(value.len() / if kind == 3 { 2 } else { 4 }));
            if value.len() > 4 {
                table.extend(long(out.len()));
                out.extend(value);
            } else {
                table.extend(&value);
                table.resize(table.len() + 4 - value.len(), 0);
            }
        }
        let at = long(out.len());
        out[link..link + 4].copy_from_slice(&at);
        out.extend(table);
        link = out.len();
        out.extend([0; 4]);
    }
    open(out).unwrap()
}

fn shown(file: &TiffFile) -> Vec<Rgba> {
    let chunk = file.chunk(0, 0, 0).unwrap();
    let colours = Colours::of(file).unwrap();
    colours
        .paint(&file.levels()[0], chunk.as_ref())
        .pixels()
        .to_vec()
}

fn words(values: &[u16]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// 2000 of 4095, the largest number of the twelve bits that 3000 needs, are 125 of 255.
#[test]
fn pixels_that_are_not_shown_do_not_darken_those_of_16_bits() {
    let rgb = [
        (258, &[16, 16, 16][..]),
        (259, &[1]),
        (262, &[2]),
        (277, &[3]),
    ];
    let rgba = [
        (258, &[16; 4][..]),
        (259, &[1]),
        (262, &[2]),
        (277, &[4]),
        (338, &[2]),
    ];
    for border in [65_535, 0] {
        let pixels = words(&[2000, 3000, 1000, 65_535, border, border, border, 0]);
        let seen = shown(&tiff(&[Image(2, 1, &pixels, &rgba)]));
        assert_eq!(seen, [[125, 187, 62, 255], [0; 4]], "{border}");
        let pixels = words(&[2000, 3000, 1000, border, border, border]);
        let mask = [(258, &[8][..]), (259, &[1]), (262, &[4]), (277, &[1])];
        let file = tiff(&[Image(2, 1, &pixels, &rgb), Image(2, 1, &[1, 0], &mask)]);
        assert_eq!(shown(&file)[0], [125, 187, 62, 255], "{border}");
        assert_eq!(Colours::of(&file).unwrap().white(), 4095, "{border}");
    }
}

#[test]
fn a_palette_has_transparency_as_other_pictures_have() {
    let mut palette = [0; 768];
    (palette[1], palette[256 + 2]) = (65_535, 65_535);
    let tags = [
        (258, &[8, 8][..]),
        (259, &[1]),
        (262, &[3]),
        (277, &[2]),
        (320, &palette),
        (338, &[2]),
    ];
    let seen = shown(&tiff(&[Image(
        4,
        1,
        &[1, 255, 2, 255, 1, 0, 2, 128],
        &tags,
    )]));
    assert_eq!(
        seen,
        [[255, 0, 0, 255], [0, 255, 0, 255], [0; 4], [0, 255, 0, 128]]
    );
}

/// The first pixel of 0x0f is white where the bits of every stored byte are in the other order, also of packed ones.
#[test]
fn bits_of_bytes_may_be_stored_in_the_other_order() {
    let reversed = |bytes: &[u8]| {
        bytes
            .iter()
            .map(|byte| byte.reverse_bits())
            .collect::<Vec<u8>>()
    };
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(&[0xf0]).unwrap();
    let packed = encoder.finish().unwrap();
    for (order, method, stored) in [
        (1, 1, vec![0xf0]),
        (2, 1, vec![0x0f]),
        (1, 8, packed.clone()),
        (2, 8, reversed(&packed)),
    ] {
        let tags = [
            (258, &[1][..]),
            (259, &[method]),
            (262, &[1]),
            (266, &[order]),
            (277, &[1]),
        ];
        let seen = shown(&tiff(&[Image(8, 1, &stored, &tags)]));
        let white = seen.iter().map(|p| p[0] == 255).collect::<Vec<_>>();
        assert_eq!(white, [[true; 4], [false; 4]].concat(), "{order}, {method}");
    }
}
