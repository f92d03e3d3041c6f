//! Layout of the pixels of one image of a TIFF file: how they are cut and stored.

use super::compression::compression;
use super::{Compression, Directory, LARGEST_CHUNK, MOST_CHUNK_PIXELS, Tag, TiffError};

/// Longest side of an image, pixels.
const LONGEST_SIDE: u64 = 1 << 20;
/// Most pixels of an image.
const MOST_PIXELS: u64 = 1 << 34;
/// Most samples of a pixel.
const MOST_SAMPLES: u64 = 64;
/// Uncompressed strips above this are read in parts, bytes.
const PART_OF_STRIP: u64 = 1 << 18;

/// Meaning of the samples of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Photometric {
    /// Grey, white at zero.
    WhiteIsZero,
    /// Grey, black at zero.
    BlackIsZero,
    /// Red, green, blue.
    Rgb,
    /// A number of a colour in a palette.
    Palette,
    /// Luminance and two colour differences; only inside JPEG, which turns it into RGB.
    YCbCr,
    /// A mask: nonzero pixels of another image are valid.
    Mask,
}

/// Order of the bits in a byte as it is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FillOrder {
    /// The most significant first, as everywhere else.
    MostFirst,
    /// The least significant first, as some scanners write it.
    LeastFirst,
}

/// Type of a sample by its bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampleKind {
    /// Whole numbers of other than whole bytes: 1 to 15 bits, packed from the most significant on, and
    /// every row begins with a byte.
    Bits(u8),
    /// 8 bits.
    U8,
    /// 8 bits with a sign.
    I8,
    /// 16 bits.
    U16,
    /// 16 bits with a sign.
    I16,
    /// 32 bits.
    U32,
    /// 32 bits with a sign.
    I32,
    /// 64 bits.
    U64,
    /// 64 bits with a sign.
    I64,
    /// Real number of 16 bits.
    F16,
    /// Real number of 32 bits.
    F32,
    /// Real number of 64 bits.
    F64,
}

/// Layout of one image: what it takes to read any tile of it.
#[derive(Clone, Debug)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "four independent properties of the format"
)]
pub struct TiffLayout {
    /// Pixels from left to right.
    pub width: usize,
    /// Pixels from top to bottom.
    pub height: usize,
    /// Pixels across a tile; a strip is as wide as the image.
    pub chunk_width: usize,
    /// Pixels down a tile or strip.
    pub chunk_height: usize,
    /// Whether the image is cut into tiles, not strips.
    pub is_tiled: bool,
    /// Samples of a pixel.
    pub samples: usize,
    /// Whether every sample has tiles of its own.
    pub is_planar: bool,
    /// Type of a sample.
    pub kind: SampleKind,
    /// Compression of tiles.
    pub compression: Compression,
    /// Order of bits in the bytes of tiles.
    pub bit_order: FillOrder,
    /// 1: samples as they are, 2: differences to the left, 3: the same for the bytes of reals.
    pub predictor: u64,
    /// Meaning of the samples.
    pub photometric: Photometric,
    /// Index of the sample that is transparency, and whether colours are multiplied by it.
    pub alpha: Option<(usize, bool)>,
    /// Palette: red of all colours, then green, then blue, 16 bits each.
    pub palette: Vec<u16>,
    /// Value of pixels without data.
    pub no_data: Option<f64>,
    /// Bytes of the tables that all JPEG tiles share.
    pub jpeg_tables: Vec<u8>,
    /// Whether numbers begin with the least significant byte.
    pub is_little_endian: bool,
    /// Whether this is a smaller copy of another image.
    pub is_overview: bool,
    /// First byte and number of bytes of every tile or strip of the file.
    places: Vec<(u64, u64)>,
    /// Parts into which a strip of the file is cut.
    parts: usize,
}

impl SampleKind {
    /// Bits of a sample.
    pub fn bits(self) -> usize {
        match self {
            Self::Bits(bits) => usize::from(bits),
            Self::U8 | Self::I8 => 8,
            Self::U16 | Self::I16 | Self::F16 => 16,
            Self::U32 | Self::I32 | Self::F32 => 32,
            Self::U64 | Self::I64 | Self::F64 => 64,
        }
    }

    /// Bytes of `count` samples of a row, padded to whole bytes.
    pub(super) fn row_bytes(self, count: usize) -> usize {
        (count * self.bits()).div_ceil(8)
    }
}

impl TiffLayout {
    /// The layout that a directory describes.
    pub fn from_directory(directory: &Directory) -> Result<Self, TiffError> {
        let side = |tag: Tag| -> Result<usize, TiffError> {
            match directory.number(tag)? {
                Some(n) if (1..=LONGEST_SIDE).contains(&n) => Ok(n as usize),
                Some(n) => Err(directory.blame(&tag.name()).damaged(format!(
                    "{n} pixels; one to {LONGEST_SIDE} would be sensible"
                ))),
                None => Err(directory.blame(&tag.name()).damaged("it is missing")),
            }
        };
        let subfile = directory.number(Tag::NewSubfileType)?.unwrap_or(0);
        let (width, height) = (side(Tag::ImageWidth)?, side(Tag::ImageLength)?);
        if width as u64 * height as u64 > MOST_PIXELS {
            return Err(directory
                .blame(&Tag::ImageLength.name())
                .unsupported(format!(
                    "{width} × {height} pixels; at most {MOST_PIXELS} are read"
                )));
        }
        let samples = directory.number(Tag::SamplesPerPixel)?.unwrap_or(1);
        if !(1..=MOST_SAMPLES).contains(&samples) {
            return Err(directory
                .blame(&Tag::SamplesPerPixel.name())
                .unsupported(format!(
                    "{samples} samples a pixel; 1 to {MOST_SAMPLES} are read"
                )));
        }
        let samples = samples as usize;
        let compression = compression(directory)?;
        let photometric = if subfile & 4 == 4 {
            Photometric::Mask
        } else {
            photometric(directory, compression)?
        };
        let is_tiled = directory.number(Tag::TileWidth)?.is_some();
        let (chunk_width, chunk_height) = if is_tiled {
            (side(Tag::TileWidth)?, side(Tag::TileLength)?)
        } else {
            let rows = directory.number(Tag::RowsPerStrip)?.unwrap_or(u64::MAX);
            (width, rows.clamp(1, height as u64) as usize)
        };
        let mut layout = Self {
            width,
            height,
            chunk_width,
            chunk_height,
            is_tiled,
            samples,
            is_planar: directory.number(Tag::PlanarConfiguration)? == Some(2) && samples > 1,
            kind: kind(directory)?,
            compression,
            bit_order: match directory.number(Tag::FillOrder)? {
                // JPEG has an order of its own.
                Some(2) if compression != Compression::Jpeg => FillOrder::LeastFirst,
                _ => FillOrder::MostFirst,
            },
            predictor: directory.number(Tag::Predictor)?.unwrap_or(1),
            photometric,
            alpha: alpha(directory, photometric, samples)?,
            palette: (directory.numbers(Tag::ColorMap)?.iter())
                .map(|v| *v as u16)
                .collect(),
            no_data: directory
                .text(Tag::GdalNoData)
                .and_then(|text| text.trim().parse().ok()),
            jpeg_tables: directory.bytes(Tag::JPEGTables),
            is_little_endian: directory.is_little_endian(),
            is_overview: subfile & 1 == 1,
            places: Vec::new(),
            parts: 1,
        };
        layout.check(directory)?;
        layout.find_places(directory)?;
        Ok(layout)
    }

    /// Tiles or strips from left to right.
    pub fn across(&self) -> usize {
        self.width.div_ceil(self.chunk_width)
    }

    /// Tiles or strips from top to bottom.
    pub fn down(&self) -> usize {
        self.height.div_ceil(self.chunk_height)
    }

    /// Samples that lie together in a tile.
    pub(super) fn samples_together(&self) -> usize {
        if self.is_planar { 1 } else { self.samples }
    }

    /// Rows that are stored for the tiles of the given row of tiles: the last strip is shorter.
    pub(super) fn stored_rows(&self, chunk_row: usize) -> usize {
        if self.is_tiled {
            self.chunk_height
        } else {
            self.chunk_height
                .min(self.height - chunk_row * self.chunk_height)
        }
    }

    /// Bytes of a decoded tile with all its samples.
    pub(super) fn chunk_bytes(&self) -> u64 {
        let row = self
            .kind
            .row_bytes(self.chunk_width * self.samples_together()) as u64;
        let planes = if self.is_planar { self.samples } else { 1 };
        row * self.chunk_height as u64 * planes as u64
    }

    fn check(&self, directory: &Directory) -> Result<(), TiffError> {
        let name = Tag::Predictor.name();
        let fits = match self.predictor {
            1 => true,
            2 => !matches!(self.kind, SampleKind::Bits(_)),
            3 => matches!(
                self.kind,
                SampleKind::F16 | SampleKind::F32 | SampleKind::F64
            ),
            _ => false,
        };
        if !fits {
            return Err(directory.blame(&name).unsupported(format!(
                "predictor {} for samples of {} bits is not read; 1, 2 and, for reals, 3 are",
                self.predictor,
                self.kind.bits()
            )));
        }
        if self.compression == Compression::Jpeg && self.kind != SampleKind::U8 {
            return Err(directory
                .blame(&Tag::BitsPerSample.name())
                .unsupported("JPEG with other than 8 bits is not read; export it with deflate"));
        }
        if self.compression == Compression::WebP
            && !(self.kind == SampleKind::U8 && matches!(self.samples_together(), 3 | 4))
        {
            return Err(directory.blame(&Tag::BitsPerSample.name()).unsupported(
                "WebP with other than three or four samples of 8 bits is not read; export it with deflate",
            ));
        }
        let has_lerc = !matches!(
            self.kind,
            SampleKind::Bits(_) | SampleKind::U64 | SampleKind::I64 | SampleKind::F16
        );
        if matches!(self.compression, Compression::Lerc(_)) && !has_lerc {
            return Err(directory.blame(&Tag::BitsPerSample.name()).unsupported(
                "LERC with samples of other than 8, 16 or 32 bits or reals of 64 is not read; export it with deflate",
            ));
        }
        let is_index = matches!(
            self.kind,
            SampleKind::Bits(_) | SampleKind::U8 | SampleKind::U16
        );
        if self.photometric == Photometric::Palette && (self.palette.is_empty() || !is_index) {
            let name = Tag::ColorMap.name();
            return Err(directory
                .blame(&name)
                .damaged("a palette picture without a palette"));
        }
        Ok(())
    }

    /// Takes over the places of tiles or strips; cuts large uncompressed strips.
    fn find_places(&mut self, directory: &Directory) -> Result<(), TiffError> {
        let (offsets, counts) = if self.is_tiled {
            (Tag::TileOffsets, Tag::TileByteCounts)
        } else {
            (Tag::StripOffsets, Tag::StripByteCounts)
        };
        let planes = if self.is_planar { self.samples } else { 1 };
        let expected = self.across() as u64 * self.down() as u64 * planes as u64;
        let places = directory.numbers(offsets)?;
        let sizes = directory.numbers(counts)?;
        for (tag, found) in [(offsets, places.len()), (counts, sizes.len())] {
            if (found as u64) < expected {
                return Err(directory.blame(&tag.name()).damaged(format!(
                    "{found} values where the image has {expected} tiles or strips"
                )));
            }
        }
        let pairs = places.into_iter().zip(sizes).take(expected as usize);
        self.places = pairs.collect();
        let strip = self.chunk_bytes();
        if !self.is_tiled && self.compression == Compression::None && strip > PART_OF_STRIP {
            let whole = strip / self.chunk_height as u64 * self.height as u64;
            if whole > directory.length() {
                return Err(directory.blame(&Tag::ImageLength.name()).damaged(format!(
                    "{whole} bytes of pixels in a file of {}",
                    directory.length()
                )));
            }
            self.cut_strips();
        }
        let pixels = self.chunk_width * self.chunk_height;
        if self.chunk_bytes() > LARGEST_CHUNK || pixels > MOST_CHUNK_PIXELS {
            return Err(directory.blame("layout").unsupported(format!(
                "one tile or strip has {} × {} pixels; convert the map to tiles of 256 or 512 pixels",
                self.chunk_width, self.chunk_height
            )));
        }
        Ok(())
    }

    /// Cuts uncompressed strips into parts, so that a window does not need the whole of one.
    fn cut_strips(&mut self) {
        let row = self.kind.row_bytes(self.width * self.samples_together()) as u64;
        let whole = self.chunk_height;
        let most = (PART_OF_STRIP / row).clamp(1, whole as u64) as usize;
        // Parts must not run across the end of a strip.
        let part = (1..=most)
            .rev()
            .find(|n| whole.is_multiple_of(*n))
            .unwrap_or(1);
        self.parts = whole / part;
        self.chunk_height = part;
    }

    /// First byte and number of bytes of a tile, strip or part of a strip; no bytes where the file
    /// leaves it out.
    pub(super) fn place(&self, plane: usize, column: usize, row: usize) -> (u64, u64) {
        let strips = self.down().div_ceil(self.parts);
        let index = (plane * strips + row / self.parts) * self.across() + column;
        let Some(&(offset, count)) = self.places.get(index) else {
            return (0, 0);
        };
        if self.parts == 1 || count == 0 {
            return (offset, count);
        }
        let bytes = self.kind.row_bytes(self.width * self.samples_together());
        let skipped = (row % self.parts * self.chunk_height * bytes) as u64;
        let own = (self.stored_rows(row) * bytes) as u64;
        (offset.saturating_add(skipped), own)
    }
}

fn photometric(directory: &Directory, packed: Compression) -> Result<Photometric, TiffError> {
    let name = Tag::PhotometricInterpretation.name();
    let number = directory.number(Tag::PhotometricInterpretation)?;
    Ok(match number.unwrap_or(1) {
        0 => Photometric::WhiteIsZero,
        1 => Photometric::BlackIsZero,
        2 => Photometric::Rgb,
        3 => Photometric::Palette,
        4 => Photometric::Mask,
        6 if packed == Compression::Jpeg => Photometric::YCbCr,
        other => {
            return Err(directory.blame(&name).unsupported(format!(
                "colours of kind {other} are not read; export it as grey or RGB"
            )));
        }
    })
}

fn kind(directory: &Directory) -> Result<SampleKind, TiffError> {
    let bits = directory.numbers(Tag::BitsPerSample)?;
    let first = bits.first().copied().unwrap_or(1);
    let format = directory.number(Tag::SampleFormat)?.unwrap_or(1);
    let found = match (first, format) {
        (8, 1 | 4) => Some(SampleKind::U8),
        (8, 2) => Some(SampleKind::I8),
        (16, 1 | 4) => Some(SampleKind::U16),
        (16, 2) => Some(SampleKind::I16),
        (32, 1 | 4) => Some(SampleKind::U32),
        (32, 2) => Some(SampleKind::I32),
        (64, 1 | 4) => Some(SampleKind::U64),
        (64, 2) => Some(SampleKind::I64),
        (16, 3) => Some(SampleKind::F16),
        (32, 3) => Some(SampleKind::F32),
        (64, 3) => Some(SampleKind::F64),
        (bits @ (1..=7 | 9..=15), 1 | 4) => Some(SampleKind::Bits(bits as u8)),
        _ => None,
    };
    found
        .filter(|_| bits.iter().all(|b| *b == first))
        .ok_or_else(|| {
            let name = Tag::BitsPerSample.name();
            directory.blame(&name).unsupported(format!(
                "samples of {bits:?} bits in format {format} are not read; whole numbers of 1 to 16, 32 and 64 bits and reals of 16, 32 and 64 are"
            ))
        })
}

fn alpha(
    directory: &Directory,
    photometric: Photometric,
    samples: usize,
) -> Result<Option<(usize, bool)>, TiffError> {
    let colours = match photometric {
        Photometric::Rgb | Photometric::YCbCr => 3,
        _ => 1,
    };
    let extra = directory.numbers(Tag::ExtraSamples)?;
    let found = extra.iter().position(|kind| matches!(kind, 1 | 2));
    // Files with three grey bands and one more mean colours as well: count from the end.
    let first = samples.saturating_sub(extra.len()).max(colours);
    Ok(found
        .map(|i| (first + i, extra[i] == 1))
        .filter(|(index, _)| *index < samples))
}
